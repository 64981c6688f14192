// The lemmas, applied to profiles. specs/guide/cannot-start.md has their proofs.
#include "checker/engines/calculus/threshold.hpp"

#include <algorithm>

#include "checker/engines/timeline/free_threshold.hpp"
#include "checker/engines/timeline/needless_repair.hpp"
#include "model/implementations.hpp"
#include "props/monitors/delay_meter.hpp"

namespace stormproof::calculus {

namespace {

using model::Nanoseconds;

Threshold none(std::string why) {
  Threshold threshold;
  threshold.why = std::move(why);
  return threshold;
}

Threshold of_the_paper(const model::Scenario& scenario, const OpenLoop* traffic) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  const bool equal = props::takes_equal_times(scenario.wireless);
  if (sedp.relation_opening == model::RelationOpening::each_side) {
    return none("a side that opens alone drops DATA, or asks before the other side has opened");
  }
  const timeline::FreeThreshold any = timeline::free_threshold(sedp, equal);
  if (!any.exists) return none("readers pull, and one packet's suppression ends another's");
  Threshold threshold;
  threshold.lemma = equal ? Lemma::constant_delay : Lemma::any_order;
  threshold.unlimited = any.unlimited;
  threshold.delta = any.delta;
  threshold.formula = any.formula;
  threshold.why = equal ? "every packet takes the same time"
                        : "a reader that waits so long has the DATA when it answers";
  const bool shared = scenario.wireless.kind == model::ServiceKind::shared_channel;
  if (!shared || traffic == nullptr || traffic->exhaustions > 0 ||
      !pushes_keep_order(scenario.wireless, traffic)) {
    return threshold;
  }
  threshold.lemma = Lemma::in_order;
  threshold.unlimited = !timeline::asks_by_itself(sedp);
  threshold.delta = sedp.initial_acknack_delay;
  threshold.formula = threshold.unlimited ? "unlimited" : "τ_I";
  threshold.why = "no HEARTBEAT overtakes DATA on this channel, so only initial ACKNACKs could ask";
  return threshold;
}

Threshold of_the_stateful(const model::Scenario& scenario, const OpenLoop* traffic) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  if (scenario.dds.spdp.resend == model::SpdpResend::none) {
    return none("a reader that has not heard of the writer yet drops what is pushed");
  }
  if (!pushes_keep_order(scenario.wireless, traffic)) {
    return none("a HEARTBEAT can overtake DATA that is pushed, and an ACKNACK can be due already");
  }
  Threshold patient;
  patient.lemma = Lemma::patient_reader;
  const Nanoseconds twice = sedp.heartbeat_response_delay - sedp.nack_response_delay;
  patient.delta = Nanoseconds{std::max<std::int64_t>(0, twice.count() / 2)};
  patient.formula = "(τ_A − τ_N)/2";
  patient.why = "a second ACKNACK comes after the DATA that the first one asked for";
  const Nanoseconds covered{(sedp.nack_suppression_duration.count() + 1) / 2};
  if (is_created_at_once(scenario.deployment) && covered > patient.delta) {
    patient.lemma = Lemma::long_suppression;
    patient.delta = covered;
    patient.formula = "(τ_S + 1 ns)/2";
    patient.why =
        "suppression ends after every ACKNACK that can still ask; all endpoints exist "
        "at the start";
  }
  if (patient.delta > Nanoseconds{0}) return patient;
  return none("its shared timers let one late packet cause a needless repair");
}

}  // namespace

bool pushes_keep_order(const model::WirelessProfile& wireless, const OpenLoop* traffic) {
  if (wireless.kind == model::ServiceKind::constant_delay) {
    return props::takes_equal_times(wireless);
  }
  if (wireless.loss || model::queues_drop(wireless)) return false;
  if (wireless.service == model::ServedBy::unit) {
    return wireless.queueing == model::Queueing::fifo;
  }
  return wireless.fragment_request == model::FragmentRequest::at_admission ||
         (traffic != nullptr && traffic->push_fragments <= 1);
}

bool is_created_at_once(const model::Deployment& deployment) {
  const auto& schedule = deployment.schedule;
  if (schedule && schedule->endpoints_done_max > schedule->start_min) return false;
  return std::ranges::all_of(deployment.participants, [](const model::Participant& participant) {
    return participant.endpoints_done == participant.start;
  });
}

Threshold threshold_of(const model::Scenario& scenario, const OpenLoop* traffic) {
  switch (model::traits_of(scenario.dds).writer) {
    case model::Writer::of_the_paper:
      return of_the_paper(scenario, traffic);
    case model::Writer::of_cyclone:
    case model::Writer::of_server:
      return none("no lemma is about its writer");
    case model::Writer::stateful:
      break;
  }
  return of_the_stateful(scenario, traffic);
}

}  // namespace stormproof::calculus
