// The bridge between executing and proving: every step that an execution of the rules takes, seen
// by each descriptor of each relation, is a step of the derived system. What the derivation
// forgets, an effect that only another descriptor or reader causes, shows up here, and deliberate
// mistakes in it do. The states are compared as a whole; only what is watched besides is left open.
#include <gtest/gtest.h>

#include "checker/engines/tables/descriptor_system.hpp"
#include "tests/fsm/composition/small_world.hpp"

namespace stormproof::tables {
namespace bridge_test {

namespace comp = fsm::composition;

using Values = std::map<std::string, std::int64_t>;

/// The state as the descriptor at `place` sees it, by the names of the system's variables.
template <class Composition>
Values seen_from(const comp::SmallState& state, const comp::Place& place) {
  Values values;
  const auto at = [&]<class T>() { return comp::Key{fsm::name_of<T>(), place.of(T::owner)}; };
  comp::for_each_type(typename Composition::Parts{}, [&]<class P>() {
    const auto found = state.values.find(at.template operator()<P>());
    const std::int64_t now = found == state.values.end() ? 0 : found->second;
    const auto& names = fsm::Reflect<typename P::Machine>::state_names;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string name = std::string{fsm::name_of<P>()} + "=" + std::string{names[k]};
      values[name] = now == static_cast<std::int64_t>(k) ? 1 : 0;
    }
  });
  comp::for_each_type(typename Composition::State{}, [&]<class V>() {
    if constexpr (requires { typename V::IsFlag; }) {
      const auto found = state.values.find(at.template operator()<V>());
      values[std::string{fsm::name_of<V>()}] = found == state.values.end() ? 0 : found->second;
    }
  });
  comp::for_each_type(typename Composition::Timers{}, [&]<class T>() {
    const comp::Key key = at.template operator()<T>();
    const std::string name{fsm::name_of<T>()};
    if constexpr (T::counted) {
      const auto found = state.pending.find(key);
      values["pending " + name] = found == state.pending.end() ? 0 : found->second;
    } else {
      values["pending " + name] = state.surely_pending.contains(key) ? 1 : 0;
      values["started " + name] = state.started.contains(key) ? 1 : 0;
    }
  });
  comp::for_each_type(typename Composition::Packets{}, [&]<class P>() {
    for (const comp::SentPacket& packet : state.sent) {
      if (packet.name != fsm::name_of<P>() || packet.place != place.of(P::owner)) continue;
      std::string name = "sent " + packet.name;
      comp::for_each_type(typename P::Fields{}, [&]<class F>() {
        const std::uint32_t said = packet.says.at(std::string{fsm::name_of<F>()});
        const bool of_descriptor = std::derived_from<F, comp::DescriptorField>;
        const bool says = of_descriptor ? (said >> place.descriptor & 1) != 0 : said != 0;
        if (says) name += " " + std::string{fsm::name_of<F>()};
      });
      values[name] = 1;
    }
  });
  return values;
}

/// How the derivation calls a rule that happens at `where`, seen from `place`.
std::string step_name(const std::string& rule, comp::Owner owner, const comp::Place& where,
                      const comp::Place& place) {
  const comp::Place own = place.of(owner);
  const comp::Place there = where.of(owner);
  if (own.stream != there.stream) return "another stream: " + rule;
  if (own.peer != there.peer) return "another reader: " + rule;
  if (own.descriptor != there.descriptor) return "another descriptor: " + rule;
  return rule;
}

/// Asks whether the system has certain steps.
class Bridge {
 public:
  explicit Bridge(const TransitionSystem& system) : system_{system} {}

  bool has(const std::string& name, const Values& before, const Values& after) {
    Exprs from;
    Exprs to;
    for (const Expr& variable : system_.variables) {
      const auto value = value_of(variable, before);
      if (!value) continue;
      from.push_back(variable);
      to.push_back(*value);
    }
    for (const SystemStep& step : system_.steps) {
      if (step.name != name) continue;
      Exprs conditions{with(step.guard, from, to)};
      for (std::size_t v = 0; v < system_.variables.size(); ++v) {
        const auto value = value_of(system_.variables[v], after);
        if (value) conditions.push_back(with(step.next[v], from, to) == *value);
      }
      z3::solver solver{context(), z3::solver::simple()};
      for (const Expr& condition : conditions) solver.add(condition);
      if (solver.check() == z3::sat) return true;
    }
    return false;
  }

