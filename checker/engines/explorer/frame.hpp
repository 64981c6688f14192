// What a world works on while it processes one event: the pending events and their zone, the
// packets it emits (each of which the search may lose), and the objections it raises. A frame can
// keep a log of all constraints, from which checker/engines/explorer/path.hpp finds concrete times.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "checker/engines/explorer/scope.hpp"
#include "checker/engines/explorer/slot.hpp"
#include "checker/engines/explorer/zone.hpp"
#include "model/mutation.hpp"

namespace stormproof::explorer {

/// What the explorer can object to, by the property that breaks.
enum class Claim : std::uint8_t {
  ack_implies_received,
  repair_only_if_asked,
  snapshot,
  single_heartbeat,
  suppression_honoured,
  no_stall,
  completion,
  quiescence,
  single_copy,
  free_threshold
};
inline constexpr std::size_t claim_count = 10;
using Claims = std::uint16_t;  ///< a set, one bit each

[[nodiscard]] constexpr Claims bit(Claim claim) {
  return static_cast<Claims>(1U << static_cast<unsigned>(claim));
}

/// How events are scheduled: by the rules, or with the mistakes of a mutant.
struct EventRules {
  struct Rule {
    std::int64_t shift = 0;   ///< ns later
    std::uint8_t copies = 1;  ///< how many are scheduled
    model::EventClass event_class{};
  };
  std::array<Rule, static_cast<std::size_t>(What::completed) + 1> rules{};

  EventRules(std::span<const model::EventMutation> mutations, bool receives_separately);
  [[nodiscard]] const Rule& of(What what) const { return rules[static_cast<std::size_t>(what)]; }
};

/// x_a - x_b <= c, over the numbers that variables have along a path.
struct Constraint {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::int64_t c = 0;
};

/// Everything that happened along one path. Variable 0 is the start of the world.
struct PathLog {
  static constexpr std::uint32_t none = UINT32_MAX;
  struct Fired {
    Slot slot;
    std::uint32_t variable = 0;
  };
  struct Emission {
    Slot packet;
    std::uint32_t emitted = 0;         ///< the event that emitted it
    std::uint32_t received = none;     ///< none: it is lost
    std::uint32_t left_source = none;  ///< only of repair DATA
  };
  std::uint32_t variables = 1;
  std::vector<Fired> scheduled;  ///< all variables but marks, as they come into being
  std::vector<Constraint> constraints;
  std::vector<Fired> fired;
  std::vector<Emission> emissions;
};

class Frame {
 public:
  static constexpr unsigned capacity = Zone::capacity - 1;

  /// An empty frame at the start of the world.
  Frame(const Scope& scope, const EventRules& rules) : scope_{&scope}, rules_{&rules} {}

  [[nodiscard]] unsigned count() const { return zone_.size() - 1; }
  [[nodiscard]] const Slot& slot(unsigned k) const { return slots_[k]; }
  [[nodiscard]] const Zone& zone() const { return zone_; }
  [[nodiscard]] bool overflowed() const { return overflowed_; }

  /// How many packets may still be lost.
  void set_losses(unsigned losses) { losses_left_ = losses; }
  /// Rebuilds a stored frame.
  template <class Bound>
  void restore(const Slot* slots, unsigned count, const Bound* bounds, unsigned losses_left) {
    zone_.assign(count + 1, bounds);
    std::copy(slots, slots + count, slots_.begin());
    losses_left_ = losses_left;
  }

  /// Whether slot k can be the next event.
  [[nodiscard]] bool can_be_next(unsigned k) const;
  /// Slot k happens now: it is removed, and the present is its time. `loss_mask` says which of the
  /// packets emitted from now on are lost, `choices` which comparisons of times do not hold.
  Slot advance(unsigned k, unsigned loss_mask, unsigned choices = 0);
  /// Whether x_a - x_b <= c (variables of the zone). If both are possible, the choices of the step
  /// say so, and from now on it is.
  [[nodiscard]] bool holds(unsigned a, unsigned b, std::int64_t c);
  /// How many comparisons of this step both were possible in.
  [[nodiscard]] unsigned choices() const { return chosen_; }

