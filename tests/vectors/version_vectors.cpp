// The table of the test vectors of later versions of Fast DDS.
#include "tests/vectors/version_vectors.hpp"

#include "tests/vectors/fastdds_scenarios.hpp"

namespace stormproof::vectors {

namespace {

using model::Bytes;
using model::Nanoseconds;
using model::Scenario;
using Table = std::vector<Vector>;

void statistics(Scenario& s) { s.dds.version.statistics_bytes = Bytes{60}; }
void sizes_of_3(Scenario& s) { s.dds.version.sizes = model::SizesSince::v3_6; }
void small_messages(Scenario& s) { s.dds.version.max_data_per_message = 31; }
void group(Scenario& s) { s.dds.sedp.piggyback = model::Piggyback::group; }
void type_lookup(Scenario& s) { s.dds.version.type_lookup = model::Whether::yes; }
void no_type_lookup(Scenario& s) { s.dds.version.type_lookup = model::Whether::no; }
void builtin_first(Scenario& s) { s.dds.version.match_order = model::MatchOrder::builtin_first; }
void slow_builtin_replies(Scenario& s) {
  s.dds.version.builtin_response_delay = Nanoseconds{11'000'000};
}
void hashes_of_types(Scenario& s) { s.dds.version.descriptor_extra_bytes = Bytes{92}; }

void linear(Scenario& s) { s.dds.sedp.piggyback = model::Piggyback::linear; }
void resend_none(Scenario& s) { s.dds.spdp.resend = model::SpdpResend::none; }
void large_types(Scenario& s) { s.dds.version.type_object_bytes = Bytes{1'400}; }
void static_peers(Scenario& s) {
  s.dds.discovery = model::Discovery::static_peers;
  s.dds.peer_ports = 4;
}
Scenario with_threshold(Scenario s, std::int64_t bytes) {
  s.dds.sedp.piggyback_threshold_bytes = Bytes{bytes};
  return s;
}
/// Of the endpoints of each participant `unknown` have a type that nobody else knows.
Scenario with_types(std::uint32_t unknown, Scenario s) {
  s.deployment.types = model::EndpointTypes{unknown};
  return s;
}

Scenario times_a() { return at(grid(2, 10), {{18, 18}, {6, 180}, {6, 60}, {1000, 1000}}); }
Scenario times_b() {
  return at(grid(3, 5), {{80, 82}, {6, 400}, {14, 14}, {50, 320}, {6, 120}, {180, 190}});
}

// 2.14.5 with one key changed.
void add_keys(Table& table) {
  const Scenario five = with(grid(5, 20), version_2_14_5);
  const auto add = [&](const char* name, const Scenario& scenario, Expected expected,
                       std::int64_t user_control) {
    table.push_back({name, scenario, expected, user_control});
  };
  add("statistics", with(five, statistics), {1675057911, 1850, 943, 1177, 516, 60, 279}, 2960);
  add("sizes_of_3", with(five, sizes_of_3), {1461921062, 1850, 768, 714, 383, 60, 279}, 2873);
  add("small_messages", with(grid(2, 80), done_at_once, version_2_14_5, small_messages),
      {223313468, 776, 0, 144, 31, 12, 24}, 383);
  add("group", with(five, group), {1435670653, 1850, 780, 306, 312, 60, 279}, 2817);
  add("done_at_once_group", with(grid(6, 40), done_at_once, version_2_14_5, group),
      {2300049422, 4104, 285, 476, 220, 72, 432}, 9309);
  add("type_lookup", with(five, type_lookup), {1750162064, 1850, 747, 900, 535, 60, 276}, 3559);
  add("builtin_first", with(five, type_lookup, builtin_first),
      {1736574327, 1850, 781, 933, 538, 60, 276}, 3525);
  add("slow_builtin_replies", with(five, type_lookup, slow_builtin_replies),
      {1743199395, 1850, 906, 1022, 514, 60, 275}, 3510);
}

void add_3_2_5(Table& table) {
  const auto add = [&](const char* name, const Scenario& scenario, Expected expected,
                       std::int64_t user_control) {
    table.push_back({name, with(scenario, version_3_2_5), expected, user_control});
  };
  add("of_3_2_5_1x0", grid(1, 0), {123304288, 34, 0, 4, 4, 4, 4}, 14);
  add("of_3_2_5_1x20", grid(1, 20), {136033127, 74, 0, 4, 4, 4, 4}, 24);
  add("of_3_2_5_2x7", grid(2, 7), {138983374, 192, 0, 16, 16, 8, 16}, 84);
  add("of_3_2_5_3x20", grid(3, 20), {413089808, 666, 0, 56, 70, 30, 88}, 653);
  add("of_3_2_5_4x20", grid(4, 20), {984138133, 1184, 326, 264, 184, 48, 184}, 1884);
  add("of_3_2_5_5x20", grid(5, 20), {1746630062, 1850, 949, 919, 518, 60, 273}, 3509);
  add("of_3_2_5_2x80", with(grid(2, 80), done_at_once), {195383508, 776, 0, 96, 30, 8, 16}, 367);
}

void add_3_6_2(Table& table) {
  const auto add = [&](const char* name, const Scenario& scenario, Expected expected,
                       std::int64_t user_control) {
    table.push_back({name, with(scenario, version_3_6_2), expected, user_control});
  };
  add("of_3_6_2_1x0", grid(1, 0), {123304288, 34, 0, 4, 4, 4, 4}, 14);
  add("of_3_6_2_1x20", grid(1, 20), {136033127, 74, 0, 4, 4, 4, 4}, 24);
  add("of_3_6_2_2x7", grid(2, 7), {138983374, 192, 0, 16, 16, 8, 16}, 84);
  add("of_3_6_2_3x20", grid(3, 20), {412114230, 666, 0, 50, 64, 29, 85}, 653);
  add("of_3_6_2_4x20", grid(4, 20), {941310633, 1184, 326, 112, 160, 48, 184}, 1873);
  add("of_3_6_2_5x20", grid(5, 20), {1615871454, 1850, 949, 314, 428, 60, 273}, 3514);
  add("of_3_6_2_2x80", with(grid(2, 80), done_at_once), {194781040, 776, 0, 16, 16, 8, 16}, 367);
  add("of_3_6_2_6x40", with(grid(6, 40), done_at_once), {2615005451, 4104, 1710, 518, 460, 72, 421},
      9905);
  add("of_3_6_2_times_a", times_a(), {628251872, 216, 0, 16, 16, 20, 32}, 139);
  add("of_3_6_2_times_b", times_b(), {219802829, 396, 0, 36, 36, 15, 45}, 220);
  table.push_back({"registration_only",
                   with(grid(5, 20), version_3_6_2, no_type_lookup, hashes_of_types),
                   {1406947577, 1850, 575, 306, 312, 60, 279},
                   2640});
}

// Before 3.2.5 nobody asks, but the rules are the same.
void add_lookups_before_3(Table& table) {
  table.push_back({"lookups_of_2_14_5",
                   with_types(1, with(grid(2, 10), version_2_14_5, type_lookup)),
                   {201261258, 216, 0, 18, 18, 8, 16},
                   160,
                   95});
  table.push_back({"lookups_of_2_6_11",
                   with_types(4, with(grid(3, 20), type_lookup, statistics)),
                   {3137304792, 666, 764, 2016, 2058, 66, 133},
                   3525,
                   1558});
  table.push_back({"lookups_of_2_6_11_linear",
                   with_types(12, with_threshold(with(grid(2, 10), type_lookup, linear), 20'000)),
                   {373203546, 216, 40, 22, 28, 28, 38},
                   223,
                   1140});
}

void add_lookups_of_3_2_5(Table& table) {
  const auto add = [&](const char* name, std::uint32_t unknown, const Scenario& scenario,
                       Expected expected, std::int64_t user_control, std::int64_t lookup) {
    table.push_back(
        {name, with_types(unknown, with(scenario, version_3_2_5)), expected, user_control, lookup});
  };
  add("lookups_of_3_2_5_3x20_0", 0, grid(3, 20), {435927430, 666, 0, 71, 76, 30, 88}, 664, 0);
  add("lookups_of_3_2_5_2x10_1", 1, grid(2, 10), {201863976, 216, 0, 18, 18, 8, 16}, 152, 96);
  add("lookups_of_3_2_5_3x20_4", 4, grid(3, 20), {1161970770, 666, 144, 211, 122, 36, 106}, 1828,
      1383);
  add("lookups_of_3_2_5_3x20_12", 12, grid(3, 20), {1661701081, 666, 236, 427, 155, 36, 106}, 3453,
      4151);
  add("lookups_of_3_2_5_5x20_12", 12, grid(5, 20), {16509755417, 1850, 4619, 12181, 3092, 110, 502},
      31749, 18692);
}

void add_lookups_of_3_6_2(Table& table) {
  const auto add = [&](const char* name, std::uint32_t unknown, const Scenario& scenario,
                       Expected expected, std::int64_t user_control, std::int64_t lookup) {
    table.push_back(
        {name, with_types(unknown, with(scenario, version_3_6_2)), expected, user_control, lookup});
  };
  add("lookups_1x0_0", 0, grid(1, 0), {123630137, 34, 0, 4, 4, 4, 4}, 15, 0);
  add("lookups_3x20_0", 0, grid(3, 20), {421927422, 666, 0, 50, 64, 30, 88}, 663, 0);
  add("lookups_5x20_0", 0, grid(5, 20), {1686122167, 1850, 994, 314, 428, 60, 273}, 3477, 0);
  add("lookups_times_a_0", 0, times_a(), {634245966, 216, 0, 16, 16, 20, 32}, 151, 48);
  add("lookups_1x2_1", 1, grid(1, 2), {127996015, 38, 0, 4, 4, 4, 4}, 18, 8);
  add("lookups_3x20_1", 1, grid(3, 20), {848382759, 666, 181, 52, 68, 36, 106}, 1252, 345);
  add("lookups_2x10_4", 4, grid(2, 10), {243314608, 216, 0, 16, 16, 12, 24}, 168, 384);
  add("lookups_4x20_4", 4, grid(4, 20), {2731891766, 1184, 870, 200, 264, 48, 181}, 4562, 3174);
  add("lookups_1x2_12", 12, grid(1, 2), {135467151, 38, 0, 4, 4, 4, 4}, 24, 96);
  add("lookups_2x10_12", 12, grid(2, 10), {296011367, 216, 0, 18, 20, 12, 24}, 227, 1152);
  add("lookups_times_a_12", 12, times_a(), {697709312, 216, 0, 16, 16, 20, 32}, 190, 972);
  add("lookups_times_b_12", 12, times_b(), {887041994, 396, 107, 52, 68, 36, 101}, 671, 3786);
  add("lookups_3x20_12", 12, grid(3, 20), {1224405605, 666, 181, 88, 104, 36, 106}, 1469, 4151);
  add("lookups_5x20_12", 12, grid(5, 20), {7561707653, 1850, 3053, 774, 939, 80, 352}, 12188,
      18692);
  add("lookups_done_at_once_12", 12, with(grid(4, 20), done_at_once),
      {2868720038, 1184, 129, 199, 206, 48, 192}, 5007, 10752);
  add("lookups_small_threshold_12", 12, with_threshold(times_b(), 3'000),
      {1132752612, 396, 193, 221, 180, 36, 101}, 1389, 3786);
  add("lookups_resend_none_4", 4, times_b(), {649360982, 396, 46, 56, 70, 36, 86}, 561, 1548);
  resend_none(table.back().scenario);
  add("lookups_of_large_types_20", 20, grid(2, 10), {509031282, 216, 27, 18, 20, 24, 48}, 205,
      1920);
  large_types(table.back().scenario);
  add("lookups_of_static_peers_4", 4, with(grid(2, 10), static_peers),
      {251163190, 216, 0, 16, 16, 0, 72}, 161, 384);
  add("lookups_switched_off_12", 12, grid(3, 20), {434750545, 666, 5, 46, 56, 30, 90}, 666, 0);
  no_type_lookup(table.back().scenario);
}

}  // namespace

const std::vector<Vector>& version_vectors() {
  static const Table table = [] {
    Table t;
    add_keys(t);
    add_3_2_5(t);
    add_3_6_2(t);
    add_lookups_before_3(t);
    add_lookups_of_3_2_5(t);
    add_lookups_of_3_6_2(t);
    return t;
  }();
  return table;
}

}  // namespace stormproof::vectors
