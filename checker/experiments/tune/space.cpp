// The join of two tables: the numeric knobs and switches of the scenario, and the vendor's.
#include "checker/experiments/tune/space.hpp"

#include <algorithm>
#include <cmath>

#include "checker/experiments/trials/usual_hosts.hpp"
#include "model/config/knobs/other_choices.hpp"

namespace stormproof::tune {

namespace {

using model::config::NumericKnob;
using model::config::OtherChoices;
using model::config::vendor::VendorKnob;

/// `value` with two digits that count.
std::int64_t rounded(double value) {
  const double size = std::max(std::abs(value), 1.0);
  const double unit = std::max(1.0, std::pow(10.0, std::floor(std::log10(size)) - 1));
  return std::llround(std::round(value / unit) * unit);
}

/// Log scale of a range that may begin at 0.
double lowest(const Dimension& dimension) {
  return static_cast<double>(std::max(dimension.finest, dimension.minimum));
}

constexpr std::string_view off = "false";
constexpr std::string_view on = "true";

/// It can be switched off. What is off in a preset the library's version does not have.
bool is_switched_on(const OtherChoices& choice) { return choice.value == on; }

/// The profile with the switch `key` turned, if there is one.
model::DdsProfile turned(const model::DdsProfile& dds, const std::string& key) {
  const std::vector<OtherChoices> choices = model::config::other_choices(dds);
  const auto found = std::ranges::find(choices, key, &OtherChoices::key);
  return found == choices.end() ? dds : found->others.front();
}

/// What is searched of a knob that the vendor's library has; nothing if it is a word that is no
/// switch, or a switch that is off.
std::optional<Dimension> dimension_of(const std::string& key, const VendorKnob& knob,
                                      std::span<const NumericKnob> numbers,
                                      std::span<const OtherChoices> choices) {
  Dimension dimension;
  dimension.key = key;
  dimension.setting = knob.setting;
  dimension.note = knob.why;
  if (const auto number = std::ranges::find(numbers, key, &NumericKnob::key);
      number != numbers.end()) {
    dimension.unit = number->unit;
    dimension.minimum = std::max(knob.minimum, number->minimum);
    dimension.maximum = std::min(knob.maximum, number->maximum);
    dimension.unchanged = number->value;
    return dimension;
  }
  const auto choice = std::ranges::find(choices, key, &OtherChoices::key);
  if (choice == choices.end() || !is_switched_on(*choice)) return std::nullopt;
  dimension.unit = NumericKnob::Unit::things;
  dimension.maximum = 1;
  dimension.unchanged = 1;
  dimension.is_switch = true;
  return dimension;
}

}  // namespace

bool Dimension::is_logarithmic() const {
  return static_cast<double>(maximum) >= 100 * lowest(*this);
}

std::int64_t Dimension::value_at(double position) const {
  const double from = static_cast<double>(minimum);
  const double to = static_cast<double>(maximum);
  const double where = std::clamp(position, 0.0, 1.0);
  if (where == 0) return minimum;
  const double value = is_logarithmic() ? lowest(*this) * std::pow(to / lowest(*this), where)
                                        : from + where * (to - from);
  return std::clamp(rounded(value), minimum, maximum);
}

double Dimension::position_of(std::int64_t value) const {
  if (maximum <= minimum || value <= minimum) return 0;
  if (value >= maximum) return 1;
  const double from = static_cast<double>(minimum);
  const double to = static_cast<double>(maximum);
  const double at = static_cast<double>(value);
  return is_logarithmic()
             ? std::max(0.0, std::log(at / lowest(*this)) / std::log(to / lowest(*this)))
             : (at - from) / (to - from);
}

std::string Dimension::print(std::int64_t value) const {
  if (is_switch) return std::string{value == 0 ? off : on};
  if (const auto one = plan(value)) return launch::words_of(*one);
  return model::config::print_quantity(unit, value);
}

std::optional<launch::Plan> Dimension::plan(std::int64_t value) const {
  if (!order) return std::nullopt;
  if (value == 0) return launch::Plan{launch::Order::at_once};
  return launch::Plan{*order, model::Nanoseconds{value}};
}

Point Space::unchanged() const {
  Point point;
  for (const Dimension& dimension : dimensions) point.push_back(dimension.unchanged);
  return point;
}

std::vector<std::size_t> Space::changes(const Point& point) const {
  std::vector<std::size_t> changed;
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    if (point[d] != dimensions[d].unchanged) changed.push_back(d);
  }
  return changed;
}

