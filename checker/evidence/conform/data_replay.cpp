// Runs the writer's rules through a plan.
#include "checker/evidence/conform/data_replay.hpp"

#include <algorithm>

#include "checker/evidence/conform/relay_host.hpp"
#include "checker/evidence/conform/writer_host.hpp"

namespace stormproof::conform {

namespace change = fsm::change_for_reader;

namespace {

std::unique_ptr<ReplayedWriter> host_of(bool is_relay, const model::DdsProfile& dds,
                                        std::uint32_t count, Machines& machines) {
  if (is_relay) return std::make_unique<WriterHost<FromRelay>>(dds, count, machines);
  return std::make_unique<WriterHost<FromParticipant>>(dds, count, machines);
}

}  // namespace

DataReplay::DataReplay(const WriterContext& context, const Relation& relation,
                       const std::vector<Transmission>& transmissions, std::uint32_t existing,
                       Ledger& ledger)
    : context_{context},
      relation_{relation},
      transmissions_{transmissions},
      existing_{existing},
      ledger_{ledger},
      count_{std::max(descriptors_of(context.dialogue, relation.place), existing)},
      host_{host_of(kind_of(context.dialogue, relation.place) == RelationKind::relay, context.dds,
                    count_, ledger.machines)} {}

const Answer* DataReplay::run(const Plan& plan, std::int64_t lag) {
  std::vector<Step> steps;
  std::int64_t in_order = INT64_MIN;
  for (std::size_t k = 0; k < plan.arrivals.size(); ++k) {
    in_order = std::max(in_order, plan.arrivals[k].from_ns);
    steps.push_back({in_order, false, k});
  }
  for (std::size_t k = 0; k < transmissions_.size(); ++k) {
    std::int64_t serialized = transmissions_[k].time_ns - lag;
    if (const auto request = plan.request[k]) {
      serialized = std::max(serialized, steps[*request].time_ns);
    }
    steps.push_back({serialized, true, k});
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const Step& a, const Step& b) { return a.time_ns < b.time_ns; });

  host_->open(existing_);
  for (const Step& step : steps) {
    host_->end_suppression(step.time_ns);
    if (step.is_transmission) {
      transmit(step, plan.to_everybody[step.index]);
    } else if (!arrive(step, plan.arrivals[step.index])) {
      return &relation_.answers[step.index];
    }
  }
  return nullptr;
}

bool DataReplay::arrive(const Step& step, const Arrival& arrival) {
  const Answer& answer = relation_.answers[step.index];
  if (!arrival.is_used && is_unanswered(answer, step.time_ns)) {
    const std::int64_t served = arrival.to_ns + context_.dds.sedp.nack_response_delay.count() +
                                context_.bounds.most_lateness_ns + context_.bounds.most_send_lag_ns;
    const bool still_under_way = served >= context_.dialogue.end_ns;
    if (!still_under_way && !context_.bounds.may_lose) return false;
    ledger_.hidden(still_under_way ? Hidden::Kind::still_under_way : Hidden::Kind::lost,
                   answer.time_ns, answer.event);
    return true;
  }
  ledger_.hidden(Hidden::Kind::received, step.time_ns, answer.event);
  host_->receive(answer, step.time_ns);
  return true;
}

bool DataReplay::is_unanswered(const Answer& answer, std::int64_t now) const {
  if (!host_->answers_all()) return false;
  constexpr fsm::StateId u = fsm::Reflect<fsm::ChangeForReader>::id<change::U>;
  return std::any_of(answer.missing.begin(), answer.missing.end(), [&](std::uint32_t d) {
    if (d >= count_ || host_->state_of(d) != u) return false;
    return std::none_of(transmissions_.begin(), transmissions_.end(), [&](const Transmission& one) {
      return one.descriptor == d && one.time_ns >= now;
    });
  });
}

void DataReplay::transmit(const Step& step, bool to_everybody) {
  if (to_everybody) {
    ledger_.explained(Rule::data_to_everybody);  // the machines of this reader do not notice
    return;
  }
  // What was requested joins the queue no later than anything is sent.
  host_->respond(step.time_ns);
  const Transmission& one = transmissions_[step.index];
  const bool is_sent = one.is_pushed ? host_->create(one.descriptor, step.time_ns)
                                     : host_->serve(one.descriptor, step.time_ns);
  if (!is_sent) {
    ledger_.not_replayed();
    return;
  }
  const DataRules by = host_->explained_by();
  ledger_.explained(!one.is_first ? by.again : one.is_pushed ? by.pushed : by.first);
}

}  // namespace stormproof::conform
