// `profile show` as a document: a row for each knob, its sources below it.
#include <algorithm>

#include <fmt/core.h>

#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/verification/profile/profile_report.hpp"
#include "model/config/shown_path.hpp"

namespace stormproof::report {

namespace vendor = model::config::vendor;

namespace {

/// "robots.xml: for Fast DDS, profile \"arm\", on preset fastdds-2.6.11".
std::string head(const ProfileReport& report) {
  std::string what = report.vendor ? fmt::format("for {}", vendor::name_of(*report.vendor)) : "";
  if (!report.selected.empty()) what += fmt::format(", profile \"{}\"", report.selected);
  if (report.preset.empty()) {
    what += what.empty() ? "on no preset" : ", on no preset";
  } else if (report.preset != report.reference) {
    what += fmt::format("{}on preset {}", what.empty() ? "" : ", ", report.preset);
  }
  return report.reference + (what.empty() ? "" : ": " + what);
}

/// Who set it, in few words.
std::string giver_text(const Origin& origin) {
  switch (origin.giver) {
    case Giver::file:
    case Giver::vendor:
      return model::config::shown_place(origin.place);
    case Giver::override:
      return *origin.place.source;
    case Giver::preset:
      return origin.preset;
    case Giver::model:
      return "default of the model";
  }
  return {};
}

/// Whether a user's own file or argument set it.
bool is_users(const Origin& origin) {
  return origin.giver != Giver::preset && origin.giver != Giver::model;
}

Facts sources_of(const KnobRow& row) {
  Facts facts;
  const auto fact = [&](const char* label, const std::string& text) {
    if (!text.empty()) facts.rows.emplace_back(label, text);
  };
  fact("set in", row.origin.element);
  fact("evidence", row.origin.evidence);
  if (!row.access) return facts;
  const Access& access = *row.access;
  const std::string setting = access.setting == row.origin.element ? "" : access.setting;
  const bool both = !setting.empty() && !access.why.empty();
  fact(access.changeable ? "can set" : "fixed", setting + (both ? "; " : "") + access.why);
  return facts;
}

Table knobs_table(const ProfileReport& report) {
  Table table;
  table.columns = {{"knob"}, {"value"}, {"user"}, {"set by"}};
  for (const KnobRow& row : report.knobs) {
    const char* user = !row.access ? "–" : row.access->changeable ? "yes" : "no";
    Table::Row& shown = table.rows.emplace_back();
    shown.cells = {code(row.key), row.value, user, giver_text(row.origin)};
    shown.marked = is_users(row.origin);
    shown.summary = "evidence";
    Facts facts = sources_of(row);
    if (!facts.rows.empty()) shown.details.emplace_back(std::move(facts));
  }
  return table;
}

void add_settings(Document& document, const ProfileReport& report, vendor::Effect effect,
                  const std::string& title) {
  Bullets list;
  for (const vendor::Setting& setting : report.others) {
    if (setting.effect != effect) continue;
    const std::string value = setting.value.empty() ? "" : " = " + setting.value;
    const std::string note = setting.note.empty() ? "" : ": " + setting.note;
    list.items.push_back(fmt::format("line {}: ", setting.place.line) + code(setting.path) +
                         (value + note));
  }
  if (list.items.empty()) return;
  document.blocks.emplace_back(Section{"In " + report.vendor_file + ": " + title, "", {list}});
}

/// What the vendor's file does not say itself: that is among its settings.
void add_unmodelled(Document& document, const ProfileReport& report) {
  Table table;
  table.columns = {{"setting"}, {"what it would do", Column::Align::left, true}};
  for (const UnmodelledRow& row : report.unmodelled) {
    if (row.origin.giver == Giver::vendor) continue;
    Facts facts;
    facts.rows.emplace_back("named by", giver_text(row.origin));
    if (!row.origin.evidence.empty()) facts.rows.emplace_back("evidence", row.origin.evidence);
    table.rows.push_back({{code(row.setting), row.effect}, false, {facts}, "evidence"});
  }
  if (table.rows.empty()) return;
  document.blocks.emplace_back(Section{unmodelled_heading, "", {std::move(table)}});
}

}  // namespace

Document document_of(const ProfileReport& report) {
  Document document;
  document.title = "stormproof profile show " + report.reference;
  document.answer = head(report);
  if (report.distribution) {
    document.elaboration = model::config::statement_of(*report.distribution) + ".";
  }
  document.blocks.emplace_back(knobs_table(report));
  const auto is_set = [](const KnobRow& row) { return is_users(row.origin); };
  Bullets legend;
  if (std::ranges::any_of(report.knobs, is_set)) {
    legend.items.emplace_back("*, shaded: set by you, not by the preset");
  }
  if (report.vendor) {
    legend.items.emplace_back(
        fmt::format("user: whether a user of {} can set it", vendor::name_of(*report.vendor)));
  }
  if (!legend.items.empty()) document.blocks.emplace_back(std::move(legend));
  add_settings(document, report, vendor::Effect::outside, "the model has no such system");
  add_settings(document, report, vendor::Effect::unknown, "unknown to this version of the library");
  add_settings(document, report, vendor::Effect::unmodelled,
               "not in the model, assumed to make no difference");
  add_settings(document, report, vendor::Effect::none, "no effect on discovery");
  add_unmodelled(document, report);
  if (report.remarks > 0) {
    document.blocks.emplace_back(
        Paragraph{(report.remarks == 1 ? "There is more" : "There are more") +
                  std::string{" to say about this file:"}});
    document.blocks.emplace_back(Command{command_line({"profile", "lint", report.reference})});
  }
  return document;
}

}  // namespace stormproof::report
