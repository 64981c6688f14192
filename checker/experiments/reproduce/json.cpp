// The report as JSON and CSV.
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "checker/experiments/reproduce/measures.hpp"
#include "checker/experiments/reproduce/report.hpp"

namespace stormproof::reproduce {

namespace {

using nlohmann::ordered_json;

ordered_json number(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return nullptr;
  return *value;
}

ordered_json numbers(const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  if (values.size() == 1) return number(values.front());
  ordered_json list = ordered_json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

const char* name_of(model::HeartbeatPolicy policy) {
  return policy == model::HeartbeatPolicy::adaptive ? "adaptive" : "periodic";
}

const char* name_of(model::ServiceOrder order) {
  switch (order) {
    case model::ServiceOrder::fifo_uplink:
      return "fifo_uplink";
    case model::ServiceOrder::fifo_downlink:
      return "fifo_downlink";
    case model::ServiceOrder::fifo:
      return "fifo";
    case model::ServiceOrder::datagram_uplink:
      return "datagram_uplink";
  }
  return "";
}

ordered_json reason_texts(const Report& report, const std::vector<std::size_t>& positions) {
  ordered_json texts = ordered_json::array();
  for (const std::size_t k : positions) texts.push_back(report.published.reasons[k].text);
  return texts;
}

ordered_json figure_json(const Report& report, const Figure& figure) {
  ordered_json json{{"id", figure.published.id},
                    {"published", numbers(figure.published.values)},
                    {"unit", figure.published.unit},
                    {"kind", name_of(figure.kind)},
                    {"quantity", figure.quantity}};
  ordered_json models = ordered_json::array();
  for (std::size_t v = 0; v < figure.models.size(); ++v) {
    const ModelValue& model = figure.models[v];
    ordered_json ratios = ordered_json::array();
    for (const auto& ratio : model.ratios) ratios.push_back(number(ratio));
    ordered_json one{{"variant", report.results.plan.variants[v].id},
                     {"value", numbers(model.values)}};
    one["ratio"] = ratios.empty() ? ordered_json(nullptr) : ratios.size() == 1 ? ratios[0] : ratios;
    one["agreement"] = name_of(model.agreement);
    one["reasons"] = reason_texts(report, model.reasons);
    models.push_back(std::move(one));
  }
  json["models"] = std::move(models);
  json["reasons"] = reason_texts(report, figure.reasons);
  return json;
}

ordered_json case_json(const Report& report, const Case& which, const Outcome& outcome) {
  ordered_json json{{"variant", report.results.plan.variants[which.variant].id},
                    {"network", name_of(which.network)},
                    {"heartbeat_policy", name_of(which.policy)},
                    {"order", name_of(which.order)},
                    {"participants_per_host", which.configuration.participants_per_host},
                    {"endpoints_per_participant", which.configuration.endpoints_per_participant},
                    {"runs", outcome.runs.size()},
                    {"completed", outcome.completed()},
                    {"completion_s", number(outcome.completion_s())}};
  ordered_json times = ordered_json::array();
  for (const Run& run : outcome.runs) {
    times.push_back(run.completion ? ordered_json(run.completion->count()) : ordered_json(nullptr));
  }
  json["t_disc_ns"] = std::move(times);
  ordered_json messages;
  for (const Class one : table_classes) messages[name_of(one)] = number(outcome.messages(one));
  messages["spdp_multicast"] = number(outcome.messages(Class::spdp_multicast));
  messages["spdp_unicast"] = number(outcome.messages(Class::spdp_unicast));
  json["messages"] = std::move(messages);
  return json;
}

ordered_json configuration_json(const Report& report, std::size_t variant,
                                const Configuration& one) {
  const Measures measures{report.results};
  ordered_json json{
      {"variant", report.results.plan.variants[variant].id},
      {"participants_per_host", one.participants_per_host},
      {"endpoints_per_participant", one.endpoints_per_participant},
      {"high_load", report.results.plan.high_load(one)},
      {"open_loop_s", measures.open_loop_s(variant, one)},
      {"wireless_to_wired", number(measures.wireless_to_wired(variant, one))},
      {"completion_spread", number(measures.completion_spread(variant, one))},
      {"message_spread", number(measures.message_spread(variant, Class::total, one))}};
  ordered_json reference;
  ordered_json loopback;
  for (const Class what : table_classes) {
    reference[name_of(what)] = measures.reference_messages(variant, what, one);
    loopback[name_of(what)] = number(measures.loopback_messages(variant, what, one));
  }
  json["failure_free"] = std::move(reference);
  json["loopback_normalised"] = std::move(loopback);
  return json;
}

/// A field of a CSV line.
std::string csv(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string{"\"\""} : std::string{c};
  return quoted + "\"";
}

std::string csv(std::optional<double> value) {
  return value && std::isfinite(*value) ? fmt::format("{:.10g}", *value) : "";
}

}  // namespace

nlohmann::ordered_json to_json(const Report& report) {
  const Plan& plan = report.results.plan;
  ordered_json json{{"command", report.command},
                    {"version", report.version},
                    {"complete", report.results.complete},
                    {"close_share", close_share}};
  json["variants"] = ordered_json::array();
  for (const Variant& variant : plan.variants) {
    json["variants"].push_back({{"id", variant.id},
                                {"title", variant.title},
                                {"start", variant.staggered ? "drawn" : "simultaneous"},
                                {"runs", variant.runs}});
  }
  json["figures"] = ordered_json::array();
  for (const Figure& figure : report.figures) {
    json["figures"].push_back(figure_json(report, figure));
  }
  json["configurations"] = ordered_json::array();
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    for (const Configuration& one : plan.configurations) {
      json["configurations"].push_back(configuration_json(report, v, one));
    }
  }
  json["cases"] = ordered_json::array();
  for (const auto& [which, outcome] : report.results.outcomes) {
    json["cases"].push_back(case_json(report, which, outcome));
  }
  return json;
}

std::string figures_csv(const Report& report) {
  std::string text = "figure,published,unit,kind,variant,model,ratio,agreement,quantity,reasons\n";
  for (const Figure& figure : report.figures) {
    // One line for each number: quartiles have two, lists of sizes more.
    for (std::size_t n = 0; n < figure.published.values.size(); ++n) {
      const std::string id = figure.published.values.size() == 1
                                 ? figure.published.id
                                 : fmt::format("{}.{}", figure.published.id, n);
      for (std::size_t v = 0; v < figure.models.size(); ++v) {
        const ModelValue& model = figure.models[v];
        const bool has = n < model.values.size();
        std::string reasons;
        for (const std::size_t k :
             figure.kind == Kind::unavailable ? figure.reasons : model.reasons) {
          reasons += (reasons.empty() ? "" : " ") + report.published.reasons[k].text;
        }
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", id,
                            csv(std::optional{figure.published.values[n]}), figure.published.unit,
                            name_of(figure.kind), report.results.plan.variants[v].id,
                            csv(has ? std::optional{model.values[n]} : std::nullopt),
                            csv(has ? model.ratios[n] : std::nullopt), name_of(model.agreement),
                            csv(figure.quantity), csv(reasons));
      }
    }
  }
  return text;
}

