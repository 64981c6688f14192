// What a composition forgets: whatever exists in it must be used or caused by some rule, or a
// reason is given why not.
#include <algorithm>
#include <map>
#include <set>

#include "fsm/composition/composition_info.hpp"

namespace stormproof::fsm::composition {
namespace {

class Completeness {
 public:
  explicit Completeness(const CompositionInfo& composition) : composition_{composition} {}

  std::vector<Forgotten> check() {
    collect(composition_.rules);
    collect(composition_.procedures);
    collect(composition_.steps);
    check_outboxes();
    check_events();
    check_causes({"timer",
                  "due",
                  {"after", "at"},
                  "is handled by no rule",
                  "is started by nothing",
                  "a rule that starts it, or a reason among what comes from outside"},
                 composition_.timers);
    check_causes({"packet",
                  "received",
                  {"emit"},
                  "is received by nobody",
                  "is emitted by nobody",
                  "a rule that emits it"},
                 composition_.packets);
    check_causes({"occasion",
                  "happens",
                  {"raise"},
                  "has no rule",
                  "is raised by nothing",
                  "a rule that raises it, or a reason among what comes from outside"},
                 composition_.occasions);
    check_state();
    check_reasons();
    return std::move(forgotten_);
  }

 private:
  using Pair = std::pair<std::string_view, std::string_view>;
  /// A kind of things that are caused by effects, and cause rules.
  struct Kind {
    std::string name;
    std::string_view trigger;
    std::vector<std::string_view> effects;
    std::string_view without_rule;
    std::string_view without_cause;
    std::string_view expected_cause;
  };

  void collect(const std::vector<RuleInfo>& rules) {
    for (const RuleInfo& rule : rules) {
      handled_.insert({{rule.trigger, rule.cause}, &rule});
      for (const EffectInfo& effect : rule.effects) {
        // A timer that starts itself again is not started by that.
        const bool itself = rule.trigger == "due" && rule.cause == effect.target;
        (itself ? again_ : done_).insert({{effect.kind, effect.target}, &effect});
        if (!effect.kind.starts_with("feed")) continue;
        feeds_.insert({effect.target, &effect});
        fed_.insert(std::string{effect.target} + "." +
                    effect.detail.substr(0, effect.detail.find(' ')));
        check_known(effect);
      }
    }
  }
  void check_known(const EffectInfo& effect) {
    const auto known = [&](const PartInfo& part) { return part.name == effect.target; };
    if (std::ranges::none_of(composition_.parts, known)) {
      complain(effect.id + " feeds " + std::string{effect.target} + ", which is no part",
               place_of(effect), "a part of the composition");
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
        if (!excused(part.name, field)) {
          complain("nothing reads " + name, place_of_feed(part.name),
                   "a condition or value with it, or a reason among what is unused");
        }
      }
    }
  }
  void check_events() {
    for (const PartInfo& part : composition_.parts) {
      for (const std::string_view event : part.events) {
        const std::string name = std::string{part.name} + "." + std::string{event};
        if (fed_.contains(name)) continue;
        if (!excused(part.name, event)) {
          complain("nothing feeds " + name, place_of_feed(part.name),
                   "a rule that feeds it, or a reason among what is unused");
        }
      }
    }
  }
  void check_causes(const Kind& kind, const std::vector<ThingInfo>& things) {
    std::set<std::string_view> known;
    for (const ThingInfo& thing : things) {
      known.insert(thing.name);
      const std::string name = kind.name + " " + std::string{thing.name};
      const EffectInfo* const cause = caused(done_, kind, thing.name);
      const EffectInfo* const again = caused(again_, kind, thing.name);
      const auto rule = handled_.find({kind.trigger, thing.name});
      if (rule == handled_.end()) {
        complain(name + " " + std::string{kind.without_rule},
                 cause == nullptr ? "" : place_of(*cause), "a rule for it");
      }
      if (cause == nullptr && !from_outside(thing.name)) {
        const std::string then = rule == handled_.end() ? "" : "rule " + rule->second->id;
        complain(name + " " + std::string{kind.without_cause} + (again ? " but itself" : ""),
                 again == nullptr ? then : place_of(*again), std::string{kind.expected_cause});
      }
    }
    for (const auto& [what, effect] : done_) {
      const bool of_kind = std::ranges::find(kind.effects, what.first) != kind.effects.end();
      if (of_kind && !known.contains(what.second)) {
        complain(std::string{what.second} + " is no " + kind.name + " of the composition",
                 place_of(*effect), "one of its " + kind.name + "s");
      }
    }
  }
  void check_state() {
    for (const ThingInfo& state : composition_.state) {
      if (!done_.contains({"set", state.name}) && !done_.contains({"set each", state.name})) {
        complain("state " + std::string{state.name} + " is set by nothing", "",
                 "a rule that sets it");
      }
    }
  }
  void check_reasons() {
    for (const UnusedInfo& unused : composition_.unused) {
      if (!needed_.contains({unused.part, unused.name})) {
        complain(std::string{unused.part} + "." + std::string{unused.name} +
                     " is used, and needs no reason",
                 place_of_feed(unused.part), "no entry among what is unused");
      }
    }
    for (const FromOutsideInfo& cause : composition_.from_outside) {
      if (!excused_.contains(cause.name)) {
        complain(std::string{cause.name} + " is caused by a rule, and needs no reason", "",
                 "no entry among what comes from outside");
      }
    }
  }
  static const EffectInfo* caused(const std::map<Pair, const EffectInfo*>& by, const Kind& kind,
                                  std::string_view name) {
    for (const std::string_view effect : kind.effects) {
      const auto found = by.find({effect, name});
      if (found != by.end()) return found->second;
    }
    return nullptr;
  }
  bool from_outside(std::string_view name) {
    excused_.insert(name);
    return std::ranges::any_of(composition_.from_outside, [&](const FromOutsideInfo& cause) {
      return cause.name == name && !cause.reason.empty();
    });
  }
  [[nodiscard]] std::string place_of_feed(std::string_view part) const {
    const auto found = feeds_.find(part);
    return found == feeds_.end() ? "" : place_of(*found->second);
  }
  void complain(std::string what, std::string where, std::string expected) {
    forgotten_.push_back({std::move(what), std::move(where), std::move(expected)});
  }

  const CompositionInfo& composition_;
  std::map<Pair, const RuleInfo*> handled_;              ///< by trigger and cause
  std::map<Pair, const EffectInfo*> done_;               ///< by kind and target
  std::map<Pair, const EffectInfo*> again_;              ///< the same of timers in their own rules
  std::map<std::string_view, const EffectInfo*> feeds_;  ///< by part
  std::set<std::string> fed_;
  std::set<Pair> needed_;
  std::set<std::string_view> excused_;  ///< what no rule causes
  std::vector<Forgotten> forgotten_;
};

}  // namespace

std::vector<Forgotten> what_is_forgotten(const CompositionInfo& composition) {
  return Completeness{composition}.check();
}

}  // namespace stormproof::fsm::composition
