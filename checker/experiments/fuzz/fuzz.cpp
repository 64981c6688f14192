// First the unperturbed scenario, then the variants on all cores, then shrinking. Results count in
// the order of the variants' numbers, up to the first that is missing, so they do not depend on
// which thread was faster. What the rules promise is watched in some runs only.
#include "checker/experiments/fuzz/fuzz.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iterator>
#include <map>
#include <mutex>

#include "checker/engines/exact/observed_run.hpp"
#include "checker/experiments/fuzz/variant.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"
#include "props/limits.hpp"
#include "props/monitor.hpp"
#include "props/property.hpp"

namespace stormproof::fuzz {

namespace {

bool is_limit(std::string_view id) { return id.starts_with("limit."); }

/// About what follows from progress: an incomplete run says nothing, unless it breaks it.
bool needs_completion(std::string_view id) {
  return id == "live.completion" || id == exact::quiescence;
}

class Fuzzer {
 public:
  Fuzzer(const model::Scenario& scenario, const Ranges& ranges, const FuzzOptions& options)
      : base_{scenario},
        ranges_{ranges},
        options_{options},
        variants_{scenario, ranges},
        runner_{options.jobs, [this](std::size_t finished, std::size_t) {
                  return !options_.on_progress ||
                         options_.on_progress({finished, violating_, shrinking_});
                }} {
    report_.ranges = ranges;
    report_.seed = options.seed;
    report_.first = options.first;
    report_.wanted = options.runs;
    base_.vary.reset();
    base_.deployment.schedule.reset();  // the drawn times remain
    choose_ids();
  }

  FuzzReport run() {
    run_base();
    if (report_.base_known && runner_.goes_on()) run_variants();
    conclude();
    for (Judgment& judgment : report_.judgments) {
      if (judgment.broken > 0 && judgment.sampled && runner_.goes_on()) shrink_first(judgment);
    }
    report_.interrupted = runner_.stopped();
    // As many as there was time for; the first one is always tried.
    if (options_.seconds && !report_.interrupted) {
      report_.wanted = std::max<std::size_t>(report_.runs.size(), 1);
    }
    return std::move(report_);
  }

 private:
  void choose_ids() {
    std::vector<std::string_view> known = props::monitored_properties(base_);
    const std::vector<std::string_view> limits = props::limits_of(base_);
    const std::vector<std::string_view> ordinary = exact::ordinary_properties(base_);
    known.insert(known.begin(), limits.begin(), limits.end());
    for (const std::string_view id : known) {
      const bool wanted = options_.only.empty()
                              ? is_limit(id) || std::ranges::find(ordinary, id) != ordinary.end()
                              : std::ranges::find(options_.only, id) != options_.only.end();
      if (!wanted) continue;
      Judgment judgment;
      judgment.id = id;
      if (const props::Property* property = props::find_property(id)) {
        const model::ImplementationKind implementation = model::kind_of(base_.dds);
        judgment.statement = statement_of(*property, implementation);
        judgment.promised = options_.only.empty() && !is_limit(id) &&
                            applicability_of(*property, base_).is_promised();
      }
      report_.judgments.push_back(std::move(judgment));
    }
  }

  void run_base() {
    std::vector<std::string_view> ids;
    for (const Judgment& judgment : report_.judgments) ids.push_back(judgment.id);
    model::Scenario scenario = base_;
    const auto run = run_and_judge(scenario, ids, {}, 1, [this] { return runner_.goes_on(); });
    if (!run) return;
    report_.base = *run;
    report_.base_known = true;
    for (Judgment& judgment : report_.judgments) {
      if (const Breach* breach = run->breach(judgment.id)) judgment.in_base = *breach;
      judgment.sampled = !judgment.in_base || is_limit(judgment.id) ||
                         std::ranges::find(options_.only, judgment.id) != options_.only.end();
      if (!judgment.sampled) continue;
      sampled_.push_back(judgment.id);
      (judgment.promised ? promised_ : always_).push_back(judgment.id);
    }
  }

