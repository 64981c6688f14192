// The JSON form of a simulation. Times are integers in ns, sizes in bytes; what does not exist is
// null.
#include <map>
#include <variant>

#include "checker/experiments/simulate/samples_json.hpp"
#include "checker/experiments/simulate/simulate_report.hpp"
#include "checker/presentation/json/describe_model.hpp"
#include "checker/presentation/json/schema.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/implementations.hpp"
#include "model/reference.hpp"

namespace stormproof::model {

template <class V>
void describe(V& v, const MissingDescriptor& missing) {
  v("source", missing.source.value);
  v("destination", missing.destination.value);
  v("stream", missing.stream);
  v("descriptor", missing.descriptor.value);
}

template <class V>
void describe(V& v, const LastDelivery& last) {
  describe(v, last.descriptor);
  v("repair", last.repair);
  v("emitted_ns", last.emitted);
  v("admitted_ns", last.admitted);
  v("received_ns", last.received);
}

template <class V>
void describe(V& v, const Latency& latency) {
  v("received_packets", latency.packets);
  v("backlog_sum_ns", latency.backlog_sum);
  v("service_sum_ns", latency.service_sum);
  v("longest_ns", latency.longest);
}

}  // namespace stormproof::model

namespace stormproof::props {

template <class V>
void describe(V& v, const LimitReading& reading) {
  using Number = std::variant<std::uint64_t, double>;
  const auto number = [&](double value) {
    const bool is_ratio = reading.id == "limit.amplification";
    return is_ratio ? Number{value} : Number{static_cast<std::uint64_t>(value)};
  };
  v("limit", number(reading.limit));
  v("reached", reading.reached ? std::optional{number(*reading.reached)} : std::nullopt);
  v("exceeded", reading.exceeded);
}

}  // namespace stormproof::props

namespace stormproof::report {

namespace {

using model::Counts;
using model::RunResult;

std::optional<double> quotient(std::uint64_t value, std::uint64_t base) {
  if (base == 0) return std::nullopt;
  return static_cast<double>(value) / static_cast<double>(base);
}

/// A value for each class of traffic.
template <class V, class Values>
void describe_by_class(V& v, const Values& values) {
  for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
    v(name_of(static_cast<model::TrafficClass>(k)), values[k]);
  }
}

struct BusyByClass {
  const model::ChannelUse& channel;
};

template <class V>
void describe(V& v, const BusyByClass& one) {
  describe_by_class(v, one.channel.busy);
}

struct LatencyByClass {
  const RunResult& result;
};

template <class V>
void describe(V& v, const LatencyByClass& all) {
  describe_by_class(v, all.result.latency);
}

struct Amplification {
  const Counts& counts;
  const Counts& reference;
};

template <class V>
void describe(V& v, const Amplification& one) {
  const auto values = one.counts.entries();
  const auto bases = one.reference.entries();
  for (std::size_t k = 0; k < values.size(); ++k) {
    v(values[k].name, quotient(values[k].value, bases[k].value));
  }
  v("total", quotient(one.counts.total(), one.reference.total()));
}

struct ChannelOfRun {
  const model::ChannelUse& channel;
  const RunResult& result;
};

template <class V>
void describe(V& v, const ChannelOfRun& one) {
  const std::int64_t busy = one.channel.total_busy().count();
  v("name", one.channel.name);
  v("busy_ns", busy);
  v("busy_share", quotient(static_cast<std::uint64_t>(busy),
                           static_cast<std::uint64_t>(one.result.end_time.count())));
  v("busy_ns_by_class", BusyByClass{one.channel});
}

struct ByClass {
  const std::array<std::uint64_t, model::traffic_class_count>& frames;
};

template <class V>
void describe(V& v, const ByClass& one) {
  describe_by_class(v, one.frames);
}

struct Dropped {
  const model::DroppedFrames& frames;
};

template <class V>
void describe(V& v, const Dropped& dropped) {
  v("stations", ByClass{dropped.frames.at_stations});
  v("access_points", ByClass{dropped.frames.at_access_points});
}

struct BacklogOfParticipant {
  std::size_t participant = 0;
  const model::BacklogPeak& peak;
};

template <class V>
void describe(V& v, const BacklogOfParticipant& one) {
  v("participant", one.participant);
  v("peak_packets", one.peak.packets);
  v("peak_at_ns", one.peak.at);
  v("packets_at_end", one.peak.packets_at_end);
}

struct Missing {
  const RunResult& result;
};

template <class V>
void describe(V& v, const Missing& missing) {
  v("count", missing.result.missing_count);
  v("descriptors", missing.result.missing);
}

struct Deliveries {
  const RunResult& result;
};

template <class V>
void describe(V& v, const Deliveries& deliveries) {
  v("useful", deliveries.result.useful_deliveries);
  v("duplicate", deliveries.result.duplicate_deliveries);
}

/// By name, without "limit.".
std::map<std::string, props::LimitReading> by_name(const std::vector<props::LimitReading>& limits) {
  std::map<std::string, props::LimitReading> all;
  for (const props::LimitReading& reading : limits) {
    all.emplace(reading.id.substr(reading.id.find('.') + 1), reading);
  }
  return all;
}

}  // namespace

