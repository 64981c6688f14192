// The HEARTBEAT clock of `amendments.heartbeat_policy: measured_ack`: an expiry asks all readers
// that lack something and goes on as long as there are such; the period doubles as long as somebody
// who was asked is silent, and is 1.1 times what they took as soon as all have answered, which ends
// it.
#include <algorithm>

#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

constexpr Time ms = 1'000'000;

bool is_awaited(const Writer& writer, Id j) {
  return writer.cycle_readers.contains(j) && !writer.responded.contains(j);
}

bool someone_is_awaited(const Writer& writer) {
  return std::any_of(writer.cycle_readers.begin(), writer.cycle_readers.end(),
                     [&](Id j) { return is_awaited(writer, j); });
}

void schedule_measured_expiry(World& w, Id i, int s) {
  Writer& writer = w.writers.at({i, s});
  writer.active = true;
  Event event;
  event.kind = EventKind::heartbeat_expiry;
  event.from = i;
  event.to = i;
  event.stream = s;
  event.token = writer.token;
  schedule(w, w.now + writer.period, EventClass::protocol, event);
}

void ask(World& w, Id i, int s) {
  Writer& writer = w.writers.at({i, s});
  const std::vector<Id> readers = lacking_readers(w, i, s);
  writer.active = false;
  writer.cycle_readers = {readers.begin(), readers.end()};
  writer.responded.clear();
  writer.cycle_start = w.now;
  for (const Id j : readers) generate_heartbeat(w, i, j, s);
  if (!readers.empty()) schedule_measured_expiry(w, i, s);
}

}  // namespace

bool measures(const World& w) {
  const auto& rules = w.scenario.dds.amendments;
  return rules && rules->heartbeat_policy == model::AmendedPolicy::measured_ack;
}

void begin_measuring(World& w, Id i, int s) {
  Writer& writer = w.writers.at({i, s});
  if (writer.active && !w.makes(Mistake::measuring_begins_anew)) return;
  writer.period = w.sedp.heartbeat_period.count();
  schedule_measured_expiry(w, i, s);
}

void measured_expiry(World& w, Id i, int s, std::uint64_t token) {
  Writer& writer = w.writers.at({i, s});
  if (token != writer.token) return;
  if (someone_is_awaited(writer) && !w.makes(Mistake::silence_not_doubled)) {
    writer.period = std::clamp(2 * writer.period, 10 * ms, 10'000 * ms);
  }
  ask(w, i, s);
}

void answered(World& w, Id i, Id j, int s) {
  Writer& writer = w.writers.at({i, s});
  if (!is_awaited(writer, j)) return;
  writer.responded.insert(j);
  if (someone_is_awaited(writer) && !w.makes(Mistake::first_answer_ends)) return;
  const Time shortest = w.makes(Mistake::measured_without_bound) ? 0 : 10 * ms;
  writer.period = std::clamp((w.now - writer.cycle_start) * 11 / 10, shortest, 10'000 * ms);
  if (!w.makes(Mistake::answered_expiry_stays)) ++writer.token;
  ask(w, i, s);
}

}  // namespace stormproof::oracle
