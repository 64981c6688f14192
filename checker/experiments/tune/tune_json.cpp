// Everything the report knows. Shifts are written as ratios.
#include <cmath>

#include <nlohmann/json.hpp>

#include "checker/experiments/tune/tune_report.hpp"

namespace stormproof::tune {

namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json to_json(const sampling::Quantiles& q) {
  return {{"median", number(q.median)},
          {"p10", number(q.p10)},
          {"p90", number(q.p90)},
          {"min", number(q.min)},
          {"max", number(q.max)}};
}

Json to_json(const Shift& shift) {
  return {{"ratio", std::exp(shift.estimate)},
          {"low", std::exp(shift.low)},
          {"high", std::exp(shift.high)},
          {"confidence", shift.confidence},
          {"exact", shift.exact},
          {"clear", shift.is_less() || shift.is_more()}};
}

Json to_json(const std::optional<Difference>& difference) {
  if (!difference) return {};
  return {{"completion", to_json(difference->completion)},
          {"messages", to_json(difference->messages)}};
}

const char* name_of(Row::Kind kind) {
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

const char* name_of(Answer answer) {
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

Json to_json(const Row& row, const Context& context) {
  Json changes = Json::array();
  for (const Change& change : row.changes) {
    changes.push_back({{"key", change.key},
                       {"setting", change.setting},
                       {"before", change.before},
                       {"after", change.after},
                       {"note", change.note}});
  }
  const Summary& s = row.summary;
  Json json{{"kind", name_of(row.kind)},
            {"name", row.name},
            {"changes", std::move(changes)},
            {"runs", s.runs},
            {"completed", s.completed},
            {"completion_ns", to_json(s.completion_ns)},
            {"messages", to_json(s.messages)},
            {"heartbeat", to_json(s.heartbeat)},
            {"repair_data", to_json(s.repair_data)},
            {"acknack", to_json(s.acknack)},
            {"spdp", to_json(s.spdp)},
            {"against_unchanged", to_json(row.against_unchanged)},
            {"recommended_against", to_json(row.recommended_against)},
            {"broken", row.broken}};
  if (!row.note.empty()) json["note"] = row.note;
  const auto file = context.files.find(row.name);
  json["file"] = file != context.files.end() ? Json(file->second) : Json();
  return json;
}

Json to_json(const Space& space) {
  Json searched = Json::array();
  for (const Dimension& d : space.dimensions) {
    searched.push_back({{"key", d.key},
                        {"setting", d.setting},
                        {"unchanged", model::config::print_quantity(d.unit, d.unchanged)},
                        {"minimum", model::config::print_quantity(d.unit, d.minimum)},
                        {"maximum", model::config::print_quantity(d.unit, d.maximum)},
                        {"note", d.note}});
  }
  Json fixed = Json::array();
  for (const Fixed& f : space.fixed) fixed.push_back({{"key", f.key}, {"why", f.why}});
  return {{"searched", std::move(searched)}, {"fixed", std::move(fixed)}};
}

}  // namespace

Json to_json(const Report& report, const Context& context) {
  Json json{{"scenario", context.scenario},
            {"command", context.command},
            {"preset", context.subject.preset},
            {"vendor", model::config::vendor::name_of(context.subject.vendor)},
            {"answer", name_of(report.answer)},
            {"knobs", to_json(report.space)},
            {"sampled", report.is_sampled},
            {"seeds", {{"first", report.basis.first}, {"count", report.basis.count}}},
            {"runs", report.runs},
            {"settings", report.settings},
            {"rejected", report.found.rejected},
            {"rejected_by", report.found.rejected_by},
            {"changes_set_back", report.undone},
            {"front_dropped", report.dropped},
            {"kept", report.kept},
            {"not_required", report.not_required}};
  json["recommended"] = report.recommended ? Json(report.rows[*report.recommended].name) : Json();
  json["rows"] = Json::array();
  for (const Row& row : report.rows) json["rows"].push_back(to_json(row, context));
  json["prerequisites"] = context.prerequisites;
  json["repeat"] = context.repeat.empty() ? Json() : Json(context.repeat);
  json["check"] = context.check;
  json["unmodelled"] = context.subject.scenario.dds.unmodelled;
  return json;
}

}  // namespace stormproof::tune
