// What a derivation is about, and what those who ask for one are told while it runs: the request
// that all places of checker/engines/tables/derived_world.hpp share.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "checker/engines/tables/derivation.hpp"
#include "checker/engines/tables/derived_time.hpp"
#include "checker/engines/tables/effect_system.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "model/mutation.hpp"

namespace stormproof::tables {

namespace composition = fsm::composition;

/// What is derived: rules with the mistakes of a mutant, under the knobs of a profile.
struct Derived {
  const model::DdsProfile& dds;
  const model::Mutation& mistakes;
  Derivation& derivation;
  /// Called when our relation's writer or reader emits a packet: its name, when, and what it says
  /// of our descriptor and of itself.
  std::function<void(std::string_view, const Expr&, const std::map<std::string, Expr>&)> emitted{};
  /// Called when a packet arrives at our relation.
  std::function<void(std::string_view, const std::map<std::string, Expr>&)> received{};
  /// Called at the end of each step, with whether an ACKNACK would list our descriptor now.
  std::function<void(const Expr&)> ended{};
  /// Called for each effect at our own place: its id (EffectInfo::id) and when it happens. With it,
  /// all rules are derived, also those that only announce and those of control-only relations, and
  /// occasions only happen once they are raised.
  std::function<void(const std::string&, const Expr&)> happens{};
  /// Called for each knob that is read: what stands for it; without it, the knob's value does.
  std::function<Expr(const Knob&)> knob{};
  /// With it, things under way have deadlines.
  DerivedTime* time = nullptr;
  /// Timers of which it matters how many are pending, though no rule asks for that.
  std::set<std::string> counted{};

  /// Effects are counted as the recorder does (fsm/program/words.cpp): within a rule,
  /// procedure or step, each once, however often it runs.
  std::string within{};
  unsigned number = 0;

  template <class T>
  [[nodiscard]] bool counts() const {
    return T::counted || counted.contains(std::string{fsm::name_of<T>()});
  }

  /// The next effect happens `when`, here or at a place that is not ours.
  void effect(const Expr& when, bool is_ours) {
    if (!happens) return;
    const std::string id = within + "." + std::to_string(++number);
    if (is_ours) happens(id, when);
  }
  /// The effects of a procedure or step of this name.
  template <class Body>
  void aside(std::string name, Body&& body) {
    std::swap(within, name);
    const unsigned outer = std::exchange(number, 0);
    body();
    within = std::move(name);
    number = outer;
  }
};

template <class T>
std::string tag_name() {
  return std::string{fsm::name_of<T>()};
}

/// The variable, for those who declare it, that becomes true when the reverse of our pair raises
/// it: by symmetry, what happens to ours when the other one does what is ours to do here.
inline std::string raised_back(const std::string& occasion) { return "raised back " + occasion; }

/// Whether something else than the rules causes it, at least for the first time.
template <class T, class Composition>
bool comes_from_outside() {
  return std::ranges::any_of(Composition::from_outside,
                             [](const auto& cause) { return cause.name == fsm::name_of<T>(); });
}

}  // namespace stormproof::tables
