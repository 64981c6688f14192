// What two compositions share and where they differ. Rules, procedures and steps are matched by
// their names; the effects of a pair by what they do, in order.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "fsm/composition/composition_info.hpp"

namespace stormproof::draw {

/// Of an effect that is not the same in both.
struct EffectDifference {
  std::string first;   ///< id in the first composition; empty: only in the second
  std::string second;  ///< empty: only in the first
  std::string first_words, second_words;  ///< "if WriterOpen: emit Heartbeat"
};

/// A rule, procedure or step in either composition.
struct RuleComparison {
  /// `relies`: says the same, but on something that differs: a procedure, a step, a machine, a
  /// fact.
  enum class Is : std::uint8_t { same, relies, different, only_first, only_second };
  std::string id;
  std::string group;  ///< "rule", "procedure", "step"
  Is is = Is::same;
  std::vector<std::string> relies_on;  ///< of `relies`
  std::string triggers;                ///< if they differ: "when … / when …"
  std::vector<EffectDifference> effects;
  std::vector<std::string> ids;  ///< of all effects, if only one composition has it
};

struct CompositionComparison {
  std::string first, second;  ///< names of the compositions
  std::vector<RuleComparison> rules;
  std::vector<std::string> things;  ///< sentences about machines, packets, timers, state, facts

  /// Of this group; with `is`, only such.
  [[nodiscard]] std::size_t count(std::string_view group) const;
  [[nodiscard]] std::size_t count(std::string_view group, RuleComparison::Is is) const;
};
[[nodiscard]] std::string_view name_of(RuleComparison::Is is);

[[nodiscard]] CompositionComparison compare(const fsm::composition::CompositionInfo& first,
                                            const fsm::composition::CompositionInfo& second);

[[nodiscard]] report::Document comparison_document(const CompositionComparison& comparison);
[[nodiscard]] nlohmann::ordered_json comparison_json(const CompositionComparison& comparison);
[[nodiscard]] nlohmann::ordered_json comparison_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::draw
