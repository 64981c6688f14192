// Everything the report knows. Shifts are written as ratios.
#include <cmath>

#include "checker/experiments/statistics/quantiles_json.hpp"
#include "checker/experiments/tune/tune_report.hpp"

namespace stormproof::tune {

using report::json_of;
using Json = nlohmann::ordered_json;

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

static Json ratio_json(const Shift& shift) {
  report::JsonObject v;
  v("ratio", std::exp(shift.estimate));
  v("low", std::exp(shift.low));
  v("high", std::exp(shift.high));
  v("confidence", shift.confidence);
  v("exact", shift.exact);
  v("clear", shift.is_less() || shift.is_more());
  return std::move(v).take();
}

template <class V>
void describe(V& v, const Difference& difference) {
  v("t_disc_ns", ratio_json(difference.completion));
  v("messages", ratio_json(difference.messages));
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
  v("unchanged", model::config::print_quantity(d.unit, d.unchanged));
  v("minimum", model::config::print_quantity(d.unit, d.minimum));
  v("maximum", model::config::print_quantity(d.unit, d.maximum));
  v("note", d.note);
}

template <class V>
void describe(V& v, const Fixed& fixed) {
  v("key", fixed.key);
  v("why", fixed.why);
}

template <class V>
void describe(V& v, const Space& space) {
  v("searched", space.dimensions);
  v("fixed", space.fixed);
}

template <class V>
void describe(V& v, const Seeds& seeds) {
  v("first", seeds.first);
  v("count", seeds.count);
}

namespace {

Json to_json(const Row& row, const Context& context) {
  const Summary& s = row.summary;
  Json counts;
  counts["heartbeat"] = json_of(s.heartbeat);
  counts["repair_data"] = json_of(s.repair_data);
  counts["acknack"] = json_of(s.acknack);
  counts["spdp"] = json_of(s.spdp);
  counts["total"] = json_of(s.messages);
  const auto file = context.files.find(row.name);
  report::JsonObject v;
  v("kind", row.kind);
  v("name", row.name);
  v("changes", row.changes);
  v("runs", s.runs);
  v("completed", s.completed);
  v("t_disc_ns", s.completion_ns);
  v("counts", counts);
  v("against_unchanged", row.against_unchanged);
  v("recommended_against", row.recommended_against);
  v("broken", row.broken);
  v.or_null("note", row.note);
  v.or_null("file", file != context.files.end() ? std::string_view{file->second} : "");
  return std::move(v).take();
}

}  // namespace

Json to_json(const Report& report, const Context& context) {
  Json rows = Json::array();
  for (const Row& row : report.rows) rows.push_back(to_json(row, context));
  report::JsonObject v;
  v("scenario", context.scenario);
  v("preset", context.subject.preset);
  v("vendor", model::config::vendor::name_of(context.subject.vendor));
  v("answer", report.answer);
  v("knobs", report.space);
  v("sampled", report.is_sampled);
  v("seeds", report.basis);
  v("runs", report.runs);
  v("settings", report.settings);
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
  v("check", context.check);
  v.unless_empty("unmodelled", context.subject.scenario.dds.unmodelled);
  return std::move(v).take();
}

}  // namespace stormproof::tune
