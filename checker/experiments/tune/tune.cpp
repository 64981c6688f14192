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
/// Distance between the sets of seeds.
constexpr std::uint64_t next_seeds = 1'000'000;
/// Of the time: what the first runs may take until something completes, and of what is left then
/// what the search may.
constexpr double first_part = 0.2;
constexpr double search_part = 0.4;
/// With little time a search has at least so many settings for each of its seeds, of which there
/// are no fewer.
constexpr std::size_t settings_each = 30;
constexpr std::size_t least_search_samples = 3;
/// A run that is watched takes so many times as long as one that is not.
constexpr std::size_t watched_factor = 8;
/// Steps of the reduction of a setting, about.
constexpr std::size_t reduction_steps = 10;

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
        runner_{options.threads,
                [this](std::size_t runs, std::size_t) {
                  return !options_.on_progress ||
                         options_.on_progress(doing_, runs, std::max(runs, about_));
                }},
        archive_{problem_,
                 trials::Patience::from_least(subject.scenario.time_limit,
                                              exact::late_limit(subject.scenario.limits)),
                 runner_} {
    const bool sampled = model::is_drawn(scenario()) || options.start_jitter.count() > 0;
    const std::size_t samples = sampled ? options.samples : 1;
    report_.is_sampled = sampled;
    report_.searched = {options.seed, sampled ? std::min(search_samples, samples) : 1};
    report_.chosen = {options.seed + (sampled ? next_seeds : 0), samples};
    report_.compared = {options.seed + (sampled ? 2 * next_seeds : 0), samples};
    report_.basis = report_.searched;
    report_.space = space_of(scenario(), model::config::vendor::vendor_knobs(subject.vendor));
    if (options.plans) add_launch_plan(scenario(), report_.space);
  }

  Result<Report> run() {
    if (auto error = refuse()) return *std::move(error);
    problem_.space = report_.space;
    choice_ = report_.space.unchanged();
    problem_.is_valid = [this](const Point& point) {
      return model::config::is_valid(report_.space.apply(scenario(), point));
    };
    problem_.run = [this](const Point& point, std::uint64_t seed, Nanoseconds limit) {
      return run_under(report_.space.apply(scenario(), point), report_.space.plan(point), seed,
                       limit, limits_);
    };
    problem_.watch = [this](const Point& point, std::uint64_t seed,
                            Nanoseconds limit) -> std::optional<std::vector<std::string_view>> {
      auto outcome = run_under(report_.space.apply(scenario(), point), report_.space.plan(point),
                               seed, limit, properties_);
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

  std::optional<Outcome> run_under(const Scenario& changed, const std::optional<launch::Plan>& plan,
                                   std::uint64_t seed, Nanoseconds limit,
                                   const std::vector<std::string_view>& ids) {
    Scenario drawn = trials::under_seed(changed, seed, options_.start_jitter);
    if (plan) launch::follow(*plan, changed.deployment, drawn);
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

  /// What holds without a change, and how long it takes. With little time properties are watched in
  /// the comparison alone.
  bool look_at_unchanged() {
    if (options_.keep.empty()) {
      watched_ = watchable(scenario());
    } else {
      for (const std::string_view id : known_ids(scenario())) {
        if (std::ranges::find(options_.keep, id) != options_.keep.end()) watched_.push_back(id);
      }
    }
    share_out();
    budget_ = options_.budget;
    report_.compared_until = scenario().time_limit;
    about_ = all_runs();
    if (options_.time.is_limited()) {
      if (!find_patience()) return false;
      if (hurries_) {
        problem_.watch = {};
        forgive({});
        return true;
      }
    }
    const Point unchanged = report_.space.unchanged();
    Archive whole{problem_, scenario().time_limit, runner_};
    if (!whole.extend({unchanged}, report_.searched)) return false;
    if (!whole.watch({unchanged}, report_.searched)) return false;
    const auto outcomes = whole.outcomes(unchanged, report_.searched);
    forgive(broken_in(outcomes));
    trials::Patience patience{scenario().time_limit, Nanoseconds{1}};
    patience.see(cost_of(outcomes).completion, trials::beside_unchanged);
    archive_.begin_anew(trials::Patience{patience.limit(), exact::late_limit(scenario().limits)});
    return true;
  }

  /// What breaks unchanged is not asked of others, unless the user does.
  void forgive(const std::vector<std::string_view>& broken) {
    if (options_.keep.empty()) {
      for (const std::string_view id : broken) {
        report_.not_required.emplace_back(id);
        std::erase(watched_, id);
      }
      share_out();
    }
    for (const std::string_view id : watched_) report_.kept.emplace_back(id);
  }

  /// With little time nobody waits for the end of a storm: the unchanged setting and the ends of
  /// each knob run under one seed, for longer and longer, until one of them completes. What these
  /// runs took says how many settings the search has time for.
  bool find_patience() {
    std::vector<Point> points{report_.space.unchanged()};
    for (std::size_t d = 0; d < report_.space.dimensions.size(); ++d) {
      const Dimension& dimension = report_.space.dimensions[d];
      for (const std::int64_t end : {dimension.minimum, dimension.maximum}) {
        points.push_back(report_.space.unchanged());
        points.back()[d] = end;
        if (!problem_.is_valid(points.back())) points.pop_back();
      }
    }
    const trials::Budget first = options_.time.part(first_part);
    do {
      pace_ = trials::Pace{options_.time, runner_.finished()};
      first_limit_ = archive_.limit();
      if (!archive_.extend(points, {report_.searched.first, 1})) return false;
    } while (!first.is_over() && archive_.lengthen());
    const std::size_t fits = fitting(options_.time.part(search_part));
    hurries_ = fits < budget_;
    if (!hurries_) return true;
    budget_ = fits;
    report_.searched.count =
        std::clamp(fits / settings_each, std::min(least_search_samples, report_.searched.count),
                   report_.searched.count);
    report_.basis = report_.searched;
    about_ = runner_.finished() + all_runs();
    return true;
  }

  [[nodiscard]] std::size_t fitting(const trials::Budget& rest) const {
    return pace_.fitting(rest, runner_.finished());
  }

  /// About how many runs there will be.
  [[nodiscard]] std::size_t all_runs() const {
    return budget_ + reduction_steps * shown_ * report_.chosen.count +
           (shown_ + 3) * report_.compared.count;
  }

  /// Fewer runs if there is no time for all that comes after the search: first of each setting,
  /// then settings of the front. Returns whether there is time to set anything back.
  bool fit_into_time() {
    if (!options_.time.is_limited()) return true;
    const std::size_t fits = fitting(options_.time);
    const auto costs = [&] {
      const std::size_t watched_runs =
          hurries_ ? shown_ + 1 : shown_ * (report_.chosen.count + report_.compared.count);
      return reduction_steps * shown_ * report_.chosen.count +
             (shown_ + 4) * report_.compared.count + watched_factor * watched_runs;
    };
    const auto lower = [&](std::size_t& number, std::size_t least) {
      while (costs() > fits && number > least) {
        number = std::max(least, number * 3 / 4);
        report_.compared.count = report_.chosen.count;
      }
    };
    lower(report_.chosen.count, std::min(search_samples, report_.chosen.count));
    lower(shown_, 2);
    lower(report_.chosen.count, std::min(least_samples, report_.chosen.count));
    lower(shown_, 1);
    about_ = runner_.finished() + costs();
    return costs() <= 2 * fits;  // some steps are fewer
  }

  bool search_and_choose() {
    doing_ = "search";
    SearchOptions options{budget_, report_.searched, options_.seed};
    const trials::Budget search_time = options_.time.part(search_part);
    if (search_time.is_limited()) options.time_used = [&] { return search_time.used(); };
    pace_ = trials::Pace{options_.time, runner_.finished()};
    report_.found = search(problem_, archive_, options);
    const auto keep_what_is_known = [&](const std::vector<Point>& front, Seeds basis) {
      report_.settings = archive_.settings();
      report_.basis = basis;
      front_ = front;
      for (const Point& point : with_unchanged(front)) {
        known_[point] = archive_.outcomes(point, basis);
      }
    };
    report_.tried = report_.found.finalists;
    keep_what_is_known(report_.found.front, report_.found.basis);
    choice_ = front_.empty() ? problem_.space.unchanged() : front_.front();
    note_search();
    if (!report_.found.finished) return false;

    if (!fit_into_time()) {
      report_.unasked.left_out.emplace_back("changes set back that do not matter");
      front_.resize(std::min<std::size_t>(front_.size(), 1));
      return true;
    }
    doing_ = "reduction";
    const std::vector<Point> spread = spread_front(archive_, report_.found.front, report_.searched);
    const auto reduced =
        tune::reduced(with_unchanged(spread), problem_, archive_, report_.chosen, options_.least);
    if (!reduced) return false;
    count_undone(spread, *reduced);
    const std::vector<Point> front = kept_front(archive_, *reduced, report_.chosen);
    keep_what_is_known(front, report_.chosen);
    choice_ = chosen_of(archive_, front);
    return true;
  }

  /// What the search did not ask.
  void note_search() {
    if (hurries_) report_.unasked.note("runs of the search", archive_.runs(), options_.budget);
    if (archive_.cuts() > 0) {
      // Where none may be cut any more, those were that waited for the first to complete.
      const bool any_more = archive_.limit() < scenario().time_limit;
      report_.unasked.cuts.push_back(
          {"runs of the search", archive_.cuts(), any_more ? archive_.limit() : first_limit_});
    }
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
    if (hurries_) report_.compared_until = archive_.limit();
    const std::size_t samples = report_.compared.count;
    const auto watched = [&](const Row& row,
                             std::size_t run) -> const std::vector<std::string_view>& {
      const bool is_watched = run == 0 && row.kind != Row::Kind::comparison;
      return hurries_ && !is_watched ? limits_ : watched_;
    };
    auto outcomes = runner_.run(rows.size() * samples, [&](std::size_t k) {
      const Row& row = rows[k / samples];
      return run_under(row.scenario, row.plan, report_.compared.first + k % samples,
                       report_.compared_until, watched(row, k % samples));
    });
    if (runner_.stopped()) return;
    note_comparison(outcomes);
    std::vector<std::vector<Outcome>> by_row(rows.size());
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
      by_row[k / samples].push_back(*std::move(outcomes[k]));
    }
    report_.basis = report_.compared;
    judge_rows(std::move(rows), by_row, options_, report_);
    finished_ = true;
  }

  void note_comparison(const std::vector<std::optional<Outcome>>& outcomes) {
    trials::Unasked& unasked = report_.unasked;
    unasked.note("runs of each setting", report_.compared.count,
                 report_.is_sampled ? options_.samples : 1);
    if (hurries_) unasked.left_out.emplace_back("properties beyond one run of a setting");
    const auto cut = static_cast<std::size_t>(std::ranges::count_if(
        outcomes, [](const auto& outcome) { return outcome->cut.has_value(); }));
    if (cut > 0) unasked.cuts.push_back({"runs of the table", cut, report_.compared_until});
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
  std::size_t budget_ = 0;   ///< runs of the search
  Nanoseconds first_limit_;  ///< of the last of the first runs
  trials::Runner runner_;
  trials::Pace pace_{options_.time, 0};
  Archive archive_;
  bool hurries_ = false;  ///< there is no time for the whole search
  bool finished_ = false;
  Report report_;
};

}  // namespace

Result<Report> tune(const Subject& subject, const Options& options) {
  return Study{subject, options}.run();
}

}  // namespace stormproof::tune
