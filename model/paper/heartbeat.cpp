// The HEARTBEAT timer of a writer. What happens when is decided by the machine in fsm/heartbeat_timer.hpp; here
// is what its outbox asks for, and the lists of readers that the adaptive policy keeps: whom a cycle contacted,
// who has responded, and the batches in which the silent ones are asked again.
#include <algorithm>

#include "model/paper/protocol.hpp"

namespace stormproof::model::paper {

namespace timer = fsm::heartbeat_timer;

Driver<fsm::HeartbeatTimer>::Input Protocol::timer_input(const Writer& writer) const {
  Driver<fsm::HeartbeatTimer>::Input input;
  input.now = run_.now.count();
  input.heartbeat_period = sedp_.heartbeat_period.count();
  input.adaptive = sedp_.heartbeat_policy == HeartbeatPolicy::adaptive;
  input.additive = sedp_.heartbeat_timer == HeartbeatTimerKind::additive;
  input.pending = writer.pending_expiries;
  input.unacknowledged = writer.unacknowledged > 0;
  if (writer.cycle != nullptr) {
    input.cycle.start = writer.cycle->start.count();
    input.cycle.period = writer.cycle->period.count();
    input.cycle.contacted = static_cast<std::int64_t>(writer.cycle->contacted.size());
    input.cycle.responded = writer.cycle->responded;
    input.cycle.min_period = sedp_.adaptive.min_period.count();
    input.cycle.max_period = sedp_.adaptive.max_period.count();
    input.cycle.epsilon_num = sedp_.adaptive.epsilon_numerator;
    input.cycle.epsilon_den = sedp_.adaptive.epsilon_denominator;
  }
  return input;
}

template <class TimerEvent>
void Protocol::step_timer(std::uint32_t w, std::uint32_t responding_reader) {
  Writer& writer = writers_[w];
  const TimerOutput output =
      timer_driver_.step<TimerEvent>(run_, writer.timer, timer_input(writer), w);
  if (sedp_.heartbeat_policy == HeartbeatPolicy::periodic) {
    apply_periodic(w, output);
  } else {
    apply_adaptive(w, output, responding_reader);
  }
}

template void Protocol::step_timer<timer::RelationOpened>(std::uint32_t, std::uint32_t);
template void Protocol::step_timer<timer::SuppressionEnded>(std::uint32_t, std::uint32_t);
template void Protocol::step_timer<timer::Expired>(std::uint32_t, std::uint32_t);

void Protocol::apply_periodic(std::uint32_t w, const TimerOutput& output) {
  if (output.send) {
    if (sedp_.heartbeat_recipients == HeartbeatRecipients::matched) generate_heartbeat_to_open(w);
    else generate_heartbeat_to_unacknowledged(w);
  }
  if (output.schedule_expiry) {
    ++writers_[w].pending_expiries;
    run_.schedule(Nanoseconds{output.next_at}, EventKind::heartbeat_expiry, w);
  }
}

void Protocol::apply_adaptive(std::uint32_t w, const TimerOutput& output,
                              std::uint32_t responding_reader) {
  Writer& writer = writers_[w];
  if (writer.cycle == nullptr) writer.cycle = std::make_unique<Cycle>();
  Cycle& cycle = *writer.cycle;
  if (output.count_response) {
    cycle.has_responded[responding_reader] = true;
    ++cycle.responded;
  }
  if (output.invalidate) ++cycle.token;
  if (output.send) contact(w);
  if (output.pace) plan_batches(w, Nanoseconds{output.period});
  if (output.period > 0) cycle.period = Nanoseconds{output.period};
  const Nanoseconds next{output.next_at};
  if (output.schedule_cycle) run_.schedule(next, EventKind::cycle_start, w, cycle.token);
  if (output.schedule_end) run_.schedule(next, EventKind::cycle_end, w, cycle.token);
  if (output.send_batch) send_batch(w);
}

/// A cycle starts: its set U is every open relation with something not in A.
void Protocol::contact(std::uint32_t w) {
  Cycle& cycle = *writers_[w].cycle;
  cycle.start = run_.now;
  cycle.responded = 0;
  for_each_unacknowledged(w, [&](std::uint32_t relation) { cycle.contacted.push_back(relation); });
  cycle.has_responded.assign(cycle.contacted.size(), false);
  generate_heartbeat_to_unacknowledged(w);
}

/// A cycle ends with silent readers: they are asked again in batches spread over the rest of the period.
void Protocol::plan_batches(std::uint32_t w, Nanoseconds stretched) {
  Cycle& cycle = *writers_[w].cycle;
  cycle.batches.clear();
  cycle.next_batch = 0;
  const auto input = timer_input(writers_[w]);
  const auto size = static_cast<std::size_t>(fsm::batch_size<fsm::Plain>(input.cycle));
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

void Protocol::send_batch(std::uint32_t w) {
  Cycle& cycle = *writers_[w].cycle;
  for (const std::uint32_t relation : cycle.batches[cycle.next_batch++]) {
    if (relations_[relation].unacknowledged > 0) generate_heartbeat(relation);
  }
}

void Protocol::cycle_event(const Event& event) {
  const std::uint32_t w = event.subject;
  Cycle& cycle = *writers_[w].cycle;
  if (event.detail != cycle.token) return;  // void: a later cycle event replaced it
  switch (event.kind) {
    case EventKind::cycle_start:
      cycle.contacted.clear();  // responses to the last cycle end to count here
      cycle.has_responded.clear();
      step_timer<timer::CycleStarted>(w);
      break;
    case EventKind::cycle_end: step_timer<timer::CycleEnded>(w); break;
    default: step_timer<timer::BatchDue>(w); break;
  }
}

/// A clean ACKNACK of this relation's reader: it counts once for the cycle that contacted the reader.
void Protocol::response(std::uint32_t relation) {
  const std::uint32_t w = writer_of(relation);
  const Cycle* cycle = writers_[w].cycle.get();
  if (cycle == nullptr) return;
  const auto found =
      std::lower_bound(cycle->contacted.begin(), cycle->contacted.end(), relation);
  if (found == cycle->contacted.end() || *found != relation) return;
  const auto reader = static_cast<std::uint32_t>(found - cycle->contacted.begin());
  if (!cycle->has_responded[reader]) step_timer<timer::ResponseReceived>(w, reader);
}

}  // namespace stormproof::model::paper
