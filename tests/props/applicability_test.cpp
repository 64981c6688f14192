// Which properties speak of Cyclone DDS: what certificates from its rules prove, what monitors that
// know it observe, and no more. And which of a Discovery Server: those that speak of Fast DDS's
// exchange do so of what clients tell it.
#include "props/applicability.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "model/implementations.hpp"
#include "props/monitor.hpp"
#include "props/property.hpp"

namespace stormproof::props {
namespace applicability_test {

model::Scenario cyclone() {
  model::Scenario scenario;
  scenario.dds.implementation = model::ImplementationKind::cyclone;
  return scenario;
}
bool is_watched(const model::Scenario& scenario, std::string_view property) {
  const std::vector<std::string_view> watched = monitored_properties(scenario);
  return std::ranges::find(watched, property) != watched.end();
}

TEST(CycloneDds, IsSpokenOfByWhatItsRulesProve) {
  for (const char* const property : {"safety.ack-implies-received", "safety.snapshot"}) {
    EXPECT_EQ(applicability_of(property, cyclone()).why_not, "") << property;
    EXPECT_EQ(applicability_of(property, cyclone()).why_not_provable, "") << property;
    EXPECT_TRUE(is_watched(model::Scenario{}, property)) << property;
    EXPECT_TRUE(is_watched(cyclone(), property)) << property;
  }
}

TEST(CycloneDds, IsSpokenOfByWhatItsMonitorsObserve) {
  for (const char* const property : {"composition.followed", "safety.repair-only-if-asked",
                                     "live.no-stall", "storm.feedback-gain"}) {
    EXPECT_EQ(applicability_of(property, cyclone()).why_not, "") << property;
    EXPECT_TRUE(is_watched(cyclone(), property)) << property;
  }
}

TEST(CycloneDds, IsSpokenOfByTheExplorerWhereNoCertificateIs) {
  const auto is_explored = [](const char* property, const model::Scenario& scenario) {
    const Applicability answer = applicability_of(property, scenario);
    return answer.is_decided_by(Engine::explorer) && !answer.is_decided_by(Engine::tables);
  };
  for (const char* const property : {"safety.repair-only-if-asked", "live.no-stall"}) {
    EXPECT_TRUE(is_explored(property, cyclone())) << property;
    EXPECT_FALSE(is_explored(property, model::Scenario{})) << property;
    EXPECT_EQ(applicability_of(property, cyclone()).why_not_provable, "") << property;
  }
  for (const char* const property : {"safety.ack-implies-received", "storm.feedback-gain"}) {
    EXPECT_FALSE(is_explored(property, cyclone())) << property;
  }
  EXPECT_NE(applicability_of("storm.feedback-gain", cyclone()).why_not_provable, "");
}

TEST(CycloneDds, IsNotSpokenOfByPropertiesOfOtherWriters) {
  for (const char* const property :
       {"timer.single-heartbeat", "timer.suppression-honoured", "live.completion",
        "live.quiescence", "storm.single-copy", "composition.pending"}) {
    EXPECT_NE(applicability_of(property, cyclone()).why_not, "") << property;
    EXPECT_EQ(applicability_of(property, model::Scenario{}).why_not, "") << property;
  }
}

/// What is proved of channels that lose nothing says nothing of queues that drop; what a run shows,
/// it still shows.
TEST(Queues, ThatDropLeaveWhatRunsShow) {
  model::Scenario scenario;
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  scenario.wireless.service = model::ServedBy::unit;
  scenario.wireless.queue.emplace();
  const auto names_queue = [](std::string_view why) {
    return why.find("wireless.queue") != std::string_view::npos;
  };
  EXPECT_FALSE(names_queue(applicability_of("live.completion", scenario).why_not)) << "unlimited";
  scenario.wireless.queue = model::QueueManagement{.discipline = model::QueueDiscipline::codel};
  for (const char* const property :
       {"live.completion", "live.no-stall", "storm.cannot-start", "safety.conservation"}) {
    EXPECT_TRUE(names_queue(applicability_of(property, scenario).why_not)) << property;
  }
  const Applicability observed = applicability_of("safety.ack-implies-received", scenario);
  EXPECT_EQ(observed.why_not, "");
  EXPECT_TRUE(names_queue(observed.why_not_provable)) << observed.why_not_provable;
  EXPECT_TRUE(is_watched(scenario, "composition.followed"));
}

TEST(Lookups, ThatAreFilteredAreNotFollowedWhereSendersStall) {
  model::Scenario scenario;
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  scenario.dds.version.typelookup_filter = model::LookupFilter::answers;
  EXPECT_TRUE(is_watched(scenario, "composition.followed"));
  scenario.wireless.sender = model::Sender::stalls;
  EXPECT_FALSE(is_watched(scenario, "composition.followed"));
  scenario.dds.version.typelookup_filter = model::LookupFilter::none;
  EXPECT_TRUE(is_watched(scenario, "composition.followed"));
}

TEST(Server, IsSpokenOfByWhatItsClientsTellIt) {
  for (const model::Discovery discovery :
       {model::Discovery::server, model::Discovery::super_client}) {
    model::Scenario scenario;
    scenario.dds.implementation = model::ImplementationKind::fastdds;
    scenario.dds.discovery = discovery;
    for (const char* const property : {"safety.ack-implies-received", "safety.repair-only-if-asked",
                                       "safety.snapshot", "timer.single-heartbeat"}) {
      EXPECT_EQ(applicability_of(property, scenario).why_not, "") << property;
      EXPECT_EQ(applicability_of(property, scenario).why_not_provable, "") << property;
      EXPECT_TRUE(is_watched(scenario, property)) << property;
    }
    for (const char* const property :
         {"safety.ack-stable", "timer.suppression-honoured", "storm.feedback-gain"}) {
      EXPECT_TRUE(is_watched(scenario, property)) << property;
      EXPECT_NE(applicability_of(property, scenario).why_not_provable, "") << property;
    }
    EXPECT_TRUE(is_watched(scenario, "composition.followed"));
    EXPECT_EQ(applicability_of("composition.live", scenario).why_not, "");
    EXPECT_FALSE(is_watched(scenario, "composition.live"));
    for (const char* const property :
         {"composition.pending", "order.commutation", "live.no-stall", "live.completion",
          "live.quiescence", "storm.single-copy", "storm.cannot-start"}) {
      EXPECT_NE(applicability_of(property, scenario).why_not, "") << property;
    }
    const model::ImplementationKind kind = model::kind_of(scenario.dds);
    EXPECT_TRUE(applicability_of("safety.snapshot", scenario).is_about_clients);
    EXPECT_FALSE(applicability_of("composition.followed", scenario).is_about_clients);
    EXPECT_NE(statement_of(*find_property("safety.snapshot"), kind).find("tell the server"),
              std::string::npos);
  }
}

model::Scenario mixed(model::ImplementationKind implementation) {
  model::Scenario scenario;
  scenario.dds.implementation = implementation;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  model::DdsProfile other = scenario.dds;
  other.spdp.period += model::Nanoseconds{1};
  scenario.deployment.participants[1].dds = other;
  return scenario;
}

TEST(Mixes, AreSpokenOfByWhatCountsOnNoProfile) {
  const model::Scenario scenario = mixed(model::ImplementationKind::fastdds);
  for (const char* const property :
       {"composition.followed", "safety.ack-implies-received", "safety.repair-only-if-asked",
        "timer.suppression-honoured", "live.no-stall", "safety.conservation"}) {
    EXPECT_TRUE(is_watched(scenario, property)) << property;
  }
  for (const char* const property : {"live.completion", "live.quiescence", "storm.single-copy",
                                     "storm.free-threshold", "storm.cannot-start"}) {
    EXPECT_NE(applicability_of(property, scenario).why_not, "") << property;
    EXPECT_FALSE(is_watched(scenario, property)) << property;
  }
  EXPECT_FALSE(is_watched(mixed(model::ImplementationKind::cyclone), "live.no-stall"));
}

TEST(Mixes, AreProvedByNoEngine) {
  for (const Property& property : catalogue()) {
    const Applicability answer =
        applicability_of(property, mixed(model::ImplementationKind::fastdds));
    if (property.about == Vocabulary::everything) continue;
    for (const Engine engine :
         {Engine::tables, Engine::explorer, Engine::timelines, Engine::calculus}) {
      EXPECT_FALSE(answer.is_decided_by(engine)) << property.id;
    }
  }
}

TEST(Mixes, HaveNoProfileThatIsChangedForAll) {
  EXPECT_NE(why_profile_is_not_changed(mixed(model::ImplementationKind::fastdds)), "");
  model::Scenario same = mixed(model::ImplementationKind::fastdds);
  same.deployment.participants[1].dds = same.dds;
  EXPECT_EQ(why_profile_is_not_changed(same), "");
}

}  // namespace applicability_test
}  // namespace stormproof::props
