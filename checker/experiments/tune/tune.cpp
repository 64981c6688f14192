// The stages one after the other: what holds unchanged, search, reduction and choice, comparison.
#include "checker/experiments/tune/tune.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "checker/engines/exact/storm.hpp"
#include "checker/experiments/trials/patience.hpp"
#include "checker/experiments/trials/under_seed.hpp"
#include "checker/experiments/tune/comparison.hpp"
#include "checker/experiments/tune/model_runs.hpp"
#include "model/config/tree/suggestion.hpp"
#include "model/config/vendor/vendor_knobs.hpp"
#include "model/implementations.hpp"
#include "props/limits.hpp"
#include "props/monitor.hpp"

namespace stormproof::tune {

using model::Nanoseconds;
using model::Scenario;
using model::config::InputError;
using model::config::Result;

namespace {

/// Runs of a setting in the search.
constexpr std::size_t search_samples = 12;
/// Settings of the front that are looked at closely.
constexpr std::size_t most_shown = 8;
/// Fewer runs of a setting say nothing.
constexpr std::size_t least_samples = 6;
/// Of the time that is left, what runs are planned for: some take longer than those before.
constexpr double careful = 0.7;
/// Distance between the sets of seeds.
constexpr std::uint64_t next_seeds = 1'000'000;
/// Of the time that is left, what the search may take where the unchanged setting is not complete.
constexpr double search_part = 0.35;
/// What follows takes so many times as long for each run: it is watched.
constexpr std::size_t watched_factor = 4;
/// A run that is cut takes no less than such a part of the others.
constexpr std::size_t most_gained = 4;
/// Where there is little time, the unchanged setting is watched for so many times what is late.
constexpr std::int64_t watched_late = 10;

std::vector<std::string_view> known_ids(const Scenario& scenario) {
  std::vector<std::string_view> ids = props::monitored_properties(scenario);
  for (const std::string_view id : props::set_limits(scenario.limits)) ids.push_back(id);
  return ids;
}

class Study {
 public:
  Study(const Subject& subject, const Options& options)
      : subject_{subject},
        options_{options},
        runner_{options.threads, [this](std::size_t runs, std::size_t) {
                  return !options_.on_progress ||
                         options_.on_progress(doing_, runs, std::max(runs, about_));
                }} {
    const bool sampled = model::is_drawn(scenario()) || options.start_jitter.count() > 0;
    const std::size_t samples = sampled ? options.samples : 1;
    report_.is_sampled = sampled;
    report_.searched = {options.seed, sampled ? std::min(search_samples, samples) : 1};
    report_.chosen = {options.seed + (sampled ? next_seeds : 0), samples};
    report_.compared = {options.seed + (sampled ? 2 * next_seeds : 0), samples};
    report_.basis = report_.searched;
    report_.space = space_of(scenario(), model::config::vendor::vendor_knobs(subject.vendor));
  }

  Result<Report> run() {
    if (auto error = refuse()) return *std::move(error);
    problem_.space = report_.space;
    choice_ = report_.space.unchanged();
    problem_.is_valid = [this](const Point& point) {
      return model::config::is_valid(report_.space.apply(scenario(), point));
    };
    problem_.run = [this](const Point& point, std::uint64_t seed, Nanoseconds limit) {
      return run_under(report_.space.apply(scenario(), point), seed, limit, limits_);
    };
    problem_.watch = [this](const Point& point, std::uint64_t seed,
                            Nanoseconds limit) -> std::optional<std::vector<std::string_view>> {
      auto outcome = run_under(report_.space.apply(scenario(), point), seed, limit, properties_);
      if (!outcome) return std::nullopt;
      return std::move(outcome->broken);
    };
    if (look_at_unchanged() && search_and_choose()) compare();
    conclude();
    return std::move(report_);
  }

 private:
  [[nodiscard]] const Scenario& scenario() const { return subject_.scenario; }

  std::optional<InputError> refuse() {
    if (report_.space.dimensions.empty()) {
      return InputError{subject_.preset, "no number of this profile can be set by a user"};
    }
    const std::vector<std::string_view> known = known_ids(scenario());
    for (const std::string& id : options_.keep) {
      if (std::ranges::find(known, id) != known.end()) continue;
      const std::vector<std::string> names{known.begin(), known.end()};
      return InputError{"--keep " + id,
                        fmt::format("no property that a run shows, and no limit of the scenario{}; "
                                    "'stormproof properties' lists the properties",
                                    model::config::suggestion(id, names))};
    }
    return std::nullopt;
  }

  std::optional<Outcome> run_under(const Scenario& changed, std::uint64_t seed, Nanoseconds limit,
                                   const std::vector<std::string_view>& ids) {
    const Scenario drawn = trials::under_seed(changed, seed, options_.start_jitter);
    return run_once(drawn, ids, limit, [this] { return runner_.goes_on(); });
  }

  /// Limits are judged by the result of a run. Properties take several times as long as the run.
  void share_out() {
    limits_.clear();
    properties_.clear();
    for (const std::string_view id : watched_) {
      (id.starts_with("limit.") ? limits_ : properties_).push_back(id);
    }
  }

