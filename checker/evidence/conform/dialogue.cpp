// Sorts the events of a conversation into relations and announcements.
#include "checker/evidence/conform/dialogue.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "checker/evidence/capture/relapses.hpp"

namespace stormproof::conform {

namespace {

using capture::Conversation;
using capture::Event;
using capture::Traffic;

std::uint32_t descriptor_of(std::int64_t sequence_number) {
  return static_cast<std::uint32_t>(
      std::clamp<std::int64_t>(sequence_number - 1, 0, std::int64_t{UINT32_MAX} - 1));
}

/// The highest sequence number that an SEDP event speaks of.
std::int64_t number_in(const Event& event) {
  if (const auto* data = event.data()) return data->sequence_number;
  if (const auto* heartbeat = event.heartbeat()) return std::max(heartbeat->first, heartbeat->last);
  const auto* gap = event.gap();
  const auto& set = gap != nullptr ? gap->list : event.acknack()->missing;
  const bool can_count = set.base > 0 && set.base <= INT64_MAX - 256;
  const std::int64_t last = can_count ? set.base + set.num_bits - 1 : set.base;
  return gap != nullptr ? std::max(gap->start, last) : last;
}

std::vector<std::uint32_t> numbers_of(const capture::GapEvent& gap) {
  std::vector<std::uint32_t> numbers;
  for (std::int64_t n = gap.start; n < gap.list.base; ++n) numbers.push_back(descriptor_of(n));
  for (std::uint32_t bit = 0; bit < gap.list.num_bits; ++bit) {
    if (gap.list.has(bit)) numbers.push_back(descriptor_of(gap.list.base + bit));
  }
  return numbers;
}

/// Whether an SEDP event speaks of a number that no writer has: samples are numbered from 1 on, and
/// readers and writers that know of none say 0.
bool has_no_number(const Event& event) {
  if (const auto* data = event.data()) return data->sequence_number < 1;
  if (const auto* heartbeat = event.heartbeat()) {
    return std::min(heartbeat->first, heartbeat->last) < 0;
  }
  if (const auto* gap = event.gap()) return gap->start < 1 || gap->list.base < gap->start;
  return event.acknack()->missing.base < 0;
}

class Sorter {
 public:
  Sorter(Dialogue& dialogue, Sorting sorting)
      : dialogue_{dialogue}, conversation_{dialogue.conversation}, sorting_{sorting} {
    const auto& participants = conversation_.topology.participants;
    for (std::size_t i = 0; i < participants.size(); ++i) index_[participants[i].prefix] = i;
    dialogue.announcements.resize(participants.size());
    dialogue.descriptors.resize(participants.size());
    if (sorting.has_server) dialogue.server = find_server();
    dialogue.has_neighbour.resize(participants.size());
    for (std::size_t i = 0; i < participants.size(); ++i) {
      for (std::size_t k = 0; k < participants.size(); ++k) {
        if (i == k || participants[i].host != participants[k].host) continue;
        // Clients do not talk to each other.
        if (!sorting.has_server || dialogue.server == i) dialogue.has_neighbour[i] = true;
      }
    }
  }

  /// Before anything is added: what the capture shows of each writer.
  void look_at(const Event& event) {
    const auto source = index_.find(event.source);
    if (source == index_.end() || !is_reliable(event.traffic()) || event.data() == nullptr) return;
    shown_[{source->second, event.writer}].insert(event.data()->sequence_number);
  }

  void add(std::size_t k) {
    const Event& event = conversation_.events[k];
    const auto source = index_.find(event.source);
    const Traffic traffic = event.traffic();
    const bool is_looked_at = traffic == Traffic::spdp || traffic == Traffic::sedp ||
                              (traffic == Traffic::type_lookup && !sorting_.lookups);
    if (event.is_same_host || source == index_.end() || !is_looked_at) {
      ++dialogue_.not_checked;
      return;
    }
    const std::optional<std::size_t> destination = destination_of(event);
    if (!event.is_multicast && !destination) {
      ++dialogue_.not_checked;  // to an address that nobody announced
      return;
    }
    ++dialogue_.checked;
    if (traffic == Traffic::type_lookup) {
      dialogue_.strange.push_back(k);
      return;
    }
    if (destination && is_one_too_many(event)) dialogue_.crowded.push_back(k);
    if (sorting_.has_server) {
      add_with_server(k, source->second, destination);
    } else if (traffic == Traffic::spdp && event.data() != nullptr) {
      dialogue_.announcements[source->second].push_back({event.time_ns, k, destination});
    } else if (traffic != Traffic::sedp || event.gap() != nullptr ||
               (event.data() != nullptr && event.data()->fragment != 0)) {
      dialogue_.strange.push_back(k);
    } else if (destination) {
      add_sedp(k, source->second, *destination);
    } else if (sorting_.sedp_multicast && event.acknack() == nullptr) {
      add_multicast(k, source->second);
    } else {
      dialogue_.strange.push_back(k);
    }
  }

