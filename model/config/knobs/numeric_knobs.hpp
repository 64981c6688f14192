// The knobs of a scenario that are one number, by key: for whoever changes one knob at a time
// (fuzzing, sensitivity, tuning, the smallest difference of two profiles).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/config/tree/result.hpp"
#include "model/scenario.hpp"

namespace stormproof::model::config {

/// One numeric knob of a scenario, with the value that it has there.
struct NumericKnob {
  enum class Unit : std::uint8_t { nanoseconds, bits_per_second, bytes, things };

  std::string key;  ///< as `--set` takes it: "dds.sedp.heartbeat_period", "wireless.stages.0.…"
  Unit unit{};
  std::int64_t value = 0;  ///< in ns, bit/s, bytes or things
  std::int64_t minimum = 0, maximum = 0;
  std::string doc;
};

/// All numeric knobs of DDS and wireless profile that are present and that the scenario's
/// implementation has, in the order of the tables. Deployment, lists of packets, limits and ranges
/// are left out; so are words that stand for a number (`source_queue_bytes: unlimited`).
[[nodiscard]] std::vector<NumericKnob> numeric_knobs(const Scenario& scenario);

/// The value of the numeric knob `key` of a DDS profile ("spdp.period"), in ns, bytes or things;
/// nothing if the profile has no such knob, or it is not numeric.
[[nodiscard]] std::optional<std::int64_t> numeric_knob(const DdsProfile& dds, std::string_view key);

/// Sets the knob `key` of `numeric_knobs(scenario)`; false if there is none or `value` is out of
/// its range. Rules between knobs are not checked; see `is_valid`.
[[nodiscard]] bool set_numeric_knob(Scenario& scenario, std::string_view key, std::int64_t value);

/// Whether `read_scenario` would accept the scenario, were it written to a file.
[[nodiscard]] bool is_valid(const Scenario& scenario);

/// `value` as a file would say it: "1.5ms", "144.4Mbps", "1480".
[[nodiscard]] std::string print_quantity(NumericKnob::Unit unit, std::int64_t value);

}  // namespace stormproof::model::config
