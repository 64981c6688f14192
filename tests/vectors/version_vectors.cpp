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

}  // namespace

const std::vector<Vector>& version_vectors() {
  static const Table table = [] {
    Table t;
    add_keys(t);
    add_3_2_5(t);
    add_3_6_2(t);
    return t;
  }();
  return table;
}

}  // namespace stormproof::vectors