model::Scenario Space::apply(model::Scenario scenario, const Point& point) const {
  for (const std::size_t d : changes(point)) {
    if (dimensions[d].order) continue;
    if (dimensions[d].is_switch) {
      scenario.dds = turned(scenario.dds, dimensions[d].key);
      continue;
    }
    // In range by construction: `space_of` intersects both tables' ranges.
    static_cast<void>(model::config::set_numeric_knob(scenario, dimensions[d].key, point[d]));
  }
  return scenario;
}

std::optional<launch::Plan> Space::plan(const Point& point) const {
  for (const std::size_t d : changes(point)) {
    if (dimensions[d].order) return dimensions[d].plan(point[d]);
  }
  return std::nullopt;
}

std::optional<std::size_t> Space::find(std::string_view key) const {
  const auto found = std::ranges::find(dimensions, key, &Dimension::key);
  if (found == dimensions.end()) return std::nullopt;
  return static_cast<std::size_t>(found - dimensions.begin());
}

Space space_of(const model::Scenario& scenario, std::span<const VendorKnob> knobs) {
  const std::vector<NumericKnob> numbers = model::config::numeric_knobs(scenario);
  const std::vector<OtherChoices> choices = model::config::other_choices(scenario.dds);
  Space space;
  for (const VendorKnob& knob : knobs) {
    const std::string key = "dds." + std::string{knob.key};
    if (knob.setting.empty()) {
      space.fixed.push_back({key, std::string{knob.why}});
      continue;
    }
    std::optional<Dimension> dimension = dimension_of(key, knob, numbers, choices);
    if (!dimension) {
      space.fixed.push_back({key, "no number or switch in this profile; only these are searched"});
    } else if (dimension->minimum < dimension->maximum) {
      space.dimensions.push_back(*std::move(dimension));
    } else {
      space.fixed.push_back({key, "only one value is possible"});
    }
  }
  return space;
}

void add_launch_plan(const model::Scenario& scenario, Space& space) {
  constexpr std::int64_t finest = 1'000'000;
  constexpr std::int64_t longest = 2'000'000'000;
  const std::string key{launch::plan_key};
  const model::Deployment& deployment = scenario.deployment;
  if (!launch::can_vary(deployment)) {
    space.fixed.push_back({key, "a plan is about first starts, of several"});
    return;
  }
  if (trials::lacks_hosts(scenario)) {
    space.fixed.push_back(
        {key, "what spread starts cost depends on processors; say hosts, such as " +
                  std::string{trials::usual_hosts}});
    return;
  }
  const launch::Plan plan = launch::plan_of(deployment);
  if (plan.order == launch::Order::deployed) {
    space.fixed.push_back({key, "the starts of the scenario follow no plan"});
    return;
  }
  Dimension dimension;
  dimension.key = key;
  dimension.setting = "launch plan";
  dimension.unit = NumericKnob::Unit::nanoseconds;
  dimension.order = plan.order == launch::Order::at_once ? launch::Order::by_process : plan.order;
  dimension.finest = finest;
  dimension.unchanged = plan.step.count();
  const auto last =
      std::max<std::int64_t>(1, launch::starts_of(deployment, *dimension.order).back());
  dimension.maximum = std::min(longest, scenario.time_limit.count() / (2 * last));
  space.dimensions.push_back(std::move(dimension));
}

}  // namespace stormproof::tune
