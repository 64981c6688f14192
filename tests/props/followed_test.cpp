// composition.followed: correct runs are what the rules say, and a mistake at an effect is noticed
// whenever it changes what some run does.
#include <map>
#include <memory>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "fsm/composition/compositions.hpp"
#include "model/composition_of.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/implementations.hpp"
#include "props/generators/on_demand.hpp"
#include "tests/oracle/random_scenario.hpp"
#include "tests/oracle/sharp_scenario.hpp"
#include "tests/props/monitored_run.hpp"
#include "tests/props/run_digest.hpp"
#include "tests/vectors/cyclone_life_vectors.hpp"

namespace stormproof::props {
namespace followed_test {

using fsm::composition::EffectMutation;
using model::ImplementationKind;
using model::Scenario;

std::unique_ptr<Monitor> follow(const Scenario& scenario, model::RunOptions options = {}) {
  std::unique_ptr<Monitor> monitor = make_monitor("composition.followed", scenario);
  options.probe = monitor.get();
  (void)simulate(scenario, options);
  return monitor;
}

std::uint64_t deeds_of(const Scenario& scenario, model::RunOptions options) {
  RunDigest run;
  options.probe = &run;
  (void)simulate(scenario, options);
  return run.digest;
}

/// Rules that are followed beside a run ask the participants that the run asks.
TEST(FollowedMixes, AreWhatTheRulesSay) {
  model::RunOptions options;
  options.max_events = 10'000;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Scenario scenario = oracle::random_mixed_scenario(seed);
    const auto monitor = follow(scenario, options);
    if (!monitor->violation()) continue;
    ADD_FAILURE() << "seed " << seed << ", event " << monitor->violation()->event << ": "
                  << monitor->violation()->reason;
    break;
  }
}

class Followed : public testing::TestWithParam<ImplementationKind> {};

TEST_P(Followed, CorrectRunsAreWhatTheRulesSay) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Scenario scenario = oracle::random_scenario(seed, GetParam());
    if (seed % 2 == 1) scenario.run_until = model::RunUntil::time_limit;
    const auto monitor = follow(scenario);
    if (!monitor->violation()) continue;
    ADD_FAILURE() << "seed " << seed << ", event " << monitor->violation()->event << ": "
                  << monitor->violation()->reason;
  }
}

TEST(Followed, RunsWithStaticPeersAreWhatTheRulesSay) {
  model::RunOptions options;
  options.max_events = 10'000;
  int ports_of_nobody = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Scenario scenario = oracle::random_scenario(seed, ImplementationKind::fastdds);
    draw_discovery(seed, model::Discovery::static_peers, scenario);
    const auto monitor = follow(scenario, options);
    EXPECT_FALSE(monitor->violation()) << "seed " << seed << ": " << monitor->violation()->reason;
    if (scenario.deployment.host_count() < 2) continue;
    Scenario specification = scenario;
    ++specification.dds.peer_ports;  // one packet more to each other host
    const auto other = make_monitor("composition.followed", specification);
    model::RunOptions observed = options;
    observed.probe = other.get();
    (void)simulate(scenario, observed);
    ASSERT_TRUE(other->violation()) << "seed " << seed;
    const std::string& reason = other->violation()->reason;
    if (reason.find("a port that nobody has") != std::string::npos) ++ports_of_nobody;
  }
  EXPECT_GT(ports_of_nobody, 50);
}

