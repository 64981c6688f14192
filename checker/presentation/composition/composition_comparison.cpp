// Matching of rules and effects.
#include "checker/presentation/composition/composition_comparison.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/core.h>

#include "checker/presentation/composition/composition_words.hpp"

namespace stormproof::draw {

namespace {

namespace comp = fsm::composition;
using comp::CompositionInfo;
using comp::EffectInfo;
using comp::RuleInfo;
using Is = RuleComparison::Is;

std::string effect_words(const EffectInfo& effect) {
  const std::string condition = condition_words(effect);
  return condition.empty() ? sentence(effect) : condition + ": " + sentence(effect);
}

/// What must be the same of two effects that may be called the same but for details.
std::string essence(const EffectInfo& effect) {
  std::string words = std::string{effect.kind} + " " + std::string{effect.target};
  if (effect.kind.starts_with("feed")) {
    words += " " + effect.detail.substr(0, effect.detail.find(' '));
  }
  return words;
}

/// For each of `a` the place in `b` of a longest common subsequence; b.size(): none.
std::vector<std::size_t> common(const std::vector<std::string>& a,
                                const std::vector<std::string>& b) {
  const std::size_t columns = b.size() + 1;
  std::vector<std::size_t> longest((a.size() + 1) * columns, 0);  // of what follows
  for (std::size_t i = a.size(); i-- > 0;) {
    for (std::size_t j = b.size(); j-- > 0;) {
      longest[i * columns + j] =
          a[i] == b[j] ? longest[(i + 1) * columns + j + 1] + 1
                       : std::max(longest[(i + 1) * columns + j], longest[i * columns + j + 1]);
    }
  }
  std::vector<std::size_t> places(a.size(), b.size());
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j]) {
      places[i++] = j++;
    } else if (longest[(i + 1) * columns + j] >= longest[i * columns + j + 1]) {
      ++i;
    } else {
      ++j;
    }
  }
  return places;
}

std::vector<EffectDifference> effect_differences(const RuleInfo& first, const RuleInfo& second) {
  std::vector<std::string> a;
  std::vector<std::string> b;
  for (const EffectInfo& effect : first.effects) a.push_back(effect_words(effect));
  for (const EffectInfo& effect : second.effects) b.push_back(effect_words(effect));
  const std::vector<std::size_t> places = common(a, b);
  std::vector<bool> taken(b.size(), false);
  for (const std::size_t place : places) {
    if (place < b.size()) taken[place] = true;
  }
  std::vector<EffectDifference> differences;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (places[i] < b.size()) continue;
    EffectDifference difference{first.effects[i].id, "", a[i], ""};
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (taken[j] || essence(first.effects[i]) != essence(second.effects[j])) continue;
      taken[j] = true;
      difference.second = second.effects[j].id;
      difference.second_words = b[j];
      break;
    }
    differences.push_back(difference);
  }
  for (std::size_t j = 0; j < b.size(); ++j) {
    if (!taken[j]) differences.push_back({"", second.effects[j].id, "", b[j]});
  }
  return differences;
}

bool mentions(const std::string& text, const std::string& name) {
  const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; at += name.size()) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !in_word(text[at - 1])) && (end == text.size() || !in_word(text[end]))) {
      return true;
    }
  }
  return false;
}

class Comparer {
 public:
  Comparer(const CompositionInfo& first, const CompositionInfo& second)
      : first_{first}, second_{second} {}

  CompositionComparison run() && {
    result_.first = first_.name;
    result_.second = second_.name;
    things();
    rules("rule", first_.rules, second_.rules);
    rules("procedure", first_.procedures, second_.procedures);
    rules("step", first_.steps, second_.steps);
    while (reliance()) {
    }
    return std::move(result_);
  }

 private:
  using Described = std::map<std::string, std::string>;

  void things() {
    const auto parts = [](const CompositionInfo& composition) {
      Described all;
      for (const comp::PartInfo& part : composition.parts) {
        all[std::string{part.name}] = fmt::format("{} of each {}", part.machine, part.owner);
      }
      return all;
    };
    const auto owned = [](const std::vector<comp::ThingInfo>& things) {
      Described all;
      for (const comp::ThingInfo& thing : things) {
        all[std::string{thing.name}] = fmt::format("of each {}", thing.owner);
      }
      return all;
    };
    const auto facts = [](const CompositionInfo& composition) {
      Described all;
      for (const auto& [name, definition] : composition.facts) {
        all[std::string{name}] = definition;
      }
      return all;
    };
    compare_things("machine", parts(first_), parts(second_));
    compare_things("packet", owned(first_.packets), owned(second_.packets));
    compare_things("timer", owned(first_.timers), owned(second_.timers));
    compare_things("state", owned(first_.state), owned(second_.state));
    compare_things("fact", facts(first_), facts(second_));
  }

