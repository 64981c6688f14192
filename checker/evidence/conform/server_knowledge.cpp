// Looks at what clients sent to the server, and at what it had announced to them.
#include "checker/evidence/conform/server_knowledge.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "model/implementations.hpp"

namespace stormproof::conform::server {

namespace {

bool is_publication(capture::EntityId sedp_writer) {
  return sedp_writer == capture::entity::publications_writer;
}

/// Times in a capture can be as far apart as its numbers claim.
std::uint64_t between(std::int64_t earlier_ns, std::int64_t later_ns) {
  return static_cast<std::uint64_t>(later_ns) - static_cast<std::uint64_t>(earlier_ns);
}

}  // namespace

ServerKnowledge::ServerKnowledge(const Context& context)
    : context_{context},
      topology_{context.dialogue.conversation.topology},
      server_{*context.dialogue.server},
      is_told_everything_{context.dds.discovery == model::Discovery::super_client},
      registered_(context.dialogue.participants(), never_ns) {
  for (std::size_t i = 0; i < registered_.size(); ++i) {
    if (i == server_) continue;
    const auto announced = context.dialogue.first_announced(i, server_);
    if (is_hidden(i))
      registered_[i] = always_ns;
    else if (announced)
      registered_[i] = context.earliest_arrival(*announced);
    learn_endpoints(i);
  }
  for (const Relation& relation : context.dialogue.relations) {
    if (relation.place.source == server_ && relation.place.writer == capture::entity::spdp_writer) {
      note_acknowledgements(relation);
    }
  }
  note_wakes();
}

bool ServerKnowledge::is_hidden(std::size_t participant) const {
  return topology_.participants[participant].host == topology_.participants[server_].host;
}

std::optional<Item> ServerKnowledge::item_of(const capture::Event& event) const {
  const capture::DataEvent& data = *event.data();
  const auto prefix = data.endpoint ? std::optional{data.endpoint->prefix} : data.participant;
  const capture::Participant* whose = prefix ? topology_.find(*prefix) : nullptr;
  if (whose == nullptr) return std::nullopt;
  return Item{topology_.index_of(*whose), data.endpoint ? data.endpoint->entity : 0};
}

/// What it sent to the server, or on the server's host what the server tells of.
void ServerKnowledge::learn_endpoints(std::size_t participant) {
  for (const auto& [guid, one] : topology_.participants[participant].endpoints) {
    endpoints_[{participant, guid.entity}] = {one.topic, is_publication(one.announced_by),
                                              is_hidden(participant) ? always_ns : never_ns};
  }
  for (const Relation& relation : context_.dialogue.relations) {
    if (relation.place.source != participant) continue;
    for (const Submessage& one : relation.sent) {
      const capture::Event& event = context_.dialogue.conversation.events[one.event];
      if (event.data() == nullptr || !event.data()->endpoint) continue;
      const auto known = endpoints_.find({participant, event.data()->endpoint->entity});
      if (known == endpoints_.end()) continue;
      known->second.known_ns =
          std::min(known->second.known_ns, context_.earliest_arrival(one.time_ns));
    }
  }
}

/// The client has acknowledged a participant if its base is above a number that this had.
void ServerKnowledge::note_acknowledgements(const Relation& announcements) {
  const std::size_t client = *announcements.place.destination;
  for (const Submessage& one : announcements.sent) {
    if (!one.descriptor) continue;
    const auto item = item_of(context_.dialogue.conversation.events[one.event]);
    if (!item) continue;
    const auto answer = std::ranges::find_if(announcements.answers, [&](const Answer& by) {
      return by.base > *one.descriptor &&
             by.time_ns + capture_resolution_ns + context_.bounds.clock_error_ns >= one.time_ns;
    });
    if (answer == announcements.answers.end()) continue;
    const auto [known, is_new] = acknowledged_.emplace(std::pair{item->participant, client},
                                                       context_.earliest_arrival(answer->time_ns));
    if (!is_new) {
      known->second = std::min(known->second, context_.earliest_arrival(answer->time_ns));
    }
  }
}

/// The routine runs when a client or one of its descriptors is new, and then after its period.
void ServerKnowledge::note_wakes() {
  std::vector<Run> wakes;
  for (const Relation& relation : context_.dialogue.relations) {
    if (relation.place.source == server_) continue;
    std::set<std::uint32_t> seen;
    for (const Submessage& one : relation.sent) {
      if (!one.descriptor || !seen.insert(*one.descriptor).second) continue;
      wakes.push_back(
          {context_.earliest_arrival(one.time_ns), arrived_by(relation, *one.descriptor)});
    }
  }
  for (const Run& wake : wakes) {
    runs_.push_back(wake);
    runs_.back().again = times_again(wake, wakes);
  }
}

/// When the server has surely got it: it says so, or the longest delay is over.
std::int64_t ServerKnowledge::arrived_by(const Relation& relation, std::uint32_t descriptor) const {
  std::int64_t by = context_.dialogue.end_ns;
  const auto has = [&](const Answer& answer) { return answer.base > descriptor; };
  const auto answer = std::ranges::find_if(relation.answers, has);
  if (answer != relation.answers.end()) by = std::min(by, answer->time_ns);
  if (context_.bounds.may_lose) return by;
  const auto sent = std::ranges::find_if(
      relation.sent, [&](const Submessage& one) { return one.descriptor == descriptor; });
  return std::min(by,
                  sent->time_ns + context_.bounds.most_delay_ns + context_.bounds.clock_error_ns);
}

/// How often the routine runs again by its period, until the next wake has surely come. The k-th
/// time is at from + k·period at the earliest, and late by at most the bound more each time.
std::uint64_t ServerKnowledge::times_again(const Run& wake, const std::vector<Run>& wakes) const {
  const std::int64_t end_ns = context_.dialogue.end_ns;
  std::uint64_t most = wake.from_ns < end_ns ? between(wake.from_ns, end_ns) / period() : 0;
  for (const Run& other : wakes) {
    if (other.to_ns < wake.from_ns || other.from_ns <= wake.to_ns) continue;
    // The first time that would have to come after the other wake.
    const std::uint64_t k = between(wake.from_ns, other.to_ns) / period();
    const bool is_before = k <= between(wake.to_ns, other.from_ns - 1) / longest_period();
    if (is_before) most = std::min(most, k);
  }
  return most;
}

/// The first instant from `time_ns` on at which the routine can run.
std::int64_t ServerKnowledge::runs_after(std::int64_t time_ns) const {
  // A client that nobody sees can have made it run.
  if (context_.dialogue.has_neighbour[server_]) return time_ns;
  std::int64_t first = never_ns;
  for (const Run& run : runs_) {
    const std::uint64_t k =
        run.to_ns >= time_ns
            ? 0
            : (between(run.to_ns, time_ns) + longest_period() - 1) / longest_period();
    if (k > run.again) continue;
    const auto later = static_cast<std::int64_t>(k * period());
    first = std::min(first, std::max(run.from_ns + later, time_ns));
  }
  return first;
}

std::uint64_t ServerKnowledge::period() const {
  return static_cast<std::uint64_t>(context_.dds.server.server_routine_period.count());
}
std::uint64_t ServerKnowledge::longest_period() const {
  return period() + static_cast<std::uint64_t>(context_.bounds.most_lateness_ns);
}

/// When somebody has to be told of the endpoint: the client has one on the other side of its topic.
std::int64_t ServerKnowledge::needed(const Endpoint& one, std::size_t client) const {
  if (is_told_everything_) return one.known_ns;
  std::int64_t first = never_ns;
  const auto end = endpoints_.lower_bound({client + 1, 0});
  for (auto other = endpoints_.lower_bound({client, 0}); other != end; ++other) {
    const Endpoint& opposite = other->second;
    const bool is_same = one.topic.empty() || opposite.topic.empty() || one.topic == opposite.topic;
    if (opposite.is_publication == one.is_publication || !is_same) continue;
    first = std::min(first, std::max(one.known_ns, opposite.known_ns));
  }
  return first;
}

std::int64_t ServerKnowledge::passes_on(const Item& item, std::size_t client) const {
  if (item.participant == server_) return registered_[client];
  if (item.participant == client) return never_ns;
  if (item.endpoint != 0) {
    const auto known = endpoints_.find(item);
    const auto acknowledged = acknowledged_.find({item.participant, client});
    if (known == endpoints_.end() || acknowledged == acknowledged_.end()) return never_ns;
    return std::max(needed(known->second, client), runs_after(acknowledged->second));
  }
  // Of a client on the server's own host it may have endpoints that it tells nobody of.
  std::int64_t first = is_hidden(item.participant) ? registered_[client] : never_ns;
  const auto end = endpoints_.lower_bound({item.participant + 1, 0});
  for (auto one = endpoints_.lower_bound({item.participant, 0}); one != end; ++one) {
    first = std::min(first, needed(one->second, client));
  }
  return std::max({first, registered_[item.participant], registered_[client]});
}

}  // namespace stormproof::conform::server
