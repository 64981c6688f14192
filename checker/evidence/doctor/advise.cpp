// Profiles by version and conformance, the channel by prediction, settings by tuning.
#include "checker/evidence/doctor/advise.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "checker/evidence/capture/library_version.hpp"
#include "checker/evidence/conform/ranking.hpp"
#include "checker/evidence/validate/validate.hpp"
#include "checker/experiments/tune/deploy.hpp"
#include "checker/experiments/tune/tune.hpp"
#include "checker/experiments/tune/tune_report.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/vendor/vendor_knobs.hpp"
#include "model/simulator.hpp"

namespace stormproof::doctor {

namespace {

using model::config::InputError;
using model::config::SpecKind;
using model::config::SpecPath;
namespace vendor = model::config::vendor;

/// Each participant starts up to this much later than captured: the same system on another day.
constexpr model::Nanoseconds another_day{20'000'000};
constexpr std::size_t most_advice = 3;

/// Whether a preset is of a version that what was seen allows.
bool agrees(const std::string& seen, std::pair<unsigned, unsigned> preset) {
  const auto version = capture::version_in(seen);
  if (!version) return true;
  if (seen.find("before") != std::string::npos) return preset < *version;
  if (seen.find("from") != std::string::npos) {
    return preset >= *version && preset.first == version->first;
  }
  return preset.first == version->first;
}

}  // namespace

std::vector<std::string> profiles_of(const Product& product) {
  std::vector<std::string> all;
  std::vector<std::string> of_version;
  for (const std::string& name : SpecPath::standard().names(SpecKind::dds)) {
    const auto whose = vendor::vendor_of_preset(name);
    if (!whose || vendor::name_of(*whose) != product.vendor) continue;
    all.push_back(name);
    const auto version = capture::version_in(name);
    if (version && agrees(product.version, *version)) of_version.push_back(name);
  }
  return of_version.empty() ? all : of_version;
}

void find_presets(const std::vector<std::string>& profiles, const Request& request,
                  Report& report) {
  report.looked_for_presets = true;
  conform::RankingRequest ranking{report.conversation, request.until_ns, {}, {}};
  ranking.each = std::chrono::milliseconds{10'000};
  for (const std::string& name : profiles) {
    const auto dds = model::config::read_dds_profile(name, {}, SpecPath::standard());
    if (dds && !conform::refuse_profile(*dds)) ranking.candidates.push_back({name, *dds});
  }
  if (ranking.candidates.empty()) return;
  ranking.progress = [&](const std::string& name, std::size_t, std::size_t) {
    return !request.on_progress || request.on_progress("does it behave as " + name);
  };
  const auto ranked = conform::rank(ranking);
  if (!ranked) return;  // no discovery between hosts: nothing to hold a profile against
  for (const conform::Ranked& one : ranked->ranked) {
    if (one.result.verdict == conform::Verdict::conforms) report.presets.push_back(one.name);
  }
}

namespace {

/// A profile over a channel, and how far its model is from the capture.
struct Fit {
  Basis basis;
  double distance = 0;  ///< |ln| of both ratios together
  model::Scenario scenario;
};

std::optional<Fit> fit(const std::string& dds, const std::string& wireless, const Request& request,
                       const Report& report) {
  constexpr std::size_t samples = 3;
  validate::Request asked;
  asked.dds = dds;
  asked.wireless = wireless;
  if (report.missing > 0) asked.until_ns = report.conversation.last_ns;
  asked.sampling.samples = samples;
  asked.sampling.threads = request.threads;
  asked.sampling.on_progress = [&](std::size_t, std::size_t) {
    return !request.on_progress || request.on_progress("predict over " + wireless);
  };
  const auto compared = validate::validate(report.conversation, asked);
  if (!compared) return std::nullopt;
  const auto completion = compared->of(validate::Figure::completion).ratio;
  if (!completion || *completion <= 0) return std::nullopt;
  // The comparison ends with the last initial DATA. Repairs go on, and tuning counts them, too.
  const auto whole = model::simulate(compared->scenario).counts.total();
  const double messages = static_cast<double>(whole) / static_cast<double>(report.messages());
  return Fit{{dds, wireless, *completion, messages},
             std::abs(std::log(*completion)) + std::abs(std::log(messages)),
             compared->scenario};
}

std::optional<Fit> nearest(const std::vector<std::string>& profiles, const Request& request,
                           const Report& report) {
  std::vector<std::string> channels{request.wireless};
  if (request.wireless.empty()) channels = SpecPath::standard().names(SpecKind::wireless);
  std::optional<Fit> best;
  for (const std::string& dds : profiles) {
    for (const std::string& wireless : channels) {
      auto tried = fit(dds, wireless, request, report);
      if (tried && (!best || tried->distance < best->distance)) best = std::move(tried);
    }
  }
  return best;
}

Predicted predicted(const tune::Summary& summary) {
  return {summary.completion_ns.median, summary.messages.median};
}

/// The rows that a user can deploy, the shortest discovery first.
std::vector<const tune::Row*> best_rows(const tune::Report& tuned) {
  std::vector<const tune::Row*> rows;
  for (const tune::Row& row : tuned.rows) {
    const bool helps = row.against_unchanged && row.against_unchanged->completion.is_less();
    if (row.point && !row.changes.empty() && row.broken.empty() && helps) rows.push_back(&row);
  }
  std::ranges::stable_sort(rows, {}, [](const tune::Row* row) {
    return row->summary.completion_ns.median.value_or(INFINITY);
  });
  if (rows.size() > most_advice) rows.resize(most_advice);
  return rows;
}

/// What is wrong with the profiles that the request names.
std::optional<InputError> unknown_profile(const Request& request, const SpecPath& specs) {
  if (!request.dds.empty()) {
    const auto dds = model::config::read_dds_profile(request.dds, {}, specs);
    if (!dds) return dds.error();
  }
  if (!request.wireless.empty()) {
    const auto wireless = model::config::read_wireless_profile(request.wireless, {}, specs);
    if (!wireless) return wireless.error();
  }
  return std::nullopt;
}

}  // namespace

namespace {

/// What one run of the model takes, lookups among its messages.
Predicted run_of(const model::Scenario& scenario) {
  const model::RunResult run = model::simulate(scenario);
  Predicted predicted;
  if (run.discovery_time) {
    predicted.completion_ns = static_cast<double>(run.discovery_time->count());
  }
  predicted.messages = static_cast<double>(run.counts.total() + run.counts.lookup);
  return predicted;
}

}  // namespace

void switch_lookups_off(const std::vector<std::string>& profiles, const Request& request,
                        Report& report) {
  const SpecPath specs = SpecPath::standard();
  std::vector<std::string> names = report.presets.empty() ? profiles : report.presets;
  const auto seen = capture::version_in(report.products.front().version);
  std::ranges::stable_partition(
      names, [&](const std::string& name) { return capture::version_in(name) == seen; });
  for (const std::string& name : names) {
    const auto base = model::config::read_dds_profile(name, {}, specs);
    const auto whose = vendor::vendor_of_preset(name);
    if (!base || !whose || base->version.type_lookup == model::Whether::no) continue;
    tune::Subject subject;
    subject.preset = name;
    subject.vendor = *whose;
    subject.base = *base;
    model::DdsProfile without = *base;
    without.version.type_lookup = model::Whether::no;
    const auto xml =
        tune::deployable(subject, without, "Advised by stormproof doctor for " + name, specs);
    if (!xml) continue;
    report.without_lookups =
        Advice{"fastdds.type_propagation = registration_only", {}, {}, *xml, {}};
    auto best = nearest({name}, request, report);
    if (!best || !best->scenario.deployment.types) return;
    report.basis = best->basis;
    report.without_lookups->before = run_of(best->scenario);
    best->scenario.dds.version.type_lookup = model::Whether::no;
    report.without_lookups->after = run_of(best->scenario);
    return;
  }
}

std::optional<InputError> advise(const std::vector<std::string>& profiles, const Request& request,
                                 Report& report) {
  std::vector<std::string> candidates = report.presets.empty() ? profiles : report.presets;
  // Of profiles that all explain the capture, one without a user's settings: those are advice.
  const auto is_plain = [](const std::string& name) { return tune::version_of(name) == name; };
  if (std::ranges::any_of(report.presets, is_plain)) {
    std::erase_if(candidates, [&](const std::string& name) { return !is_plain(name); });
  }
  if (!request.dds.empty()) candidates = {request.dds};
  const SpecPath specs = SpecPath::standard();
  if (auto error = unknown_profile(request, specs)) return error;
  const auto best = nearest(candidates, request, report);
  if (!best) {
    report.no_advice = candidates.empty()
                           ? fmt::format("there is no model of {}", report.products.front().vendor)
                           : "no shipped profile over no shipped channel gives a prediction";
    return std::nullopt;
  }
  report.basis = best->basis;
  tune::Subject subject;
  subject.scenario = best->scenario;
  subject.preset = tune::version_of(best->basis.dds);
  const auto whose = vendor::vendor_of_preset(subject.preset);
  const auto base = model::config::read_dds_profile(subject.preset, {}, specs);
  if (!whose || !base) {
    report.no_advice =
        "its profile is that of no product, so there is nothing that a user could set";
    return std::nullopt;
  }
  subject.vendor = *whose;
  subject.base = *base;
  tune::Options options;
  options.budget = request.budget;
  options.samples = 6;
  options.threads = request.threads;
  options.start_jitter = another_day;
  options.on_progress = [&](std::string_view doing, std::size_t runs, std::size_t about) {
    return !request.on_progress ||
           request.on_progress(fmt::format("{}: {} of about {} runs", doing, runs, about));
  };
  const auto tuned = tune::tune(subject, options);
  if (!tuned) {
    report.no_advice = to_string(tuned.error());
    return std::nullopt;
  }
  report.interrupted = tuned->answer == tune::Answer::interrupted;
  if (!tuned->rows.empty() && tuned->rows.front().summary.messages.median) {
    report.basis->message_ratio =
        *tuned->rows.front().summary.messages.median / static_cast<double>(report.messages());
  }
  for (const tune::Row* row : best_rows(*tuned)) {
    const auto xml = tune::deployable(subject, row->scenario.dds,
                                      "Advised by stormproof doctor for " + subject.preset, specs);
    if (!xml) continue;
    report.advice.push_back({tune::settings_text(*row), predicted(tuned->rows.front().summary),
                             predicted(row->summary), *xml,
                             tune::prerequisites(subject, row->scenario.dds)});
  }
  if (report.advice.empty()) {
    report.no_advice =
        report.interrupted ? "interrupted" : "no setting was found that clearly shortens discovery";
  }
  return std::nullopt;
}

}  // namespace stormproof::doctor
