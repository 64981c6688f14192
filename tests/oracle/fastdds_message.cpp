// DATA on its way out: the creation of a descriptor, which pushes it to all readers at once, the
// asynchronous run, which serves what was requested, and the message both of them fill. The storm
// is made here, by the HEARTBEATs to all readers that ride along when the budget is used up.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

constexpr std::int64_t message_header = 20;
constexpr std::int64_t destination_bytes = 16;
constexpr std::int64_t timestamp_bytes = 12;
constexpr std::int64_t heartbeat_bytes = 32;

/// One creation or one asynchronous run of participant i.
struct Sending {
  Id i = 0;
  bool async = false;
  std::optional<Message> open;
};

void open_message(const World& w, Sending& sending, int s, const std::vector<Id>& destinations) {
  Message message;
  message.stream = s;
  message.destinations = destinations;
  message.bytes = message_header;
  const bool to_one = destinations.size() == 1 && !w.makes(Mistake::no_destination_bytes);
  if (to_one) message.bytes += destination_bytes;
  sending.open = message;
}

void flush(World& w, Sending& sending) {
  if (!sending.open.has_value()) return;
  const Message message = *sending.open;
  sending.open.reset();
  const bool is_empty = message.descriptors.empty() && message.samples.empty();
  if (is_empty && !message.announced.has_value()) return;
  std::int64_t sent = message.bytes;
  if (!w.makes(Mistake::statistics_uncharged)) {
    sent += profile(w, sending.i).version.statistics_bytes.count();
  }
  if (w.makes(Mistake::charge_per_packet)) sent *= std::int64_t(message.destinations.size());
  if (sending.async) {
    Participant& p = w.participants.at(sending.i);
    p.sent_bytes += sent;
    p.group_bytes += sent;
    const std::int64_t threshold = sedp(w, sending.i).piggyback_threshold_bytes.count();
    if (p.group_bytes > threshold) {
      p.group_bytes -= w.makes(Mistake::group_starts_anew) ? p.group_bytes : threshold;
      ++p.group_number;
    }
  }
  for (const Id j : message.destinations) {
    Packet packet;
    packet.kind = PacketKind::sedp;
    packet.source = sending.i;
    packet.destination = j;
    packet.payload = message.bytes;
    packet.stream = message.stream;
    packet.descriptors = message.descriptors;
    packet.announced = message.announced;
    packet.heartbeats = message.heartbeats;
    const auto count = [j](const std::map<Id, Id>& by_destination) {
      const auto found = by_destination.find(j);
      return found == by_destination.end() ? Id{0} : found->second;
    };
    if (is_lookup(message.stream)) {
      packet.kind = message.samples.empty() ? PacketKind::control_heartbeat : PacketKind::lookup;
      packet.topic = message.stream;
      packet.samples = message.samples;
      packet.sample_count = message.announced.value_or(0);
    }
    packet.initial_data = count(message.initial_data);
    packet.repair_data = count(message.repair_data);
    emit(w, packet);
  }
}

bool joins(const World& w, Id i, const Message& message, int s, Id d,
           const std::vector<Id>& destinations) {
  if (message.stream != s || message.destinations != destinations) return false;
  const std::vector<Id>& carried = message.descriptors;
  if (std::find(carried.begin(), carried.end(), d) != carried.end()) return false;
  return message.bytes + timestamp_bytes + submessage_bytes(w, i, s, d) <=
         sedp(w, i).grouping_limit_bytes.count();
}

void count_data(World& w, Message& message, Id i, Id j, int s, Id d) {
  Relation& r = relation(w, i, j, s);
  if (cross_host(w, i, j)) {
    if (r.delivered.at(d)) {
      ++w.outcome.repair_data;
      ++message.repair_data[j];
    } else {
      ++w.outcome.initial_data;
      ++message.initial_data[j];
    }
  }
  r.delivered.at(d) = true;
}

