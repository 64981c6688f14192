// Where a rule is executed on solver expressions: at a place of a small deployment, under a
// condition, by an event with inputs of its own. What is here knows variables, machines and
// effects; the words of rules are in checker/engines/tables/symbolic_world.hpp.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "checker/engines/tables/machine_step.hpp"
#include "checker/engines/tables/symbolic_run.hpp"
#include "fsm/composition/vocabulary.hpp"

namespace stormproof::tables {

/// One truth value for each descriptor; none: false.
struct Lanes {
  std::vector<smt::SymbolicBool> of;
};
/// The domain of outboxes that several descriptors fill.
struct LaneDomain {
  using Bool = Lanes;
  struct Int {
    constexpr Int(std::int64_t = 0) {}
  };
};

class SymbolicScope {
 public:
  using D = smt::Symbolic;
  using Bool = smt::SymbolicBool;
  using Int = smt::SymbolicInt;

  /// `event` is how the names of its inputs begin: "a.".
  SymbolicScope(SymbolicRun& run, std::string event, Place place)
      : run_{&run}, event_{std::move(event)}, place_{place}, subject_{place.descriptor} {}

  /// An input of the event that no packet says.
  Bool drawn(const std::string& words) {
    return Bool{run_->input(Bool::named(event_ + words).expr())};
  }
  /// Under which condition effects happen here.
  [[nodiscard]] const Expr& path() const { return path_; }

 protected:
  template <class T>
  static std::string name() {
    return std::string{fsm::name_of<T>()};
  }
  template <class T>
  [[nodiscard]] std::string variable() const {
    return name<T>() + place_.of(T::owner.indices).text();
  }
  template <class T>
  [[nodiscard]] std::string pending() const {
    return "pending " + variable<T>();
  }
  template <class F>
  Bool input() {
    Place place = place_;
    if constexpr (!std::derived_from<F, fsm::composition::DescriptorField>) place.descriptor = 0;
    return Bool{run_->input(Bool::named(event_ + name<F>() + place.text()).expr())};
  }
  /// The variables of the machine, one for each of its states, and their values.
  template <class P>
  [[nodiscard]] std::vector<std::string> states() const {
    std::vector<std::string> names;
    for (const std::string_view state : fsm::Reflect<typename P::Machine>::state_names) {
      names.push_back(name<P>() + "=" + std::string{state} + place_.of(P::owner.indices).text());
    }
    return names;
  }
  template <class P>
  Exprs machine() {
    Exprs now;
    run_->machine(states<P>());
    for (const std::string& state : states<P>()) now.push_back(run_->truth(state));
    return now;
  }
  template <class P, class E>
  auto step(const Expr& when, const typename P::Machine::Io::template Input<D>& input) {
    run_->steps(fsm::name_of<typename P::Machine>());
    const MachineStep<typename P::Machine> table{run_->mistakes()};
    const auto effect = table.template step<E>(machine<P>(), input, when);
    std::size_t k = 0;
    for (const std::string& state : states<P>()) run_->truth(state) = effect.next[k++];
    return effect.outbox();
  }

  void assign(Expr& target, const Expr& value) {
    target = z3::ite(path_, value, target).simplify();
  }
  template <class T>
  void happens(const char* how, Exprs content) {
    run_->happens({variable<T>() + how, path_, std::move(content)});
  }

  SymbolicRun* run_;
  std::string event_;
  Place place_;
  int subject_;
  Expr path_ = Bool{true}.expr();
};

}  // namespace stormproof::tables
