// What the author of a scenario demands of it, beyond the properties of the catalogue: `limits:`
// says what discovery may cost, `vary:` by how much reality may differ from the file. `simulate`
// and `check` take the scenario as it is; `stormproof fuzz` looks for a run within the ranges that
// breaks a limit or a property.
#pragma once

#include <cstdint>
#include <optional>

#include "model/units.hpp"

namespace stormproof::model {

/// A positive fraction in lowest terms.
struct Ratio {
  std::int64_t numerator = 1;
  std::int64_t denominator = 1;

  [[nodiscard]] double value() const {
    return static_cast<double>(numerator) / static_cast<double>(denominator);
  }
  bool operator==(const Ratio&) const = default;
};

/// Upper limits of one run; an absent one limits nothing.
struct Limits {
  std::optional<Nanoseconds> completion;  ///< discovery is complete at this time
  std::optional<std::uint64_t> messages;  ///< of all six classes, until completion
  std::optional<Ratio> amplification;     ///< messages over those of the failure-free reference
  std::optional<std::uint64_t>
      backlog;  ///< packets that wait for the source queue of one participant
  // What a storm is (checker/engines/exact/storm.hpp); nothing else is judged by these two.
  std::optional<Ratio> needless = {};    ///< needless traffic over everything sent once
  std::optional<Nanoseconds> late = {};  ///< time that discovery takes from the last start on

  [[nodiscard]] bool any() const { return completion || messages || amplification || backlog; }
  bool operator==(const Limits&) const = default;
};

/// Ranges around a scenario. Relative ranges scale each value by an independent factor between
/// 1 - r and 1 + r.
struct Variation {
  std::optional<Nanoseconds> start_jitter;  ///< each participant starts up to this much later
  std::optional<Ratio> loss;    ///< at most 1: each packet is lost with this probability
  std::optional<Ratio> sizes;   ///< at most 1: of packets and their parts
  std::optional<Ratio> delays;  ///< at most 1: of airtime overheads, rates and constant delays
  std::optional<Ratio> timers;  ///< at most 1: of the periods and delays of the DDS profile
  // Of the life of participants; all of it happens before `failures_within`.
  std::optional<std::uint32_t> outages;             ///< at most so many, each in one direction
  std::optional<std::uint32_t> restarts;            ///< at most so many participants come back
  std::optional<std::uint32_t> late_joiners;        ///< at most so many participants start later
  std::optional<std::uint32_t> new_endpoints = {};  ///< at most so many times some are created
  std::optional<Nanoseconds> failures_within;
  /// `failures_within`, or what is usual.
  [[nodiscard]] Nanoseconds time_of_failures() const {
    return failures_within.value_or(Nanoseconds{10'000'000'000});
  }

  bool operator==(const Variation&) const = default;
};

}  // namespace stormproof::model
