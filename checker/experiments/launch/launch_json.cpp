// Everything the report knows, but the single runs.
#include "checker/experiments/launch/launch_report.hpp"
#include "checker/experiments/statistics/quantiles_json.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::launch {

namespace {

struct CellOf {
  const Setting& setting;
  const Cell& cell;
};

template <class V>
void describe(V& v, const CellOf& shown) {
  v("setting", shown.setting.id);
  v("runs", shown.cell.runs.size());
  v("storms", shown.cell.storms);
  v("incomplete", shown.cell.incomplete);
  v("t_disc_ns", shown.cell.completion);
  v("messages", shown.cell.messages);
}

struct RowOf {
  const Row& row;
  const Report& report;
};

template <class V>
void describe(V& v, const RowOf& shown) {
  std::vector<CellOf> cells;
  for (std::size_t s = 0; s < shown.row.cells.size(); ++s) {
    cells.push_back({shown.report.settings[s], shown.row.cells[s]});
  }
  v("plan", std::string_view{name_of(shown.row.plan.order)});
  v("step_ns", shown.row.plan.step);
  v("sentence", words_of(shown.row.plan));
  v("last_start_ns", shown.row.last_start);
  v("by_setting", cells);
}

struct SettingOf {
  const Setting& setting;
};

template <class V>
void describe(V& v, const SettingOf& shown) {
  v("id", shown.setting.id);
  v("name", shown.setting.name);
  v("proved_free_of_storms", shown.setting.proved);
  v.or_null("why", shown.setting.why);
}

struct JoinOf {
  const Setting& setting;
  const Join& join;
};

template <class V>
void describe(V& v, const JoinOf& shown) {
  v("setting", shown.setting.id);
  v("runs", shown.join.runs);
  v("t_disc_ns", shown.join.took);
  v("messages", shown.join.messages);
  v("between_others", shown.join.others);
}

struct ReportOf {
  const Report& report;
  const Request& request;
  const std::vector<std::string>& written;
};

template <class V>
void describe(V& v, const ReportOf& shown) {
  const Report& report = shown.report;
  std::vector<SettingOf> settings;
  std::vector<RowOf> rows;
  std::vector<JoinOf> joins;
  for (const Setting& setting : report.settings) settings.push_back({setting});
  for (const Row& row : report.rows) rows.push_back({row, report});
  for (std::size_t s = 0; s < report.joins.size(); ++s) {
    joins.push_back({report.settings[s], report.joins[s]});
  }
  const auto best = report.best();
  v("scenario", shown.request.scenario);
  v("limit_ns", shown.request.limit);
  v("wanted", shown.request.samples);
  v("seed", shown.request.seed);
  v("start_jitter_ns", shown.request.start_jitter);
  v("usual_hosts", report.usual_hosts);
  v("settings", settings);
  v("plans", rows);
  v("best_plan", best ? std::optional{best->row} : std::nullopt);
  v("best_setting", best ? std::optional{report.settings[best->setting].id} : std::nullopt);
  v("joins", joins);
  v("written_files", shown.written);
}

}  // namespace

nlohmann::ordered_json to_json(const Report& report, const Request& request,
                               const std::vector<std::string>& written) {
  return report::json_of(ReportOf{report, request, written});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<ReportOf>(definitions);
}

}  // namespace stormproof::launch
