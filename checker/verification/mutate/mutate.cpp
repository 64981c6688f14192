// Tries every mutant on the trial scenarios. Cheap engines go first; the explorer and the timelines
// are asked only about properties that have not noticed the mutant yet.
#include "checker/verification/mutate/mutate.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <set>

#include <fmt/core.h>

#include "checker/engines/exact/exact.hpp"
#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/tables/tables.hpp"
#include "checker/engines/timeline/timeline.hpp"
#include "checker/verification/mutate/effect_trials.hpp"
#include "checker/verification/mutate/law_trials.hpp"
#include "checker/verification/mutate/trial_scenarios.hpp"
#include "model/implementations.hpp"
#include "props/property.hpp"

namespace stormproof::mutate {

namespace {

using checker::CheckRequest;
using checker::Findings;
using props::VerdictKind;

using EngineFunction = Findings (*)(std::span<const std::string_view>, const CheckRequest&);
using Ids = std::set<std::string_view>;

/// The properties that are violated on one scenario.
Ids violated(EngineFunction engine, const Ids& properties, const CheckRequest& request) {
  const std::vector<std::string_view> list{properties.begin(), properties.end()};
  Ids found;
  if (list.empty()) return found;
  for (const auto& [id, finding] : engine(list, request)) {
    if (finding.kind == VerdictKind::violated) found.insert(id);
  }
  return found;
}

Ids without(Ids ids, const Ids& removed) {
  for (const std::string_view id : removed) ids.erase(id);
  return ids;
}

Ids whole_catalogue() {
  Ids ids;
  for (const props::Property& property : props::catalogue()) ids.insert(property.id);
  return ids;
}

/// They say that what is waited for will happen; their long proofs are asked only of mutants that
/// forget an event.
constexpr std::array<std::string_view, 2> of_causes{"composition.live", "composition.pending"};

bool forgets(const CatalogueEntry& entry) {
  return std::ranges::any_of(entry.mutant.rules.events, [](const model::EventMutation& mistake) {
    return mistake.change == model::EventMutation::Change::forget;
  });
}

/// A scenario with one engine, and the properties that hold there without a mutant.
struct Ground {
  Trial trial;
  EngineFunction engine;
  Ids hold;
  unsigned readers = 1;  ///< of one writer, for the explorer
};

class Mutator {
 public:
  explicit Mutator(const MutateOptions& options) : options_{options}, claims_{quick(options)} {}

  MutationReport run() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point started = Clock::now();
    const std::vector<CatalogueEntry> entries = wanted();
    MutationReport report;
    for (const CatalogueEntry& entry : entries) {
      if (!progress(entry.mutant.id)) {
        report.interrupted = true;
        break;
      }
      MutantResult result = entry.kind == Kind::effect ? try_effect(entry) : try_out(entry);
      if (!progress(entry.mutant.id)) {  // then it is not known what would have noticed it
        report.interrupted = true;
        break;
      }
      report.mutants.push_back(std::move(result));
    }
    report.seconds = std::chrono::duration<double>(Clock::now() - started).count();
    return report;
  }

 private:
  static smt::Options quick(const MutateOptions& options) {
    smt::Options solver = options.solver;
    solver.second_solver = false;
    solver.export_dir.clear();
    return solver;
  }

  [[nodiscard]] bool progress(std::string_view what) const {
    return !options_.on_progress || options_.on_progress(what);
  }

  /// For trials, which have nothing to say.
  [[nodiscard]] std::function<bool()> goes_on() const {
    return [this] { return progress("runs"); };
  }

  [[nodiscard]] std::vector<CatalogueEntry> wanted() const {
    std::vector<CatalogueEntry> list = mutants();
    const auto wanted = [](const auto& chosen, const auto& value) {
      return chosen.empty() || std::ranges::find(chosen, value) != chosen.end();
    };
    std::erase_if(list, [&](const CatalogueEntry& entry) {
      return !wanted(options_.only, entry.mutant.id) || !wanted(options_.kinds, entry.kind);
    });
    return list;
  }

  CheckRequest request(const Trial& trial, const checker::Mutant* mutant, unsigned readers = 1) {
    return {trial.scenario, claims_, mutant, 0, 1, options_.on_progress, readers};
  }

  /// The grounds of an implementation; what holds there is found out once.
  std::vector<Ground>& grounds(model::ImplementationKind implementation) {
    std::vector<Ground>& list = grounds_[model::index_of(implementation)];
    if (!list.empty()) return list;
    const std::vector<Trial> all = trials(implementation);
    const auto add = [&](const Trial& trial, EngineFunction engine) {
      const Ids broken = violated(engine, whole_catalogue(), request(trial, nullptr));
      list.push_back({trial, engine, without(whole_catalogue(), broken)});
    };
    for (const Trial& trial : all) add(trial, exact::check);
    for (const Trial& trial : all) {
      if (trial.all_engines) add(trial, tables::check);
    }
    for (const Trial& trial : all) {
      if (trial.all_engines) add(trial, timeline::check);
    }
    for (const Trial& trial : all) {
      if (trial.all_engines) add(trial, explorer::check);
    }
    return list;
  }

  /// Those on which the explorer looks at several readers of one writer.
  std::vector<Ground>& shared_grounds(model::ImplementationKind implementation) {
    std::vector<Ground>& list = shared_grounds_[model::index_of(implementation)];
    if (!list.empty()) return list;
    for (const Trial& trial : trials(implementation)) {
      if (!trial.all_engines) continue;
      const Ids broken =
          violated(explorer::check, whole_catalogue(), request(trial, nullptr, options_.readers));
      list.push_back(
          {trial, explorer::check, without(whole_catalogue(), broken), options_.readers});
    }
    return list;
  }

