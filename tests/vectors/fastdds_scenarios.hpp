// What the scenarios of the vectors of `implementation: fastdds` have in common: two hosts, whose
// participants start one after the other, and the rules of a version.
#pragma once

#include <cstdint>

#include "tests/vectors/staggered.hpp"

namespace stormproof::vectors {

[[nodiscard]] inline model::Scenario grid(std::uint32_t participants, std::uint32_t endpoints) {
  constexpr std::uint32_t hosts = 2;
  constexpr std::int64_t creation_ns = 500'000;
  model::Scenario scenario = staggered(hosts, participants, endpoints, creation_ns);
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  return scenario;
}

inline void new_only(model::Scenario& s) { s.dds.spdp.resend = model::SpdpResend::new_only; }

/// The timers and resends of that version.
inline void version_2_14_5(model::Scenario& s) {
  constexpr std::int64_t ms = 1'000'000;
  new_only(s);
  s.dds.sedp.nack_response_delay = model::Nanoseconds{100 * ms};
  s.dds.sedp.nack_suppression_duration = model::Nanoseconds{10 * ms};
  s.dds.sedp.heartbeat_response_delay = model::Nanoseconds{10 * ms};
}

inline void version_3_2_5(model::Scenario& s) {
  version_2_14_5(s);
  s.dds.version = {.match_order = model::MatchOrder::builtin_first,
                   .builtin_response_delay = model::Nanoseconds{11'000'000},
                   .sizes = model::SizesSince::v3_2,
                   .type_lookup = model::Whether::yes,
                   .statistics_bytes = model::Bytes{60},
                   .max_data_per_message = 31};
}

inline void version_3_6_2(model::Scenario& s) {
  version_3_2_5(s);
  s.dds.version.sizes = model::SizesSince::v3_6;
  s.dds.sedp.piggyback = model::Piggyback::group;
}

inline void done_at_once(model::Scenario& s) {
  for (model::Participant& p : s.deployment.participants) p.endpoints_done = p.start;
}

}  // namespace stormproof::vectors
