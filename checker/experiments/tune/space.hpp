// What may be searched: the numeric knobs and switches of the model that a user of the vendor's
// library can change, and how far apart processes are started, within the ranges that the library
// and a sensible deployment allow. Values are rounded to two digits: nobody wants to read 3,981,072
// where 4,000,000 does the same, and a coarser space is searched sooner.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "checker/experiments/trials/launch_plan.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/vendor/vendor_knobs.hpp"
#include "model/scenario.hpp"

namespace stormproof::tune {

struct Dimension {
  std::string key;      ///< "dds.spdp.period"
  std::string setting;  ///< the vendor's element: "…/leaseAnnouncement"
  std::string note;     ///< how the element's value relates to the knob's; may be empty
  model::config::NumericKnob::Unit unit{};
  std::int64_t minimum = 0, maximum = 0;  ///< what is searched
  std::int64_t unchanged = 0;             ///< in the scenario; may be outside of what is searched
  bool is_switch = false;                 ///< 0 is "false", 1 "true"
  /// Of a launch plan, whose step in ns is the value; 0 is all at once.
  std::optional<launch::Order> order{};
  std::int64_t finest = 1;  ///< where a range in factors that begins at 0 begins above it

  /// Whether the search thinks of this knob in factors: the range spans two decades or more.
  [[nodiscard]] bool is_logarithmic() const;
  /// The value at `position`, from 0 (minimum) to 1 (maximum), rounded to two digits.
  [[nodiscard]] std::int64_t value_at(double position) const;
  /// The inverse, but for rounding; the nearest end for a value outside of the range.
  [[nodiscard]] double position_of(std::int64_t value) const;
  /// The plan that a value is; nothing if it is no dimension of plans.
  [[nodiscard]] std::optional<launch::Plan> plan(std::int64_t value) const;
  /// As a file would say it: "1.5ms", "true"; of a plan in words.
  [[nodiscard]] std::string print(std::int64_t value) const;
};

/// A knob that is not searched, and why.
struct Fixed {
  std::string key;
  std::string why;
};

/// A setting: one value for each dimension.
using Point = std::vector<std::int64_t>;

struct Space {
  std::vector<Dimension> dimensions;
  std::vector<Fixed> fixed;

  [[nodiscard]] Point unchanged() const;
  /// Numbers of the dimensions in which `point` differs from the unchanged setting.
  [[nodiscard]] std::vector<std::size_t> changes(const Point& point) const;
  /// The scenario with these settings, but for its launch plan, which is followed by runs.
  [[nodiscard]] model::Scenario apply(model::Scenario scenario, const Point& point) const;
  /// If it is not the unchanged one.
  [[nodiscard]] std::optional<launch::Plan> plan(const Point& point) const;
  /// The position of `key` ("dds.…"), or nothing.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view key) const;
};

/// The knobs of `scenario` that `knobs` let a user change.
[[nodiscard]] Space space_of(const model::Scenario& scenario,
                             std::span<const model::config::vendor::VendorKnob> knobs);
/// Has the launch plan of `scenario` vary as well, by process or as the deployed one. What cannot
/// be, or is not known enough, is among what is fixed.
void add_launch_plan(const model::Scenario& scenario, Space& space);

}  // namespace stormproof::tune
