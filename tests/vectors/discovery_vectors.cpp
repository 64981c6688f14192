// The table of the test vectors of the other ways to discover of `implementation: fastdds`: with a
// Discovery Server, as clients and as super clients, and with static peers. They have the channel
// of the other vectors of Fast DDS, and differ in size, in when participants start, and in what
// versions of Fast DDS differ in.
#include "tests/vectors/discovery_vectors.hpp"

#include "tests/vectors/fastdds_scenarios.hpp"

namespace stormproof::vectors {

namespace {

using model::Bytes;
using model::Discovery;
using model::Nanoseconds;
using model::Scenario;

constexpr std::int64_t us = 1'000;
constexpr std::int64_t ms = 1'000'000;

Scenario grid(Discovery discovery, std::uint32_t hosts, std::uint32_t participants,
              std::uint32_t endpoints) {
  Scenario scenario = staggered(hosts, participants, endpoints, 500 * us);
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  scenario.dds.discovery = discovery;
  return scenario;
}

// Participants come so late that others have learned everything.
Scenario late(Discovery discovery) {
  constexpr std::uint32_t participants = 8;
  Scenario scenario = grid(discovery, 2, 4, 12);
  for (std::uint32_t i = 0; i < participants; ++i) {
    model::Participant& p = scenario.deployment.participants.at(i);
    p.start = Nanoseconds{170 * ms * (3 * i % participants)};
    p.endpoints_done = Nanoseconds{p.start.count() + 58 * ms};
  }
  return scenario;
}

void short_routine_period(Scenario& s) {
  s.dds.server.server_routine_period = Nanoseconds{50 * ms};
}

void short_periods(Scenario& s) {
  short_routine_period(s);
  s.dds.server.client_sync_period = Nanoseconds{50 * ms};
}

void server_2_14_5(Scenario& s) {
  version_2_14_5(s);
  s.dds.server.relay = model::Relay::once;
}

void look_up_types_with_statistics(Scenario& s) {
  server_2_14_5(s);
  s.dds.version.type_lookup = model::Whether::yes;
  s.dds.version.statistics_bytes = Bytes{60};
}

void no_type_lookup(Scenario& s) { s.dds.version.type_lookup = model::Whether::no; }

void known_by_locator(Scenario& s) {
  s.dds.server.relay = model::Relay::once;
  s.dds.server.known = model::ServerKnown::locator;
}

using Table = std::vector<DiscoveryVector>;

void add_clients(Table& table) {
  constexpr Discovery server = Discovery::server;
  table.push_back(
      {"server_1x2", grid(server, 2, 1, 2), {914102792, 25, 3, 20, 20, 9, 7, 5, 8, 18}});
  table.push_back({"server_2x10",
                   grid(server, 2, 2, 10),
                   {994812141, 138, 258, 383, 132, 30, 30, 11, 49, 118}});
  table.push_back({"server_3x20",
                   grid(server, 2, 3, 20),
                   {1275531639, 471, 2184, 2639, 463, 74, 80, 19, 139, 722}});
  const Scenario five = grid(server, 2, 5, 20);
  table.push_back(
      {"server_5x20", five, {1589306706, 1265, 1892, 3155, 1272, 268, 312, 63, 233, 2464}});
  table.push_back({"short_periods",
                   with(five, short_periods),
                   {1573124694, 1265, 816, 2192, 2186, 281, 325, 66, 324, 2855}});
  table.push_back({"server_2_14_5",
                   with(five, server_2_14_5),
                   {1790982108, 1265, 1954, 3207, 344, 222, 258, 54, 224, 2765}});
  table.push_back({"server_3x20_type_lookup",
                   with(grid(server, 2, 3, 20), look_up_types_with_statistics),
                   {1246680239, 471, 148, 602, 88, 65, 74, 23, 102, 734}});
  table.push_back({"server_6x30",
                   grid(server, 2, 6, 30),
                   {2729037212, 2526, 0, 2546, 2561, 417, 486, 125, 346, 5958}});
  table.push_back({"three_hosts",
                   grid(server, 3, 2, 9),
                   {1092248822, 344, 517, 831, 329, 105, 122, 26, 97, 385}});
  table.push_back(
      {"late", late(server), {2976487798, 564, 1848, 2552, 2566, 86, 116, 50, 685, 1325}});
  table.push_back({"server_2x60",
                   grid(server, 2, 2, 60),
                   {1380638049, 538, 3555, 4099, 533, 30, 32, 11, 187, 913}});
}

void add_super_clients(Table& table) {
  constexpr Discovery super = Discovery::super_client;
  table.push_back({"super_5x20",
                   grid(super, 2, 5, 20),
                   {2432259813, 1850, 13166, 15028, 1595, 429, 504, 102, 364, 3193}});
  table.push_back({"super_three_hosts",
                   grid(super, 3, 2, 9),
                   {1299547662, 624, 2107, 2717, 501, 157, 191, 33, 150, 532}});
  table.push_back({"super_3x20_2_14_5",
                   with(grid(super, 2, 3, 20), server_2_14_5),
                   {1297064035, 666, 0, 658, 99, 92, 109, 24, 120, 716}});
  table.push_back({"super_late_2_14_5",
                   with(with(late(super), server_2_14_5), short_routine_period),
                   {2364016950, 928, 1580, 2677, 222, 88, 103, 50, 399, 1602}});
}

/// Versions since 3.0, which know the server by its locator.
void add_locators(Table& table) {
  constexpr Discovery server = Discovery::server;
  constexpr Discovery super = Discovery::super_client;
  const auto add = [&](const char* name, const Scenario& scenario, DiscoveryExpected expected) {
    table.push_back({name, with(scenario, known_by_locator), expected});
  };
  add("of_3_2_5_1x2", with(grid(server, 2, 1, 2), version_3_2_5),
      {1022793434, 25, 0, 17, 10, 7, 4, 4, 6, 41});
  add("of_3_2_5_3x20", with(grid(server, 2, 3, 20), version_3_2_5),
      {1243777875, 471, 148, 599, 87, 60, 68, 17, 98, 710});
  add("of_3_2_5_5x20", with(grid(server, 2, 5, 20), version_3_2_5),
      {1691742826, 1265, 0, 1248, 277, 214, 250, 63, 190, 2960});
  add("super_of_3_2_5", with(grid(super, 2, 2, 10), version_3_2_5),
      {1098086292, 216, 0, 205, 34, 32, 32, 8, 42, 154});
  const auto of_3_6_2 = [&](std::uint32_t hosts, std::uint32_t participants,
                            std::uint32_t endpoints) {
    return with(grid(super, hosts, participants, endpoints), version_3_6_2);
  };
  add("super_of_3_6_2_1x2", of_3_6_2(2, 1, 2), {1027338528, 38, 0, 32, 10, 8, 5, 3, 8, 35});
  add("super_of_3_6_2_2x10", of_3_6_2(2, 2, 10), {1098089844, 216, 0, 205, 34, 32, 32, 8, 42, 154});
  const Scenario three = of_3_6_2(2, 3, 20);
  add("super_of_3_6_2_3x20", three, {1295304786, 666, 0, 652, 96, 92, 106, 21, 119, 822});
  add("super_of_3_6_2_5x20", of_3_6_2(2, 5, 20),
      {2738895814, 1850, 1697, 3747, 460, 345, 407, 112, 574, 4210});
  add("super_of_3_6_2_three_hosts", of_3_6_2(3, 2, 9),
      {1255778865, 624, 0, 604, 112, 105, 124, 25, 110, 577});
  add("super_of_3_6_2_short_periods", with(three, short_periods),
      {787428680, 666, 325, 1081, 112, 95, 106, 21, 228, 849});
  add("super_of_3_6_2_no_type_lookup", with(three, no_type_lookup),
      {1307100404, 666, 257, 909, 101, 94, 108, 21, 121, 704});
}

void add_static_peers(Table& table) {
  constexpr Discovery peers = Discovery::static_peers;
  const auto ports = [](std::uint32_t count) {
    return with(grid(peers, 2, 5, 20), [&](Scenario& s) { s.dds.peer_ports = count; });
  };
  table.push_back(
      {"static_2x10", grid(peers, 2, 2, 10), {115578259, 216, 0, 18, 16, 102, 0, 0, 0, 79}});
  table.push_back({"static_three_hosts",
                   grid(peers, 3, 2, 10),
                   {547362378, 648, 24, 376, 376, 710, 0, 0, 0, 415}});
  table.push_back(
      {"static_5_ports", ports(5), {1728368606, 1850, 779, 3609, 1618, 1151, 0, 0, 0, 2377}});
  table.push_back(
      {"static_32_ports", ports(32), {5124041208, 1850, 4716, 25713, 3616, 5427, 0, 0, 0, 3283}});
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const DiscoveryExpected& e) {
  return out << e.t_disc_ns << " ns, initial " << e.initial_data << ", repair " << e.repair_data
             << ", HEARTBEAT " << e.heartbeat << ", ACKNACK " << e.acknack << ", DATA(p) "
             << e.announcements << ", HB(p) " << e.pdp_heartbeat << ", ACK(p) " << e.pdp_acknack
             << ", gap " << e.gap << ", user control " << e.user_control;
}

const std::vector<DiscoveryVector>& discovery_vectors() {
  static const Table table = [] {
    Table t;
    add_clients(t);
    add_super_clients(t);
    add_locators(t);
    add_static_peers(t);
    return t;
  }();
  return table;
}

}  // namespace stormproof::vectors
