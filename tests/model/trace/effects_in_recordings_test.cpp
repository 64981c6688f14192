// Recordings that name effects say what the composition says: what sends a packet can send it, what
// starts a timer starts the one whose rule runs when it is due; and they say nothing else than the
// recording without names.
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "fsm/composition/composition_info.hpp"
#include "model/composition_of.hpp"
#include "model/trace/replay.hpp"
#include "tests/model/trace/recording.hpp"

namespace stormproof::model::trace {
namespace effects_in_recordings_test {

using Json = nlohmann::ordered_json;
using fsm::composition::CompositionInfo;
using fsm::composition::EffectInfo;
using fsm::composition::RuleInfo;

class EffectsInRecordings : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const CompositionInfo& composition = composition_of(GetParam().scenario());
    for (const auto* list : {&composition.rules, &composition.procedures}) {
      for (const RuleInfo& rule : *list) {
        for (const EffectInfo& effect : rule.effects) effects[effect.id] = &effect;
      }
    }
    for (const RuleInfo& rule : composition.rules) rules[rule.id] = &rule;
  }
  const RuleInfo& rule_of(const std::string& effect) const {
    return *rules.at(effect.substr(0, effect.rfind('.')));
  }

  std::map<std::string, const EffectInfo*> effects;
  std::map<std::string, const RuleInfo*> rules;
};

/// The line without what names effects.
std::string without_effects(const std::string& line) {
  Json json = Json::parse(line);
  json.erase("effects");
  json.erase("started_by");
  for (const char* key : {"emitted", "looped_back"}) {
    if (!json.contains(key)) continue;
    for (Json& packet : json[key]) packet.erase("effect");
  }
  return json.dump();
}

TEST_P(EffectsInRecordings, AddNothingElse) {
  const Recording& plain = recorded(GetParam());
  const Recording named = record(GetParam().scenario(), {}, Effects::named);
  ASSERT_EQ(named.lines.size(), plain.lines.size());
  EXPECT_EQ(named.header["effects"], true);
  for (std::size_t k = 0; k < plain.lines.size(); ++k) {
    ASSERT_EQ(without_effects(named.lines[k]), Json::parse(plain.lines[k]).dump()) << k;
  }
}

TEST_P(EffectsInRecordings, PacketsAreSentByWhatCanSend) {
  for (const Json& event : record(GetParam().scenario(), {}, Effects::named).events) {
    std::set<std::string> happened;
    for (const Json& id : event.value("effects", Json::array())) happened.insert(id);
    for (const char* key : {"emitted", "looped_back"}) {
      for (const Json& packet : event.value(key, Json::array())) {
        ASSERT_TRUE(packet.contains("effect")) << event;
        const std::string id = packet["effect"];
        EXPECT_TRUE(happened.contains(id)) << event;
        ASSERT_TRUE(effects.contains(id)) << event;
        const std::string_view kind = effects.at(id)->kind;
        EXPECT_TRUE(kind == "emit" || kind == "perform") << event;
      }
    }
  }
}

/// What is due runs the rule of the timer that its starter names.
TEST_P(EffectsInRecordings, TimersAreStartedByWhatStartsThem) {
  for (const Json& event : record(GetParam().scenario(), {}, Effects::named).events) {
    const bool of_rules = event["class"] == "protocol" && event["event"] != "source_completion" &&
                          event["event"] != "endpoint_creation";
    ASSERT_EQ(event.contains("started_by"), of_rules && !event["cause"].is_null()) << event;
    if (!event.contains("started_by")) continue;
    ASSERT_TRUE(effects.contains(event["started_by"])) << event;
    const EffectInfo& starter = *effects.at(event["started_by"]);
    if (!event.contains("effects")) continue;  // it had been cancelled
    const RuleInfo& rule = rule_of(event["effects"].front());
    EXPECT_EQ(rule.trigger, "due") << event;
    if (starter.kind == "perform") continue;  // by the contract of a step
    EXPECT_TRUE(starter.kind == "at" || starter.kind == "after") << event;
    EXPECT_EQ(rule.cause, starter.target) << event;
  }
}

TEST_P(EffectsInRecordings, AreInTheTimelineToo) {
  const Timeline& plain = recorded_timeline(GetParam());
  Timeline named = record_timeline(GetParam().scenario(), {}, Effects::named);
  std::size_t names = 0;
  for (Json& event : named.document["traceEvents"]) {
    if (!event.contains("args")) continue;
    Json kept = Json::object();
    for (const auto& [key, value] : event["args"].items()) {
      if (key != "started by" && !key.starts_with("effect of ")) {
        kept[key] = value;
      } else {
        EXPECT_TRUE(effects.contains(value)) << event;
        ++names;
      }
    }
    event["args"] = kept;
    if (kept.empty()) event.erase("args");
  }
  EXPECT_GT(names, 0U);
  EXPECT_EQ(named.document, plain.document);
}

INSTANTIATE_TEST_SUITE_P(Cases, EffectsInRecordings, testing::ValuesIn(trace_cases()), CaseName{});
INSTANTIATE_TEST_SUITE_P(Lives, EffectsInRecordings,
                         testing::Values(Case{"fastdds", living_scenario()}), CaseName{});

Verdict replayed(const std::string& text) {
  const auto file = std::filesystem::path{testing::TempDir()} / "effects.jsonl";
  std::ofstream{file} << text;
  const auto result = replay(file.string(), config::SpecPath{});
  EXPECT_TRUE(result);
  return result ? result->verdict : Verdict::stopped;
}

TEST(EffectsInTraces, AreReplayed) {
  const Recording named = record(case_named("hosts2x1x2"), {}, Effects::named);
  EXPECT_EQ(replayed(named.text), Verdict::identical);
  std::string wrong = named.text;
  const std::size_t at = wrong.find("AckNackDue.");
  ASSERT_NE(at, std::string::npos);
  wrong[at + 11] = '9';
  EXPECT_EQ(replayed(wrong), Verdict::different);
}

}  // namespace effects_in_recordings_test
}  // namespace stormproof::model::trace
