// The response-aware HEARTBEAT policy, which takes the place of the periodic HEARTBEAT: cycles that
// widen while few readers answer and shrink as soon as all of them have. The cycles are those of
// the paper's model; which readers need a HEARTBEAT, and what answers it, is different here.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"
#include "tests/oracle/oracle_sizes.hpp"

namespace stormproof::oracle::fastdds {

namespace {

Time clamp_period(const World& w, Id i, Time period) {
  const model::AdaptiveProfile& a = sedp(w, i).adaptive;
  return std::clamp(period, a.min_period.count(), a.max_period.count());
}

std::int64_t divide_half_up(std::int64_t a, std::int64_t b) { return (2 * a + b) / (2 * b); }

// Whether j lacks an acknowledgment of something that i's writer has.
bool behind(World& w, Id i, Id j, int s) {
  const Relation& r = relation(w, i, j, s);
  const Id existing = writer(w, i, s).existing;
  if (existing > 0 && r.low == 0) return true;
  for (Id d = 0; d < existing; ++d) {
    if (r.state.at(d) != DescriptorState::acknowledged) return true;
  }
  return false;
}

std::set<Id> readers_behind(World& w, Id i, int s) {
  std::set<Id> result;
  for (const Id j : writer(w, i, s).readers) {
    if (behind(w, i, j, s)) result.insert(j);
  }
  return result;
}

// Schedules a cycle event that is valid until the writer's token changes.
void schedule_cycle(World& w, EventKind kind, Time at, Id i, int s) {
  Event event = make_event(kind, i, i, s);
  event.token = writer(w, i, s).token;
  schedule(w, at, EventClass::protocol, event);
}

void deactivate(World& w, Id i, Writer& wr) {
  wr.active = false;
  wr.period = sedp(w, i).heartbeat_period.count();
}

// T* of a cycle with period T, `expected` readers and `answered` responses.
Time next_period(const World& w, Id i, Time period, std::int64_t expected, std::int64_t answered) {
  const std::int64_t numerator = sedp(w, i).adaptive.epsilon_numerator;
  const std::int64_t denominator = sedp(w, i).adaptive.epsilon_denominator;
  // All of them have been forgotten since it began: the shortest period, and no shorter than T.
  if (expected == 0) return std::max(period, clamp_period(w, i, 0));
  Time next = 0;
  if (answered > 0 && denominator * answered >= numerator * expected) {
    next = clamp_period(w, i, divide_half_up(period * expected, answered));
  } else if (numerator > 0) {
    next = clamp_period(w, i, divide_half_up(period * denominator, numerator));
  } else {
    next = sedp(w, i).adaptive.max_period.count();
  }
  return std::max(next, period);
}

std::vector<std::vector<Id>> make_batches(const World& w, Id i, const Writer& wr) {
  const auto expected = static_cast<std::int64_t>(wr.cycle_readers.size());
  const auto answered = static_cast<std::int64_t>(wr.responded.size());
  const model::AdaptiveProfile& a = sedp(w, i).adaptive;
  const std::int64_t floor = ceil_div(expected * a.epsilon_numerator, a.epsilon_denominator);
  const auto size = static_cast<std::size_t>(std::max({std::int64_t{1}, answered, floor}));
  std::vector<std::vector<Id>> batches;
  for (const Id j : wr.cycle_readers) {
    if (wr.responded.contains(j)) continue;
    if (batches.empty() || batches.back().size() == size) batches.emplace_back();
    batches.back().push_back(j);
  }
  return batches;
}

}  // namespace

void activate_cycles(World& w, Id i, int s) {
  Writer& wr = writer(w, i, s);
  if (wr.active) return;
  wr.active = true;
  wr.period = sedp(w, i).heartbeat_period.count();
  schedule_cycle(w, EventKind::cycle_start, w.now + wr.period, i, s);
}

void cycle_start(World& w, Id i, int s, std::uint64_t token) {
  Writer& wr = writer(w, i, s);
  if (token != wr.token) return;
  ++wr.token;
  wr.cycle_readers = readers_behind(w, i, s);
  wr.cycle_existing = wr.existing;
  wr.responded.clear();
  if (wr.cycle_readers.empty()) {
    deactivate(w, i, wr);
    return;
  }
  wr.cycle_start = w.now;
  for (const Id j : wr.cycle_readers) heartbeat(w, i, j, s, heartbeat_payload);
  schedule_cycle(w, EventKind::cycle_end, w.now + wr.period, i, s);
}

void response(World& w, Id i, Id j, int s) {
  Writer& wr = writer(w, i, s);
  if (!wr.active || !wr.cycle_readers.contains(j)) return;
  if (wr.responded.contains(j)) return;
  wr.responded.insert(j);
  if (wr.responded.size() != wr.cycle_readers.size()) return;
  if (w.now >= wr.cycle_start + wr.period) return;
  ++wr.token;
  wr.period = clamp_period(w, i, w.now - wr.cycle_start);
  if (readers_behind(w, i, s).empty()) {
    deactivate(w, i, wr);
    return;
  }
  const Time at = std::max(w.now, wr.cycle_start + wr.period);
  schedule_cycle(w, EventKind::cycle_start, at, i, s);
}

void cycle_end(World& w, Id i, int s, std::uint64_t token) {
  Writer& wr = writer(w, i, s);
  if (token != wr.token) return;
  ++wr.token;
  const Time next = next_period(w, i, wr.period, static_cast<std::int64_t>(wr.cycle_readers.size()),
                                static_cast<std::int64_t>(wr.responded.size()));
  const Time extra = next - wr.period;
  wr.batches = make_batches(w, i, wr);  // those that are late by a cycle are gone
  const auto m = static_cast<std::int64_t>(wr.batches.size());
  for (std::int64_t k = 0; k < m; ++k) {
    schedule_cycle(w, EventKind::cycle_batch, w.now + extra * k / m, i, s);
  }
  schedule_cycle(w, EventKind::cycle_start, w.now + (extra == 0 ? 1 : extra), i, s);
  wr.period = next;
}

void cycle_batch(World& w, const Event& event) {
  const Id i = event.from;
  const int s = event.stream;
  Writer& wr = writer(w, i, s);
  if (event.token != wr.token || wr.batches.empty()) return;
  const std::vector<Id> readers = wr.batches.front();
  wr.batches.erase(wr.batches.begin());
  for (const Id j : readers) {
    if (behind(w, i, j, s)) heartbeat(w, i, j, s, heartbeat_payload);
  }
}

}  // namespace stormproof::oracle::fastdds
