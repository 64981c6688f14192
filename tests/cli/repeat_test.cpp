// The line "repeat it with" keeps its word: for every verb, the printed command goes through a
// shell and gives the same answer again. The scenario's path has a space and a quote in it. And the
// JSON is what the verb's schema in specs/schema/output says, no more and no less.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "tests/checker/presentation/json/schema_errors.hpp"
#include "tests/files.hpp"

namespace repeat_test {

namespace fs = std::filesystem;
namespace files = stormproof::files;
using Json = nlohmann::ordered_json;

struct Case {
  const char* name;
  const char* arguments;  ///< as a user types them; $S is the scenario, $C a capture
};

void PrintTo(const Case& tested, std::ostream* out) { *out << tested.name; }

const Case cases[] = {
    {"simulate", "simulate \"$S\" --set 'time_limit=3s' --set 'limits={completion: 1s}'"},
    {"samples",
     "simulate \"$S\" --samples 3 --seed 7 --compare fastdds-2.6.11 --no-progress --set "
     "'deployment={hosts: 2, participants_per_host: 1, endpoints_per_participant: 1, schedule: "
     "{start: [0ms, 20ms], endpoints_done: [50ms, 120ms]}}'"},
    {"check",
     "check \"$S\" --timeout 5 --single-solver --seed 3 --property live.completion --property "
     "storm.single-copy --set 'vary={start_jitter: 1s}' -v --counterexamples \"it's\""},
    {"fuzz", "fuzz \"$S\" --set 'vary={start_jitter: 1s}' --runs 5 --limit 'completion=1ms'"},
    {"fuzz_for_a_time", "fuzz \"$S\" --loss 2% --seconds 0.2 --first 3 --property safety.snapshot"},
    {"fuzz_without_a_draw",
     "fuzz \"$S\" --vary dds.sedp.shared_header_bytes=2000..3000 --seed 2 --first 3 --property "
     "safety.snapshot"},
    {"fuzz_for_a_time_without_a_draw",
     "fuzz \"$S\" --vary dds.sedp.shared_header_bytes=2000..3000 --seconds 5 --property "
     "safety.snapshot"},
    {"sensitivity", "sensitivity \"$S\" --set 'time_limit=3s' --pairs --range 1/10 --jobs 2"},
    {"tune", "tune \"$S\" --preset fastdds-2.6.11 --budget 50 --set 'time_limit=3s'"},
    {"diff",
     "diff fastdds-2.6.11 'it'\"'\"'s new.yaml' --over \"$S\" --no-check --no-telling-apart"},
    {"diff_exhibit", "diff --exhibit E7 paper --over \"$S\" --no-check --no-telling-apart"},
    {"compare_discovery",
     "compare-discovery \"$S\" --set dds=fastdds-2.6.11 --set 'time_limit=3s' --start-jitter 20ms "
     "--samples 2 --sizes 2,3 --seed 4 --limit 2s"},
    {"launch",
     "launch \"$S\" --set dds=fastdds-2.6.11 --limit 3s --step 20ms --step 50ms --samples 2 --seed "
     "4 "
     "--start-jitter 5ms --join"},
    {"survive",
     "survive \"$S\" --set dds=fastdds-2.6.11 --versions fastdds-2.14.5 --length 1s --length 30s "
     "--limit 3s --samples 2 --seed 4"},
    {"fix",
     "fix \"$S\" --set dds=fastdds-2.6.11 --set 'limits={completion: 1ms}' --keep vendor --keep "
     "settings --samples 2 --seed 4 --start-jitter 5ms --export \"it's\""},
    {"coverage",
     "coverage \"$SPECS/observations/fastdds-2.6.11-ap150.jsonl\" --dds fastdds-2.6.11 --wireless "
     "wifi-80211n --channel row --scope np1 --samples 1 --set 'time_limit=3s'"},
    {"capture", "capture summarize \"$C\" --until 3s"},
    {"conform",
     "conform \"$C\" --dds fastdds-2.9.1 --delay 0..30s --set 'sedp.heartbeat_period=3s'"},
    {"conform_all", "conform \"$C\" --lateness 200ms"},
    {"validate",
     "validate \"$C\" --dds fastdds-2.9.1 --wireless wifi-80211n --samples 2 --loss 5% "
     "--endpoints-done 20ms..80ms"},
    {"validate_with_server",
     "validate \"$SPECS/captures/discovery-server/fastdds291_ap150_client_np1_ne2_r0.pcap.xz\" "
     "--dds fastdds-server-2.6.11 --wireless emulated-ap --samples 2 --record "
     "\"$SPECS/captures/discovery-server/fastdds291_ap150_client_np1_ne2_r0.json\""},
    {"doctor", "doctor \"$C\" --no-advice --until 4s"},
    {"properties", "properties"},
    {"profile_show", "profile show fastdds-2.6.11 --set 'sedp.heartbeat_period=3s'"},
    {"profile_lint", "profile lint \"it's new.yaml\" fastdds-2.6.11"},
    {"replay", "replay \"it's a trace.jsonl\""},
    {"sweep", "sweep \"it's a grid.yaml\" -o 'the runs.db'"},
    {"reproduce", "reproduce paper --samples 1 --profile paper"},
    {"list", "list profiles findings"},
    {"museum", "museum E0"},
    {"mutate", "mutate --mutant repairs-unasked --timeout 5"},
};

/// Without what is never twice the same.
void drop_times(Json& json) {
  for (const char* key : {"seconds", "already_done", "run_now", "counterexample"}) {
    if (json.is_object()) json.erase(key);
  }
  for (Json& value : json) {
    if (value.is_structured()) drop_times(value);
  }
}

/// Of the verb that the arguments begin with, "profile show" or "check".
Json schema_of(const std::string& arguments) {
  const std::string first = arguments.substr(0, arguments.find(' '));
  std::string verb = first;
  if (first == "profile" || first == "capture") {
    verb = arguments.substr(0, arguments.find(' ', first.size() + 1));
    verb[first.size()] = '-';
  }
  std::ifstream file{STORMPROOF_SPECS_DIR "/schema/output/" + verb + ".schema.json"};
  return Json::parse(file, nullptr, false);
}

class Repeat : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    fs::copy_file(STORMPROOF_SPECS_DIR "/scenarios/smallest.yaml", folder_ / "it's one.yaml");
    std::ofstream{folder_ / "it's new.yaml"} << "base: fastdds-2.6.11\n"
                                                "sedp: {heartbeat_period: 2s}\n";
    std::ofstream{folder_ / "it's a grid.yaml"} << "scenarios: [smallest]\n"
                                                   "grid: {time_limit: [2s, 3s]}\n";
    shell("stormproof simulate smallest --trace \"it's a trace.jsonl\"", "trace");
  }

  /// The standard output of a command, run in the folder.
  std::string shell(const std::string& command, const std::string& name) {
    const fs::path script = folder_ / (name + ".sh");
    std::ofstream{script} << "PATH='" << fs::path{STORMPROOF_PROGRAM}.parent_path().string()
                          << "':$PATH\nSPECS='" STORMPROOF_SPECS_DIR "'\n"
                          << "S=\"it's one.yaml\"\n"
                          << "C='" STORMPROOF_CAPTURES_DIR "/fastdds291_veth_np1_ne2_r0.pcap.xz'\n"
                          << command << '\n';
    const std::string run = "cd '" + folder_.string() + "' && sh " + name + ".sh >" + name +
                            ".out 2>" + name + ".err </dev/null";
    exit_code_ = WEXITSTATUS(std::system(run.c_str()));
    return content(name + ".out");
  }

  [[nodiscard]] std::string content(const std::string& name) const {
    return files::content(folder_ / name);
  }

  const files::Folder own_{"stormproof repeat"};
  const fs::path folder_ = own_.path();
  int exit_code_ = -1;
};

