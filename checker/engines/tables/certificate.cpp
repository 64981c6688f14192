// The search for what a statement needs, its conditions, and what is said of them.
#include "checker/engines/tables/certificate.hpp"

#include <algorithm>

#include "checker/engines/smt/claims.hpp"
#include "checker/engines/tables/houdini.hpp"

namespace stormproof::tables {
namespace {

Exprs holds_of(const std::vector<Clause>& clauses) {
  Exprs all;
  for (const Clause& clause : clauses) all.push_back(clause.holds);
  return all;
}

/// Of what is given, stated and found: what every step keeps. Gives up if that lacks something that
/// is stated.
std::vector<Clause> invariant_of(Proof& proof, const Certificate& certificate) {
  std::vector<Clause> all = certificate.given;
  all.insert(all.end(), certificate.invariant.begin(), certificate.invariant.end());
  const std::size_t stated = all.size();
  for (const Expr& candidate : certificate.candidates) all.push_back({"found", candidate});
  const Kept found = houdini(proof, certificate.system, holds_of(all));
  std::vector<Clause> invariant;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (found.kept[k]) {
      invariant.push_back(all[k]);
    } else if (k < stated) {
      const std::string loss = "'" + all[k].words + "' is lost at: " + found.lost_at[k];
      proof.give_up(loss);
      proof.detail(loss);
    }
  }
  return invariant;
}

bool follows(Proof& proof, const Certificate& certificate, const Expr& invariant) {
  bool holds = true;
  for (const StepClause& clause : certificate.on_steps) {
    for (const SystemStep& step : certificate.system.steps) {
      if (step.name != clause.step) continue;
      const Expr after = with(clause.after, certificate.system.variables, step.next);
      const bool possible = proof.possible(step.name + ": not so: " + clause.words,
                                           {invariant, clause.before, step.guard, !after});
      if (possible) proof.give_up("not so: " + clause.words);
      holds = holds && !possible;
    }
  }
  for (const Clause& clause : certificate.conclusions) {
    const bool possible = proof.possible("not so: " + clause.words, {invariant, !clause.holds});
    if (possible) proof.give_up("not so: " + clause.words);
    holds = holds && !possible;
  }
  return holds;
}

}  // namespace

bool prove(Proof& proof, const Certificate& certificate) {
  const std::vector<Clause> invariant = invariant_of(proof, certificate);
  const Expr all = all_of(holds_of(invariant));
  TransitionSystem safe = certificate.system;
  safe.bad = !all;
  bool holds = certify(proof, safe, all);
  if (!holds) proof.give_up("an invariant that was found does not pass its check");
  holds = follows(proof, certificate, all) && holds;
  for (const auto* stated : {&certificate.invariant, &certificate.conclusions}) {
    for (const Clause& clause : *stated) proof.detail(clause.words);
  }
  for (const StepClause& clause : certificate.on_steps) proof.detail(clause.words);
  smt::Claims& claims = proof.request().claims;
  if (holds && !claims.options().export_dir.empty()) {
    claims.export_certificate(proof.property(),
                              certificate_text(certificate, invariant, proof.property()));
  }
  return holds;
}

}  // namespace stormproof::tables
