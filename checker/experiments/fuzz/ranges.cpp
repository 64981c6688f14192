// Reads, completes and describes ranges.
#include "checker/experiments/fuzz/ranges.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/experiments/trials/launch_plan.hpp"
#include "model/config/tree/quantities.hpp"
#include "model/config/tree/suggestion.hpp"

namespace stormproof::fuzz {

using model::config::InputError;
using model::config::NumericKnob;
using model::config::Result;

namespace {

using Parsed = model::config::Parsed<std::int64_t>;

template <class Quantity>
Parsed plain(const model::config::Parsed<Quantity>& parsed) {
  if (!parsed) return parsed.error();
  return parsed->count();
}

Parsed parse_value(NumericKnob::Unit unit, std::string_view text) {
  switch (unit) {
    case NumericKnob::Unit::nanoseconds:
      return plain(model::config::parse_duration(text));
    case NumericKnob::Unit::bits_per_second:
      return plain(model::config::parse_rate(text));
    case NumericKnob::Unit::bytes:
    case NumericKnob::Unit::things:
      break;
  }
  return model::config::parse_count(text);
}

bool is_below(const NumericKnob& knob, std::string_view section) {
  return knob.key.starts_with(section);
}

std::vector<NumericKnob> select(const model::Scenario& scenario, auto&& wanted) {
  std::vector<NumericKnob> knobs = model::config::numeric_knobs(scenario);
  std::erase_if(knobs, [&](const NumericKnob& k) { return k.value == 0 || !wanted(k); });
  return knobs;
}

/// The step of a launch plan, as if it were a knob.
NumericKnob spread() {
  constexpr std::int64_t longest = 3'600'000'000'000;
  NumericKnob knob;
  knob.key = launch::plan_key;
  knob.unit = NumericKnob::Unit::nanoseconds;
  knob.maximum = longest;
  return knob;
}

std::string percent(const model::Ratio& ratio) { return fmt::format("{} %", 100 * ratio.value()); }

}  // namespace

model::Variation usual_variation() {
  model::Variation usual;
  usual.start_jitter = model::Nanoseconds{100'000'000};
  usual.loss = model::Ratio{1, 100};
  return usual;
}

Result<KnobRange> parse_knob_range(const std::string& text, const model::Scenario& scenario) {
  const auto wrong = [&](std::string message) {
    return InputError{"--vary " + text, std::move(message)};
  };
  const std::size_t equals = text.find('=');
  const std::size_t dots = text.find("..", equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos || equals == 0 || dots == std::string::npos) {
    return wrong("is not a range; expected KEY=LOW..HIGH");
  }
  const std::string key = text.substr(0, equals);
  std::vector<NumericKnob> knobs = model::config::numeric_knobs(scenario);
  if (launch::can_vary(scenario.deployment)) knobs.push_back(spread());
  auto knob = std::ranges::find(knobs, key, &NumericKnob::key);
  if (knob == knobs.end()) {
    std::vector<std::string> keys;
    for (const NumericKnob& known : knobs) keys.push_back(known.key);
    return wrong(fmt::format(
        "this scenario has no numeric knob '{}'{}; expected a key of the DDS or wireless profile, "
        "such as dds.sedp.heartbeat_period",
        key, model::config::suggestion(key, keys)));
  }
  KnobRange range{key, knob->unit, 0, 0};
  const std::string limits[] = {text.substr(equals + 1, dots - equals - 1), text.substr(dots + 2)};
  std::int64_t* const values[] = {&range.low, &range.high};
  for (std::size_t k = 0; k < 2; ++k) {
    const Parsed value = parse_value(knob->unit, limits[k]);
    if (!value) return wrong(value.error() + "; expected KEY=LOW..HIGH");
    if (*value < knob->minimum || *value > knob->maximum) {
      return wrong(fmt::format("'{}' is out of range; expected {} to {}", limits[k],
                               print_quantity(knob->unit, knob->minimum),
                               print_quantity(knob->unit, knob->maximum)));
    }
    *values[k] = *value;
  }
  if (range.low > range.high) {
    return wrong(fmt::format("'{}' is more than '{}'; expected LOW..HIGH", limits[0], limits[1]));
  }
  return range;
}

Ranges ranges_around(const model::Scenario& scenario, std::vector<KnobRange> knobs) {
  Ranges ranges;
  ranges.knobs = std::move(knobs);
  ranges.schedule = scenario.deployment.schedule.has_value();
  if (scenario.vary) ranges.vary = *scenario.vary;
  if (!scenario.vary && ranges.knobs.empty() && !ranges.schedule) {
    ranges.vary = usual_variation();
    ranges.usual = true;
  }
  return ranges;
}

std::vector<NumericKnob> size_knobs(const model::Scenario& scenario) {
  return select(scenario, [](const NumericKnob& knob) {
    const bool limit = knob.key == "dds.sedp.grouping_limit_bytes" ||
                       knob.key == "dds.sedp.piggyback_threshold_bytes";
    return knob.unit == NumericKnob::Unit::bytes && is_below(knob, "dds.") && !limit;
  });
}

std::vector<NumericKnob> delay_knobs(const model::Scenario& scenario) {
  return select(scenario, [](const NumericKnob& knob) {
    const bool time_or_rate = knob.unit == NumericKnob::Unit::nanoseconds ||
                              knob.unit == NumericKnob::Unit::bits_per_second;
    return time_or_rate && is_below(knob, "wireless.");
  });
}

std::vector<NumericKnob> timer_knobs(const model::Scenario& scenario) {
  return select(scenario, [](const NumericKnob& knob) {
    return knob.unit == NumericKnob::Unit::nanoseconds && is_below(knob, "dds.");
  });
}

std::vector<RangeText> describe(const Ranges& ranges, const model::Scenario& scenario) {
  using model::config::print_duration;
  std::vector<RangeText> lines;
  const model::Variation& vary = ranges.vary;
  if (ranges.schedule) {
    lines.push_back({"schedule", "starts and endpoints_done from deployment.schedule"});
  }
  if (vary.start_jitter) {
    lines.push_back({"start_jitter", fmt::format("each participant starts 0 to {} later",
                                                 print_duration(*vary.start_jitter))});
  }
  if (vary.loss) {
    lines.push_back(
        {"loss", fmt::format("each packet is lost with probability {}", percent(*vary.loss))});
  }
  const auto failures = [&](const char* name, const std::optional<std::uint32_t>& most,
                            const char* what) {
    if (!most) return;
    lines.push_back({name, fmt::format("0 to {} {} within {}", *most, what,
                                       print_duration(vary.time_of_failures()))});
  };
  failures("outages", vary.outages, "outages of one direction");
  failures("restarts", vary.restarts, "participants that stop and come back under their name");
  failures("late_joiners", vary.late_joiners, "participants that start later");
  failures("new_endpoints", vary.new_endpoints, "times somebody creates endpoints");
  const auto relative = [&](const char* name, const std::optional<model::Ratio>& ratio,
                            std::size_t knobs, const char* what) {
    if (!ratio) return;
    lines.push_back({name, knobs == 0
                               ? std::string{"nothing: this scenario has none"}
                               : fmt::format("{} {}, each ± {}", knobs, what, percent(*ratio))});
  };
  relative("sizes", vary.sizes, size_knobs(scenario).size(), "sizes of packets and their parts");
  relative("delays", vary.delays, delay_knobs(scenario).size(), "delays and rates of the network");
  relative("timers", vary.timers, timer_knobs(scenario).size(), "periods and delays of DDS");
  for (const KnobRange& knob : ranges.knobs) {
    const bool is_plan = knob.key == launch::plan_key;
    lines.push_back(
        {knob.key, fmt::format("{}{} to {}{}", is_plan ? "processes or hosts one by one, " : "",
                               print_quantity(knob.unit, knob.low),
                               print_quantity(knob.unit, knob.high), is_plan ? " apart" : "")});
  }
  return lines;
}

}  // namespace stormproof::fuzz
