// Size after size, all candidates that have not broken before side by side: the runs of a size fill
// all cores, and what storms is not run again where it only storms worse.
#include "checker/experiments/compare/compare.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "checker/presentation/text/numbers.hpp"
#include "model/config/tree/quantities.hpp"
#include "model/config/vendor/vendor_knobs.hpp"

namespace stormproof::compare {

using model::Nanoseconds;
using model::config::InputError;
using model::config::Result;
using model::config::SpecPath;
using trials::Sample;

namespace {

double value_of(const Sample& run, Figure figure) {
  const model::Counts& counts = run.counts;
  switch (figure) {
    case Figure::completion:
      return statistics::completion_ns(run.discovery_time);
    case Figure::messages:
      return static_cast<double>(counts.total());
    case Figure::initial_data:
      return static_cast<double>(counts.initial_data);
    case Figure::repair_data:
      return static_cast<double>(counts.repair_data);
    case Figure::heartbeat:
      return static_cast<double>(counts.heartbeat);
    case Figure::acknack:
      return static_cast<double>(counts.acknack);
    case Figure::announcements:
      return static_cast<double>(counts.spdp() + counts.of_server());
    case Figure::user_control:
      return static_cast<double>(run.user_control);
  }
  return 0;
}

/// Whether a run is what nobody wants: not complete when it has to be, or a storm.
bool fails(const Sample& run, const model::Scenario& scenario) {
  if (!run.discovery_time) return true;
  if (scenario.limits && scenario.limits->completion) {
    return *run.discovery_time > *scenario.limits->completion;
  }
  return run.health.health == exact::Health::storm;
}

void describe_runs(Cell& cell, const model::Scenario& scenario) {
  for (std::size_t k = 0; k < figure_count; ++k) {
    std::vector<double> values;
    for (const Sample& run : cell.runs) values.push_back(value_of(run, static_cast<Figure>(k)));
    cell.figures[k] = statistics::quantiles(std::move(values));
  }
  cell.completed = static_cast<std::size_t>(std::ranges::count_if(
      cell.runs, [](const Sample& run) { return run.discovery_time.has_value(); }));
  const auto outlook = trials::outlook_of(cell.runs);
  if (!outlook) return;
  cell.outcome = outlook->headline();
  cell.health = outlook->median().health;
  if (cell.interrupted) cell.outcome += fmt::format(", interrupted after {}", cell.runs.size());
  const auto failed = static_cast<std::size_t>(
      std::ranges::count_if(cell.runs, [&](const Sample& run) { return fails(run, scenario); }));
  cell.breaks = !cell.interrupted && 2 * failed >= cell.runs.size();
}

class Comparison {
 public:
  Comparison(const Request& request, const SpecPath& specs)
      : request_{request},
        specs_{specs},
        runner_{request.threads, [this](std::size_t runs, std::size_t) {
                  return !request_.on_progress ||
                         request_.on_progress(doing_, runs, std::max(runs, about_));
                }} {}

  Result<Report> run() {
    auto candidates = candidates_of(request_.scenario, request_.overrides, specs_);
    if (!candidates) return candidates.error();
    report_.candidates = *std::move(candidates);
    auto validated = read_validated(specs_.directories);
    if (!validated) return validated.error();
    report_.validated = *std::move(validated);
    settle();
    if (const auto error = add_tuned()) return *error;
    const std::size_t sizes = report_.sizes.size();
    for (const Candidate& one : report_.candidates.list) {
      report_.rows.push_back({one, std::vector<Cell>(sizes), {}, {}});
    }
    about_ = report_.rows.size() * sizes * report_.samples;
    // The own size first: it is what was asked, if there is no time for all.
    run_size(report_.own_index());
    for (std::size_t k = 0; k < sizes; ++k) {
      if (k != report_.own_index()) run_size(k);
    }
    report_.interrupted = report_.interrupted || runner_.stopped();
    return std::move(report_);
  }

 private:
  /// Sizes, runs and their limit.
  void settle() {
    model::Scenario& scenario = report_.candidates.scenario;
    report_.grows = request_.grows;
    report_.own_size = size_of(scenario.deployment, request_.grows);
    const std::uint32_t least = request_.grows == Grows::robots ? 2 : 1;
    report_.sizes = request_.sizes.empty() ? usual_sizes(report_.own_size, least) : request_.sizes;
    report_.sizes.push_back(report_.own_size);
    std::ranges::sort(report_.sizes);
    const auto again = std::unique(report_.sizes.begin(), report_.sizes.end());
    report_.sizes.erase(again, report_.sizes.end());
    report_.is_sampled =
        scenario.deployment.schedule.has_value() || request_.start_jitter.count() > 0;
    report_.samples = report_.is_sampled ? request_.samples : 1;
    report_.limit =
        request_.limit.count() > 0 ? request_.limit : std::min(scenario.time_limit, longest);
    scenario.time_limit = report_.limit;
    scenario.run_until = model::RunUntil::completion;
    if (scenario.limits && scenario.limits->completion) {
      scenario.limits->completion = std::min(*scenario.limits->completion, report_.limit);
    }
  }

