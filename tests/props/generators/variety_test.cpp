// What 500 random scenarios have to contain: every choice of every knob, all implementations and
// services, durations of every order of magnitude, ties, losses, tiny queues. A generator that
// forgets one of them proves less than it seems to. The counts are printed.
#include <functional>
#include <iostream>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "model/implementations.hpp"
#include "model/simulator.hpp"
#include "props/generators/on_demand.hpp"
#include "props/generators/scenarios.hpp"
#include "tests/model/config/knobs/knob_list.hpp"

namespace stormproof::props {
namespace variety_test {

using model::Nanoseconds;
using model::Scenario;
using Json = model::config::Json;

constexpr std::uint64_t draws = 500;
constexpr std::uint64_t draws_on_demand = 200;

const std::vector<Scenario>& drawn() {
  static const std::vector<Scenario> scenarios = [] {
    std::vector<Scenario> list;
    for (std::uint64_t seed = 0; seed < draws; ++seed) list.push_back(draw_scenario(seed, 100));
    return list;
  }();
  return scenarios;
}

/// Of implementations that are drawn on demand only, because engines do not know their writer.
std::vector<Scenario> drawn_on_demand() {
  std::vector<Scenario> list;
  for (const model::ImplementationKind kind : model::implementations) {
    if (model::traits_of(kind).is_known_to_engines) continue;
    for (std::uint64_t seed = 0; seed < draws_on_demand; ++seed) {
      list.push_back(draw_scenario(seed, 100, {.implementation = kind}));
    }
  }
  for (std::uint64_t seed = 0; seed < 2 * draws_on_demand; ++seed) {
    list.push_back(draw_scenario(seed, 100, {.implementation = model::ImplementationKind::paper}));
    Dice dice{seed};
    draw_amendments(dice, list.back());
    list.push_back(
        draw_scenario(seed, 100, {.implementation = model::ImplementationKind::cyclone}));
    draw_goodbyes(dice, list.back());
  }
  for (std::uint64_t seed = 0; seed < 2 * draws_on_demand; ++seed) {
    const Scenario plain =
        draw_scenario(seed, 100, {.implementation = model::ImplementationKind::fastdds});
    Scenario later = plain;
    Dice of_later{seed};
    draw_version(of_later, later.dds);
    draw_types(of_later, later);
    list.push_back(std::move(later));
    Scenario radio = plain;
    radio.wireless.kind = model::ServiceKind::shared_channel;
    radio.wireless.packet_delays.clear();
    Dice dice{seed};
    draw_radio(dice, radio.wireless);
    list.push_back(radio);
    if (radio.wireless.service == model::ServedBy::unit) {
      draw_queue(dice, list.back().wireless);
    }
    radio.wireless.stages = model::WirelessProfile{}.stages;
    draw_fleet(dice, radio.deployment);
    draw_frame_loss(dice, radio.wireless);
    draw_processor(dice, radio);
    list.push_back(std::move(radio));
    for (const auto discovery : {model::Discovery::server, model::Discovery::super_client,
                                 model::Discovery::static_peers}) {
      list.push_back(plain);
      draw_discovery(seed, discovery, list.back());
    }
    Scenario several = plain;
    draw_discovery(seed, model::Discovery::server, several);
    draw_servers(dice, several);
    list.push_back(std::move(several));
  }
  return list;
}

/// Adds the values below `json` to `seen`; an element of a list is "*" in its key.
void collect(const Json& json, const std::string& key,
             std::map<std::string, std::map<std::string, int>>& seen) {
  if (json.is_object()) {
    for (const auto& [name, member] : json.items()) {
      collect(member, key.empty() ? name : key + "." + name, seen);
    }
  } else if (json.is_array() && !json.empty() && json.front().is_object()) {
    for (const Json& item : json) collect(item, key + ".*", seen);
  } else {
    ++seen[key][json.is_string() ? json.get<std::string>() : json.dump()];
  }
}

/// `allow_multicast: default` is another word as soon as the network is known, and a queue without
/// limits is none.
bool is_resolved(const std::string& key, const std::string& choice) {
  return (key == "dds.allow_multicast" && choice == "default") ||
         (key == "wireless.queue.discipline" && choice == "unlimited");
}
/// Keys that a random scenario does not have: the short form, what changes no run, the lease of
/// a profile, as a life is drawn with its own, and profiles of participants, whose keys are those
/// of the scenario's (mixes are drawn by tests/oracle/random_scenario.hpp).
bool is_left_out(const std::string& key) {
  for (const std::string_view part :
       {"deployment.hosts", "deployment.participants_per_host",
        "deployment.endpoints_per_participant", "deployment.nodes_per_participant",
        "deployment.schedule", "limits.", "vary.", "dds.unmodelled",
        "dds.max_participants_per_host", "dds.spdp.lease", "deployment.participants.*.dds"}) {
    if (key.starts_with(part)) return true;
  }
  return false;
}

TEST(Variety, EveryKnobVaries) {
  std::map<std::string, std::map<std::string, int>> seen;
  for (const auto& list : {drawn(), drawn_on_demand()}) {
    for (const Scenario& scenario : list) {
      collect(model::config::effective_json(scenario), "", seen);
    }
  }
  for (const model::config::KnobInfo& knob : model::config::scenario_knob_list()) {
    if (is_left_out(knob.key)) continue;
    const auto& values = seen[knob.key];
    std::size_t unwritten = 0;
    for (const std::string& choice : knob.choices) {
      if (is_resolved(knob.key, choice)) continue;
      if (!values.contains(choice) && knob.default_value.is_null()) {
        ++unwritten;  // the usual word
        continue;
      }
      EXPECT_GE(values.contains(choice) ? values.at(choice) : 0, 25) << knob.key << ": " << choice;
    }
    EXPECT_LE(unwritten, 1U) << knob.key;
    EXPECT_GT(values.size() + unwritten, knob.choices.empty() ? 0U : 1U) << knob.key;
    if (knob.choices.empty() && !knob.key.ends_with(".name")) {
      EXPECT_GE(values.size(), 3U) << knob.key;
    }
  }
}

/// A timer or delay of a scenario.
struct Timer {
  const char* name;
  Nanoseconds (*of)(const Scenario&);
};

constexpr Timer timers[] = {
    {"period", [](const Scenario& s) { return s.dds.spdp.period; }},
    {"startup_period", [](const Scenario& s) { return s.dds.spdp.startup_period; }},
    {"heartbeat_period", [](const Scenario& s) { return s.dds.sedp.heartbeat_period; }},
    {"heartbeat_response_delay",
     [](const Scenario& s) { return s.dds.sedp.heartbeat_response_delay; }},
    {"nack_response_delay", [](const Scenario& s) { return s.dds.sedp.nack_response_delay; }},
    {"nack_suppression_duration",
     [](const Scenario& s) { return s.dds.sedp.nack_suppression_duration; }},
    {"initial_acknack_delay", [](const Scenario& s) { return s.dds.sedp.initial_acknack_delay; }},
    {"min_period", [](const Scenario& s) { return s.dds.sedp.adaptive.min_period; }},
    {"one_way", [](const Scenario& s) { return s.wireless.one_way; }},
};

/// 1 ns to 1 s, and for periods beyond it.
TEST(Variety, DurationsOverNineOrdersOfMagnitude) {
  for (const Timer& timer : timers) {
    std::map<std::size_t, int> by_digits;
    for (const Scenario& s : drawn()) {
      const std::int64_t t = timer.of(s).count();
      if (t > 0) ++by_digits[std::to_string(t).size()];
    }
    std::cout << timer.name << ':';
    for (const auto& [digits, count] : by_digits) std::cout << " 1e" << digits - 1 << " " << count;
    std::cout << '\n';
    for (std::size_t digits = 1; digits <= 9; ++digits) {
      EXPECT_TRUE(by_digits.contains(digits)) << timer.name << ", " << digits << " digits";
    }
  }
}

/// How often two events of different subjects, neither of them a dispatch, come at the same time.
class TieCounter : public model::Probe {
 public:
  void event_started(const model::Event& event) override {
    if (event.event_class() == model::EventClass::dispatch) return;
    if (event.time == last_.time && event.subject != last_.subject) ++ties;
    last_ = event;
  }
  int ties = 0;

