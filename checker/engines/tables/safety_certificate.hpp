// Certificates of what is never so, whenever anything happens: invariants of the system of one
// descriptor (checker/engines/tables/descriptor_system.hpp), whose timers and packets know no time.
// Should a mutant's step not keep one, the shortest steps that break the property are looked for.
#pragma once

#include "checker/engines/tables/certificate.hpp"
#include "checker/engines/tables/descriptor_system.hpp"

namespace stormproof::tables {

struct Never {
  Expr bad;
  std::string breaks;  ///< what is so then, in words
};

struct SafetyStatement {
  std::vector<Clause> invariant;  ///< which excludes all that is never so
  Exprs implied;                  ///< what the state of anything may imply
  std::vector<Never> never;
};

/// Decides it. Returns the method, for `Proof::finish`.
std::string prove_never(Proof& proof, const DescriptorSystem& descriptor,
                        const SafetyStatement& statement);

/// What is in A has been received; with numbers, what a reader that has replied acknowledges.
[[nodiscard]] SafetyStatement acknowledged_is_received(const DescriptorSystem& descriptor);

}  // namespace stormproof::tables
