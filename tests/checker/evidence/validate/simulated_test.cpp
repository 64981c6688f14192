// A simulated run, written as a capture and read as any other, must be predicted exactly: the
// deployment, every figure, and every step over time. Whatever is counted differently on the two
// sides shows here. And a wrong profile must not.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/evidence/capture/write/simulated_capture.hpp"
#include "checker/evidence/validate/validate.hpp"
#include "checker/presentation/document/render.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/checker/evidence/capture/write_comparison.hpp"

namespace stormproof::validate::testing {
namespace simulated_test {

constexpr const char* text = R"({
  deployment: {participants: [
    {host: 0, publications: 3, subscriptions: 2, start: 0ms, endpoints_done: 100ms},
    {host: 0, publications: 1, subscriptions: 4, start: 5ms, endpoints_done: 120ms},
    {host: 0, publications: 2, subscriptions: 2, start: 9ms, endpoints_done: 95ms},
    {host: 1, publications: 0, subscriptions: 2, start: 2ms, endpoints_done: 110ms},
    {host: 1, publications: 2, subscriptions: 2, start: 7ms, endpoints_done: 130ms},
    {host: 1, publications: 2, subscriptions: 2, start: 12ms, endpoints_done: 150ms}]},
  dds: fastdds-2.6.11, wireless: {base: emulated-ap, overhead_unicast: 700us}, time_limit: 100s})";

model::Scenario scenario() {
  const auto read =
      model::config::parse_scenario(text, "test", {}, model::config::SpecPath::standard());
  EXPECT_TRUE(read) << to_string(read.error());
  return *read;
}

capture::Conversation simulated() {
  auto written = capture::simulated_capture(scenario());
  EXPECT_TRUE(written.run.completed());
  return capture::testing::conversation_in(written);
}

Request request(const std::string& dds) {
  Request request;
  request.dds = dds;
  request.wireless = "emulated-ap";
  request.overrides = {"wireless.overhead_unicast=700us"};  // slow enough for repairs
  request.sampling.samples = 2;
  request.sampling.threads = 1;
  return request;
}

Report report_of(const Request& wanted) {
  const auto report = validate(simulated(), wanted);
  EXPECT_TRUE(report) << to_string(report.error());
  return *report;
}

TEST(SimulatedCapture, IsPredictedExactly) {
  const Report report = report_of(request("fastdds-2.6.11"));
  EXPECT_TRUE(report.observation.complete);
  for (const Row& row : report.rows) {
    EXPECT_EQ(row.observed, row.median) << name_of(row.figure);
  }
  EXPECT_GT(*report.of(Figure::initial_pulled).observed, 0);
  EXPECT_GT(*report.of(Figure::user_control).observed, 0);
}

/// Programs take processor time where starts are spread, unless the caller says which.
TEST(SimulatedCapture, HasTheUsualHostsWhereStartsAreSpread) {
  EXPECT_FALSE(report_of(request("fastdds-2.6.11")).usual_hosts);
  model::Scenario spread = scenario();
  spread.deployment.participants[5].start = model::Nanoseconds{200'000'000};
  spread.deployment.participants[5].endpoints_done = model::Nanoseconds{300'000'000};
  const auto written = capture::simulated_capture(spread);
  const auto conversation = capture::testing::conversation_in(written);
  Request wanted = request("fastdds-2.6.11");
  const auto usual = validate(conversation, wanted);
  ASSERT_TRUE(usual);
  EXPECT_TRUE(usual->usual_hosts);
  ASSERT_TRUE(usual->scenario.hosts);
  EXPECT_NE(report::to_text(document_of(*usual, {})).find("live-bed-processors"),
            std::string::npos);
  wanted.overrides.emplace_back("hosts=raspberry-pi-4");
  const auto said = validate(conversation, wanted);
  ASSERT_TRUE(said);
  EXPECT_FALSE(said->usual_hosts);
  EXPECT_EQ(said->scenario.hosts->cores, 4U);
}

/// Announcements to ports that nobody has are on the link, too.
TEST(SimulatedCapture, IsPredictedExactlyWithStaticPeers) {
  model::Scenario with_peers = scenario();
  with_peers.dds.discovery = model::Discovery::static_peers;
  with_peers.dds.peer_ports = 5;
  const auto written = capture::simulated_capture(with_peers);
  ASSERT_TRUE(written.run.completed());
  const auto conversation = capture::testing::conversation_in(written);
  Request wanted = request("fastdds-2.6.11");
  wanted.overrides.insert(wanted.overrides.end(), {"dds.discovery=static", "dds.peer_ports=5"});
  wanted.until_ns = conversation.first_ns + written.run.discovery_time->count();
  const auto report = validate(conversation, wanted);
  ASSERT_TRUE(report) << to_string(report.error());
  for (const Row& row : report->rows) {
    EXPECT_EQ(row.observed, row.median) << name_of(row.figure);
  }
  EXPECT_EQ(*report->of(Figure::total).observed, written.run.counts.total());
}

TEST(SimulatedCapture, IsPredictedExactlyUntilItsCompletion) {
  const auto written = capture::simulated_capture(scenario());
  const capture::Conversation conversation = simulated();
  Request wanted = request("fastdds-2.6.11");
  wanted.until_ns = conversation.first_ns + written.run.discovery_time->count();
  const auto report = validate(conversation, wanted);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->observation.completion_ns(), written.run.discovery_time->count());
  EXPECT_EQ(*report->of(Figure::total).observed, written.run.counts.total());
  EXPECT_GT(*report->of(Figure::repair_data).observed, 0);
  for (const Row& row : report->rows) {
    EXPECT_EQ(row.observed, row.median) << name_of(row.figure);
  }
}

