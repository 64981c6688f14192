// Participants from the topology, times from the events.
#include "checker/evidence/validate/captured_deployment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "checker/evidence/capture/unknown_types.hpp"
#include "checker/evidence/validate/creation_times.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::validate {

namespace {

using capture::GuidPrefix;
using model::Nanoseconds;

std::map<GuidPrefix, std::int64_t> first_announcements(const capture::Conversation& conversation,
                                                       std::int64_t until_ns) {
  std::map<GuidPrefix, std::int64_t> first;
  for (const capture::Event& event : conversation.events) {
    if (event.time_ns > until_ns) break;
    if (event.traffic() != capture::Traffic::spdp || event.data() == nullptr) continue;
    first.try_emplace(event.source, event.time_ns);
  }
  return first;
}

/// Endpoints of one SEDP writer, described by the cut.
std::uint32_t described(const capture::Participant& participant, capture::EntityId writer,
                        std::int64_t until_ns) {
  return static_cast<std::uint32_t>(
      std::ranges::count_if(participant.endpoints, [&](const auto& entry) {
        const capture::Endpoint& endpoint = entry.second;
        return endpoint.announced_by == writer && !endpoint.is_gone &&
               endpoint.first_ns <= until_ns;
      }));
}

/// The k-th of E endpoints should have been created at start + (last − start) · (k + 1) / E.
Nanoseconds unevenness(const CapturedParticipant& participant, const std::vector<Creation>& seen) {
  using model::fastdds::creation_order;
  const std::uint32_t endpoints = participant.publications + participant.subscriptions;
  const std::uint32_t defaults = model::fastdds::default_publications;
  if (participant.publications < defaults ||
      participant.subscriptions < model::fastdds::default_subscriptions) {
    return Nanoseconds{0};  // no participant of the model
  }
  std::map<std::pair<model::Stream, std::int64_t>, std::uint32_t> place;
  for (std::uint32_t k = 0; k < endpoints; ++k) {
    const model::fastdds::Endpoint one = creation_order(k, participant.publications - defaults);
    place[{one.stream, std::int64_t{one.descriptor} + 1}] = k;
  }
  const Nanoseconds last{
      (participant.created_earliest.count() + participant.created_latest.count()) / 2};
  const double interval = static_cast<double>((last - participant.start).count()) / endpoints;
  double most = 0;
  for (const Creation& one : seen) {
    const auto k = place.find({one.stream, one.number});
    if (k == place.end()) continue;
    const double expected =
        static_cast<double>(participant.start.count()) + interval * (k->second + 1);
    most = std::max(most, std::abs(static_cast<double>(one.time_ns) - expected));
  }
  constexpr std::int64_t resolution_ns = 1000;  // of the times in a capture
  return Nanoseconds{static_cast<std::int64_t>(most) / resolution_ns * resolution_ns};
}

/// A participant that only the Discovery Server tells of. Clients are told of endpoints that
/// somebody needs, so of those that every node has only the ones on topics that all share.
CapturedParticipant unseen(const capture::Topology& topology, const capture::Participant& one,
                           std::int64_t until_ns) {
  CapturedParticipant participant;
  participant.number = topology.index_of(one);
  participant.host = one.host;
  participant.publications = described(one, capture::entity::publications_writer, until_ns);
  participant.subscriptions = described(one, capture::entity::subscriptions_writer, until_ns);
  participant.announced = false;
  participant.is_seen = false;
  if (one.discovery == "SUPER_CLIENT") return participant;
  constexpr std::uint32_t shared_by_all = 2;  // ros_discovery_info and parameter_events
  participant.publications += model::fastdds::default_publications - shared_by_all;
  participant.subscriptions += model::fastdds::default_subscriptions - shared_by_all;
  return participant;
}

/// With the first that is seen; creation takes as long as theirs.
void assume_times(CapturedDeployment& deployment) {
  const auto& all = deployment.participants;
  const auto is_better = [](const CapturedParticipant& a, const CapturedParticipant& b) {
    return std::pair{!a.is_seen, a.start} < std::pair{!b.is_seen, b.start};
  };
  const Nanoseconds start = std::ranges::min_element(all, is_better)->start;
  Nanoseconds least{std::numeric_limits<std::int64_t>::max()};
  Nanoseconds most{0};
  for (const CapturedParticipant& one : all) {
    if (!one.is_seen) continue;
    least = std::min(least, one.done_earliest() - one.start);
    most = std::max(most, one.done_latest() - one.start);
  }
  for (CapturedParticipant& one : deployment.participants) {
    if (one.is_seen) continue;
    one.start = start;
    one.created_earliest = start + least;
    one.created_latest = start + most;
  }
}

/// Times of those that are not seen. What is wrong with the record, or nothing.
std::optional<std::string> use_record(const capture::Topology& topology, const RunRecord& record,
                                      CapturedDeployment& deployment) {
  std::vector<CapturedParticipant*> nameless;
  std::set<const Reported*> used;
  const auto use = [&](CapturedParticipant& one, const Reported& reported) {
    used.insert(&reported);
    one.start = Nanoseconds{reported.created_ns};
    one.created_earliest = one.created_latest = Nanoseconds{reported.endpoints_done_ns};
  };
  for (CapturedParticipant& one : deployment.participants) {
    if (one.is_seen) continue;
    const std::string name = to_string(topology.participants[one.number].prefix);
    const auto found = std::ranges::find(record.participants, name, &Reported::guid_prefix);
    if (found == record.participants.end()) {
      nameless.push_back(&one);
    } else {
      use(one, *found);
    }
  }
  // Who is who does not matter among those that have no names.
  for (const Reported& reported : record.participants) {
    const bool is_on_host = reported.guid_prefix.empty() && reported.host == 0;
    if (!is_on_host || nameless.empty()) continue;
    use(*nameless.front(), reported);
    nameless.erase(nameless.begin());
  }
  if (nameless.empty()) return std::nullopt;
  return fmt::format(
      "it has the times of {} participants on the host of the Discovery Server (host 0), which are "
      "not on the link; the capture tells of {}",
      used.size(), used.size() + nameless.size());
}

/// Times of all participants were those of the capture.
void count_from_first_announcement(CapturedDeployment& deployment) {
  const auto first =
      std::ranges::min_element(deployment.participants, {}, &CapturedParticipant::start);
  const Nanoseconds zero = first->start;
  deployment.zero_ns = zero.count();
  for (CapturedParticipant& participant : deployment.participants) {
    participant.start -= zero;
    participant.created_earliest -= zero;
    participant.created_latest -= zero;
  }
}

std::string names_of(const capture::Conversation& conversation) {
  std::string names;
  for (const capture::CaptureInfo& one : conversation.captures) {
    names += (names.empty() ? "" : ", ") + one.name;
  }
  return names;
}

}  // namespace

