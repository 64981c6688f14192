// A Discovery Server and clients that are lost, die and come back (specs/guide/discovery-server.md,
// "Lives with a server"): who checks whose lease, who is told that somebody is gone, and what
// becomes of a client that returns while the server still tells it.
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/engine/packet.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/probe.hpp"
#include "model/simulator.hpp"

namespace stormproof::model::fastdds {
namespace server_life_test {

constexpr std::int64_t ms = 1'000'000;

/// Clients b1 and b2 on the other host, and a beside the server, which is participant 3. A packet
/// takes no time.
Scenario three(const std::string& life, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{
      "dds=fastdds-server-2.6.11",
      "deployment.participants=[{host: 1, publications: 1, subscriptions: 1, start: 1s}, "
      "{host: 1, publications: 1, subscriptions: 1, start: 2400ms}, "
      "{host: 0, publications: 1, subscriptions: 1, start: 1900ms}]",
      "deployment.loopback_delay=0ms",
      "wireless={kind: constant_delay, one_way: 0ms}",
      "run_until=time_limit",
      "time_limit=60s",
      "deployment.life={" + life + "}"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return *config::read_scenario("rejoin-fastdds", overrides, config::SpecPath::standard());
}
constexpr std::uint32_t b1 = 0;
constexpr std::uint32_t b2 = 1;
constexpr std::uint32_t a = 2;
constexpr std::uint32_t server = 3;

/// The host of b1 and b2 is cut off.
std::string cut(const std::string& start, const std::string& end) {
  const std::string times = ", start: " + start + ", end: " + end + "}";
  return "outages: [{from: 1, from_reach: host, to: 0, to_reach: all" + times +
         ", {from: 0, from_reach: all, to: 1, to_reach: host" + times + "]";
}

Scenario without_life(Scenario scenario) {
  scenario.deployment.life.reset();
  return scenario;
}

/// When the server has told whom that who is gone, or that who is there, and when it has announced
/// itself to whom; in an outage nobody heeds it.
class Told : public Probe {
 public:
  struct Telling {
    Nanoseconds time;
    std::uint32_t whom = 0;
    std::uint32_t of = 0;
    bool goodbye = false;
  };
  void event_started(const Event& event) override { now_ = event.time; }
  void received(const Packet& packet, std::uint32_t receiver) override {
    if (packet.kind != PacketKind::relayed || !packet.relayed->has_data) return;
    if (!packet.relayed->is_announcement) return;
    all.push_back({now_, receiver, packet.relayed->participant, packet.relayed->is_goodbye});
  }
  [[nodiscard]] std::optional<std::int64_t> first(std::uint32_t whom, std::uint32_t of,
                                                  bool goodbye, Nanoseconds from = {}) const {
    for (const Telling& one : all) {
      if (one.whom == whom && one.of == of && one.goodbye == goodbye && one.time >= from) {
        return one.time.count() / ms;
      }
    }
    return {};
  }

  std::vector<Telling> all;

 private:
  Nanoseconds now_;
};
RunResult run(const Scenario& scenario, Probe& probe) {
  RunOptions options;
  options.probe = &probe;
  return simulate(scenario, options);
}
constexpr Nanoseconds at_ms(std::int64_t time) { return Nanoseconds{time * ms}; }

/// Announcements end at start + 0.5 s, then every 3 s; the server's, too, which without a life says
/// nothing of itself.
TEST(ServerLife, TheServerAnnouncesItself) {
  Told told;
  const RunResult result = run(three(""), told);
  EXPECT_TRUE(result.completed());
  EXPECT_EQ(told.first(b1, server, false, at_ms(3'400)), 3'500);
  EXPECT_EQ(told.first(b1, server, false, at_ms(3'501)), 6'500);
  EXPECT_EQ(told.first(a, server, false, at_ms(57'000)), 57'500);
  EXPECT_EQ(result.discovery_time, simulate(without_life(three(""))).discovery_time);
}

/// Nobody is forgotten in an outage that ends before the leases.
TEST(ServerLife, AnOutageOfFifteenSecondsCostsNothing) {
  Told told;
  const RunResult result = run(three(cut("10s", "25s")), told);
  EXPECT_TRUE(result.completed());
  EXPECT_EQ(result.recovery_time, Nanoseconds{});
  EXPECT_EQ(told.first(a, b1, true), std::nullopt);
}

/// The server last hears b1 at 7.5 and b2 at 8.9.
TEST(ServerLife, TheServerTellsWhomItHasLost) {
  Told told;
  (void)run(three(cut("10s", "60s")), told);
  EXPECT_EQ(told.first(a, b1, true), 27'500);
  EXPECT_EQ(told.first(a, b2, true), 28'900);
}

/// b1's goodbye waits for b2, which hears of it only after b1 has announced itself again: b1 is
/// dropped, and nobody hears of it any more. Since 2.14.5 it is anybody new.
TEST(ServerLife, WhoReturnsWhileItsGoodbyeIsToldIsLost) {
  const std::string outage = cut("10s", "28400ms");
  Told told;
  const RunResult lost = run(three(outage, {"time_limit=120s"}), told);
  EXPECT_EQ(told.first(b2, b1, true, at_ms(28'400)), 28'661);
  EXPECT_FALSE(lost.completed());
  EXPECT_EQ(told.first(a, b1, false, at_ms(28'000)), std::nullopt);
  EXPECT_EQ(told.first(b2, b1, false, at_ms(28'000)), std::nullopt);
  Told known;
  const RunResult fixed = run(three(outage, {"dds.rejoin=known", "time_limit=120s"}), known);
  EXPECT_TRUE(fixed.completed());
  EXPECT_EQ(known.first(a, b1, false, at_ms(28'000)), 28'570);
}

/// A client that is dropped loses the server, which does not announce itself to it, and finds it by
/// an initial ACKNACK: 70 ms, then 11 ms to the request and 100 ms to the answer; again and again.
TEST(ServerLife, WhoIsDroppedLosesTheServerAgainAndAgain) {
  Told told;
  (void)run(three(cut("10s", "28400ms"), {"time_limit=120s"}), told);
  const auto first = told.first(b1, server, false, at_ms(40'000));
  ASSERT_TRUE(first);
  const auto second = told.first(b1, server, false, at_ms(*first + 1'000));
  ASSERT_TRUE(second);
  EXPECT_EQ(*first, 48'762);
  EXPECT_EQ(*second, 69'282);
}

/// A client that dies is told of when its lease is over; its successor is there long before.
TEST(ServerLife, ADeathIsOverWhenTheServerTellsIt) {
  Told told;
  const RunResult result =
      run(three("restarts: [{participant: 0, stop: 8s, start: 10s, identity: new}]"), told);
  EXPECT_TRUE(result.completed());
  EXPECT_EQ(told.first(a, b1, true), 27'500);
  EXPECT_EQ(result.discovery_time->count() / ms, 27'500);
}

/// Clients check no lease but the server's: who dies while no server lives stays known to all.
TEST(ServerLife, WhoDiesWhileNoServerLivesStaysKnown) {
  Told told;
  const RunResult result = run(three("mute: [{participant: 3, from: 10s}, {participant: 0, from: "
                                     "12s}]",
                                     {"time_limit=120s"}),
                               told);
  EXPECT_FALSE(result.completed());
  EXPECT_EQ(result.missing_count, 2U);  // a and b2 hold b1; all have forgotten the server
  EXPECT_EQ(told.first(a, b1, true), std::nullopt);
}

/// A server that is away until the clients have forgotten it is as at its start: its last
/// announcement is that of 9.5, the clients look for it from 29.5 on every 450 ms.
TEST(ServerLife, AServerThatComesBackLateIsObeyed) {
  Told told;
  const RunResult result =
      run(three("restarts: [{participant: 3, stop: 10s, start: 45s}]", {"time_limit=120s"}), told);
  EXPECT_TRUE(result.completed());
  EXPECT_EQ(result.recovery_time, Nanoseconds{});  // nobody has forgotten another client
  for (const std::uint32_t client : {b1, b2, a}) {
    const auto met = told.first(client, server, false, at_ms(44'000));
    ASSERT_TRUE(met);
    EXPECT_LE(*met, 45'450 + 200) << client;
  }
}

/// One that comes back before that numbers everything anew, which the clients take for old news: a
/// fourth, which starts a second after the server's return, is never told to the first and the
/// third. After a longer absence it is told to all.
TEST(ServerLife, AServerThatComesBackEarlyIsNotObeyed) {
  const auto with_newcomer = [](const std::string& back, const std::string& newcomer) {
    Scenario scenario =
        three("restarts: [{participant: 4, stop: 10s, start: " + back + "}]",
              {"deployment.participants=[{host: 1, publications: 1, subscriptions: 1, start: 1s}, "
               "{host: 1, publications: 1, subscriptions: 1, start: 2400ms}, {host: 0, "
               "publications: 1, subscriptions: 1, start: 1900ms}, {host: 0, publications: 1, "
               "subscriptions: 1, start: " +
                   newcomer + "}]",
               "time_limit=600s"});
    return simulate(scenario);
  };
  const RunResult ignored = with_newcomer("12s", "13s");
  EXPECT_EQ(ignored.missing_count, 12U);
  for (const MissingDescriptor& missing : ignored.missing) {
    EXPECT_EQ(missing.source.value, 3U);
    EXPECT_TRUE(missing.destination.value == b1 || missing.destination.value == a);
  }
  EXPECT_TRUE(with_newcomer("45s", "46s").completed());
  EXPECT_TRUE(with_newcomer("12s", "30s").completed());  // its numbers are above those of before
}

TEST(ServerLife, IsRefusedWhereItHasNoRules) {
  EXPECT_TRUE(config::is_valid(three("mute: [{participant: 3, from: 1s}]")));
  Scenario scenario = three("");
  scenario.deployment.life->mute.push_back({4, {}});
  EXPECT_FALSE(config::is_valid(scenario));
  scenario = three("");
  scenario.deployment.life->stale.push_back({0, 2});
  EXPECT_FALSE(config::is_valid(scenario));
  scenario = three("");
  scenario.deployment.life->restarts.push_back({0, at_ms(5'000), at_ms(6'000), Identity::same});
  EXPECT_FALSE(config::is_valid(scenario));
}

}  // namespace server_life_test
}  // namespace stormproof::model::fastdds