 private:
  model::Event last_{Nanoseconds{-1}, 0, 0, 0, {}};
};

struct Share {
  const char* name;
  int least;
  std::function<bool(const Scenario&)> has;
};

bool has_equal_timers(const Scenario& s) {
  const model::SedpProfile& sedp = s.dds.sedp;
  const std::set<Nanoseconds> different{sedp.heartbeat_period, sedp.heartbeat_response_delay,
                                        sedp.nack_response_delay, sedp.nack_suppression_duration,
                                        sedp.initial_acknack_delay};
  return different.size() < 5;
}

bool sums_coincide(const Scenario& s) {
  const model::SedpProfile& sedp = s.dds.sedp;
  const std::int64_t reply = (sedp.heartbeat_response_delay + sedp.nack_response_delay).count();
  const std::int64_t sum = reply + sedp.nack_suppression_duration.count();
  if (reply == 0) return false;
  return sedp.heartbeat_period.count() % reply == 0 || sedp.heartbeat_period.count() % sum == 0 ||
         sedp.initial_acknack_delay.count() == reply || sedp.initial_acknack_delay.count() == sum ||
         sedp.nack_suppression_duration.count() == reply;
}

bool starts_nearly_tie(const Scenario& s) {
  for (const model::Participant& a : s.deployment.participants) {
    for (const model::Participant& b : s.deployment.participants) {
      if (a.start + Nanoseconds{1} == b.start) return true;
    }
  }
  return false;
}

bool start_differs(const Scenario& s) {
  const auto& all = s.deployment.participants;
  return std::ranges::any_of(all, [&](const auto& p) { return p.start != all.front().start; });
}

const std::vector<Share>& shares() {
  static const std::vector<Share> list{
      {"equal timers", 100, has_equal_timers},
      {"sums of timers coincide", 100, sums_coincide},
      {"equal starts", 100, [](const Scenario& s) { return !start_differs(s); }},
      {"starts 1 ns apart", 25, starts_nearly_tie},
      {"different starts", 200, start_differs},
      {"losses", 200, [](const Scenario& s) { return !s.wireless.lost_packets.empty(); }},
      {"packet delays", 25, [](const Scenario& s) { return !s.wireless.packet_delays.empty(); }},
      {"queue of one byte", 25,
       [](const Scenario& s) { return s.wireless.source_queue_bytes == model::Bytes{1}; }},
      {"unlimited queue", 25,
       [](const Scenario& s) {
         return s.wireless.source_queue_bytes == model::WirelessProfile::unlimited;
       }},
      {"four stages", 50, [](const Scenario& s) { return s.wireless.stages.size() == 4; }},
      {"four hosts", 25, [](const Scenario& s) { return s.deployment.host_count() == 4; }},
      {"no user endpoint", 10,
       [](const Scenario& s) {
         return std::ranges::all_of(s.deployment.participants, [](const auto& p) {
           return p.publications + p.subscriptions == 0;
         });
       }},
      {"slow creation", 100,
       [](const Scenario& s) {
         return s.dds.implementation == model::ImplementationKind::fastdds &&
                std::ranges::any_of(s.deployment.participants,
                                    [](const auto& p) { return p.endpoints_done > p.start; });
       }},
      {"constant interval of initial ACKNACKs", 100,
       [](const Scenario& s) {
         return s.dds.sedp.initial_acknack_delay > Nanoseconds{0} &&
                s.dds.sedp.initial_acknack_interval == model::InitialAckNackInterval::constant;
       }},
      {"events at the same time", 250,
       [](const Scenario& s) {
         TieCounter counter;
         model::RunOptions options;
         options.probe = &counter;
         options.max_events = 2'000;
         (void)model::simulate(s, options);
         return counter.ties > 100;
       }},
  };
  return list;
}

TEST(Variety, Shares) {
  for (const Share& share : shares()) {
    const auto count = std::ranges::count_if(drawn(), share.has);
    std::cout << share.name << ": " << count << " of " << draws << '\n';
    EXPECT_GE(count, share.least) << share.name;
    EXPECT_LE(count, static_cast<int>(draws * 19 / 20)) << share.name;
  }
}

/// The check notices a generator that leaves something out.
TEST(Variety, APlainScenarioHasNoneOfThem) {
  Scenario plain;
  plain.deployment = model::Deployment::homogeneous(2, 1, 2);
  const std::set<std::string> there{"equal timers", "equal starts"};  // τ_A = τ_S
  for (const Share& share : shares()) {
    if (std::string{share.name} == "events at the same time") continue;
    EXPECT_EQ(share.has(plain), there.contains(share.name)) << share.name;
  }
}

}  // namespace variety_test
}  // namespace stormproof::props
