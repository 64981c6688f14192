// Several Discovery Servers (specs/guide/discovery-server.md, "Several servers"): clients of all of
// them, clients of one each whose servers know each other, and what is left when one is away.
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/probe.hpp"
#include "model/simulator.hpp"

namespace stormproof::model::fastdds {
namespace several_servers_test {

constexpr std::int64_t ms = 1'000'000;
constexpr Nanoseconds at_ms(std::int64_t time) { return Nanoseconds{time * ms}; }

/// Packets take no time. `participants` and `servers` are lists as a file has them.
Scenario with_servers(const std::string& participants, const std::string& servers,
                      const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{"dds=fastdds-server-2.6.11",
                                     "deployment.participants=[" + participants + "]",
                                     "deployment.servers=[" + servers + "]",
                                     "deployment.loopback_delay=0ms",
                                     "wireless={kind: constant_delay, one_way: 0ms}",
                                     "time_limit=60s",
                                     "deployment.life={}"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  auto read = config::read_scenario("rejoin-fastdds", overrides, config::SpecPath::standard());
  EXPECT_TRUE(read) << (read ? "" : read.error().message);
  return *read;
}
/// Of such a client.
std::string client(int host, const std::string& start, const std::string& servers = "") {
  return "{host: " + std::to_string(host) + ", publications: 1, subscriptions: 1, start: " + start +
         (servers.empty() ? "" : ", servers: [" + servers + "]") + "}";
}
const std::string two = client(0, "0s") + ", " + client(1, "100ms");
const std::string pair_of_servers = "{host: 0}, {host: 1}";

RunResult run(Scenario scenario) { return simulate(scenario); }

/// How often a server has told a client of somebody.
class Told : public Probe {
 public:
  void event_started(const Event& event) override { now_ = event.time; }
  void received(const Packet& packet, std::uint32_t receiver) override {
    if (packet.kind != PacketKind::relayed || !packet.relayed->has_data) return;
    const std::uint32_t teller = topology_->pair(packet.pair).source;
    if (packet.relayed->is_announcement) {
      first_.try_emplace({teller, receiver, packet.relayed->participant}, now_);
    } else {
      ++descriptors[{teller, receiver}];
    }
  }
  void run_started(const Topology& topology) override { topology_ = &topology; }
  [[nodiscard]] std::int64_t first(std::uint32_t teller, std::uint32_t whom,
                                   std::uint32_t of) const {
    const auto found = first_.find({teller, whom, of});
    return found == first_.end() ? -1 : found->second.count() / ms;
  }

  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> descriptors;

 private:
  const Topology* topology_ = nullptr;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, Nanoseconds> first_;
  Nanoseconds now_;
};
RunResult run(const Scenario& scenario, Probe& probe) {
  RunOptions options;
  options.probe = &probe;
  return simulate(scenario, options);
}

void expect_same(const RunResult& one, const RunResult& other) {
  EXPECT_EQ(one.discovery_time, other.discovery_time);
  EXPECT_EQ(one.counts, other.counts);
  EXPECT_EQ(one.events, other.events);
}

/// One that is listed is the one that is there anyway.
TEST(SeveralServers, OneIsAsIfNoneWereListed) {
  Scenario scenario = with_servers(two, "{host: 0}");
  const RunResult listed = run(scenario);
  scenario.deployment.servers.clear();
  EXPECT_TRUE(listed.completed());
  expect_same(listed, run(scenario));
  scenario.deployment.servers = {{HostId{0}, {}}};
  scenario.deployment.participants[0].servers = {0};
  expect_same(listed, run(scenario));
}

/// Where it is counts: on a third host it has both clients across the network.
TEST(SeveralServers, AServerIsOnItsHost) {
  const RunResult beside = run(with_servers(two, "{host: 0}"));
  const RunResult apart = run(with_servers(two, "{host: 2}"));
  EXPECT_TRUE(apart.completed());
  EXPECT_EQ(apart.discovery_time, beside.discovery_time);
  EXPECT_GT(apart.counts.total(), beside.counts.total());
}

/// Each server tells everything, so everything comes twice; the second time it is nothing new.
TEST(SeveralServers, OfARedundantPairEachTellsEverything) {
  const std::vector<std::string> more{"run_until=time_limit", "time_limit=5s"};
  Told told;
  const RunResult result = run(with_servers(two, pair_of_servers, more), told);
  EXPECT_TRUE(result.completed());
  for (const std::uint32_t server : {2U, 3U}) {
    for (const std::uint32_t client : {0U, 1U}) {
      EXPECT_EQ((told.descriptors[{server, client}]), 6U) << server << " " << client;
    }
  }
  EXPECT_EQ(result.discovery_time, run(with_servers(two, "{host: 0}", more)).discovery_time);
  EXPECT_EQ(result.duplicate_deliveries, 12U);
}

/// The other one serves on without a pause; and it is obeyed while the first, which is back before
/// its lease is over, is not.
TEST(SeveralServers, OneOfAPairMayDie) {
  const std::string three = two + ", " + client(0, "13s");
  const std::string restart =
      "deployment.life={restarts: [{participant: 3, stop: 10s, start: 12s}]}";
  EXPECT_FALSE(run(with_servers(three, "{host: 0}", {restart})).completed());
  EXPECT_TRUE(run(with_servers(three, pair_of_servers, {restart})).completed());
  const std::string death = "deployment.life={mute: [{participant: 3, from: 10s}]}";
  const RunResult alone = run(with_servers(three, pair_of_servers, {death}));
  EXPECT_TRUE(alone.completed());
}

/// Who dies while one server lives is told of by that one.
TEST(SeveralServers, WhoDiesIsForgottenWhileOneLives) {
  const std::string deaths =
      "deployment.life={mute: [{participant: 3, from: 10s}, {participant: 1, from: 12s}]}";
  const std::string three = two + ", " + client(0, "200ms");
  EXPECT_FALSE(run(with_servers(three, "{host: 0}", {deaths})).completed());
  EXPECT_TRUE(run(with_servers(three, pair_of_servers, {deaths})).completed());
}

/// Clients of different servers know each other only if the servers do.
TEST(SeveralServers, WhatIsSplitIsCompleteOnceTheServersKnowEachOther) {
  const std::string split = client(0, "0s", "0") + ", " + client(1, "100ms", "1");
  const RunResult apart = run(with_servers(split, pair_of_servers));
  EXPECT_FALSE(apart.completed());
  EXPECT_EQ(apart.missing_count, 12U);
  const RunResult linked = run(with_servers(split, "{host: 0}, {host: 1, servers: [0]}"));
  EXPECT_TRUE(linked.completed());
  const RunResult mutual =
      run(with_servers(split, "{host: 0, servers: [1]}, {host: 1, servers: [0]}"));
  EXPECT_TRUE(mutual.completed());
}

/// What one server tells goes on from server to server; each takes up to a period of its routine,
/// and until an announcement that had to be asked for has been acknowledged: 11 ms and 100 ms.
TEST(SeveralServers, AChainIsPassedHopByHop) {
  std::int64_t before = 0;
  for (int length = 2; length <= 4; ++length) {
    std::string servers = "{host: 0}";
    for (int k = 1; k < length; ++k) {
      servers += ", {host: " + std::to_string(k) + ", servers: [" + std::to_string(k - 1) + "]}";
    }
    const std::string ends =
        client(0, "3s", "0") + ", " + client(length - 1, "3100ms", std::to_string(length - 1));
    const RunResult result = run(with_servers(ends, servers));
    ASSERT_TRUE(result.completed()) << length;
    const std::int64_t time = result.discovery_time->count() / ms;
    if (length > 2) {
      EXPECT_GT(time, before);
      EXPECT_LE(time, before + 450 + 111);
    }
    before = time;
  }
}

/// A server looks for another one again after a loss; meanwhile the clients of both know each other
/// as before. A server that is killed and comes back knowing nothing is found again, too.
TEST(SeveralServers, LinkedServersFindEachOtherAgain) {
  const std::string split =
      client(0, "0s", "0") + ", " + client(1, "100ms", "1") + ", " + client(1, "70s", "1");
  const std::string servers = "{host: 0}, {host: 1, servers: [0]}";
  const std::string cut =
      "deployment.life={outages: [{from: 0, from_reach: host, to: 1, to_reach: host, start: 10s, "
      "end: 50s}, {from: 1, from_reach: host, to: 0, to_reach: host, start: 10s, end: 50s}]}";
  EXPECT_TRUE(run(with_servers(split, servers, {cut, "time_limit=120s"})).completed());
  const std::string restart =
      "deployment.life={restarts: [{participant: 3, stop: 10s, start: 40s}]}";
  EXPECT_TRUE(run(with_servers(split, servers, {restart, "time_limit=120s"})).completed());
}

/// What a server knows from another one alone stays when that dies, and so does who dies with it.
TEST(SeveralServers, WhoDiesWithItsServerStaysKnownBeyondIt) {
  const std::string split = client(0, "0s", "0") + ", " + client(1, "100ms", "1");
  const std::string deaths =
      "deployment.life={mute: [{participant: 3, from: 10s}, {participant: 1, from: 10s}]}";
  const RunResult result =
      run(with_servers(split, "{host: 0}, {host: 1, servers: [0]}", {deaths, "time_limit=200s"}));
  EXPECT_FALSE(result.completed());
  EXPECT_EQ(result.missing_count, 1U);  // client 0 holds client 1
}

TEST(SeveralServers, AreRefusedWhereTheyCannotBe) {
  const Scenario scenario = with_servers(two, pair_of_servers);
  EXPECT_TRUE(config::is_valid(scenario));
  const auto refused = [&](auto&& change) {
    Scenario other = scenario;
    change(other);
    return !config::is_valid(other);
  };
  EXPECT_TRUE(refused([](Scenario& s) { s.deployment.participants[0].servers = {2}; }));
  EXPECT_TRUE(refused([](Scenario& s) { s.deployment.servers[0].servers = {0}; }));
  EXPECT_TRUE(refused([](Scenario& s) { s.deployment.servers[0].servers = {2}; }));
  EXPECT_TRUE(refused([](Scenario& s) {
    s.deployment.servers[0].servers = {1};
    s.dds.server.known = ServerKnown::locator;
  }));
  EXPECT_TRUE(refused([](Scenario& s) { s.dds.discovery = Discovery::simple; }));
  EXPECT_FALSE(refused([](Scenario& s) { s.deployment.life->mute = {{3, at_ms(1)}}; }));
  EXPECT_TRUE(refused([](Scenario& s) { s.deployment.life->mute = {{4, at_ms(1)}}; }));
}

}  // namespace several_servers_test
}  // namespace stormproof::model::fastdds
