// The writers of the Discovery Server: one for announcements, one for publications, one for
// subscriptions. Everything that they send goes to one reader at a time, with a HEARTBEAT for all
// that there is.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

// By version, with a HEARTBEAT.
constexpr std::int64_t own_announcement_payloads[] = {428, 688, 684};
constexpr std::int64_t passed_announcement_payloads[] = {356, 616, 620};
constexpr std::int64_t riding_heartbeat = 32;
constexpr std::int64_t around_descriptor = 36 + 12 + 32;  // header, timestamp, HEARTBEAT
constexpr std::int64_t gap_payload = 72;
constexpr std::int64_t gap_with_heartbeat_payload = 100;

model::Nanoseconds heartbeat_period(const World& w, int stream) {
  return stream == participants_stream ? w.scenario.dds.server.pdp_heartbeat_period
                                       : w.sedp.heartbeat_period;
}
model::Nanoseconds response_delay(const World& w, int stream) {
  return stream == participants_stream ? w.scenario.dds.server.pdp_nack_response_delay
                                       : w.sedp.nack_response_delay;
}
model::Nanoseconds suppression(const World& w, int stream) {
  return stream == participants_stream ? w.scenario.dds.server.pdp_nack_suppression_duration
                                       : w.sedp.nack_suppression_duration;
}

void arm(World& w, int stream) {
  Relay& relay = w.server->relays[stream];
  if (relay.expiry_pending) return;
  relay.expiry_pending = true;
  schedule_after(w, heartbeat_period(w, stream),
                 make_event(EventKind::relay_expiry, w.server_id(), w.server_id(), stream));
}

void start_sending(World& w) {
  if (w.server->sending) return;
  w.server->sending = true;
  schedule(w, w.now, EventClass::protocol,
           make_event(EventKind::sending, w.server_id(), w.server_id(), 0));
}

Packet relayed(World& w, int stream, Id j, std::int64_t payload) {
  Packet packet;
  packet.kind = PacketKind::relayed;
  packet.source = w.server_id();
  packet.destination = j;
  packet.stream = stream;
  packet.payload = payload;
  return packet;
}

void add_heartbeat(World& w, Packet& packet) {
  const Relay& relay = w.server->relays[packet.stream];
  packet.has_heartbeat = true;
  packet.first = relay.first();
  packet.last = w.makes(ServerMistake::what_left_is_announced) ? relay.next - 1 : relay.last();
  if (!cross_host(w, packet.source, *packet.destination)) return;
  ++(packet.stream == participants_stream ? w.outcome.pdp_heartbeat : w.outcome.heartbeat);
}

void heartbeat_to(World& w, int stream, Id j) {
  Packet packet = relayed(w, stream, j, heartbeat_payload);
  add_heartbeat(w, packet);
  emit(w, packet);
}

void gap_to(World& w, int stream, Id j, const std::set<std::int64_t>& numbers, bool heartbeat) {
  Packet packet = relayed(w, stream, j, heartbeat ? gap_with_heartbeat_payload : gap_payload);
  packet.numbers = numbers;
  if (cross_host(w, packet.source, j)) ++w.outcome.gap;
  if (heartbeat) add_heartbeat(w, packet);
  emit(w, packet);
}

std::int64_t payload_of(const World& w, const Item& item) {
  if (item.stream != participants_stream) {
    return around_descriptor + submessage_bytes(w, item.participant, item.stream, item.descriptor);
  }
  const auto version = static_cast<std::size_t>(w.scenario.dds.version.sizes);
  return item.participant == w.server_id() ? own_announcement_payloads[version]
                                           : passed_announcement_payloads[version];
}

void count_data(World& w, const Item& item, Id j) {
  if (!cross_host(w, w.server_id(), j)) return;
  if (item.stream == participants_stream) {
    ++w.outcome.pdp_data;
    return;
  }
  Server& teller = w.makes(ServerMistake::told_by_any) ? w.servers.begin()->second : *w.server;
  const bool first = teller.told.insert({item, j}).second;
  ++(first ? w.outcome.initial_data : w.outcome.repair_data);
}

std::int64_t number_of(const Relay& relay, const Item& item) {
  std::int64_t number = 0;
  for (const auto& [k, one] : relay.history) {
    if (one == item) number = k;
  }
  return number;
}

