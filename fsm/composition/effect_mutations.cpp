// The mistakes that can be made between the machines, from the recorded rules. What changes nothing
// by construction is left out: setting a value twice; feeding an event twice that has no row in a
// state that it has led to; calling a procedure twice that does nothing else, and what such an
// event's outbox asks for; and another order of effects that join no queue, for their values are
// known before.
#include <algorithm>
#include <array>
#include <set>

#include "fsm/composition/composition_info.hpp"
#include "fsm/composition/effect_mutation.hpp"
#include "fsm/machines.hpp"

namespace stormproof::fsm::composition {

namespace {

using Change = EffectMutation::Change;

bool is_any(std::string_view kind, std::initializer_list<std::string_view> kinds) {
  for (const std::string_view each : kinds) {
    if (kind == each) return true;
  }
  return false;
}

/// Whether the order of an effect among its like can be seen: it joins a queue.
bool joins_a_queue(const EffectInfo& effect) {
  return is_any(effect.kind, {"after", "at", "emit"});
}

bool same_block(const EffectInfo& a, const EffectInfo& b) {
  return a.blocks.size() == b.blocks.size() &&
         (a.blocks.empty() || a.blocks.back().number == b.blocks.back().number);
}

/// Whether a machine can react to the event again where it has led to.
bool reacts_twice(const MachineInfo& machine, std::string_view event) {
  for (const RowInfo& first : machine.rows) {
    for (const RowInfo& second : machine.rows) {
      if (machine.events[first.event] == event && second.event == first.event &&
          second.source == first.target) {
        return true;
      }
    }
  }
  return false;
}

bool is_fed_to_no_avail_again(const EffectInfo& effect, const CompositionInfo& composition) {
  static const std::vector<MachineInfo> all = machines();
  if (!is_any(effect.kind, {"feed", "feed each"})) return false;
  const std::string_view event = std::string_view{effect.detail}.substr(0, effect.detail.find(' '));
  const auto part = std::ranges::find(composition.parts, effect.target, &PartInfo::name);
  return !reacts_twice(*std::ranges::find(all, part->machine, &MachineInfo::name), event);
}

/// Whether the effect happens only if the part's outbox says so.
bool is_asked_for_by(const std::string_view part, const EffectInfo& effect) {
  const std::string asks = "if " + std::string{part} + ".";
  return std::ranges::any_of(effect.blocks, [&](const BlockInfo& block) {
    return block.text.starts_with(asks) && block.text.find(" or ") == std::string::npos;
  });
}

bool shows_twice(const EffectInfo& effect, const CompositionInfo& composition);

/// Whether a procedure that is called again at once does something again.
bool shows_again(const RuleInfo& procedure, const CompositionInfo& composition) {
  const std::vector<EffectInfo>& effects = procedure.effects;
  return std::ranges::any_of(effects, [&](const EffectInfo& effect) {
    const bool never_again = std::ranges::any_of(effects, [&](const EffectInfo& fed) {
      return is_fed_to_no_avail_again(fed, composition) && is_asked_for_by(fed.target, effect);
    });
    return !never_again && shows_twice(effect, composition);
  });
}

bool shows_twice(const EffectInfo& effect, const CompositionInfo& composition) {
  if (is_any(effect.kind, {"renew", "set", "set each", "cancel"})) return false;
  if (effect.kind == "call") {
    const auto called = std::ranges::find(composition.procedures, effect.target, &RuleInfo::id);
    return called == composition.procedures.end() || shows_again(*called, composition);
  }
  return !is_fed_to_no_avail_again(effect, composition);
}

/// What can be wrong at an effect of a rule with this owner, whatever follows it.
std::vector<Change> changes_of(const EffectInfo& effect, std::string_view owner,
                               const CompositionInfo& composition) {
  std::vector<Change> changes{Change::drop};
  if (shows_twice(effect, composition)) changes.push_back(Change::twice);
  if (is_any(effect.kind, {"after", "at"})) {
    changes.push_back(Change::at_once);
    changes.push_back(Change::other_delay);
  }
  const bool of_one_reader = owner == "relation";
  if (of_one_reader && is_any(effect.kind, {"after", "at", "emit", "feed each", "raise"})) {
    changes.push_back(Change::every_reader);
  }
  if (owner == "relation" && is_any(effect.kind, {"after", "at", "emit", "raise"})) {
    changes.push_back(Change::reversed);
  }
  return changes;
}

class Mutations {
 public:
  explicit Mutations(const CompositionInfo& composition) : composition_{composition} {
    for (const RuleInfo& rule : composition.rules) add(rule);
    for (const RuleInfo& procedure : composition.procedures) add(procedure);
  }
  std::vector<EffectMutation> list;

 private:
  void add(const RuleInfo& rule) {
    for (std::size_t k = 0; k < rule.effects.size(); ++k) {
      const EffectInfo& effect = rule.effects[k];
      for (std::size_t depth = 0; depth < effect.blocks.size(); ++depth) {
        add(effect.blocks[depth], effect.id + ":if" + std::to_string(depth + 1));
      }
      for (const Change change : changes_of(effect, rule.owner, composition_)) add(effect, change);
      if (k + 1 == rule.effects.size()) continue;
      const EffectInfo& next = rule.effects[k + 1];
      if (joins_a_queue(effect) && joins_a_queue(next) && same_block(effect, next)) {
        add(effect, Change::after_next);
      }
    }
  }
  void add(const EffectInfo& effect, Change change) {
    std::string what{effect.kind};
    what.append(" ").append(effect.target);
    if (!effect.detail.empty()) what.append(" ").append(effect.detail);
    list.push_back(
        {std::string{composition_.name}, effect.id, std::move(what), effect.key, change});
  }
  void add(const BlockInfo& block, const std::string& id) {
    if (!seen_.insert(block.key).second) return;
    const auto add = [&](Change change) {
      list.push_back({std::string{composition_.name}, id, block.text, block.key, change});
    };
    if (block.kind == "when") {
      add(Change::negated);
      add(Change::always);
    } else if (block.text != "in the reverse direction") {
      add(Change::first_only);
    }
  }

  const CompositionInfo& composition_;
  std::set<EffectKey> seen_;
};

constexpr std::array<std::string_view, 11> change_names{
    "none",         "dropped",    "twice",    "after-next", "at-once", "other-delay",
    "every-reader", "first-only", "reversed", "negated",    "always"};

}  // namespace

std::string_view word_of(Change change) { return change_names[static_cast<std::size_t>(change)]; }

std::vector<EffectMutation> effect_mutations(const CompositionInfo& composition) {
  return std::move(Mutations{composition}.list);
}

}  // namespace stormproof::fsm::composition
