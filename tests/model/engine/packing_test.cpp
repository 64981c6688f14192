// What a composition leaves to the host is packing: which descriptors share a packet. Its contract
// (`Generate` and `Pack` of fsm/composition) says that a generation is put into packets completely,
// each descriptor once, in order, and that HEARTBEATs ride or follow only where piggybacking is on.
// Here the simulator is held to it, in random runs of both implementations.
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/probe.hpp"
#include "model/simulator.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof::model {
namespace packing_test {

using Descriptors = std::vector<std::uint32_t>;

/// What one event generated for a relation, and the packets that it was put into.
struct Generation {
  Descriptors generated;  ///< as its machine says: R→Q (paper), Q→S (Fast DDS); in that order
  std::vector<Descriptors> packets;
  std::vector<bool> with_heartbeat;
};

/// Which rule of the contract the packets of a generation break; nothing: none.
std::optional<std::string> broken(const Generation& generation, bool piggyback) {
  Descriptors packed;
  for (std::size_t k = 0; k < generation.packets.size(); ++k) {
    const Descriptors& packet = generation.packets[k];
    packed.insert(packed.end(), packet.begin(), packet.end());
    if (packet.empty()) return "a packet without descriptors";
    if (generation.with_heartbeat[k] && !piggyback) return "a HEARTBEAT rides though none may";
  }
  if (std::set<std::uint32_t>(packed.begin(), packed.end()).size() != packed.size()) {
    return "a descriptor twice";
  }
  if (packed != generation.generated) return "packets that are not what was generated, in order";
  return std::nullopt;
}

/// Collects the generations of repairs, event by event.
class Packing : public Probe {
 public:
  explicit Packing(const Scenario& scenario)
      : piggyback_{scenario.dds.sedp.piggyback != Piggyback::off} {}

  void event_started(const Event&) override { now_.clear(); }
  void transition(const Transition& fired) override {
    const bool paper =
        fired.machine.machine == "DescriptorRepair" && fired.before == "R" && fired.after == "Q";
    const bool fastdds =
        fired.machine.machine == "ChangeForReader" && fired.before == "Q" && fired.after == "S";
    if (!paper && !fastdds) return;
    for (std::uint32_t bit = 0; bit < 64; ++bit) {
      if ((fired.descriptors >> bit & 1) == 0) continue;
      now_[fired.machine.subject].generated.push_back(fired.first_word * 64 + bit);
    }
  }
  void emitted(const Packet& packet, std::uint32_t /*source*/,
               std::span<const std::uint32_t> /*destinations*/) override {
    if (packet.kind != PacketKind::data) return;
    const auto found = now_.find(packet.relation());
    if (found == now_.end()) return;  // initial DATA of the paper: no machine moves
    Descriptors carried;
    packet.descriptors.for_each([&](std::uint32_t d) { carried.push_back(d); });
    found->second.packets.push_back(std::move(carried));
    found->second.with_heartbeat.push_back(packet.carries_heartbeat);
  }
  void event_finished(const Depths&) override {
    for (auto& [relation, generation] : now_) {
      // Between participants of one host nothing is emitted.
      if (!topology_->pair(relation / 2).cross_host) continue;
      ++generations;
      several += generation.packets.size() > 1;
      const auto problem = broken(generation, piggyback_);
      if (problem && first_problem.empty()) first_problem = *problem;
    }
  }
  void run_started(const Topology& topology) override { topology_ = &topology; }

  std::uint64_t generations = 0;
  std::uint64_t several = 0;  ///< those that needed more than one packet
  std::string first_problem;

 private:
  bool piggyback_;
  const Topology* topology_ = nullptr;
  std::map<std::uint32_t, Generation> now_;
};

class PackingOf : public testing::TestWithParam<ImplementationKind> {};

TEST_P(PackingOf, KeepsItsContractInRandomRuns) {
  std::uint64_t generations = 0;
  std::uint64_t several = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Scenario scenario = oracle::random_scenario(seed, GetParam());
    Packing packing{scenario};
    RunOptions options;
    options.probe = &packing;
    static_cast<void>(simulate(scenario, options));
    EXPECT_EQ(packing.first_problem, "") << "seed " << seed;
    generations += packing.generations;
    several += packing.several;
  }
  EXPECT_GT(generations, 1000U);
  EXPECT_GT(several, 50U);
}

INSTANTIATE_TEST_SUITE_P(Both, PackingOf,
                         testing::Values(ImplementationKind::paper, ImplementationKind::fastdds));

TEST(PackingContract, CanBeBroken) {
  const Generation kept{{1, 2, 5}, {{1, 2}, {5}}, {false, false}};
  EXPECT_EQ(broken(kept, false), std::nullopt);
  EXPECT_NE(broken({{1, 2, 5}, {{1, 2}}, {false}}, false), std::nullopt);           // forgotten
  EXPECT_NE(broken({{1, 2}, {{1, 2}, {5}}, {false, false}}, false), std::nullopt);  // not asked for
  EXPECT_NE(broken({{1, 2}, {{1, 2}, {2}}, {false, false}}, false), std::nullopt);  // twice
  EXPECT_NE(broken({{1, 2}, {{2}, {1}}, {false, false}}, false), std::nullopt);     // out of order
  EXPECT_NE(broken({{1}, {{1}, {}}, {false, false}}, false), std::nullopt);
  const Generation riding{{1}, {{1}}, {true}};
  EXPECT_EQ(broken(riding, true), std::nullopt);
  EXPECT_NE(broken(riding, false), std::nullopt);
}

}  // namespace packing_test
}  // namespace stormproof::model
