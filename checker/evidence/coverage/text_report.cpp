// The text form of a comparison: one table for each profile and scope.
#include <cmath>

#include <fmt/format.h>

#include "checker/evidence/coverage/report.hpp"
#include "checker/presentation/text/assumptions.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::prediction {

namespace {

using report::left;
using report::right;

std::string plain(const std::optional<double>& value, const char* format = "{:.2f}") {
  if (!value) return "–";
  return std::isfinite(*value) ? fmt::format(fmt::runtime(format), *value) : "∞";
}

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

std::string label(Measure measure) {
  return measure == Measure::messages ? "all messages" : words_of(measure);
}

std::string fit_line(const FitRow& row) {
  const Fit& f = row.fit;
  const std::string covered = f.covered_median
                                  ? fmt::format("{} [{}, {}]", plain(f.covered_median),
                                                plain(f.covered_q1), plain(f.covered_q3))
                                  : "–";
  std::string text = "  " + left(label(row.measure), 15);
  text += right(percent(f.coverage), 9) + right(covered, 20);
  text += right(plain(f.median_ratio, "{:.3f}"), 9);
  text += right(plain(f.median_abs_ln_ratio, "{:.3f}"), 11);
  text += right(f.mean_absolute_percent ? plain(f.mean_absolute_percent, "{:.0f} %") : "–", 9);
  text += right(percent(f.in_range), 9);
  text += right(fmt::format("{:.0f}/{:.0f}/{:.0f} %", 100 * f.calibration[0],
                            100 * f.calibration[4], 100 * f.calibration[8]),
                14);
  return text + "\n";
}

std::string fit_table(const ProfileStudy& profile) {
  std::string text;
  std::string scope;
  for (const FitRow& row : profile.rows) {
    const Fit& f = row.fit;
    if (row.scope != scope) {
      scope = row.scope;
      text += fmt::format("\n{}: {} configurations, {} measured runs, {} model runs\n", scope,
                          f.configurations, f.runs, f.model_runs);
      text += "  " + left("", 15) + right("O ≤ M", 9) + right("covered M/O [IQR]", 20) +
              right("M/O", 9) + right("|ln M/O|", 11) + right("MAPE", 9) + right("in range", 9) +
              right("10/50/90 %", 14) + "\n";
    }
    text += fit_line(row);
    if (row.measure == Measure::spdp_unicast && f.incomplete_runs + f.incomplete_model_runs > 0) {
      text += fmt::format("  {} measured and {} model runs did not complete\n", f.incomplete_runs,
                          f.incomplete_model_runs);
    }
  }
  return text;
}

std::string estimate(const RatioEstimate& ratio) {
  return fmt::format("{} [{}, {}]", plain(ratio.median), plain(ratio.low), plain(ratio.high));
}

std::string effect_table(const ProfileStudy& profile, const std::string& baseline) {
  std::string text;
  std::string scope;
  for (const Effect& e : profile.effects) {
    if (e.scope != scope) {
      scope = e.scope;
      text += fmt::format("\n{}, relative to {}: median over {} configurations [90 % interval]\n",
                          scope, baseline, e.predicted.configurations);
      text += "  " + left("", 15) + right("predicted", 22) + right("measured", 22) + "\n";
    }
    text += "  " + left(label(e.measure), 15) + right(estimate(e.predicted), 22) +
            right(e.observed ? estimate(*e.observed) : "–", 22) + "   " + name_of(e.verdict) + "\n";
  }
  return text;
}

constexpr const char* fit_words =
    "O: measured, M: predicted (median of the model runs). Covered: M/O among measured runs with "
    "O ≤ M, median and quartiles. M/O, |ln M/O|: medians over configurations of the ratio of "
    "medians. In range: measured runs between the least and the greatest model run. 10/50/90 %: "
    "share of measured runs up to these quantiles of the model runs.";
constexpr const char* effect_words =
    "Confirmed: both intervals are on the same side of 1, or both contain it, and they overlap. "
    "Direction only: they do not overlap. Open: they overlap, but only one of them contains 1. "
    "Refuted: neither. How well each system fits by itself is in the JSON form.";

std::string profile_text(const ProfileStudy& profile, const Heading& heading,
                         const std::string& baseline) {
  std::string text = fmt::format("\n{}{} on {}: {}\n", profile.name,
                                 profile.is_baseline ? " (baseline)" : "", heading.wireless,
                                 profile.sampled ? fmt::format("{} schedules each, from seed {}",
                                                               heading.samples, heading.first_seed)
                                                 : "one run each");
  for (const auto& [difference, runs] : profile.skipped) {
    text +=
        fmt::format("skipped: {} runs with {}, which is not of this profile\n", runs, difference);
  }
  if (profile.configurations.empty()) text += "nothing to predict\n";
  text += baseline.empty() ? fit_table(profile) : effect_table(profile, baseline);
  return text + report::unmodelled_text(profile.dds);
}

}  // namespace

std::string to_text(const Heading& heading, const Study& study) {
  std::string text = fmt::format("{}: {} measured runs", heading.observations, heading.rows);
  if (heading.not_selected > 0) text += fmt::format(", {} not selected", heading.not_selected);
  text += "\n";
  if (study.interrupted) text += "interrupted: only the runs that finished are evaluated\n";
  const ProfileStudy& last = study.profiles.back();
  const std::string baseline = last.is_baseline ? last.name : "";
  for (const ProfileStudy& profile : study.profiles)
    text += profile_text(profile, heading, baseline);
  text += "\n" + report::paragraph("", baseline.empty() ? fit_words : effect_words);
  return text + "\nreproduce: " + heading.command + "\n";
}

}  // namespace stormproof::prediction
