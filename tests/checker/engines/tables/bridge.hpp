// What an execution and a derived system have in common: the state as one descriptor sees it, by
// the names of the system's variables, and whether the system has the steps from one to another
// that an execution takes.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "checker/engines/tables/descriptor_system.hpp"
#include "tests/fsm/composition/small_world.hpp"

namespace stormproof::tables {

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
      values[std::string{fsm::name_of<V>()}] =
          found == state.values.end() ? comp::first_value<V>() : found->second;
    }
  });
  if constexpr (comp::counts_first_samples<Composition>) {
    values[its_number] = place.descriptor + 1;
    comp::for_each_type(typename Composition::FirstSamples{}, [&]<class V>() {
      const auto found = state.values.find(at.template operator()<V>());
      values[std::string{fsm::name_of<V>()}] = found == state.values.end() ? 0 : found->second;
    });
  }
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
        if constexpr (std::derived_from<F, comp::PacketNumber>) return;
        const auto field = packet.says.find(std::string{fsm::name_of<F>()});
        const std::uint32_t said = field == packet.says.end() ? 0 : field->second;
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
inline std::string step_name(const std::string& rule, comp::Owner owner, const comp::Place& where,
                             const comp::Place& place) {
  const comp::Place own = place.of(owner);
  const comp::Place there = where.of(owner);
  if (own.stream != there.stream) return "another stream: " + rule;
  if (own.peer != there.peer) return "another reader: " + rule;
  if (own.descriptor != there.descriptor) return "another descriptor: " + rule;
  return rule;
}

/// What became of the steps of executions.
struct Crossing {
  std::size_t distinct = 0;  ///< steps that change what a descriptor sees
  std::vector<std::string> refused;
};

inline std::string first_of(const Crossing& crossing) {
  return crossing.refused.empty() ? "" : crossing.refused.front();
}

/// Looks for the steps of executions in the system.
class Bridge {
 public:
  explicit Bridge(const TransitionSystem& system) : system_{system} {}

  /// An execution begins, which is looked at from these places: `look(place)` says what is seen.
  template <class Look>
  void begin(const std::vector<comp::Place>& places, Look&& look) {
    views_.clear();
    for (const comp::Place& place : places) views_[place] = look(place);
  }
  /// This rule has happened at `where`: every place that sees a change asks for the step.
  template <class Look>
  void cross(const std::string& rule, comp::Owner owner, const comp::Place& where, Look&& look) {
    for (auto& [place, before] : views_) {
      Values now = look(place);
      if (now == before) continue;
      const std::string name = step_name(rule, owner, where, place);
      if (known_.emplace(name, before, now).second) {
        ++crossing_.distinct;
        if (!has(name, before, now)) crossing_.refused.push_back(name);
      }
      before = std::move(now);
    }
  }
  [[nodiscard]] const Crossing& crossing() const { return crossing_; }

 private:
  bool has(const std::string& name, const Values& before, const Values& after) {
    Exprs from;
    Exprs to;
    for (const Expr& variable : system_.variables) {
      const auto value = value_of(variable, before);
      if (!value) continue;
      from.push_back(variable);
      to.push_back(*value);
    }
    if (before.contains(its_number)) {
      from.push_back(context().int_const(its_number));
      to.push_back(context().int_val(before.at(its_number)));
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
  std::map<comp::Place, Values> views_;
  std::set<std::tuple<std::string, Values, Values>> known_;
  Crossing crossing_;
};

}  // namespace stormproof::tables