/// Outages, a successor, endpoints that are created late and deleted, goodbyes, and peers.
TEST(Followed, LivesUnderCycloneDdsAreWhatTheRulesSay) {
  constexpr std::int64_t ms = 1'000'000;
  for (std::uint64_t seed = 0; seed < 48; ++seed) {
    Scenario scenario = vectors::two_lives(seed % 2 == 0 ? model::AllowMulticast::always
                                                         : model::AllowMulticast::spdp);
    if (seed % 3 == 2) scenario = vectors::pruning(vectors::two_peers(3));
    model::Life& life = *scenario.deployment.life;
    const auto at = [&](std::int64_t after) {
      return model::Nanoseconds{(12'000 + 100 * static_cast<std::int64_t>(seed) + after) * ms};
    };
    if (seed % 4 != 0) {
      life.outages.push_back(
          {0, 0, at(0), at(seed % 4 == 1 ? 3'000 : 13'000), model::Reach::all, model::Reach::host});
    }
    if (seed % 5 == 1) life.mute.push_back({1, at(500)});
    if (seed % 5 == 2) {
      const auto goodbye = seed % 2 == 0 ? model::Goodbye::yes : model::Goodbye::no;
      life.restarts.push_back({1, at(500), at(2'500), model::Identity::fresh, goodbye});
    }
    if (seed % 5 == 3) life.leaves.push_back({0, at(700)});
    if (seed % 7 < 3) life.endpoints.push_back({0, 1, 1, at(100), at(300)});
    if (seed % 7 == 4) life.deletions.push_back({.participant = 0, .subscription = 1, .at = at(0)});
    const auto monitor = follow(scenario);
    if (!monitor->violation()) continue;
    ADD_FAILURE() << "seed " << seed << ": " << monitor->violation()->reason;
  }
}

TEST(Followed, DrawnLivesUnderCycloneDdsAreWhatTheRulesSay) {
  model::RunOptions options;
  options.max_events = 20'000;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Scenario scenario = oracle::varied_cyclone_scenario(seed);
    Dice dice{seed};
    draw_goodbyes(dice, scenario);
    ASSERT_TRUE(model::config::is_valid(scenario)) << "seed " << seed;
    const auto monitor = follow(scenario, options);
    if (!monitor->violation()) continue;
    ADD_FAILURE() << "seed " << seed << ", event " << monitor->violation()->event << ": "
                  << monitor->violation()->reason;
  }
}

/// Clients or super clients of a server, or of several.
Scenario with_server(std::uint64_t seed) {
  Scenario scenario = oracle::random_scenario(seed, ImplementationKind::fastdds);
  using enum model::Discovery;
  draw_discovery(seed, seed % 4 < 2 ? server : super_client, scenario);
  Dice dice{seed};
  if (seed % 3 == 2) draw_servers(dice, scenario);
  return scenario;
}

TEST(Followed, RunsWithAServerAreWhatTheRulesSay) {
  model::RunOptions options;
  options.max_events = 30'000;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Scenario scenario = with_server(seed);
    if (seed % 2 == 1) scenario.run_until = model::RunUntil::time_limit;
    Dice dice{seed};
    if (seed % 5 == 4) draw_processor(dice, scenario);
    if (seed % 7 == 6) scenario.wireless.sender = model::Sender::stalls;
    const auto monitor = follow(scenario, options);
    if (!monitor->violation()) continue;
    ADD_FAILURE() << "seed " << seed << ", event " << monitor->violation()->event << ": "
                  << monitor->violation()->reason;
  }
}

/// What the server's database and relays do are steps that simulator and audit share; each has a
/// state of its own, by its own profile.
TEST(Followed, AServerThatDoesOtherwiseIsNoticed) {
  using Change = void (*)(Scenario&);
  const std::map<std::string, Change> others{
      {"everybody learns everything",
       [](Scenario& s) { s.dds.discovery = model::Discovery::super_client; }},
      {"each change is relayed once", [](Scenario& s) { s.dds.server.relay = model::Relay::once; }},
      {"clients do not know who the server is",
       [](Scenario& s) { s.dds.server.known = model::ServerKnown::locator; }},
      {"sending costs nothing",
       [](Scenario& s) { s.deployment.send_cost = model::Nanoseconds{0}; }},
      {"the routine runs more often",
       [](Scenario& s) { s.dds.server.server_routine_period = model::Nanoseconds{1'000'000}; }},
      {"descriptors are suppressed as announcements are", [](Scenario& s) {
         s.dds.sedp.nack_suppression_duration = s.dds.server.pdp_nack_suppression_duration;
       }}};
  const Scenario scenario =
      shipped("live-5x20", {"dds=fastdds-server-2.6.11", "deployment.participants_per_host=2"});
  ASSERT_FALSE(follow(scenario)->violation());
  for (const auto& [what, change] : others) {
    Scenario other = scenario;
    change(other);
    EXPECT_NE(run_monitored(scenario, other).violation("composition.followed"), nullptr) << what;
  }
}

/// What later versions of Fast DDS have, static peers and servers among it; lookups of types.
TEST(Followed, RunsOfLaterVersionsAreWhatTheRulesSay) {
  model::RunOptions options;
  options.max_events = 20'000;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Scenario scenario = seed % 2 == 0 ? oracle::random_lookup_scenario(seed)
                                      : oracle::varied_version_scenario(seed);
    if (seed % 7 == 6) {
      scenario.wireless.sender = model::Sender::stalls;
      scenario.dds.version.typelookup_filter = model::LookupFilter::none;
    }
    const auto monitor = follow(scenario, options);
    if (!monitor->violation()) continue;
    ADD_FAILURE() << "seed " << seed << ", event " << monitor->violation()->event << ": "
                  << monitor->violation()->reason;
  }
}

/// When a piggyback budget is used up is the host's: HEARTBEATs may ride or follow, or not.
bool is_of_the_budget(const EffectMutation& mistake) {
  return mistake.what.find("RefillBudget") != std::string::npos ||
         mistake.what.find("Charge") != std::string::npos;
}

/// Of mistakes at effects of rules for which `is_tried` holds: each that changes one of these runs
/// is noticed, and `percent` of them change one.
template <class IsTried>
void expect_noticed(const std::string& name, const std::vector<Scenario>& scenarios,
                    std::size_t percent, IsTried&& is_tried) {
  std::vector<std::uint64_t> correct;
  model::RunOptions options;
  options.max_events = 3'000;
  for (const Scenario& scenario : scenarios) correct.push_back(deeds_of(scenario, options));
  std::size_t noticed = 0;
  std::size_t tried = 0;
  for (const auto& composition : fsm::composition::compositions()) {
    if (composition.name != name) continue;
    for (const EffectMutation& mistake : fsm::composition::effect_mutations(composition)) {
      if (!is_tried(mistake.effect.substr(0, mistake.effect.find('.')))) continue;
      model::Mutation mutation;
      mutation.effects.push_back(mistake);
      options.mutation = &mutation;
      ++tried;
      bool changes = false;
      bool found = false;
      for (std::size_t k = 0; k < scenarios.size() && !found; ++k) {
        found = follow(scenarios[k], options)->violation().has_value();
        changes = changes || found || deeds_of(scenarios[k], options) != correct[k];
      }
      if (found) ++noticed;
      EXPECT_TRUE(found || !changes || is_of_the_budget(mistake))
          << mistake.effect << " " << word_of(mistake.change) << ": " << mistake.what;
    }
  }
  EXPECT_GT(tried, 0U);
  EXPECT_GT(100 * noticed, percent * tried) << noticed << " of " << tried;
}

TEST_P(Followed, MistakesAtEffectsThatChangeARunAreNoticed) {
  std::vector<Scenario> scenarios;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    scenarios.push_back(oracle::random_scenario(seed, GetParam()));
  }
  const bool has_types = GetParam() == ImplementationKind::fastdds;
  for (std::uint64_t seed = 1; has_types && seed <= 30; ++seed) {
    scenarios.push_back(oracle::random_lookup_scenario(seed));
  }
  const std::string name{model::composition_of(GetParam()).name};
  expect_noticed(name, scenarios, 80, [](const std::string&) { return true; });
}

TEST(Followed, MistakesAtEffectsWithAServerAreNoticed) {
  std::vector<Scenario> scenarios;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) scenarios.push_back(with_server(seed));
  expect_noticed("fastdds-server", scenarios, 80, [](const std::string&) { return true; });
}

