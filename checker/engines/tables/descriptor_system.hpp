// One generic descriptor of one generic relation as a transition system, derived from the rules of
// the composition (checker/engines/tables/derivation.hpp), and what the properties about it watch:
// whether an ACKNACK has asked for the descriptor, and what one ACKNACK on its way says of it. All
// other descriptors, readers and streams enter only through unknowns. That is why a proof about it
// holds for any number of them.
#pragma once

#include <optional>
#include <string>

#include "checker/engines/tables/derivation.hpp"
#include "checker/engines/tables/proof.hpp"
#include "fsm/program/program.hpp"
#include "model/mutation.hpp"

namespace stormproof::tables {

/// What is watched besides the state of the composition.
namespace watched {
/// An ACKNACK that lists it has arrived since repair DATA with it was made last.
inline constexpr const char* asked = "asked";
/// Repair DATA has carried it though no ACKNACK had asked for it.
inline constexpr const char* unasked_repair = "unasked repair";
/// An ACKNACK listed what its reader had at its generation, or did not list what it lacked.
inline constexpr const char* wrong_list = "an ACKNACK does not list what is missing";
inline constexpr const char* generated = "ACKNACK generated";  ///< the one that is looked at
inline constexpr const char* lists = "it lists the descriptor";
inline constexpr const char* listed_at_first = "it listed the descriptor at its generation";
}  // namespace watched

class DescriptorSystem {
 public:
  DescriptorSystem(const fsm::program::Program& program, const model::DdsProfile& dds,
                   const model::Mutation& mistakes, Unsound unsound = Unsound::none);
  /// That of the profile's implementation.
  DescriptorSystem(const model::DdsProfile& dds, const model::Mutation& mistakes,
                   Unsound unsound = Unsound::none);

  /// A variable: "C=A" (the writer's state of the descriptor), "X", "pending HeartbeatExpiry", …
  [[nodiscard]] const Expr& operator[](const std::string& name) const {
    return derivation_.variable(name);
  }
  /// The descriptor's number in its stream, from 1, if the composition has them; see Derivation.
  [[nodiscard]] const std::optional<Expr>& number() const { return derivation_.number(); }
  /// The whole system; `bad` is left to the property.
  [[nodiscard]] TransitionSystem whole() const { return derivation_.system(); }
  /// As much of it as matters to whether `bad` can be reached.
  [[nodiscard]] TransitionSystem with_bad(const Expr& bad) const;

 private:
  Derivation derivation_;
};

/// States in the finding what everything assumes that is derived from a composition.
void assume_for_descriptors(Proof& proof);

/// The system of the implementation that the scenario of `proof` names, with the mutant's mistakes.
/// States its assumptions in the finding.
[[nodiscard]] DescriptorSystem descriptor_system(Proof& proof);

}  // namespace stormproof::tables
