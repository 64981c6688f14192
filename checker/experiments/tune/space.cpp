// The join of two tables: the numeric knobs of the scenario, and the vendor's.
#include "checker/experiments/tune/space.hpp"

#include <algorithm>
#include <cmath>

namespace stormproof::tune {

namespace {

using model::config::NumericKnob;

/// `value` with two digits that count.
std::int64_t rounded(double value) {
  const double size = std::max(std::abs(value), 1.0);
  const double unit = std::max(1.0, std::pow(10.0, std::floor(std::log10(size)) - 1));
  return std::llround(std::round(value / unit) * unit);
}

/// Log scale of a range that may begin at 0: the least step above 0 is 1.
double lowest(std::int64_t minimum) { return std::max(1.0, static_cast<double>(minimum)); }

}  // namespace

bool Dimension::is_logarithmic() const {
  return static_cast<double>(maximum) >= 100 * lowest(minimum);
}

std::int64_t Dimension::value_at(double position) const {
  const double from = static_cast<double>(minimum);
  const double to = static_cast<double>(maximum);
  const double where = std::clamp(position, 0.0, 1.0);
  if (where == 0) return minimum;
  const double value = is_logarithmic() ? lowest(minimum) * std::pow(to / lowest(minimum), where)
                                        : from + where * (to - from);
  return std::clamp(rounded(value), minimum, maximum);
}

double Dimension::position_of(std::int64_t value) const {
  if (maximum <= minimum || value <= minimum) return 0;
  if (value >= maximum) return 1;
  const double from = static_cast<double>(minimum);
  const double to = static_cast<double>(maximum);
  const double at = static_cast<double>(value);
  return is_logarithmic() ? std::log(at / lowest(minimum)) / std::log(to / lowest(minimum))
                          : (at - from) / (to - from);
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
    // In range by construction: `space_of` intersects both tables' ranges.
    static_cast<void>(model::config::set_numeric_knob(scenario, dimensions[d].key, point[d]));
  }
  return scenario;
}

std::optional<std::size_t> Space::find(std::string_view key) const {
  const auto found = std::ranges::find(dimensions, key, &Dimension::key);
  if (found == dimensions.end()) return std::nullopt;
  return static_cast<std::size_t>(found - dimensions.begin());
}

Space space_of(const model::Scenario& scenario,
               std::span<const model::config::vendor::VendorKnob> knobs) {
  const std::vector<NumericKnob> numeric = model::config::numeric_knobs(scenario);
  Space space;
  for (const auto& knob : knobs) {
    const std::string key = "dds." + std::string{knob.key};
    if (knob.setting.empty()) {
      space.fixed.push_back({key, std::string{knob.why}});
      continue;
    }
    const auto found = std::ranges::find(numeric, key, &NumericKnob::key);
    if (found == numeric.end()) {
      space.fixed.push_back({key, "not a number in this profile; only numbers are searched"});
      continue;
    }
    Dimension dimension{key,
                        std::string{knob.setting},
                        std::string{knob.why},
                        found->unit,
                        std::max(knob.minimum, found->minimum),
                        std::min(knob.maximum, found->maximum),
                        found->value};
    if (dimension.minimum < dimension.maximum) {
      space.dimensions.push_back(std::move(dimension));
    } else {
      space.fixed.push_back({key, "only one value is possible"});
    }
  }
  return space;
}

}  // namespace stormproof::tune
