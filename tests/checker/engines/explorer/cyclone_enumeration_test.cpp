// Every tiny run of Cyclone DDS in the simulator is explored, and everything that is explored is a
// run, beside all that the other writers of the two participants say.
#include <sstream>

#include "checker/engines/explorer/relation_world.hpp"
#include "checker/engines/explorer/replayed_packets.hpp"
#include "props/monitors/received_submessages.hpp"
#include "tests/checker/engines/explorer/enumeration.hpp"
#include "tests/checker/engines/explorer/tiny.hpp"

namespace stormproof::explorer {
namespace cyclone_enumeration_test {

using model::Nanoseconds;

/// The parts of packets that are about the explored relation, and when its reader has all samples.
class SampleHistory final : public model::Probe {
 public:
  using Entry = PacketList::Entry;
  std::vector<Entry> packets;
  std::string history;
  std::string until_completion;
  std::optional<Nanoseconds> completion;

  explicit SampleHistory(const Scope& scope) : scope_{scope}, list_{scope} {}
  void run_started(const model::Topology& topology) override { heard_.reset(topology); }
  void event_started(const model::Event& event) override { now_ = event.time; }
  void event_finished(const model::Depths&) override {
    if (completion || received_.size() < scope_.descriptors) return;
    completion = now_;
    until_completion = history;
  }
  void received(const model::Packet& packet, std::uint32_t) override { heard_.arriving(packet); }
  void transition(const model::Transition& fired) override {
    const model::Submessage* heard = heard_.heard(fired.machine, fired.event);
    if (heard != nullptr && fired.event == "DataReceived" && fired.machine.subject == 0) {
      received_.insert(heard->sample);
    }
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    list_.emitted(packet, source, destinations);
    for (; packets.size() < list_.of_relations.size();
         packets.push_back(list_.of_relations[packets.size()])) {
      const Slot& part = list_.of_relations[packets.size()].slot;
      history += word_of(part.what, part.set, 0, false, part.has(Slot::initial),
                         part.has(Slot::carries_heartbeat));
    }
  }

 private:
  const Scope& scope_;
  PacketList list_;
  props::ReceivedSubmessages heard_;
  std::set<std::uint32_t> received_;
  Nanoseconds now_;
};

model::Scenario tiny_cyclone() {
  model::Scenario scenario = tiny_scenario();
  scenario.dds.implementation = model::ImplementationKind::cyclone;
  model::SedpProfile& sedp = scenario.dds.sedp;
  sedp.heartbeat_interval = Nanoseconds{9};
  sedp.heartbeat_interval_max = Nanoseconds{40};
  sedp.match_heartbeat_delay = Nanoseconds{1};
  sedp.ack_delay = Nanoseconds{2};
  sedp.nack_delay = Nanoseconds{5};
  sedp.auto_resched_nack_delay = Nanoseconds{15};
  sedp.preemptive_ack_delay = Nanoseconds{3};
  return scenario;
}

/// What each participant has said, in its order: at the same instant, another relation can wake the
/// thread of one of them before that of the other.
std::string said_by_each(const std::string& history) {
  std::string by_writer;
  std::string by_reader;
  std::istringstream words{history};
  for (std::string word; words >> word;) {
    (word.starts_with('A') ? by_reader : by_writer) += word + " ";
  }
  return by_writer + "| " + by_reader;
}

struct Case {
  const char* name;
  std::int64_t delay;
  unsigned losses;
  unsigned samples;
  bool apart;
  std::uint64_t least_runs;  ///< so that the test is not about next to nothing
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class CycloneRuns : public testing::TestWithParam<Case> {};

TEST_P(CycloneRuns, HaveTheOutcomesOfTheExplorer) {
  const Case& c = GetParam();
  Scope scope;
  scope.descriptors = c.samples;
  scope.losses = c.losses;
  scope.least_delay = Nanoseconds{1};
  scope.largest_delay = Nanoseconds{c.delay};
  scope.side_by_side = c.apart;
  const std::uint64_t runs = expect_equal_outcomes<RelationWorld, SampleHistory>(
      tiny_cyclone(), scope, nullptr, said_by_each);
  EXPECT_GT(runs, c.least_runs);
}

INSTANTIATE_TEST_SUITE_P(Tiny, CycloneRuns,
                         testing::Values(Case{"no_loss", 2, 0, 1, false, 20},
                                         Case{"no_loss_long_delay", 3, 0, 1, false, 5000},
                                         Case{"no_loss_apart", 2, 0, 1, true, 1000},
                                         Case{"one_loss", 1, 1, 1, false, 20},
                                         Case{"one_loss_two_samples", 2, 1, 2, false, 300}),
                         [](const auto& test) { return std::string{test.param.name}; });

}  // namespace cyclone_enumeration_test
}  // namespace stormproof::explorer
