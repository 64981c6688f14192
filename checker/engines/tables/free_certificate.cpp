// The invariant: until the DATA of the opening has arrived, by Δ after it, no ACKNACK that counts
// is generated, so none ever lists the descriptor. Without losses the ghost `limit` stays at the
// opening.
#include "checker/engines/tables/free_certificate.hpp"

#include <algorithm>
#include <limits>

#include "checker/engines/bounds/resting.hpp"
#include "checker/engines/tables/derived_time.hpp"
#include "checker/engines/tables/timed_certificate.hpp"
#include "model/engine/composition_knobs.hpp"

namespace stormproof::tables {
namespace {

constexpr const char* free_certificate_name = "storm.free-threshold.rules";

/// The writer takes an initial ACKNACK for one that asks.
bool counts_initial(const model::DdsProfile& dds) {
  return model::knob_value(fsm::composition::paper::InitialCountsAsAckNack{}, dds);
}
bool sends_initial(const model::DdsProfile& dds) {
  return dds.sedp.initial_acknack_delay > model::Nanoseconds{0};
}
/// An initial ACKNACK comes, and asks for what is missing.
bool asks_early(const model::DdsProfile& dds) { return counts_initial(dds) && sends_initial(dds); }

class FreeInvariant {
 public:
  FreeInvariant(const TimedDescriptor& descriptor, const model::DdsProfile& dds, bool exact)
      : is_{descriptor}, open_{is_["WriterOpen"]}, opening_{is_[timed::limit]} {
    const Expr delta = is_.delays().delta.expr();
    const Expr response = is_.delays().response.expr();
    say("what is open counts, from its opening on",
        is_[watched::counting] == open_ && z3::implies(open_, opening_ <= is_[timed::now]));
    say("until it is received, the DATA of the opening is on its way",
        z3::implies(open_ && !is_["X"], is_[timed::in_flight("Data")] &&
                                            is_[timed::arrives("Data")] == opening_ + delta));
    if (exact) {
      for (const char* packet : {"Data", "Heartbeat"}) {
        say(std::string{packet} + ": none arrives before Δ after the opening",
            z3::implies(is_[timed::sent(packet)],
                        open_ && is_[timed::first(packet)] >= opening_ + delta));
      }
    }
    say("replies are due τ_A after what they answer could be there at the earliest",
        z3::implies(is_["started AckNackGeneration"], open_) &&
            waits("AckNackGeneration", exact ? response + delta : response));
    say("it is in U or A", is_["C=U"] || is_["C=A"]);
    say("before the opening it is in U", open_ || is_["C=U"]);
    if (asks_early(dds)) {
      say("attempts are due τ_I after the opening at the earliest",
          waits("InitialAttempt", is_.initial()));
    }
    say("DATA with it is sent at the opening, and not again",
        is_[watched::data_sent] == open_ && !is_[watched::data_sent_again]);
  }

  std::vector<Clause> clauses;

 private:
  void say(std::string words, const Expr& holds) { clauses.push_back({std::move(words), holds}); }
  Expr waits(const char* timer, const Expr& delay) {
    const Expr from = z3::ite(open_, opening_, is_[timed::now]);
    return z3::implies(is_["started " + std::string{timer}],
                       is_[timed::earliest(timer)] >= from + delay);
  }