void suppress(World& w, Id i, Id j, int s, Id d) {
  Relation& r = relation(w, i, j, s);
  r.state.at(d) = DescriptorState::suppressed;
  if (!r.suppression_pending || w.makes(Mistake::suppression_per_descriptor)) {
    r.suppression_pending = true;
    schedule_after(w, sedp(w, i).nack_suppression_duration,
                   make_event(EventKind::suppression_end, i, j, s));
  }
}

// What the DATA just added to the open message takes from the writer's budget.
std::int64_t charge(const World& w, const Sending& sending, std::int64_t submessage) {
  const std::int64_t alone = message_header + timestamp_bytes + submessage;
  switch (sedp(w, sending.i).piggyback) {
    case model::Piggyback::cumulative:
      if (!sending.async && !w.makes(Mistake::sync_charges_message)) return alone;
      return w.participants.at(sending.i).sent_bytes +
             (sending.open.has_value() ? sending.open->bytes : 0);
    case model::Piggyback::linear:
      return alone;
    case model::Piggyback::off:
    case model::Piggyback::group:
      return 0;
  }
  return 0;
}

// Whether a HEARTBEAT has to ride with the DATA just added.
bool rides(World& w, const Sending& sending, int s, std::int64_t submessage) {
  Writer& wr = writer(w, sending.i, s);
  if (sedp(w, sending.i).piggyback == model::Piggyback::group) {
    const bool in_group = sending.async || w.makes(Mistake::group_of_creations);
    const std::int64_t number = in_group ? w.participants.at(sending.i).group_number : 0;
    if (number == wr.group_number) return false;
    if (!w.makes(Mistake::group_goes_on)) wr.group_number = number;
    return true;
  }
  if (sedp(w, sending.i).piggyback == model::Piggyback::off) return false;
  wr.budget -= charge(w, sending, submessage);
  return wr.budget < 0;
}

void piggyback(World& w, Sending& sending, int s) {
  Writer& wr = writer(w, sending.i, s);
  const bool ride = w.makes(Mistake::piggyback_rides_along);
  if (!sending.open.has_value()) {
    open_message(w, sending, s, wr.readers);
  } else if (sending.open->destinations != wr.readers && !ride) {
    flush(w, sending);
    open_message(w, sending, s, wr.readers);
    ++w.outcome.replaced_messages;
  }
  sending.open->bytes += heartbeat_bytes;
  sending.open->announced = wr.existing;
  ++sending.open->heartbeats;
  for (const Id j : wr.readers) {
    if (!cross_host(w, sending.i, j)) continue;
    ++(is_lookup(s) ? w.outcome.user_control : w.outcome.heartbeat);
  }
  wr.budget = sedp(w, sending.i).piggyback_threshold_bytes.count();
  ++w.outcome.piggybacks;
}

// Sends a message that takes no more DATA, then charges the one that was added last.
void charge_added(World& w, Sending& sending, int s, std::int64_t submessage) {
  const Id most = profile(w, sending.i).version.max_data_per_message;
  const std::size_t data = sending.open->descriptors.size() + sending.open->samples.size();
  const bool is_full = most > 0 && data >= most;
  if (is_full && !w.makes(Mistake::full_message_charged)) flush(w, sending);
  if (rides(w, sending, s, submessage)) piggyback(w, sending, s);
  if (is_full && w.makes(Mistake::full_message_charged)) flush(w, sending);
}

void deliver(World& w, Sending& sending, int s, Id d, const std::vector<Id>& destinations) {
  if (sending.open.has_value() && !joins(w, sending.i, *sending.open, s, d, destinations))
    flush(w, sending);
  if (!sending.open.has_value()) open_message(w, sending, s, destinations);
  sending.open->descriptors.push_back(d);
  sending.open->bytes += timestamp_bytes + submessage_bytes(w, sending.i, s, d);
  for (const Id j : destinations) {
    suppress(w, sending.i, j, s, d);
    count_data(w, *sending.open, sending.i, j, s, d);
  }
  arm(w, sending.i, s);
  charge_added(w, sending, s, submessage_bytes(w, sending.i, s, d));
}