/// A scenario of Fast DDS with a life. Nobody comes back in the very instant in which an endpoint
/// of its earlier life was to be created: the host creates that one, without those that its absence
/// has left out.
Scenario living(std::uint64_t seed) {
  Scenario scenario = oracle::random_scenario(seed, ImplementationKind::fastdds);
  Dice dice{seed};
  draw_life(dice, scenario);
  for (model::Restart& restart : scenario.deployment.life->restarts) {
    restart.start += model::Nanoseconds{1};
  }
  return scenario;
}

TEST(Followed, LivesOfFastDdsAreWhatTheRulesSay) {
  model::RunOptions options;
  options.max_events = 20'000;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const auto monitor = follow(living(seed), options);
    if (!monitor->violation()) continue;
    ADD_FAILURE() << "seed " << seed << ", event " << monitor->violation()->event << ": "
                  << monitor->violation()->reason;
  }
}

TEST(Followed, MistakesInLivesOfFastDdsAreNoticed) {
  std::vector<Scenario> scenarios;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) scenarios.push_back(living(seed));
  const std::set<std::string> of_lives{"HearFrom",     "LeaseIsChecked", "Forget",
                                       "ForgetReader", "ForgetWriter",   "Returns"};
  expect_noticed("fastdds-living", scenarios, 70,
                 [&](const std::string& rule) { return of_lives.contains(rule); });
}

