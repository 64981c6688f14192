// Which effect of the rules (fsm/composition) is behind what an observer hears: the last one that
// began in the event, by the id that `draw composition` prints. Traces, timelines and the stories
// of counterexamples name packets and timers after it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

#include "fsm/composition/effect_mutation.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::model::trace {

class EffectNames {
 public:
  /// Of the composition that the profile's implementation executes.
  explicit EffectNames(const DdsProfile& dds);

  /// An event starts: nothing has happened in it.
  void event_started() { last_ = {}; }
  /// Returns the id of the effect, "AckNackArrives.3".
  std::string_view happens(fsm::composition::EffectKey key) { return last_ = ids_.at(key); }
  /// What happens now; empty: no effect of a rule.
  [[nodiscard]] std::string_view last() const { return last_; }

  /// It starts the timer with this insertion number.
  void starts_timer(std::uint64_t insertion) {
    if (!last_.empty()) timers_.emplace(insertion, last_);
  }
  /// A timer that is pending has another insertion number now.
  void renumber_timer(std::uint64_t before, std::uint64_t insertion) {
    auto timer = timers_.extract(before);
    if (!timer) return;
    timer.key() = insertion;
    timers_.insert(std::move(timer));
  }
  /// Which one started the timer that is due now; empty: none, because it was started before the
  /// run. To be asked once.
  [[nodiscard]] std::string_view take_starter(std::uint64_t insertion);

 private:
  std::map<fsm::composition::EffectKey, std::string> ids_;
  std::string_view last_;
  std::unordered_map<std::uint64_t, std::string_view> timers_;  // while scheduled
};

/// Whether a recording names effects, which slows the run down.
enum class Effects : std::uint8_t { left_out, named };

}  // namespace stormproof::model::trace