TEST_P(Repeat, TheCommandGivesTheSameAnswer) {
  const std::string typed = std::string{"stormproof "} + GetParam().arguments;
  const std::string printed = shell(typed + " --report json=first.json", "first");
  const int first_code = exit_code_;
  ASSERT_NE(first_code, 2) << content("first.err");
  Json first = Json::parse(content("first.json"));
  EXPECT_EQ(first.at("schema"), 3);
  EXPECT_EQ(first.at("exit_code"), first_code);
  EXPECT_EQ(first.at("interrupted"), false);
  EXPECT_EQ(stormproof::report::SchemaErrors(schema_of(GetParam().arguments), first).found(),
            std::vector<std::string>{});
  const auto command = first.at("command").get<std::string>();
  EXPECT_NE(printed.find(command), std::string::npos) << printed;

  Json second = Json::parse(shell(command + " --format json", "second"), nullptr, false);
  EXPECT_EQ(exit_code_, first_code);
  ASSERT_FALSE(second.is_discarded()) << command << '\n' << content("second.err");
  EXPECT_EQ(second.at("command"), command);
  drop_times(first);
  drop_times(second);
  EXPECT_EQ(first, second);
}

INSTANTIATE_TEST_SUITE_P(Verbs, Repeat, testing::ValuesIn(cases),
                         [](const auto& tested) { return std::string{tested.param.name}; });

}  // namespace repeat_test