  void finish() {
    if (dialogue_.server) look_for_hidden_clients();
    for (auto& [place, relation] : relations_) dialogue_.relations.push_back(std::move(relation));
    // All relations of a writer in a row.
    std::stable_sort(dialogue_.relations.begin(), dialogue_.relations.end(),
                     [](const Relation& a, const Relation& b) {
                       return std::pair{a.place.source, a.place.writer} <
                              std::pair{b.place.source, b.place.writer};
                     });
  }

 private:
  /// Who says so, or whom somebody announces itself to alone.
  [[nodiscard]] std::optional<std::size_t> find_server() const {
    const auto& topology = conversation_.topology;
    if (const auto* server = topology.server()) return topology.index_of(*server);
    const auto is_for_server = [](const Event& event) {
      return event.traffic() == Traffic::spdp && event.data() != nullptr && !event.is_multicast;
    };
    const auto event = std::ranges::find_if(conversation_.events, is_for_server);
    const bool has_clients = topology.has_server();
    if (!has_clients || event == conversation_.events.end()) return std::nullopt;
    return destination_of(*event);
  }

  /// A HEARTBEAT of the server that is in no capture went to a client on its host.
  void look_for_hidden_clients() {
    std::map<capture::EntityId, std::set<std::uint32_t>> counts;
    for (const auto& [place, relation] : relations_) {
      if (dialogue_.server != place.source) continue;
      for (const Submessage& one : relation.sent) {
        if (one.heartbeat) counts[place.writer].insert(one.heartbeat->count);
      }
    }
    for (const auto& [writer, seen] : counts) {
      if (*seen.rbegin() > seen.size()) dialogue_.has_neighbour[*dialogue_.server] = true;
    }
  }

  /// Whether its message holds as many DATA without it as one may.
  bool is_one_too_many(const Event& event) {
    if (event.data() == nullptr || sorting_.max_data_per_message == 0) return false;
    if (datagram_ != event.datagram) data_in_datagram_ = 0;
    datagram_ = event.datagram;
    return ++data_in_datagram_ == sorting_.max_data_per_message + 1;
  }

  [[nodiscard]] bool is_reliable(Traffic traffic) const {
    return traffic == Traffic::sedp || (sorting_.has_server && traffic == Traffic::spdp);
  }

  [[nodiscard]] std::optional<std::size_t> destination_of(const Event& event) const {
    if (!event.destination) return std::nullopt;
    const auto found = index_.find(*event.destination);
    if (found == index_.end()) return std::nullopt;
    return found->second;
  }

  Relation& relation(std::size_t writer, std::size_t reader, capture::EntityId entity) {
    const Place place{writer, reader, entity};
    Relation& found = relations_[place];
    found.place = place;
    return found;
  }

  void add_with_server(std::size_t k, std::size_t source, std::optional<std::size_t> destination) {
    const Event& event = conversation_.events[k];
    const bool is_fragment = event.data() != nullptr && event.data()->fragment != 0;
    const bool is_with_server =
        destination && (source == dialogue_.server) != (*destination == dialogue_.server);
    if (event.is_multicast || is_fragment || !is_with_server) {
      dialogue_.strange.push_back(k);
      return;
    }
    // The server passes on those of others.
    if (event.data() != nullptr && event.data()->participant == event.source) {
      dialogue_.announcements[source].push_back({event.time_ns, k, destination});
    }
    add_sedp(k, source, *destination);
  }

  void add_multicast(std::size_t k, std::size_t source) {
    const auto& participants = conversation_.topology.participants;
    const std::size_t beyond = dialogue_.beyond.size();
    for (std::size_t j = 0; j < participants.size(); ++j) {
      if (participants[j].host == participants[source].host) continue;
      if (dialogue_.beyond.size() == beyond) add_sedp(k, source, j);
    }
  }

  void add_sedp(std::size_t k, std::size_t source, std::size_t destination) {
    const Event& event = conversation_.events[k];
    const bool is_answer = event.acknack() != nullptr;
    const Place place{is_answer ? destination : source, is_answer ? source : destination,
                      event.writer};
    const std::int64_t most = believable(shown_[{place.source, event.writer}].size());
    if (number_in(event) > most || has_no_number(event)) {
      dialogue_.beyond.push_back({k, place, number_in(event), most});
      return;
    }
    if (event.acknack() != nullptr) {
      add_answer(k, relation(destination, source, event.writer));
      return;
    }
    std::uint32_t& known = dialogue_.descriptors[source][stream_index(event.writer)];
    Submessage submessage{event.time_ns, k, event.datagram, {}, {}, event.is_multicast, {}};
    if (const auto* data = event.data()) {
      submessage.descriptor = descriptor_of(data->sequence_number);
      known = std::max(known, *submessage.descriptor + 1);
    } else if (const auto* gap = event.gap()) {
      submessage.gap = numbers_of(*gap);
    } else {
      const auto* heartbeat = event.heartbeat();
      submessage.heartbeat = {heartbeat->first, descriptor_of(heartbeat->last + 1),
                              heartbeat->count, event.has_info_dst, heartbeat->is_final};
      known = std::max(known, submessage.heartbeat->announced);
    }
    relation(source, destination, event.writer).sent.push_back(submessage);
  }

