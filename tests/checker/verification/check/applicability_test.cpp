// Nobody but `applicability_of` decides what is said of a property: watched runs, verdicts, the
// frontier, the margin of `diff`, mutants and lists answer as it does, for every property and every
// implementation.
#include "props/applicability.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/engines/calculus/frontier.hpp"
#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/verification/check/check.hpp"
#include "checker/verification/check/gate.hpp"
#include "checker/verification/check/properties_report.hpp"
#include "checker/verification/mutate/concerns.hpp"
#include "model/composition_of.hpp"
#include "model/config/scenario_file.hpp"
#include "model/implementations.hpp"
#include "props/monitor.hpp"

namespace stormproof::checker {
namespace applicability_test {

using props::Applicability;
using props::Engine;
using props::Property;

model::Scenario shipped(const std::string& name, const std::vector<std::string>& overrides) {
  auto scenario =
      model::config::read_scenario(name, overrides, model::config::SpecPath::standard());
  EXPECT_TRUE(scenario) << name;
  return *scenario;
}

/// One of each implementation, and of what makes engines silent.
std::vector<model::Scenario> scenarios() {
  const auto with = [](const std::string& dds) { return shipped("smallest", {"dds=" + dds}); };
  std::vector<model::Scenario> list{shipped("smallest", {}),       with("fastdds-2.6.11"),
                                    with("fastdds-static-2.6.11"), with("cyclonedds-0.10"),
                                    with("fastdds-server-2.6.11"), shipped("rejoin-6401", {})};
  list.push_back(shipped("smallest", {"dds=fastdds-static-2.6.11", "dds.peer_ports=1"}));
  list.push_back(shipped("smallest", {"dds=fastdds-2.6.11", "hosts=live-bed"}));
  return list;
}

std::vector<const Property*> catalogue() {
  std::vector<const Property*> list;
  for (const Property& property : props::catalogue()) list.push_back(&property);
  return list;
}

/// What `applicability_of` lets the engine decide.
std::set<std::string_view> decided_by(Engine engine, const model::Scenario& scenario) {
  std::set<std::string_view> ids;
  for (const Property* property : catalogue()) {
    if (applicability_of(*property, scenario).is_decided_by(engine)) ids.insert(property->id);
  }
  return ids;
}

TEST(Applicability, CoversEveryImplementation) {
  std::set<model::ImplementationKind> kinds;
  for (const model::Scenario& scenario : scenarios()) kinds.insert(model::kind_of(scenario.dds));
  EXPECT_EQ(kinds.size(), model::implementation_traits.size());
}

TEST(Applicability, IsWhatRunsAreWatchedBy) {
  for (const model::Scenario& scenario : scenarios()) {
    const auto watched = props::monitored_properties(scenario);
    EXPECT_EQ((std::set<std::string_view>{watched.begin(), watched.end()}),
              decided_by(Engine::exact_run, scenario))
        << model::composition_of(scenario).name;
  }
}

/// Of what does not apply there are no findings, and the verdict says why, whether or not it is
/// asked for by name.
TEST(Applicability, IsWhatVerdictsSay) {
  smt::Claims claims{smt::Options{}};
  for (const model::Scenario& scenario : scenarios()) {
    for (const Property* property : catalogue()) {
      const Applicability answer = applicability_of(*property, scenario);
      if (answer.applies()) continue;
      const CheckReport report = check({property->id}, {scenario, claims, nullptr, 0, 12, {}});
      ASSERT_EQ(report.results.size(), 1U);
      EXPECT_EQ(report.results[0].decisive().how, answer.in_words()) << property->id;
      EXPECT_TRUE(report.results[0].decisive().engine.empty()) << property->id;
    }
  }
}

TEST(Applicability, IsWhatTheFrontierSays) {
  for (const model::Scenario& scenario : scenarios()) {
    const Applicability answer = props::applicability_of("storm.cannot-start", scenario);
    const calculus::Frontiers frontiers = calculus::frontier_of(scenario);
    EXPECT_EQ(frontiers.why_not, answer.why_not);
    EXPECT_EQ(frontiers.why_not_provable,
              answer.applies() ? answer.why_not_provable : std::string_view{});
    EXPECT_EQ(frontiers.of_loads.empty(), !answer.applies());
  }
}

/// A load at which somebody is at no port that is asked is not proved.
TEST(Applicability, IsAskedOfEveryVariantOfTheFrontier) {
  model::Scenario scenario = shipped("smallest", {"dds=fastdds-static-2.6.11", "dds.peer_ports=1",
                                                  "wireless={kind: constant_delay, one_way: 1ms}",
                                                  "dds.sedp.heartbeat_response_delay=2100us",
                                                  "dds.sedp.nack_response_delay=100us"});
  const calculus::Frontiers frontiers = calculus::frontier_of(scenario);
  ASSERT_EQ(frontiers.of_loads.size(), 3U);
  EXPECT_EQ(frontiers.of_loads[1].load, std::string{"participants of each host"});
  EXPECT_LE(frontiers.of_loads[1].most.value_or(1), 1U);
}

TEST(Applicability, IsWhatTheExplorerLooksAt) {
  smt::Claims claims{smt::Options{}};
  for (const model::Scenario& scenario : scenarios()) {
    const auto decided = decided_by(Engine::explorer, scenario);
    std::vector<std::string_view> others;
    for (const Property* property : catalogue()) {
      if (!decided.contains(property->id)) others.push_back(property->id);
    }
    EXPECT_TRUE(explorer::check(others, {scenario, claims, nullptr, 0, 12, {}}).empty());
  }
}

TEST(Applicability, IsWhatTheGateAndTheListSay) {
  const nlohmann::ordered_json listed = properties_json()["properties"];
  for (const model::Scenario& scenario : scenarios()) {
    const model::ImplementationKind kind = model::kind_of(scenario.dds);
    for (std::size_t k = 0; k < catalogue().size(); ++k) {
      const Property& property = *catalogue()[k];
      const Applicability answer = applicability_of(property, scenario);
      PropertyResult open;
      open.property = &property;
      open.findings.push_back({});
      CheckReport report;
      report.results.push_back(open);
      const Standing standing = judge(report, scenario.dds, {}).standings.front();
      EXPECT_EQ(standing, answer.is_promised() ? Standing::open : Standing::unknown);
      const auto* const named = std::ranges::find(model::implementations, kind);
      if (named == model::implementations.end() || model::traits_of(kind).is_known_to_engines ||
          kind == model::default_implementation) {
        continue;
      }
      const bool is_listed = listed[k].contains(std::string{model::traits_of(kind).name});
      EXPECT_EQ(is_listed, applicability_of(property, kind).applies()) << property.id;
    }
  }
}

TEST(Applicability, IsWhatMutantsOfRulesAreTriedOn) {
  const Property& followed = *props::find_property("composition.followed");
  for (std::size_t k = 0; k < model::implementation_traits.size(); ++k) {
    const auto kind = static_cast<model::ImplementationKind>(k);
    const mutate::Concerns concerns =
        mutate::where_is_composition(model::composition_of(kind).name);
    EXPECT_EQ(!concerns.empty(), applicability_of(followed, kind).applies());
  }
}

}  // namespace applicability_test
}  // namespace stormproof::checker