/// A sample goes to all readers, though one is meant; unless it is filtered.
void deliver(World& w, Sending& sending, Sample sample) {
  const int topic = sample.is_question ? questions : answers;
  Writer& wr = writer(w, sending.i, topic);
  const std::int64_t bytes = timestamp_bytes + sample_bytes(w, sample);
  std::vector<Id> destinations = wr.readers;
  using enum model::LookupFilter;
  const model::LookupFilter filter = profile(w, sending.i).version.typelookup_filter;
  const bool filters_questions = filter == all || w.makes(Mistake::questions_filtered);
  const bool to_one = filter != none && (filters_questions || !sample.is_question);
  if (to_one || w.makes(Mistake::samples_to_addressee)) destinations = {sample.to};
  const std::optional<Message>& open = sending.open;
  if (open && (open->stream != topic || open->destinations != destinations ||
               open->bytes + bytes > sedp(w, sending.i).grouping_limit_bytes.count())) {
    flush(w, sending);
  }
  if (!sending.open) open_message(w, sending, topic, destinations);
  sample.number = ++wr.existing;
  sending.open->samples.push_back(sample);
  sending.open->bytes += bytes;
  for (const Id j : destinations) {
    w.outcome.lookup += cross_host(w, sending.i, j) ? 1 : 0;
    control(w, sending.i, j, topic).told = sample.number;
  }
  if (!w.makes(Mistake::samples_do_not_arm)) arm_lookups(w, sending.i, topic);
  charge_added(w, sending, topic, sample_bytes(w, sample));
}

/// The first one of the queue, to those who wait for it.
void serve_descriptor(World& w, Sending& sending) {
  std::deque<std::pair<int, Id>>& queue = w.participants.at(sending.i).async_queue;
  const auto [s, d] = queue.front();
  queue.pop_front();
  std::vector<Id> waiting;
  for (const Id j : writer(w, sending.i, s).readers) {
    if (relation(w, sending.i, j, s).state.at(d) == DescriptorState::queued) waiting.push_back(j);
  }
  if (!waiting.empty()) deliver(w, sending, s, d, waiting);
}

}  // namespace

void create(World& w, Id i, int s, Id d) {
  Writer& wr = writer(w, i, s);
  wr.existing = d + 1;
  if (!wr.readers.empty() && !w.makes(Mistake::creation_not_pushed)) {
    for (const Id j : wr.readers) relation(w, i, j, s).state.at(d) = DescriptorState::queued;
    Sending sending;
    sending.i = i;
    deliver(w, sending, s, d, wr.readers);
    flush(w, sending);
  }
  created(w, i, s, d);
}

void async_run(World& w, Id i) {
  Participant& p = w.participants.at(i);
  p.run_pending = false;
  Sending sending;
  sending.i = i;
  sending.async = true;
  sending.open = p.unfinished;
  p.unfinished.reset();
  while (!p.async_queue.empty() || !p.samples.empty()) {
    const bool of_samples = !p.samples.empty() && (p.async_queue.empty() ||
                                                   !w.makes(Mistake::descriptors_before_samples));
    if (of_samples) {
      const Sample sample = p.samples.front();
      p.samples.pop_front();
      deliver(w, sending, sample);
    } else {
      serve_descriptor(w, sending);
    }
    const bool is_left =
        !p.async_queue.empty() || !p.samples.empty() || w.makes(WifiMistake::stop_before_the_last);
    if (!stalls(w, i) || !is_left || w.makes(WifiMistake::runs_never_stop)) continue;
    if (w.makes(WifiMistake::stop_flushes)) flush(w, sending);
    p.unfinished = sending.open;
    p.run_pending = !w.makes(WifiMistake::stopped_run_not_pending);
    ++w.insertions;  // the rest is scheduled again
    p.held.push_back(make_event(EventKind::async_run, i, i, 0));
    return;
  }
  flush(w, sending);
}

}  // namespace stormproof::oracle::fastdds
