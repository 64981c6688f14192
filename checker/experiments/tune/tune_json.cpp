// Everything the report knows. Shifts are written as ratios.
#include <cmath>

#include "checker/experiments/statistics/quantiles_json.hpp"
#include "checker/experiments/tune/tune_report.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::tune {

static const char* name_of(Row::Kind kind) {
  switch (kind) {
    case Row::Kind::unchanged:
      return "unchanged";
    case Row::Kind::front:
      return "front";
    case Row::Kind::comparison:
      return "comparison";
  }
  return "";
}

static const char* name_of(Answer answer) {
  switch (answer) {
    case Answer::better:
      return "better";
    case Answer::nothing_better:
      return "nothing_better";
    case Answer::interrupted:
      return "interrupted";
  }
  return "";
}

namespace {

/// A shift of a logarithm.
struct Ratio {
  const Shift& shift;
};

template <class V>
void describe(V& v, const Ratio& ratio) {
  const Shift& shift = ratio.shift;
  v("estimate", std::exp(shift.estimate));
  v("low", std::exp(shift.low));
  v("high", std::exp(shift.high));
  v("confidence", shift.confidence);
  v("exact", shift.exact);
  v("clear", shift.is_less() || shift.is_more());
}

}  // namespace

template <class V>
void describe(V& v, const Difference& difference) {
  v("t_disc_ns", Ratio{difference.completion});
  v("messages", Ratio{difference.messages});
}

template <class V>
void describe(V& v, const Change& change) {
  v("key", change.key);
  v("setting", change.setting);
  v("before", change.before);
  v("after", change.after);
  v("note", change.note);
}

template <class V>
void describe(V& v, const Dimension& d) {
  v("key", d.key);
  v("setting", d.setting);
  v("unchanged", d.print(d.unchanged));
  v("minimum", d.print(d.minimum));
  v("maximum", d.print(d.maximum));
  v("note", d.note);
}

template <class V>
void describe(V& v, const Fixed& fixed) {
  v("key", fixed.key);
  v("why", fixed.why);
}

namespace {

/// SPDP in one.
struct CountsOfRow {
  const Summary& summary;
};

template <class V>
void describe(V& v, const CountsOfRow& counts) {
  const Summary& s = counts.summary;
  v("heartbeat", s.heartbeat);
  v("repair_data", s.repair_data);
  v("acknack", s.acknack);
  v("spdp", s.spdp);
  v("total", s.messages);
}

struct RowInContext {
  const Row& row;
  const Context& context;
};

template <class V>
void describe(V& v, const RowInContext& shown) {
  const Row& row = shown.row;
  const auto file = shown.context.files.find(row.name);
  v("kind", row.kind);
  v("name", row.name);
  v("changes", row.changes);
  v("runs", row.summary.runs);
  v("completed", row.summary.completed);
  v("t_disc_ns", row.summary.completion_ns);
  v("counts", CountsOfRow{row.summary});
  v("against_unchanged", row.against_unchanged);
  v("recommended_against", row.recommended_against);
  v("broken", row.broken);
  v.or_null("note", row.note);
  v.or_null("file", file != shown.context.files.end() ? std::string_view{file->second} : "");
}

struct ReportInContext {
  const Report& report;
  const Context& context;
};

template <class V>
void describe(V& v, const ReportInContext& shown) {
  const Report& report = shown.report;
  const Context& context = shown.context;
  std::vector<RowInContext> rows;
  for (const Row& row : report.rows) rows.push_back({row, context});
  const trials::Unasked::Cut* const cut =
      report.unasked.cuts.empty() ? nullptr : &report.unasked.cuts.front();
  v("scenario", context.scenario);
  v("preset", context.subject.preset);
  v("vendor", context.subject.vendor);
  v("verdict", report.answer);
  v("knobs", report.space.dimensions);
  v("fixed", report.space.fixed);
  v("sampled", report.is_sampled);
  v("seed", report.basis.first);
  v("wanted", report.basis.count);
  v("runs", report.runs);
  v("fitted_into_time", report.unasked.lacked_time());
  v("cut_runs", cut ? cut->runs : 0);
  v("cut_at_ns", cut ? cut->at : model::Nanoseconds{});
  v("not_asked", sentences_of(report.unasked));
  v("compared_until_ns", report.compared_until);
  v("tried", report.settings);
  v("rejected", report.found.rejected);
  v("rejected_by", report.found.rejected_by);
  v("changes_set_back", report.undone);
  v("front_dropped", report.dropped);
  v("kept", report.kept);
  v("not_required", report.not_required);
  v.or_null("recommended",
            report.recommended ? std::string_view{report.rows[*report.recommended].name} : "");
  v("rows", rows);
  v("prerequisites", context.prerequisites);
  v.or_null("repeat", context.repeat);
  v("check_lines", context.check);
  v.unless_empty("unmodelled", context.subject.scenario.dds.unmodelled);
}

}  // namespace

nlohmann::ordered_json to_json(const Report& report, const Context& context) {
  return report::json_of(ReportInContext{report, context});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<ReportInContext>(definitions);
}

}  // namespace stormproof::tune