std::string configurations_csv(const Report& report) {
  const Measures measures{report.results};
  std::string text =
      "variant,network,heartbeat_policy,order,participants_per_host,endpoints_per_participant,runs,"
      "completed,completion_s,fastest_s,slowest_s,spdp,initial_data,repair_data,heartbeat,acknack,"
      "total,open_loop_s,failure_free_total,wireless_to_wired\n";
  for (const auto& [which, outcome] : report.results.outcomes) {
    const Configuration& one = which.configuration;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}",
                        report.results.plan.variants[which.variant].id, name_of(which.network),
                        name_of(which.policy), name_of(which.order), one.participants_per_host,
                        one.endpoints_per_participant, outcome.runs.size(), outcome.completed(),
                        csv(outcome.completion_s()), csv(outcome.fastest_s()),
                        csv(outcome.slowest_s()));
    for (const Class what : table_classes) text += "," + csv(outcome.messages(what));
    const bool wireless = which.network == Network::wireless;
    text += fmt::format(
        ",{},{},{}\n", wireless ? csv(std::optional{measures.open_loop_s(which.variant, one)}) : "",
        csv(std::optional{measures.reference_messages(which.variant, Class::total, one)}),
        wireless ? csv(measures.wireless_to_wired(which.variant, one)) : "");
  }
  return text;
}

}  // namespace stormproof::reproduce
