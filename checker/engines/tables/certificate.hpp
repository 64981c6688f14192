// A certificate: an invariant of a derived system, clause by clause in words, and what follows from
// it. What is stated is what a proof is about; what else it needs is found among candidates
// (checker/engines/tables/houdini.hpp). Z3 and cvc5 decide one condition for each step, and an
// export has the whole as SMT-LIB in which every answer must be unsat.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "checker/engines/bounds/check_request.hpp"
#include "checker/engines/tables/transition_system.hpp"

namespace stormproof::tables {

struct Clause {
  std::string words;
  Expr holds;
};

/// A step of this name that is taken where `before` holds leads to where `after` holds.
struct StepClause {
  std::string words;
  std::string step;
  Expr before;
  Expr after;
};

struct Certificate {
  TransitionSystem system;
  Exprs constants{};                   ///< unknowns that are no variables
  std::vector<Clause> given{};         ///< what is assumed of them
  std::vector<Clause> invariant{};     ///< what is stated
  Exprs candidates{};                  ///< of what else holds
  std::vector<Clause> conclusions{};   ///< in every state
  std::vector<StepClause> on_steps{};  ///< of steps
};

/// Decides it, and gives up at the first clause that a step does not keep. What is stated goes into
/// the details. Whether all of it holds.
bool prove(Proof& proof, const Certificate& certificate);
/// Proves it and ends the proof. Checks that share what they find of rules prove what is the same,
/// word for word, once.
[[nodiscard]] props::Finding proved(Proof& proof, const Certificate& certificate,
                                    const std::string& how);
/// The same as `prove` for those who know better than to give up: false, and nothing is said, if a
/// step does not keep what is stated.
[[nodiscard]] bool prove_if_kept(Proof& proof, const Certificate& certificate);

/// The certificate with this invariant as SMT-LIB, to be read and checked by others. It begins with
/// what is claimed: of every state, of steps, and under which assumptions.
[[nodiscard]] std::string certificate_text(const Certificate& certificate,
                                           const std::vector<Clause>& invariant,
                                           std::string_view property,
                                           const std::vector<std::string>& assumptions);

/// A property that certificates make together, unless there is a reason why they say nothing of the
/// scenario. Nothing is decided then.
[[nodiscard]] props::Finding of_certificates(
    const checker::CheckRequest& request, const char* how, const std::string& why_not,
    std::vector<std::string> assumptions,
    const std::function<std::vector<props::Finding>()>& certificates);

}  // namespace stormproof::tables
