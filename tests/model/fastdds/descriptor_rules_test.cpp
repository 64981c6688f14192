// The descriptors of a relation as the simulator keeps them, 64 at a time, against a letter for
// each: what Fast DDS's rules do to them, written down here once more in the plainest way, and
// random sequences of events over numbers of descriptors around the borders of words. What rules
// ask of them is compared too.
#include <bit>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "model/fastdds/protocol.hpp"
#include "tests/model/fastdds/one_writer.hpp"

namespace stormproof::model::fastdds {
namespace descriptor_rules_test {

namespace change = fsm::change_for_reader;
using Members = std::set<std::uint32_t>;
using World = RunningWorld<Protocol, comp::owner::relation>;
using DescriptorWorld = RunningWorld<Protocol, comp::owner::descriptor>;
constexpr std::uint32_t relation = 0;
constexpr std::uint32_t writer = 0;

/// Rebuilds the states from what the probe hears; '-' is a descriptor that does not exist.
class StateProbe final : public Probe {
 public:
  explicit StateProbe(std::uint32_t count) : states(count, '-') {}

  void transition(const Transition& fired) override {
    const std::uint32_t word = fired.first_word;
    std::uint64_t bits = fired.descriptors;
    if (fired.machine.machine != "ChangeForReader") return;
    for (; bits != 0; bits &= bits - 1) {
      char& state = states.at(64 * word + static_cast<std::uint32_t>(std::countr_zero(bits)));
      consistent = consistent && state == letter(fired.before);
      state = letter(fired.after);
    }
  }

  std::string states;
  bool consistent = true;

 private:
  static char letter(std::string_view name) { return name == "Absent" ? '-' : name[0]; }
};

/// A writer of `count` descriptors whose reader is matched when the first `existing` exist.
struct Fixture {
  Fixture(std::uint32_t count, std::uint32_t existing)
      : scenario{scenario_of(count)},
        probe{count},
        run{scenario, &probe, nullptr, SameHostPairs::included},
        network{run},
        protocol{run, network} {
    network.attach(protocol);
    for (std::uint32_t d = 0; d < existing; ++d) protocol.assign(rules::Exists{}, writer, d, true);
    run_rule<comp::Happens<rules::WriterOpens>>(protocol, relation);
  }

  static Scenario scenario_of(std::uint32_t count) {
    Scenario scenario = one_writer();
    scenario.deployment.participants[0].publications = count - default_publications;
    return scenario;
  }
  World world() { return World{protocol, relation}; }
  DescriptorWorld descriptor(std::uint32_t d) {
    return DescriptorWorld{protocol, relation, nullptr, d};
  }
  void acknack(std::uint32_t base, const Members& bitmap, bool initial = false) {
    Packet packet;
    packet.kind = PacketKind::acknack;
    packet.detail = base;
    packet.initial_acknack = initial;
    for (const std::uint32_t d : bitmap) {
      packet.descriptors.add(d / 64, std::uint64_t{1} << d % 64);
    }
    run_rule<comp::Received<rules::AckNack>>(protocol, relation, &packet);
  }
  template <class E>
  auto each(comp::On<E> event) {
    World w = world();
    return w.feed_each(rules::C{}, event);
  }
  void create(std::uint32_t d) {
    protocol.assign(rules::Exists{}, writer, d, true);
    descriptor(d).feed(rules::C{}, comp::on<change::Created>);
  }
  void serialize(std::uint32_t d) { descriptor(d).feed(rules::C{}, comp::on<change::Serialized>); }
  bool is_queued(std::uint32_t d) { return descriptor(d).in(rules::C{}, comp::is<change::Q>); }
  bool has_unacknowledged() {
    return world().some([](auto& d) { return d.in(rules::C{}, comp::is<change::U>); });
  }
  bool all_acknowledged() {
    return world().all(
        [](auto& d) { return !d(rules::Exists{}) || d.in(rules::C{}, comp::is<change::A>); });
  }

  Scenario scenario;
  StateProbe probe;
  RunState run;
  Network network;
  Protocol protocol;
};

/// The same in letters.
struct Letters {
  void acknack(std::uint32_t base, const Members& bitmap) {
    for (std::uint32_t d = 0; d < state.size(); ++d) {
      if (state[d] == '-') continue;
      if (d < base)
        state[d] = 'A';
      else if (bitmap.contains(d) && state[d] == 'U')
        state[d] = 'R';
    }
  }
  Members move(char from, char to) {
    Members moved;
    for (std::uint32_t d = 0; d < state.size(); ++d) {
      if (state[d] != from) continue;
      state[d] = to;
      moved.insert(d);
    }
    return moved;
  }
  std::string state;
};

/// One random event on both; returns whether they agree on its result.
bool step(Fixture& f, Letters& letters, std::uint32_t& created) {
  const auto count = static_cast<std::uint32_t>(letters.state.size());
  const auto below = [](std::uint32_t limit) { return *rc::gen::inRange<std::uint32_t>(0, limit); };
  switch (below(7)) {
    case 0: {
      const std::uint32_t base = below(created + 1);
      Members bitmap;
      for (std::uint32_t d = base; d < created; ++d) {
        if (*rc::gen::arbitrary<bool>()) bitmap.insert(d);
      }
      f.acknack(base, bitmap);
      letters.acknack(base, bitmap);
      return true;
    }
    case 1:
      f.acknack(0, {}, true);
      letters.move('A', 'U');
      return true;
    case 2: {
      Members enqueued;
      f.each(comp::on<change::NackResponseDue>).enqueue.for_each([&](std::uint32_t d) {
        enqueued.insert(d);
      });
      return enqueued == letters.move('R', 'Q');
    }
    case 3: {
      const std::uint32_t d = below(count);
      const bool queued = letters.state[d] == 'Q';
      if (f.is_queued(d) != queued) return false;
      if (!queued) return true;
      f.serialize(d);
      letters.state[d] = 'S';
      return true;
    }
    case 4:
      f.each(comp::on<change::SuppressionEnded>);
      letters.move('S', 'U');
      return true;
    default:
      if (created == count) return true;
      f.create(created);
      letters.state[created++] = 'Q';
      return true;
  }
}

RC_GTEST_PROP(FastddsDescriptorRules, AreALetterForEachDescriptor, ()) {
  const auto count = *rc::gen::element<std::uint32_t>(9, 63, 64, 65, 127, 128, 129);
  auto created = *rc::gen::inRange<std::uint32_t>(0, count + 1);
  Fixture f{count, created};
  Letters letters{std::string(created, 'U') + std::string(count - created, '-')};
  for (int k = 0; k < 60; ++k) {
    RC_ASSERT(step(f, letters, created));
    RC_ASSERT(f.probe.states == letters.state);
    RC_ASSERT(f.probe.consistent);
    RC_ASSERT(f.has_unacknowledged() == (letters.state.find('U') != std::string::npos));
    const bool all = letters.state.substr(0, created).find_first_not_of('A') == std::string::npos;
    RC_ASSERT(f.all_acknowledged() == all);
    World w = f.world();
    RC_ASSERT(w(rules::HasDescriptors{}) == rules::HasDescriptors::of(w));
    RC_ASSERT(w(rules::HasReaders{}) == rules::HasReaders::of(w));
    RC_ASSERT(w(comp::Missing{}) == comp::Missing::of(w));
  }
}

}  // namespace descriptor_rules_test
}  // namespace stormproof::model::fastdds
