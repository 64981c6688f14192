// The certificate for as much of the system as matters to what is stated.
#include "checker/engines/tables/safety_certificate.hpp"

#include "checker/engines/tables/houdini.hpp"

namespace stormproof::tables {
namespace {

/// "what is in A has been received: C=A implies X"
std::string in_both_languages(const Clause& clause) {
  std::string text;
  for (const std::string& line : invariant_lines(clause.holds)) {
    text += (text.empty() ? "" : "; ") + line;
  }
  return clause.words + ": " + text;
}

Certificate certificate_of(const DescriptorSystem& descriptor, const SafetyStatement& statement) {
  TransitionSystem whole = descriptor.whole();
  Exprs broken;
  for (const Clause& clause : statement.invariant) broken.push_back(!clause.holds);
  for (const Never& never : statement.never) broken.push_back(never.bad);
  whole.bad = any_of(broken);
  const Moving moving{whole};
  Certificate certificate{.system = what_matters(moving.system)};
  if (descriptor.number()) certificate.constants.push_back(*descriptor.number());
  for (const Clause& clause : statement.invariant) {
    certificate.invariant.push_back({in_both_languages(clause), moving(clause.holds)});
  }
  for (const Never& never : statement.never) {
    certificate.conclusions.push_back({"never: " + never.breaks, !moving(never.bad)});
  }
  certificate.candidates = facts_of(certificate.system);
  for (const Expr& variable : certificate.system.variables) {
    if (!variable.is_bool()) continue;
    for (const Expr& implied : statement.implied) {
      certificate.candidates.push_back(z3::implies(variable, moving(implied)));
    }
  }
  return certificate;
}

}  // namespace

std::string prove_never(Proof& proof, const DescriptorSystem& descriptor,
                        const SafetyStatement& statement) {
  const Certificate certificate = certificate_of(descriptor, statement);
  proof.detail("invariant:");
  if (prove_if_kept(proof, certificate)) {
    return "invariant over the steps that are derived from the rules, any number of them";
  }
  std::string how;
  for (const Never& never : statement.never) {
    if (proof.violated()) break;
    how = prove_unreachable(proof, descriptor.with_bad(never.bad), never.breaks);
  }
  return how;
}

SafetyStatement acknowledged_is_received(const DescriptorSystem& descriptor) {
  const Expr& received = descriptor["X"];
  if (descriptor.number()) {
    // Before its first reply a new reader only counts as having what there was.
    const Expr taken = descriptor["Peer=Replied"] && descriptor["Acked"] >= *descriptor.number();
    return {{{"what a reader that has replied acknowledges has been received", !taken || received}},
            {received},
            {{taken && !received, "a reader has acknowledged a sample that it has not received"}}};
  }
  return {
      {{"what is in A has been received", !descriptor["C=A"] || received}},
      {received},
      {{descriptor["C=A"] && !received, "a descriptor is in A that the reader has not received"}}};
}

}  // namespace stormproof::tables
