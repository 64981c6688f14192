// A run of the live bed is accepted only if it is all it has to be: each case takes a good run and
// makes one thing wrong. And the files of a run are read as they are written.
#include "tests/live/report/judgement.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/files.hpp"

namespace stormproof::live {
namespace judgement_test {

namespace fs = std::filesystem;

/// 1×2 as it was measured: 38 = 1²·2·(17+2) initial DATA.
RunRecord good_run() {
  RunRecord run;
  run.name = "run-1";
  run.link = "veth";
  run.participants_per_host = 1;
  run.endpoints_per_participant = 2;
  run.start_ns = 1'000'000'000;
  run.waited_ns = 16'000'000'000;
  run.captures = {CaptureReport{.packets = 20}, CaptureReport{.packets = 22}};
  const ParticipantReport report{.app_ns = 1'050'000'000,
                                 .strict_ns = 1'040'000'000,
                                 .matches = 12,
                                 .matches_expected = 12,
                                 .discovered = 19,
                                 .discovered_expected = 19};
  run.participants = {report, report};
  run.participants[1].app_ns = 1'060'000'000;
  run.counts = {.spdp = 6, .initial_data = 38, .heartbeat = 4, .acknack = 4, .total = 52};
  run.required_keys = 38;
  run.captured = {{10, 9}, {10, 9}};
  return run;
}

/// That `run` has this outcome, for a reason that says `remark`.
void expect(const RunRecord& run, Outcome outcome, const std::string& remark) {
  const Judgement judgement = judge(run);
  EXPECT_EQ(judgement.outcome, outcome) << remark;
  bool is_said = false;
  for (const std::string& text : judgement.remarks) {
    is_said = is_said || text.find(remark) != std::string::npos;
  }
  EXPECT_TRUE(is_said) << remark;
}

TEST(Judgement, AcceptsWhatIsComplete) {
  const RunRecord run = good_run();
  EXPECT_EQ(run.expected_initial(), 38);
  EXPECT_EQ(run.app_duration_ns(), 60'000'000);
  EXPECT_EQ(run.strict_duration_ns(), 40'000'000);
  EXPECT_EQ(judge(run).outcome, Outcome::as_expected);
  EXPECT_TRUE(judge(run).remarks.empty());
}

TEST(Judgement, WantsABehaviourOfTheProfile) {
  RunRecord run = good_run();
  run.conformance = "conforms";
  EXPECT_EQ(judge(run).outcome, Outcome::as_expected);
  run.conformance = "does_not_conform";
  expect(run, Outcome::check_failed, "no behaviour of the profile");
}

TEST(Judgement, WithAServerCountsWhatGoesToItAndWhatItTells) {
  RunRecord run = good_run();
  run.discovery = "server";
  run.captured = {{10, 9}};  // the other one is on the server's host
  run.required_keys = 12;
  EXPECT_EQ(run.expected_initial(), 25);
  expect(run, Outcome::check_failed, "38 initial DATA were sent; expected 25");
  run.counts.initial_data = 25;
  EXPECT_EQ(judge(run).outcome, Outcome::as_expected);
  run.missing_keys = 1;
  expect(run, Outcome::check_failed, "1 required descriptor keys were not sent");
  run.missing_keys = 0;
  run.discovery = "super_client";
  EXPECT_EQ(run.expected_initial(), 38);
  run.participants_per_host = 5;
  run.endpoints_per_participant = 20;
  EXPECT_EQ(run.expected_initial(), 1'850);
  run.discovery = "server";
  EXPECT_EQ(run.expected_initial(), 1'265);
}

TEST(Judgement, ByMulticastDataMayBeForSeveral) {
  RunRecord run = good_run();
  run.sedp_multicast = true;
  run.counts.initial_data = 20;
  EXPECT_EQ(judge(run).outcome, Outcome::as_expected);
  run.missing_keys = 1;
  EXPECT_EQ(judge(run).outcome, Outcome::check_failed);
}

TEST(Judgement, CountsInitialDataAndKeys) {
  RunRecord run = good_run();
  run.counts.initial_data = 37;
  expect(run, Outcome::check_failed,
         "37 initial DATA were sent; expected N_H·(N_H−1)·N_P²·(17+N_E) = 38");
  run = good_run();
  run.required_keys = 36;
  expect(run, Outcome::check_failed, "requires 36 descriptor keys; expected 38");
  run = good_run();
  run.missing_keys = 1;
  expect(run, Outcome::check_failed, "1 required descriptor keys were not sent");
}

TEST(Judgement, TrustsNoCaptureThatLostPackets) {
  RunRecord run = good_run();
  run.captures[1].dropped = 3;
  expect(run, Outcome::check_failed, "the capture of host 1 lost 3 packets");
  run = good_run();
  run.captures[0].interface_dropped = 2;
  expect(run, Outcome::check_failed, "the interface of host 0 dropped 2 packets");
  run = good_run();
  run.captures[0].packets = 0;
  expect(run, Outcome::check_failed, "the capture of host 0 is empty");
}

TEST(Judgement, OnlyNotesWhatTheHostsThemselvesLost) {
  RunRecord run = good_run();
  run.captures[1].socket_dropped = 12;
  EXPECT_EQ(judge(run).outcome, Outcome::as_expected);
  ASSERT_EQ(judge(run).notes.size(), 1U);
  EXPECT_NE(to_text({run}).find("12 datagrams that arrived at host 1 found a full socket buffer"),
            std::string::npos);
}

TEST(Judgement, WantsTheWholeTopology) {
  RunRecord run = good_run();
  run.captured.pop_back();
  expect(run, Outcome::check_failed, "1 participants were captured; expected 2");
  run = good_run();
  run.captured[1].subscriptions = 8;
  expect(run, Outcome::check_failed,
         "captured participant 1 has 10 publications and 8 subscriptions; expected 10 and 9");
}

TEST(Judgement, SaysWhatAnIncompleteRunLacks) {
  RunRecord run = good_run();
  run.participants[1].strict_ns = 0;
  run.participants[1].discovered = 7;
  expect(run, Outcome::incomplete, "1 of 2 participants were complete after 16.000 s");
  expect(run, Outcome::incomplete, "7 of 19 endpoints");
  run.participants[1].discovered = 19;
  expect(run, Outcome::incomplete, "one had everything, but too late");
  run = good_run();
  run.participants.pop_back();
  expect(run, Outcome::incomplete, "1 of 2 participants were complete");
}

TEST(Table, HasOneLinePerRunAndTheirRange) {
  std::vector<RunRecord> runs = {good_run(), good_run(), good_run()};
  runs[1].name = "run-2";
  runs[1].counts.heartbeat = 900;
  runs[2].name = "run-3";
  runs[2].participants.pop_back();
  const std::string text = to_text(runs);
  EXPECT_NE(text.find("run-1         0.060    0.040"), std::string::npos) << text;
  EXPECT_NE(text.find("run-3             –        –"), std::string::npos) << text;
  EXPECT_NE(text.find("most "), std::string::npos) << text;
  EXPECT_NE(text.find("900"), std::string::npos) << text;
  EXPECT_NE(text.find("not complete"), std::string::npos) << text;
  EXPECT_NE(to_json(runs).find("\"outcome\": \"incomplete\""), std::string::npos);
}

/// A folder as tests/live/run writes it.
class Folder : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(path_ / "participants");
    write("run.json", R"({"link": "veth", "participants_per_host": 1,
      "endpoints_per_participant": 2, "start_ns": 10, "limit_ns": 25, "waited_ns": 24, "until_ns": 30,
      "captures": [{"packets": 5, "dropped": 1, "interface_dropped": 2, "socket_dropped": 3},
                   {"packets": 6, "dropped": 0, "interface_dropped": 0, "socket_dropped": 0}]})");
    write("summary.json", R"({"counts": {"initial_data": 38, "repair_data": 1, "heartbeat": 4,
      "acknack": 5, "spdp_multicast": 4, "spdp_unicast": 2, "total": 54},
      "missing": {"required": 38, "count": 0, "descriptors": []},
      "topology": {"participants": [{"publications": 10, "subscriptions": 9}]}})");
    write("participants/0-0.json", R"({"host": 0, "index": 0, "created_ns": 11,
      "endpoints_done_ns": 12, "app_ns": 30, "matches": 12, "matches_expected": 12,
      "strict_ns": 29, "discovered": 19, "discovered_expected": 19})");
  }
  void write(const std::string& name, const std::string& text) { files::write(path_ / name, text); }
  const files::Folder own_;
  const fs::path path_ = own_.path() / "run-1";
};

