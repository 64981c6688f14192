// The invariant: until the DATA of the opening has arrived, by Δ after it, no ACKNACK is generated,
// so none ever lists the descriptor. Without losses the ghost `limit` stays at the opening.
#include "checker/engines/tables/free_certificate.hpp"

#include "checker/engines/tables/derived_time.hpp"
#include "checker/engines/tables/timed_certificate.hpp"
#include "model/engine/composition_knobs.hpp"

namespace stormproof::tables {
namespace {

/// An initial ACKNACK comes, and asks for what is missing.
bool asks_early(const model::DdsProfile& dds) {
  return model::knob_value(fsm::composition::paper::InitialCountsAsAckNack{}, dds) &&
         dds.sedp.initial_acknack_delay > model::Nanoseconds{0};
}

std::vector<Clause> invariant_of_opening(const TimedDescriptor& is) {
  const Expr open = is["WriterOpen"];
  const Expr opening = is[timed::limit];
  const Expr delta = is.delays().delta.expr();
  const auto waits = [&](const char* timer, const Expr& delay) {
    const Expr from = z3::ite(open, opening, is[timed::now]);
    return z3::implies(is["started " + std::string{timer}],
                       is[timed::earliest(timer)] >= from + delay);
  };
  std::vector<Clause> clauses{
      {"what is open counts, from its opening on",
       is[watched::counting] == open && z3::implies(open, opening <= is[timed::now])},
      {"until it is received, the DATA of the opening is on its way",
       z3::implies(open && !is["X"],
                   is[timed::in_flight("Data")] && is[timed::arrives("Data")] == opening + delta)},
      {"replies are due τ_A after the opening at the earliest",
       z3::implies(is["started AckNackGeneration"], open) &&
           waits("AckNackGeneration", is.delays().response.expr())},
      {"it is in U or A", is["C=U"] || is["C=A"]},
      {"before the opening it is in U", open || is["C=U"]},
      {"attempts are due τ_I after the opening at the earliest",
       waits("InitialAttempt", is.initial())}};
  return clauses;
}

}  // namespace

bool has_free_certificate(const model::DdsProfile& dds) {
  return asks_early(dds) && model::traits_of(dds).waits_for_source &&
         !model::traits_of(dds).acknacks_have_bases &&
         dds.sedp.heartbeat_policy == model::HeartbeatPolicy::periodic &&
         dds.sedp.relation_opening == model::RelationOpening::receiver &&
         dds.sedp.initial_data == model::InitialData::push;
}

props::Finding free_certificate(const checker::CheckRequest& request, int more) {
  Proof proof{"storm.free-threshold.rules", request};
  const model::DdsProfile& dds = proof.scenario().dds;
  assume_in_time(proof);
  proof.assume("Nothing is lost, and both sides of a relation open at one instant.");
  proof.assume("0 < τ_I, and no packet takes longer than min(τ_A, τ_I).");
  const TimedDescriptor descriptor{dds, proof.mistakes(), {.loses = false}};
  const Moving moving{descriptor.whole()};
  Certificate certificate = certificate_in_time(descriptor, moving);
  const auto& t = descriptor.delays();
  give(certificate, "Δ ≤ τ_A", t.delta.expr() <= t.response.expr() + more);
  give(certificate, "0 < τ_I, Δ ≤ τ_I",
       descriptor.initial() >= 1 && t.delta.expr() <= descriptor.initial() + more);
  for (const Clause& clause : invariant_of_opening(descriptor)) {
    certificate.invariant.push_back({clause.words, moving(clause.holds)});
  }
  for (const Expr& variable : moving.system.variables) {
    const std::string name = variable.decl().name().str();
    if (name.starts_with("sent AckNack Listed")) {
      certificate.invariant.push_back({"never: " + name, !variable});
    } else if (name.starts_with("sent Data Carries IsRepair")) {
      certificate.conclusions.push_back({"never: " + name, !variable});
      certificate.invariant.push_back(certificate.conclusions.back());
    } else if (name.starts_with("sent ") || name.starts_with("in flight ")) {
      certificate.candidates.push_back(z3::implies(variable, moving(descriptor["WriterOpen"])));
    }
  }
  certificate.conclusions.push_back({"it is never requested", !moving(descriptor["C=R"])});
  for (SystemStep& step : certificate.system.steps) {
    if (step.name != timed::passing) continue;
    step.guard = step.guard && (moving(descriptor["Reader=Unknown"] || descriptor["WriterOpen"] ||
                                       descriptor["Reader=EarlyComplete"]));
  }
  prove(proof, certificate);
  return proof.finish(
      "invariant over the steps that are derived from the rules, with all timers and delays "
      "symbolic");
}

}  // namespace stormproof::tables
