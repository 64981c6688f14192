// Effects as edges between rules; sides as the components of a graph.
#include "checker/presentation/composition/composition_graph.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace stormproof::draw {

namespace {

namespace comp = fsm::composition;
using comp::CompositionInfo;
using comp::EffectInfo;
using comp::RuleInfo;
using Names = std::vector<std::string>;

/// Rules, then procedures, then steps.
std::vector<const RuleInfo*> everything(const CompositionInfo& composition) {
  std::vector<const RuleInfo*> all;
  for (const auto* rules : {&composition.rules, &composition.procedures, &composition.steps}) {
    for (const RuleInfo& rule : *rules) all.push_back(&rule);
  }
  return all;
}

bool is_call(const EffectInfo& effect) { return effect.kind == "call" || effect.kind == "perform"; }

/// The id of what is called or performed; a tag among its arguments is part of the id.
std::string callee(const CompositionInfo& composition, const EffectInfo& effect) {
  const std::string name{effect.target};
  const std::string with_tag = name + " " + effect.detail;
  for (const auto* rules : {&composition.procedures, &composition.steps}) {
    if (std::ranges::find(*rules, with_tag, &RuleInfo::id) != rules->end()) return with_tag;
  }
  return name;
}

/// The rules with an effect that `wanted` accepts.
template <class Wanted>
Names with_effect(const CompositionInfo& composition, Wanted&& wanted) {
  Names names;
  for (const RuleInfo* rule : everything(composition)) {
    if (std::ranges::any_of(rule->effects, wanted)) names.push_back(rule->id);
  }
  return names;
}

/// Packets of RTPS by who sends them.
std::string known_sender(std::string_view packet) {
  if (packet.starts_with("Spdp")) return "participant";
  const std::string of = packet.starts_with("User") ? "control traffic, " : "";
  if (packet.ends_with("AckNack")) return of + "reader side";
  if (packet.ends_with("Heartbeat") || packet == "Data") return of + "writer side";
  return {};
}

/// Unites rules with what only their side has.
class Sides {
 public:
  explicit Sides(const CompositionInfo& composition) : composition_{composition} {
    for (const RuleInfo* rule : everything(composition)) unite(*rule);
    // A step belongs to those who perform it, if they are one side; such steps perform others.
    for (bool changed = true; changed;) {
      changed = false;
      for (const RuleInfo& step : composition.steps) changed = adopt(step) || changed;
    }
  }

  std::string root(const std::string& node) {
    const auto parent = parent_.find(node);
    return parent == parent_.end() ? node : root(parent->second);
  }
  static std::string rule(std::string_view id) { return "rule " + std::string{id}; }
  static std::string thing(std::string_view name) { return "thing " + std::string{name}; }
  static std::string sender(std::string_view packet) { return "sender " + std::string{packet}; }

 private:
  bool unite(const std::string& a, const std::string& b) {
    const std::string from = root(b);
    const std::string to = root(a);
    if (from != to) parent_[from] = to;
    return from != to;
  }
  /// What a rule of the participant does itself, other sides ask for, as for the next run of the
  /// asynchronous thread: that makes them no part of its side.
  [[nodiscard]] bool is_request(const RuleInfo& of, const EffectInfo& effect) const {
    const bool asks = effect.kind == "feed" || effect.kind == "at" || effect.kind == "after";
    const auto does_itself = [&](const RuleInfo& rule) {
      return rule.owner == effect.owner &&
             (rule.cause == effect.target ||
              std::ranges::find(rule.effects, effect.target, &EffectInfo::target) !=
                  rule.effects.end());
    };
    return asks && effect.owner == "participant" && of.owner != effect.owner &&
           std::ranges::any_of(composition_.rules, does_itself);
  }
  /// Control traffic has sides of its own: what its rules and others call is in none.
  [[nodiscard]] bool is_called_from_both(const std::string& id) const {
    const Names callers = callers_of(composition_, id);
    const auto is_control = [&](const RuleInfo& rule) {
      return std::string_view{rule.owner}.starts_with("control");
    };
    bool some = false;
    bool others = false;
    for (const RuleInfo& rule : composition_.rules) {
      if (std::ranges::find(callers, rule.id) == callers.end()) continue;
      (is_control(rule) ? some : others) = true;
    }
    return some && others;
  }
  void unite(const RuleInfo& of) {
    if (of.trigger == "due") unite(rule(of.id), thing(of.cause));
    for (const EffectInfo& effect : of.effects) {
      if (effect.kind == "call") {
        if (is_called_from_both(callee(composition_, effect))) continue;
        unite(rule(of.id), rule(callee(composition_, effect)));
      } else if (effect.kind == "emit") {
        unite(rule(of.id), sender(effect.target));
      } else if (effect.kind != "perform" && effect.kind != "raise" && !is_request(of, effect)) {
        unite(rule(of.id), thing(effect.target));
      }
    }
  }
  bool adopt(const RuleInfo& step) {
    std::set<std::string> sides;
    Names performers;
    for (const std::string& id : callers_of(composition_, step.id)) {
      performers.push_back(id);
      sides.insert(root(rule(id)));
    }
    return sides.size() == 1 && unite(rule(performers.front()), rule(step.id));
  }

