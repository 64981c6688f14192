// Discoveries with a Discovery Server: a simulated one is predicted exactly, given when the clients
// on the server's host started, which is on no link; a live one gives the counts of somebody else.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "checker/evidence/capture/write/simulated_capture.hpp"
#include "checker/evidence/validate/run_record.hpp"
#include "checker/evidence/validate/validate.hpp"
#include "checker/presentation/document/render.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/checker/evidence/capture/write_comparison.hpp"

namespace stormproof::validate::testing {
namespace server_test {

constexpr const char* text = R"({
  deployment: {participants: [
    {host: 0, publications: 3, subscriptions: 2, start: 0ms, endpoints_done: 100ms},
    {host: 0, publications: 1, subscriptions: 4, start: 5ms, endpoints_done: 120ms},
    {host: 1, publications: 0, subscriptions: 2, start: 2ms, endpoints_done: 110ms},
    {host: 1, publications: 2, subscriptions: 2, start: 7ms, endpoints_done: 130ms},
    {host: 1, publications: 4, subscriptions: 2, start: 12ms, endpoints_done: 150ms}]},
  dds: PROFILE, wireless: {base: emulated-ap, overhead_unicast: 700us}, time_limit: 100s})";

struct Profile {
  std::string name;
  std::string discovery = "server";
};

model::Scenario scenario(const Profile& profile) {
  std::string filled = text;
  filled.replace(filled.find("PROFILE"), 7,
                 "{base: " + profile.name + ", discovery: " + profile.discovery + "}");
  const auto read =
      model::config::parse_scenario(filled, "test", {}, model::config::SpecPath::standard());
  EXPECT_TRUE(read) << to_string(read.error());
  return *read;
}

struct Simulated {
  capture::SimulatedCapture written;
  capture::Conversation conversation;
};

Simulated simulated(const Profile& profile) {
  Simulated run{capture::simulated_capture(scenario(profile)), {}};
  EXPECT_TRUE(run.written.run.completed());
  run.conversation = capture::testing::conversation_in(run.written);
  return run;
}

/// What the two clients beside the server would say.
RunRecord record(const Profile& profile, const capture::Conversation& conversation,
                 std::int64_t epoch_ns) {
  RunRecord record{"a record", {}};
  const model::Scenario run = scenario(profile);
  const auto& topology = conversation.topology;
  for (std::size_t k = 0; k < 2; ++k) {
    const model::Participant& one = run.deployment.participants[k];
    const auto found = std::ranges::find(
        topology.participants, "simulated_h0_p" + std::to_string(k), &capture::Participant::name);
    EXPECT_NE(found, topology.participants.end());
    record.participants.push_back({0, to_string(found->prefix), epoch_ns + one.start.count(),
                                   epoch_ns + one.endpoints_done.count()});
  }
  return record;
}

constexpr std::int64_t epoch_ns = 946'684'800'000'000'000;

Request request(const Profile& profile) {
  Request request;
  request.dds = profile.name;
  request.wireless = "emulated-ap";
  request.overrides = {"wireless.overhead_unicast=700us", "dds.discovery=" + profile.discovery};
  request.sampling.samples = 2;
  request.sampling.threads = 1;
  // Clients send all their descriptors at once, so the capture does not show when they were made.
  request.endpoints_done = {model::Nanoseconds{100'000'000}, model::Nanoseconds{100'000'000}};
  return request;
}

class WithServer : public ::testing::TestWithParam<Profile> {};

TEST_P(WithServer, ASimulatedRunHasItsDeployment) {
  const Simulated run = simulated(GetParam());
  Request wanted = request(GetParam());
  wanted.record = record(GetParam(), run.conversation, epoch_ns);
  const auto report = validate(run.conversation, wanted);
  ASSERT_TRUE(report) << to_string(report.error());
  const auto& expected = scenario(GetParam()).deployment.participants;
  const auto& found = report->scenario.deployment.participants;
  ASSERT_EQ(found.size(), expected.size());
  for (const model::Participant& one : expected) {
    EXPECT_EQ(std::ranges::count_if(found,
                                    [&](const model::Participant& other) {
                                      // Of a client beside the server what others need.
                                      const auto fits = [&](std::uint32_t has, std::uint32_t all) {
                                        return one.host.value == 0 ? has <= all : has == all;
                                      };
                                      return other.host == one.host && other.start == one.start &&
                                             fits(other.publications, one.publications) &&
                                             fits(other.subscriptions, one.subscriptions);
                                    }),
              1)
        << one.start.count();
  }
}