  void add_answer(std::size_t k, Relation& relation) {
    const Event& event = conversation_.events[k];
    const auto& acknack = *event.acknack();
    Answer answer;
    answer.time_ns = event.time_ns;
    answer.event = k;
    answer.base = descriptor_of(acknack.missing.base);
    answer.is_initial = acknack.is_initial() && !acknack.is_final;
    answer.count = acknack.count;
    for (std::uint32_t bit = 0; bit < acknack.missing.num_bits; ++bit) {
      if (acknack.missing.has(bit)) answer.missing.push_back(answer.base + bit);
    }
    relation.answers.push_back(std::move(answer));
  }

  Dialogue& dialogue_;
  const Conversation& conversation_;
  Sorting sorting_;
  std::map<capture::GuidPrefix, std::size_t> index_;
  std::map<Place, Relation> relations_;
  std::optional<std::uint32_t> datagram_;  ///< of the last DATA
  std::uint32_t data_in_datagram_ = 0;
  /// By participant and writer: the sequence numbers of its DATA.
  std::map<std::pair<std::size_t, capture::EntityId>, std::set<std::int64_t>> shown_;
};

}  // namespace

bool Answer::asks_for(std::uint32_t descriptor) const {
  return std::binary_search(missing.begin(), missing.end(), descriptor);
}

std::optional<std::int64_t> Dialogue::first_announced(std::size_t from, std::size_t to) const {
  for (const Announcement& one : announcements[from]) {
    if (!one.destination || *one.destination == to) return one.time_ns;
  }
  return std::nullopt;
}

std::optional<Announcement> Dialogue::last_sign_of(std::size_t participant) const {
  const auto& events = conversation.events;
  const capture::GuidPrefix& self = conversation.topology.participants[participant].prefix;
  const std::int64_t last_ns = conversation.topology.participants[participant].last_ns;
  for (std::size_t k = events.size(); k-- > 0;) {
    if (events[k].source == self && events[k].time_ns <= end_ns) {
      // DATA of its topics are signs, too, and no events.
      const std::int64_t time_ns = last_ns <= end_ns ? last_ns : events[k].time_ns;
      return Announcement{std::max(time_ns, events[k].time_ns), k, {}};
    }
  }
  return std::nullopt;
}

std::optional<std::int64_t> known_since(const Dialogue& dialogue, std::size_t i, std::size_t j,
                                        const Bounds& bounds) {
  const auto announced = dialogue.first_announced(j, i);
  if (!announced) return std::nullopt;
  const auto& participants = dialogue.conversation.topology.participants;
  // The copy on the own host may be there before the one on the network is captured.
  return participants[j].host == participants[i].host
             ? *announced - bounds.most_send_lag_ns
             : *announced + bounds.least_delay_ns - bounds.clock_error_ns;
}

Dialogue sort_out(const Conversation& conversation, std::int64_t until_ns, Sorting sorting) {
  Dialogue dialogue{conversation};
  Sorter sorter{dialogue, sorting};
  for (const Event& event : conversation.events) sorter.look_at(event);
  std::int64_t forgets_ns = INT64_MAX;
  for (const capture::Relapse& one : capture::relapses(conversation)) {
    forgets_ns = std::min(forgets_ns, one.before_ns);
  }
  for (std::size_t k = 0; k < conversation.events.size(); ++k) {
    const Event& event = conversation.events[k];
    if (event.time_ns > until_ns) break;
    if (event.time_ns > forgets_ns) {
      dialogue.ends_early =
          "what follows the last that somebody said before it forgot another participant is not "
          "looked at: discovery has no rule for leases";
      break;
    }
    const Traffic traffic = event.traffic();
    if ((traffic == Traffic::spdp || traffic == Traffic::sedp) && event.data() != nullptr &&
        event.data()->is_gone) {
      dialogue.ends_early =
          "what follows the first participant or endpoint that leaves is not looked at: discovery "
          "has no rule for leaving";
      break;
    }
    dialogue.end_ns = event.time_ns;
    sorter.add(k);
  }
  for (const capture::DatagramRecord& one : conversation.datagrams) {
    const bool is_after =
        dialogue.ends_early != nullptr ? one.time_ns > dialogue.end_ns : one.time_ns > until_ns;
    if (is_after || one.user.data == 0) continue;
    dialogue.end_ns = std::max(dialogue.end_ns, one.time_ns);
    dialogue.not_checked += one.user.data;
  }
  sorter.finish();
  return dialogue;
}

}  // namespace stormproof::conform
