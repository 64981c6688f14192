// The JSON form of a simulation. Times are integers in ns, sizes in bytes; what does not exist is
// null.
#include "checker/experiments/simulate/samples_json.hpp"
#include "checker/experiments/simulate/simulate_report.hpp"
#include "checker/presentation/json/describe.hpp"
#include "checker/presentation/json/describe_model.hpp"
#include "model/config/knobs/effective.hpp"
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

namespace stormproof::report {

namespace {

using Json = nlohmann::ordered_json;
using model::Counts;
using model::RunResult;

std::optional<double> quotient(std::uint64_t value, std::uint64_t base) {
  if (base == 0) return std::nullopt;
  return static_cast<double>(value) / static_cast<double>(base);
}

/// An object with a value for each class of traffic.
template <class Values>
Json by_class(const Values& values) {
  JsonObject v;
  for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
    v(name_of(static_cast<model::TrafficClass>(k)), values[k]);
  }
  return std::move(v).take();
}

Json amplification_json(const Counts& counts, const Counts& reference) {
  JsonObject v;
  const auto values = counts.entries();
  const auto bases = reference.entries();
  for (std::size_t k = 0; k < values.size(); ++k) {
    v(values[k].name, quotient(values[k].value, bases[k].value));
  }
  v("total", quotient(counts.total(), reference.total()));
  return std::move(v).take();
}

Json channels_json(const RunResult& result) {
  Json list = Json::array();
  for (const model::ChannelUse& channel : result.channels) {
    const std::int64_t busy = channel.total_busy().count();
    JsonObject v;
    v("name", channel.name);
    v("busy_ns", busy);
    v("busy_share", quotient(static_cast<std::uint64_t>(busy),
                             static_cast<std::uint64_t>(result.end_time.count())));
    v("busy_ns_by_class", by_class(channel.busy));
    list.push_back(std::move(v).take());
  }
  return list;
}

Json backlog_json(const RunResult& result) {
  Json list = Json::array();
  for (const model::BacklogPeak& peak : result.backlog) {
    JsonObject v;
    v("participant", list.size());
    v("peak_packets", peak.packets);
    v("peak_at_ns", peak.at);
    v("packets_at_end", peak.packets_at_end);
    list.push_back(std::move(v).take());
  }
  return list;
}

/// In ns, messages, a ratio, packets.
Json limits_json(const std::vector<props::LimitReading>& limits) {
  Json json;
  for (const props::LimitReading& reading : limits) {
    const auto number = [&](double value) {
      const bool is_ratio = reading.id == "limit.amplification";
      return is_ratio ? Json(value) : Json(static_cast<std::uint64_t>(value));
    };
    const std::string name{reading.id.substr(reading.id.find('.') + 1)};
    json[name] = {{"limit", number(reading.limit)},
                  {"reached", reading.reached ? number(*reading.reached) : Json(nullptr)},
                  {"exceeded", reading.exceeded}};
  }
  return json;
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

Json to_json(const Simulation& s) {
  const RunResult& result = s.result;
  Json counts = json_of(result.counts);
  counts["user_control"] = result.user_control;
  std::optional<double> closed_to_open_loop;
  if (s.open_loop && result.discovery_time) {
    closed_to_open_loop = exact::health_of(s.scenario, result).stretch;
  }
  JsonObject v;
  v("scenario", s.name);
  v("outlook", s.outlook());
  v("completed", result.completed());
  v("end", result.end);
  v("t_disc_ns", result.discovery_time);
  v("end_ns", result.end_time);
  v("counts", counts);
  v("failure_free", s.failure_free);
  v("amplification", amplification_json(result.counts, s.failure_free));
  v("user_control", result.user_control);
  v("events", result.events);
  v("open_loop_ns", s.open_loop);
  v("closed_to_open_loop", closed_to_open_loop);
  if (!s.limits.empty()) v("limits", limits_json(s.limits));
  v("missing", Json{{"count", result.missing_count}, {"descriptors", json_of(result.missing)}});
  v("channels", channels_json(result));
  v("backlog", backlog_json(result));
  v("latency", by_class(result.latency));
  v("deliveries",
    Json{{"useful", result.useful_deliveries}, {"duplicate", result.duplicate_deliveries}});
  v("last_delivery", result.last_delivery);
  if (!s.samples.empty()) {
    v("samples", s.samples);
    v("summary", summarize(s.samples));
  }
  v.unless_empty("unmodelled", s.scenario.dds.unmodelled);
  v("profile", model::config::effective_json(s.scenario));
  return std::move(v).take();
}

}  // namespace stormproof::report