/// All figures that are predicted, of a run in which everybody has all endpoints after 100 ms.
TEST_P(WithServer, ASimulatedRunIsPredictedExactly) {
  const Profile profile = GetParam();
  model::Scenario same = scenario(profile);
  for (model::Participant& one : same.deployment.participants) {
    one.endpoints_done = model::Nanoseconds{100'000'000};
  }
  const auto written = capture::simulated_capture(same);
  ASSERT_TRUE(written.run.completed());
  const auto conversation = capture::testing::conversation_in(written);
  Request wanted = request(profile);
  wanted.record = record(profile, conversation, epoch_ns);
  for (const bool is_cut : {false, true}) {
    if (is_cut) wanted.until_ns = epoch_ns + written.run.discovery_time->count();
    const auto report = validate(conversation, wanted);
    ASSERT_TRUE(report) << to_string(report.error());
    EXPECT_TRUE(report->observation.complete);
    std::size_t predicted = 0;
    for (const Row& row : report->rows) {
      if (!row.median) continue;
      ++predicted;
      EXPECT_EQ(row.observed, row.median)
          << name_of(row.figure) << (is_cut ? " until the end" : "");
    }
    EXPECT_GT(predicted, 15U);
    EXPECT_GT(*report->of(Figure::gap).median, 0);
    if (!is_cut) continue;
    EXPECT_EQ(*report->of(Figure::total).observed, written.run.counts.total());
    EXPECT_EQ(*report->of(Figure::pdp_data).observed, written.run.counts.pdp_data);
    EXPECT_EQ(report->observation.completion_ns(), written.run.discovery_time->count());
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, WithServer,
                         ::testing::Values(Profile{"fastdds-server-2.6.11"},
                                           Profile{"fastdds-server-2.14.5"},
                                           Profile{"fastdds-server-2.6.11", "super_client"}),
                         [](const auto& one) { return "Profile" + std::to_string(one.index); });

const Profile profile{"fastdds-server-2.6.11"};

TEST(ServerCapture, WithoutARecordTheOthersStartWithTheFirst) {
  const Simulated run = simulated(profile);
  const auto report = validate(run.conversation, request(profile));
  ASSERT_TRUE(report) << to_string(report.error());
  std::size_t unseen = 0;
  for (const CapturedParticipant& one : report->observation.deployment.participants) {
    if (one.is_seen) continue;
    ++unseen;
    EXPECT_EQ(one.start.count(), 0);
  }
  EXPECT_EQ(unseen, 2U);
  const std::string words = to_text(document_of(*report, {{"a.pcap"}}));
  EXPECT_NE(words.find("DATA(p)"), std::string::npos) << words;
}

TEST(ServerCapture, AChangedKnobIsToldApart) {
  const Simulated run = simulated(profile);
  Request wanted = request(profile);
  wanted.record = record(profile, run.conversation, epoch_ns);
  wanted.within = 1.05;
  wanted.overrides.emplace_back("dds.client_sync_period=200ms");
  const auto report = validate(run.conversation, wanted);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->agreement, Agreement::beyond);
}

TEST(ServerCapture, NeedsAProfileWithAServer) {
  const Simulated run = simulated(profile);
  EXPECT_FALSE(validate(run.conversation, request({"fastdds-2.6.11", "simple"})));
}

TEST(ServerCapture, ARecordOfTooFewIsRefused) {
  const Simulated run = simulated(profile);
  Request wanted = request(profile);
  wanted.record = record(profile, run.conversation, epoch_ns);
  wanted.record.participants.pop_back();
  const auto report = validate(run.conversation, wanted);
  ASSERT_FALSE(report);
  EXPECT_NE(to_string(report.error()).find("the capture tells of 2"), std::string::npos)
      << to_string(report.error());
}

TEST(RunRecord, IsReadFromAFolder) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path{::testing::TempDir()} / "run_record";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const auto write = [&](const char* name, const char* content) {
    std::ofstream{folder / name} << content;
  };
  EXPECT_FALSE(read_run_record(folder)) << "nothing in it";
  write("0-0.json", R"({"host": 0, "index": 0, "created_ns": 5, "endpoints_done_ns": 9})");
  write("0-1.json", R"([{"host": 0, "created_ns": 6, "endpoints_done_ns": 6},
                        {"host": 1, "created_ns": 7, "endpoints_done_ns": 8}])");
  write("notes.txt", "no JSON");
  const auto record = read_run_record(folder);
  ASSERT_TRUE(record) << to_string(record.error());
  ASSERT_EQ(record->participants.size(), 3U);
  EXPECT_EQ(record->participants[2].host, 1U);
  EXPECT_EQ(record->participants[0].endpoints_done_ns, 9);
  const auto error_of = [&](const char* content) {
    write("0-2.json", content);
    const auto refused = read_run_record(folder);
    return refused ? std::string{} : to_string(refused.error());
  };
  for (const auto& [content, word] : std::initializer_list<std::pair<const char*, const char*>>{
           {"{", "not JSON"},
           {"3", "not an object"},
           {R"({"created_ns": 5, "endpoints_done_ns": 9})", "host"},
           {R"({"host": 0, "created_ns": -5, "endpoints_done_ns": 9})", "created_ns"},
           {R"({"host": 0, "created_ns": 10, "endpoints_done_ns": 9})", "endpoints_done_ns"}}) {
    const std::string error = error_of(content);
    EXPECT_NE(error.find(word), std::string::npos) << error;
    EXPECT_NE(error.find("0-2.json"), std::string::npos) << error;
  }
}

}  // namespace server_test
}  // namespace stormproof::validate::testing
