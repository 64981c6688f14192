// The comparison on small deployments: who is compared, on which draws, where a way breaks, and
// what is written to deploy it.
#include "checker/experiments/compare/compare.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "checker/experiments/compare/compare_report.hpp"
#include "checker/experiments/compare/deployment_files.hpp"
#include "checker/experiments/trials/sample_runs.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::compare {
namespace compare_test {

const model::config::SpecPath specs{{STORMPROOF_SPECS_DIR}};

Request request_of(std::vector<std::string> overrides) {
  Request request;
  request.scenario = "live-5x20";
  request.overrides = {"deployment.participants_per_host=1",
                       "deployment.endpoints_per_participant=2"};
  request.overrides.insert(request.overrides.end(), overrides.begin(), overrides.end());
  request.samples = 2;
  return request;
}

Report compared(const Request& request) {
  auto report = compare(request, specs);
  EXPECT_TRUE(report) << to_string(report.error());
  return report ? *std::move(report) : Report{};
}

const Row& row_of(const Report& report, std::string_view id) {
  const auto found =
      std::ranges::find(report.rows, id, [](const Row& row) { return row.candidate.id; });
  EXPECT_NE(found, report.rows.end()) << id;
  return *found;
}

TEST(CompareDiscovery, EveryWayRunsTheSameSchedules) {
  Request request = request_of({});
  request.sizes = {3};
  const Report report = compared(request);
  EXPECT_EQ(report.sizes, (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(report.rows.size(), 10U);
  for (const Row& row : report.rows) {
    if (row.candidate.id == "one-process") {  // there is one as it is
      EXPECT_FALSE(row.cells.front().not_run.empty());
      continue;
    }
    for (const Cell& cell : row.cells) {
      ASSERT_EQ(cell.runs.size(), 2U) << row.candidate.id << cell.not_run;
      EXPECT_EQ(cell.runs[1].seed, 1U);
      EXPECT_EQ(cell.completed, 2U) << row.candidate.id;
    }
  }
  // The numbers are those of `simulate`.
  std::vector<std::string> changes = request.overrides;
  changes.insert(changes.end(), {"dds=fastdds-server-2.6.11", "time_limit=20s"});
  const auto scenario = model::config::read_scenario(request.scenario, changes, specs);
  ASSERT_TRUE(scenario);
  trials::SampleOptions options;
  options.samples = 2;
  const auto alone = trials::sample_runs(*scenario, options);
  const Cell& cell = row_of(report, "server-on-a-robot").cells.front();
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(cell.runs[k].discovery_time, alone[k].discovery_time);
    EXPECT_EQ(cell.runs[k].counts, alone[k].counts);
  }
}

TEST(CompareDiscovery, AServerOfItsOwnIsNoParticipantsNeighbour) {
  const Report report = compared(request_of({}));
  const Cell& beside = row_of(report, "server-on-a-robot").cells.front();
  const Cell& apart = row_of(report, "server-on-its-own-host").cells.front();
  // Now the traffic of both clients crosses the channel.
  EXPECT_GT(apart.runs.front().counts.initial_data, beside.runs.front().counts.initial_data);
}

TEST(CompareDiscovery, TheScenariosOwnProfileIsMarkedOrComesFirst) {
  EXPECT_TRUE(row_of(compared(request_of({})), "simple").candidate.is_own);
  const Report other = compared(request_of({"dds.spdp.period=1s"}));
  EXPECT_EQ(other.rows.front().candidate.id, "as-it-is");
  EXPECT_EQ(other.rows.size(), 11U);
  const Report paper = compared(request_of({"dds=paper"}));
  EXPECT_EQ(paper.rows.front().candidate.id, "as-it-is");
  const Report jazzy = compared(request_of({"dds=fastdds-2.14.5"}));
  EXPECT_EQ(row_of(jazzy, "server-on-a-robot").candidate.profile, "fastdds-server-2.14.5");
  const Report debian = compared(request_of({"dds=fastdds-2.9.1"}));
  EXPECT_EQ(row_of(debian, "simple").candidate.profile, "fastdds-2.9.1");
  EXPECT_FALSE(row_of(debian, "super-clients").candidate.note.empty());
}

/// Its starts are those of the scenario without any spread.
TEST(CompareDiscovery, SpreadStartsAreComparedWithAllAtOnce) {
  Request request;
  request.scenario = "fleet-4x2x20";
  request.sizes = {4};
  request.limit = model::Nanoseconds{1'000'000'000};
  const Report report = compared(request);
  const auto spread =
      std::ranges::find_if(report.rows, [](const Row& row) { return row.candidate.is_own; });
  ASSERT_NE(spread, report.rows.end());
  const Row& together = row_of(report, "all-at-once");
  EXPECT_EQ(&together, &*spread + 1);
  EXPECT_EQ(together.candidate.dds, spread->candidate.dds);
  const std::size_t own = report.own_index();
  EXPECT_EQ(spread->cells[own].runs.front().health.last_start.count(), 700'000'000);
  EXPECT_EQ(together.cells[own].runs.front().health.last_start.count(), 0);
}

TEST(CompareDiscovery, WhatBreaksIsNotRunAtLargerSizes) {
  Request request = request_of({});
  request.sizes = {3, 4};
  request.limit = model::Nanoseconds{500'000'000};  // less than a server needs
  const Report report = compared(request);
  const Row& server = row_of(report, "server-on-a-robot");
  EXPECT_EQ(server.breaks_at, 2U);
  EXPECT_TRUE(server.cells[0].breaks);
  EXPECT_FALSE(server.cells[1].not_run.empty());
  EXPECT_TRUE(server.cells[1].runs.empty());
  EXPECT_FALSE(row_of(report, "simple").breaks_at);
}

/// Fastest is fastest, whether or not it breaks; the one that does not is named beside it.
TEST(CompareDiscovery, NamesTheFastestAndTheFastestThatDoesNotBreak) {
  Request request = request_of({});
  Report report = compared(request);
  Row* const simple = &*std::ranges::find_if(
      report.rows, [](const Row& row) { return row.candidate.id == "simple"; });
  const auto fastest = [&] { return document_of(report, request).answer.plain(); };
  for (Row& row : report.rows) {  // every other way takes a second longer
    Cell& cell = row.cells[report.own_index()];
    if (&row == simple || cell.runs.empty()) continue;
    auto& median = cell.figures[static_cast<std::size_t>(Figure::completion)].median;
    if (median) *median += 1e9;
  }
  EXPECT_NE(fastest().find("simple is fastest"), std::string::npos) << fastest();
  Cell& cell = simple->cells[report.own_index()];
  cell.breaks = true;
  EXPECT_NE(fastest().find("simple is fastest"), std::string::npos) << fastest();
  EXPECT_NE(fastest().find("of those that do not, "), std::string::npos) << fastest();
  cell.runs.clear();
  cell.interrupted = true;
  report.interrupted = true;
  EXPECT_TRUE(fastest().starts_with("INTERRUPTED after ")) << fastest();
  EXPECT_EQ(fastest().find("breaks"), std::string::npos) << fastest();
}

TEST(CompareDiscovery, OneProcessMattersWhereThereAreSeveral) {
  Request request = request_of({});
  request.grows = Grows::participants;
  request.sizes = {3};
  request.samples = 1;
  const Row one = row_of(compared(request), "one-process");
  EXPECT_FALSE(one.cells.front().not_run.empty());
  ASSERT_EQ(one.cells.back().runs.size(), 1U) << one.cells.back().not_run;
  // 3 nodes with 2 endpoints of the user and 15 of their own each, and 2 of the participant.
  EXPECT_EQ(one.cells.back().runs.front().counts.initial_data, 2 * (3 * (2 + 15U) + 2));
}

TEST(CompareDiscovery, StaticPeersHavePortsForAll) {
  Request request = request_of({});
  request.grows = Grows::participants;
  request.sizes = {6};
  request.samples = 1;
  const Report report = compared(request);
  const Row& peers = row_of(report, "static-peers");
  EXPECT_EQ(peers.cells.back().completed, 1U);
  EXPECT_EQ(instance_of(report.candidates, peers.candidate, Grows::participants, 6)
                .scenario.dds.peer_ports,
            6U);
}

TEST(CompareDiscovery, FilesSayWhatWasCompared) {
  Request request = request_of({"deployment.participants_per_host=6"});
  request.samples = 1;
  request.sizes = {2};
  const auto all = candidates_of(request.scenario, request.overrides, specs);
  ASSERT_TRUE(all) << to_string(all.error());
  std::vector<std::string> names;
  for (const Candidate& one : all->list) {
    const Instance instance = instance_of(*all, one, Grows::robots, 2);
    const auto files = deployment_files(one, instance.scenario.dds, specs);
    ASSERT_TRUE(files) << one.id << " " << to_string(files.error());
    for (const DeploymentFile& file : *files) {
      names.push_back(file.name);
      if (file.name == "static-peers.xml") {
        EXPECT_NE(file.text.find("<maxInitialPeersRange>6<"), std::string::npos) << file.text;
        EXPECT_NE(file.text.find("<initialPeersList>"), std::string::npos) << file.text;
      }
      if (file.name == "cyclone-unicast.xml") {
        EXPECT_NE(file.text.find("<AllowMulticast>spdp<"), std::string::npos) << file.text;
      }
      if (file.name == "cyclone-heartbeat.xml") {
        EXPECT_NE(file.text.find("<HeartbeatInterval>1 s<"), std::string::npos) << file.text;
      }
      if (file.name == "super-clients.env") {
        EXPECT_NE(file.text.find("ROS_SUPER_CLIENT=TRUE"), std::string::npos) << file.text;
      }
    }
  }
  EXPECT_EQ(names, (std::vector<std::string>{
                       "simple.env", "server-on-a-robot.env", "server-on-its-own-host.env",
                       "super-clients.env", "static-peers.xml", "static-peers.env",
                       "large-send-buffer.xml", "large-send-buffer.env", "one-process.launch.py",
                       "cyclone-unicast.xml", "cyclone-unicast.env", "cyclone-multicast.xml",
                       "cyclone-multicast.env", "cyclone-heartbeat.xml", "cyclone-heartbeat.env"}));
}

TEST(CompareDiscovery, WhereTypesAreLookedUpNotToAnnounceThemIsAWay) {
  Request request = request_of({"dds=fastdds-3.6", "deployment.types.unknown_per_participant=3"});
  request.samples = 1;
  request.sizes = {2};
  const Report report = compared(request);
  const auto lookups = [&](const std::string& id) {
    return row_of(report, id).cells.front().runs.front().counts.lookup;
  };
  EXPECT_GT(lookups("simple"), 0U);
  EXPECT_EQ(lookups("registration-only"), 0U);
  const auto files = deployment_files(row_of(report, "registration-only").candidate,
                                      row_of(report, "registration-only").candidate.dds, specs);
  ASSERT_TRUE(files) << to_string(files.error());
  EXPECT_NE(files->front().text.find("registration_only"), std::string::npos)
      << files->front().text;
  for (const Row& row : compared(request_of({})).rows) {
    EXPECT_NE(row.candidate.id, "registration-only") << "Fast DDS 2 looks up nothing";
  }
}

TEST(CompareDiscovery, AMistakeIsOneOfTheScenario) {
  EXPECT_FALSE(compare(request_of({"deployment.hosts=0"}), specs));
}

}  // namespace compare_test
}  // namespace stormproof::compare
