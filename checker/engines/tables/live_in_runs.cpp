// Random deployments and channels with the knobs of the profile, until each effect has happened in
// some run, through the machines themselves: a run in which it happens is a proof that it can. What
// a knob of the profile excludes is named, and not looked for with it. What no run shows is looked
// for with other knobs. If it happens there, the rule is not dead; that the knobs of the profile
// rule the effect out, unless one excludes it, is as much as runs can say: sampled.
#include "checker/engines/tables/live_in_runs.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/core.h>

#include "checker/engines/tables/excluded_effects.hpp"
#include "checker/engines/tables/listed_effects.hpp"
#include "checker/engines/tables/proof.hpp"
#include "fsm/composition/composition_info.hpp"
#include "model/composition_of.hpp"
#include "model/implementations.hpp"
#include "model/simulator.hpp"
#include "props/generators/dice.hpp"
#include "props/generators/on_demand.hpp"
#include "props/generators/space.hpp"

namespace stormproof::tables {

namespace {

constexpr std::uint64_t most_runs = 400;
constexpr std::uint64_t most_runs_with_other_knobs = 60;
constexpr std::uint64_t enough_events = 20'000;
/// So many that their retransmissions fill a queue that takes hundreds, in every fifth deployment.
constexpr std::uint32_t many_endpoints = 150;

/// An effect that a mistake leaves out is due, but does not happen.
class Happened final : public model::Probe {
 public:
  explicit Happened(const model::Mutation& mistakes) : mistakes_{mistakes} {}

  [[nodiscard]] bool wants_effects() const override { return true; }
  void effect(fsm::composition::EffectKey key) override {
    const bool left_out = std::ranges::any_of(mistakes_.effects, [&](const auto& mistake) {
      return mistake.key == key && mistake.change == Mistake::Change::drop;
    });
    if (!left_out) keys.insert(key);
  }

  std::set<fsm::composition::EffectKey> keys;

 private:
  using Mistake = fsm::composition::EffectMutation;