  const TimedDescriptor& is_;
  Expr open_;
  Expr opening_;
};

/// What is given besides: the threshold, in as far as there is one.
void give_threshold(Proof& proof, Certificate& certificate, const TimedDescriptor& descriptor,
                    bool exact, int more) {
  const model::DdsProfile& dds = proof.scenario().dds;
  const Expr delta = descriptor.delays().delta.expr();
  proof.assume("Nothing is lost.");
  if (exact) {
    proof.assume("Every packet takes the same time.");
  } else {
    proof.assume("No packet takes longer than τ_A.");
    give(certificate, "Δ ≤ τ_A", delta <= descriptor.delays().response.expr() + more);
  }
  if (asks_early(dds)) {
    proof.assume(
        "0 < τ_I, both sides of a relation open at one instant, and no packet takes "
        "longer than τ_I.");
    give(certificate, "0 < τ_I, Δ ≤ τ_I",
         descriptor.initial() >= 1 && delta <= descriptor.initial() + more);
  } else if (!sends_initial(dds)) {
    proof.assume("τ_I = 0: no reader asks by itself.");
    give(certificate, "τ_I = 0", descriptor.initial() == 0);
  }
}

props::Finding decided(const checker::CheckRequest& request, bool exact, int more) {
  Proof proof{free_certificate_name, request};
  const model::DdsProfile& dds = proof.scenario().dds;
  assume_in_time(proof);
  const TimedDescriptor descriptor{
      dds, proof.mistakes(), {.loses = false, .exact = exact, .counts_copies = true}};
  const Moving moving{descriptor.whole()};
  Certificate certificate = certificate_in_time(descriptor, moving);
  give_threshold(proof, certificate, descriptor, exact, more);
  for (const Clause& clause : FreeInvariant{descriptor, dds, exact}.clauses) {
    certificate.invariant.push_back({clause.words, moving(clause.holds)});
  }
  const Expr open = moving(descriptor["WriterOpen"]);
  for (const Expr& variable : moving.system.variables) {
    const std::string name = variable.decl().name().str();
    if (name.starts_with("sent AckNack Listed") &&
        (counts_initial(dds) || name.find("IsInitial") == std::string::npos)) {
      certificate.invariant.push_back({"never: " + name, !variable});
    } else if (name.starts_with("sent Data Carries IsRepair")) {
      certificate.conclusions.push_back({"never: " + name, !variable});
      certificate.invariant.push_back(certificate.conclusions.back());
    } else if (name.starts_with("sent ") || name.starts_with("in flight ")) {
      certificate.candidates.push_back(z3::implies(variable, open));
    }
    for (const char* packet : {"Data", "Heartbeat", "AckNack"}) {
      if (!exact || !name.starts_with("sent " + std::string{packet})) continue;
      certificate.candidates.push_back(
          z3::implies(variable, moving(descriptor[timed::sent(packet)])));
    }
  }
  certificate.conclusions.push_back({"it is never requested", !moving(descriptor["C=R"])});
  certificate.conclusions.push_back(
      {"it is sent once", !moving(descriptor[watched::data_sent_again])});
  for (SystemStep& step : certificate.system.steps) {
    if (!asks_early(dds) || step.name != timed::passing) continue;
    step.guard = step.guard && (moving(descriptor["Reader=Unknown"] || descriptor["WriterOpen"] ||
                                       descriptor["Reader=EarlyComplete"]));
  }
  return proved(
      proof, certificate,
      "invariant over the steps that are derived from the rules, with all timers and delays "
      "symbolic");
}

}  // namespace

std::optional<model::Nanoseconds> certified_free(const model::DdsProfile& dds,
                                                 bool constant_delay) {
  const model::SedpProfile& sedp = dds.sedp;
  if (!model::traits_of(dds).waits_for_source || model::traits_of(dds).acknacks_have_bases ||
      sedp.heartbeat_policy != model::HeartbeatPolicy::periodic ||
      sedp.initial_data != model::InitialData::push) {
    return std::nullopt;
  }
  const bool at_once = sedp.relation_opening == model::RelationOpening::receiver;
  if (!at_once && (asks_early(dds) || sedp.unmatched == model::Unmatched::drop)) {
    return std::nullopt;
  }
  model::Nanoseconds threshold{std::numeric_limits<std::int64_t>::max()};
  if (!constant_delay) threshold = sedp.heartbeat_response_delay;
  if (asks_early(dds)) threshold = std::min(threshold, sedp.initial_acknack_delay);
  return threshold;
}

props::Finding free_certificate(const checker::CheckRequest& request, bool constant_delay,
                                int beyond) {
  if (beyond != 0) return decided(request, constant_delay, beyond);
  return checker::known(request, free_certificate_name,
                        [&] { return decided(request, constant_delay, 0); });
}

}  // namespace stormproof::tables
