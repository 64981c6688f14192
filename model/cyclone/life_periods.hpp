// Periods of Cyclone DDS that follow from a lease: how often a participant announces itself, and
// says that it is alive.
// Source: specs/guide/cyclone-life.md, "Periods"; q_xevent.c,
// handle_xevk_spdp; ddsi_spdp_schedule.c, spdp_intv.
#pragma once

#include <algorithm>

#include "model/implementations.hpp"
#include "model/life.hpp"
#include "model/scenario.hpp"

namespace stormproof::model::cyclone {

/// SPDPInterval, if nobody says another one.
inline constexpr Nanoseconds usual_interval{30'000'000'000};

/// What a lease leaves between two signs of life: 2 s less, of short ones 4/5.
[[nodiscard]] inline Nanoseconds base_period(Nanoseconds lease) {
  constexpr Nanoseconds long_lease{10'000'000'000};
  constexpr Nanoseconds margin{2'000'000'000};
  return lease < long_lease ? Nanoseconds{4 * lease.count() / 5} : lease - margin;
}

/// SPDPInterval, if the profile's period is not what its lease comes to without one.
[[nodiscard]] inline std::optional<Nanoseconds> said_interval(const DdsProfile& dds) {
  const Nanoseconds without = std::min(base_period(lease_of(dds)), usual_interval);
  if (dds.spdp.period == without) return {};
  return dds.spdp.period;
}

/// Whether addresses at which nobody is known are announced to rarely, and dropped: 11.0 does that.
[[nodiscard]] inline bool prunes(const DdsProfile& dds) {
  return dds.spdp.initial_prune_delay.has_value() || dds.spdp.discovered_prune_delay.has_value();
}

/// Between two announcements of a participant with the lease.
[[nodiscard]] inline Nanoseconds announcing_period(const DdsProfile& dds, Nanoseconds lease) {
  if (lease == lease_of(dds)) return dds.spdp.period;
  const std::optional<Nanoseconds> said = said_interval(dds);
  if (said && prunes(dds)) return *said;
  return std::min(base_period(lease), said.value_or(usual_interval));
}

/// Announcements to somebody who is recognised.
[[nodiscard]] inline std::int64_t replies_due(const DdsProfile& dds, Nanoseconds lease) {
  constexpr Nanoseconds second{1'000'000'000};
  const bool is_hasty = lease < second || said_interval(dds).value_or(second) < second;
  return is_hasty ? std::min(1U, dds.spdp.directed_replies) : dds.spdp.directed_replies;
}

/// A pre-emptive ACKNACK is repeated after that, by the age of the reader side.
[[nodiscard]] inline std::int64_t preemptive_interval(std::int64_t age) {
  constexpr std::int64_t second = 1'000'000'000;
  if (age < 10 * second) return second;
  if (age < 60 * second) return 2 * second;
  return age < 120 * second ? 5 * second : 10 * second;
}

}  // namespace stormproof::model::cyclone