  void compare_things(const std::string& what, const Described& a, const Described& b) {
    for (const auto& [name, words] : a) {
      const auto other = b.find(name);
      if (other == b.end()) {
        result_.things.push_back(
            fmt::format("{} {} ({}): only {}", what, name, words, result_.first));
      } else if (other->second != words) {
        result_.things.push_back(fmt::format("{} {}: {} in {}, {} in {}", what, name, words,
                                             result_.first, other->second, result_.second));
        differing_.push_back(name);
      }
    }
    for (const auto& [name, words] : b) {
      if (a.count(name) == 0) {
        result_.things.push_back(
            fmt::format("{} {} ({}): only {}", what, name, words, result_.second));
      }
    }
  }

  void rules(const std::string& group, const std::vector<RuleInfo>& a,
             const std::vector<RuleInfo>& b) {
    for (const RuleInfo& rule : a) {
      const auto other = std::ranges::find(b, rule.id, &RuleInfo::id);
      if (other == b.end()) {
        add_alone(group, rule, Is::only_first);
      } else {
        add_pair(group, rule, *other);
      }
    }
    for (const RuleInfo& rule : b) {
      if (std::ranges::find(a, rule.id, &RuleInfo::id) == a.end()) {
        add_alone(group, rule, Is::only_second);
      }
    }
  }

  void add_alone(const std::string& group, const RuleInfo& rule, Is is) {
    RuleComparison comparison{rule.id, group, is, {}, "", {}, {}};
    for (const EffectInfo& effect : rule.effects) comparison.ids.push_back(effect.id);
    result_.rules.push_back(std::move(comparison));
    texts_.emplace_back();
  }

  void add_pair(const std::string& group, const RuleInfo& a, const RuleInfo& b) {
    RuleComparison comparison{a.id, group, Is::same, {}, "", effect_differences(a, b), {}};
    if (a.trigger != b.trigger || a.cause != b.cause || a.owner != b.owner) {
      comparison.triggers =
          fmt::format("{} ({}) / {} ({})", trigger_words(a), a.owner, trigger_words(b), b.owner);
    }
    if (!comparison.effects.empty() || !comparison.triggers.empty()) {
      comparison.is = Is::different;
      if (group != "rule") differing_.push_back(a.id);
    }
    result_.rules.push_back(std::move(comparison));
    std::string text;
    for (const EffectInfo& effect : a.effects) text += effect_words(effect) + "\n";
    texts_.push_back(std::move(text));
  }

  /// Finds more of those that rely on what differs; whether there were any.
  bool reliance() {
    bool found = false;
    for (std::size_t k = 0; k < result_.rules.size(); ++k) {
      RuleComparison& rule = result_.rules[k];
      if (rule.is != Is::same && rule.is != Is::relies) continue;
      std::vector<std::string> names;
      for (const std::string& name : differing_) {
        const std::string word = name.substr(0, name.find(' '));  // a procedure's, not its argument
        if (name != rule.id && mentions(texts_[k], word)) names.push_back(name);
      }
      if (names.size() == rule.relies_on.size()) continue;
      found = true;
      rule.relies_on = std::move(names);
      if (rule.is == Is::same && rule.group != "rule") differing_.push_back(rule.id);
      rule.is = Is::relies;
    }
    return found;
  }

  const CompositionInfo& first_;
  const CompositionInfo& second_;
  CompositionComparison result_;
  std::vector<std::string> texts_;      ///< of the rules in `result_`
  std::vector<std::string> differing_;  ///< names that rules rely on
};

}  // namespace

std::string_view name_of(Is is) {
  switch (is) {
    case Is::same:
      return "same";
    case Is::relies:
      return "relies_on_different";
    case Is::different:
      return "different";
    case Is::only_first:
      return "only_first";
    case Is::only_second:
      return "only_second";
  }
  return "";
}

std::size_t CompositionComparison::count(std::string_view group) const {
  return static_cast<std::size_t>(std::ranges::count(rules, group, &RuleComparison::group));
}

std::size_t CompositionComparison::count(std::string_view group, Is is) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      rules, [&](const RuleComparison& rule) { return rule.group == group && rule.is == is; }));
}

CompositionComparison compare(const CompositionInfo& first, const CompositionInfo& second) {
  return Comparer{first, second}.run();
}

}  // namespace stormproof::draw