  /// Something happens `delay` ns from now.
  void schedule(Slot slot, std::int64_t delay) { schedule_between(slot, delay, delay); }
  void schedule_between(Slot slot, std::int64_t low, std::int64_t high);
  /// The pending event k does not happen after another one.
  void precede(unsigned k, unsigned other) { relate(k, other, 0); }
  /// Something happens when the mark k is.
  void schedule_with(Slot slot, unsigned k);
  /// A packet is emitted now; it arrives within the scope's delays, unless it is lost.
  void emit(Slot packet);
  /// The packet that was emitted last has another part, which arrives right after the others.
  void emit_part(Slot part);
  /// Puts the slots into an order that says no more than it must: events of one class that may
  /// happen at the same time keep the order of their insertion, and nothing else does.
  void sort();
  /// The present is remembered; or when it will be `delay` ns later.
  void mark(Slot slot, std::int64_t delay = 0);
  void erase_marks(What what, std::uint16_t set, unsigned relation = 0);
  /// What slot k stands for is of no interest any more.
  void erase(unsigned k);
  /// The count that a packet carries; what is said in comparison may be said in another way.
  void set_count(unsigned k, std::uint16_t count) { slots_[k].count = count; }
  /// There is more than a state can hold.
  void overflow() { overflowed_ = true; }
  /// Position of the first such slot, or `count()`.
  [[nodiscard]] unsigned find(What what, std::uint16_t set = 0, unsigned relation = 0) const;
  [[nodiscard]] unsigned pending(What what, unsigned relation) const;
  [[nodiscard]] bool any_pending() const;

  /// The claim is broken in every concrete run of this frame.
  void object(Claim claim) { object_if(claim, 0, 0, 0); }
  /// The claim is broken in runs where x_a - x_b <= c (variables of the zone); no objection if
  /// there is none.
  void object_if(Claim claim, unsigned a, unsigned b, std::int64_t c);
  [[nodiscard]] Claims objections() const { return objections_; }
  /// Only with a log: keeps the runs in which `claim` was objected to.
  void keep_objection(Claim claim) { kept_ = bit(claim); }

  /// Whether a packet emitted in this step is lost.
  [[nodiscard]] bool lost_something() const { return loss_mask_ != 0; }
  [[nodiscard]] unsigned losses_left() const { return losses_left_; }
  [[nodiscard]] bool no_losses_yet() const { return losses_left_ == scope_->losses; }
  [[nodiscard]] unsigned emitted() const { return emitted_; }
  /// Descriptors that this step puts into DATA.
  void count_generated(unsigned descriptors) { generated_ += descriptors; }
  [[nodiscard]] unsigned generated() const { return generated_; }

  /// Logs from now on; the frame must be a start.
  void log_to(PathLog& log) { log_ = &log; }

 private:
  [[nodiscard]] std::uint64_t rank(unsigned k) const;
  [[nodiscard]] Zone::Limits limits(unsigned k) const;
  unsigned append(Slot slot, std::int64_t low, std::int64_t high);
  void relate(unsigned a, unsigned b, std::int64_t c);
  [[nodiscard]] bool belong_the_other_way(unsigned k) const;
  [[nodiscard]] std::uint32_t id_of(unsigned variable) const {
    return variable == 0 ? now_id_ : ids_[variable - 1];
  }

  const Scope* scope_;
  const EventRules* rules_;
  Zone zone_;
  std::array<Slot, capacity> slots_{};
  std::array<std::uint32_t, capacity> ids_{};
  std::uint32_t now_id_ = 0;
  PathLog* log_ = nullptr;
  unsigned loss_mask_ = 0;
  unsigned choices_ = 0;
  unsigned chosen_ = 0;
  unsigned emitted_ = 0;
  unsigned arrival_ = capacity;  ///< of the packet that was emitted last; capacity: none
  unsigned generated_ = 0;
  unsigned losses_left_ = 0;
  Claims objections_ = 0;
  Claims kept_ = 0;
  bool overflowed_ = false;
};

}  // namespace stormproof::explorer
