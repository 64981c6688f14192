// The JSON form of a simulation. Times are integers in ns, sizes in bytes; what does not exist is
// null.
#include <nlohmann/json.hpp>

#include "checker/experiments/simulate/simulate_report.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "model/config/knobs/effective.hpp"
#include "model/reference.hpp"

namespace stormproof::report {

namespace {

using Json = nlohmann::ordered_json;
using model::Counts;
using model::RunResult;

Json counts_json(const Counts& counts) {
  Json json;
  for (const auto& [name, value] : counts.entries()) json[name] = value;
  json["total"] = counts.total();
  return json;
}

Json amplification_json(const Counts& counts, const Counts& reference) {
  Json json;
  const auto quotient = [](std::uint64_t value, std::uint64_t base) {
    return base == 0 ? Json(nullptr) : Json(static_cast<double>(value) / static_cast<double>(base));
  };
  const auto values = counts.entries();
  const auto bases = reference.entries();
  for (std::size_t k = 0; k < values.size(); ++k) {
    json[values[k].name] = quotient(values[k].value, bases[k].value);
  }
  json["total"] = quotient(counts.total(), reference.total());
  return json;
}

Json descriptor_json(const model::MissingDescriptor& missing) {
  return {{"source", missing.source.value},
          {"destination", missing.destination.value},
          {"stream", name_of(missing.stream)},
          {"descriptor", missing.descriptor.value}};
}

Json missing_json(const RunResult& result) {
  Json list = Json::array();
  for (const auto& missing : result.missing) list.push_back(descriptor_json(missing));
  return {{"count", result.missing_count}, {"descriptors", list}};
}

Json channels_json(const RunResult& result) {
  Json list = Json::array();
  for (const model::ChannelUse& channel : result.channels) {
    Json classes;
    for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
      classes[name_of(static_cast<model::TrafficClass>(k))] = channel.busy[k].count();
    }
    const auto end = static_cast<double>(result.end_time.count());
    const auto busy = static_cast<double>(channel.total_busy().count());
    list.push_back({{"name", channel.name},
                    {"busy_ns", channel.total_busy().count()},
                    {"busy_share", end > 0 ? Json(busy / end) : Json(nullptr)},
                    {"busy_ns_by_class", classes}});
  }
  return list;
}

Json backlog_json(const RunResult& result) {
  Json list = Json::array();
  for (std::size_t i = 0; i < result.backlog.size(); ++i) {
    const model::BacklogPeak& peak = result.backlog[i];
    list.push_back({{"participant", i},
                    {"peak_packets", peak.packets},
                    {"peak_at_ns", peak.at.count()},
                    {"packets_at_end", peak.packets_at_end}});
  }
  return list;
}

Json latency_json(const RunResult& result) {
  Json json;
  for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
    const model::Latency& latency = result.latency[k];
    json[name_of(static_cast<model::TrafficClass>(k))] = {
        {"received_packets", latency.packets},
        {"backlog_sum_ns", latency.backlog_sum.count()},
        {"service_sum_ns", latency.service_sum.count()},
        {"longest_ns", latency.longest.count()}};
  }
  return json;
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

Json last_delivery_json(const RunResult& result) {
  if (!result.last_delivery) return nullptr;
  const model::LastDelivery& last = *result.last_delivery;
  Json json = descriptor_json(last.descriptor);
  json["repair"] = last.repair;
  json["emitted_ns"] = last.emitted.count();
  json["admitted_ns"] = last.admitted.count();
  json["received_ns"] = last.received.count();
  return json;
}

}  // namespace

Simulation describe(std::string name, const model::Scenario& scenario, model::RunResult result) {
  return {std::move(name), scenario, std::move(result), model::failure_free_reference(scenario),
          model::open_loop_airtime(scenario)};
}

Json to_json(const Simulation& s) {
  const RunResult& result = s.result;
  Json json;
  json["scenario"] = s.name;
  json["completed"] = result.completed();
  json["end"] = name_of(result.end);
  json["t_disc_ns"] = result.discovery_time ? Json(result.discovery_time->count()) : Json(nullptr);
  json["end_ns"] = result.end_time.count();
  json["counts"] = counts_json(result.counts);
  json["counts"]["user_control"] = result.user_control;
  json["failure_free"] = counts_json(s.failure_free);
  json["amplification"] = amplification_json(result.counts, s.failure_free);
  json["user_control"] = result.user_control;
  json["events"] = result.events;
  json["open_loop_ns"] = s.open_loop ? Json(s.open_loop->count()) : Json(nullptr);
  json["closed_to_open_loop"] = s.open_loop && result.discovery_time
                                    ? Json(static_cast<double>(result.discovery_time->count()) /
                                           static_cast<double>(s.open_loop->count()))
                                    : Json(nullptr);
  if (!s.limits.empty()) json["limits"] = limits_json(s.limits);
  json["missing"] = missing_json(result);
  json["channels"] = channels_json(result);
  json["backlog"] = backlog_json(result);
  json["latency"] = latency_json(result);
  json["deliveries"] = {{"useful", result.useful_deliveries},
                        {"duplicate", result.duplicate_deliveries}};
  json["last_delivery"] = last_delivery_json(result);
  add_unmodelled(json, s.scenario.dds);
  json["profile"] = model::config::effective_json(s.scenario);
  return json;
}

}  // namespace stormproof::report
