// What a derivation is about, and what those who ask for one are told while it runs: the request
// that all places of checker/engines/tables/derived_world.hpp share.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "checker/engines/tables/derivation.hpp"
#include "checker/engines/tables/derived_time.hpp"
#include "checker/engines/tables/effect_system.hpp"
#include "fsm/program/program.hpp"
#include "model/mutation.hpp"

namespace stormproof::tables {

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
  /// What knobs are, made once: Z3 orders what it simplifies by when it was made first, so that two
  /// profiles whose rules do the same have the same steps word for word.
  std::map<std::string_view, Expr> knobs{};

  [[nodiscard]] bool counts(const fsm::program::Thing& timer) const {
    return timer.counted || counted.contains(std::string{timer.name});
  }
};

/// The variable, for those who declare it, that becomes true when the reverse of our pair raises
/// it: by symmetry, what happens to ours when the other one does what is ours to do here.
inline std::string raised_back(const std::string& occasion) { return "raised back " + occasion; }

/// Derives the steps of a composition: of the rules about relations and writers, or of all.
void derive(const fsm::program::Program& program, Derived& derived);

}  // namespace stormproof::tables
