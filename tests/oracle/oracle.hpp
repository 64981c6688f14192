// The oracle: a second, deliberately naive simulator of the rules in specs/guide/model.md. It
// exists to be compared with the product on any scenario, so it shares nothing with it but the
// plain input structs: one sorted map of events, one switch, and standard containers everywhere. It
// is slow, and it is easy to read.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "model/scenario.hpp"
#include "tests/oracle/mistake.hpp"

namespace stormproof::oracle {

/// A descriptor of `source` that `destination` had not received when the run ended.
struct Missing {
  std::uint32_t source = 0;
  std::uint32_t destination = 0;
  model::Stream stream = model::Stream::pub;
  std::uint32_t descriptor = 0;

  bool operator==(const Missing&) const = default;
};

struct Outcome {
  bool completed = false;       ///< discovery was completed, whatever ended the run
  std::int64_t t_disc_ns = -1;  ///< −1 if the run did not complete
  std::int64_t initial_data = 0;
  std::int64_t repair_data = 0;
  std::int64_t heartbeat = 0;
  std::int64_t acknack = 0;
  std::int64_t spdp_multicast = 0;
  std::int64_t spdp_unicast = 0;
  std::uint64_t events = 0;      ///< processed events, the completing one included
  std::uint64_t packets = 0;     ///< emitted packets
  std::uint64_t piggybacks = 0;  ///< how often the piggyback budget of a writer was exhausted
  std::vector<Missing> missing;  ///< ascending; empty if the run completed

  [[nodiscard]] std::int64_t total() const {
    return initial_data + repair_data + heartbeat + acknack + spdp_multicast + spdp_unicast;
  }
};

/// One processed event. Participants and stream are −1 where the event has none.
struct LogEntry {
  std::int64_t time_ns = 0;
  int event_class = 0;  ///< 0 service, 1 protocol, 2 dispatch
  std::uint64_t insertion = 0;
  const char* kind = "";
  std::int64_t source = -1;
  std::int64_t destination = -1;
  int stream = -1;
};

/// Called for each event just before it is processed.
using EventLog = std::function<void(const LogEntry&)>;

/// Runs the scenario to completion (unless it says `run_until: time_limit`), to its time limit, or
/// until nothing is left to do; with a deliberate mistake, if there is one. Ends after `max_events`
/// events at the latest (0: no limit): a mistake may have no end.
/// Throws std::invalid_argument if the deployment has no cross-host pair.
[[nodiscard]] Outcome run(const model::Scenario& scenario, const EventLog& log = {},
                          Mistake mistake = Mistake::none, std::uint64_t max_events = 0);

/// With a participant more for each that comes back as somebody new.
[[nodiscard]] model::Scenario with_those_who_come_back_as_others(model::Scenario scenario);

/// The airtime of everything a loss-free discovery has to send once, summed over all stages.
[[nodiscard]] std::int64_t open_loop_ns(const model::Scenario& scenario);

}  // namespace stormproof::oracle
