// composition.live: each effect of each rule can happen, or a knob of the profile rules it out.
// Steps in which it happens are found in the system of one generic descriptor
// (checker/engines/tables/effect_system.hpp); that it cannot happen is proved, and why. An effect
// that no knob allows is a rule that somebody wrote down and nobody executes. For writers that the
// engines do not know, runs are looked at instead (checker/engines/tables/live_in_runs.hpp).
#include <algorithm>
#include <stdexcept>

#include "checker/engines/tables/descriptor_system.hpp"
#include "checker/engines/tables/listed_effects.hpp"
#include "checker/engines/tables/live_in_runs.hpp"
#include "checker/engines/tables/properties.hpp"
#include "checker/engines/tables/ruled_out.hpp"
#include "checker/engines/tables/witnesses.hpp"
#include "model/composition_of.hpp"
#include "model/implementations.hpp"

namespace stormproof::tables {
namespace {

namespace composition = fsm::composition;
using composition::CompositionInfo;

const composition::EffectInfo& effect_of(const CompositionInfo& info, const std::string& id) {
  for (const auto* rules : {&info.rules, &info.procedures, &info.steps}) {
    for (const composition::RuleInfo& rule : *rules) {
      for (const composition::EffectInfo& effect : rule.effects) {
        if (effect.id == id) return effect;
      }
    }
  }
  throw std::out_of_range{id};
}

class Liveness {
 public:
  Liveness(Proof& proof, const CompositionInfo& info)
      : proof_{proof},
        info_{info},
        effects_{effect_system(proof.scenario().dds, proof.mistakes(), info)},
        happens_(effects_.effects.size(), false),
        impossible_(effects_.effects.size(), false) {}

  std::string decide() {
    look_for_witnesses();
    const std::size_t happen = static_cast<std::size_t>(std::ranges::count(happens_, true));
    explain();
    return std::to_string(happens_.size()) + " effects: " + std::to_string(happen) +
           " happen, each after steps that were evaluated; " + std::to_string(ruled_out_) +
           " are ruled out by knobs of the profile, because of variables that never change";
  }

 private:
  void look_for_witnesses() {
    const TransitionSystem system =
        under(effects_, proof_.scenario().dds, std::vector<bool>(effects_.knobs.size(), true));
    const std::vector<bool> never = never_changing(system);
    const TransitionSystem moving = without(never, system);
    std::vector<std::size_t> effect_of_mark;
    for (std::size_t e = 0; e < happens_.size(); ++e) {
      impossible_[e] = never[e];
      if (!never[e]) effect_of_mark.push_back(e);
    }
    std::vector<bool> is_mark(moving.variables.size(), false);
    for (std::size_t m = 0; m < effect_of_mark.size(); ++m) is_mark[m] = true;
    const smt::Options& options = proof_.request().claims.options();
    const Witnesses witnesses = find_witnesses(moving, is_mark, options);
    tell(witnesses, effect_of_mark);
    for (std::size_t m = 0; m < effect_of_mark.size(); ++m) {
      const std::size_t e = effect_of_mark[m];
      happens_[e] = witnesses.found[m];
      if (happens_[e]) continue;
      if (!witnesses.gap.empty()) {
        proof_.give_up(effects_.effects[e] + ": no steps found (" + witnesses.gap + ")");
      } else {
        reach(moving, m, e);
      }
    }
  }
  void tell(const Witnesses& witnesses, const std::vector<std::size_t>& effect_of_mark) {
    proof_.detail("steps, and what happens in each for the first time:");
    for (std::size_t k = 0; k < witnesses.steps.size(); ++k) {
      const WitnessStep& step = witnesses.steps[k];
      std::vector<std::string> ids;
      for (const std::size_t mark : step.marks) ids.push_back(id_of(effect_of_mark[mark]));
      std::string line = "  " + std::to_string(k + 1) + ". ";
      if (step.from == 0 && k > 0) line += "in the beginning: ";
      if (step.from != k && step.from > 0) line += "after " + std::to_string(step.from) + ": ";
      line += step.name + (step.inputs.empty() ? "" : " (" + step.inputs + ")");
      proof_.detail(line + (ids.empty() ? "" : ": " + listed_effects(ids)));
    }
  }
  [[nodiscard]] const std::string& id_of(std::size_t effect) const {
    return effects_.effects[effect];
  }
  /// What the search has not found is decided by itself.
  void reach(TransitionSystem system, std::size_t mark, std::size_t effect) {
    system.bad = system.variables[mark];
    const Reached reached = reach_bad(proof_, what_matters(system));
    if (reached.answer == smt::Answer::unknown) {
      proof_.give_up(id_of(effect) + ": " + reached.why);
    } else if (reached.answer == smt::Answer::unsat) {
      impossible_[effect] = true;
    } else {
      happens_[effect] = true;
      proof_.detail(id_of(effect) + " happens:");
      for (const std::string& line : reached.lines) proof_.detail(line);
    }
  }
  void explain() {
    for (const RuledOut& group : why_ruled_out(proof_, effects_, impossible_)) {
      std::vector<std::string> ids;
      for (const std::size_t effect : group.effects) {
        impossible_[effect] = false;
        ids.push_back(id_of(effect));
        if (!group.by.empty()) continue;
        const composition::EffectInfo& info = effect_of(info_, ids.back());
        proof_.violate("no knobs let it happen: " + std::string{info.kind} + " " +
                       std::string{info.target} + " (" + place_of(info) + ")");
      }
      if (group.by.empty()) continue;
      ruled_out_ += ids.size();
      proof_.detail("ruled out by " + group.by + ": " + listed_effects(ids));
    }
    for (std::size_t e = 0; e < impossible_.size(); ++e) {
      if (!impossible_[e]) continue;
      proof_.give_up(id_of(e) +
                     " cannot happen under this profile, and no knob is known to be why");
    }
  }

  Proof& proof_;
  const CompositionInfo& info_;
  EffectSystem effects_;
  std::vector<bool> happens_;
  std::vector<bool> impossible_;
  std::size_t ruled_out_ = 0;
};

}  // namespace

Finding composition_live(const CheckRequest& request) {
  if (!model::traits_of(request.scenario.dds).is_known_to_engines) return live_in_runs(request);
  Proof proof{"composition.live", request};
  assume_for_descriptors(proof);
  proof.assume(
      "Steps show that the rules let an effect happen to one descriptor; what they need of others, "
      "of the host and of the network is taken as given.");
  const CompositionInfo& info = model::composition_of(proof.scenario().dds);
  return proof.finish(Liveness{proof, info}.decide());
}

}  // namespace stormproof::tables
