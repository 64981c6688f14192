// Goes through the rules and procedures of the composition; what a step sends, its contract says.
#include "checker/evidence/conform/report/effect_coverage.hpp"

#include <algorithm>
#include <numeric>

#include "checker/presentation/composition/composition_graph.hpp"
#include "model/composition_of.hpp"
#include "model/implementations.hpp"

namespace stormproof::conform {

namespace {

using fsm::composition::CompositionInfo;
using fsm::composition::EffectInfo;
using fsm::composition::RuleInfo;

/// Whether conformance looks at the packet: control-only relations are liveliness and user topics.
bool is_checked(const CompositionInfo& composition, std::string_view packet) {
  return std::ranges::any_of(composition.packets, [&](const auto& known) {
    return known.name == packet && known.owner != "control relation";
  });
}

void collect(const CompositionInfo& composition, const EffectInfo& effect,
             std::vector<std::string_view>& packets) {
  if (effect.kind == "emit" && is_checked(composition, effect.target) &&
      std::ranges::find(packets, effect.target) == packets.end()) {
    packets.push_back(effect.target);
  }
  if (effect.kind != "perform") return;
  for (const std::string& id : draw::led_to(composition, effect)) {
    const auto step = std::ranges::find(composition.steps, id, &RuleInfo::id);
    if (step == composition.steps.end()) continue;
    for (const EffectInfo& inner : step->effects) collect(composition, inner, packets);
  }
}

/// By effect, the knob that rules it out; a profile by itself has no "dds." before its keys.
std::map<std::string, std::string> reasons_of(
    const std::vector<tables::ImpossibleEffects>& impossible) {
  constexpr std::string_view prefix = "dds.";
  std::map<std::string, std::string> reasons;
  for (const auto& group : impossible) {
    std::string by = group.by;
    for (std::size_t at = by.find(prefix); at != std::string::npos; at = by.find(prefix, at)) {
      by.erase(at, prefix.size());
    }
    for (const std::string& effect : group.effects) reasons[effect] = by;
  }
  return reasons;
}

/// Adds what the rules of a composition can send.
void cover(const CompositionInfo& composition, const std::map<std::string, std::string>& reasons,
           CompositionCoverage& coverage) {
  for (const auto* list : {&composition.rules, &composition.procedures}) {
    for (const RuleInfo& rule : *list) {
      RuleCoverage covered{rule.id, {}};
      for (const EffectInfo& effect : rule.effects) {
        auto packets = packets_sent_by(composition, effect);
        if (packets.empty()) {
          coverage.unobservable.emplace_back(effect.id);
          continue;
        }
        const auto reason = reasons.find(effect.id);
        covered.effects.push_back({&effect, std::move(packets), 0,
                                   reason == reasons.end() ? std::string{} : reason->second});
      }
      if (covered.effects.empty()) {
        coverage.unobservable_rules.emplace_back(rule.id);
      } else {
        coverage.rules.push_back(std::move(covered));
      }
    }
  }
}

/// With a server nobody announces himself to all.
std::map<std::string, std::string> reasons_with_server(
    const CompositionInfo& composition, const std::vector<tables::ImpossibleEffects>& impossible,
    const std::string& reason) {
  auto reasons = reasons_of(impossible);
  for (const auto* list : {&composition.rules, &composition.procedures}) {
    for (const RuleInfo& rule : *list) {
      for (const EffectInfo& effect : rule.effects) {
        const bool announces =
            std::ranges::any_of(packets_sent_by(composition, effect),
                                [](std::string_view packet) { return packet.starts_with("Spdp"); });
        if (announces) reasons[effect.id] = reason;
      }
    }
  }
  return reasons;
}

/// The condition right around an effect.
std::string_view condition_of(const EffectInfo& effect) {
  return effect.blocks.empty() ? std::string_view{} : effect.blocks.back().text;
}

/// Gives the events of each sender to the one effect that can have sent them; how many have one.
std::uint64_t attribute(const std::map<Sender, std::uint64_t>& by_sender,
                        std::vector<RuleCoverage>& rules) {
  std::uint64_t attributed = 0;
  for (const auto& [sender, times] : by_sender) {
    EffectCoverage* only = nullptr;
    std::size_t candidates = 0;
    for (RuleCoverage& rule : rules) {
      if (rule.rule != sender.scope) continue;
      for (EffectCoverage& effect : rule.effects) {
        if (!effect.ruled_out_by.empty() ||
            (!sender.condition.empty() && sender.condition != condition_of(*effect.effect)) ||
            std::ranges::find(effect.packets, sender.packet) == effect.packets.end()) {
          continue;
        }
        only = &effect;
        ++candidates;
      }
    }
    if (candidates != 1) continue;
    only->times += times;
    attributed += times;
  }
  return attributed;
}

template <class Of, class Count>
std::uint64_t sum(const std::vector<Of>& all, Count&& count) {
  return std::accumulate(all.begin(), all.end(), std::uint64_t{0},
                         [&](std::uint64_t total, const Of& one) { return total + count(one); });
}

}  // namespace

std::uint64_t RuleCoverage::seen() const {
  return sum(effects, [](const EffectCoverage& one) { return one.times > 0 ? 1U : 0U; });
}
std::uint64_t RuleCoverage::possible() const {
  return sum(effects, [](const EffectCoverage& one) { return one.ruled_out_by.empty() ? 1U : 0U; });
}
std::uint64_t CompositionCoverage::seen() const {
  return sum(rules, [](const RuleCoverage& one) { return one.seen(); });
}
std::uint64_t CompositionCoverage::possible() const {
  return sum(rules, [](const RuleCoverage& one) { return one.possible(); });
}
std::uint64_t CompositionCoverage::observable() const {
  return sum(rules, [](const RuleCoverage& one) { return one.effects.size(); });
}
std::uint64_t CompositionCoverage::rules_seen() const {
  return sum(rules, [](const RuleCoverage& one) { return one.seen() > 0 ? 1U : 0U; });
}
std::uint64_t CompositionCoverage::rules_possible() const {
  return sum(rules, [](const RuleCoverage& one) { return one.possible() > 0 ? 1U : 0U; });
}

std::vector<std::string_view> packets_sent_by(const CompositionInfo& composition,
                                              const EffectInfo& effect) {
  std::vector<std::string_view> packets;
  collect(composition, effect, packets);
  return packets;
}

CompositionCoverage effect_coverage(const Conformance& result, const model::DdsProfile& dds,
                                    const std::vector<tables::ImpossibleEffects>& impossible) {
  CompositionCoverage coverage{model::composition_of(dds).name, {}, {}, {}, 0};
  cover(model::composition_of(dds), reasons_of(impossible), coverage);
  if (model::traits_of(dds).has_server) {
    // Descriptors on their way to the server go by the rules of Fast DDS.
    const CompositionInfo& of_descriptors = model::composition_of(dds.implementation);
    const bool is_super = dds.discovery == model::Discovery::super_client;
    const std::string reason = is_super ? "discovery: super_client" : "discovery: server";
    cover(of_descriptors, reasons_with_server(of_descriptors, impossible, reason), coverage);
  }
  coverage.unattributed = result.explained - attribute(result.by_sender, coverage.rules);
  return coverage;
}

}  // namespace stormproof::conform
