// The summary as JSON; specs/guide/captures.md explains the keys.
#include <algorithm>

#include "checker/evidence/capture/describe_capture.hpp"
#include "checker/evidence/capture/summary.hpp"
#include "checker/evidence/capture/timeline.hpp"
#include "checker/presentation/json/describe_model.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::capture {

template <class V>
void describe(V& v, const HeartbeatFigures& figures) {
  for (std::size_t k = 0; k < heartbeat_kinds; ++k) {
    v(name_of(static_cast<HeartbeatKind>(k)), figures.by_kind[k]);
  }
  v("no_info_dst", figures.no_info_dst);
  v("behind_data", figures.behind_data);
  v("empty", figures.empty);
  v("final", figures.final_flag);
}

template <class V>
void describe(V& v, const AcknackFigures& figures) {
  v("initial", figures.initial);
  v("negative", figures.negative);
  v("positive", figures.positive);
  v("preemptive", figures.preemptive);
  v("final", figures.final_flag);
  v("requested", figures.requested);
}

template <class V>
void describe(V& v, const TrafficFigures& figures) {
  v("data", figures.data);
  v("data_frag", figures.data_frag);
  v("heartbeat", figures.heartbeat);
  v("acknack", figures.acknack);
  v("gap", figures.gap);
  v("bytes", figures.bytes);
}

template <class V>
void describe(V& v, const SizeFigures& figures) {
  v("submessage_bytes", figures.submessage_bytes);
  v("single_payload_bytes", figures.single);
}

namespace {

struct NamedEndpoint {
  EntityId entity = 0;
  const Endpoint& endpoint;
};

template <class V>
void describe(V& v, const NamedEndpoint& one) {
  v("entity", one.entity);
  v("stream", stream_of(one.endpoint.announced_by));
  v("sequence_number", one.endpoint.sequence_number);
  v("topic", one.endpoint.topic);
  v("type", one.endpoint.type);
  v("reliable", one.endpoint.qos.is_reliable);
  v("type_information", one.endpoint.has_type_information);
  v("gone", one.endpoint.is_gone);
  v("first_ns", one.endpoint.first_ns);
}

template <class Addresses>
std::vector<std::string> texts(const Addresses& addresses) {
  std::vector<std::string> list;
  for (const auto& one : addresses) list.push_back(to_string(one));
  return list;
}

/// Missing keys, with GUID prefixes as indices in `topology.participants`.
struct Missing {
  const Topology& topology;
  const Counting& counting;
};

struct NamedKey {
  const Topology& topology;
  const MissingKey& key;
};

template <class V>
void describe(V& v, const NamedKey& one) {
  const auto index = [&](const GuidPrefix& prefix) -> std::optional<std::size_t> {
    const Participant* found = one.topology.find(prefix);
    if (found == nullptr) return std::nullopt;
    return one.topology.index_of(*found);
  };
  v("source", index(one.key.source));
  v("destination", index(one.key.destination));
  v("stream", stream_of(one.key.writer));
  v("sequence_number", one.key.sequence_number);
}

template <class V>
void describe(V& v, const Missing& missing) {
  constexpr std::size_t most = 100;
  v("required", missing.counting.required);
  v("count", missing.counting.missing_count);
  std::vector<NamedKey> keys;
  for (const MissingKey& key : missing.counting.missing) {
    if (keys.size() < most) keys.push_back({missing.topology, key});
  }
  v("descriptors", keys);
}

/// Figures of all kinds of traffic, by name.
struct AllTraffic {
  const Counting& counting;
};

template <class V>
void describe(V& v, const AllTraffic& all) {
  for (const Traffic one : all_traffic) {
    v(name_of(one), all.counting.traffic[static_cast<std::size_t>(one)]);
  }
}

/// Sizes of all classes, by name.
struct AllSizes {
  const Counting& counting;
};

template <class V>
void describe(V& v, const AllSizes& all) {
  const auto names = model::Counts{}.entries();
  for (std::size_t k = 0; k < message_class_count; ++k) v(names[k].name, all.counting.sizes[k]);
}

}  // namespace

template <class V>
void describe(V& v, const Participant& participant) {
  v("guid_prefix", to_string(participant.prefix));
  v("host", participant.host);
  v("vendor", vendor_name(participant.vendor));
  v.or_null("version", participant.version);
  v("name", participant.name);
  v.or_null("machine_id", participant.machine);
  v("first_ns", participant.first_ns);
  v("addresses", texts(participant.addresses));
  v("locators", texts(participant.locators));
  v("publications", participant.announced(entity::publications_writer));
  v("subscriptions", participant.announced(entity::subscriptions_writer));
  std::vector<NamedEndpoint> endpoints;
  for (const auto& [guid, endpoint] : participant.endpoints) {
    endpoints.push_back({guid.entity, endpoint});
  }
  v("endpoints", endpoints);
}

template <class V>
void describe(V& v, const Topology& topology) {
  v("hosts", topology.hosts);
  v("participants", topology.participants);
}

template <class V>
void describe(V& v, const Timeline& line) {
  const auto names = model::Counts{}.entries();
  v("step_ns", line.step_ns);
  for (std::size_t one = 0; one < message_class_count; ++one) {
    std::vector<std::uint64_t> values;
    for (const auto& step : line.steps) values.push_back(step[one]);
    v(names[one].name, values);
  }
}

template <class V>
void describe(V& v, const Summary& summary) {
  constexpr std::size_t steps = 100;
  const Conversation& conversation = summary.conversation;
  const Counting& counting = summary.counting;
  v("captures", conversation.captures);
  v("first_ns", conversation.first_ns);
  v("last_ns", conversation.last_ns);
  v("until_ns", summary.end_ns());
  v("last_initial_data_ns", counting.last_initial_ns);
  v("counts", counting.counts);
  v("same_host", counting.same_host);
  v("heartbeats", counting.heartbeats);
  v("acknacks", counting.acknacks);
  v("multicast_sedp_data", counting.multicast_data);
  v("unknown_destination", counting.unknown_destination);
  v("lookups", Lookups{counting});
  v("traffic", AllTraffic{counting});
  v("sizes", AllSizes{counting});
  v("data_per_datagram", counting.data_per_datagram);
  v("datagrams", counting.datagrams);
  v("frames", counting.frames);
  v("wire_bytes", counting.wire_bytes);
  v("statistics_bytes", counting.statistics_bytes);
  v("after_until_datagrams", counting.after_cut);
  v("missing", Missing{conversation.topology, counting});
  v("topology", conversation.topology);
  v("timeline", timeline(conversation, counting, summary.end_ns(), steps));
  v("remarks", conversation.remarks);
}

nlohmann::ordered_json to_json(const Summary& summary) { return report::json_of(summary); }

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<Summary>(definitions);
}

}  // namespace stormproof::capture