  const model::Mutation& mistakes_;
};

/// Participants start as far apart as timers expire.
void start_apart(props::Dice& dice, model::Deployment& deployment) {
  constexpr std::int64_t longest_ns = 2'000'000'000;
  for (model::Participant& p : deployment.participants) {
    const model::Nanoseconds later{dice.between(0, longest_ns)};
    p.start += later;
    p.endpoints_done += later;
    if (p.open) *p.open += later;
    if (p.ready) *p.ready += later;
  }
}

/// Some packets arrive long after later ones: timers expire meanwhile.
void let_packets_overtake(props::Dice& dice, model::WirelessProfile& wireless) {
  constexpr std::uint64_t packets = 300;
  wireless.kind = model::ServiceKind::constant_delay;
  wireless.packet_delays.clear();
  const std::int64_t longest_ns = dice.among({1'500'000'000, 400'000'000, 40'000'000});
  for (std::uint64_t packet = 0; packet < packets; ++packet) {
    if (!dice.chance(25)) continue;
    const model::Nanoseconds delay{dice.between(0, longest_ns)};
    wireless.packet_delays.push_back({packet, {}, delay});
  }
}

/// Of the implementation of the profile, with knobs of its own.
model::Scenario drawn(std::uint64_t seed, const model::DdsProfile& dds) {
  constexpr int size = 60;
  constexpr model::Nanoseconds long_enough{20'000'000'000};
  model::Scenario scenario =
      props::draw_scenario(seed, size, {.implementation = dds.implementation});
  if (model::traits_of(dds).has_server) {
    props::draw_discovery(seed, dds.discovery, scenario);
    props::Dice dice{seed};
    if (seed % 3 == 2) props::draw_servers(dice, scenario);
  }
  scenario.run_until = model::RunUntil::time_limit;
  scenario.time_limit = long_enough;
  if (seed % 2 == 1) {
    props::Dice dice{seed};
    start_apart(dice, scenario.deployment);
    let_packets_overtake(dice, scenario.wireless);
  }
  if (seed % 5 == 0) {
    scenario.deployment.participants.front().publications = many_endpoints;
    scenario.deployment.participants.front().subscriptions = many_endpoints;
  }
  return scenario;
}

/// The effects of a composition that have not happened, in the order of its page.
class Missing {
 public:
  Missing() = default;
  explicit Missing(const fsm::composition::CompositionInfo& composition) {
    for (const auto* list : {&composition.rules, &composition.procedures}) {
      for (const fsm::composition::RuleInfo& rule : *list) {
        for (const fsm::composition::EffectInfo& effect : rule.effects) left_.push_back(&effect);
      }
    }
  }
  [[nodiscard]] std::size_t count() const { return left_.size(); }
  [[nodiscard]] std::string listed() const {
    std::vector<std::string> ids;
    for (const fsm::composition::EffectInfo* effect : left_) ids.push_back(effect->id);
    return listed_effects(ids);
  }
  /// Without those that have happened, which are returned.
  std::string remove(const Happened& happened) {
    Missing found;
    return move_to(found, [&](const auto& effect) { return happened.keys.contains(effect.key); });
  }
  /// Those for which this holds are among the others instead; which are returned.
  std::string move_to(Missing& others, auto&& is_one) {
    std::vector<std::string> ids;
    std::erase_if(left_, [&](const fsm::composition::EffectInfo* effect) {
      const bool moves = is_one(*effect);
      if (moves) others.left_.push_back(effect);
      if (moves) ids.push_back(effect->id);
      return moves;
    });
    return listed_effects(ids);
  }
  void add(const Missing& others) {
    left_.insert(left_.end(), others.left_.begin(), others.left_.end());
  }

 private:
  std::vector<const fsm::composition::EffectInfo*> left_;
};

/// Runs with the knobs of the profile, or with others, until nothing is missing. How many it took.
std::uint64_t look_for(Missing& missing, Proof& proof, bool with_own_knobs) {
  const model::DdsProfile& dds = proof.scenario().dds;
  const auto& on_progress = proof.request().on_progress;
  std::uint64_t runs = 0;
  const std::uint64_t most = with_own_knobs ? most_runs : most_runs_with_other_knobs;
  while (missing.count() > 0 && runs < most && (!on_progress || on_progress("runs"))) {
    model::Scenario scenario = drawn(++runs, dds);
    if (with_own_knobs) scenario.dds = dds;
    Happened happened{proof.mistakes()};
    model::RunOptions options;
    options.probe = &happened;
    options.mutation = &proof.mistakes();
    options.max_events = enough_events;
    (void)model::simulate(scenario, options);
    const std::string first = missing.remove(happened);
    if (first.empty()) continue;
    proof.detail(fmt::format("for the first time in run {}{}: {}", runs,
                             with_own_knobs ? "" : " with other knobs", first));
  }
  return runs;
}

/// Takes out what a knob of the profile excludes, and says so.
Missing exclude(Missing& missing, Proof& proof) {
  Missing excluded;
  for (const ImpossibleEffects& group : excluded_effects(proof.scenario().dds)) {
    const auto is_in_group = [&](const fsm::composition::EffectInfo& effect) {
      return std::ranges::find(group.effects, effect.id) != group.effects.end();
    };
    const std::string ids = missing.move_to(excluded, is_in_group);
    if (!ids.empty()) proof.detail(fmt::format("excluded by {}: {}", group.by, ids));
  }
  return excluded;
}

}  // namespace

Finding live_in_runs(const checker::CheckRequest& request) {
  Proof proof{"composition.live", request};
  Missing missing{model::composition_of(proof.scenario().dds)};
  const std::size_t all = missing.count();
  Missing excluded = exclude(missing, proof);
  const std::size_t possible = missing.count();
  const std::uint64_t runs = look_for(missing, proof, true);
  const std::size_t silent = missing.count();
  // What is excluded here has to happen somewhere else, or nobody would execute it.
  missing.add(excluded);
  if (missing.count() > 0) look_for(missing, proof, false);
  if (missing.count() > 0) proof.give_up("no run shows " + missing.listed());
  Finding finding = proof.finish(
      fmt::format("{} effects: {} happen in one of {} runs with the knobs of this profile{}{}", all,
                  possible - silent, runs,
                  possible == all ? "" : fmt::format(", {} are excluded by them", all - possible),
                  silent == 0 ? "" : ", the others happen in runs with other knobs only"));
  const bool rests_on_silence = silent > 0 && finding.kind == props::VerdictKind::proved;
  if (rests_on_silence) finding.kind = props::VerdictKind::sampled;
  return finding;
}

}  // namespace stormproof::tables
