// The report for scripts; specs/guide/validating.md explains the keys.
#include "checker/evidence/validate/validate.hpp"
#include "checker/presentation/json/schema.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::validate {

template <class V>
void describe(V& v, const CapturedParticipant& one) {
  v("host", one.host);
  v("publications", one.publications);
  v("subscriptions", one.subscriptions);
  v("start_ns", one.start);
  v("announced", one.announced);
  v("on_link", one.is_seen);
  v("last_creation_ns", std::pair{one.created_earliest, one.created_latest});
  v("unevenness_ns", one.unevenness);
  v("creations_seen", one.creations_seen);
}

template <class V>
void describe(V& v, const Difference& difference) {
  v("id", difference.id);
  v("count", difference.count);
  v("text", difference.text);
}

namespace {

/// Median and range of the model's runs.
struct Range {
  const Row& row;
};

template <class V>
void describe(V& v, const Range& range) {
  v("median", range.row.median);
  v("p5", range.row.low);
  v("p95", range.row.high);
}

/// How many runs there were, and how they were drawn.
struct Runs {
  const Report& report;
};

template <class V>
void describe(V& v, const Runs& runs) {
  const Sampling& sampling = runs.report.request.sampling;
  v("wanted", runs.report.wanted);
  v("runs", runs.report.runs);
  v("completed", runs.report.complete);
  v("seed", sampling.first_seed);
  v("loss", sampling.loss);
  v("drawn", runs.report.is_drawn);
}

/// What the model's runs waited for.
struct WaitedFor {
  const Limiting& limiting;
};

template <class V>
void describe(V& v, const WaitedFor& waited) {
  v("limited_by", waited.limiting.limit);
  v("air_share", waited.limiting.median.air);
  v("sender_share", waited.limiting.median.sender);
  v("processor_share", waited.limiting.median.processor);
}

struct Missing {
  const capture::Counting& counting;
};

template <class V>
void describe(V& v, const Missing& missing) {
  v("required", missing.counting.required);
  v("count", missing.counting.missing_count);
}

/// One curve of the growth, observed and predicted.
struct Curve {
  const Report& report;
  std::size_t number = 0;
};

template <class V>
void describe(V& v, const Curve& curve) {
  std::vector<std::uint64_t> observed;
  for (const GrowthPoint& point : curve.report.observation.growth.points) {
    observed.push_back(point[curve.number]);
  }
  v("observed", observed);
  const auto bands = [&](const char* key, double Band::*value) {
    std::vector<double> values;
    for (const auto& band : curve.report.bands) values.push_back(band[curve.number].*value);
    v(key, values);
  };
  bands("median", &Band::median);
  bands("p5", &Band::low);
  bands("p95", &Band::high);
}

struct OverTime {
  const Report& report;
};

template <class V>
void describe(V& v, const OverTime& all) {
  v("step_ns", all.report.observation.growth.step_ns);
  for (std::size_t curve = 0; curve < growth_curves; ++curve) {
    v(name_of(figure_of_curve(curve)), Curve{all.report, curve});
  }
}

}  // namespace

template <class V>
void describe(V& v, const Row& row) {
  // What is observed are counts and nanoseconds: whole numbers.
  const auto whole = [](double value) { return static_cast<std::uint64_t>(value); };
  v("observed", row.observed ? std::optional{whole(*row.observed)} : std::nullopt);
  v("model", Range{row});
  v("ratio", row.ratio);
  v("observation", row.position);
}

namespace {

struct ReportWithHeading {
  const Report& report;
  const Heading& heading;
};

template <class V>
void describe(V& v, const ReportWithHeading& shown) {
  const Report& report = shown.report;
  const Observation& observation = report.observation;
  nlohmann::ordered_map<std::string, Row> figures;
  for (const Row& row : report.rows) {
    if (is_shown(report, row.figure)) figures[name_of(row.figure)] = row;
  }
  v("captures", shown.heading.captures);
  v("cut", observation.cut == Cut::given ? "given" : "last_initial");
  v("first_announcement_ns", observation.deployment.zero_ns);
  v("cut_ns", observation.cut_ns);
  v("completed", observation.complete);
  v("missing", Missing{observation.counting});
  v("participants", observation.deployment.participants);
  v("sampling", Runs{report});
  v("usual_hosts", report.usual_hosts);
  v("figures", figures);
  v("waited_for", WaitedFor{report.limiting});
  v("within", report.request.within);
  v("verdict", report.agreement);
  v("over_time", OverTime{report});
  v("differences", report.differences);
  v.unless_empty("unmodelled", report.scenario.dds.unmodelled);
  v.as_in("profile", "../scenario.schema.json", model::config::effective_json(report.scenario));
}

}  // namespace

nlohmann::ordered_json to_json(const Report& report, const Heading& heading) {
  return report::json_of(ReportWithHeading{report, heading});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<ReportWithHeading>(definitions);
}

}  // namespace stormproof::validate
