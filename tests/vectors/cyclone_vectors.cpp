// The table of the test vectors of `implementation: cyclone`. Two hosts and one channel for all of
// them; they differ in size, in whether SEDP goes by multicast, in a few knobs, in what is lost,
// and in when participants start, open and are ready.
#include "tests/vectors/cyclone_vectors.hpp"

#include <utility>

#include "tests/vectors/staggered.hpp"

namespace stormproof::vectors {

namespace {

using model::AllowMulticast;
using model::Bytes;
using model::Nanoseconds;
using model::Scenario;

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000'000;
constexpr std::uint32_t hosts = 2;
constexpr AllowMulticast uc = AllowMulticast::spdp;
constexpr AllowMulticast mc = AllowMulticast::always;

}  // namespace

Scenario cyclone_grid(std::uint32_t participants, std::uint32_t endpoints,
                      AllowMulticast multicast) {
  Scenario scenario = staggered(hosts, participants, endpoints, 100 * us);
  scenario.deployment.loopback_delay = Nanoseconds{60 * us};
  scenario.deployment.send_time = Nanoseconds{20 * us};
  scenario.dds.implementation = model::ImplementationKind::cyclone;
  scenario.dds.allow_multicast = multicast;
  scenario.dds.spdp.period = Nanoseconds{8'000 * ms};
  return scenario;
}

namespace {

using Table = std::vector<Vector>;

auto loopback_and_send_time(std::int64_t loopback, std::int64_t send) {
  return [=](Scenario& s) {
    s.deployment.loopback_delay = Nanoseconds{loopback};
    s.deployment.send_time = Nanoseconds{send};
  };
}

auto intervals(std::int64_t heartbeat, std::int64_t nack) {
  return [=](Scenario& s) {
    s.dds.sedp.heartbeat_interval = Nanoseconds{heartbeat};
    s.dds.sedp.nack_delay = Nanoseconds{nack};
  };
}

Scenario losing(Scenario scenario, std::vector<std::uint64_t> packets) {
  scenario.wireless.lost_packets = std::move(packets);
  return scenario;
}

Scenario losing_range(Scenario scenario, std::uint64_t first, std::uint64_t last) {
  for (std::uint64_t k = first; k <= last; ++k) scenario.wireless.lost_packets.push_back(k);
  return scenario;
}

// What arrives between `open` and `ready`, in milliseconds, is received late.
Scenario busy(Scenario scenario, const std::vector<std::pair<std::int64_t, std::int64_t>>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    scenario.deployment.participants.at(i).open = Nanoseconds{times.at(i).first * ms};
    scenario.deployment.participants.at(i).ready = Nanoseconds{times.at(i).second * ms};
  }
  return scenario;
}

void add_sizes(Table& table) {
  const auto add = [&](const char* name, std::uint32_t participants, std::uint32_t endpoints,
                       AllowMulticast multicast, const Expected& expected, std::int64_t control) {
    table.push_back({name, cyclone_grid(participants, endpoints, multicast), expected, control});
  };
  add("uc_1x2", 1, 2, uc, {15272214, 38, 8, 8, 6, 2, 1}, 20);
  add("uc_1x20", 1, 20, uc, {27423918, 74, 19, 10, 10, 2, 1}, 36);
  add("mc_1x20", 1, 20, mc, {27168227, 74, 18, 10, 10, 2, 1}, 36);
  add("uc_2x10", 2, 10, uc, {60096824, 216, 12, 32, 42, 4, 5}, 169);
  add("mc_2x10", 2, 10, mc, {77207588, 222, 22, 36, 46, 4, 5}, 213);
  add("uc_3x7", 3, 7, uc, {121749441, 432, 24, 72, 102, 12, 30}, 362);
  add("uc_3x20", 3, 20, uc, {199353068, 666, 50, 102, 124, 12, 30}, 754);
  add("mc_3x20", 3, 20, mc, {382821333, 589, 199, 116, 160, 12, 12}, 965);
  add("uc_5x20", 5, 20, uc, {1206521841, 1850, 3042, 1390, 804, 20, 115}, 5557);
  add("mc_5x20", 5, 20, mc, {1281329782, 919, 1056, 424, 904, 20, 82}, 4956);
  add("uc_6x30", 6, 30, uc, {6274220257, 3384, 18304, 7835, 3063, 24, 284}, 33035);
  add("mc_6x30", 6, 30, mc, {3919231648, 1260, 3453, 917, 2250, 24, 264}, 14341);
}

void add_knobs(Table& table) {
  const Scenario five = cyclone_grid(5, 20, uc);
  const auto add = [&](const char* name, const Scenario& base, auto change,
                       const Expected& expected, std::int64_t control) {
    table.push_back({name, with(base, change), expected, control});
  };
  add("mc_4x10_no_delays", cyclone_grid(4, 10, mc), loopback_and_send_time(0, 0),
      {453363800, 613, 525, 196, 290, 16, 25}, 1283);
  add("live_machine", five, loopback_and_send_time(2 * ms, 50 * us),
      {1372779098, 1850, 3668, 1558, 845, 20, 115}, 6029);
  add(
      "no_merging", five,
      [](Scenario& s) { s.dds.sedp.merge_queued_rexmit = model::MergeQueued::no; },
      {1203341090, 1850, 2966, 1390, 804, 20, 115}, 5502);
  add("both_one_second", five, intervals(1'000 * ms, 1'000 * ms),
      {430623010, 1850, 154, 200, 292, 20, 78}, 1529);
  add(
      "max_queued_20", five, [](Scenario& s) { s.dds.sedp.max_queued_rexmit_messages = 20; },
      {2471146095, 1850, 3798, 1939, 1329, 20, 152}, 10607);
  add(
      "max_rexmit_14720", five,
      [](Scenario& s) { s.dds.sedp.max_rexmit_message_size = Bytes{14'720}; },
      {1114507343, 1850, 2966, 1308, 782, 20, 115}, 4902);
  add("nack_delay_one_second", five, intervals(100 * ms, 1'000 * ms),
      {1068644518, 1850, 1412, 1162, 618, 20, 100}, 4508);
  add("heartbeat_interval_300_ms", five, intervals(300 * ms, 100 * ms),
      {560843408, 1850, 154, 300, 292, 20, 78}, 2359);
  add("send_time_200_us", cyclone_grid(3, 20, uc), loopback_and_send_time(60 * us, 200 * us),
      {281239887, 666, 153, 114, 138, 12, 30}, 1039);
}

void add_losses(Table& table) {
  table.push_back({"uc_2x10_losses",
                   losing(cyclone_grid(2, 10, uc), {0, 5, 9, 40, 41, 60, 100}),
                   {118520990, 216, 19, 36, 44, 8, 13},
                   223});
  table.push_back({"mc_3x20_losses",
                   losing(cyclone_grid(3, 20, mc), {3, 20, 35, 60, 61, 90, 120}),
                   {348828296, 594, 243, 119, 152, 12, 12},
                   782});
  table.push_back({"uc_3x20_loses_41_in_a_row",
                   losing_range(cyclone_grid(3, 20, uc), 20, 60),
                   {406687349, 666, 340, 144, 168, 12, 24},
                   1265});
  const auto slow = [](Scenario& s) {
    s.deployment.send_time = Nanoseconds{1 * ms};
    intervals(200 * ms, 300 * ms)(s);
    s.dds.sedp.max_queued_rexmit_messages = 8;
  };
  table.push_back({"uc_3x7_slow_and_lossy",
                   losing_range(with(cyclone_grid(3, 7, uc), slow), 97, 106),
                   {911557452, 432, 174, 178, 173, 12, 27},
                   710});
}

void add_schedules(Table& table) {
  const std::vector<std::pair<std::int64_t, std::int64_t>> uneven{
      {18, 18}, {6, 180}, {6, 60}, {1000, 1000}};
  table.push_back({"second_first",
                   at(cyclone_grid(1, 20, uc), {{10, 47}, {6, 43}}),
                   {34939150, 74, 4, 8, 8, 2, 1},
                   49});
  table.push_back(
      {"uneven", at(cyclone_grid(2, 10, uc), uneven), {532343534, 216, 17, 33, 39, 7, 9}, 216});
  table.push_back({"busy_at_start",
                   busy(at(cyclone_grid(2, 10, mc), {{18, 18}, {6, 180}, {6, 60}, {100, 100}}),
                        {{1, 20}, {1, 25}, {1, 21}, {2, 50}}),
                   {178492112, 216, 7, 33, 44, 8, 8},
                   187});
}

}  // namespace

const std::vector<Vector>& cyclone_vectors() {
  static const Table table = [] {
    Table t;
    add_sizes(t);
    add_knobs(t);
    add_losses(t);
    add_schedules(t);
    return t;
  }();
  return table;
}

}  // namespace stormproof::vectors
