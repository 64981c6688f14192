// Time in a derived system, for those who ask for it: an integer `now`, and for each thing that is
// surely under way the latest instant at which it happens. By these rules, which know no protocol:
//   1. a timer that is surely pending is due at "due T": of an uncounted one the earliest of those
//      that were started since one was last due, of a counted one the last of those that are
//      pending;
//   2. of each kind of packet at most one is looked at: the first that matters and is not lost,
//      until it arrives. It arrives within Δ, and has left its source within σ. Each loss of one
//      that would be looked at raises the ghost "limit" as far as a loss does. A packet may be of a
//      further kind that is looked at beside;
//   3. time passes as long as nothing that is looked at is overdue;
//   4. if every packet takes Δ, none of a kind arrives before the first one of that kind can;
//   5. no timer of a kind fires before "earliest T", when the first of them is due, and what must
//      arrive now arrives before a timer fires: receptions come first (order.reception-first).
// Everything else happens when it will, as without time.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "checker/engines/tables/derivation.hpp"

namespace stormproof::tables {

/// The names of the variables.
namespace timed {
inline constexpr const char* now = "now";
inline constexpr const char* limit = "limit";
inline constexpr const char* passing = "time passes";  ///< the name of that step
[[nodiscard]] std::string due(std::string_view timer);
[[nodiscard]] std::string earliest(std::string_view timer);
[[nodiscard]] std::string in_flight(std::string_view packet);
[[nodiscard]] std::string arrives(std::string_view packet);
[[nodiscard]] std::string sent(std::string_view packet);   ///< one has been sent
[[nodiscard]] std::string first(std::string_view packet);  ///< when that can arrive
[[nodiscard]] std::string leaving(std::string_view packet);
[[nodiscard]] std::string leaves(std::string_view packet);
}  // namespace timed

class DerivedTime {
 public:
  /// What a packet says of our descriptor and of itself, by field.
  using Says = std::map<std::string, Expr>;
  struct Network {
    Expr delay;                                   ///< Δ
    Expr source;                                  ///< σ
    std::function<Expr(const Expr& limit)> lost;  ///< the limit after a loss
    bool loses;                                   ///< packets can be lost
    bool exact;                                   ///< every packet takes Δ, not less
    /// Whether a packet with this content is looked at as one of this kind until it arrives.
    std::function<Expr(std::string_view kind, const Says& says)> matters;
    /// And until it has left its source.
    std::function<Expr(std::string_view packet, const Says& says)> matters_at_source;
    /// The further kind of a packet, by its name.
    std::map<std::string, std::string> further{};
  };

  DerivedTime(Derivation& derivation, Network network);

  [[nodiscard]] Expr now() { return derivation_.now(timed::now); }

  void declare_timer(const std::string& timer, bool counted);
  /// `leaves`: a rule waits for its having left the source.
  void declare_packet(const std::string& packet, bool leaves);

  // In a step. To be called before the derivation counts.
  void started(const std::string& timer, const Expr& when, const Expr& due);
  void fires(const std::string& timer);
  void emitted(const std::string& packet, const Expr& when, const Says& says);
  void arrived(const std::string& packet, const Says& says);
  void left(const std::string& packet, const Says& says);

  /// Derives the step that lets time pass.
  void derive_passing();

 private:
  struct Timer {
    std::string name;
    bool counted;
  };

  [[nodiscard]] Expr is_pending(const Timer& timer);
  [[nodiscard]] std::vector<std::string> kinds_of(const std::string& packet) const;
  void emitted_as(const std::string& kind, const Expr& when, const Says& says);
  void look_at(const std::string& flag, const std::string& by, const Expr& when, const Expr& end);

  Derivation& derivation_;
  Network network_;
  std::vector<Timer> timers_;
  std::vector<std::string> arriving_;
  std::vector<std::string> leaving_;
};

}  // namespace stormproof::tables