  const CompositionInfo& composition_;
  std::map<std::string, std::string> parent_;
};

/// Tells a rule, then what nobody else calls or performs who has not been told yet.
class Telling {
 public:
  explicit Telling(const CompositionInfo& composition)
      : composition_{composition}, all_{everything(composition)} {}

  std::vector<const RuleInfo*> run() {
    for (const RuleInfo& rule : composition_.rules) tell(rule);
    for (const RuleInfo* rule : all_) {
      if (!is_told(rule->id)) tell(*rule);  // what calls itself, or is called by nobody
    }
    return std::move(told_);
  }

 private:
  [[nodiscard]] bool is_told(const std::string& id) const {
    return std::ranges::any_of(told_, [&](const RuleInfo* rule) { return rule->id == id; });
  }
  void tell(const RuleInfo& rule) {
    told_.push_back(&rule);
    for (const EffectInfo& effect : rule.effects) {
      if (!is_call(effect)) continue;
      const std::string id = callee(composition_, effect);
      const Names callers = callers_of(composition_, id);
      if (is_told(id) || !std::ranges::all_of(callers, [&](auto& c) { return is_told(c); })) {
        continue;
      }
      const auto called = std::ranges::find(all_, id, &RuleInfo::id);
      if (called != all_.end()) tell(**called);
    }
  }

  const CompositionInfo& composition_;
  const std::vector<const RuleInfo*> all_;
  std::vector<const RuleInfo*> told_;
};

}  // namespace

Names causes_of(const CompositionInfo& composition, std::string_view target,
                std::initializer_list<std::string_view> kinds) {
  return with_effect(composition, [&](const EffectInfo& effect) {
    return effect.target == target && std::ranges::find(kinds, effect.kind) != kinds.end();
  });
}

Names callers_of(const CompositionInfo& composition, std::string_view id) {
  return with_effect(composition, [&](const EffectInfo& effect) {
    return is_call(effect) && callee(composition, effect) == id;
  });
}

Names handlers_of(const CompositionInfo& composition, std::string_view cause) {
  Names names;
  for (const RuleInfo& rule : composition.rules) {
    if (rule.cause == cause) names.push_back(rule.id);
  }
  return names;
}

Names led_to(const CompositionInfo& composition, const EffectInfo& effect) {
  if (is_call(effect)) return {callee(composition, effect)};
  const bool causes = effect.kind == "emit" || effect.kind == "after" || effect.kind == "at" ||
                      effect.kind == "raise";
  return causes ? handlers_of(composition, effect.target) : Names{};
}

std::vector<const RuleInfo*> reading_order(const CompositionInfo& composition) {
  return Telling{composition}.run();
}

std::vector<Party> parties(const CompositionInfo& composition) {
  Sides sides{composition};
  std::vector<std::string> roots;
  std::vector<Party> found;
  const auto at = [&](const std::string& node) -> Party* {
    const auto place = std::ranges::find(roots, sides.root(node));
    return place == roots.end() ? nullptr : &found[static_cast<std::size_t>(place - roots.begin())];
  };
  for (const RuleInfo* rule : reading_order(composition)) {
    const std::string node = Sides::rule(rule->id);
    if (at(node) == nullptr && rule->trigger.empty()) continue;
    if (at(node) == nullptr) {
      roots.push_back(sides.root(node));
      found.emplace_back();
    }
    at(node)->rules.push_back(rule->id);
  }
  for (const comp::PartInfo& part : composition.parts) {
    if (Party* party = at(Sides::thing(part.name))) party->parts.push_back(part);
  }
  for (const comp::ThingInfo& timer : composition.timers) {
    if (Party* party = at(Sides::thing(timer.name))) party->timers.push_back(timer.name);
  }
  for (const comp::ThingInfo& state : composition.state) {
    if (Party* party = at(Sides::thing(state.name))) party->state.push_back(state.name);
  }
  for (const comp::ThingInfo& packet : composition.packets) {
    Party* party = at(Sides::sender(packet.name));
    if (party == nullptr) continue;
    party->packets.push_back(packet.name);
    if (party->name.empty()) party->name = known_sender(packet.name);
  }
  for (Party& party : found) {
    if (party.name.empty() && !party.parts.empty()) party.name = party.parts.front().name;
    if (party.name.empty()) party.name = party.rules.front();
  }
  return found;
}

const Party* party_of(const std::vector<Party>& parties, std::string_view rule) {
  const auto found = std::ranges::find_if(parties, [&](const Party& party) {
    return std::ranges::find(party.rules, rule) != party.rules.end();
  });
  return found == parties.end() ? nullptr : &*found;
}

}  // namespace stormproof::draw