TEST_F(Folder, IsRead) {
  const RunRecord run = read_run(path_);
  EXPECT_EQ(run.name, "run-1");
  EXPECT_EQ(run.captures[0].dropped, 1);
  EXPECT_EQ(run.captures[0].interface_dropped, 2);
  EXPECT_EQ(run.captures[0].socket_dropped, 3);
  EXPECT_EQ(run.captures[1].packets, 6);
  EXPECT_EQ(run.counts.spdp, 6);
  EXPECT_EQ(run.counts.total, 54);
  EXPECT_EQ(run.required_keys, 38);
  ASSERT_EQ(run.captured.size(), 1U);
  EXPECT_EQ(run.captured[0].subscriptions, 9);
  ASSERT_EQ(run.participants.size(), 1U);
  EXPECT_EQ(run.app_duration_ns(), 20);
  EXPECT_FALSE(run.is_complete());
}

TEST_F(Folder, DoesNotCountWhatCameAfterTheLimit) {
  write("participants/1-0.json", R"({"created_ns": 11, "endpoints_done_ns": 12, "app_ns": 36,
    "matches": 12, "matches_expected": 12, "strict_ns": 35, "discovered": 19,
    "discovered_expected": 19})");
  const RunRecord run = read_run(path_);
  ASSERT_EQ(run.participants.size(), 2U);
  EXPECT_EQ(run.app_duration_ns(), 20);
  EXPECT_EQ(run.strict_duration_ns(), 25);
  EXPECT_FALSE(run.is_complete());
}

TEST_F(Folder, SaysWhichFileIsWrong) {
  write("summary.json", R"({"counts": {}})");
  try {
    (void)read_run(path_);
    FAIL() << "accepted counts without figures";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("summary.json"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("spdp_multicast"), std::string::npos);
  }
  fs::remove(path_ / "run.json");
  EXPECT_THROW((void)read_run(path_), std::runtime_error);
}

}  // namespace judgement_test
}  // namespace stormproof::live
