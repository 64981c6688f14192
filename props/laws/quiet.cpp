// Laws of a quiet network: a constant delay d that is short against all timers, everybody there at
// 0. What happens then can be said in advance:
//   * announcements arrive at d, DATA and HEARTBEATs at 2d, ACKNACKs leave τ_A later: the
//     failure-free reference (the paper's eq. 4), without repairs, and then silence;
//   * if one DATA packet is lost, its descriptors, and only those, are repaired, once. In the
//     paper's model the repair arrives at 4d + τ_A + τ_N, the next periodic HEARTBEAT fetches the
//     missing acknowledgment, and then there is silence;
//   * if the repair is lost, too, the next periodic HEARTBEAT, τ_H after the first, brings another.
#include <algorithm>

#include <fmt/core.h>

#include "model/reference.hpp"
#include "props/laws/families.hpp"
#include "props/laws/run_log.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;
using model::Packet;
using model::PacketKind;
using model::Participant;
using model::Scenario;
using Broken = std::optional<std::string>;

Nanoseconds least_timer(const Scenario& scenario) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  const model::SpdpProfile& spdp = scenario.dds.spdp;
  Nanoseconds least = std::min({sedp.heartbeat_period, spdp.period, spdp.startup_period});
  if (sedp.initial_acknack_delay > Nanoseconds{0}) {
    least = std::min(least, sedp.initial_acknack_delay);
  }
  if (sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive) {
    least = std::min(least, sedp.adaptive.min_period);
  }
  return least;
}

/// The scenario in a quiet network, until before the first timer expires.
Scenario quiet(Scenario scenario) {
  model::SedpProfile& sedp = scenario.dds.sedp;
  for (Participant& p : scenario.deployment.participants) {
    p.start = Nanoseconds{0};
    p.endpoints_done = Nanoseconds{0};
  }
  scenario.deployment.types.reset();  // to look them up takes longer
  scenario.dds.spdp.resend = model::SpdpResend::all_known;
  sedp.relation_opening = model::RelationOpening::receiver;
  sedp.initial_data = model::InitialData::push;
  sedp.piggyback = model::Piggyback::off;
  const Nanoseconds delay{std::max<std::int64_t>(1, least_timer(scenario).count() / 16)};
  sedp.heartbeat_response_delay = std::min(sedp.heartbeat_response_delay, delay);
  sedp.nack_response_delay = std::min(sedp.nack_response_delay, delay);
  sedp.nack_suppression_duration = std::min(sedp.nack_suppression_duration, delay);
  if (sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive) {
    // A cycle that cannot stretch its period asks silent readers at its end, and the next one asks
    // them again 1 ns later. Without suppression both answers bring a repair.
    sedp.nack_suppression_duration = std::max(sedp.nack_suppression_duration, Nanoseconds{2});
  }
  if (traits_of(scenario).discovers_same_host) scenario.deployment.loopback_delay = delay;
  scenario.wireless = {};
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = delay;
  scenario.time_limit = delay * 7;
  scenario.run_until = model::RunUntil::time_limit;
  return scenario;
}

/// Timers that leave room for a delay.
bool can_be_quiet(const Scenario& scenario) {
  if (!is_of_two_writers(scenario)) return false;
  const Scenario candidate = quiet(scenario);
  return least_timer(candidate) > candidate.time_limit;
}

Broken failure_free(const Scenario& scenario, const Simulate& simulate) {
  const Scenario candidate = quiet(scenario);
  const model::RunResult result = simulate(candidate, nullptr);
  if (was_cut_off(result)) return std::nullopt;
  if (!result.completed()) {
    return fmt::format("With a delay of {} and without losses {} descriptors are missing.",
                       time_text(candidate.wireless.one_way), result.missing_count);
  }
  model::Counts expected = failure_free_reference(candidate);
  // How many copies cross hosts depends on the order of recognitions; the reference has the
  // average.
  if (traits_of(candidate).discovers_same_host) expected.spdp_unicast = result.counts.spdp_unicast;
  for (std::size_t k = 0; k < expected.entries().size(); ++k) {
    const auto [name, value] = expected.entries()[k];
    const std::uint64_t found = result.counts.entries()[k].value;
    if (found != value) return fmt::format("{} should be {} and is {}.", name, value, found);
  }
  return std::nullopt;
}

