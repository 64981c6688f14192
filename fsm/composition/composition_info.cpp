// What a composition forgets.
#include "fsm/composition/composition_info.hpp"

#include <algorithm>
#include <set>

namespace stormproof::fsm::composition {
namespace {

class Completeness {
 public:
  explicit Completeness(const CompositionInfo& composition) : composition_{composition} {}

  std::vector<std::string> check() {
    collect(composition_.rules);
    collect(composition_.procedures);
    collect(composition_.steps);
    check_outboxes();
    check_events();
    check_causes("timer", composition_.timers, "due", {"after", "at"}, "is started by nothing");
    check_causes("packet", composition_.packets, "received", {"emit"}, "is emitted by nobody");
    for (const ThingInfo& occasion : composition_.occasions) {
      if (!handled_.contains({"happens", occasion.name})) {
        complain("occasion " + std::string{occasion.name} + " has no rule");
      }
    }
    for (const ThingInfo& state : composition_.state) {
      if (!done_.contains({"set", state.name}) && !done_.contains({"set each", state.name})) {
        complain("state " + std::string{state.name} + " is set by nothing");
      }
    }
    for (const UnusedInfo& unused : composition_.unused) {
      if (!needed_.contains({unused.part, unused.name})) {
        complain(std::string{unused.part} + "." + std::string{unused.name} +
                 " is used, and needs no reason");
      }
    }
    return std::move(complaints_);
  }

 private:
  using Pair = std::pair<std::string_view, std::string_view>;

  void collect(const std::vector<RuleInfo>& rules) {
    for (const RuleInfo& rule : rules) {
      handled_.insert({rule.trigger, rule.cause});
      for (const EffectInfo& effect : rule.effects) {
        done_.insert({effect.kind, effect.target});
        if (!effect.kind.starts_with("feed")) continue;
        fed_.insert(std::string{effect.target} + "." +
                    effect.detail.substr(0, effect.detail.find(' ')));
        check_known(effect);
      }
    }
  }
  void check_known(const EffectInfo& effect) {
    const auto known = [&](const PartInfo& part) { return part.name == effect.target; };
    if (std::ranges::none_of(composition_.parts, known)) {
      complain(effect.id + " feeds " + std::string{effect.target} + ", which is no part");
    }
  }
  /// Whether a reason is given why it has no use.
  bool excused(std::string_view part, std::string_view name) {
    needed_.insert({part, name});
    return std::ranges::any_of(composition_.unused, [&](const UnusedInfo& unused) {
      return unused.part == part && unused.name == name && !unused.reason.empty();
    });
  }
  void check_outboxes() {
    for (const PartInfo& part : composition_.parts) {
      for (const std::string_view field : part.outbox) {
        const std::string name = std::string{part.name} + "." + std::string{field};
        if (std::ranges::find(composition_.consumed, name) != composition_.consumed.end()) continue;
        if (!excused(part.name, field)) complain("nothing reads " + name);
      }
    }
  }
  void check_events() {
    for (const PartInfo& part : composition_.parts) {
      for (const std::string_view event : part.events) {
        const std::string name = std::string{part.name} + "." + std::string{event};
        if (fed_.contains(name)) continue;
        if (!excused(part.name, event)) complain("nothing feeds " + name);
      }
    }
  }
  void check_causes(const std::string& what, const std::vector<ThingInfo>& things,
                    std::string_view trigger, const std::vector<std::string_view>& kinds,
                    const std::string& complaint) {
    std::set<std::string_view> known;
    for (const ThingInfo& thing : things) {
      known.insert(thing.name);
      const std::string name = what + " " + std::string{thing.name};
      if (!handled_.contains({trigger, thing.name})) {
        complain(name + (trigger == "due" ? " is handled by no rule" : " is received by nobody"));
      }
      if (std::ranges::none_of(kinds, [&](auto kind) {
            return done_.contains({kind, thing.name});
          })) {
        complain(name + " " + complaint);
      }
    }
    for (const auto& [kind, target] : done_) {
      if (std::ranges::find(kinds, kind) != kinds.end() && !known.contains(target)) {
        complain(std::string{target} + " is no " + what + " of the composition");
      }
    }
  }
  void complain(std::string words) { complaints_.push_back(std::move(words)); }

  const CompositionInfo& composition_;
  std::set<Pair> handled_;  ///< triggers and causes of the rules
  std::set<Pair> done_;     ///< kinds and targets of the effects
  std::set<std::string> fed_;
  std::set<Pair> needed_;
  std::vector<std::string> complaints_;
};

}  // namespace

std::vector<std::string> what_is_forgotten(const CompositionInfo& composition) {
  return Completeness{composition}.check();
}

}  // namespace stormproof::fsm::composition
