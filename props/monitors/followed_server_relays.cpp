// The writers of a Discovery Server beside the run: what is acknowledged, inserted and delivered,
// and what an ACKNACK does to it (specs/guide/discovery-server.md, "The server's writers").
#include <algorithm>

#include "props/monitors/followed_server.hpp"

namespace stormproof::props {

namespace {

namespace change = fsm::change_for_reader;

template <class State>
constexpr fsm::StateId id = fsm::Reflect<fsm::ChangeForReader>::id<State>;

}  // namespace

bool ServerFollower::answer(server::LacksSomething, const World& w) const {
  const FollowedRelay& writer = relays_[relay_of(w)];
  const FollowedRelay::Reader& reader = writer.about.at(w.place().relation);
  const std::int64_t wanted = writer.history.empty() ? writer.last() : writer.first();
  return reader.low < wanted || std::ranges::any_of(reader.list, [](const auto& one) {
           return one.second == id<change::U>;
         });
}

bool ServerFollower::answer(server::SomethingUnacknowledged, const World&) const {
  return !database_.all_noted || relays_[relay::announcements].history.size() > 1 ||
         !relays_[relay::publications].history.empty() ||
         !relays_[relay::subscriptions].history.empty();
}

std::vector<std::int64_t> ServerFollower::numbers_listed(const Place& place) {
  std::vector<std::int64_t> numbers;
  for (const auto& [number, state] : reader_at(place).list) numbers.push_back(number);
  return numbers;
}

/// A change in the list of a reader, which joins it if it is not in there.
template <class Event>
fsm::Stepper<fsm::ChangeForReader>::Output ServerFollower::move_change(
    const Place& place, std::int64_t number,
    const fsm::Stepper<fsm::ChangeForReader>::Input& input) {
  const auto& names = fsm::Reflect<fsm::ChangeForReader>::state_names;
  fsm::StateId& state = reader_at(place).list.try_emplace(number, changes_.initial).first->second;
  Move move;
  move.machine = {fsm::name_of<fsm::ChangeForReader>(), model::MachineRef::Kind::pair, place.pair};
  move.event = fsm::name_of<Event>();
  move.before = names[state];
  fsm::RowId row = fsm::no_row;
  const auto output = changes_.step<Event>(state, input, row);
  move.after = names[state];
  if (row != fsm::no_row) expect(move, site_);
  return output;
}

void ServerFollower::becomes(server::RelayOpen, const Place& place) {
  FollowedRelay& writer = relay_at(place);
  writer.readers.push_back(place.relation);
  writer.about[place.relation].low = writer.first() - 1;
}

void ServerFollower::perform(server::ListRelevant, const World& w) {
  const std::uint32_t client = topology_.pair(w.place().pair).destination;
  for (const auto& [number, item] : relay_at(w.place()).history) {
    if (database_.relevant(item, client)) move_change<change::ReaderMatched>(w.place(), number);
  }
}

void ServerFollower::perform(server::TakeAckNack, const World& w) {
  const model::Relayed& acknack = *w.heard().relayed.of;
  FollowedRelay::Reader& reader = reader_at(w.place());
  reader.low = std::max(reader.low, acknack.base - 1);
  for (const std::int64_t number : numbers_listed(w.place())) {
    if (number >= acknack.base) break;
    move_change<change::AckNackReceived>(w.place(), number, {.listed = false, .below_base = true});
    reader.list.erase(number);
  }
  const std::int64_t first = relay_at(w.place()).first();
  some_requested_ = false;
  some_irrelevant_ = false;
  irrelevant_.clear();
  for (const std::int64_t number : acknack.numbers) {
    if (reader.list.contains(number)) {
      const auto asked = move_change<change::AckNackReceived>(
          w.place(), number, {.listed = true, .below_base = false});
      some_requested_ = some_requested_ || asked.requested;
    } else if (number >= first) {
      irrelevant_.push_back(number);
      some_irrelevant_ = some_irrelevant_ || number > reader.low;
    }
  }
}

void ServerFollower::perform(server::QueueAgain, const World& w) {
  const FollowedRelay& writer = relay_at(w.place());
  for (const std::uint32_t relation : writer.readers) {
    const Place place = relation_place(relation);
    for (const std::int64_t number : numbers_listed(place)) {
      if (!move_change<change::NackResponseDue>(place, number).enqueue) continue;
      const RelayedItem& item = writer.history.at(number);
      const auto has = [&](const auto& queue) { return std::ranges::count(queue, item) > 0; };
      if (!has(fresh_) && !has(again_)) again_.push_back(item);
    }
  }
}

void ServerFollower::perform(server::EndSuppression, const World& w) {
  for (const std::int64_t number : numbers_listed(w.place())) {
    move_change<change::SuppressionEnded>(w.place(), number);
  }
}

void ServerFollower::perform(server::UpdateDatabase, const World&) {
  note_acknowledgements();
  for (const auto& list : database_.update()) {
    for (const RelayedItem& item : list) insert(item);
  }
}

void ServerFollower::remove(const RelayedItem& item) {
  FollowedRelay& writer = relays_[item.relay];
  const std::int64_t number = writer.number_of(item);
  writer.history.erase(number);
  for (auto& [relation, reader] : writer.about) reader.list.erase(number);
  std::erase(fresh_, item);
  std::erase(again_, item);
}

void ServerFollower::note_acknowledgements() {
  const RelayedItem own = database_.own_announcement();
  for (const std::uint32_t r : {relay::subscriptions, relay::publications, relay::announcements}) {
    const std::map<std::int64_t, RelayedItem> history = relays_[r].history;
    for (const auto& [number, item] : history) {
      if (item == own && database_.all_noted) continue;
      if (is_pending(number, item)) continue;
      if (item == own)
        database_.all_noted = true;
      else
        remove(item);
    }
  }
}

/// Notes who has acknowledged it; somebody for whom it is relevant may be left.
bool ServerFollower::is_pending(std::int64_t number, const RelayedItem& item) {
  bool pending = false;
  for (const std::uint32_t relation : relays_[item.relay].readers) {
    const Place place = relation_place(relation);
    const std::uint32_t client = topology_.pair(place.pair).destination;
    if (!database_.relevant(item, client)) continue;
    const FollowedRelay::Reader& reader = reader_at(place);
    const bool acknowledged = number <= reader.low || !reader.list.contains(number);
    if (acknowledged) database_.note(item, client);
    pending = pending || !acknowledged;
  }
  return pending;
}

/// It gets a new number, also if it is in the history already.
void ServerFollower::insert(const RelayedItem& item) {
  remove(item);
  FollowedRelay& writer = relays_[item.relay];
  const std::int64_t number = writer.next++;
  writer.history.emplace(number, item);
  bool is_wanted = false;
  for (const std::uint32_t relation : writer.readers) {
    const Place place = relation_place(relation);
    if (!database_.relevant(item, topology_.pair(place.pair).destination)) continue;
    move_change<change::Created>(place, number);
    is_wanted = true;
  }
  if (!is_wanted) return;
  fresh_.push_back(item);
  world_at(writer_place(relay_writer(item.relay))).raise(server::Inserted{});
}

/// Changes that nobody wants any more take no time.
void ServerFollower::perform(server::DeliverNext, const World&) {
  packets_sent_ = 0;
  while (packets_sent_ == 0) {
    std::deque<RelayedItem>& queue = fresh_.empty() ? again_ : fresh_;
    if (queue.empty()) return;
    const RelayedItem item = queue.front();
    queue.pop_front();
    packets_sent_ = deliver(item);
  }
}

/// Returns the number of packets.
std::int64_t ServerFollower::deliver(const RelayedItem& item) {
  const FollowedRelay& writer = relays_[item.relay];
  const std::int64_t number = writer.number_of(item);
  std::vector<Place> wanting;
  for (const std::uint32_t relation : writer.readers) {
    const auto& list = writer.about.at(relation).list;
    const auto found = list.find(number);
    if (found == list.end() || found->second != id<change::Q>) continue;
    wanting.push_back(relation_place(relation));
  }
  if (wanting.empty()) return 0;
  std::int64_t packets = std::ssize(wanting);
  for (const Place& place : wanting) packets += expect_gap_before(place, number) ? 1 : 0;
  served_ = item;
  for (const Place& place : wanting) {
    move_change<change::Serialized>(place, number);
    World r = world_at(place);
    r.raise(server::Served{});
  }
  World w = world_at(writer_place(relay_writer(item.relay)));
  w.raise(server::Delivered{});
  return packets;
}

/// The first time that a number is sent to a reader: what is before it, and not for this reader.
bool ServerFollower::expect_gap_before(const Place& place, std::int64_t number) {
  FollowedRelay::Reader& reader = reader_at(place);
  if (!reader.sent.insert(number).second) return false;
  std::int64_t before = reader.low;
  for (const auto& [listed, state] : reader.list) {
    if (listed < number) before = listed;
  }
  irrelevant_.clear();
  const std::int64_t first = relay_at(place).first();
  for (std::int64_t k = std::max(before + 1, first); k < number; ++k) irrelevant_.push_back(k);
  if (irrelevant_.empty()) return false;
  world_at(place).raise(server::Skipped{});
  return true;
}

model::Relayed ServerFollower::served() const {
  model::Relayed data;
  data.has_data = true;
  data.is_announcement = served_.is_announcement();
  data.participant = served_.participant;
  data.stream = served_.stream();
  data.descriptor = served_.descriptor;
  data.number = relays_[served_.relay].number_of(served_);
  return data;
}

/// It announces everything that there is.
model::Relayed ServerFollower::with_heartbeat(const World& w, model::Relayed relayed) const {
  const FollowedRelay& writer = relays_[relay_of(w)];
  relayed.has_heartbeat = true;
  relayed.first = writer.first();
  relayed.last = writer.last();
  return relayed;
}

}  // namespace stormproof::props
