// specs/schema/output holds what every verb says of its own JSON (`--json-schema`). To renew the
// files after a change: STORMPROOF_UPDATE_GOLDEN=1. And the vocabulary: a key has one type, whoever
// prints it. That the JSON of every verb is as its schema says, tests/cli/repeat_test.cpp holds.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/checker/presentation/json/schema_errors.hpp"
#include "tests/files.hpp"

namespace schema_test {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Errors = std::vector<std::string>;

const char* const verbs[] = {"simulate",     "check",
                             "fuzz",         "sensitivity",
                             "tune",         "diff",
                             "coverage",     "conform",
                             "validate",     "capture summarize",
                             "replay",       "sweep",
                             "profile show", "profile lint",
                             "reproduce",    "mutate",
                             "draw",         "properties",
                             "list",         "doctor",
                             "watch",        "compare-discovery",
                             "museum",       "launch",
                             "fix",          "survive"};

std::string output_of(const std::string& arguments) {
  return stormproof::files::output_of(STORMPROOF_PROGRAM " " + arguments);
}

fs::path file_of(std::string verb) {
  std::replace(verb.begin(), verb.end(), ' ', '-');
  return fs::path{STORMPROOF_SPECS_DIR "/schema/output"} / (verb + ".schema.json");
}

using stormproof::files::content;

TEST(OutputSchema, TheFilesSayWhatTheProgramSays) {
  const bool renew = std::getenv("STORMPROOF_UPDATE_GOLDEN") != nullptr;
  std::set<fs::path> files;
  for (const std::string verb : verbs) {
    const std::string said = output_of(verb + " --json-schema");
    ASSERT_FALSE(said.empty()) << verb;
    const fs::path file = file_of(verb);
    if (renew) std::ofstream{file} << said;
    EXPECT_EQ(content(file), said) << file;
    files.insert(file);
  }
  for (const auto& entry : fs::directory_iterator{file_of("x").parent_path()}) {
    EXPECT_TRUE(files.contains(entry.path())) << entry.path();
  }
}

TEST(OutputSchema, EveryVerbThatPrintsJsonHasOne) {
  for (const std::string verb : verbs) {
    EXPECT_NE(output_of(verb + " --help").find("json"), std::string::npos) << verb;
  }
}

TEST(OutputSchema, DrawingsAreAsTheirsSays) {
  const Json schema = Json::parse(content(file_of("draw")));
  for (const char* what : {"", "DescriptorRepair", "composition --dds fastdds-2.6.11",
                           "composition --compare paper fastdds-2.6.11"}) {
    const Json json = Json::parse(output_of(std::string{"draw --format json "} + what));
    EXPECT_EQ(stormproof::report::SchemaErrors(schema, json).found(), Errors{}) << what;
  }
}

// --- one key, one type --------------------------------------------------------------------------

/// Which types each key has, and where: "simulate", "diff Configuration".
using Types = std::map<std::string, std::map<std::string, std::set<std::string>>>;

/// `draw` prints tables and rules, which have names of their own (specs/guide/compositions.md).
bool has_the_vocabulary(const std::string& verb) { return verb != "draw"; }

/// Their keys are names of things, like those of a map: classes of messages, rules, verdicts.
const std::set<std::string> by_name = {
    "AllSizes",  "AllTraffic",       "BusyByClass",    "ByLaw",          "ByProperty",
    "ByRule",    "HeartbeatFigures", "LatencyByClass", "LoopbackCounts", "MeasuresOf",
    "Standings", "Totals",           "Timeline",       "TrafficFigures", "VerdictByReach"};

/// One name for different things, on purpose.
const std::map<std::string, const char*> several = {
    {"completed", "of one run whether, of several how many"},
    {"before", "of whatever has changed"},
    {"after", "of whatever has changed"},
    {"profile", "in the rows of `coverage` its name: others read them"},
    {"storm", "in `doctor` whether it is one, in `check` how it is judged"},
    {"estimate", "may be infinite in `diff`, which is a text"},
    {"low", "the same"},
    {"high", "the same"},
    {"observed", "over time, by step"},
    {"median", "over time, by step"},
    {"p5", "over time, by step"},
    {"p95", "over time, by step"},
};

class KeyTypes {
 public:
  explicit KeyTypes(const std::string& verb)
      : verb_{verb}, root_(Json::parse(content(file_of(verb)))) {}

  void add_to(Types& all) const {
    add_form(root_, verb_, all);
    for (const auto& [name, definition] : root_.at("$defs").items()) {
      if (!by_name.contains(name)) add_form(definition, verb_ + " " + name, all);
    }
  }

 private:
  void add_form(const Json& schema, const std::string& where, Types& all) const {
    for (const Json& form : schema.value("anyOf", Json::array())) add_form(form, where, all);
    const Json properties = schema.value("properties", Json::object());
    for (const auto& [key, member] : properties.items()) {
      std::set<std::string> types;
      add_types(member, types);
      for (const std::string& type : types) all[key][type].insert(where);
    }
  }

  void add_types(const Json& schema, std::set<std::string>& types) const {
    if (schema.is_boolean()) return;
    if (schema.contains("$ref")) types.insert(type_of(schema["$ref"].get<std::string>()));
    for (const Json& form : schema.value("anyOf", Json::array())) add_types(form, types);
    const Json type = schema.value("type", Json::array());
    for (const Json& one : type.is_array() ? type : Json::array({type})) {
      types.insert(one == "integer" ? "number" : one.get<std::string>());
    }
    types.erase("null");
  }

  /// Statistics of a number are that number, over several runs.
  std::string type_of(const std::string& reference) const {
    if (!reference.starts_with('#')) return "object";
    const Json& properties = root_.at(Json::json_pointer(reference.substr(1))).at("properties");
    for (const char* key : {"median", "estimate", "shift"}) {
      if (properties.contains(key)) return "number";
    }
    return "object";
  }

  std::string verb_;
  Json root_;
};

TEST(OutputSchema, AKeyHasOneType) {
  Types all;
  for (const std::string verb : verbs) {
    if (has_the_vocabulary(verb)) KeyTypes{verb}.add_to(all);
  }
  for (const auto& [key, why] : several) {
    EXPECT_GT(all[key].size(), 1U) << key << " is no exception any more (" << why << ')';
  }
  for (const auto& [key, types] : all) {
    if (several.contains(key) || types.size() <= 1) continue;
    std::string text;
    for (const auto& [type, places] : types) {
      text += "\n  " + type + ":";
      for (const std::string& place : places) text += " " + place + ";";
    }
    ADD_FAILURE() << key << text;
  }
}

}  // namespace schema_test