/// The first DATA packet, the first repair, the last HEARTBEAT or ACKNACK, and the last expiry of a
/// timer for them.
class SedpWatch final : public model::Probe {
 public:
  void event_started(const model::Event& event) override {
    now_ = event.time;
    if (event.kind == model::EventKind::heartbeat_expiry ||
        event.kind == model::EventKind::cycle_start) {
      last_ = now_;
    }
  }
  void emitted(const Packet& packet, std::uint32_t, std::span<const std::uint32_t>) override {
    if (packet.kind == PacketKind::data && !first_data_) {
      first_data_ = packet.number;
      descriptors_ = packet.descriptors.count();
    }
    if (packet.kind == PacketKind::data && !packet.carries_initial && !first_repair_) {
      first_repair_ = packet.number;
    }
    if (packet.kind == PacketKind::heartbeat || packet.kind == PacketKind::acknack) last_ = now_;
  }
  [[nodiscard]] const std::optional<std::uint64_t>& first_data() const { return first_data_; }
  [[nodiscard]] const std::optional<std::uint64_t>& first_repair() const { return first_repair_; }
  [[nodiscard]] std::uint64_t descriptors() const { return descriptors_; }
  [[nodiscard]] Nanoseconds last() const { return last_; }

 private:
  Nanoseconds now_;
  std::optional<std::uint64_t> first_data_;
  std::optional<std::uint64_t> first_repair_;
  std::uint64_t descriptors_ = 0;
  Nanoseconds last_;
};

/// The longest time between two HEARTBEATs of a writer.
Nanoseconds longest_period(const model::SedpProfile& sedp) {
  if (sedp.heartbeat_policy == model::HeartbeatPolicy::periodic) return sedp.heartbeat_period;
  return std::max(sedp.heartbeat_period, sedp.adaptive.max_period) + Nanoseconds{1};
}

/// The timers that would go on announcing are out of the way.
Scenario long_and_quiet(const Scenario& scenario) {
  Scenario candidate = quiet(scenario);
  candidate.time_limit = longest_period(candidate.dds.sedp) * 6;
  candidate.dds.spdp.startup_announcements = 0;
  candidate.dds.spdp.period = candidate.time_limit * 2;
  return candidate;
}

Broken silence(const Scenario& candidate, const model::RunResult& result, const SedpWatch& watch) {
  if (was_cut_off(result)) return "The run does not come to an end.";
  if (!result.completed()) {
    return fmt::format("At the end {} descriptors are missing.", result.missing_count);
  }
  // Each loss takes a period more to be repaired (Fast DDS: the first one, too); then come an
  // expiry that fetches the acknowledgment and one that finds nobody to ask.
  const auto losses = static_cast<std::int64_t>(candidate.wireless.lost_packets.size());
  const Nanoseconds bound = longest_period(candidate.dds.sedp) * (losses + 3);
  if (watch.last() <= bound) return std::nullopt;
  return fmt::format("Everything is there at {}, but HEARTBEATs go on until {} at least.",
                     time_text(*result.discovery_time), time_text(watch.last()));
}

Broken silence_without_loss(const Scenario& scenario, const Simulate& simulate) {
  const Scenario candidate = long_and_quiet(scenario);
  SedpWatch watch;
  const model::RunResult result = simulate(candidate, &watch);
  return silence(candidate, result, watch);
}

/// How many HEARTBEATs the acknowledgment of a repair takes in the paper's model.
std::uint64_t repeated_heartbeats(const Scenario& scenario) {
  const auto& list = scenario.deployment.participants;
  const model::SedpProfile& sedp = scenario.dds.sedp;
  const bool to_all = sedp.heartbeat_policy == model::HeartbeatPolicy::periodic &&
                      sedp.heartbeat_recipients == model::HeartbeatRecipients::matched;
  if (!to_all) return 1;
  // The first DATA packet is one of the first participant that anybody recognises.
  return static_cast<std::uint64_t>(std::ranges::count_if(
      list, [&](const Participant& p) { return p.host != list.front().host; }));
}