  /// What holds without a change, and how long it takes.
  bool look_at_unchanged() {
    if (options_.keep.empty()) {
      watched_ = watchable(scenario());
    } else {
      for (const std::string_view id : known_ids(scenario())) {
        if (std::ranges::find(options_.keep, id) != options_.keep.end()) watched_.push_back(id);
      }
    }
    share_out();
    report_.budget = options_.budget;
    report_.compared_until = scenario().time_limit;
    about_ = all_runs();
    Archive archive{problem_, scenario().time_limit, runner_};
    const std::vector<Point> unchanged{report_.space.unchanged()};
    if (!archive.extend(unchanged, report_.searched)) return false;
    const Cost cost = archive.cost(report_.space.unchanged(), report_.searched);
    if (seconds_left() && std::isinf(cost.completion)) archive.watch_until(late() * watched_late);
    if (!archive.watch(unchanged, report_.searched)) return false;
    const auto outcomes = archive.outcomes(report_.space.unchanged(), report_.searched);
    if (options_.keep.empty()) {
      for (const std::string_view id : broken_in(outcomes)) {
        report_.not_required.emplace_back(id);
        std::erase(watched_, id);
      }
      share_out();
    }
    for (const std::string_view id : watched_) report_.kept.emplace_back(id);
    trials::Patience patience{scenario().time_limit, Nanoseconds{1}};
    patience.see(cost_of(outcomes).completion, trials::beside_unchanged);
    report_.search_limit = patience.limit();
    // Where the unchanged setting does not complete, its runs say little of those of the search,
    // which are cut: its time ends it.
    if (is_open()) {
      if (const auto left = seconds_left()) {
        report_.budget = std::min(report_.budget, most_gained * runner_.fitting(careful * *left));
        report_.was_fitted = report_.budget < options_.budget;
      }
      runner_.forget_pace();
    } else {
      fit_into_time();
    }
    return true;
  }

  [[nodiscard]] std::optional<double> seconds_left() const {
    return options_.seconds_left ? options_.seconds_left() : std::nullopt;
  }
  [[nodiscard]] Nanoseconds late() const { return exact::late_limit(scenario().limits); }
  /// Whether the unchanged setting is no measure of how long a run of the search takes.
  [[nodiscard]] bool is_open() const {
    return report_.search_limit == scenario().time_limit && report_.search_limit > late();
  }

  /// About how many runs there will be.
  [[nodiscard]] std::size_t all_runs() const {
    return (is_searched_ ? 0 : report_.budget) + 10 * shown_ * report_.chosen.count +
           (shown_ + 3) * report_.compared.count;
  }

  /// Fewer runs if there is no time for all: first of each setting, then of the search, then
  /// settings of the front.
  void fit_into_time() {
    const auto left = seconds_left();
    if (!left) return;
    const std::size_t unwatched = runner_.fitting(careful * *left);
    const std::size_t fits = is_searched_ ? unwatched / watched_factor : unwatched;
    const auto lower = [&](std::size_t& number, std::size_t least) {
      while (all_runs() > fits && number > least) number = std::max(least, number * 3 / 4);
    };
    report_.was_fitted = report_.was_fitted || all_runs() > fits;
    lower(report_.chosen.count, std::min<std::size_t>(search_samples, report_.chosen.count));
    report_.compared.count = std::min(report_.compared.count, report_.chosen.count);
    if (!is_searched_) lower(report_.budget, std::min<std::size_t>(200, options_.budget));
    lower(report_.chosen.count, std::min(least_samples, report_.chosen.count));
    report_.compared.count = report_.chosen.count;
    lower(shown_, 1);
    if (!is_searched_) lower(report_.budget, std::min<std::size_t>(25, options_.budget));
    about_ = all_runs();
  }

  bool search_and_choose() {
    doing_ = "search";
    Archive archive{problem_, {report_.search_limit, late()}, runner_};
    SearchOptions options{report_.budget, report_.searched, options_.seed};
    if (const auto left = seconds_left(); left && is_open()) {
      options.time_used = [this, left] {
        return (*left - seconds_left().value_or(0)) / (search_part * *left);
      };
    }
    report_.found = search(problem_, archive, options);
    report_.cuts = archive.cuts();
    report_.cut_at = archive.limit();
    const auto keep_what_is_known = [&](const std::vector<Point>& front, Seeds basis) {
      report_.settings = archive.settings();
      report_.basis = basis;
      front_ = front;
      for (const Point& point : with_unchanged(front)) {
        known_[point] = archive.outcomes(point, basis);
      }
    };
    report_.tried = report_.found.finalists;
    keep_what_is_known(report_.found.front, report_.found.basis);
    choice_ = front_.empty() ? problem_.space.unchanged() : front_.front();
    if (!report_.found.finished) return false;

    if (is_open()) {
      is_searched_ = true;
      if (archive.runs() < report_.budget) {
        report_.was_fitted = true;
        report_.budget = archive.runs();
      }
      fit_into_time();
    }
    doing_ = "reduction";
    const std::vector<Point> spread = spread_front(archive, report_.found.front, report_.searched);
    const auto reduced =
        tune::reduced(with_unchanged(spread), problem_, archive, report_.chosen, options_.least);
    if (!reduced) return false;
    count_undone(spread, *reduced);
    const std::vector<Point> front = kept_front(archive, *reduced, report_.chosen);
    keep_what_is_known(front, report_.chosen);
    choice_ = chosen_of(archive, front);
    return true;
  }

