// The rules about descriptors as the simulator executes them, 64 at a time, against a letter for
// each descriptor: ACKNACK reception, repair and suppression, written down here once more in the
// plainest way, and random sequences of events over numbers of descriptors around the borders of
// words, with both readings of what an ACKNACK confirms. What the host keeps up to date is compared
// with its definition.
#include <bit>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/paper/protocol.hpp"
#include "tests/model/run_log.hpp"

namespace stormproof::model::paper {
namespace descriptor_rules_test {

using Members = std::set<std::uint32_t>;

DescriptorSet to_set(const Members& members) {
  DescriptorSet set;
  for (const std::uint32_t d : members) set.add(d / 64, std::uint64_t{1} << d % 64);
  return set;
}

/// One relation of `count` descriptors, one letter each.
struct Reference {
  explicit Reference(std::uint32_t count) : state(count, 'U') {}

  /// Returns whether something is requested.
  bool acknack(const Members& bitmap, bool prefix) {
    bool requested = false;
    for (std::uint32_t d = 0; d < state.size(); ++d) {
      if (bitmap.contains(d)) {
        if (state[d] == 'U') state[d] = 'R', requested = true;
      } else if (!prefix || bitmap.empty() || d < *bitmap.begin()) {
        state[d] = 'A';
      }
    }
    return requested;
  }
  bool move(char from, char to) {
    bool moved = false;
    for (char& s : state) {
      if (s == from) s = to, moved = true;
    }
    return moved;
  }

  std::string state;
};

/// Rebuilds the states from what the probe hears, and checks that each transition starts where the
/// last one ended; counts what is scheduled.
class StateProbe final : public Probe {
 public:
  explicit StateProbe(std::uint32_t count) : states(count, 'U') {}

  void transition(const Transition& fired) override {
    const std::uint32_t word = fired.first_word;
    std::uint64_t bits = fired.descriptors;
    if (fired.machine.machine != "DescriptorRepair") return;
    for (; bits != 0; bits &= bits - 1) {
      char& state = states[64 * word + static_cast<std::uint32_t>(std::countr_zero(bits))];
      consistent = consistent && fired.before[0] == state;
      state = fired.after[0];
    }
  }
  void scheduled(std::uint64_t, Nanoseconds, EventKind kind, std::uint32_t) override {
    if (kind == EventKind::repair_generation) ++repairs;
  }

  std::string states;
  int repairs = 0;
  bool consistent = true;
};

/// Two participants on two hosts; relation 0 has `count` descriptors and its writer side is open.
struct Fixture {
  Fixture(std::uint32_t count, bool prefix)
      : scenario{scenario_of(count, prefix)},
        probe{count},
        run{scenario, &probe},
        network{run},
        protocol{run, network} {
    network.attach(protocol);
    run_rule<comp::Happens<rules::WriterOpens>>(protocol, 0);
  }

  static Scenario scenario_of(std::uint32_t count, bool prefix) {
    Scenario scenario = by_hand({{0, count}, {1, 0}});
    if (prefix) scenario.dds.sedp.acknowledge = Acknowledge::prefix;
    return scenario;
  }
  void acknack(const Members& bitmap) {
    Packet packet;
    packet.kind = PacketKind::acknack;
    packet.descriptors = to_set(bitmap);
    run_rule<comp::Received<rules::AckNack>>(protocol, 0, &packet);
  }
  void repair_leaves(const Members& carried) {
    Packet packet;
    packet.kind = PacketKind::data;
    packet.from_repair = true;
    packet.descriptors = to_set(carried);
    run_rule<comp::LeftSource<rules::Data>>(protocol, 0, &packet);
  }

  Scenario scenario;
  StateProbe probe;
  RunState run;
  Network network;
  Protocol protocol;
};

RC_GTEST_PROP(DescriptorRules, AreALetterForEachDescriptor, ()) {
  const auto count = *rc::gen::element<std::uint32_t>(1, 5, 63, 64, 65, 128, 130, 200);
  const auto prefix = *rc::gen::arbitrary<bool>();
  Fixture f{count, prefix};
  Reference reference{count};
  const auto members = [&] {
    return *rc::gen::container<Members>(rc::gen::inRange<std::uint32_t>(0, count));
  };
  for (const int action : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 6))) {
    if (action < 3) {
      const Members bitmap = members();
      const int before = f.probe.repairs;
      f.acknack(bitmap);
      RC_ASSERT((f.probe.repairs > before) == reference.acknack(bitmap, prefix));
    } else if (action == 3) {
      run_rule<comp::Due<rules::RepairGeneration>>(f.protocol, 0);
      reference.move('R', 'Q');
    } else if (action == 4) {
      const Members in_packet = members();
      f.repair_leaves(in_packet);
      for (const std::uint32_t d : in_packet) {
        if (reference.state[d] == 'Q') reference.state[d] = 'S';
      }
    } else {
      run_rule<comp::Due<rules::SuppressionEnd>>(f.protocol, 0);
      reference.move('S', 'U');
    }
    RC_ASSERT(f.probe.consistent);
    RC_ASSERT(f.probe.states == reference.state);
    RunningWorld<Protocol, comp::owner::relation> w{f.protocol, 0};
    RC_ASSERT(w(rules::Waits{}) == rules::Waits::of(w));
    RC_ASSERT(w(rules::SomeReaderWaits{}) == rules::SomeReaderWaits::of(w));
    RC_ASSERT(w(comp::Missing{}) == comp::Missing::of(w));
  }
}

}  // namespace descriptor_rules_test
}  // namespace stormproof::model::paper
