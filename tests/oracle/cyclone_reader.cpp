// The reader: which HEARTBEATs it hears, and when it asks for what.
#include <algorithm>

#include "tests/oracle/cyclone_world.hpp"

namespace stormproof::oracle::cyclone {

namespace {

constexpr Time preemptive_interval = 1'000'000'000;

enum class Verdict { nothing, ack, hush, nack };

Sample lowest_missing(const Reader& r) {
  Sample b = 1;
  while (r.received.contains(b)) ++b;
  return b;
}

struct Judgement {
  Verdict verdict = Verdict::nothing;
  bool delayed = false;
};

Judgement judge(const World& w, const Reader& r) {
  const Sample b = lowest_missing(r);
  const bool nack_delay_over = w.now >= r.t_nack + w.sedp.nack_delay.count();
  Verdict verdict = Verdict::hush;
  if (b > r.last) {
    verdict = Verdict::ack;
  } else if (b >= r.end && !w.makes(Mistake::new_gaps_wait)) {
    return {Verdict::nack, false};
  } else if (r.directed && (!r.by_delay || nack_delay_over) &&
             !w.makes(Mistake::answers_are_heartbeats)) {
    return {Verdict::nack, false};
  } else if (nack_delay_over || w.makes(Mistake::nack_delay_ignored)) {
    return {Verdict::nack, !w.makes(Mistake::never_delayed)};
  }
  const bool ack_delay_over = w.now >= r.t_ack + w.sedp.ack_delay.count();
  const bool new_to_say = b > r.base || ack_delay_over || w.makes(Mistake::ack_delay_ignored);
  if (r.since && r.wanted && new_to_say) return {verdict, false};
  return {};
}

Message acknack(Reader& r, Id i, int writer, Id j) {
  Message m;
  m.kind = MessageKind::acknack;
  m.owner = i;
  m.writer = writer;
  m.to = only(i);
  m.base = lowest_missing(r);
  m.count = r.next_count++;
  m.bytes = 28;
  (void)j;
  return m;
}

void request(const World& w, Reader& r, Message& m, bool delayed) {
  for (Sample k = m.base; k <= r.last; ++k) {
    if (!r.received.contains(k)) m.bitmap.insert(k);
  }
  const Sample bits = r.last + 1 - m.base;
  m.bytes += w.makes(Mistake::bitmap_words_down) ? bits / 32 * 4 : (bits + 31) / 32 * 4;
  r.by_delay = delayed;
  r.end = r.last + 1;
  r.t_nack = w.now;
}

Message preemptive(World& w, Reader& r, Id i, int writer) {
  Message m;
  m.kind = MessageKind::acknack;
  m.owner = i;
  m.writer = writer;
  m.to = only(i);
  m.base = 1;
  m.bytes = 28;
  r.t_ack = w.now;
  Time again = preemptive_interval;
  const Time age = w.now - r.opened;
  if (w.lives && age >= 10 * preemptive_interval) {
    again *= age < 60 * preemptive_interval ? 2 : age < 120 * preemptive_interval ? 5 : 10;
  }
  if (!w.makes(Mistake::asks_once)) move(w, r.timer, w.now + again);
  return m;
}

}  // namespace

void open_reader(World& w, Id i, int writer, Id j) {
  Reader& r = w.readers.at({i, writer, j});
  if (r.open) return;
  r.open = true;
  r.opened = w.now;
  move(w, r.timer, w.now + w.sedp.preemptive_ack_delay.count());
}

void receive_gap(World& w, Id j, const Message& m) {
  Reader& r = w.readers.at({m.owner, m.writer, j});
  if (r.open) r.received.insert(m.bitmap.begin(), m.bitmap.end());
}

void receive_heartbeat(World& w, Id j, const Message& m) {
  Reader& r = w.readers.at({m.owner, m.writer, j});
  if (!r.open) return;
  if (!r.seen || w.makes(Mistake::each_heartbeat_is_first)) r.first_heard = m.sample;
  r.seen = true;
  for (Sample k = 1; k < m.first; ++k) r.received.insert(k);
  r.last = std::max(r.last, m.sample);
  const bool old = m.count <= r.last_count && w.now < r.accepted + half_second;
  if (old && !w.makes(Mistake::old_heartbeats_count)) return;
  r.last_count = m.count;
  r.accepted = w.now;
  r.since = true;
  r.wanted = true;
  if (m.directed) r.directed = true;
  const Judgement judgement = judge(w, r);
  if (judgement.verdict == Verdict::nothing) return;
  const bool hush = judgement.verdict == Verdict::hush && !w.makes(Mistake::hush_answers_at_once);
  move(w, r.timer, hush ? r.t_nack + w.sedp.nack_delay.count() : w.now);
}

std::optional<Message> fire_acknack(World& w, Id i, int writer, Id j) {
  Reader& r = w.readers.at({i, writer, j});
  if (!r.seen) return preemptive(w, r, i, writer);
  const Judgement judgement = judge(w, r);
  if (judgement.verdict == Verdict::nothing) return {};
  const Time again = r.t_nack + w.sedp.auto_resched_nack_delay.count();
  if (!r.since && w.now < again) {
    move(w, r.timer, again);
    return {};
  }
  r.directed = r.since = r.wanted = false;
  Message m = acknack(r, i, writer, j);
  r.base = m.base;
  r.t_ack = w.now;
  if (judgement.verdict == Verdict::nack) {
    request(w, r, m, judgement.delayed);
    if (!w.makes(Mistake::never_asks_again)) {
      move(w, r.timer, w.now + w.sedp.auto_resched_nack_delay.count());
    }
  } else if (judgement.verdict == Verdict::hush) {
    move(w, r.timer, r.t_nack + w.sedp.nack_delay.count());
  }
  return m;
}

}  // namespace stormproof::oracle::cyclone
