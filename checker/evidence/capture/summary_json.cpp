// The summary as JSON; specs/guide/captures.md explains the keys.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "checker/evidence/capture/summary.hpp"
#include "checker/evidence/capture/timeline.hpp"

namespace stormproof::capture {

namespace {

using Json = nlohmann::json;

Json counts_json(const model::Counts& counts) {
  Json json;
  for (const auto& [name, value] : counts.entries()) json[name] = value;
  json["total"] = counts.total();
  return json;
}

Json heartbeats_json(const HeartbeatFigures& figures) {
  Json json;
  for (std::size_t k = 0; k < heartbeat_kinds; ++k) {
    json[name_of(static_cast<HeartbeatKind>(k))] = figures.by_kind[k];
  }
  json["no_info_dst"] = figures.no_info_dst;
  json["behind_data"] = figures.behind_data;
  json["empty"] = figures.empty;
  json["final"] = figures.final_flag;
  return json;
}

Json acknacks_json(const AcknackFigures& figures) {
  return {{"initial", figures.initial},   {"negative", figures.negative},
          {"positive", figures.positive}, {"preemptive", figures.preemptive},
          {"final", figures.final_flag},  {"requested", figures.requested}};
}

Json traffic_json(const Counting& counting) {
  Json json;
  for (const Traffic traffic : all_traffic) {
    const TrafficFigures& figures = counting.traffic[static_cast<std::size_t>(traffic)];
    json[name_of(traffic)] = {{"data", figures.data},
                              {"data_frag", figures.data_frag},
                              {"heartbeat", figures.heartbeat},
                              {"acknack", figures.acknack},
                              {"gap", figures.gap},
                              {"bytes", figures.bytes}};
  }
  return json;
}

Json sizes_json(const Counting& counting) {
  Json json;
  const auto names = model::Counts{}.entries();
  for (std::size_t k = 0; k < message_class_count; ++k) {
    const SizeFigures& figures = counting.sizes[k];
    Json single = Json::object();
    for (const auto& [size, datagrams] : figures.single) single[std::to_string(size)] = datagrams;
    json[names[k].name] = {{"submessage_bytes", figures.submessage_bytes},
                           {"single_payload_bytes", single}};
  }
  return json;
}

Json participant_json(const Participant& participant) {
  Json addresses = Json::array();
  Json locators = Json::array();
  Json endpoints = Json::array();
  for (const Address& address : participant.addresses) addresses.push_back(to_string(address));
  for (const UdpEnd& locator : participant.locators) locators.push_back(to_string(locator));
  for (const auto& [guid, endpoint] : participant.endpoints) {
    Json reliable = nullptr;
    if (endpoint.is_reliable) reliable = *endpoint.is_reliable;
    endpoints.push_back({{"entity", guid.entity},
                         {"stream", stream_of(endpoint.announced_by)},
                         {"sequence_number", endpoint.sequence_number},
                         {"topic", endpoint.topic},
                         {"type", endpoint.type},
                         {"reliable", reliable},
                         {"gone", endpoint.is_gone},
                         {"first_ns", endpoint.first_ns}});
  }
  return {{"guid_prefix", to_string(participant.prefix)},
          {"host", participant.host},
          {"vendor", vendor_name(participant.vendor)},
          {"name", participant.name},
          {"first_ns", participant.first_ns},
          {"addresses", addresses},
          {"locators", locators},
          {"publications", participant.announced(entity::publications_writer)},
          {"subscriptions", participant.announced(entity::subscriptions_writer)},
          {"endpoints", endpoints}};
}

Json topology_json(const Topology& topology) {
  Json participants = Json::array();
  for (const Participant& one : topology.participants) {
    participants.push_back(participant_json(one));
  }
  return {{"hosts", topology.hosts}, {"participants", participants}};
}

/// As `simulate` has it, with GUID prefixes as indices in `topology.participants`.
Json missing_json(const Summary& summary) {
  constexpr std::size_t most = 100;
  const Topology& topology = summary.conversation.topology;
  const auto& missing = summary.counting.missing;
  const auto index = [&](const GuidPrefix& prefix) {
    const Participant* found = topology.find(prefix);
    return found == nullptr ? Json{} : Json(topology.index_of(*found));
  };
  Json descriptors = Json::array();
  for (std::size_t k = 0; k < std::min(missing.size(), most); ++k) {
    descriptors.push_back({{"source", index(missing[k].source)},
                           {"destination", index(missing[k].destination)},
                           {"stream", stream_of(missing[k].writer)},
                           {"sequence_number", missing[k].sequence_number}});
  }
  return {{"required", summary.counting.required},
          {"count", summary.counting.missing_count},
          {"descriptors", descriptors}};
}

Json timeline_json(const Summary& summary) {
  constexpr std::size_t steps = 100;
  const Timeline line = timeline(summary.conversation, summary.counting, summary.end_ns(), steps);
  const auto names = model::Counts{}.entries();
  Json json = {{"step_ns", line.step_ns}};
  for (std::size_t one = 0; one < message_class_count; ++one) {
    Json values = Json::array();
    for (const auto& step : line.steps) values.push_back(step[one]);
    json[names[one].name] = std::move(values);
  }
  return json;
}

}  // namespace

nlohmann::json to_json(const Summary& summary) {
  const Conversation& conversation = summary.conversation;
  const Counting& counting = summary.counting;
  Json captures = Json::array();
  for (const CaptureInfo& one : conversation.captures) {
    captures.push_back({{"name", one.name},
                        {"packets", one.packets},
                        {"datagrams", one.datagrams},
                        {"merged", one.merged}});
  }
  Json histogram = Json::object();
  for (const auto& [data, datagrams] : counting.data_per_datagram) {
    histogram[std::to_string(data)] = datagrams;
  }
  Json remarks = Json::array();
  for (const Remark& one : conversation.remarks) {
    remarks.push_back({{"what", one.what}, {"count", one.count}, {"first", one.first}});
  }
  Json last_initial = nullptr;
  if (counting.last_initial_ns) last_initial = *counting.last_initial_ns;
  const Json json = {{"captures", captures},
                     {"first_ns", conversation.first_ns},
                     {"last_ns", conversation.last_ns},
                     {"until_ns", summary.end_ns()},
                     {"last_initial_data_ns", last_initial},
                     {"counts", counts_json(counting.counts)},
                     {"same_host", counts_json(counting.same_host)},
                     {"heartbeats", heartbeats_json(counting.heartbeats)},
                     {"acknacks", acknacks_json(counting.acknacks)},
                     {"multicast_sedp_data", counting.multicast_data},
                     {"unknown_destination", counting.unknown_destination},
                     {"traffic", traffic_json(counting)},
                     {"sizes", sizes_json(counting)},
                     {"data_per_datagram", histogram},
                     {"datagrams", counting.datagrams},
                     {"frames", counting.frames},
                     {"wire_bytes", counting.wire_bytes},
                     {"after_until_datagrams", counting.after_cut},
                     {"missing", missing_json(summary)},
                     {"topology", topology_json(conversation.topology)},
                     {"timeline", timeline_json(summary)},
                     {"remarks", remarks}};
  // Names in a capture are any bytes; what is no UTF-8 is replaced here, not when it is printed.
  return nlohmann::json::parse(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace stormproof::capture
