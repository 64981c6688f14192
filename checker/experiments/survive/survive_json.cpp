// Everything the report knows, but the single runs.
#include <string_view>

#include "checker/experiments/statistics/quantiles_json.hpp"
#include "checker/experiments/survive/survive_report.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::survive {

template <class V>
void describe(V& v, const Outcome& outcome) {
  v("failure", std::string_view{name_of(outcome.failure.kind)});
  v("length_ns", outcome.failure.length);
  v("sentence", words_of(outcome.failure));
  v("runs", outcome.runs);
  v("recovered", outcome.recovered);
  v("recovery_ns", outcome.recovery);
  v("lost_pairs", outcome.lost_pairs);
  v("messages", outcome.messages);
}

template <class V>
void describe(V& v, const Attempt& attempt) {
  v("failure", std::string_view{name_of(attempt.failure.kind)});
  v("length_ns", attempt.failure.length);
  v("name", attempt.cure.name);
  v("overrides", attempt.cure.overrides);
  v("why", attempt.cure.source);
  v("runs", attempt.runs);
  v("recovered", attempt.recovered);
  v("recovery_ns", attempt.recovery);
}

template <class V>
void describe(V& v, const Version& version) {
  v("profile_name", version.name);
  v("undiscovered", version.undiscovered);
  v("outcomes", version.outcomes);
  v("attempts", version.attempts);
}

namespace {

struct ReportOf {
  const Report& report;
  const Request& request;
};

template <class V>
void describe(V& v, const ReportOf& shown) {
  v("scenario", shown.request.scenario);
  v("limit_ns", shown.request.limit);
  v("wanted", shown.request.samples);
  v("seed", shown.request.seed);
  v("unsurvived", shown.report.unsurvived());
  v("without_processors", shown.report.without_processors);
  v("not_asked", sentences_of(shown.report.unasked));
  v("versions", shown.report.versions);
}

}  // namespace

nlohmann::ordered_json to_json(const Report& report, const Request& request) {
  return report::json_of(ReportOf{report, request});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<ReportOf>(definitions);
}

}  // namespace stormproof::survive
