// The writer: when it sends HEARTBEATs and to whom, and what it does with an ACKNACK.
#include <algorithm>

#include "tests/oracle/cyclone_world.hpp"

namespace stormproof::oracle::cyclone {

namespace {

constexpr std::int64_t timestamp_bytes = 12;
constexpr std::int64_t liveliness_bytes = 52;

Message heartbeat(World& w, Id i, int writer, const Destination& to) {
  Writer& state = w.writers.at({i, writer});
  Message m;
  m.kind = MessageKind::heartbeat;
  m.owner = i;
  m.writer = writer;
  m.to = to;
  m.bytes = 32;
  m.sample = state.history;
  m.first = state.first;
  m.count = ++state.count;
  return m;
}

Time interval(const World& w, const Writer& writer) {
  Time interval = w.sedp.heartbeat_interval.count();
  for (std::int64_t k = 7; k <= writer.n; k += 2) {
    if (2 * interval >= w.sedp.heartbeat_interval_max.count()) break;
    if (!w.makes(Mistake::interval_not_doubled)) interval *= 2;
  }
  return interval;
}

bool is_pending(const World& w, const Writer& writer) {
  return std::any_of(writer.readers.begin(), writer.readers.end(), [&](const auto& entry) {
    const Matched& r = entry.second;
    const bool silent = !r.replied && !w.makes(Mistake::replies_not_awaited);
    return silent || r.acked < writer.history;
  });
}

// Whom the next HEARTBEAT is for: the one who is behind, or all.
Destination addressees(const World& w, Id i, int number) {
  const Writer& writer = w.writers.at({i, number});
  Sample most = 0;
  for (const auto& [j, r] : writer.readers) most = std::max(most, r.acked);
  std::vector<Id> others;
  for (const auto& [j, r] : writer.readers) {
    const bool good = r.replied && r.acked == most && most > 0;
    if (!good) others.push_back(j);
  }
  const bool alone = writer.history == most || w.makes(Mistake::single_without_all);
  if (alone && others.size() == 1 && !w.makes(Mistake::heartbeats_to_all)) {
    return only(others.front());
  }
  return readers_of(w, i, number);
}

// In the answer's order: what is kept for another relation goes first.
void answer(World& w, Id i, int writer, Id j) {
  if (w.kept && w.kept->writer == writer && w.kept->to.addresses == only(j).addresses) return;
  if (!w.makes(Mistake::answers_replaced)) let_answer_go(w, i);
  Message m = heartbeat(w, i, writer, only(j));
  m.directed = !w.makes(Mistake::answers_undirected);
  w.kept = m;
  if (w.makes(Mistake::answers_at_once)) let_answer_go(w, i);
}

bool retransmit(World& w, Id i, int writer, Id j, Sample sample) {
  Participant& p = w.participants.at(i);
  std::uint32_t queued = 0;
  for (Message& m : p.queue) {
    if (m.kind != MessageKind::data || !m.retransmission) continue;
    ++queued;
    if (m.writer != writer || m.sample != sample) continue;
    const bool same = !m.to.set && m.to.addresses.front() == j;
    const bool merges = w.sedp.merge_queued_rexmit == model::MergeQueued::yes &&
                        !w.makes(Mistake::repairs_not_merged);
    if (!merges && !same) continue;
    const bool to_all = (!m.to.set && !same) || w.makes(Mistake::merges_with_itself);
    if (to_all) m.to = readers_of(w, i, writer);
    return true;
  }
  if (queued >= w.sedp.max_queued_rexmit_messages) return false;
  Message m = data_message(w, i, writer, sample);
  m.to = only(j);
  m.retransmission = true;
  enqueue(w, i, m);
  return true;
}

// One GAP; its list begins behind the first run of numbers.
Message gap_message(Id i, int writer, Id j, const std::set<Sample>& gone) {
  Message m;
  m.kind = MessageKind::gap;
  m.owner = i;
  m.writer = writer;
  m.to = only(j);
  m.bitmap = gone;
  Sample run_end = *gone.begin();
  while (gone.contains(run_end)) ++run_end;
  const Sample bits = *gone.rbegin() + 1 - run_end;
  m.bytes = 32 + (bits + 31) / 32 * 4;
  return m;
}

}  // namespace

Message heartbeat_to(World& w, Id i, int writer, const Destination& to) {
  return heartbeat(w, i, writer, to);
}

Destination only(Id j) {
  Destination to;
  to.addresses = {j};
  return to;
}

Destination readers_of(const World& w, Id i, int number) {
  const Writer& writer = w.writers.at({i, number});
  Destination to;
  to.set = true;
  to.owner = i;
  to.writer = number;
  to.version = writer.version;
  for (const auto& [j, r] : writer.readers) to.addresses.push_back(j);
  const std::size_t few = w.makes(Mistake::group_for_one) ? 0 : 1;
  if (w.multicast && to.addresses.size() > few) to.addresses = {group};
  return to;
}

Message data_message(const World& w, Id i, int writer, Sample sample) {
  (void)w;
  Message m;
  m.kind = MessageKind::data;
  m.owner = i;
  m.writer = writer;
  m.sample = sample;
  m.bytes = timestamp_bytes +
            (writer == liveliness ? liveliness_bytes : descriptor_bytes(writer, sample));
  return m;
}

void open_writer(World& w, Id i, int number, Id j) {
  Writer& writer = w.writers.at({i, number});
  if (writer.readers.contains(j)) return;
  Matched matched;
  if (!w.makes(Mistake::matched_without_history)) matched.acked = writer.history;
  writer.readers[j] = matched;
  ++writer.version;
  if (!w.makes(Mistake::match_keeps_n)) writer.n = 0;
  move(w, writer.timer, w.now + w.sedp.match_heartbeat_delay.count());
}

std::optional<Message> fire_heartbeat(World& w, Id i, int number) {
  Writer& writer = w.writers.at({i, number});
  if (!is_pending(w, writer)) return {};
  const Time before = interval(w, writer);
  if (w.now < writer.t_hb + before && !w.makes(Mistake::interval_not_kept)) {
    move(w, writer.timer, w.now + before);
    return {};
  }
  const Message m = heartbeat(w, i, number, addressees(w, i, number));
  writer.t_hb = w.now;
  ++writer.n;
  move(w, writer.timer, w.now + interval(w, writer));
  return m;
}

void let_answer_go(World& w, Id i) {
  if (!w.kept) return;
  const Message m = *w.kept;
  w.kept.reset();
  enqueue(w, i, m);
}

void receive_acknack(World& w, Id i, const Message& m, Id j) {
  Writer& writer = w.writers.at({i, m.writer});
  if (!writer.readers.contains(j)) return;
  Matched& r = writer.readers.at(j);
  const bool preemptive = m.base == 1 && m.count == 0;
  const bool old = m.count <= r.last_count && w.now < r.accepted + half_second;
  if (old && !preemptive && !w.makes(Mistake::old_acknacks_count)) return;
  r.last_count = m.count;
  r.accepted = w.now;
  const bool takes_back = m.base - 1 < r.acked && !w.makes(Mistake::replies_take_back);
  if (m.bitmap.empty() && !takes_back) r.replied = true;
  if (m.base - 1 > r.acked) r.acked = std::min(m.base - 1, writer.history);
  if (preemptive) {
    answer(w, i, m.writer, j);
    let_answer_go(w, i);
    return;
  }
  bool accepted = false;
  std::set<Sample> gone;
  for (const Sample sample : m.bitmap) {
    if (sample > writer.sent && !w.makes(Mistake::unsent_repaired)) break;
    if (sample > writer.history) break;
    if (sample < writer.first) {
      gone.insert(sample);
      accepted = true;
      continue;
    }
    if (retransmit(w, i, m.writer, j, sample)) {
      accepted = true;
    } else if (!w.makes(Mistake::refusals_ignored)) {
      break;
    }
  }
  if (!gone.empty()) enqueue(w, i, gap_message(i, m.writer, j, gone));
  if (!accepted) return;
  if (!w.makes(Mistake::repairs_not_answered)) answer(w, i, m.writer, j);
  if (!w.makes(Mistake::repairs_keep_n)) writer.n = 0;
  if (!w.makes(Mistake::repairs_leave_timer)) {
    move(w, writer.timer, w.now + w.sedp.heartbeat_interval.count());
  }
}

}  // namespace stormproof::oracle::cyclone
