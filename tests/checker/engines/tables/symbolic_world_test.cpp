// What the symbolic world does is what executing the same rule does: every step of random walks
// through the rules, in all variables and timers at once, is one for which the symbolic step has
// inputs. A world that leaves an effect out is refused.
#include <gtest/gtest.h>

#include "checker/engines/tables/event_kinds.hpp"
#include "tests/fsm/composition/small_world.hpp"

namespace stormproof::tables {
namespace symbolic_world_test {

namespace comp = fsm::composition;

using Values = std::map<std::string, std::int64_t>;

constexpr Extent small{.descriptors = comp::small_descriptors,
                       .readers = comp::small_peers,
                       .streams = comp::small_streams};

/// The readers of the small world are peers from 0 on, of a participant that it does not name.
Place place_of(const comp::Place& place) {
  return {.stream = place.stream, .peer = place.peer + 1, .descriptor = place.descriptor};
}

/// The state in the names of the symbolic world; what is 0 or false is missing.
template <class Composition>
Values named(const comp::SmallState& state) {
  Values values;
  const auto each = [](const auto& map, std::string_view name, auto&& visit) {
    for (const auto& [key, value] : map) {
      if (key.first == name) visit(key.second, value);
    }
  };
  const auto at = [](comp::Place place, comp::Owner owner) {
    return place_of(place).of(owner.indices).text();
  };
  comp::for_each_type(typename Composition::Parts{}, [&]<class P>() {
    const auto& names = fsm::Reflect<typename P::Machine>::state_names;
    each(state.values, fsm::name_of<P>(), [&](comp::Place place, std::int64_t now) {
      values[std::string{fsm::name_of<P>()} + "=" +
             std::string{names[static_cast<std::size_t>(now)]} + at(place, P::owner)] = 1;
    });
  });
  comp::for_each_type(typename Composition::State{}, [&]<class V>() {
    each(state.values, fsm::name_of<V>(), [&](comp::Place place, std::int64_t now) {
      values[std::string{fsm::name_of<V>()} + at(place, V::owner)] = now;
    });
  });
  comp::for_each_type(typename Composition::Timers{}, [&]<class T>() {
    each(state.pending, fsm::name_of<T>(), [&](comp::Place place, std::int64_t now) {
      values["pending " + std::string{fsm::name_of<T>()} + at(place, T::owner)] = now;
    });
  });
  return values;
}

/// What a variable that is not named has: nothing, and a machine its initial state.
template <class Composition>
std::int64_t value_of(const std::string& name, const Values& values) {
  const auto found = values.find(name);
  if (found != values.end()) return found->second;
  std::int64_t value = 0;
  comp::for_each_type(typename Composition::Parts{}, [&]<class P>() {
    using Info = fsm::Reflect<typename P::Machine>;
    const std::string part{fsm::name_of<P>()};
    const std::string start =
        part + "=" +
        std::string{Info::state_names[Info::template id<typename P::Machine::initial_state>]};
    const std::string place =
        name.find(" (") == std::string::npos ? "" : name.substr(name.find(" ("));
    if (name != start + place) return;
    value = 1;
    for (const std::string_view state : Info::state_names) {
      if (values.contains(part + "=" + std::string{state} + place)) value = 0;
    }
  });
  return value;
}

Expr constant_of(const Expr& like, std::int64_t value) {
  z3::context& context = smt::SymbolicContext::current();
  return like.is_bool() ? context.bool_val(value != 0) : context.int_val(value);
}

/// Whether the rule at `where` has inputs with which it leads from one state to the other.
template <class Composition, class R>
bool has_step(const comp::SmallState& before, const comp::SmallState& after, comp::Place where) {
  const std::vector<fsm::TableMutation> none;
  SymbolicRun run{small, none};
  SymbolicWorld<Composition> world{run, "a.", place_of(where)};
  (void)world.template trigger<typename R::Trigger>();
  R::run(world);
  const Values from = named<Composition>(before);
  const Values to = named<Composition>(after);
  z3::solver solver{smt::SymbolicContext::current(), z3::solver::simple()};
  for (const auto& [name, variable] : run.variables()) {
    solver.add(variable.at_first ==
               constant_of(variable.at_first, value_of<Composition>(name, from)));
    solver.add(variable.now == constant_of(variable.now, value_of<Composition>(name, to)));
  }
  // What is not touched stays, and what is started is pending once more.
  Values untouched = from;
  for (const auto& [name, value] : to) untouched.try_emplace(name, 0);
  for (const auto& [name, ignored] : untouched) {
    if (run.variables().contains(name)) continue;
    const std::int64_t more = value_of<Composition>(name, to) - value_of<Composition>(name, from);
    const std::string timer = name.starts_with("pending ") ? name.substr(8) : "";
    Expr starts = smt::SymbolicContext::current().int_val(0);
    for (const SymbolicEffect& effect : run.effects()) {
      if (effect.what != timer) continue;
      starts = starts + z3::ite(effect.when, smt::SymbolicContext::current().int_val(1),
                                smt::SymbolicContext::current().int_val(0));
    }
    const bool is_due =
        std::is_same_v<typename R::Trigger, comp::Due<typename R::Trigger::Cause>> &&
        timer == std::string{fsm::name_of<typename R::Trigger::Cause>()} +
                     place_of(where).of(R::owner.indices).text();
    solver.add(starts == smt::SymbolicContext::current().int_val(more + (is_due ? 1 : 0)));
  }
  return solver.check() == z3::sat;
}

/// The rules of the first steps of random walks that the symbolic world of `Claimed` refuses.
template <class Composition, class Claimed = Composition>
std::vector<std::string> refused(const model::DdsProfile& dds, unsigned walks) {
  z3::context context;
  const smt::SymbolicContext current{context};
  std::mt19937_64 dice{1};
  std::vector<std::string> refused;
  for (unsigned walk = 0; walk < walks; ++walk) {
    comp::SmallState state;
    for (unsigned k = 0; k < 300; ++k) {
      const comp::SmallState before = state;
      comp::random_step<Composition>(
          state, dds, dice, [&](const std::string& rule, comp::Owner, comp::Place where) {
            comp::for_each_type(typename Claimed::Exchange{}, [&]<class R>() {
              if (rule != fsm::name_of<R>()) return;
              if (!has_step<Claimed, R>(before, state, where)) refused.push_back(rule);
            });
          });
    }
  }
  return refused;
}

model::DdsProfile fastdds() {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  return dds;
}

/// Forgets the suppression and its end.
struct RepairHasLeft : comp::Rule<comp::LeftSource<comp::paper::Data>> {
  template <class W>
  static void run(W&) {}
};
struct Forgetful : comp::paper::Paper {
  using Exchange = fsm::TypeList<RepairHasLeft>;
};

TEST(SymbolicWorld, DoesWhatExecutingDoes) {
  EXPECT_EQ((refused<comp::paper::Paper>({}, 6)), std::vector<std::string>{});
  EXPECT_EQ((refused<comp::fastdds::FastDds>(fastdds(), 4)), std::vector<std::string>{});
}

TEST(SymbolicWorld, IsRefusedIfARuleForgetsSomething) {
  EXPECT_FALSE((refused<comp::paper::Paper, Forgetful>({}, 6)).empty());
}

}  // namespace symbolic_world_test
}  // namespace stormproof::tables