Broken single_loss(const Scenario& scenario, const Simulate& simulate) {
  Scenario candidate = long_and_quiet(scenario);
  SedpWatch first;
  static_cast<void>(simulate(candidate, &first));
  if (!first.first_data()) return "No DATA is sent.";
  candidate.wireless.lost_packets = {*first.first_data()};
  SedpWatch watch;
  const model::RunResult result = simulate(candidate, &watch);
  if (Broken noise = silence(candidate, result, watch)) return noise;
  if (result.counts.repair_data != first.descriptors()) {
    return fmt::format("A lost packet had {} descriptors, but {} are repaired.",
                       first.descriptors(), result.counts.repair_data);
  }
  if (is_stateful(candidate)) return std::nullopt;
  const model::SedpProfile& sedp = candidate.dds.sedp;
  const Nanoseconds expected =
      candidate.wireless.one_way * 4 + sedp.heartbeat_response_delay + sedp.nack_response_delay;
  if (*result.discovery_time != expected) {
    return fmt::format("The repair should arrive at {} and discovery takes {}.",
                       time_text(expected), time_text(*result.discovery_time));
  }
  const std::uint64_t heartbeats =
      failure_free_reference(candidate).heartbeat + repeated_heartbeats(candidate);
  if (result.counts.heartbeat == heartbeats && result.counts.acknack == heartbeats) {
    return std::nullopt;
  }
  return fmt::format("{} HEARTBEATs and as many ACKNACKs are due, but {} and {} are sent.",
                     heartbeats, result.counts.heartbeat, result.counts.acknack);
}

Broken double_loss(const Scenario& scenario, const Simulate& simulate) {
  Scenario candidate = long_and_quiet(scenario);
  std::vector<std::uint64_t>& lost = candidate.wireless.lost_packets;
  SedpWatch first;
  static_cast<void>(simulate(candidate, &first));
  if (!first.first_data()) return "No DATA is sent.";
  lost.push_back(*first.first_data());
  SedpWatch second;
  static_cast<void>(simulate(candidate, &second));
  if (!second.first_repair()) return "A lost packet is not repaired.";
  lost.push_back(*second.first_repair());
  SedpWatch watch;
  const model::RunResult result = simulate(candidate, &watch);
  if (Broken noise = silence(candidate, result, watch)) return noise;
  const model::SedpProfile& sedp = candidate.dds.sedp;
  const bool adaptive = sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive;
  const bool stateful = is_stateful(candidate);
  if (stateful && adaptive) return std::nullopt;  // it may ask twice for one repair
  if (result.counts.repair_data != 2 * first.descriptors()) {
    return fmt::format("A packet with {} descriptors was lost twice, but {} are repaired.",
                       first.descriptors(), result.counts.repair_data);
  }
  if (stateful) return std::nullopt;
  const Nanoseconds expected = candidate.wireless.one_way * 4 + sedp.heartbeat_period +
                               sedp.heartbeat_response_delay + sedp.nack_response_delay;
  if (*result.discovery_time == expected) return std::nullopt;
  return fmt::format("The second repair should arrive at {} and discovery takes {}.",
                     time_text(expected), time_text(*result.discovery_time));
}

constexpr Law quiet_list[] = {
    {"law.failure-free",
     "With a short constant delay, everybody there at 0 and nothing lost, the messages are those "
     "of the failure-free reference (eq. 4), without repairs.",
     can_be_quiet, failure_free},
    {"law.silence", "In such a network HEARTBEATs and ACKNACKs come to an end.", can_be_quiet,
     silence_without_loss},
    {"law.single-loss",
     "In such a network a lost DATA packet costs one repair of each of its descriptors, at the "
     "time that the timers say, and one more round of HEARTBEAT and ACKNACK.",
     can_be_quiet, single_loss},
    {"law.double-loss",
     "If the repair is lost, too, the next periodic HEARTBEAT brings another one, and nothing else "
     "is repaired (Fast DDS: with periodic HEARTBEATs).",
     can_be_quiet, double_loss},
};

}  // namespace

std::span<const Law> quiet_laws() { return quiet_list; }

}  // namespace stormproof::props
