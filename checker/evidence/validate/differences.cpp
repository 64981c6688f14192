// Who takes part, and with which endpoints.
#include "checker/evidence/validate/differences.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "checker/evidence/validate/difference_finder.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::validate {

using capture::Conversation;
using capture::Event;
using report::grouped;

std::vector<Difference> Finder::find() {
  who_takes_part();
  endpoints();
  if (traits().has_control_relations) control_relations();
  creation();
  destinations();
  submessages();
  other_bytes();
  sizes_of_messages();
  heartbeat_kinds();
  for (const capture::Remark& remark : conversation_.remarks) {
    add("unreadable", remark.count,
        fmt::format("{}: {}, first in {}; what it carried is not counted", remark.what,
                    grouped(remark.count), remark.first));
  }
  return std::move(found_);
}

void Finder::who_takes_part() {
  std::map<std::string, std::uint64_t> others;
  std::uint64_t unannounced = 0;
  std::uint64_t many_locators = 0;
  std::set<std::size_t> counted;
  for (const CapturedParticipant& one : observation_.deployment.participants) {
    const capture::Participant& participant = captured(one);
    counted.insert(one.number);
    if (traits().vendor && participant.vendor != *traits().vendor) {
      ++others[capture::vendor_name(participant.vendor)];
    }
    if (!one.announced && one.is_seen) ++unannounced;
    if (participant.locators.size() > 1) ++many_locators;
  }
  for (const auto& [vendor, count] : others) {
    add("other-vendor", count,
        fmt::format("{} participants are of {}; the profile describes {}", count, vendor,
                    traits().whose));
  }
  add("unannounced", unannounced,
      fmt::format("{} participants never announce themselves in the capture; the model's announce "
                  "themselves at their first message",
                  unannounced));
  add("locators", many_locators,
      fmt::format("{} participants announce more than one unicast locator; the model's have one, "
                  "and one copy goes to each participant",
                  many_locators));
  const std::uint64_t servers = traits().has_server ? 1 : 0;
  const std::uint64_t left_out =
      conversation_.topology.participants.size() - counted.size() - servers;
  add("strangers", left_out,
      fmt::format("{} senders announce neither themselves nor an endpoint until the cut; the model "
                  "leaves them out",
                  left_out));
}

void Finder::endpoints() {
  const model::DescriptorProfile& defaults = scenario_.dds.descriptors;
  std::uint64_t fewer = 0;
  std::uint64_t gone = 0;
  std::uint64_t renewed = 0;
  std::uint64_t later = 0;
  for (const CapturedParticipant& one : observation_.deployment.participants) {
    fewer += one.publications < defaults.default_publications ||
                     one.subscriptions < defaults.default_subscriptions
                 ? 1U
                 : 0U;
    std::map<capture::EntityId, std::set<std::int64_t>> numbers;
    for (const auto& [guid, endpoint] : captured(one).endpoints) {
      gone += endpoint.is_gone ? 1U : 0U;
      later += !endpoint.is_gone && endpoint.first_ns > observation_.cut_ns ? 1U : 0U;
    }
  }
  // Several descriptions of one endpoint.
  std::set<std::tuple<capture::GuidPrefix, capture::Guid, std::int64_t>> descriptions;
  std::set<std::pair<capture::GuidPrefix, capture::Guid>> described;
  for (std::size_t k = 0; k < counting_.classes.size(); ++k) {
    const Event& event = conversation_.events[k];
    const capture::DataEvent* data = event.data();
    if (data == nullptr || !data->endpoint || data->is_gone) continue;
    if (capture::is_relayed(event, *data)) continue;  // each time with a new number
    descriptions.insert({event.source, *data->endpoint, data->sequence_number});
    described.insert({event.source, *data->endpoint});
  }
  renewed = descriptions.size() - described.size();
  add("fewer-endpoints", fewer,
      fmt::format("{} participants have fewer endpoints than the {} publications and {} "
                  "subscriptions that the profile gives everybody; they are predicted with these",
                  fewer, defaults.default_publications, defaults.default_subscriptions));
  add("disposed", gone, fmt::format("{} endpoints are disposed of; the model's stay", gone));
  add("renewed", renewed,
      fmt::format("{} descriptions renew an earlier one; the model describes each endpoint once",
                  renewed));
  add("later-endpoints", later,
      fmt::format("{} endpoints are first described after the cut; the model leaves them out",
                  later));
}

