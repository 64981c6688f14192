// The text of `profile show`: one block for each knob, the value first and the sources below it.
#include <algorithm>

#include <fmt/format.h>

#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/verification/profile/profile_report.hpp"

namespace stormproof::report {

namespace vendor = model::config::vendor;

namespace {

constexpr std::size_t key_columns = 32;
constexpr std::size_t value_columns = 12;
constexpr std::size_t user_columns = 5;

std::string head(const ProfileReport& report) {
  std::string what = report.vendor ? fmt::format("for {}", vendor::name_of(*report.vendor)) : "";
  if (!report.selected.empty()) what += fmt::format(", profile \"{}\"", report.selected);
  if (report.preset.empty()) {
    what += what.empty() ? "on no preset" : ", on no preset";
  } else if (report.preset != report.reference) {
    what += fmt::format("{}on preset {}", what.empty() ? "" : ", ", report.preset);
  }
  return paragraph("", report.reference + (what.empty() ? "" : ": " + what)) + "\n";
}

/// Who set it, in few words.
std::string giver_text(const Origin& origin) {
  switch (origin.giver) {
    case Giver::file:
    case Giver::vendor:
      return origin.place.to_string();
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

std::string detail(const char* label, const std::string& text) {
  return text.empty() ? "" : paragraph(fmt::format("      {:<10}", label), text);
}

std::string knob_text(const KnobRow& row) {
  const std::string user = !row.access ? "–" : row.access->changeable ? "yes" : "no";
  std::string text =
      fmt::format("{} {} {} {} {}\n", is_users(row.origin) ? '*' : ' ', left(row.key, key_columns),
                  left(row.value, value_columns), left(user, user_columns), giver_text(row.origin));
  text += detail("set in", row.origin.element);
  text += detail("evidence", row.origin.evidence);
  if (!row.access) return text;
  const Access& access = *row.access;
  const std::string setting = access.setting == row.origin.element ? "" : access.setting;
  const bool both = !setting.empty() && !access.why.empty();
  return text +
         detail(access.changeable ? "can set" : "fixed", setting + (both ? "; " : "") + access.why);
}

std::string settings_text(const ProfileReport& report, vendor::Effect effect,
                          const std::string& heading) {
  std::string text;
  for (const vendor::Setting& setting : report.others) {
    if (setting.effect != effect) continue;
    const std::string value = setting.value.empty() ? "" : " = " + setting.value;
    const std::string note = setting.note.empty() ? "" : ": " + setting.note;
    text +=
        paragraph(fmt::format("  - line {}: ", setting.place.line), setting.path + value + note);
  }
  return text.empty() ? "" : fmt::format("\n{}:\n{}", heading, text);
}

/// What the vendor's file does not say itself: that is among its settings.
std::string unmodelled_rows(const ProfileReport& report) {
  std::string text;
  for (const UnmodelledRow& row : report.unmodelled) {
    if (row.origin.giver == Giver::vendor) continue;
    text += paragraph("  - ", fmt::format("{}: {}", row.setting, row.effect));
    text += detail("named by", giver_text(row.origin));
    text += detail("evidence", row.origin.evidence);
  }
  return text.empty() ? "" : fmt::format("\n{}:\n{}", unmodelled_heading, text);
}

}  // namespace

std::string to_text(const ProfileReport& report) {
  std::string text = head(report);
  const bool any =
      std::ranges::any_of(report.knobs, [](const KnobRow& row) { return is_users(row.origin); });
  text += fmt::format("  {} {} {} {}\n", left("knob", key_columns), left("value", value_columns),
                      left("user", user_columns), "set by");
  for (const KnobRow& row : report.knobs) text += knob_text(row);
  text += "\n";
  if (any) text += "* set by you, not by the preset\n";
  if (report.vendor) {
    text += fmt::format("user: whether a user of {} can set it\n", vendor::name_of(*report.vendor));
  }
  const std::string file = "In " + report.vendor_file;
  text += settings_text(report, vendor::Effect::outside, file + ": the model has no such system");
  text += settings_text(report, vendor::Effect::unknown,
                        file + ": unknown to this version of the library");
  text += settings_text(report, vendor::Effect::unmodelled,
                        file + ": not in the model, assumed to make no difference");
  text += settings_text(report, vendor::Effect::none, file + ": no effect on discovery");
  text += unmodelled_rows(report);
  if (report.remarks > 0) {
    text += fmt::format("\n{} more to say about this file: stormproof profile lint {}\n",
                        report.remarks == 1 ? "There is" : "There are", report.reference);
  }
  return text;
}

}  // namespace stormproof::report
