// Everything the report knows, but the single runs.
#include "checker/engines/exact/health_json.hpp"
#include "checker/experiments/compare/compare_report.hpp"
#include "checker/experiments/statistics/quantiles_json.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::compare {

namespace {

/// Of one measure, as the rows of `coverage` have it.
struct FitOf {
  Figure figure{};
  Nearness nearness;
};

template <class V>
void describe(V& v, const FitOf& fit) {
  v("measure", std::string_view{key_of(fit.figure)});
  v("median_ratio", fit.nearness.ratio);
  v("median_abs_ln_ratio", fit.nearness.deviation);
}

}  // namespace

template <class V>
void describe(V& v, const Measured& measured) {
  const std::vector<FitOf> fits{{Figure::completion, measured.completion},
                                {Figure::messages, measured.messages}};
  v("what", measured.what);
  v("repeat", measured.command);
  v("configuration_count", measured.configurations);
  v("fits", fits);
}

namespace {

struct CountsOfCell {
  const Cell& cell;
};

template <class V>
void describe(V& v, const CountsOfCell& counts) {
  for (const Figure figure : {Figure::initial_data, Figure::repair_data, Figure::heartbeat,
                              Figure::acknack, Figure::announcements}) {
    v(key_of(figure), counts.cell.figures[static_cast<std::size_t>(figure)]);
  }
  v("total", counts.cell.figures[static_cast<std::size_t>(Figure::messages)]);
}

struct CellInReport {
  const Cell& cell;
};

template <class V>
void describe(V& v, const CellInReport& shown) {
  const Cell& cell = shown.cell;
  v("size", cell.size);
  v("runs", cell.runs.size());
  v("completed", cell.completed);
  v.or_null("sentence", cell.outcome);
  v("breaks", cell.breaks);
  v("t_disc_ns", cell.figures[static_cast<std::size_t>(Figure::completion)]);
  v("counts", CountsOfCell{cell});
  v("user_control", cell.figures[static_cast<std::size_t>(Figure::user_control)]);
  v.or_null("not_run", cell.not_run);
}

struct RowInReport {
  const Row& row;
  const Report& report;
};

template <class V>
void describe(V& v, const RowInReport& shown) {
  const Row& row = shown.row;
  std::vector<CellInReport> cells;
  for (const Cell& cell : row.cells) cells.push_back({cell});
  const auto measured = shown.report.validated.find(row.candidate.measured);
  const bool is_measured = measured != shown.report.validated.end();
  v("id", row.candidate.id);
  v("name", row.candidate.name);
  v("change", row.candidate.change);
  v("preset", row.candidate.profile);
  v("as_it_is", row.candidate.is_own);
  v.or_null("note", row.candidate.note);
  v("breaks_at", row.breaks_at);
  v("by_size", cells);
  v("measured", is_measured ? std::optional{measured->second} : std::nullopt);
  v("written_files", row.files);
}

struct ReportOfRequest {
  const Report& report;
  const Request& request;
};

template <class V>
void describe(V& v, const ReportOfRequest& shown) {
  const Report& report = shown.report;
  std::vector<RowInReport> rows;
  for (const Row& row : report.rows) rows.push_back({row, report});
  v("scenario", shown.request.scenario);
  v("grows", report.grows);
  v("all_sizes", report.sizes);
  v("own_size", report.own_size);
  v("sampled", report.is_sampled);
  v("wanted", report.samples);
  v("seed", shown.request.seed);
  v("limit_ns", report.limit);
  v("candidates", rows);
}

}  // namespace

nlohmann::ordered_json to_json(const Report& report, const Request& request) {
  return report::json_of(ReportOfRequest{report, request});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<ReportOfRequest>(definitions);
}

}  // namespace stormproof::compare
