// The certificates are those of `stormproof check`.
#include "checker/experiments/museum/certified.hpp"

#include <algorithm>

#include "checker/engines/smt/claims.hpp"
#include "checker/engines/tables/tables.hpp"
#include "props/property.hpp"

namespace stormproof::museum {

namespace {

using props::VerdictKind;

props::Finding finding_of(std::string_view claim, const model::Scenario& scenario,
                          const std::function<bool()>& go_on) {
  smt::Options solver;
  solver.interrupted = [&] { return !go_on(); };
  smt::Claims claims{solver};
  const checker::CheckRequest request{
      .scenario = scenario,
      .claims = claims,
      .on_progress = [&](std::string_view) { return go_on(); },
  };
  const checker::Findings findings = tables::check({&claim, 1}, request);
  return findings.empty() ? props::Finding{} : findings.front().second;
}

}  // namespace

bool is_provable(std::string_view claim) {
  const props::Property* property = props::find_property(claim);
  return property != nullptr &&
         std::ranges::find(property->engines, props::Engine::tables) != property->engines.end();
}

void take(Found& found, const props::Finding& proof) {
  if (proof.kind != VerdictKind::proved && proof.kind != VerdictKind::disputed) return;
  const bool contradicted = found.verdict == VerdictKind::violated;
  found.verdict = contradicted ? VerdictKind::disputed : proof.kind;
  found.how = proof.how + "; " + found.how;
  found.assumptions = proof.assumptions;
}

void certify(Found& found, const Exhibit& exhibit, const Variant& variant,
             const std::function<bool()>& go_on) {
  if (found.verdict == VerdictKind::violated) {
    Exhibit general = exhibit;
    general.bound.reset();
    if (search(general, variant, go_on).verdict != VerdictKind::violated) return;
  }
  take(found, finding_of(exhibit.claim, variant.scenario, go_on));
}

}  // namespace stormproof::museum
