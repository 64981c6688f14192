// The server's writers at work: what the routine has noted and lists, what the sending thread makes
// of it, and what ACKNACKs do to it. Everything goes to one reader at a time, with a HEARTBEAT that
// announces all that there is.
#include <algorithm>
#include <memory>
#include <utility>

#include "model/fastdds/server_protocol.hpp"

namespace stormproof::model::fastdds {

namespace {

constexpr std::int64_t own_announcement_bytes = 428;
constexpr std::int64_t announcement_bytes = 356;
constexpr std::int64_t gap_bytes = 72;
constexpr std::int64_t gap_with_heartbeat_bytes = 100;

namespace change = fsm::change_for_reader;

bool is_in(const RelayWriter::Entry& entry, fsm::StateId state) { return entry.state == state; }
template <class State>
constexpr fsm::StateId id = fsm::Reflect<fsm::ChangeForReader>::id<State>;

}  // namespace

void ServerProtocol::list_relevant(Number relation) {
  RelayWriter& writer = relays_[relation % relay::count];
  for (const auto& [number, item] : writer.history) {
    if (!database_.relevant(item, client_of(relation / relay::count))) continue;
    step<change::ReaderMatched>(about(relation).list[number], relation);
  }
}

void ServerProtocol::take_acknack(Number relation, const Relayed& acknack) {
  RelayWriter::Reader& reader = about(relation);
  reader.low = std::max(reader.low, acknack.base - 1);
  const auto above = reader.list.lower_bound(acknack.base);
  for (auto entry = reader.list.begin(); entry != above; ++entry) {
    step<change::AckNackReceived>(entry->second, relation, false, true);
  }
  reader.list.erase(reader.list.begin(), above);
  const std::int64_t first = relays_[relation % relay::count].first();
  some_requested_ = false;
  some_irrelevant_ = false;
  irrelevant_.clear();
  for (const std::int64_t number : acknack.numbers) {
    const auto entry = reader.list.find(number);
    if (entry != reader.list.end()) {
      some_requested_ |= step<change::AckNackReceived>(entry->second, relation, true).requested;
    } else if (number >= first) {
      irrelevant_.push_back(number);
      some_irrelevant_ |= number > reader.low;
    }
  }
}

void ServerProtocol::queue_again(Number relay) {
  RelayWriter& writer = relays_[relay];
  for (const Number relation : writer.readers) {
    for (auto& [number, entry] : about(relation).list) {
      if (!step<change::NackResponseDue>(entry, relation).enqueue) continue;
      queues_.add_again({relay, writer.history.at(number)});
    }
  }
}

void ServerProtocol::end_suppression(Number relation) {
  for (auto& [number, entry] : about(relation).list) {
    step<change::SuppressionEnded>(entry, relation);
  }
}

bool ServerProtocol::lacks_something(Number relation) const {
  const RelayWriter& writer = relays_[relation % relay::count];
  const RelayWriter::Reader& reader = writer.about.at(relation);
  const std::int64_t wanted = writer.empty() ? writer.last() : writer.first();
  return reader.low < wanted || std::ranges::any_of(reader.list, [](const auto& one) {
           return is_in(one.second, id<change::U>);
         });
}

bool ServerProtocol::something_unacknowledged() const {
  return !database_.all_noted || relays_[relay::announcements].history.size() > 1 ||
         !relays_[relay::publications].empty() || !relays_[relay::subscriptions].empty();
}

void ServerProtocol::note_acknowledgements() {
  const Item own = database_.announcement(server_id());
  for (const Number relay : {relay::subscriptions, relay::publications, relay::announcements}) {
    const std::map<std::int64_t, Item> history = relays_[relay].history;
    for (const auto& [number, item] : history) {
      if (item == own && database_.all_noted) continue;
      bool pending = false;
      for (const Number relation : relays_[relay].readers) {
        const Number client = client_of(relation / relay::count);
        if (!database_.relevant(item, client)) continue;
        const RelayWriter::Reader& reader = about(relation);
        if (number <= reader.low || !reader.list.contains(number))
          database_.note(item, client);
        else
          pending = true;
      }
      if (pending) continue;
      if (item == own)
        database_.all_noted = true;
      else
        remove(relay, item);
    }
  }
}

void ServerProtocol::update_database() {
  note_acknowledgements();
  const Database::Lists lists = database_.update();
  for (const Item item : lists.announcements) insert(relay::announcements, item);
  for (const Item item : lists.publications) insert(relay::publications, item);
  for (const Item item : lists.subscriptions) insert(relay::subscriptions, item);
}

void ServerProtocol::remove(Number relay, Item item) {
  if (relays_[relay].number_of(item) == 0) return;
  relays_[relay].remove(item);
  queues_.remove({relay, item});
}

/// The item gets a new number, also if it is in the history already. The database lists only what
/// is relevant for somebody.
void ServerProtocol::insert(Number relay, Item item) {
  remove(relay, item);
  RelayWriter& writer = relays_[relay];
  const std::int64_t number = writer.append(item);
  bool wanted = false;
  for (const Number relation : writer.readers) {
    if (!database_.relevant(item, client_of(relation / relay::count))) continue;
    step<change::Created>(about(relation).list[number], relation);
    wanted = true;
  }
  if (!wanted) return;
  queues_.add({relay, item});
  run_rule<comp::Happens<server::Inserted>>(*this, relay::count * server_id() + relay);
}

void ServerProtocol::deliver_next() {
  packets_sent_ = 0;
  while (packets_sent_ == 0 && !queues_.empty()) packets_sent_ = deliver(queues_.take());
}

/// Returns the number of packets.
std::int64_t ServerProtocol::deliver(SendingQueues::Entry entry) {
  RelayWriter& writer = relays_[entry.relay];
  const std::int64_t number = writer.number_of(entry.item);
  std::vector<Number> wanting;
  for (const Number relation : writer.readers) {
    const auto& list = about(relation).list;
    const auto found = list.find(number);
    if (found != list.end() && is_in(found->second, id<change::Q>)) wanting.push_back(relation);
  }
  if (wanting.empty()) return 0;
  served_ = entry;
  auto packets = static_cast<std::int64_t>(wanting.size());
  for (const Number relation : wanting) packets += send_gap_before(relation, number) ? 1 : 0;
  for (const Number relation : wanting) {
    step<change::Serialized>(about(relation).list.at(number), relation);
    run_rule<comp::Happens<server::Served>>(*this, relation);
  }
  run_rule<comp::Happens<server::Delivered>>(*this, relay::count * server_id() + entry.relay);
  return packets;
}

/// The first time that a change is sent to a reader, it is told what it does not need before it.
bool ServerProtocol::send_gap_before(Number relation, std::int64_t number) {
  RelayWriter::Reader& reader = about(relation);
  const auto entry = reader.list.find(number);
  if (std::exchange(entry->second.sent, true)) return false;
  const std::int64_t before = entry == reader.list.begin() ? reader.low : std::prev(entry)->first;
  irrelevant_.clear();
  for (std::int64_t k = std::max(before + 1, relays_[relation % relay::count].first()); k < number;
       ++k) {
    irrelevant_.push_back(k);
  }
  if (irrelevant_.empty()) return false;
  run_rule<comp::Happens<server::Skipped>>(*this, relation);
  return true;
}

void ServerProtocol::send_data(Number relation) {
  const Database::Contents& contents = database_.contents(served_.item);
  Relayed data;
  data.has_data = true;
  data.is_announcement = contents.is_announcement;
  data.participant = contents.participant;
  data.stream = contents.stream;
  data.descriptor = contents.descriptor;
  data.number = relays_[served_.relay].number_of(served_.item);
  data.has_heartbeat = true;
  send_relayed(relation, std::move(data));
}

/// Whether the client is sent the descriptor for the first time, which it is with this.
bool ServerProtocol::is_first_for(Number client, const Relayed& data) {
  if (data.participant == client) return false;  // only a mistake tells it of itself
  const Number pair = run_.topology.pair_between(data.participant, client);
  const auto relation = static_cast<Number>(2 * pair + index_of(data.stream));
  return changes().mark_generated(relation, data.descriptor);
}

/// Counts and sends it; the HEARTBEAT, if it has one, announces what there is now.
void ServerProtocol::send_relayed(Number relation, Relayed relayed) {
  const Number relay = relation % relay::count;
  const Number pair = relation / relay::count;
  const bool of_announcements = relay == relay::announcements;
  const bool cross_host = run_.topology.pair(pair).cross_host;
  Counts& counts = generated();
  if (relayed.has_heartbeat) {
    relayed.first = relays_[relay].first();
    relayed.last = relays_[relay].last();
    if (cross_host) ++(of_announcements ? counts.pdp_heartbeat : counts.heartbeat);
  }
  Packet packet = packet_of(PacketKind::relayed, pair, heartbeat_to_one_bytes);
  packet.use = of_announcements ? TrafficClass::spdp : TrafficClass::heartbeat;
  const auto weigh = [&](std::int64_t bytes) {
    packet.payload_bytes = static_cast<std::uint32_t>(bytes);
  };
  if (!relayed.numbers.empty()) {
    if (cross_host) ++counts.gap;
    weigh(relayed.has_heartbeat ? gap_with_heartbeat_bytes : gap_bytes);
  } else if (relayed.has_data && relayed.is_announcement) {
    if (cross_host) ++counts.pdp_data;
    weigh(relayed.participant == server_id() ? own_announcement_bytes : announcement_bytes);
  } else if (relayed.has_data) {
    const bool initial = is_first_for(client_of(pair), relayed);
    if (cross_host) ++(initial ? counts.initial_data : counts.repair_data);
    packet.carries_initial = initial;
    packet.use = initial ? TrafficClass::initial_data : TrafficClass::repair_data;
    weigh(message_header_bytes + destination_bytes + timestamp_bytes +
          bytes_of(relayed.stream, relayed.descriptor) + heartbeat_submessage_bytes);
  }
  packet.detail = relay;
  packet.carries_heartbeat = relayed.has_heartbeat;
  packet.stream = relay == relay::subscriptions ? Stream::sub : Stream::pub;
  packet.relayed = std::make_shared<const Relayed>(std::move(relayed));
  send(std::move(packet));
}

}  // namespace stormproof::model::fastdds
