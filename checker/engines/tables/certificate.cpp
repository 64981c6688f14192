// The search for what a statement needs, its conditions, and what is said of them.
#include "checker/engines/tables/certificate.hpp"

#include <algorithm>

#include "checker/engines/bounds/resting.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/engines/tables/houdini.hpp"
#include "props/property.hpp"

namespace stormproof::tables {
namespace {

Exprs holds_of(const std::vector<Clause>& clauses) {
  Exprs all;
  for (const Clause& clause : clauses) all.push_back(clause.holds);
  return all;
}

/// Of what is given, stated and found: what every step keeps, and what is stated in vain. Nothing
/// if a solver has no answer.
struct Found {
  struct Loss {
    std::string words;
    std::string state;  ///< in which the step is taken
  };
  std::vector<Clause> invariant;
  std::vector<Loss> lost;
};
std::optional<Found> find(Proof& proof, const Certificate& certificate) {
  std::vector<Clause> all = certificate.given;
  all.insert(all.end(), certificate.invariant.begin(), certificate.invariant.end());
  const std::size_t stated = all.size();
  for (const Expr& candidate : certificate.candidates) all.push_back({"found", candidate});
  const std::optional<Kept> kept = houdini(proof, certificate.system, holds_of(all));
  if (!kept) return std::nullopt;
  Found found;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (kept->kept[k]) {
      found.invariant.push_back(all[k]);
    } else if (k < stated) {
      found.lost.push_back(
          {"'" + all[k].words + "' is lost at: " + kept->lost_at[k], kept->lost_in[k]});
    }
  }
  return found;
}

bool follows(Proof& proof, const Certificate& certificate, const Expr& invariant) {
  bool holds = true;
  const auto fail = [&](const std::string& why) {
    proof.give_up(why);
    proof.detail(why);
    holds = false;
  };
  for (const StepClause& clause : certificate.on_steps) {
    bool taken = false;
    for (const SystemStep& step : certificate.system.steps) {
      if (step.name != clause.step) continue;
      taken = true;
      const Expr after = with(clause.after, certificate.system.variables, step.next);
      if (proof.possible(step.name + ": not so: " + clause.words,
                         {invariant, clause.before, step.guard, !after})) {
        fail("not so: " + clause.words);
      }
    }
    if (!taken) fail("there is no step " + clause.step + ": " + clause.words);
  }
  for (const Clause& clause : certificate.conclusions) {
    if (proof.possible("not so: " + clause.words, {invariant, !clause.holds})) {
      fail("not so: " + clause.words);
    }
  }
  return holds;
}

bool conclude(Proof& proof, const Certificate& certificate, const std::vector<Clause>& invariant) {
  const Expr all = all_of(holds_of(invariant));
  TransitionSystem safe = certificate.system;
  safe.bad = !all;
  bool holds = certify(proof, safe, all);
  if (!holds) proof.give_up("an invariant that was found does not pass its check");
  holds = follows(proof, certificate, all) && holds;
  for (const Clause& clause : certificate.invariant) proof.detail(clause.words);
  for (const Clause& clause : certificate.conclusions) {
    const bool is_said = std::ranges::find(certificate.invariant, clause.words, &Clause::words) !=
                         certificate.invariant.end();
    if (!is_said) proof.detail(clause.words);
  }
  for (const StepClause& clause : certificate.on_steps) proof.detail(clause.words);
  smt::Claims& claims = proof.request().claims;
  if (holds && !claims.options().export_dir.empty()) {
    claims.export_certificate(
        proof.property(),
        certificate_text(certificate, invariant, proof.property(), proof.so_far().assumptions));
  }
  return holds;
}

/// Everything that the answer depends on, and what is said of it.
std::string question_of(const Proof& proof, const Certificate& certificate,
                        const std::string& how) {
  std::vector<Clause> all = certificate.given;
  all.insert(all.end(), certificate.invariant.begin(), certificate.invariant.end());
  for (const Expr& candidate : certificate.candidates) all.push_back({"found", candidate});
  std::string text =
      certificate_text(certificate, all, proof.property(), proof.so_far().assumptions) + how;
  for (const StepClause& clause : certificate.on_steps) {
    text += "\n" + clause.step + ": " + clause.words;
  }
  for (const std::string& sentence : proof.so_far().details) text += "\n" + sentence;
  return text + "\n" + std::to_string(certificate.given.size()) + ", " +
         std::to_string(certificate.invariant.size());
}

}  // namespace

bool prove(Proof& proof, const Certificate& certificate) {
  const std::optional<Found> found = find(proof, certificate);
  if (!found) return false;
  for (const Found::Loss& loss : found->lost) {
    proof.give_up(loss.words);
    proof.detail(loss.words);
    proof.detail("a state in which it is: " + loss.state);
  }
  return conclude(proof, certificate, found->invariant);
}

props::Finding proved(Proof& proof, const Certificate& certificate, const std::string& how) {
  const auto decide = [&] {
    prove(proof, certificate);
    return proof.finish(how);
  };
  // The text is long; nobody needs it if nobody shares.
  if (proof.request().of_rules == nullptr) return decide();
  return checker::found_of_rules(proof.request(), question_of(proof, certificate, how), decide);
}

bool prove_if_kept(Proof& proof, const Certificate& certificate) {
  const std::optional<Found> found = find(proof, certificate);
  return found && found->lost.empty() && conclude(proof, certificate, found->invariant);
}

props::Finding of_certificates(const checker::CheckRequest& request, const char* how,
                               const std::string& why_not, std::vector<std::string> assumptions,
                               const std::function<std::vector<props::Finding>()>& certificates) {
  props::Finding finding;
  finding.engine = props::name_of(props::Engine::tables);
  finding.how = how;
  finding.seed = request.claims.options().seed;
  if (!why_not.empty()) {
    checker::leave_open(finding, why_not);
    return finding;
  }
  finding.kind = props::VerdictKind::proved;
  finding.solver = smt::Claims::solver_name();
  finding.assumptions = std::move(assumptions);
  for (const props::Finding& part : certificates()) {
    checker::rest_on(finding, part);
    if (!part.solver.empty()) finding.solver = part.solver;
  }
  return finding;
}

}  // namespace stormproof::tables