/// The same with a server, which may be lost and come back, too.
Scenario living_with_server(std::uint64_t seed) {
  Scenario scenario = with_server(seed);
  Dice dice{seed};
  draw_life(dice, scenario);
  scenario.run_until = model::RunUntil::time_limit;
  scenario.time_limit = model::Nanoseconds{6'000'000'000};
  return scenario;
}

TEST(Followed, LivesWithAServerAreWhatTheRulesSay) {
  model::RunOptions options;
  options.max_events = 20'000;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto monitor = follow(living_with_server(seed), options);
    if (!monitor->violation()) continue;
    ADD_FAILURE() << "seed " << seed << ", event " << monitor->violation()->event << ": "
                  << monitor->violation()->reason;
  }
}

TEST(Followed, MistakesInLivesWithAServerAreNoticed) {
  std::vector<Scenario> scenarios;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) scenarios.push_back(living_with_server(seed));
  const std::set<std::string> of_lives{"HearFrom",    "LeaseIsChecked", "CloseClient",
                                       "LoseClient",  "LoseServer",     "ServerAnnounces",
                                       "CloseServer", "CloseLearners",  "ServerReturns"};
  expect_noticed("fastdds-server-living", scenarios, 70,
                 [&](const std::string& rule) { return of_lives.contains(rule); });
}

INSTANTIATE_TEST_SUITE_P(All, Followed, testing::ValuesIn(model::implementations),
                         [](const auto& tested) {
                           return std::string{model::traits_of(tested.param).name};
                         });

/// Small ones that lose many packets, among others; some whose senders stall.
Scenario of_cyclone(std::uint64_t seed) {
  Scenario scenario = oracle::varied_cyclone_scenario(seed);
  if (seed % 3 != 0 || scenario.wireless.kind != model::ServiceKind::shared_channel) {
    return scenario;
  }
  Dice dice{seed};
  draw_radio(dice, scenario.wireless);
  return scenario;
}

TEST(Followed, RunsOfCycloneDdsThatLoseOrStallAreWhatTheRulesSay) {
  model::RunOptions options;
  options.max_events = 10'000;
  int stalling = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Scenario scenario = of_cyclone(seed);
    if (scenario.wireless.sender == model::Sender::stalls) ++stalling;
    const auto monitor = follow(scenario, options);
    EXPECT_FALSE(monitor->violation()) << "seed " << seed << ": " << monitor->violation()->reason;
  }
  EXPECT_GT(stalling, 20);
}

