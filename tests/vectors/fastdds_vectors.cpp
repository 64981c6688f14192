// The table of the test vectors of `implementation: fastdds`. Two hosts and one channel for all of
// them; they differ in size, in when participants start and are done, and in a few knobs.
#include "tests/vectors/fastdds_vectors.hpp"

#include <utility>

namespace stormproof::vectors {

namespace {

using model::Bytes;
using model::Nanoseconds;
using model::Scenario;

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000'000;
constexpr std::uint32_t hosts = 2;
constexpr std::int64_t default_endpoints = 17;

void fill_wireless(model::WirelessProfile& w) {
  w.overhead_unicast = Nanoseconds{150 * us};
  w.overhead_multicast = Nanoseconds{150 * us};
  w.rate_unicast = model::BitsPerSecond{144'400'000};
  w.rate_multicast = model::BitsPerSecond{6'000'000};
  w.link_overhead_bytes = Bytes{14};
  w.source_queue_bytes = model::WirelessProfile::unlimited;
  w.order = model::ServiceOrder::fifo;
  w.fragment_request = model::FragmentRequest::at_admission;
}

// Participants start one after the other, the hosts in turn, and need longer the more there are.
Scenario grid(std::uint32_t participants, std::uint32_t endpoints) {
  Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(hosts, participants, endpoints);
  const std::int64_t creation = participants * (default_endpoints + endpoints) * 500 * us;
  for (std::uint32_t i = 0; i < scenario.deployment.size(); ++i) {
    model::Participant& p = scenario.deployment.participants.at(i);
    const std::int64_t rank = std::int64_t{hosts} * (i % participants) + p.host.value;
    p.start = Nanoseconds{3 * ms + 2 * ms * rank};
    p.endpoints_done = Nanoseconds{p.start.count() + creation};
  }
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  fill_wireless(scenario.wireless);
  return scenario;
}

template <class Change>
Scenario with(Scenario scenario, Change change) {
  change(scenario);
  return scenario;
}

void new_only(Scenario& s) { s.dds.spdp.resend = model::SpdpResend::new_only; }

void large_threshold(Scenario& s) { s.dds.sedp.piggyback_threshold_bytes = Bytes{4'000'000}; }

void version_2_14_5(Scenario& s) {
  new_only(s);
  s.dds.sedp.nack_response_delay = Nanoseconds{100 * ms};
  s.dds.sedp.nack_suppression_duration = Nanoseconds{10 * ms};
  s.dds.sedp.heartbeat_response_delay = Nanoseconds{10 * ms};
}

void done_at_once(Scenario& s) {
  for (model::Participant& p : s.deployment.participants) p.endpoints_done = p.start;
}

void done_at_once_2_14_5(Scenario& s) {
  done_at_once(s);
  version_2_14_5(s);
}

void done_at_once_linear(Scenario& s) {
  done_at_once(s);
  s.dds.sedp.piggyback = model::Piggyback::linear;
}

// Start and end of the creation of each participant's endpoints, in half milliseconds.
Scenario at(Scenario scenario, const std::vector<std::pair<std::int64_t, std::int64_t>>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    scenario.deployment.participants.at(i).start = Nanoseconds{times.at(i).first * 500 * us};
    scenario.deployment.participants.at(i).endpoints_done =
        Nanoseconds{times.at(i).second * 500 * us};
  }
  return scenario;
}

using Table = std::vector<FastddsVector>;

void add_small(Table& table) {
  const Scenario one = grid(1, 20);
  const Scenario two = grid(2, 10);
  const Scenario three = grid(3, 20);
  table.push_back({"hosts2x1x20", one, {37050682, 74, 0, 4, 4, 4, 2}, 27});
  table.push_back({"new_only_1x20", with(one, new_only), {35946294, 74, 0, 4, 4, 2, 2}, 27});
  table.push_back({"hosts2x2x10", two, {110371038, 216, 0, 16, 16, 20, 23}, 78});
  table.push_back({"hosts2x3x20", three, {385486096, 666, 0, 73, 89, 54, 99}, 409});
  table.push_back(
      {"new_only_3x20", with(three, new_only), {403116690, 666, 131, 220, 101, 25, 75}, 603});
}

void add_large(Table& table) {
  const Scenario five = grid(5, 20);
  const Scenario six = grid(6, 30);
  table.push_back({"hosts2x5x20", five, {1477945960, 1850, 555, 2108, 976, 150, 423}, 2388});
  table.push_back({"large_threshold",
                   with(five, large_threshold),
                   {1256465636, 1850, 555, 358, 416, 150, 423},
                   2004});
  table.push_back(
      {"new_only_5x20", with(five, new_only), {1902275164, 1850, 1225, 4551, 922, 60, 279}, 3105});
  table.push_back({"hosts2x6x30", six, {3159626435, 3384, 2929, 16754, 2962, 204, 644}, 6169});
  table.push_back(
      {"new_only_6x30", with(six, new_only), {6692993328, 3384, 4992, 29130, 2928, 96, 522}, 9065});
  table.push_back({"version_2_14_5",
                   with(five, version_2_14_5),
                   {1589678451, 1850, 868, 981, 397, 60, 279},
                   2920});
}

void add_schedules(Table& table) {
  const Scenario six = grid(6, 40);
  table.push_back({"done_at_once_2_14_5",
                   with(six, done_at_once_2_14_5),
                   {4795719778, 4104, 4424, 12296, 1381, 84, 504},
                   12011});
  table.push_back({"done_at_once_linear",
                   with(six, done_at_once_linear),
                   {1832680303, 4104, 1653, 466, 500, 204, 646},
                   6219});
  table.push_back(
      {"second_first", at(grid(1, 20), {{10, 47}, {6, 43}}), {36894588, 74, 0, 4, 4, 4, 2}, 27});
  table.push_back({"uneven",
                   at(grid(2, 10), {{18, 18}, {6, 180}, {6, 60}, {1000, 1000}}),
                   {566603429, 216, 81, 115, 65, 31, 38},
                   104});
}

}  // namespace

const std::vector<FastddsVector>& fastdds_vectors() {
  static const Table table = [] {
    Table t;
    add_small(t);
    add_large(t);
    add_schedules(t);
    return t;
  }();
  return table;
}

}  // namespace stormproof::vectors
