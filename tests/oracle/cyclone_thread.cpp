// Timers, and the one thread of a participant that fires them, packs what they and the queue give,
// and sends it.
#include <algorithm>

#include "tests/oracle/cyclone_world.hpp"

namespace stormproof::oracle::cyclone {

namespace {

void schedule_run(World& w, Id i, Time at) {
  w.participants.at(i).run_scheduled = true;
  Event event;
  event.kind = EventKind::run;
  event.who = i;
  schedule(w, at, EventClass::protocol, event);
}

void wake(World& w, Id i) {
  const Participant& p = w.participants.at(i);
  if (!p.run_scheduled && !p.running) schedule_run(w, i, w.now);
}

bool is_user(const Message& m) { return m.kind != MessageKind::spdp && m.writer >= builtins; }

std::int64_t packet_bytes(const World& w, const std::vector<Message>& messages) {
  std::int64_t bytes = 20;
  if (!messages.front().to.set && !w.makes(Mistake::name_without_bytes)) bytes += 16;
  for (const Message& m : messages) bytes += m.bytes;
  return bytes;
}

bool same_address(const World& w, const Destination& a, const Destination& b) {
  if (a.set != b.set) return false;
  if (!a.set) return a.addresses == b.addresses;
  if (a.writer >= 0 && a.owner == b.owner && a.writer == b.writer &&
      (a.version == b.version || w.makes(Mistake::version_ignored))) {
    return true;
  }
  if (w.makes(Mistake::equal_sets_fit)) return a.addresses == b.addresses;
  return a.addresses.size() == 1 && a.addresses == b.addresses;
}

bool fits(const World& w, std::vector<Message> packet, const Message& m) {
  const bool same_port = is_user(packet.front()) == is_user(m);
  if (!same_port && !w.makes(Mistake::ports_ignored)) return false;
  if (!same_address(w, packet.front().to, m.to)) return false;
  packet.push_back(m);
  const bool repairs = std::any_of(packet.begin(), packet.end(),
                                   [](const Message& each) { return each.retransmission; });
  const auto limit = repairs && !w.makes(Mistake::repairs_fill_packets)
                         ? w.sedp.max_rexmit_message_size
                         : w.sedp.max_message_size;
  return packet_bytes(w, packet) <= limit.count();
}

void begin_to_send(World& w, Participant& p) {
  p.sending = std::move(p.open_packet);
  p.open_packet.clear();
  const std::vector<Id>& addresses = p.sending.front().to.addresses;
  p.left.assign(addresses.begin(), addresses.end());
  for (const Message& m : p.sending) {
    if (m.kind != MessageKind::data) continue;
    Writer& writer = w.writers.at({m.owner, m.writer});
    writer.sent = std::max(writer.sent, m.sample);
  }
}

void send_copy(World& w, Id i) {
  Participant& p = w.participants.at(i);
  Packet packet;
  packet.source = i;
  if (p.left.front() != group) packet.destination = p.left.front();
  p.left.pop_front();
  packet.payload = packet_bytes(w, p.sending);
  packet.messages = p.sending;
  emit(w, packet);
}

std::optional<Message> fire(World& w, std::size_t number) {
  Timer& timer = w.timers.at(number);
  timer.listed = false;
  timer.due = never;
  if (timer.kind == TimerKind::liveliness) say_liveliness(w, timer.owner, number);
  switch (timer.kind) {
    case TimerKind::announcement:
      return fire_announcement(w, timer, number);
    case TimerKind::reply:
      return fire_reply(w, number);
    case TimerKind::heartbeat:
      return fire_heartbeat(w, timer.owner, timer.writer);
    case TimerKind::liveliness:
      return {};
    case TimerKind::acknack:
      return fire_acknack(w, timer.peer, timer.writer, timer.owner);
  }
  return {};
}

// Whether there was something to do; it may have given a message.
bool next_task(World& w, Participant& p, std::optional<Message>& message) {
  if (!p.given.empty()) {
    message = p.given.front();
    p.given.pop_front();
    return true;
  }
  const bool queue_first = w.makes(Mistake::queue_before_timers) && !p.queue.empty();
  if (!p.due.empty() && !queue_first) {
    const std::size_t timer = p.due.front();
    p.due.pop_front();
    message = fire(w, timer);
    return true;
  }
  if (p.queue.empty()) return false;
  message = p.queue.front();
  p.queue.pop_front();
  return true;
}

void pack(World& w, Participant& p, const Message& message) {
  if (p.open_packet.empty() || fits(w, p.open_packet, message)) {
    p.open_packet.push_back(message);
    if (message.completes) begin_to_send(w, p);
    return;
  }
  p.held = message;
  begin_to_send(w, p);
}

}  // namespace

std::size_t new_timer(World& w, Timer timer) {
  w.timers.push_back(timer);
  return w.timers.size() - 1;
}

void move(World& w, std::size_t number, Time to) {
  Timer& timer = w.timers.at(number);
  if (to >= timer.due && !(w.makes(Mistake::timers_move_later) && !timer.listed)) return;
  timer.due = to;
  Event event;
  event.kind = EventKind::timer;
  event.who = timer.owner;
  event.timer = number;
  schedule(w, to, EventClass::protocol, event);
}

void timer_event(World& w, std::size_t number) {
  Timer& timer = w.timers.at(number);
  if (timer.listed || (timer.due != w.now && !w.makes(Mistake::stale_events_fire))) return;
  timer.listed = true;
  w.participants.at(timer.owner).due.push_back(number);
  wake(w, timer.owner);
}

void enqueue(World& w, Id i, Message message) {
  w.participants.at(i).queue.push_back(std::move(message));
  wake(w, i);
}

void run_thread(World& w, Id i) {
  Participant& p = w.participants.at(i);
  p.run_scheduled = false;
  p.running = true;
  const Time send_time = w.scenario.deployment.time_to_send().count();
  while (true) {
    if (!p.left.empty()) {
      send_copy(w, i);
      if (send_time == 0) continue;
      if (w.makes(Mistake::last_copy_takes_no_time) && p.left.empty()) continue;
      schedule_run(w, i, w.now + send_time);
      break;
    }
    if (p.held) {
      const bool completes = p.held->completes;
      p.open_packet.push_back(*p.held);
      p.held.reset();
      if (completes) {
        begin_to_send(w, p);
        continue;
      }
    }
    std::optional<Message> message;
    if (next_task(w, p, message)) {
      if (message) pack(w, p, *message);
    } else if (!p.open_packet.empty()) {
      begin_to_send(w, p);
    } else {
      break;
    }
  }
  p.running = false;
}

}  // namespace stormproof::oracle::cyclone