Simulation describe(std::string name, const model::Scenario& scenario, model::RunResult result) {
  return {std::move(name), scenario, std::move(result), model::failure_free_reference(scenario),
          model::open_loop_airtime(scenario)};
}

exact::Outlook Simulation::outlook() const {
  if (auto of_samples = trials::outlook_of(samples)) return *std::move(of_samples);
  return exact::Outlook{std::vector{exact::health_of(scenario, result)}};
}

std::optional<model::Bytes> Simulation::fragmented_graph_info() const {
  constexpr model::Bytes frame{1472};  // UDP payload of one unfragmented Ethernet frame
  const model::Bytes bytes = last_graph_info(scenario.deployment);
  if (!model::traits_of(scenario.dds).creates_endpoints_over_time || bytes <= frame) {
    return std::nullopt;
  }
  return bytes;
}

template <class V>
void describe(V& v, const Simulation& s) {
  const RunResult& result = s.result;
  std::vector<ChannelOfRun> channels;
  for (const model::ChannelUse& channel : result.channels) channels.push_back({channel, result});
  std::vector<BacklogOfParticipant> backlog;
  for (const model::BacklogPeak& peak : result.backlog) backlog.push_back({backlog.size(), peak});
  std::optional<double> closed_to_open_loop;
  if (s.open_loop && result.discovery_time) {
    closed_to_open_loop = exact::health_of(s.scenario, result).stretch;
  }
  v("scenario", s.name);
  v("outlook", s.outlook());
  v("completed", result.completed());
  v("end", result.end);
  v("t_disc_ns", result.discovery_time);
  v.unless_empty("recovery_ns", result.recovery_time);
  v.unless_empty("messages_since_last_start", result.messages_since_last_start);
  const std::optional<model::Bytes> graph = s.fragmented_graph_info();
  v.unless_empty("ros_discovery_info_bytes", graph ? std::optional{graph->count()} : std::nullopt);
  v("end_ns", result.end_time);
  v("counts", model::AllCounts{result.counts, result.user_control});
  v("failure_free", s.failure_free);
  v("amplification", Amplification{result.counts, s.failure_free});
  v("user_control", result.user_control);
  v("events", result.events);
  v("open_loop_ns", s.open_loop);
  v("closed_to_open_loop", closed_to_open_loop);
  v.unless_empty("limits", by_name(s.limits));
  v("missing", Missing{result});
  v("channels", channels);
  std::optional<Dropped> dropped;
  if (result.dropped) dropped.emplace(Dropped{*result.dropped});
  v.unless_empty("dropped_frames", dropped);
  v("backlog", backlog);
  v("latency", LatencyByClass{result});
  v("deliveries", Deliveries{result});
  v("last_delivery", result.last_delivery);
  v.unless_empty("samples", s.samples);
  v.unless_empty("summary", s.samples.empty() ? std::nullopt : std::optional{summarize(s.samples)});
  v.unless_empty("unmodelled", s.scenario.dds.unmodelled);
  v.as_in("profile", "../scenario.schema.json", model::config::effective_json(s.scenario));
}

nlohmann::ordered_json to_json(const Simulation& simulation) { return json_of(simulation); }

nlohmann::ordered_json simulation_schema(SchemaDefinitions& definitions) {
  return schema_form<Simulation>(definitions);
}

}  // namespace stormproof::report