// The GAP before a number that is sent to j for the first time. Returns whether there is one.
bool gap_before(World& w, int stream, Id j, std::int64_t number) {
  Relay& relay = w.server->relays[stream];
  RelayReader& about = relay.about.at(j);
  if (!about.sent.insert(number).second && !w.makes(ServerMistake::gap_each_time)) return false;
  const auto place = about.list.find(number);
  const bool none_before = place == about.list.begin() || w.makes(ServerMistake::gap_from_low);
  const std::int64_t before = none_before ? about.low : std::prev(place)->first;
  std::set<std::int64_t> gap;
  for (std::int64_t k = std::max(before + 1, relay.first()); k < number; ++k) gap.insert(k);
  if (gap.empty()) return false;
  gap_to(w, stream, j, gap, true);
  return true;
}

// Whether the thread is busy for what goes to j.
bool costs(const World& w, Id j) {
  return cross_host(w, w.server_id(), j) || !w.makes(ServerMistake::only_other_hosts_cost);
}

// Returns how many packets it sends.
std::int64_t deliver(World& w, int stream, const Item& item) {
  Relay& relay = w.server->relays[stream];
  const std::int64_t number = number_of(relay, item);
  std::vector<Id> wanting;
  for (const Id j : relay.readers) {
    const auto& list = relay.about.at(j).list;
    const auto found = list.find(number);
    if (found != list.end() && found->second == DescriptorState::queued) wanting.push_back(j);
  }
  if (wanting.empty()) return 0;
  std::int64_t packets = 0;
  for (const Id j : wanting) {
    const bool gap = gap_before(w, stream, j, number);
    if (gap && costs(w, j) && !w.makes(ServerMistake::gaps_cost_nothing)) ++packets;
  }
  for (const Id j : wanting) {
    RelayReader& about = relay.about.at(j);
    about.list[number] = DescriptorState::suppressed;
    if (!about.suppression_pending) {
      about.suppression_pending = true;
      schedule_after(w, suppression(w, stream),
                     make_event(EventKind::relay_suppression_end, w.server_id(), j, stream));
    }
    Packet packet = relayed(w, stream, j, payload_of(w, item));
    packet.item = item;
    packet.item_number = number;
    count_data(w, item, j);
    add_heartbeat(w, packet);
    emit(w, packet);
    if (costs(w, j)) ++packets;
  }
  if (!w.makes(ServerMistake::deliveries_do_not_arm)) arm(w, stream);
  return packets;
}

bool is_in(const std::deque<std::pair<int, Item>>& queue, const std::pair<int, Item>& entry) {
  return std::find(queue.begin(), queue.end(), entry) != queue.end();
}

}  // namespace

void open_relay(World& w, int stream, Id j) {
  Relay& relay = w.server->relays[stream];
  relay.readers.push_back(j);
  RelayReader& about = relay.about[j];
  about.low = w.makes(ServerMistake::low_is_zero_at_opening) ? 0 : relay.first() - 1;
  for (const auto& [number, item] : relay.history) {
    if (is_relevant(w, item, j)) about.list[number] = DescriptorState::unsent;
  }
  if (!relay.history.empty()) arm(w, stream);
  heartbeat_to(w, stream, j);
}

// To a client that knows only where the server is: at once, beside what the relay sends it.
void send_own_announcement(World& w, Id j) {
  const Item own{w.server_id(), participants_stream, 0};
  Packet packet = relayed(w, participants_stream, j, payload_of(w, own) - riding_heartbeat);
  packet.item = own;
  packet.item_number = number_of(w.server->relays[participants_stream], own);
  count_data(w, own, j);
  if (w.makes(ServerMistake::answers_with_heartbeat)) add_heartbeat(w, packet);
  emit(w, packet);
}

void remove(World& w, int stream, const Item& item) {
  Relay& relay = w.server->relays[stream];
  std::erase_if(relay.history, [&](const auto& one) {
    if (one.second != item) return false;
    for (auto& [j, about] : relay.about) about.list.erase(one.first);
    return true;
  });
  const std::pair<int, Item> entry{stream, item};
  std::erase(w.server->fresh, entry);
  std::erase(w.server->stale, entry);
}

void insert(World& w, int stream, const Item& item) {
  const auto& history = w.server->relays[stream].history;
  const bool is_old = std::any_of(history.begin(), history.end(),
                                  [&](const auto& one) { return one.second == item; });
  if (is_old && w.makes(ServerMistake::old_changes_stay)) return;
  remove(w, stream, item);
  Relay& relay = w.server->relays[stream];
  const std::int64_t number = relay.next++;
  relay.history[number] = item;
  bool wanted = false;
  for (const Id j : relay.readers) {
    if (!is_relevant(w, item, j)) continue;
    relay.about.at(j).list[number] = DescriptorState::queued;
    wanted = true;
  }
  if (wanted) {
    w.server->fresh.emplace_back(stream, item);
    start_sending(w);
  } else if (!relay.readers.empty()) {
    arm(w, stream);
  }
}

