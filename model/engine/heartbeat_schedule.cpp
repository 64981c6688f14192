// Turns the outbox of the HEARTBEAT timer into events and messages.
#include "model/engine/heartbeat_schedule.hpp"

#include <algorithm>

namespace stormproof::model {

namespace timer = fsm::heartbeat_timer;

HeartbeatSchedule::HeartbeatSchedule(RunState& run, HeartbeatSender& sender)
    : run_{run},
      sender_{sender},
      sedp_{run.scenario.dds.sedp},
      adaptive_{run.scenario.dds.sedp.heartbeat_policy == HeartbeatPolicy::adaptive},
      timers_(2 * std::size_t{run.topology.participant_count()}) {}

HeartbeatSchedule::TimerDriver::Input HeartbeatSchedule::input(std::uint32_t w) const {
  const Timer& t = timers_[w];
  TimerDriver::Input input;
  input.now = run_.now.count();
  input.heartbeat_period = sedp_.heartbeat_period.count();
  input.adaptive = adaptive_;
  input.additive = sedp_.heartbeat_timer == HeartbeatTimerKind::additive;
  input.pending = t.pending;
  input.unacknowledged = sender_.needs_heartbeat(w);
  if (!adaptive_) return input;
  input.cycle.start = t.cycle.start.count();
  input.cycle.period = t.cycle.period.count();
  input.cycle.contacted = static_cast<std::int64_t>(t.cycle.contacted.size());
  input.cycle.responded = t.cycle.responded;
  input.cycle.min_period = sedp_.adaptive.min_period.count();
  input.cycle.max_period = sedp_.adaptive.max_period.count();
  input.cycle.epsilon_num = sedp_.adaptive.epsilon_numerator;
  input.cycle.epsilon_den = sedp_.adaptive.epsilon_denominator;
  return input;
}

template <class TimerEvent>
void HeartbeatSchedule::step(std::uint32_t w, std::size_t responding) {
  const auto output = driver_.step<TimerEvent>(run_, timers_[w].state, input(w), w);
  if (adaptive_)
    apply_adaptive(w, output, responding);
  else
    apply_periodic(w, output);
}

template void HeartbeatSchedule::step<timer::ArmRequested>(std::uint32_t, std::size_t);
template void HeartbeatSchedule::step<timer::SuppressionEnded>(std::uint32_t, std::size_t);

void HeartbeatSchedule::apply_periodic(std::uint32_t w, const TimerDriver::Output& output) {
  if (output.send) sender_.send_periodic(w);
  if (output.schedule_expiry) {
    ++timers_[w].pending;
    run_.schedule(Nanoseconds{output.next_at}, EventKind::heartbeat_expiry, w);
  }
}

void HeartbeatSchedule::apply_adaptive(std::uint32_t w, const TimerDriver::Output& output,
                                       std::size_t responding) {
  Cycle& cycle = timers_[w].cycle;
  if (output.count_response) {
    cycle.has_responded[responding] = true;
    ++cycle.responded;
  }
  if (output.invalidate) ++cycle.token;
  if (output.send) contact(w);
  if (output.pace) plan_batches(w, Nanoseconds{output.period});
  if (output.period > 0) cycle.period = Nanoseconds{output.period};
  const Nanoseconds next{output.next_at};
  if (output.schedule_cycle) run_.schedule(next, EventKind::cycle_start, w, cycle.token);
  if (output.schedule_end) run_.schedule(next, EventKind::cycle_end, w, cycle.token);
  if (output.send_batch) send_batch(cycle);
}

/// A cycle starts: its set U is every reader that has not acknowledged everything.
void HeartbeatSchedule::contact(std::uint32_t w) {
  Cycle& cycle = timers_[w].cycle;
  cycle.start = run_.now;
  cycle.responded = 0;
  cycle.announced = sender_.announced(w);
  cycle.contacted = sender_.unacknowledged(w);
  cycle.has_responded.assign(cycle.contacted.size(), false);
  for (const std::uint32_t relation : cycle.contacted) sender_.send_heartbeat(relation);
}

/// A cycle ends with silent readers: they are asked again in batches spread over the rest of the
/// period.
void HeartbeatSchedule::plan_batches(std::uint32_t w, Nanoseconds stretched) {
  Cycle& cycle = timers_[w].cycle;
  cycle.batches.clear();
  cycle.next_batch = 0;
  const auto size = static_cast<std::size_t>(fsm::batch_size<fsm::Plain>(input(w).cycle));
  for (std::size_t k = 0; k < cycle.contacted.size(); ++k) {
    if (cycle.has_responded[k]) continue;
    if (cycle.batches.empty() || cycle.batches.back().size() == size) cycle.batches.emplace_back();
    cycle.batches.back().push_back(cycle.contacted[k]);
  }
  const std::int64_t rest = (stretched - cycle.period).count();
  const auto count = static_cast<std::int64_t>(cycle.batches.size());
  for (std::int64_t k = 0; k < count; ++k) {
    run_.schedule(run_.now + Nanoseconds{rest * k / count}, EventKind::batch_due, w, cycle.token);
  }
}

void HeartbeatSchedule::send_batch(Cycle& cycle) {
  if (cycle.next_batch == cycle.batches.size()) return;  // the event was scheduled twice
  for (const std::uint32_t relation : cycle.batches[cycle.next_batch++]) {
    if (sender_.is_unacknowledged(relation)) sender_.send_heartbeat(relation);
  }
}

void HeartbeatSchedule::handle(const Event& event) {
  const std::uint32_t w = event.subject;
  if (event.kind == EventKind::heartbeat_expiry) {
    if (timers_[w].pending > 0) --timers_[w].pending;  // 0: the event was scheduled twice
    step<timer::Expired>(w);
    return;
  }
  Cycle& cycle = timers_[w].cycle;
  if (event.detail != cycle.token) return;  // void: a later cycle event replaced it
  switch (event.kind) {
    case EventKind::cycle_start:
      cycle.contacted.clear();  // responses to the last cycle end to count here
      cycle.has_responded.clear();
      step<timer::CycleStarted>(w);
      break;
    case EventKind::cycle_end:
      step<timer::CycleEnded>(w);
      break;
    default:
      step<timer::BatchDue>(w);
      break;
  }
}

void HeartbeatSchedule::response(std::uint32_t w, std::uint32_t relation, std::uint32_t base) {
  if (!adaptive_) return;
  const Cycle& cycle = timers_[w].cycle;
  const auto found = std::lower_bound(cycle.contacted.begin(), cycle.contacted.end(), relation);
  if (found == cycle.contacted.end() || *found != relation || base < cycle.announced) return;
  const auto reader = static_cast<std::size_t>(found - cycle.contacted.begin());
  if (!cycle.has_responded[reader]) step<timer::ResponseReceived>(w, reader);
}

}  // namespace stormproof::model
