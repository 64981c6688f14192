// The response-aware HEARTBEAT policy, which takes the place of the periodic HEARTBEAT: cycles that
// widen while few readers answer and shrink as soon as all of them have.
#include <algorithm>

#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

Time clamp_period(const World& w, Time period) {
  const model::AdaptiveProfile& adaptive = w.sedp.adaptive;
  return std::clamp(period, adaptive.min_period.count(), adaptive.max_period.count());
}

std::int64_t divide_half_up(std::int64_t a, std::int64_t b) { return (2 * a + b) / (2 * b); }

// Schedules a cycle event that is valid until the writer's token changes.
void schedule_cycle(World& w, EventKind kind, Time at, Id i, int s,
                    const std::vector<Id>& readers = {}) {
  Event event;
  event.kind = kind;
  event.from = i;
  event.to = i;
  event.stream = s;
  event.token = w.writers.at({i, s}).token;
  event.readers = readers;
  schedule(w, at, EventClass::protocol, event);
}

void deactivate(World& w, Writer& writer) {
  writer.active = false;
  writer.period = w.sedp.heartbeat_period.count();
}

// T* of a cycle with period T, `expected` readers and `answered` responses.
Time next_period(const World& w, Time period, std::int64_t expected, std::int64_t answered) {
  const std::int64_t numerator = w.sedp.adaptive.epsilon_numerator;
  const std::int64_t denominator = w.sedp.adaptive.epsilon_denominator;
  // All of them have been forgotten since it began: the shortest period, and no shorter than T.
  if (expected == 0) return std::max(period, clamp_period(w, 0));
  Time next = 0;
  if (answered > 0 && denominator * answered >= numerator * expected) {
    const bool down = w.makes(Mistake::stretch_rounded_down);
    const std::int64_t quotient =
        down ? period * expected / answered : divide_half_up(period * expected, answered);
    next = clamp_period(w, quotient);
  } else if (numerator > 0) {
    next = clamp_period(w, divide_half_up(period * denominator, numerator));
  } else {
    next = w.sedp.adaptive.max_period.count();
  }
  return std::max(next, period);
}

std::vector<std::vector<Id>> make_batches(const World& w, const Writer& writer) {
  const auto expected = static_cast<std::int64_t>(writer.cycle_readers.size());
  const auto answered = static_cast<std::int64_t>(writer.responded.size());
  const model::AdaptiveProfile& a = w.sedp.adaptive;
  const std::int64_t floor = ceil_div(expected * a.epsilon_numerator, a.epsilon_denominator);
  auto size = static_cast<std::size_t>(std::max({std::int64_t{1}, answered, floor}));
  if (w.makes(Mistake::batches_of_one)) size = 1;
  std::vector<std::vector<Id>> batches;
  for (const Id j : writer.cycle_readers) {
    if (writer.responded.contains(j)) continue;
    if (batches.empty() || batches.back().size() == size) batches.emplace_back();
    batches.back().push_back(j);
  }
  return batches;
}

}  // namespace

void activate_cycles(World& w, Id i, int s) {
  Writer& writer = w.writers.at({i, s});
  if (writer.active) return;
  writer.active = true;
  writer.period = w.sedp.heartbeat_period.count();
  schedule_cycle(w, EventKind::cycle_start, w.now + writer.period, i, s);
}

void cycle_start(World& w, Id i, int s, std::uint64_t token) {
  Writer& writer = w.writers.at({i, s});
  if (token != writer.token) return;
  ++writer.token;
  const std::vector<Id> readers = lacking_readers(w, i, s);
  writer.cycle_readers = {readers.begin(), readers.end()};
  writer.responded.clear();
  if (readers.empty()) {
    deactivate(w, writer);
    return;
  }
  writer.cycle_start = w.now;
  writer.cycle_announced = writer.written;
  for (const Id j : readers) generate_heartbeat(w, i, j, s);
  schedule_cycle(w, EventKind::cycle_end, w.now + writer.period, i, s);
}

void response(World& w, Id i, Id j, int s) {
  Writer& writer = w.writers.at({i, s});
  if (!writer.active || !writer.cycle_readers.contains(j)) return;
  if (writer.responded.contains(j) && !w.makes(Mistake::late_response_ends_cycle)) return;
  writer.responded.insert(j);
  if (writer.responded.size() != writer.cycle_readers.size()) return;
  const Time tolerance = w.makes(Mistake::early_end_at_the_end) ? 1 : 0;
  if (w.now >= writer.cycle_start + writer.period + tolerance) return;
  ++writer.token;
  writer.period = clamp_period(w, w.now - writer.cycle_start);
  if (lacking_readers(w, i, s).empty()) {
    deactivate(w, writer);
    return;
  }
  const Time at = std::max(w.now, writer.cycle_start + writer.period);
  schedule_cycle(w, EventKind::cycle_start, at, i, s);
}

void cycle_end(World& w, Id i, int s, std::uint64_t token) {
  Writer& writer = w.writers.at({i, s});
  if (token != writer.token) return;
  ++writer.token;
  const Time next =
      next_period(w, writer.period, static_cast<std::int64_t>(writer.cycle_readers.size()),
                  static_cast<std::int64_t>(writer.responded.size()));
  const Time extra = next - writer.period;
  const std::vector<std::vector<Id>> batches = make_batches(w, writer);
  const auto m = static_cast<std::int64_t>(batches.size());
  std::int64_t k = 0;
  for (const std::vector<Id>& batch : batches) {
    schedule_cycle(w, EventKind::cycle_batch, w.now + extra * k / m, i, s, batch);
    ++k;
  }
  schedule_cycle(w, EventKind::cycle_start, w.now + (extra == 0 ? 1 : extra), i, s);
  writer.period = next;
}

void cycle_batch(World& w, const Event& event) {
  if (event.token != w.writers.at({event.from, event.stream}).token) return;
  for (const Id j : event.readers) {
    if (!relation(w, event.from, j, event.stream).writer_open) continue;
    if (all_acknowledged(w, event.from, j, event.stream)) continue;
    generate_heartbeat(w, event.from, j, event.stream);
  }
}

}  // namespace stormproof::oracle