  /// The scenario of a variant with its losses, run and judged by `ids`.
  std::optional<JudgedRun> run_variant(std::uint64_t number,
                                       const std::vector<std::string_view>& ids,
                                       model::Scenario& scenario) {
    auto variant = variants_.draw(options_.seed, number);
    if (!variant) {
      const std::lock_guard lock{mutex_};
      report_.undrawable = true;
      return std::nullopt;
    }
    scenario = std::move(variant->scenario);
    Losses losses;
    if (ranges_.vary.loss) {
      losses = [&](std::uint64_t packets) {
        return variants_.losses(options_.seed, number, packets);
      };
    }
    auto run = run_and_judge(scenario, ids, losses, 2 * report_.base.packets,
                             [this] { return runner_.goes_on(); });
    if (!run) return std::nullopt;
    run->number = number;
    run->rejected = variant->rejected;
    return run;
  }

  void run_variants() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point started = Clock::now();
    const auto in_time = [&] {
      const std::chrono::duration<double> passed = Clock::now() - started;
      return !options_.seconds || passed.count() < *options_.seconds;
    };
    std::map<std::size_t, JudgedRun> finished;
    runner_.each(options_.runs, [&](std::size_t k) {
      if ((k > 0 && !in_time()) || !runner_.goes_on()) return false;
      model::Scenario scenario;
      auto run = run_variant(options_.first + k, is_watched(k) ? sampled_ : always_, scenario);
      if (!run) return false;
      if (!is_watched(k)) std::ranges::copy(promised_, std::back_inserter(run->undecided));
      if (!run->breaches.empty()) ++violating_;
      const std::lock_guard lock{mutex_};
      finished.emplace(k, *std::move(run));
      return true;
    });
    for (auto& [k, run] : finished) {
      if (k != report_.runs.size()) break;
      report_.runs.push_back(std::move(run));
    }
  }

  void conclude() {
    for (Judgment& judgment : report_.judgments) {
      for (const JudgedRun& run : report_.runs) {
        if (!judgment.sampled) break;
        const Breach* breach = run.breach(judgment.id);
        const bool goes_far_enough =
            run.decides(judgment.id) && (!needs_completion(judgment.id) || run.discovery_time);
        if (breach == nullptr && !goes_far_enough) continue;
        ++judgment.runs;
        if (breach == nullptr) continue;
        if (judgment.broken++ > 0) continue;
        judgment.first_broken = run.number;
        judgment.first_reason = breach->reason;
      }
      judgment.rate = statistics::clopper_pearson(judgment.broken, judgment.runs);
      if (judgment.broken > 0 || (!judgment.sampled && judgment.in_base))
        judgment.verdict = props::VerdictKind::violated;
      else if (judgment.runs > 0)
        judgment.verdict = props::VerdictKind::sampled;
    }
    std::vector<double> completion, messages, amplification, backlog;
    for (const JudgedRun& run : report_.runs) {
      report_.rejected += run.rejected;
      messages.push_back(static_cast<double>(run.messages));
      amplification.push_back(run.amplification);
      backlog.push_back(static_cast<double>(run.backlog));
      completion.push_back(statistics::completion_ns(run.discovery_time));
      if (!run.discovery_time) ++report_.incomplete;
    }
    report_.completion_ns = statistics::quantiles(std::move(completion));
    report_.messages = statistics::quantiles(std::move(messages));
    report_.amplification = statistics::quantiles(std::move(amplification));
    report_.backlog = statistics::quantiles(std::move(backlog));
  }

  void shrink_first(Judgment& judgment) {
    shrinking_ = judgment.id;  // in one thread
    model::Scenario scenario;
    const auto go = [this] { return runner_.goes_on(); };
    if (!run_variant(judgment.first_broken, sampled_, scenario)) return;
    std::uint64_t events = 0;
    auto found = find_breach(scenario, judgment.id, 0, events, go);
    if (!found) return;
    judgment.shrunk = shrink(*std::move(found), base_, shrinking_events, go);
  }

  model::Scenario base_;  ///< as it runs without variation
  const Ranges& ranges_;
  const FuzzOptions& options_;
  VariantSource variants_;
  FuzzReport report_;
  std::vector<std::string_view> sampled_;            ///< ids that variants are judged by
  std::vector<std::string_view> promised_, always_;  ///< of them
  std::mutex mutex_;
  std::atomic<std::size_t> violating_ = 0;
  std::string_view shrinking_;
  trials::Runner runner_;
};

}  // namespace

bool FuzzReport::violated() const {
  return std::ranges::any_of(judgments, [](const Judgment& j) { return j.broken > 0; });
}

FuzzReport fuzz(const model::Scenario& scenario, const Ranges& ranges, const FuzzOptions& options) {
  return Fuzzer{scenario, ranges, options}.run();
}

}  // namespace stormproof::fuzz
