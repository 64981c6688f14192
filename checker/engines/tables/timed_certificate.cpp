// Which states go with what the reader has, and the assumptions in words.
#include "checker/engines/tables/timed_certificate.hpp"

#include "checker/engines/tables/derived_time.hpp"
#include "checker/engines/tables/houdini.hpp"

namespace stormproof::tables {
namespace {

/// What else may hold: each state, packet and timer implies that the reader has the descriptor,
/// knows of it, or is open; and nothing that is looked at is overdue.
Exprs candidates_of(const TimedDescriptor& whole, const Moving& moving) {
  Exprs candidates = facts_of(moving.system);
  Exprs implied{moving(whole["Reader=Recognised"] || whole["Reader=Complete"])};
  for (const Expr& variable : moving.system.variables) {
    const std::string name = variable.decl().name().str();
    for (const char* other : {"X", "Known", "Exists", "WriterOpen"}) {
      if (name == other) implied.push_back(variable);
    }
  }
  for (const Expr& variable : moving.system.variables) {
    if (!variable.is_bool()) continue;
    for (const Expr& other : implied) candidates.push_back(z3::implies(variable, other));
    const std::string name = variable.decl().name().str();
    for (const auto& [prefix, end] : {std::pair<std::string, std::string>{"in flight ", "arrives "},
                                      std::pair<std::string, std::string>{"leaving ", "leaves "}}) {
      if (!name.starts_with(prefix)) continue;
      candidates.push_back(
          z3::implies(variable, whole[timed::now] <= whole[end + name.substr(prefix.size())]));
    }
  }
  return candidates;
}

}  // namespace

void assume_in_time(Proof& proof) {
  proof.assume(
      "A packet that matters arrives within Δ, unless it is lost, and has left its source within "
      "σ ≤ Δ; all others may be delayed, lost, duplicated and reordered without bound.");
  proof.assume(
      "What is scheduled happens at its time, and receptions before timers of the same instant.");
  proof.assume(
      "The numbers of descriptors and readers are arbitrary: one is looked at, and what the rules "
      "read of the others ranges freely.");
  proof.assume(hosts_keep_contracts);
}

void give(Certificate& certificate, std::string words, const Expr& holds) {
  certificate.given.push_back({std::move(words), holds});
  certificate.system.initial = certificate.system.initial && holds;
}

Certificate certificate_in_time(const TimedDescriptor& descriptor, const Moving& moving) {
  Certificate certificate{.system = moving.system,
                          .constants = descriptor.unknowns(),
                          .candidates = candidates_of(descriptor, moving)};
  for (const Expr& assumption : descriptor.assumptions()) give(certificate, "given", assumption);
  return certificate;
}

}  // namespace stormproof::tables