model::config::Result<CapturedDeployment> captured_deployment(
    const capture::Conversation& conversation, std::int64_t until_ns, const RunRecord& record) {
  using model::config::InputError;
  const auto announced = first_announcements(conversation, until_ns);
  if (announced.empty()) {
    return InputError{names_of(conversation),
                      "no participant announces itself (SPDP DATA) until the cut; expected a "
                      "capture of discovery from its beginning"};
  }
  const auto created = creation_times(conversation, until_ns);
  CapturedDeployment result;
  std::set<std::size_t> hosts;
  const capture::Participant* server = conversation.topology.server();
  if (server != nullptr) {
    result.server_host = server->host;
    hosts.insert(server->host);
  }
  bool some_unseen = false;
  for (const capture::Participant& one : conversation.topology.participants) {
    if (one.is_server()) continue;
    const auto start = announced.find(one.prefix);
    const bool is_local = server != nullptr && one.host == server->host;
    if (is_local && start == announced.end() && one.first_ns <= until_ns) {
      result.participants.push_back(unseen(conversation.topology, one, until_ns));
      some_unseen = true;
      continue;
    }
    const auto last = created.find(one.prefix);
    if (start == announced.end() && last == created.end()) continue;  // nothing of it to discover
    const std::int64_t start_ns = start == announced.end() ? one.first_ns : start->second;
    const CreationTimes creation =
        last == created.end() ? CreationTimes{start_ns, start_ns, {}} : last->second;
    CapturedParticipant participant;
    participant.number = conversation.topology.index_of(one);
    participant.host = one.host;
    participant.publications = described(one, capture::entity::publications_writer, until_ns);
    participant.subscriptions = described(one, capture::entity::subscriptions_writer, until_ns);
    participant.announced = start != announced.end();
    participant.start = Nanoseconds{start_ns};
    participant.created_earliest = Nanoseconds{std::max(creation.last_earliest, start_ns)};
    participant.created_latest = Nanoseconds{std::max(creation.last_latest, start_ns)};
    participant.unevenness = unevenness(participant, creation.seen);
    participant.creations_seen = creation.seen.size();
    result.participants.push_back(participant);
    hosts.insert(one.host);
  }
  result.hosts = hosts.size();
  const capture::UnknownTypes types = capture::unknown_types(conversation.topology);
  if (types.can_be_looked_up) result.unknown_types = types.per_participant;
  const bool some_seen = std::ranges::any_of(result.participants, &CapturedParticipant::is_seen);
  if (!some_seen) {
    return InputError{names_of(conversation),
                      "no client of the Discovery Server is on another host than the server; "
                      "expected a capture of discovery across hosts, from its beginning"};
  }
  if (some_unseen && record.participants.empty()) assume_times(result);
  if (some_unseen && !record.participants.empty()) {
    if (const auto error = use_record(conversation.topology, record, result)) {
      return InputError{record.name, *error};
    }
  }
  count_from_first_announcement(result);
  if (hosts.size() < 2) {
    return InputError{
        names_of(conversation),
        fmt::format("its participants ({} until the cut) are on one host; expected at "
                    "least two hosts, because only discovery across hosts is "
                    "predicted",
                    result.participants.size())};
  }
  return result;
}

std::vector<model::Participant> model_participants(const CapturedDeployment& deployment,
                                                   const model::DescriptorProfile& defaults) {
  const auto user = [](std::uint32_t described, std::uint32_t by_default) {
    return described > by_default ? described - by_default : 0;
  };
  std::vector<model::Participant> participants;
  for (const CapturedParticipant& one : deployment.participants) {
    model::Participant participant{};
    // The server is on host 0 of every scenario.
    const std::size_t server_host = deployment.server_host.value_or(0);
    const std::size_t host = one.host == server_host ? 0 : one.host == 0 ? server_host : one.host;
    participant.host = model::HostId{static_cast<std::uint32_t>(host)};
    participant.publications = user(one.publications, defaults.default_publications);
    participant.subscriptions = user(one.subscriptions, defaults.default_subscriptions);
    participant.start = one.start;
    participant.endpoints_done =
        Nanoseconds{(one.created_earliest.count() + one.created_latest.count()) / 2};
    participants.push_back(participant);
  }
  return participants;
}

}  // namespace stormproof::validate
