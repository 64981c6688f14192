// The table of the test vectors. The paper profile is the default of every input struct, so that a
// vector's code shows exactly what sets it apart.
#include "tests/vectors/paper_vectors.hpp"

#include <utility>

#include "tests/vectors/staggered.hpp"

namespace stormproof::vectors {

namespace {

using model::Bytes;
using model::Nanoseconds;
using model::Scenario;

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000'000;

Scenario grid(std::uint32_t hosts, std::uint32_t participants, std::uint32_t endpoints) {
  Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(hosts, participants, endpoints);
  return scenario;
}

model::Stage multicast_stage(const std::string& name, const std::string& channel) {
  return {name, channel, model::MulticastAs::multicast, {}, {}, {}, {}};
}

void ad_hoc(Scenario& s) { s.wireless.stages = {multicast_stage("direct", "air")}; }

void mesh(Scenario& s) {
  s.wireless.stages = {multicast_stage("hop1", "air"), multicast_stage("hop2", "air"),
                       multicast_stage("hop3", "air")};
}

void cellular(Scenario& s) {
  model::Stage up{"uplink", "up", model::MulticastAs::unicast, {}, {}, {}, {}};
  up.overhead_unicast = Nanoseconds{500 * us};
  up.overhead_multicast = Nanoseconds{500 * us};
  up.rate_unicast = model::BitsPerSecond{50'000'000};
  up.rate_multicast = model::BitsPerSecond{50'000'000};
  model::Stage down = multicast_stage("downlink", "down");
  down.overhead_unicast = Nanoseconds{200 * us};
  down.overhead_multicast = Nanoseconds{200 * us};
  down.rate_unicast = model::BitsPerSecond{150'000'000};
  down.rate_multicast = model::BitsPerSecond{20'000'000};
  s.wireless.stages = {up, down};
}

void every_fast_dds_value(Scenario& s) {
  s.dds.sedp.relation_opening = model::RelationOpening::each_side;
  s.dds.sedp.initial_data = model::InitialData::pull;
  s.dds.sedp.unmatched = model::Unmatched::drop;
  s.dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  s.dds.sedp.acknowledge = model::Acknowledge::prefix;
  s.dds.sedp.heartbeat_recipients = model::HeartbeatRecipients::matched;
}

void constant_delay(Scenario& s, std::int64_t one_way_ns) {
  s.wireless.kind = model::ServiceKind::constant_delay;
  s.wireless.one_way = Nanoseconds{one_way_ns};
}

model::Participant node(std::uint32_t host, std::uint32_t publications, std::uint32_t subscriptions,
                        std::int64_t start_ns) {
  return {model::HostId{host}, publications, subscriptions, Nanoseconds{start_ns}, Nanoseconds{}};
}

Scenario v1() {
  Scenario s;
  s.deployment.participants = {node(0, 19, 5, 1 * ms), node(1, 8, 0, 0)};
  s.dds.sedp.relation_opening = model::RelationOpening::each_side;
  s.dds.sedp.initial_data = model::InitialData::pull;
  s.dds.sedp.acknowledge = model::Acknowledge::prefix;
  s.dds.spdp.resend = model::SpdpResend::none;
  s.dds.sedp.initial_acknack_delay = Nanoseconds{0};
  constant_delay(s, 300 * us);
  s.wireless.lost_packets = {22, 36};
  return s;
}

Scenario v2() {
  Scenario s;
  s.deployment.participants = {node(0, 4, 0, 100 * ms), node(1, 16, 3, 1 * ms), node(2, 4, 8, 0)};
  constant_delay(s, 1 * ms);
  return s;
}

Scenario v3() {
  Scenario s;
  s.deployment.participants = {
      node(0, 14, 1, 0), node(1, 18, 2, 2500 * ms), node(2, 16, 3, 0), node(3, 6, 0, 0),
      node(0, 9, 5, 0),  node(1, 8, 0, 100 * ms),   node(2, 4, 8, 0),  node(3, 12, 6, 0)};
  s.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  s.dds.sedp.piggyback = model::Piggyback::off;
  s.dds.spdp.resend = model::SpdpResend::new_only;
  s.dds.sedp.heartbeat_period = Nanoseconds{150 * ms};
  s.wireless.lost_packets = {0, 1, 2, 7, 19, 36, 44, 52};
  return s;
}

Scenario v4() {
  Scenario s;
  s.deployment.participants = {node(0, 6, 2, 0),         node(1, 17, 0, 2500 * ms),
                               node(0, 20, 3, 1 * ms),   node(1, 11, 5, 0),
                               node(0, 7, 5, 2000 * ms), node(1, 17, 0, 0),
                               node(0, 13, 1, 1000 * ms)};
  s.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  s.dds.sedp.piggyback = model::Piggyback::linear;
  s.wireless.order = model::ServiceOrder::fifo_downlink;
  s.wireless.lost_packets = {25, 31, 42, 66, 76, 84, 91, 127, 128, 176, 182, 190};
  return s;
}

using Table = std::vector<Vector>;

void add_plain(Table& table) {
  table.push_back({"hosts2x1x2", grid(2, 1, 2), {16136228, 38, 38, 8, 4, 4, 2}});
  table.push_back({"hosts2x2x10", grid(2, 2, 10), {175926571, 216, 216, 172, 140, 16, 20}});
  table.push_back({"hosts2x5x20", grid(2, 5, 20), {6262986593, 1850, 3286, 18106, 8552, 120, 450}});
  table.push_back(
      {"hosts2x6x30", grid(2, 6, 30), {13263476331, 3384, 4289, 34531, 15203, 192, 900}});
  table.push_back({"hosts3x2x7", grid(3, 2, 7), {1243293485, 576, 837, 2302, 1457, 60, 180}});
  table.push_back({"hosts2x1x20", grid(2, 1, 20), {26271312, 74, 74, 22, 5, 4, 2}});
}

void add_grouping_and_queue(Table& table) {
  const Scenario base = grid(2, 4, 12);
  const auto mtu = [](Scenario& s) { s.dds.sedp.grouping = model::Grouping::mtu; };
  const auto single = [](Scenario& s) { s.dds.sedp.grouping = model::Grouping::single; };
  const auto linear = [](Scenario& s) {
    s.dds.sedp.piggyback = model::Piggyback::linear;
    s.dds.sedp.piggyback_threshold_bytes = Bytes{5000};
  };
  const auto short_queue = [](Scenario& s) { s.wireless.source_queue_bytes = Bytes{4000}; };
  const auto at_admission = [](Scenario& s) {
    s.wireless.fragment_request = model::FragmentRequest::at_admission;
  };
  table.push_back({"grouping_mtu", with(base, mtu), {562775668, 928, 0, 624, 758, 80, 240}});
  table.push_back({"grouping_single", with(base, single), {811983772, 928, 0, 672, 843, 80, 240}});
  table.push_back(
      {"piggyback_linear", with(base, linear), {882019228, 928, 952, 512, 591, 80, 240}});
  table.push_back(
      {"short_queue", with(base, short_queue), {546628821, 928, 346, 1316, 699, 80, 240}});
  table.push_back(
      {"at_admission", with(base, at_admission), {555668916, 928, 0, 624, 757, 80, 240}});
}

void add_routes(Table& table) {
  const auto downlink = [](Scenario& s) { s.wireless.order = model::ServiceOrder::fifo_downlink; };
  const auto datagram = [](Scenario& s) {
    s.wireless.order = model::ServiceOrder::datagram_uplink;
  };
  const Scenario five = grid(2, 5, 20);
  const Scenario three_hops = with(grid(2, 3, 10), mesh);
  table.push_back({"fifo_downlink",
                   with(grid(2, 6, 30), downlink),
                   {13262646918, 3384, 4289, 34531, 15203, 192, 900}});
  table.push_back({"ad_hoc", with(five, ad_hoc), {2472938372, 1850, 1838, 10515, 7198, 110, 400}});
  table.push_back({"mesh", three_hops, {1380324956, 486, 957, 1725, 764, 54, 126}});
  table.push_back(
      {"mesh_datagram", with(three_hops, datagram), {1365754316, 486, 957, 1725, 757, 54, 126}});
  table.push_back(
      {"cellular", with(five, cellular), {6226910667, 1850, 1844, 10824, 7198, 120, 450}});
  table.push_back(
      {"datagram_uplink", with(five, datagram), {6244681877, 1850, 3285, 18100, 8551, 120, 450}});
}

void add_policies(Table& table) {
  const auto additive = [](Scenario& s) {
    s.dds.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  };
  const auto adaptive = [](Scenario& s) {
    s.dds.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  };
  const auto ideal = [](Scenario& s) {
    constant_delay(s, 100 * us);
    s.dds.sedp.piggyback = model::Piggyback::off;
  };
  const auto lossy = [](Scenario& s) {
    every_fast_dds_value(s);
    s.wireless.lost_packets = {3, 40, 41};
  };
  const Scenario five = grid(2, 5, 20);
  table.push_back({"heartbeat_additive",
                   with(five, additive),
                   {6508611095, 1850, 3286, 30227, 8552, 130, 500}});
  table.push_back({"heartbeat_adaptive",
                   with(five, adaptive),
                   {6242794193, 1850, 3286, 17906, 8552, 120, 450}});
  table.push_back({"constant_delay", with(five, ideal), {200000, 1850, 0, 100, 0, 60, 150}});
  table.push_back({"fast_dds_values",
                   with(five, every_fast_dds_value),
                   {8937177640, 1850, 2080, 13286, 10982, 130, 500}});
  table.push_back({"fast_dds_values_lossy",
                   with(grid(2, 3, 10), lossy),
                   {644799044, 486, 558, 990, 588, 54, 126}});
}

void add_heterogeneous(Table& table) {
  table.push_back({"v1", v1(), {2002310000, 66, 17, 12, 8, 12, 10}});
  table.push_back({"v2", v2(), {103000000, 172, 0, 39, 25, 11, 13}});
  table.push_back({"v3", v3(), {2658002385, 1488, 1535, 218, 242, 44, 222}});
  table.push_back({"v4", v4(), {2622812646, 779, 758, 72, 78, 62, 118}});
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Expected& e) {
  return out << "t_disc " << e.t_disc_ns << " ns, initial " << e.initial_data << ", repair "
             << e.repair_data << ", heartbeat " << e.heartbeat << ", acknack " << e.acknack
             << ", spdp " << e.spdp_multicast << " + " << e.spdp_unicast;
}

const std::vector<Vector>& paper_vectors() {
  static const Table table = [] {
    Table t;
    add_plain(t);
    add_grouping_and_queue(t);
    add_routes(t);
    add_policies(t);
    add_heterogeneous(t);
    return t;
  }();
  return table;
}

const std::vector<OpenLoopVector>& open_loop_vectors() {
  static const std::vector<OpenLoopVector> table{{"hosts2x1x2", grid(2, 1, 2), 15576812},
                                                 {"hosts2x5x20", grid(2, 5, 20), 534847700},
                                                 {"hosts2x6x30", grid(2, 6, 30), 902961804}};
  return table;
}

}  // namespace stormproof::vectors
