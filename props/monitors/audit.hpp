// What a run did, held against what the rules say that it does (props/monitors/followed.cpp): the
// rules are executed beside the run (props/monitors/auditor.hpp), and each effect that an observer
// sees must be the next one of the run. The first difference is kept in words.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fsm/composition/vocabulary.hpp"
#include "model/probe.hpp"
#include "props/monitors/deeds.hpp"

namespace stormproof::props {

/// It is the probe of the machines that move beside the run.
class Audit final : public model::Probe {
 public:
  explicit Audit(const model::Topology& topology) : topology_{topology}, deeds_{topology} {}

  [[nodiscard]] Deeds& deeds() { return deeds_; }
  /// In words, what the run did that the rules do not say, or the other way around.
  [[nodiscard]] const std::optional<std::string>& difference() const { return difference_; }

  void begin(std::string_view rule) {
    rule_ = rule;
    site_ = {};
  }
  /// The effects that come now are those at this place in the source.
  void stands_at(fsm::composition::Site site) {
    settle();
    site_ = site;
  }
  /// Nothing more follows from what has happened.
  void nothing_more();

  // What the run must do next.
  /// Moves of one event of an owner's machines may come in any order and in any parts.
  void transition(const Move& wanted) override;
  /// Null if the run did something else.
  const Scheduled* expect(const Scheduled& wanted);
  void expect(const Message& wanted) { expect(wanted, {&wanted.pair, 1}); }
  /// To each of the pairs.
  void expect(const Message& wanted, std::span<const std::uint32_t> pairs);
  /// The next thing that the run did, if it is a message.
  [[nodiscard]] const Message* next_message(std::size_t skip = 0) {
    settle();
    return deeds_.next<Message>(skip);
  }
  /// Whether the run did next all that `body` does, which changes no state.
  template <class Body>
  [[nodiscard]] bool would(Body&& body) {
    settle();
    ahead_ = deeds_.position();
    fits_ = true;
    sees_some_ = false;
    looks_ahead_ = true;
    body();
    looks_ahead_ = false;
    return fits_ && sees_some_;
  }
  /// Nothing more is to be told: what is looked at ahead is not what the run did.
  [[nodiscard]] bool has_parted() const { return looks_ahead_ && !fits_; }

 private:
  /// Holds the moves that were told so far against those of the run.
  void settle() {
    if (!moved_.empty()) settle_moves();
  }
  void settle_moves();
  /// `wanted` is what the rules say that happens next; the run did something else.
  void differ(const std::string& wanted);
  template <class Kind, class Same>
  const Kind* next(const Kind& wanted, Same&& same);

  const model::Topology& topology_;
  Deeds deeds_;
  std::vector<Move> moved_;  // that the run must do, too
  std::string_view rule_;
  fsm::composition::Site site_;  // of the effect that is looked at
  std::optional<std::string> difference_;
  bool looks_ahead_ = false;
  bool fits_ = true;  // so far what is looked at ahead
  bool sees_some_ = false;
  Deeds::Position ahead_;
};

}  // namespace stormproof::props
