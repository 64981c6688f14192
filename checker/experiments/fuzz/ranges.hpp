// The ranges that variants of a scenario are drawn from: `vary:` of the scenario, which options may
// override, further numeric knobs, and the schedule of the deployment.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/tree/result.hpp"
#include "model/scenario.hpp"

namespace stormproof::fuzz {

/// A numeric knob that takes every value from `low` to `high` with equal probability; or, as
/// launch::plan_key, how far processes or hosts (as often one as the other) start apart.
struct KnobRange {
  std::string key;
  model::config::NumericKnob::Unit unit{};
  std::int64_t low = 0, high = 0;
};

struct Ranges {
  model::Variation vary;
  std::vector<KnobRange> knobs;
  bool schedule = false;  ///< the deployment's schedule is drawn anew
  bool usual = false;     ///< nobody stated any range, so `vary` is `usual_variation()`
};

/// What is varied if nothing is stated: starts by up to 100 ms, one packet of a hundred lost.
[[nodiscard]] model::Variation usual_variation();

/// Reads "KEY=LOW..HIGH", both of them in the syntax of the knob.
[[nodiscard]] model::config::Result<KnobRange> parse_knob_range(const std::string& text,
                                                                const model::Scenario& scenario);

/// The ranges of `scenario.vary`, its schedule and `knobs`; the usual ones if there are none.
[[nodiscard]] Ranges ranges_around(const model::Scenario& scenario, std::vector<KnobRange> knobs);

/// The knobs that `sizes`, `delays` and `timers` scale. A knob that is 0 is off and stays so.
[[nodiscard]] std::vector<model::config::NumericKnob> size_knobs(const model::Scenario& scenario);
[[nodiscard]] std::vector<model::config::NumericKnob> delay_knobs(const model::Scenario& scenario);
[[nodiscard]] std::vector<model::config::NumericKnob> timer_knobs(const model::Scenario& scenario);

/// One range, in words.
struct RangeText {
  std::string name;  ///< "start_jitter", or the key of a knob
  std::string text;  ///< "each participant starts 0 to 100ms later"
};
[[nodiscard]] std::vector<RangeText> describe(const Ranges& ranges,
                                              const model::Scenario& scenario);

}  // namespace stormproof::fuzz
