// Pages and data of compositions: nothing is left out; what two of them share.
#include "checker/presentation/composition/composition_drawing.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/presentation/composition/composition_comparison.hpp"
#include "checker/presentation/document/render.hpp"
#include "fsm/composition/compositions.hpp"

namespace stormproof::draw {
namespace composition_drawing_test {

using fsm::composition::CompositionInfo;
using fsm::composition::EffectInfo;
using fsm::composition::RuleInfo;
using Is = RuleComparison::Is;

const std::vector<CompositionInfo>& all() {
  static const std::vector<CompositionInfo> compositions = fsm::composition::compositions();
  return compositions;
}

std::vector<std::string> ids(const CompositionInfo& composition) {
  std::vector<std::string> ids;
  for (const auto* rules : {&composition.rules, &composition.procedures, &composition.steps}) {
    for (const RuleInfo& rule : *rules) {
      ids.push_back(rule.id);
      for (const EffectInfo& effect : rule.effects) ids.push_back(effect.id);
    }
  }
  return ids;
}

/// Pages are read before they change: `stormproof draw composition --dds PROFILE -o FILE`.
TEST(CompositionPage, IsTheOneThatWasRead) {
  for (const CompositionInfo& composition : all()) {
    const std::string name = std::string{composition.name} + ".txt";
    std::ostringstream expected;
    expected << std::ifstream{STORMPROOF_SOURCE_DIR "/tests/checker/presentation/composition/" +
                              name}
                    .rdbuf();
    EXPECT_EQ(to_text(composition_document(composition)), expected.str()) << name;
  }
}

TEST(CompositionPage, HasEveryRuleAndEffect) {
  for (const CompositionInfo& composition : all()) {
    const std::string text = to_text(composition_document(composition));
    for (const std::string& id : ids(composition)) {
      EXPECT_NE((text + "\n").find(id + (id.find('.') == std::string::npos ? "" : "\n")),
                std::string::npos)
          << id;
    }
  }
}

TEST(CompositionJson, HasEveryRuleAndEffect) {
  for (const CompositionInfo& composition : all()) {
    const nlohmann::ordered_json json = composition_json(composition);
    std::vector<std::string> found;
    for (const char* group : {"rules", "procedures", "steps"}) {
      for (const auto& rule : json[group]) {
        found.push_back(rule["id"]);
        for (const auto& effect : rule["effects"]) found.push_back(effect["id"]);
      }
    }
    EXPECT_EQ(found, ids(composition));
    EXPECT_EQ(json["machines"].size(), composition.parts.size());
    EXPECT_EQ(json["packets"].size(), composition.packets.size());
  }
}

TEST(CompositionJson, SaysConditionsAndDelays) {
  const nlohmann::ordered_json json = composition_json(all()[0]);
  for (const auto& rule : json["rules"]) {
    if (rule["id"] != "AckNackArrives") continue;
    EXPECT_EQ(rule["trigger"], "received");
    EXPECT_EQ(rule["cause"], "AckNack");
    EXPECT_EQ(rule["owner"], "relation");
    const auto& effect = rule["effects"][3];
    EXPECT_EQ(effect["kind"], "after");
    EXPECT_EQ(effect["delay"], "NackResponseDelay");
    EXPECT_NE(effect["condition"].get<std::string>().find("if some C.requested"),
              std::string::npos);
  }
}

/// The keys that readers of the data rely on, for every effect of every group.
TEST(CompositionJson, HasTheSameKeysForEveryEffect) {
  for (const CompositionInfo& composition : all()) {
    const nlohmann::ordered_json json = composition_json(composition);
    for (const char* key : {"machines", "rules", "packets"}) ASSERT_TRUE(json[key].is_array());
    for (const char* group : {"rules", "procedures", "steps"}) {
      for (const auto& rule : json[group]) {
        if (group == std::string{"rules"}) {
          EXPECT_TRUE(rule["trigger"].is_string() && rule["owner"].is_string()) << rule["id"];
        }
        for (const auto& effect : rule["effects"]) {
          const std::string id = effect["id"];
          const bool after = effect["kind"] == "after";
          EXPECT_TRUE(id.starts_with(rule["id"].get<std::string>() + ".")) << id;
          EXPECT_TRUE(effect["condition"].is_null() || effect["condition"] != "") << id;
          ASSERT_TRUE(effect.contains("condition") && effect.contains("delay")) << id;
          EXPECT_EQ(effect["delay"].is_string(), after) << id;
          EXPECT_TRUE(!after || effect["detail"].is_null()) << id;
          EXPECT_TRUE(effect["kind"] != "at" || effect["detail"].is_string()) << id;
        }
      }
    }
  }
}

TEST(CompositionComparison, FindsNoDifferenceToItself) {
  for (const CompositionInfo& composition : all()) {
    const CompositionComparison comparison = compare(composition, composition);
    EXPECT_EQ(comparison.count("rule", Is::same), composition.rules.size());
    EXPECT_TRUE(comparison.things.empty());
    EXPECT_TRUE(std::ranges::all_of(comparison.rules,
                                    [](const RuleComparison& r) { return r.is == Is::same; }));
  }
}

TEST(CompositionComparison, ReportsAMissingEffectAndWhoReliesOnIt) {
  CompositionInfo changed = all()[0];
  auto& procedure = *std::ranges::find(changed.procedures, "TakeHeartbeat", &RuleInfo::id);
  procedure.effects.pop_back();
  const CompositionComparison comparison = compare(all()[0], changed);
  const auto of = [&](std::string_view id) {
    return *std::ranges::find(comparison.rules, id, &RuleComparison::id);
  };
  ASSERT_EQ(of("TakeHeartbeat").is, Is::different);
  ASSERT_EQ(of("TakeHeartbeat").effects.size(), 1U);
  EXPECT_EQ(of("TakeHeartbeat").effects.front().first, "TakeHeartbeat.3");
  EXPECT_EQ(of("TakeHeartbeat").effects.front().second, "");
  EXPECT_EQ(of("HeartbeatArrives").is, Is::relies);
  EXPECT_EQ(of("DataArrives").is, Is::relies);
  EXPECT_EQ(of("RepairIsDue").is, Is::same);
}

TEST(CompositionComparison, OfTheImplementationsIsSaidOnAPage) {
  const CompositionComparison comparison = compare(all()[0], all()[1]);
  const std::string text = to_text(comparison_document(comparison));
  EXPECT_NE(text.find(" rules are the same"), std::string::npos);
  EXPECT_NE(text.find("RepairIsDue"), std::string::npos);
  EXPECT_NE(text.find("QueueIsSent"), std::string::npos);
  EXPECT_EQ(comparison_json(comparison)["comparisons"].size(), comparison.rules.size());
}

}  // namespace composition_drawing_test
}  // namespace stormproof::draw
