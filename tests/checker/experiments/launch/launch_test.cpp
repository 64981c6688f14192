// What a study of launch plans finds: the hump, the cure, waves that wait, a robot that joins.
#include "checker/experiments/launch/launch.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/experiments/launch/launch_report.hpp"
#include "checker/presentation/document/render.hpp"

namespace stormproof::launch {
namespace launch_test {

using model::Nanoseconds;
using model::config::SpecPath;

constexpr Nanoseconds ms(std::int64_t value) { return Nanoseconds{value * 1'000'000}; }

Request request_of(const std::string& scenario, std::vector<std::string> overrides = {}) {
  Request request;
  request.scenario = scenario;
  request.overrides = std::move(overrides);
  request.samples = 3;
  request.steps = {ms(100)};
  request.threads = 2;
  return request;
}

Report report_of(const Request& request) {
  auto report = launch(request, SpecPath::standard());
  EXPECT_TRUE(report) << to_string(report.error());
  return *std::move(report);
}

const Cell& cell_of(const Report& report, Order order, std::size_t setting) {
  for (const Row& row : report.rows) {
    if (row.plan.order == order) return row.cells[setting];
  }
  ADD_FAILURE() << name_of(order);
  return report.rows.front().cells[setting];
}

double median_s(const Cell& cell) { return cell.completion.median.value_or(1e15) * 1e-9; }

/// The finding specs/findings/spread-starts.md, on its fleet.
TEST(Launch, SpreadStartsMakeTheStormAndALargeSendBufferCuresIt) {
  const Report report = report_of(request_of("fleet-4x2x20"));
  ASSERT_EQ(report.settings.size(), 2U);
  EXPECT_EQ(report.rows.front().plan, (Plan{Order::by_process, ms(100)}));
  const Cell& spread = report.rows.front().cells[0];
  const Cell& cured = report.rows.front().cells[1];
  const Cell& together = cell_of(report, Order::at_once, 0);
  EXPECT_EQ(spread.storms, 3U);
  EXPECT_GT(median_s(spread), 4 * median_s(together));
  EXPECT_EQ(cured.storms, 0U);
  EXPECT_LT(median_s(cured), 1.5);  // of which the spread is 0.7
  const auto best = report.best();
  ASSERT_TRUE(best);
  EXPECT_EQ(report.settings[best->setting].id, "large_send_buffer");
  EXPECT_FALSE(report.settings[0].proved.value_or(false));
}

TEST(Launch, AWaveStartsWhenThoseBeforeAreComplete) {
  Request request = request_of("three-hosts", {"dds=fastdds-2.6.11"});
  request.samples = 1;
  const Report report = report_of(request);
  const std::vector<Nanoseconds> starts = starts_in(report.settings[0], {Order::waves}, request);
  ASSERT_EQ(starts.size(), 6U);
  EXPECT_EQ(starts[0], starts[1]);
  EXPECT_EQ(starts[2], starts[3]);
  EXPECT_LT(starts[2], starts[4]);
  const Cell& waves = cell_of(report, Order::waves, 0);
  EXPECT_GT(waves.completion.median, static_cast<double>(starts[4].count()));
}

TEST(Launch, HostsThatNobodySaysAreTheUsualOnes) {
  EXPECT_TRUE(report_of(request_of("smallest", {"dds=fastdds-2.6.11"})).usual_hosts);
  EXPECT_FALSE(report_of(request_of("smallest", {"dds=fastdds-2.6.11", "hosts=raspberry-pi-4"}))
                   .usual_hosts);
  EXPECT_FALSE(report_of(request_of("smallest")).usual_hosts);  // the paper's have none
}

/// storm.cannot-start is proved of this deployment for all start times.
TEST(Launch, AllAtOnceIsTheShortestProvedPlanWhereAStormCannotStart) {
  const Report report = report_of(request_of("wired-5x20"));
  EXPECT_EQ(report.settings[0].proved, true);
  const report::Document document = document_of(report, request_of("wired-5x20"), {});
  EXPECT_NE(to_text(document).find("proved free of storms"), std::string::npos);
}

TEST(Launch, WhatIsNotCompleteInTimeIsNotSoonest) {
  Request request = request_of("fleet-4x2x20");
  request.limit = ms(100);
  const Report report = report_of(request);
  EXPECT_FALSE(report.best());
  EXPECT_EQ(report.rows.front().cells[0].incomplete, 3U);
  EXPECT_NE(to_text(document_of(report, request, {})).find("Under no plan"), std::string::npos);
}

TEST(Launch, ARobotThatJoinsCostsMessagesAndDisturbsOthers) {
  Request request = request_of("three-hosts", {"dds=fastdds-2.6.11"});
  request.join = true;
  const Report report = report_of(request);
  ASSERT_EQ(report.joins.size(), 2U);
  const Join& join = report.joins[0];
  EXPECT_EQ(join.runs, 3U);
  ASSERT_TRUE(join.took.median && join.messages.median && join.others.median);
  EXPECT_LT(*join.took.median, 5e9);
  EXPECT_GE(*join.messages.median, 2 * 6 * 24);  // all of it to all others, at least
  EXPECT_LT(*join.others.median, *join.messages.median);
}

TEST(Launch, SameResultOnAnyNumberOfThreads) {
  Request request = request_of("three-hosts", {"dds=fastdds-2.6.11"});
  const auto json = [&request](std::size_t threads) {
    request.threads = threads;
    return to_json(report_of(request), request, {});
  };
  EXPECT_EQ(json(1), json(3));
}

TEST(Launch, OfALifeThereIsNoPlan) {
  const auto report = launch(request_of("rejoin-fastdds"), SpecPath::standard());
  ASSERT_FALSE(report);
  EXPECT_NE(to_string(report.error()).find("first starts"), std::string::npos);
}

TEST(LaunchFiles, HaveTheDelaysOfThePlan) {
  const Request request = request_of("fleet-4x2x20");
  const Report report = report_of(request);
  const auto files = launch_files(report.settings[0], {Order::by_process, ms(100)}, request);
  ASSERT_EQ(files.size(), 4U * 3);
  EXPECT_EQ(files[3].name, "host-1.launch.py");
  EXPECT_NE(files[3].text.find("TimerAction(period=0.200"), std::string::npos);
  EXPECT_NE(files[3].text.find("TimerAction(period=0.300"), std::string::npos);
  EXPECT_EQ(files[4].name, "host-1-process_0.service");
  EXPECT_NE(files[4].text.find("ExecStartPre=/bin/sleep 0.200"), std::string::npos);
}

}  // namespace launch_test
}  // namespace stormproof::launch
