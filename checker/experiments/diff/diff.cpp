// Asks the five parts one after the other and judges them together. What Ctrl-C leaves out is left
// out of the report, and the judgment says so.
#include "checker/experiments/diff/diff.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "checker/experiments/diff/blame.hpp"
#include "checker/experiments/diff/costs.hpp"
#include "checker/experiments/diff/rolling.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "checker/experiments/diff/telling_apart.hpp"
#include "checker/experiments/diff/verdicts.hpp"

namespace stormproof::diff {

namespace config = model::config;

namespace {

/// Of the time, what pairs of runs may take if verdicts are compared as well; of what is left then,
/// what these may; and so on.
constexpr double for_costs = 0.5;
constexpr double for_verdicts = 0.8;
constexpr double for_telling_apart = 0.8;
/// A pair of runs that is watched takes so many times as long as one that is not.
constexpr std::size_t watched_factor = 25;

class DiffStudy {
 public:
  DiffStudy(const DiffRequest& request, const RollingGrid& rolling, const ReviewedPoint& checked)
      : request_{request},
        rolling_{rolling},
        grid_{rolling.grid},
        checked_{checked},
        runner_{request.threads, [this](std::size_t pairs, std::size_t all) {
                  return progress(doing_, pairs, all);
                }} {
    report_.base = request.base;
    report_.candidate = request.candidate;
    report_.policy = request.policy;
    if (request.samples) report_.policy.samples = *request.samples;
  }

  DiffReport run() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point started = Clock::now();
    report_.profiles = compare_profiles(request_.base, request_.candidate);
    if (report_.profiles.relation == Relation::elsewhere && has_lives()) {
      report_.profiles.relation = Relation::different;
    }
    if (report_.profiles.relation == Relation::different) {
      if (goes_on()) compare_runs();
      if (goes_on() && request_.check_verdicts) check();
      if (goes_on() && request_.tell_apart) find_least_scenario();
    }
    summarize(report_);
    report_.seconds = std::chrono::duration<double>(Clock::now() - started).count();
    return std::move(report_);
  }

 private:
  /// Whether somebody may leave in what is compared.
  [[nodiscard]] bool has_lives() const {
    return std::ranges::any_of(grid_.points, [](const ReviewedPoint& point) {
      return point.base.deployment.life.has_value();
    });
  }

  bool goes_on() const { return !report_.interrupted; }

  bool progress(std::string_view what, std::size_t pairs = 0, std::size_t all = 0) {
    return !request_.on_progress || request_.on_progress(what, pairs, all);
  }

  void compare_runs() {
    const std::size_t samples =
        request_.samples.value_or(grid_.samples.value_or(request_.policy.samples));
    const bool may_grow = !request_.samples && !grid_.samples;
    const CostRequest request{grid_,
                              request_.policy,
                              samples,
                              may_grow ? request_.policy.most_samples : samples,
                              request_.seed.value_or(grid_.first_seed),
                              runner_,
                              request_.time.part(request_.check_verdicts ? for_costs : 1)};
    const CostAnswer answer = compare_costs(request);
    report_.costs = answer.comparison;
    report_.unasked = answer.unasked;
    report_.interrupted = answer.interrupted;
    if (!goes_on()) return;
    if (request_.rolling) {
      report_.rollouts = rollouts(rolling_, report_.costs);
      report_.interrupted = !progress("costs");
      return;
    }
    report_.margin = compare_margins(request_.base.value, request_.candidate.value, grid_.points,
                                     report_.costs, request_.policy);
    doing_ = "which knob does it";
    if (const std::size_t knobs = report_.profiles.changes.size();
        knobs * answer.comparison.samples <= pace_.fitting(request_.time, runner_.finished())) {
      report_.blame = blame(report_.profiles.changes, request, answer);
    } else {
      report_.unasked.note("knobs set back, to see which does it", 0, knobs);
    }
    report_.interrupted = !progress("costs");
  }