/// Pairs of a reliable publication and a reliable subscription on one topic, across hosts: each is
/// a relation that exchanges HEARTBEATs and ACKNACKs. The model pairs them by their numbers.
void Finder::control_relations() {
  const auto& participants = observation_.deployment.participants;
  const model::DescriptorProfile& defaults = scenario_.dds.descriptors;
  const auto topics = [&](const CapturedParticipant& one, capture::EntityId writer) {
    std::map<std::string, std::uint64_t> result;
    for (const auto& [guid, endpoint] : captured(one).endpoints) {
      const bool counts = endpoint.announced_by == writer && !endpoint.is_gone &&
                          endpoint.qos.is_reliable.value_or(true) &&
                          endpoint.first_ns <= observation_.cut_ns;
      if (counts) ++result[endpoint.topic];
    }
    return result;
  };
  std::vector<std::map<std::string, std::uint64_t>> published;
  std::vector<std::map<std::string, std::uint64_t>> subscribed;
  for (const CapturedParticipant& one : participants) {
    published.push_back(topics(one, capture::entity::publications_writer));
    subscribed.push_back(topics(one, capture::entity::subscriptions_writer));
  }
  constexpr std::uint64_t everywhere = 2;  // ros_discovery_info and parameter_events
  std::uint64_t captured_pairs = 0;
  std::uint64_t model_pairs = 0;
  for (std::size_t i = 0; i < participants.size(); ++i) {
    for (std::size_t j = 0; j < participants.size(); ++j) {
      if (participants[i].host == participants[j].host) continue;
      for (const auto& [topic, writers] : published[i]) {
        const auto readers = subscribed[j].find(topic);
        if (readers != subscribed[j].end()) captured_pairs += writers * readers->second;
      }
      const auto user = [](std::uint32_t all, std::uint32_t by_default) {
        return std::uint64_t{all > by_default ? all - by_default : 0};
      };
      model_pairs += everywhere +
                     std::min(user(participants[i].publications, defaults.default_publications),
                              user(participants[j].subscriptions, defaults.default_subscriptions));
    }
  }
  add("control-relations",
      captured_pairs == model_pairs ? 0 : std::max<std::uint64_t>(captured_pairs, 1),
      fmt::format("{} pairs of reliable endpoints match across hosts, the model has {}; each "
                  "exchanges HEARTBEATs and ACKNACKs",
                  grouped(captured_pairs), grouped(model_pairs)));
}

/// Participants of the model have all endpoints at their start, or create them at equal intervals.
void Finder::creation() {
  std::uint64_t late = 0;
  std::uint64_t uneven = 0;
  model::Nanoseconds latest;
  model::Nanoseconds farthest;
  for (const CapturedParticipant& one : observation_.deployment.participants) {
    const model::Nanoseconds after = one.created_earliest - one.start;
    if (after.count() > 0) ++late;
    if (one.unevenness.count() > 0) ++uneven;
    latest = std::max(latest, after);
    farthest = std::max(farthest, one.unevenness);
  }
  if (traits().creates_endpoints_over_time) {
    add("uneven-creation", uneven,
        fmt::format("{} participants create endpoints up to {} earlier or later than at equal "
                    "intervals, as the model's do; so much `endpoints_done` varies from run to run",
                    uneven, report::duration(farthest)));
  } else {
    add("created-later", late,
        fmt::format("{} participants create endpoints after their first announcement, up to {} "
                    "later at least; with this profile all exist from the start",
                    late, report::duration(latest)));
  }
}

std::vector<Difference> differences(const Conversation& conversation,
                                    const Observation& observation, const model::Scenario& scenario,
                                    const Sizes& sizes) {
  return Finder{conversation, observation, scenario, sizes}.find();
}

}  // namespace stormproof::validate