 private:
  static z3::context& context() { return smt::SymbolicContext::current(); }
  /// Nothing for what is watched besides.
  static std::optional<Expr> value_of(const Expr& variable, const Values& values) {
    const std::string name = variable.decl().name().str();
    for (const char* bit : {watched::asked, watched::unasked_repair, watched::generated,
                            watched::lists, watched::listed_at_first}) {
      if (name == bit) return std::nullopt;
    }
    const auto found = values.find(name);
    const std::int64_t value = found == values.end() ? 0 : found->second;
    return variable.is_bool() ? context().bool_val(value != 0) : context().int_val(value);
  }

  const TransitionSystem& system_;
};

struct Crossing {
  std::size_t distinct = 0;  ///< steps that change what a descriptor sees
  std::vector<std::string> refused;
};

/// Random walks under this profile; every step is looked for in the system, from every place. A
/// derivation with a mistake is done with once a step is refused.
template <class Composition>
Crossing cross(const model::DdsProfile& dds, Unsound unsound, unsigned walks, unsigned seed) {
  z3::context context;
  const smt::SymbolicContext current{context};
  const model::Mutation correct;
  const DescriptorSystem derived{dds, correct, unsound};
  const TransitionSystem system = derived.whole();
  Bridge bridge{system};
  Crossing crossing;
  std::set<std::tuple<std::string, Values, Values>> seen;
  std::mt19937_64 dice{seed};
  for (unsigned walk = 0; walk < walks; ++walk) {
    comp::SmallState state;
    for (unsigned k = 0; k < 400; ++k) {
      if (unsound != Unsound::none && !crossing.refused.empty()) return crossing;
      const comp::SmallState before = state;
      comp::random_step<Composition>(
          state, dds, dice, [&](const std::string& rule, comp::Owner owner, comp::Place where) {
            for (int s = 0; s < comp::small_streams; ++s) {
              for (int d = 0; d < comp::small_descriptors; ++d) {
                const comp::Place place{s, 0, d};
                const Values from = seen_from<Composition>(before, place);
                const Values to = seen_from<Composition>(state, place);
                const std::string name = step_name(rule, owner, where, place);
                if (from == to || !seen.emplace(name, from, to).second) continue;
                ++crossing.distinct;
                if (!bridge.has(name, from, to)) crossing.refused.push_back(name);
              }
            }
          });
    }
  }
  return crossing;
}

std::string first_of(const Crossing& crossing) {
  return crossing.refused.empty() ? "" : crossing.refused.front();
}

model::DdsProfile paper() { return {}; }
model::DdsProfile fastdds() {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  return dds;
}

TEST(Bridge, EveryStepOfThePapersRulesIsDerived) {
  model::DdsProfile pull = paper();
  pull.sedp.relation_opening = model::RelationOpening::each_side;
  pull.sedp.initial_data = model::InitialData::pull;
  pull.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  pull.sedp.acknowledge = model::Acknowledge::prefix;
  pull.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  model::DdsProfile adaptive = paper();
  adaptive.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  adaptive.sedp.initial_acknack_delay = model::Nanoseconds{0};
  for (const model::DdsProfile& dds : {paper(), pull, adaptive}) {
    const Crossing crossing = cross<comp::paper::Paper>(dds, Unsound::none, 16, 1);
    EXPECT_GT(crossing.distinct, 400U);
    EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  }
}

TEST(Bridge, EveryStepOfFastDdssRulesIsDerived) {
  model::DdsProfile adaptive = fastdds();
  adaptive.sedp.heartbeat_policy = model::HeartbeatPolicy::adaptive;
  for (const model::DdsProfile& dds : {fastdds(), adaptive}) {
    const Crossing crossing = cross<comp::fastdds::FastDds>(dds, Unsound::none, 4, 1);
    EXPECT_GT(crossing.distinct, 400U);
    EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  }
}

TEST(Bridge, RefusesADerivationThatForgetsOthers) {
  for (const Unsound mistake : {Unsound::others_never_ask, Unsound::rules_for_us_only,
                                Unsound::loops_for_us_only, Unsound::packets_arrive_once}) {
    const Crossing crossing = cross<comp::fastdds::FastDds>(fastdds(), mistake, 2, 1);
    EXPECT_FALSE(crossing.refused.empty()) << static_cast<int>(mistake);
  }
  for (const Unsound mistake :
       {Unsound::others_never_ask, Unsound::rules_for_us_only, Unsound::packets_arrive_once}) {
    const Crossing crossing = cross<comp::paper::Paper>(paper(), mistake, 2, 1);
    EXPECT_FALSE(crossing.refused.empty()) << static_cast<int>(mistake);
  }
}

}  // namespace bridge_test
}  // namespace stormproof::tables