  /// Settings of the scenario's library that a search finds, as one more candidate.
  std::optional<InputError> add_tuned() {
    if (request_.tune_budget == 0) return std::nullopt;
    tune::Options options;
    options.budget = request_.tune_budget;
    options.samples = 6;
    options.seed = request_.seed;
    options.start_jitter = request_.start_jitter;
    options.threads = request_.threads;
    options.on_progress = [this](std::string_view doing, std::size_t runs, std::size_t about) {
      return !request_.on_progress ||
             request_.on_progress(fmt::format("tuning, {}", doing), runs, about);
    };
    auto made =
        tuned_candidate(report_.candidates, request_.scenario, request_.overrides, options, specs_);
    if (!made) return made.error();
    report_.interrupted = made->skipped == interrupted;
    report_.candidates.list.push_back(*std::move(made));
    return std::nullopt;
  }

  struct Job {
    std::size_t row = 0;
    std::uint64_t seed = 0;
  };

  void run_size(std::size_t at) {
    const std::uint32_t size = report_.sizes[at];
    doing_ = fmt::format("{} {}", size, words_of(report_.grows));
    std::vector<Instance> instances;
    std::vector<Job> jobs;
    for (std::size_t k = 0; k < report_.rows.size(); ++k) {
      Row& row = report_.rows[k];
      Cell& cell = row.cells[at];
      cell.size = size;
      instances.push_back(instance_of(report_.candidates, row.candidate, report_.grows, size));
      cell.not_run = instances.back().refused;
      if (cell.not_run.empty() && row.breaks_at && size > *row.breaks_at) {
        cell.not_run = fmt::format("breaks at {}", *row.breaks_at);
      }
      if (!cell.not_run.empty()) continue;
      for (std::size_t s = 0; s < report_.samples; ++s) jobs.push_back({k, request_.seed + s});
    }
    auto runs = runner_.run(jobs.size(), [&](std::size_t k) {
      const std::size_t row = jobs[k].row;
      return trials::sample_run(runner_, instances[row].scenario, jobs[k].seed,
                                request_.start_jitter, report_.rows[row].candidate.plan);
    });
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (runs[k]) report_.rows[jobs[k].row].cells[at].runs.push_back(*std::move(runs[k]));
    }
    for (std::size_t k = 0; k < report_.rows.size(); ++k) {
      Row& row = report_.rows[k];
      Cell& cell = row.cells[at];
      cell.interrupted = cell.not_run.empty() && cell.runs.size() < report_.samples;
      describe_runs(cell, instances[k].scenario);
      if (cell.interrupted && cell.runs.empty()) cell.not_run = interrupted;
      if (cell.breaks) row.breaks_at = std::min(row.breaks_at.value_or(size), size);
    }
  }

  const Request& request_;
  const SpecPath& specs_;
  std::string doing_;
  std::size_t about_ = 0;
  trials::Runner runner_;
  Report report_;
};

}  // namespace

const char* key_of(Figure figure) {
  constexpr std::array<const char*, figure_count> keys{
      "t_disc_ns", "messages", "initial_data",  "repair_data",
      "heartbeat", "acknack",  "announcements", "user_control"};
  return keys[static_cast<std::size_t>(figure)];
}

const char* words_of(Figure figure) {
  constexpr std::array<const char*, figure_count> words{
      "completion", "messages", "initial DATA",  "repair DATA",
      "HEARTBEAT",  "ACKNACK",  "announcements", "user control"};
  return words[static_cast<std::size_t>(figure)];
}

std::size_t Report::own_index() const {
  return static_cast<std::size_t>(std::ranges::find(sizes, own_size) - sizes.begin());
}

Result<Candidate> tuned_candidate(const Candidates& all, const std::string& reference,
                                  std::span<const std::string> overrides,
                                  const tune::Options& options, const SpecPath& specs) {
  Candidate made;
  made.id = "tuned";
  made.name = "tuned";
  made.change = "the settings that a short search finds for the scenario as it is";
  made.wireless = all.scenario.wireless;
  auto subject = tune::read_subject(reference, overrides, "", specs);
  if (!subject) {
    made.skipped = to_string(subject.error());
    return made;
  }
  subject->scenario = all.scenario;
  made.profile = subject->preset;
  const auto tuned = tune::tune(*subject, options);
  if (!tuned) return tuned.error();
  if (tuned->answer != tune::Answer::better) {
    made.skipped = tuned->answer == tune::Answer::interrupted
                       ? interrupted
                       : "no setting was found that clearly shortens discovery";
    return made;
  }
  const tune::Row& best = tuned->rows[*tuned->recommended];
  made.dds = best.scenario.dds;
  made.change = "settings that a search found: ";
  for (const tune::Change& change : best.changes) {
    made.change += fmt::format("{}{} {}", change.key == best.changes.front().key ? "" : ", ",
                               change.key.substr(4), change.after);
  }
  return made;
}

Result<Report> compare(const Request& request, const SpecPath& specs) {
  return Comparison{request, specs}.run();
}

}  // namespace stormproof::compare