  [[nodiscard]] std::vector<Point> with_unchanged(std::vector<Point> points) const {
    const Point unchanged = problem_.space.unchanged();
    if (std::ranges::find(points, unchanged) == points.end()) points.push_back(unchanged);
    return points;
  }

  [[nodiscard]] std::vector<Cost> costs_of(const Archive& archive, const std::vector<Point>& points,
                                           Seeds seeds) const {
    std::vector<Cost> costs;
    for (const Point& point : points) costs.push_back(archive.cost(point, seeds));
    return costs;
  }

  [[nodiscard]] std::vector<Point> spread_front(const Archive& archive,
                                                const std::vector<Point>& front,
                                                Seeds seeds) const {
    const std::vector<Cost> costs = costs_of(archive, front, seeds);
    std::vector<Point> spread;
    for (const std::size_t k : spread_out(costs, pareto_front(costs), shown_)) {
      spread.push_back(front[k]);
    }
    return spread;
  }

  void count_undone(const std::vector<Point>& before, const std::vector<Point>& after) {
    for (std::size_t k = 0; k < before.size(); ++k) {
      report_.undone +=
          problem_.space.changes(before[k]).size() - problem_.space.changes(after[k]).size();
    }
  }

  /// The front of those that keep everything under `seeds`.
  [[nodiscard]] std::vector<Point> kept_front(const Archive& archive,
                                              const std::vector<Point>& points, Seeds seeds) const {
    const std::set<Point> distinct{points.begin(), points.end()};
    std::vector<Point> kept;
    for (const Point& point : distinct) {
      if (archive.keeps(point, seeds)) kept.push_back(point);
    }
    std::vector<Point> front;
    for (const std::size_t k : pareto_front(costs_of(archive, kept, seeds))) {
      front.push_back(kept[k]);
    }
    return front;
  }

  /// Of the settings that are not clearly longer than the shortest one that with the fewest
  /// changes; of these the shortest.
  [[nodiscard]] Point chosen_of(const Archive& archive, const std::vector<Point>& front) const {
    if (front.empty()) return problem_.space.unchanged();
    const auto shortest = archive.outcomes(front.front(), report_.chosen);
    Point best = front.front();
    for (const Point& point : with_unchanged(front)) {
      if (!archive.keeps(point, report_.chosen)) continue;
      const Difference longer = difference(archive.outcomes(point, report_.chosen), shortest);
      if (is_clearly_more(longer.completion, options_.least)) continue;
      if (problem_.space.changes(point).size() < problem_.space.changes(best).size()) best = point;
    }
    return best;
  }

  /// All rows under seeds that nothing was chosen by.
  void compare() {
    doing_ = "comparison";
    std::vector<Row> rows = rows_of(subject_, report_.space, front_, choice_);
    about_ = runner_.finished() + rows.size() * report_.compared.count;
    if (report_.was_fitted && report_.cuts > 0) report_.compared_until = report_.cut_at;
    const std::size_t samples = report_.compared.count;
    auto outcomes = runner_.run(rows.size() * samples, [&](std::size_t k) {
      return run_under(rows[k / samples].scenario, report_.compared.first + k % samples,
                       report_.compared_until, watched_);
    });
    if (runner_.stopped()) return;
    std::vector<std::vector<Outcome>> by_row(rows.size());
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      by_row[k / samples].push_back(*std::move(outcomes[k]));
    }
    report_.basis = report_.compared;
    judge_rows(std::move(rows), by_row, options_, report_);
    finished_ = true;
  }

  void conclude() {
    report_.runs = runner_.finished();
    if (!finished_) {
      report_.answer = Answer::interrupted;
      describe_interrupted(rows_of(subject_, report_.space, front_, choice_), known_, report_);
    }
  }

  const Subject& subject_;
  const Options& options_;
  Problem problem_;
  std::vector<std::string_view> watched_;              ///< all that must hold
  std::vector<std::string_view> limits_, properties_;  ///< of them
  std::vector<Point> front_;
  Point choice_;
  std::map<Point, std::vector<Outcome>> known_;
  const char* doing_ = "unchanged";
  std::size_t about_ = 0;
  std::size_t shown_ = most_shown;
  trials::Runner runner_;
  bool is_searched_ = false;
  bool finished_ = false;
  Report report_;
};

}  // namespace

Result<Report> tune(const Subject& subject, const Options& options) {
  return Study{subject, options}.run();
}

}  // namespace stormproof::tune