  MutantResult try_out(const CatalogueEntry& entry) {
    Ids killers;
    for (const auto implementation : entry.concerns) {
      for (const Ground& ground : grounds(implementation)) {
        Ids asked = without(ground.hold, killers);
        if (!forgets(entry)) asked = without(asked, {of_causes.begin(), of_causes.end()});
        killers.merge(violated(ground.engine, asked, request(ground.trial, &entry.mutant)));
      }
    }
    std::optional<std::vector<std::string>> laws;
    if (shows_in_runs(entry.mutant)) laws = laws_.killers(entry);
    return result_of(entry, killers, std::move(laws));
  }

  /// Runs first, then laws, the recorded composition and the search, then one with several readers
  /// if that was asked for, until somebody notices.
  MutantResult try_effect(const CatalogueEntry& entry) {
    Ids killers;
    const auto ask_on = [&](std::vector<Ground>& list, EngineFunction engine,
                            const Ids& properties) {
      for (const Ground& ground : list) {
        if (ground.engine != engine || !killers.empty()) continue;
        Ids asked;
        std::ranges::set_intersection(ground.hold, properties, std::inserter(asked, asked.end()));
        killers = violated(engine, asked, request(ground.trial, &entry.mutant, ground.readers));
      }
    };
    const auto ask = [&](EngineFunction engine, const Ids& properties) {
      ask_on(grounds(entry.concerns.front()), engine, properties);
    };
    const Ids all = whole_catalogue();
    ask(exact::check, all);
    if (killers.empty() && !effects_.are_followed(entry)) killers.insert("composition.followed");
    std::optional<std::vector<std::string>> laws;
    if (killers.empty()) laws = laws_.killers(entry);
    if (laws && laws->empty()) ask(tables::check, {"composition.total"});
    if (laws && laws->empty()) ask(explorer::check, all);
    if (options_.readers > 1 && laws && laws->empty() && killers.empty()) {
      ask_on(shared_grounds(entry.concerns.front()), explorer::check, all);
    }
    if (laws && laws->empty()) laws.reset();
    MutantResult result = result_of(entry, killers, std::move(laws));
    if (result.noticed()) return result;
    result.makes_a_difference = effects_.makes_a_difference(entry);
    if (!result.makes_a_difference) {
      result.reason = fmt::format("it changes nothing in {} random runs", EffectTrials::runs);
    }
    return result;
  }

  static MutantResult result_of(const CatalogueEntry& entry, const Ids& killers,
                                std::optional<std::vector<std::string>> laws) {
    MutantResult result;
    result.id = entry.mutant.id;
    result.kind = entry.kind;
    result.description = entry.mutant.description;
    result.killed_by_laws = std::move(laws);
    for (const props::Property& property : props::catalogue()) {
      if (killers.contains(property.id)) result.killed_by.emplace_back(property.id);
    }
    if (!result.noticed()) {
      result.reason = entry.survives_because.empty()
                          ? "no property notices it on the trial scenarios"
                          : entry.survives_because;
    }
    return result;
  }

  const MutateOptions& options_;
  smt::Claims claims_;
  std::array<std::vector<Ground>, model::implementation_traits.size()> grounds_;
  std::array<std::vector<Ground>, model::implementation_traits.size()> shared_grounds_;
  LawTrials laws_{goes_on()};
  EffectTrials effects_{goes_on()};
};

}  // namespace

bool MutantResult::noticed() const {
  const bool by_law = kind == Kind::effect && killed_by_laws && !killed_by_laws->empty();
  return !killed_by.empty() || by_law;
}

std::size_t MutationReport::killed() const {
  return static_cast<std::size_t>(std::ranges::count_if(mutants, &MutantResult::noticed));
}

std::size_t MutationReport::harmless() const {
  return static_cast<std::size_t>(
      std::ranges::count(mutants, false, &MutantResult::makes_a_difference));
}

bool MutationReport::notices_enough() const {
  constexpr std::size_t required_percent = 95;
  return 100 * killed() >= required_percent * (mutants.size() - harmless());
}

std::size_t MutationReport::killed_by(std::string_view property) const {
  return static_cast<std::size_t>(
      std::count_if(mutants.begin(), mutants.end(), [&](const MutantResult& mutant) {
        const auto& list = mutant.killed_by;
        return std::find(list.begin(), list.end(), property) != list.end();
      }));
}

std::size_t MutationReport::killed_by_laws() const {
  return static_cast<std::size_t>(
      std::count_if(mutants.begin(), mutants.end(), [](const MutantResult& mutant) {
        return mutant.killed_by_laws && !mutant.killed_by_laws->empty();
      }));
}

std::size_t MutationReport::tried_on_laws() const {
  return static_cast<std::size_t>(
      std::count_if(mutants.begin(), mutants.end(),
                    [](const MutantResult& mutant) { return mutant.killed_by_laws.has_value(); }));
}

std::size_t MutationReport::killed_by_law(std::string_view law) const {
  return static_cast<std::size_t>(
      std::count_if(mutants.begin(), mutants.end(), [&](const MutantResult& mutant) {
        const auto& list = mutant.killed_by_laws;
        return list && std::find(list->begin(), list->end(), law) != list->end();
      }));
}

MutationReport mutate(const MutateOptions& options) { return Mutator{options}.run(); }

}  // namespace stormproof::mutate
