// Events as solver expressions and the rule that orders them: the product's own
// (model/event_order.hpp), or a mistaken one.
#pragma once

#include <string>

#include "checker/engines/tables/proof.hpp"

namespace stormproof::tables {

/// What an event is in the words of the paper's sentence about same-time events.
enum class Role : std::uint8_t { reception = 0, decision = 1, other = 2, service_start = 3 };
[[nodiscard]] const char* name_of(Role role);

struct SymbolicEvent {
  smt::SymbolicInt time;         ///< ns
  smt::SymbolicInt event_class;  ///< 0, 1, 2
  smt::SymbolicInt insertion;    ///< below 2^62
  smt::SymbolicInt role;         ///< only the paper's sentence reads it

  /// An event with this name of which nothing is known.
  static SymbolicEvent named(const std::string& name);
  /// Its fields are in range.
  [[nodiscard]] Expr valid() const;
};

/// Whether `a` is processed before `b` under the rule.
[[nodiscard]] Expr before(checker::OrderRule rule, const SymbolicEvent& a, const SymbolicEvent& b);

/// The rule of the request: the product's own without a mutant.
[[nodiscard]] checker::OrderRule order_rule(const checker::CheckRequest& request);

}  // namespace stormproof::tables
