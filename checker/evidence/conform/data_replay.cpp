// Steps the descriptors' machines through a plan.
#include "checker/evidence/conform/data_replay.hpp"

#include <algorithm>

namespace stormproof::conform {

namespace change = fsm::change_for_reader;
namespace shot = fsm::single_shot;

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

  open();
  for (const Step& step : steps) {
    end_suppression(step.time_ns);
    if (step.is_transmission) {
      transmit(step, plan.to_everybody[step.index]);
    } else if (!arrive(step, plan.arrivals[step.index])) {
      return &relation_.answers[step.index];
    }
  }
  return nullptr;
}

void DataReplay::open() {
  states_.assign(std::max<std::size_t>(known(), existing_),
                 Tally<fsm::ChangeForReader>::Fly::initial);
  for (std::uint32_t d = 0; d < existing_; ++d) {
    changes_.step<change::ReaderMatched>(states_[d], {});
  }
}

std::size_t DataReplay::known() const {
  return context_.dialogue
      .descriptors[2 * relation_.place.source + stream_index(relation_.place.writer)];
}

bool DataReplay::arrive(const Step& step, const Arrival& arrival) {
  const Answer& answer = relation_.answers[step.index];
  if (!arrival.is_used && is_unanswered(answer, step.time_ns)) {
    const std::int64_t served = arrival.to_ns + context_.sedp.nack_response_delay.count() +
                                context_.bounds.most_lateness_ns + context_.bounds.most_send_lag_ns;
    const bool still_under_way = served >= context_.dialogue.end_ns;
    if (!still_under_way && !context_.bounds.may_lose) return false;
    ledger_.hidden(still_under_way ? Hidden::Kind::still_under_way : Hidden::Kind::lost,
                   answer.time_ns, answer.event);
    return true;
  }
  ledger_.hidden(Hidden::Kind::received, step.time_ns, answer.event);
  if (answer.is_initial) {
    for (fsm::StateId& state : states_) {
      changes_.step<change::InitialAckNackReceived>(state, {});
    }
    return true;
  }
  bool requested = false;
  for (std::uint32_t d = 0; d < states_.size(); ++d) {
    const bool listed = answer.asks_for(d);
    if (!listed && d >= answer.base) continue;
    requested |= changes_
                     .step<change::AckNackReceived>(
                         states_[d], {.listed = listed, .below_base = d < answer.base})
                     .requested;
  }
  if (requested) {
    timers_.step<shot::Requested>(
        response_, {.now = step.time_ns, .delay = context_.sedp.nack_response_delay.count()});
  }
  return true;
}

bool DataReplay::is_unanswered(const Answer& answer, std::int64_t now) const {
  constexpr fsm::StateId u = fsm::Reflect<fsm::ChangeForReader>::id<change::U>;
  return std::any_of(answer.missing.begin(), answer.missing.end(), [&](std::uint32_t d) {
    if (d >= states_.size() || states_[d] != u) return false;
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
  const Transmission& one = transmissions_[step.index];
  fsm::StateId& state = states_[one.descriptor];
  if (one.is_pushed) changes_.step<change::Created>(state, {});
  if (timers_.step<shot::Due>(response_, {.now = step.time_ns}).fire) {
    for (fsm::StateId& other : states_) changes_.step<change::NackResponseDue>(other, {});
  }
  constexpr fsm::StateId s = fsm::Reflect<fsm::ChangeForReader>::id<change::S>;
  changes_.step<change::Serialized>(state, {});
  if (state != s) {
    ledger_.not_replayed();
  } else {
    ledger_.explained(one.is_pushed  ? Rule::data_push
                      : one.is_first ? Rule::data_pull
                                     : Rule::data_repair);
  }
  const auto timer = timers_.step<shot::Requested>(
      suppression_,
      {.now = step.time_ns, .delay = context_.sedp.nack_suppression_duration.count()});
  if (timer.schedule) suppressed_until_ns_ = timer.next_at;
}

void DataReplay::end_suppression(std::int64_t now) {
  if (now < suppressed_until_ns_) return;
  if (!timers_.step<shot::Due>(suppression_, {.now = now}).fire) return;
  for (fsm::StateId& state : states_) changes_.step<change::SuppressionEnded>(state, {});
}

}  // namespace stormproof::conform
