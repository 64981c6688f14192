// A deliberate mistake between the machines: at one effect, condition or loop of a rule.
// `stormproof mutate` makes every one of them, and looks which property notices; see
// fsm/table_mutation.hpp for those in the machines.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stormproof::fsm::composition {

/// What names an effect, condition or loop; see fsm/composition/trail.hpp.
enum class EffectKey : std::uint64_t {};

struct EffectMutation {
  enum class Change : std::uint8_t {
    none,
    drop,          ///< the effect does not happen
    twice,         ///< it happens twice
    after_next,    ///< it happens after the one that follows it
    at_once,       ///< a timer is due now
    other_delay,   ///< a timer is due after τ_H, or after τ_A if it was τ_H
    every_reader,  ///< for every open reader of the writer instead of one
    first_only,    ///< of a loop: only the first
    reversed,      ///< in the reverse direction of the pair
    negated,       ///< of a condition
    always         ///< of a condition: it is not looked at
  };
  std::string composition;  ///< its name
  /// The effect's id, "AckNackArrives.3"; of a condition or loop that of the first effect in it,
  /// and the depth: "AckNackArrives.4:if1".
  std::string effect;
  std::string what;  ///< the effect, condition or loop in words
  EffectKey key{};
  Change change{};
};

[[nodiscard]] std::string_view word_of(EffectMutation::Change change);

struct CompositionInfo;
/// Every mistake that can be made at the effects, conditions and loops of the rules and procedures
/// of a composition; what its contracts say is the host's own.
[[nodiscard]] std::vector<EffectMutation> effect_mutations(const CompositionInfo& composition);

}  // namespace stormproof::fsm::composition