void send_next(World& w) {
  Server& server = *w.server;
  server.sending = false;
  while (!server.fresh.empty() || !server.stale.empty()) {
    const bool old_first = w.makes(ServerMistake::repairs_first) && !server.stale.empty();
    auto& queue = server.fresh.empty() || old_first ? server.stale : server.fresh;
    const auto [stream, item] = queue.front();
    queue.pop_front();
    const std::int64_t packets = deliver(w, stream, item);
    if (packets == 0) continue;
    server.sending = true;
    const std::int64_t busy = packets * w.scenario.deployment.cost_to_send().count();
    schedule(w, w.now + busy, EventClass::protocol,
             make_event(EventKind::sending, w.server_id(), w.server_id(), 0));
    return;
  }
}

void relay_expiry(World& w, int stream) {
  Relay& relay = w.server->relays[stream];
  relay.expiry_pending = false;
  bool some = false;
  for (const Id j : relay.readers) {
    const RelayReader& about = relay.about.at(j);
    bool lacks = std::any_of(about.list.begin(), about.list.end(),
                             [](const auto& one) { return one.second == DescriptorState::unsent; });
    const bool like_others = w.makes(ServerMistake::empty_history_lacks);
    const std::int64_t wanted =
        relay.history.empty() && !like_others ? relay.next - 1 : relay.first();
    lacks = lacks || (about.low < wanted && !w.makes(ServerMistake::low_does_not_lack));
    if (!lacks && !w.makes(ServerMistake::expiries_to_all)) continue;
    heartbeat_to(w, stream, j);
    some = true;
  }
  if (some) arm(w, stream);
}

void relay_response(World& w, int stream) {
  Relay& relay = w.server->relays[stream];
  Server& server = *w.server;
  relay.response_pending = false;
  for (const Id j : relay.readers) {
    for (auto& [number, state] : relay.about.at(j).list) {
      if (state != DescriptorState::requested) continue;
      state = DescriptorState::queued;
      const std::pair<int, Item> entry{stream, relay.history.at(number)};
      if (!is_in(server.fresh, entry) && !is_in(server.stale, entry)) server.stale.push_back(entry);
    }
  }
  if (!server.fresh.empty() || !server.stale.empty()) start_sending(w);
}

void relay_suppression_end(World& w, int stream, Id j) {
  RelayReader& about = w.server->relays[stream].about.at(j);
  about.suppression_pending = false;
  for (auto& [number, state] : about.list) {
    if (state == DescriptorState::suppressed) state = DescriptorState::unsent;
  }
  arm(w, stream);
}

void receive_learning_acknack(World& w, const Packet& packet) {
  const int stream = packet.stream;
  const Id j = packet.source;
  Relay& relay = w.server->relays[stream];
  if (!relay.about.contains(j)) return;
  if (packet.initial) {
    heartbeat_to(w, stream, j);
    arm(w, stream);
    return;
  }
  RelayReader& about = relay.about.at(j);
  about.low = std::max(about.low, packet.number_base - 1);
  about.list.erase(about.list.begin(), about.list.lower_bound(packet.number_base));
  bool requested = false;
  for (const std::int64_t number : packet.numbers) {
    const auto found = about.list.find(number);
    if (found == about.list.end() || found->second != DescriptorState::unsent) continue;
    found->second = DescriptorState::requested;
    requested = true;
  }
  if (requested && !relay.response_pending) {
    relay.response_pending = true;
    schedule_after(w, response_delay(w, stream),
                   make_event(EventKind::relay_response, w.server_id(), w.server_id(), stream));
  } else if (!requested && !packet.numbers.empty() && !w.makes(ServerMistake::requests_never_arm)) {
    arm(w, stream);
  }
  std::set<std::int64_t> gap;
  bool some = false;
  for (const std::int64_t number : packet.numbers) {
    const bool gone = number < relay.first() && !w.makes(ServerMistake::gone_is_irrelevant);
    if (gone || about.list.contains(number)) continue;
    gap.insert(number);
    some = some || number > about.low || w.makes(ServerMistake::acknowledged_is_irrelevant);
  }
  if (some) gap_to(w, stream, j, gap, false);
}

}  // namespace stormproof::oracle::fastdds