/// What the rules of Cyclone DDS leave to their host is said exactly: each of these settings makes
/// another run somewhere.
TEST(Followed, AnotherEventThreadOfCycloneDdsIsNoticed) {
  using Change = void (*)(Scenario&);
  const std::vector<std::pair<const char*, Change>> changes{
      {"max_message_size", [](Scenario& s) { s.dds.sedp.max_message_size = model::Bytes{600}; }},
      {"max_rexmit_message_size",
       [](Scenario& s) { s.dds.sedp.max_rexmit_message_size = model::Bytes{900}; }},
      {"max_queued", [](Scenario& s) { s.dds.sedp.max_queued_rexmit_messages = 1; }},
      {"merging",
       [](Scenario& s) {
         const bool merges = s.dds.sedp.merge_queued_rexmit == model::MergeQueued::yes;
         s.dds.sedp.merge_queued_rexmit = merges ? model::MergeQueued::no : model::MergeQueued::yes;
       }},
      {"notification",
       [](Scenario& s) {
         const bool fresh = s.dds.sedp.notification == model::Notification::fresh_at_once;
         s.dds.sedp.notification =
             fresh ? model::Notification::in_order : model::Notification::fresh_at_once;
       }},
      {"send_time", [](Scenario& s) { s.deployment.send_time = model::Nanoseconds{77}; }},
      {"open", [](Scenario& s) {
         for (auto& p : s.deployment.participants) p.open = s.time_limit;
       }}};
  for (const auto& [name, change] : changes) {
    bool noticed = false;
    for (std::uint64_t seed = 0; seed < 60 && !noticed; ++seed) {
      const Scenario scenario = of_cyclone(seed);
      Scenario specification = scenario;
      change(specification);
      const auto monitor = make_monitor("composition.followed", specification);
      model::RunOptions options;
      options.max_events = 5'000;
      options.probe = monitor.get();
      (void)simulate(scenario, options);
      noticed = monitor->violation().has_value();
    }
    EXPECT_TRUE(noticed) << name;
  }
}

TEST(Followed, ADifferenceNamesTheRuleAndThePlaceOfTheEffect) {
  const Scenario scenario = shipped("wifi-5x20");
  Scenario specification = scenario;
  specification.dds.sedp.nack_response_delay = model::Nanoseconds{1'000};
  const MonitoredRun run = run_monitored(scenario, specification);
  ASSERT_NE(run.violation("composition.followed"), nullptr);
  const std::string& reason = run.violation("composition.followed")->reason;
  EXPECT_EQ(reason.find("At 1.515537595 s, AckNackArrives (paper.hpp:"), 0U) << reason;
  EXPECT_NE(reason.find("by the rules repair_generation of participant 0's pub stream at "
                        "participant 5 is scheduled for 1.515538595 s; in the run "
                        "repair_generation of participant 0's pub stream at participant 5 is "
                        "scheduled for 1.515637595 s."),
            std::string::npos)
      << reason;
}

TEST(Followed, ADifferenceNamesTheContentsOfMessages) {
  const Scenario scenario = shipped("smallest", {"dds=cyclonedds-0.10"});
  Scenario specification = scenario;
  specification.dds.sedp.max_rexmit_message_size = model::Bytes{900};
  const MonitoredRun run = run_monitored(scenario, specification);
  ASSERT_NE(run.violation("composition.followed"), nullptr);
  const std::string& reason = run.violation("composition.followed")->reason;
  EXPECT_EQ(reason.find("At 3.890378 ms, ThreadRuns (cyclone_thread.hpp:"), 0U) << reason;
  EXPECT_NE(
      reason.find("by the rules a message of 824 bytes of participant 1 to participant 0 with "
                  "DATA of publications with descriptor 0; DATA of publications with "
                  "descriptor 1; DATA of publications with descriptor 2 is sent; in the run "
                  "a message of 1380 bytes of participant 1 to participant 0 with "),
      std::string::npos)
      << reason;
}

}  // namespace followed_test
}  // namespace stormproof::props
