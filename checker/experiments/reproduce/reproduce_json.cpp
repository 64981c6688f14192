// The report as JSON.
#include <cmath>

#include "checker/experiments/reproduce/measures.hpp"
#include "checker/experiments/reproduce/reproduce_report.hpp"
#include "checker/presentation/json/schema.hpp"
#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/knobs/wireless_knobs.hpp"

namespace stormproof::reproduce {

template <class V>
void describe(V& v, const Variant& variant) {
  v("id", variant.id);
  v("title", variant.title);
  v("start", variant.staggered ? "drawn" : "simultaneous");
  v("runs", variant.runs);
}

template <class V>
void describe(V& v, const Run& run) {
  v("t_disc_ns", run.completion);
}

namespace {

std::vector<std::string> reason_texts(const Report& report,
                                      const std::vector<std::size_t>& positions) {
  std::vector<std::string> texts;
  for (const std::size_t k : positions) texts.push_back(report.published.reasons[k].text);
  return texts;
}

std::optional<std::int64_t> in_ns(std::optional<double> seconds) {
  if (!seconds) return std::nullopt;
  return std::llround(*seconds * 1e9);
}

struct ModelOfVariant {
  const Report& report;
  const Variant& variant;
  const ModelValue& model;
};

template <class V>
void describe(V& v, const ModelOfVariant& one) {
  v("variant", one.variant.id);
  v("values", one.model.values);
  v("ratios", one.model.ratios);
  v("verdict", one.model.agreement);
  v("reasons", reason_texts(one.report, one.model.reasons));
}

struct FigureOfReport {
  const Report& report;
  const Figure& figure;
};

template <class V>
void describe(V& v, const FigureOfReport& one) {
  const Figure& figure = one.figure;
  std::vector<ModelOfVariant> models;
  for (std::size_t k = 0; k < figure.models.size(); ++k) {
    models.push_back({one.report, one.report.results.plan.variants[k], figure.models[k]});
  }
  v("id", figure.published.id);
  v("published", figure.published.values);
  v("unit", figure.published.unit);
  v("kind", figure.kind);
  v("quantity", figure.quantity);
  v("models", models);
  v("reasons", reason_texts(one.report, figure.reasons));
}

struct MeanCounts {
  const Outcome& outcome;
};

template <class V>
void describe(V& v, const MeanCounts& means) {
  for (const Class one : table_classes) v(name_of(one), means.outcome.messages(one));
  v("spdp_multicast", means.outcome.messages(Class::spdp_multicast));
  v("spdp_unicast", means.outcome.messages(Class::spdp_unicast));
}

struct CaseOfReport {
  const Variant& variant;
  const Case& which;
  const Outcome& outcome;
};

template <class V>
void describe(V& v, const CaseOfReport& one) {
  const Case& which = one.which;
  v("variant", one.variant.id);
  v("network", which.network);
  v("heartbeat_policy", model::config::name_of(which.policy));
  v("order", model::config::name_of(which.order));
  v("participants_per_host", which.configuration.participants_per_host);
  v("endpoints_per_participant", which.configuration.endpoints_per_participant);
  v("runs", one.outcome.runs.size());
  v("completed", one.outcome.completed());
  v("t_disc_ns", in_ns(one.outcome.completion_s()));
  v("samples", one.outcome.runs);
  v("counts", MeanCounts{one.outcome});
}

/// Of a variant.
struct ConfigurationOf {
  const Report& report;
  std::size_t variant = 0;
  const Configuration& configuration;
};

struct ReferenceCounts {
  const ConfigurationOf& of;
};

template <class V>
void describe(V& v, const ReferenceCounts& counts) {
  const Measures measures{counts.of.report.results};
  for (const Class what : table_classes) {
    v(name_of(what), measures.reference_messages(counts.of.variant, what, counts.of.configuration));
  }
}

struct LoopbackCounts {
  const ConfigurationOf& of;
};

template <class V>
void describe(V& v, const LoopbackCounts& counts) {
  const Measures measures{counts.of.report.results};
  for (const Class what : table_classes) {
    v(name_of(what), measures.loopback_messages(counts.of.variant, what, counts.of.configuration));
  }
}

template <class V>
void describe(V& v, const ConfigurationOf& one) {
  const Measures measures{one.report.results};
  const Plan& plan = one.report.results.plan;
  const Configuration& configuration = one.configuration;
  v("variant", plan.variants[one.variant].id);
  v("participants_per_host", configuration.participants_per_host);
  v("endpoints_per_participant", configuration.endpoints_per_participant);
  v("high_load", plan.high_load(configuration));
  v("open_loop_ns", in_ns(measures.open_loop_s(one.variant, configuration)));
  v("wireless_to_wired", measures.wireless_to_wired(one.variant, configuration));
  v("completion_spread", measures.completion_spread(one.variant, configuration));
  v("message_spread", measures.message_spread(one.variant, Class::total, configuration));
  v("failure_free", ReferenceCounts{one});
  v("loopback_normalised", LoopbackCounts{one});
}

}  // namespace

template <class V>
void describe(V& v, const Report& report) {
  const Plan& plan = report.results.plan;
  std::vector<FigureOfReport> figures;
  for (const Figure& figure : report.figures) figures.push_back({report, figure});
  std::vector<ConfigurationOf> configurations;
  for (std::size_t k = 0; k < plan.variants.size(); ++k) {
    for (const Configuration& one : plan.configurations) configurations.push_back({report, k, one});
  }
  std::vector<CaseOfReport> cases;
  for (const auto& [which, outcome] : report.results.outcomes) {
    cases.push_back({plan.variants[which.variant], which, outcome});
  }
  v("version", report.version);
  v("close_share", close_share);
  v("variants", plan.variants);
  v("published_figures", figures);
  v("configurations", configurations);
  v("cases", cases);
}

static Report example_of(report::Type<Report>) {
  Report report;
  report.results.plan.variants.emplace_back();
  return report;
}

nlohmann::ordered_json to_json(const Report& report) { return report::json_of(report); }

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<Report>(definitions);
}

}  // namespace stormproof::reproduce
