// The table of the test vectors of `implementation: fastdds`.
#include "tests/vectors/fastdds_vectors.hpp"

#include "tests/vectors/fastdds_scenarios.hpp"

namespace stormproof::vectors {

namespace {

using model::Bytes;
using model::Scenario;

void large_threshold(Scenario& s) { s.dds.sedp.piggyback_threshold_bytes = Bytes{4'000'000}; }

void done_at_once_2_14_5(Scenario& s) {
  done_at_once(s);
  version_2_14_5(s);
}

void done_at_once_linear(Scenario& s) {
  done_at_once(s);
  s.dds.sedp.piggyback = model::Piggyback::linear;
}

using Table = std::vector<Vector>;

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

const std::vector<Vector>& fastdds_vectors() {
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