  void check() {
    const trials::Budget time = request_.time.part(for_verdicts);
    const VerdictRequest request{
        checked_.name,
        checked_.base,
        checked_.candidate,
        request_.seed.value_or(grid_.first_seed),
        static_cast<std::uint32_t>(verdict_samples()),
        request_.threads,
        [&](std::string_view what) { return !time.is_over() && progress(what); },
        [&] { return time.is_over() || (request_.interrupted && request_.interrupted()); }};
    VerdictAnswer answer = compare_verdicts(request, request_.policy);
    report_.verdicts = std::move(answer.comparison);
    report_.interrupted = answer.interrupted && !time.is_over();
    if (answer.interrupted && time.is_over()) {
      report_.unasked.left_out.emplace_back("verdicts of properties");
    }
  }

  /// Runs that verdicts rest on, of each side: fewer if there is no time for all.
  std::size_t verdict_samples() {
    const std::size_t wanted =
        std::min<std::size_t>(request_.samples.value_or(request_.policy.samples), 100);
    if (!request_.time.is_limited()) return wanted;
    const std::size_t fits = pace_.fitting(request_.time, runner_.finished()) / watched_factor;
    const std::size_t samples = std::clamp<std::size_t>(fits, 1, wanted);
    report_.unasked.note("runs for the verdicts", samples, wanted);
    return samples;
  }

  /// From the least deployment of the grid whose runs differ.
  void find_least_scenario() {
    const ReviewedPoint* start = &checked_;
    const Configuration* least = nullptr;
    for (const Configuration& configuration : report_.costs.configurations) {
      if (configuration.identical_runs) continue;
      if (least == nullptr || configuration.descriptors < least->descriptors) {
        least = &configuration;
      }
    }
    if (least != nullptr) {
      start = &*std::ranges::find(grid_.points, least->name, &ReviewedPoint::name);
    }
    const trials::Budget time = request_.time.part(for_telling_apart);
    report_.telling_apart =
        tell_apart(start->base, request_.base.value, request_.candidate.value, [&, this] {
          if (time.is_over()) return false;
          report_.interrupted = !progress("least scenario that tells them apart");
          return goes_on();
        });
  }

  const DiffRequest& request_;
  const RollingGrid& rolling_;
  const ReviewedGrid& grid_;
  const ReviewedPoint& checked_;
  const char* doing_ = "costs";
  trials::Runner runner_;
  const trials::Pace pace_{request_.time, 0};
  DiffReport report_;
};

}  // namespace

config::Result<DiffReport> diff(const DiffRequest& request, const config::SpecPath& specs) {
  const model::DdsProfile& base = request.base.value;
  const model::DdsProfile& candidate = request.candidate.value;
  const auto grid =
      read_reviewed_grid(request.grid.empty() ? "review" : request.grid, base, candidate, specs);
  if (!grid) return grid.error();
  const config::Result<RollingGrid> rolling =
      request.rolling ? rolling_grid(*grid) : RollingGrid{*grid, {}};
  if (!rolling) return rolling.error();
  if (request.scenario.empty()) {
    const auto least = std::ranges::min_element(
        grid->points, {}, [](const ReviewedPoint& point) { return load_of(point); });
    ReviewedPoint checked = *least;
    if (grid->points.size() > 1) checked.name = fmt::format("{}, {}", grid->name, least->name);
    return DiffStudy{request, *rolling, checked}.run();
  }
  const auto scenario = read_reviewed_grid(request.scenario, base, candidate, specs);
  if (!scenario) return scenario.error();
  if (scenario->points.size() != 1) {
    return config::InputError{
        request.scenario,
        fmt::format("a grid of {} scenarios; expected a single scenario", scenario->points.size())};
  }
  return DiffStudy{request, *rolling, scenario->points.front()}.run();
}

}  // namespace stormproof::diff
