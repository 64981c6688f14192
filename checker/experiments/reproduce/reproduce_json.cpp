// The report as JSON.
#include <cmath>

#include <nlohmann/json.hpp>

#include "checker/experiments/reproduce/measures.hpp"
#include "checker/experiments/reproduce/reproduce_report.hpp"
#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/knobs/wireless_knobs.hpp"

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
                    {"heartbeat_policy", model::config::name_of(which.policy)},
                    {"order", model::config::name_of(which.order)},
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
  ordered_json counts;
  for (const Class one : table_classes) counts[name_of(one)] = number(outcome.messages(one));
  counts["spdp_multicast"] = number(outcome.messages(Class::spdp_multicast));
  counts["spdp_unicast"] = number(outcome.messages(Class::spdp_unicast));
  json["counts"] = std::move(counts);
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

}  // namespace stormproof::reproduce
