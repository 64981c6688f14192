// Captures of live discoveries with a Discovery Server, on a link that shows neither the server's
// clients on its own host nor when they started: counted as somebody else did, complete when the
// applications were, and predicted.
#include <filesystem>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/validate/run_record.hpp"
#include "checker/evidence/validate/validate.hpp"

namespace stormproof::validate::testing {
namespace server_live_test {

namespace fs = std::filesystem;

const fs::path folder = fs::path{STORMPROOF_CAPTURES_DIR} / "discovery-server";

std::vector<std::string> names() {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator{folder}) {
    if (entry.path().extension() == ".json") found.push_back(entry.path().stem());
  }
  std::ranges::sort(found);
  return found;
}

nlohmann::json sidecar(const std::string& name) {
  std::ifstream in{folder / (name + ".json")};
  return nlohmann::json::parse(in);
}

capture::Conversation read(const std::string& name) {
  const std::vector<std::string> files{folder / (name + ".pcap.xz")};
  auto conversation = capture::read_conversation(files);
  EXPECT_TRUE(conversation) << to_string(conversation.error());
  return *conversation;
}

class LiveWithServer : public ::testing::TestWithParam<std::string> {};

TEST_P(LiveWithServer, HasTheCountsOfItsSidecar) {
  const auto json = sidecar(GetParam());
  const capture::Counting counting = capture::count(read(GetParam()), json["cutoff_ns"]);
  const model::Counts& counts = counting.counts;
  std::map<std::string, std::uint64_t> found{{"pdp_data", counts.pdp_data},
                                             {"pdp_heartbeat", counts.pdp_heartbeat},
                                             {"pdp_acknack", counts.pdp_acknack},
                                             {"gap", counts.gap},
                                             {"total", counts.total()}};
  for (const auto& [name, value] : counts.entries()) found[name] = value;
  for (const auto& [name, value] : json["counts"].items()) EXPECT_EQ(found.at(name), value) << name;
  EXPECT_EQ(found.size(), json["counts"].size());
}

TEST_P(LiveWithServer, LacksSomethingUntilItsLastInitialData) {
  const auto json = sidecar(GetParam());
  const capture::Conversation conversation = read(GetParam());
  const capture::Counting whole = capture::count(conversation, json["cutoff_ns"]);
  // On 4 + 2 floor(E / 2) topics; each client across is told by everybody, and tells the server.
  const std::uint64_t each = json["participants_per_host"];
  const std::uint64_t endpoints = json["endpoints_per_participant"];
  EXPECT_EQ(whole.required, each * 2 * each * (4 + endpoints / 2 * 2));
  EXPECT_EQ(whole.missing_count, 0U);
  ASSERT_TRUE(whole.last_initial_ns.has_value());
  const capture::Counting cut = capture::count(conversation, *whole.last_initial_ns - 1);
  EXPECT_TRUE(cut.missing_count > 0 || cut.required < whole.required);
}

TEST_P(LiveWithServer, ShowsThoseBesideTheServerByWhatItTells) {
  const auto json = sidecar(GetParam());
  const capture::Conversation conversation = read(GetParam());
  const auto& participants = conversation.topology.participants;
  const std::size_t each = json["participants_per_host"];
  ASSERT_EQ(participants.size(), 2 * each + 1);
  const capture::Participant* server = conversation.topology.server();
  ASSERT_NE(server, nullptr);
  for (const auto& one : json["participants"]) {
    const auto found = std::ranges::find_if(participants, [&](const capture::Participant& other) {
      return to_string(other.prefix) == one["guid_prefix"];
    });
    ASSERT_NE(found, participants.end()) << one["guid_prefix"];
    EXPECT_EQ(found->host == server->host, one["host"] == 0);
    EXPECT_FALSE(found->endpoints.empty());
  }
}

/// Completion within a tenth, messages within 15 %.
TEST_P(LiveWithServer, IsPredicted) {
  const auto json = sidecar(GetParam());
  const bool is_once = GetParam().starts_with("fastdds2145");
  Request request;
  request.dds = is_once ? "fastdds-server-2.14.5" : "fastdds-server-2.6.11";
  request.wireless = "emulated-ap";
  request.overrides = {"dds.discovery=" + json["discovery"].get<std::string>()};
  request.until_ns = json["cutoff_ns"];
  request.sampling.samples = 4;
  auto record = read_run_record(folder / (GetParam() + ".json"));
  ASSERT_TRUE(record) << to_string(record.error());
  request.record = std::move(*record);
  const auto report = validate(read(GetParam()), request);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_NEAR(*report->of(Figure::completion).ratio, 1, 0.1);
  EXPECT_NEAR(*report->of(Figure::total).ratio, 1, 0.15);
  EXPECT_EQ(*report->of(Figure::initial_data).ratio, 1);
}

INSTANTIATE_TEST_SUITE_P(Capture, LiveWithServer, ::testing::ValuesIn(names()),
                         [](const auto& one) { return one.param; });

TEST(LiveCaptures, ThereAreClientsAndSuperClients) { EXPECT_EQ(names().size(), 4U); }

}  // namespace server_live_test
}  // namespace stormproof::validate::testing
