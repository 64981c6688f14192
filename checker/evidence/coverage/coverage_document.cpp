// The comparison for people: a section for each profile, in it a table for each scope and the
// charts.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "checker/evidence/coverage/report.hpp"
#include "checker/experiments/trials/usual_hosts.hpp"
#include "checker/presentation/document/unmodelled.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::prediction {

namespace {

using report::Column;
using report::Paragraph;
using report::Section;
using report::Table;

constexpr auto to_the_right = Column::Align::right;

std::string plain(const std::optional<double>& value, int decimals = 2) {
  if (!value) return "–";
  return std::isfinite(*value) ? fmt::format("{:.{}f}", *value, decimals) : "∞";
}

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

std::string label(Measure measure) {
  return measure == Measure::messages ? "all messages" : words_of(measure);
}

/// Whether something happened in measured runs that say their own start times.
bool is_changed(const ProfileStudy& profile) {
  return std::ranges::any_of(profile.rows,
                             [](const FitRow& row) { return row.fit.near.has_value(); });
}

Table fit_table(const FitRow& first, bool is_changed) {
  const Fit& fit = first.fit;
  Table table{{{""},
               {"O ≤ M", to_the_right},
               {"covered M/O [IQR]", to_the_right},
               {"M/O", to_the_right},
               {"|ln M/O|", to_the_right},
               {"MAPE", to_the_right},
               {"in range", to_the_right},
               {"10/50/90 %", to_the_right}},
              {},
              fmt::format("{}: {}, {}, {}", first.scope,
                          report::plural(fit.configurations, "configuration"),
                          report::plural(fit.runs, "measured run"),
                          report::plural(fit.model_runs, "model run"))};
  if (is_changed) table.columns.push_back({"near", to_the_right});
  return table;
}

Table::Row fit_row(const FitRow& row, bool is_changed) {
  const Fit& f = row.fit;
  Table::Row cells{{label(row.measure), percent(f.coverage),
                    f.covered_median ? fmt::format("{} [{}, {}]", plain(f.covered_median),
                                                   plain(f.covered_q1), plain(f.covered_q3))
                                     : "–",
                    plain(f.median_ratio, 3), plain(f.median_abs_ln_ratio, 3),
                    f.mean_absolute_percent ? plain(f.mean_absolute_percent, 0) + " %" : "–",
                    percent(f.in_range),
                    fmt::format("{:.0f}/{:.0f}/{:.0f} %", 100 * f.calibration[0],
                                100 * f.calibration[4], 100 * f.calibration[8])}};
  if (is_changed) cells.cells.emplace_back(f.near ? percent(*f.near) : "–");
  return cells;
}

void add_fits(report::Blocks& blocks, const ProfileStudy& profile) {
  for (std::size_t k = 0; k < profile.rows.size();) {
    const FitRow& first = profile.rows[k];
    Table table = fit_table(first, is_changed(profile));
    std::size_t incomplete = 0;
    std::size_t incomplete_model = 0;
    for (; k < profile.rows.size() && profile.rows[k].scope == first.scope; ++k) {
      const FitRow& row = profile.rows[k];
      table.rows.push_back(fit_row(row, is_changed(profile)));
      if (row.measure != Measure::spdp_unicast) continue;
      incomplete = row.fit.incomplete_runs;
      incomplete_model = row.fit.incomplete_model_runs;
    }
    blocks.emplace_back(std::move(table));
    if (incomplete + incomplete_model == 0) continue;
    blocks.emplace_back(Paragraph{fmt::format(
        "{} measured and {} model runs did not complete; where one that was measured did not, the "
        "model's end at its limit, too",
        incomplete, incomplete_model)});
  }
}

std::string estimate(const RatioEstimate& ratio) {
  return fmt::format("{} [{}, {}]", plain(ratio.median), plain(ratio.low), plain(ratio.high));
}

void add_effects(report::Blocks& blocks, const ProfileStudy& profile, const std::string& baseline) {
  for (std::size_t k = 0; k < profile.effects.size();) {
    const Effect& first = profile.effects[k];
    Table table{
        {{""}, {"predicted", to_the_right}, {"measured", to_the_right}, {"verdict"}},
        {},
        fmt::format("{}, relative to {}: median over {} [90 % interval]", first.scope, baseline,
                    report::plural(first.predicted.configurations, "configuration"))};
    for (; k < profile.effects.size() && profile.effects[k].scope == first.scope; ++k) {
      const Effect& effect = profile.effects[k];
      table.rows.push_back(
          {{label(effect.measure), estimate(effect.predicted),
            effect.observed ? estimate(*effect.observed) : "–", name_of(effect.verdict)}});
    }
    blocks.emplace_back(std::move(table));
  }
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

Section section_of(const ProfileStudy& profile, const Heading& heading,
                   const std::string& baseline) {
  Section section{fmt::format(
      "{}{} on {}: {}", profile.name, profile.is_baseline ? " (baseline)" : "", heading.wireless,
      profile.sampled
          ? fmt::format("{} schedules each, from seed {}", heading.samples, heading.first_seed)
          : "one run each")};
  if (profile.measured_starts > 0) {
    section.blocks.emplace_back(
        Paragraph{fmt::format("participants start as they did in {}",
                              report::plural(profile.measured_starts, "measured run"))});
  }
  if (profile.spread > 0) {
    section.blocks.emplace_back(Paragraph{fmt::format(
        "programs take processor time where starts are spread, in {}: {} unless --set hosts=… says "
        "otherwise",
        report::plural(profile.spread, "configuration"), trials::usual_hosts)});
  }
  report::Bullets skipped;
  for (const auto& [difference, runs] : profile.skipped) {
    skipped.items.emplace_back(fmt::format("skipped: {} with {}, which this does not predict",
                                           report::plural(runs, "run"), difference));
  }
  if (!skipped.items.empty()) section.blocks.emplace_back(std::move(skipped));
  if (profile.configurations.empty()) section.blocks.emplace_back(Paragraph{"nothing to predict"});
  for (ChartFile& chart : charts(profile)) {
    section.blocks.emplace_back(report::Drawing{std::move(chart.svg), ""}, report::Audience::page);
  }
  if (baseline.empty()) {
    add_fits(section.blocks, profile);
  } else {
    add_effects(section.blocks, profile, baseline);
  }
  return section;
}

const Fit* overall(const ProfileStudy& profile, Measure measure) {
  for (const FitRow& row : profile.rows) {
    if (row.measure == measure && row.scope == profile.overall_scope()) return &row.fit;
  }
  return nullptr;
}

/// One row for each profile and measure: how good it is over all configurations.
Table summary(const Study& study) {
  Table table{{{"profile"},
               {"measure"},
               {"median ratio", to_the_right},
               {"median |ln ratio|", to_the_right},
               {"in range", to_the_right}},
              {}};
  for (const ProfileStudy& profile : study.profiles) {
    std::string name = profile.name;
    for (const Measure measure : {Measure::completion, Measure::messages, Measure::recovery}) {
      const Fit* const fit = overall(profile, measure);
      if (fit == nullptr) continue;
      table.rows.push_back(
          {{std::exchange(name, ""), label(measure), plain(fit->median_ratio, 3),
            plain(fit->median_abs_ln_ratio, 3), profile.sampled ? percent(fit->in_range) : "–"}});
    }
  }
  return table;
}

/// The profile whose completion is off least, in words.
std::string best_fit(const Study& study) {
  const ProfileStudy* best = nullptr;
  double least = 0;
  for (const ProfileStudy& profile : study.profiles) {
    const Fit* const fit = overall(profile, Measure::completion);
    if (fit == nullptr || !fit->median_abs_ln_ratio || !fit->median_ratio) continue;
    if (best != nullptr && *fit->median_abs_ln_ratio >= least) continue;
    best = &profile;
    least = *fit->median_abs_ln_ratio;
  }
  if (best == nullptr) return "";
  const double ratio = *overall(*best, Measure::completion)->median_ratio;
  return fmt::format(
      "{}{} predicts completion to within {:.0f} % at the median; its times are {:.2f} × the "
      "measured ones",
      best->name, study.profiles.size() > 1 ? " fits best: it" : "", 100 * (std::exp(least) - 1),
      ratio);
}

}  // namespace

report::Document document_of(const Heading& heading, const Study& study) {
  const ProfileStudy& last = study.profiles.back();
  const std::string baseline = last.is_baseline ? last.name : "";
  report::Document document;
  document.title = "stormproof coverage " + heading.observations;
  const std::string runs = fmt::format(
      "{}: {}{}", heading.observations, report::plural(heading.rows, "measured run"),
      heading.not_selected > 0 ? fmt::format(", {} not selected", heading.not_selected) : "");
  const std::string best = baseline.empty() ? best_fit(study) : "";
  document.answer = best.empty() ? runs : best;
  if (!best.empty()) {
    document.subject = runs;
    document.tone = report::Tone::info;
    document.blocks.emplace_back(summary(study));
  }
  if (study.interrupted) {
    document.elaboration = "interrupted: only the runs that finished are evaluated";
    document.tone = report::Tone::warn;
  }
  for (const ProfileStudy& profile : study.profiles) {
    document.blocks.emplace_back(section_of(profile, heading, baseline));
  }
  document.blocks.emplace_back(Paragraph{baseline.empty() ? fit_words : effect_words});
  for (const ProfileStudy& profile : study.profiles) {
    report::add_unmodelled(document, profile.dds, {profile.name});
  }
  document.complete = !study.interrupted;
  return document;
}

}  // namespace stormproof::prediction
