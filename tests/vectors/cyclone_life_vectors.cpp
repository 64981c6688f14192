// The table of the vectors of Cyclone DDS with a life.
#include "tests/vectors/cyclone_life_vectors.hpp"

#include <utility>

#include "tests/vectors/cyclone_vectors.hpp"
#include "tests/vectors/staggered.hpp"

namespace stormproof::vectors {

namespace {

using model::AllowMulticast;
using model::Life;
using model::Nanoseconds;
using model::Reach;
using model::Scenario;

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t sec = 1'000 * ms;
constexpr AllowMulticast uc = AllowMulticast::spdp;
constexpr AllowMulticast mc = AllowMulticast::always;

Life& life(Scenario& s) {
  if (!s.deployment.life) s.deployment.life.emplace();
  return *s.deployment.life;
}

auto one_way(std::uint32_t from, std::uint32_t to, std::int64_t start_ms, std::int64_t end_ms) {
  return [=](Scenario& s) {
    life(s).outages.push_back({from, to, Nanoseconds{start_ms * ms}, Nanoseconds{end_ms * ms}});
  };
}
/// Everybody from those of the other hosts.
auto all_cut(std::int64_t start_ms, std::int64_t end_ms) {
  return [=](Scenario& s) {
    life(s).outages.push_back(
        {0, 0, Nanoseconds{start_ms * ms}, Nanoseconds{end_ms * ms}, Reach::all, Reach::all});
  };
}
auto host_cut(std::uint32_t host, std::int64_t start_ms, std::int64_t end_ms) {
  return [=](Scenario& s) {
    const Nanoseconds start{start_ms * ms};
    const Nanoseconds end{end_ms * ms};
    life(s).outages.push_back({host, 0, start, end, Reach::host, Reach::all});
    life(s).outages.push_back({0, host, start, end, Reach::all, Reach::host});
  };
}
void publishes_late(Scenario& s) { life(s).endpoints.push_back({0, 1, 0, Nanoseconds{13 * sec}}); }
void deletes_and_third(Scenario& s) {
  life(s).deletions.push_back({.participant = 0, .publication = 0, .at = Nanoseconds{13 * sec}});
  model::Participant third = s.deployment.participants[1];
  third.start = Nanoseconds{14 * sec};
  third.endpoints_done = third.start + Nanoseconds{5 * ms};
  s.deployment.participants.push_back(third);
}
auto replaced(model::Goodbye goodbye) {
  return [=](Scenario& s) {
    life(s).restarts.push_back(
        {0, Nanoseconds{15 * sec}, Nanoseconds{17 * sec}, model::Identity::fresh, goodbye});
  };
}
void uneven_leases(Scenario& s) {
  life(s).leases = {{0, Nanoseconds{5 * sec}}, {1, Nanoseconds{20 * sec}}};
}
void announces_every_5_s(Scenario& s) { s.dds.spdp.period = Nanoseconds{5 * sec}; }
void second_starts_at_1_s(Scenario& s) {
  model::Participant& second = s.deployment.participants[1];
  second.start = Nanoseconds{1 * sec};
  second.endpoints_done = second.start + Nanoseconds{5 * ms};
}

using Table = std::vector<LifeVector>;

template <class... Changes>
void add(Table& table, const char* name, Scenario scenario, const LifeExpected& expected,
         const Changes&... changes) {
  table.push_back({name, with(std::move(scenario), changes...), expected});
}

void add_outages(Table& t) {
  const Scenario a = two_lives(mc);
  add(t, "mc_both_ways", a, {32108261491, 5108261491, 2, 84, 4, 16, 14, 0, 11, 5, 87, 81},
      all_cut(12'000, 27'000));
  add(t, "uc_both_ways", two_lives(uc),
      {32108354664, 5108354664, 2, 84, 5, 16, 14, 0, 11, 13, 87, 82}, all_cut(12'000, 27'000));
  add(t, "mc_from_0_to_1", a, {32114399831, 5114399831, 1, 42, 25, 14, 14, 0, 11, 5, 121, 64},
      one_way(0, 1, 12'000, 27'000));
  add(t, "mc_from_1_to_0", a, {32222399831, 5222399831, 1, 42, 25, 14, 14, 0, 12, 5, 118, 62},
      one_way(1, 0, 12'000, 27'000));
  add(t, "mc_too_short_to_be_forgotten", a, {120188792, 0, 0, 42, 4, 8, 6, 0, 3, 1, 21, 0},
      all_cut(12'000, 14'000));
}

void add_endpoints(Table& t) {
  const Scenario a = two_lives(mc);
  add(t, "mc_late_publication", a, {13000335678, 335678, 0, 43, 4, 8, 8, 0, 6, 4, 40, 1},
      publishes_late);
  add(t, "mc_late_publication_in_an_outage", a,
      {18100963602, 1100963602, 0, 43, 5, 23, 9, 0, 8, 4, 68, 14}, publishes_late,
      all_cut(12'000, 17'000));
  add(t, "mc_deleted_publication_and_a_third", a,
      {14024877801, 24877801, 0, 100, 4, 17, 17, 1, 7, 5, 74, 110}, deletes_and_third);
}

void add_restarts(Table& t) {
  const Scenario a = two_lives(mc);
  add(t, "mc_dies_and_is_replaced", a,
      {18108629252, 1108629252, 1, 84, 8, 16, 16, 0, 9, 6, 93, 110}, replaced(model::Goodbye::no));
  add(t, "mc_leaves_and_is_replaced", a,
      {17012188792, 12188792, 0, 105, 8, 16, 14, 0, 9, 5, 61, 83}, replaced(model::Goodbye::yes));
  add(t, "mc_leaves_unheard_and_is_replaced", a,
      {18108629252, 1108629252, 1, 105, 8, 16, 16, 0, 10, 6, 93, 110},
      replaced(model::Goodbye::yes), all_cut(14'000, 16'000));
  add(t, "mc_uneven_leases", a, {24114399831, 2114399831, 1, 42, 25, 14, 14, 0, 11, 5, 105, 60},
      uneven_leases, all_cut(12'000, 22'000));
}

void add_peers(Table& t) {
  add(t, "peers_9_both_ways", two_peers(9),
      {32110094239, 5110094239, 2, 84, 4, 16, 14, 0, 0, 104, 95, 89}, all_cut(12'000, 27'000));
  const Scenario eleven = pruning(two_peers(100));
  add(t, "peers_100_of_11_for_25_s", eleven,
      {48116329916, 11116329916, 2, 84, 21, 20, 18, 0, 0, 211, 94, 79}, all_cut(12'000, 37'000));
  add(t, "peers_100_of_11_for_45_s", eleven, {{}, {}, 2, 42, 21, 12, 12, 0, 0, 211, 73, {}},
      all_cut(12'000, 57'000));
  add(t, "peers_100_of_11_for_45_s_every_5_s", eleven,
      {60108042548, 3108042548, 2, 84, 21, 20, 18, 0, 0, 1218, 98, 79}, announces_every_5_s,
      all_cut(12'000, 57'000));
  add(t, "peers_100_of_11_unheard_at_the_start", eleven, {{}, {}, 0, 0, 0, 0, 0, 0, 0, 200, 0, {}},
      second_starts_at_1_s, one_way(1, 0, 900, 1'050));
  add(t, "peers_100_of_11_unheard_at_the_start_every_5_s", eleven,
      {5041912833, 3991912833, 0, 42, 0, 10, 10, 0, 0, 301, 28, 191}, second_starts_at_1_s,
      announces_every_5_s, one_way(1, 0, 900, 1'050));
  add(t, "peers_9_unheard_at_the_start", two_peers(9),
      {1109935486, 59935486, 0, 42, 0, 8, 6, 0, 0, 37, 21, 87}, second_starts_at_1_s,
      one_way(1, 0, 900, 1'050));
}

void add_sizes(Table& t) {
  add(t, "uc_2x2x10", cyclone_grid(2, 10, uc),
      {32179056493, 5179056493, 8, 432, 12, 64, 80, 0, 24, 66, 604, 512}, all_cut(12'000, 27'000));
  Scenario three = cyclone_grid(2, 10, mc);
  const Scenario times = staggered(3, 2, 10, 100'000);
  three.deployment.participants = times.deployment.participants;
  add(t, "mc_3x2x10_one_host_away", three,
      {32220607898, 5220607898, 16, 1098, 64, 172, 262, 0, 36, 81, 1612, 1095},
      host_cut(2, 12'000, 27'000));
  add(t, "uc_5x20", cyclone_grid(5, 20, uc),
      {33000076179, 6000076179, 50, 3700, 5878, 3152, 2773, 0, 60, 432, 21998, 9553},
      all_cut(12'000, 27'000));
  add(t, "mc_5x20_in_the_storm", cyclone_grid(5, 20, mc),
      {8321950331, 7321950331, 0, 2101, 360, 416, 428, 0, 30, 86, 3131, 5456}, all_cut(100, 1'000));
}

}  // namespace

Scenario two_lives(AllowMulticast multicast) {
  constexpr std::uint32_t endpoints = 4;
  Scenario scenario = cyclone_grid(1, endpoints, multicast);
  scenario = at(scenario, {{0, 10}, {216, 226}});  // half milliseconds
  scenario.time_limit = Nanoseconds{60 * sec};
  life(scenario);
  return scenario;
}

Scenario two_peers(std::uint32_t ports) {
  Scenario scenario = two_lives(AllowMulticast::never);
  scenario.dds.peers = ports;
  return scenario;
}

Scenario pruning(Scenario scenario) {
  scenario.dds.spdp.initial_prune_delay = Nanoseconds{30 * sec};
  scenario.dds.spdp.discovered_prune_delay = Nanoseconds{60 * sec};
  scenario.time_limit = Nanoseconds{120 * sec};
  return scenario;
}

const std::vector<LifeVector>& cyclone_life_vectors() {
  static const Table table = [] {
    Table t;
    add_outages(t);
    add_endpoints(t);
    add_restarts(t);
    add_peers(t);
    add_sizes(t);
    for (LifeVector& vector : t) {
      if (vector.scenario.time_limit < Nanoseconds{120 * sec}) {
        vector.scenario.time_limit = Nanoseconds{60 * sec};
      }
    }
    return t;
  }();
  return table;
}

}  // namespace stormproof::vectors