TEST(SimulatedCapture, GivesItsDeployment) {
  const Report report = report_of(request("fastdds-2.6.11"));
  const auto& expected = scenario().deployment.participants;
  const auto& found = report.scenario.deployment.participants;
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].host, expected[k].host);
    EXPECT_EQ(found[k].publications, expected[k].publications);
    EXPECT_EQ(found[k].subscriptions, expected[k].subscriptions);
    EXPECT_EQ(found[k].start, expected[k].start);
    EXPECT_EQ(report.observation.deployment.participants[k].unevenness.count(), 0);
  }
}

TEST(SimulatedCapture, GrowsAsPredicted) {
  const Report report = report_of(request("fastdds-2.6.11"));
  const Growth& observed = report.observation.growth;
  ASSERT_EQ(observed.points.size(), observed_steps);
  ASSERT_EQ(report.bands.size(), most_growth * observed_steps);
  std::size_t off = 0;
  for (std::size_t step = 0; step < observed_steps; ++step) {
    for (std::size_t curve = 0; curve < growth_curves; ++curve) {
      const double difference =
          report.bands[step][curve].median - static_cast<double>(observed.points[step][curve]);
      // Packets of one instant are a few ns apart in the capture.
      if (difference != 0) ++off;
    }
  }
  EXPECT_LT(off, observed_steps * growth_curves / 50);
}

TEST(SimulatedCapture, AnotherProfileIsToldApart) {
  Request other = request("fastdds-2.14.5");
  other.within = 1.001;
  const Report report = report_of(other);
  EXPECT_EQ(report.agreement, Agreement::beyond);
  Request same = request("fastdds-2.6.11");
  same.within = 1.001;
  EXPECT_EQ(report_of(same).agreement, Agreement::within);
}

TEST(SimulatedCapture, TheGivenRangeOfCreationsIsUsed) {
  Request wanted = request("fastdds-2.6.11");
  wanted.endpoints_done = {model::Nanoseconds{100'000'000}, model::Nanoseconds{100'000'000}};
  const Report report = report_of(wanted);
  EXPECT_FALSE(report.is_drawn);
  EXPECT_EQ(report.runs, 1U);
  for (const model::Participant& one : report.scenario.deployment.participants) {
    EXPECT_EQ(one.endpoints_done.count(), 100'000'000);
  }
}

TEST(SimulatedCapture, LossIsDrawnAnew) {
  Request wanted = request("fastdds-2.6.11");
  wanted.sampling.loss = 0.1;
  const Report report = report_of(wanted);
  EXPECT_EQ(report.runs, 2U);
  EXPECT_FALSE(report.scenario.wireless.lost_packets.empty());
  EXPECT_GT(*report.of(Figure::completion).ratio, 1);
}

TEST(SimulatedCapture, StopsWhenAsked) {
  Request wanted = request("fastdds-2.6.11");
  wanted.sampling.loss = 0.1;
  wanted.sampling.on_progress = [](std::size_t, std::size_t) { return false; };
  const Report report = report_of(wanted);
  EXPECT_TRUE(report.interrupted());
  const report::Document document = document_of(report, {{"a.pcap"}});
  EXPECT_FALSE(document.complete);
  EXPECT_NE(to_text(document).find("of 2 runs finished"), std::string::npos);
}

TEST(SimulatedCapture, TheDeploymentCannotBeOverridden) {
  Request wanted = request("fastdds-2.6.11");
  wanted.overrides = {"deployment.hosts=3"};
  EXPECT_FALSE(validate(simulated(), wanted));
  wanted.overrides = {"deployment.loopback_delay=60us"};
  EXPECT_TRUE(validate(simulated(), wanted));
  // How hosts are linked no capture shows.
  wanted.overrides = {"deployment.hosts=[{name: one}, {name: two, rate: 54Mbps}]"};
  EXPECT_TRUE(validate(simulated(), wanted));
  wanted.overrides = {"deployment.hosts=[{name: one}]"};
  EXPECT_FALSE(validate(simulated(), wanted));
  wanted.dds = "no-such-profile";
  EXPECT_FALSE(validate(simulated(), wanted));
}

TEST(ValidateReport, AllForms) {
  Request wanted = request("fastdds-2.6.11");
  wanted.within = 1.001;
  const Report report = report_of(wanted);
  const Heading heading{{"a.pcap"}};
  report::Document document = document_of(report, heading);
  document.command = "stormproof validate a.pcap";
  const std::string words = to_text(document);
  EXPECT_NE(words.find("WITHIN a factor of 1.001"), std::string::npos) << words;
  EXPECT_NE(words.find("  stormproof validate a.pcap"), std::string::npos);
  const auto json = to_json(report, heading);
  EXPECT_EQ(json["verdict"], "within");
  constexpr std::size_t of_server = 4;
  EXPECT_EQ(json["figures"].size(), figure_count - of_server);
  EXPECT_EQ(json["figures"]["total"]["ratio"], 1.0);
  EXPECT_EQ(json["over_time"]["heartbeat"]["observed"].size(), observed_steps);
  EXPECT_EQ(json["participants"].size(), 6U);
  const std::string svg = to_svg(report);
  std::size_t panels = 0;
  for (std::size_t at = svg.find("<svg x="); at != std::string::npos;
       at = svg.find("<svg x=", at + 1)) {
    ++panels;
  }
  EXPECT_EQ(panels, growth_curves);
  EXPECT_NE(svg.find("class=\"title\">Discovery messages over time"), std::string::npos);
  EXPECT_NE(svg.find("Messages are compared up to there"), std::string::npos) << "what the line is";
}

}  // namespace simulated_test
}  // namespace stormproof::validate::testing
