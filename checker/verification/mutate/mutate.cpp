// Tries every mutant on the trial scenarios, cheap engines first, until somebody notices it. If
// everybody is asked, then each engine only about properties that have not noticed it yet.
#include "checker/verification/mutate/mutate.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <iterator>
#include <mutex>
#include <thread>

#include <fmt/core.h>

#include "checker/engines/exact/exact.hpp"
#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/tables/tables.hpp"
#include "checker/engines/timeline/timeline.hpp"
#include "checker/verification/mutate/effect_trials.hpp"
#include "checker/verification/mutate/law_trials.hpp"
#include "checker/verification/mutate/trial_scenarios.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"

namespace stormproof::mutate {

namespace {

using checker::CheckRequest;
using checker::Findings;
using props::Engine;
using props::VerdictKind;

using EngineFunction = Findings (*)(std::span<const std::string_view>, const CheckRequest&);

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

/// What the engine is asked about the scenario.
Ids decided_by(Engine engine, const model::Scenario& scenario) {
  Ids ids;
  for (const props::Property& property : props::catalogue()) {
    if (applicability_of(property, scenario).is_decided_by(engine)) ids.insert(property.id);
  }
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

/// The cheapest first.
constexpr std::array<EngineFunction, 4> engines{exact::check, tables::check, timeline::check,
                                                explorer::check};

/// One engine on one scenario, asked about some properties at once.
struct Question {
  Trial trial;
  EngineFunction engine;
  Ids properties;
  unsigned readers = 1;          ///< of one writer, for the explorer
  std::optional<Ids> hold = {};  ///< of the properties without a mutant, once that was asked
};

/// Each property of the tables is a question of its own.
std::vector<Question> questions_of(model::ImplementationKind implementation) {
  std::vector<Question> list;
  for (const Trial& trial : trials(implementation)) {
    const auto decided = [&](Engine engine) { return decided_by(engine, trial.scenario); };
    list.push_back({trial, exact::check, decided(Engine::exact_run)});
    if (!trial.all_engines) continue;
    const Ids of_tables = decided(Engine::tables);
    for (const std::string_view id : tables::decidable()) {
      if (of_tables.contains(id)) list.push_back({trial, tables::check, {id}});
    }
    list.push_back({trial, timeline::check, decided(Engine::timelines)});
    list.push_back({trial, explorer::check, decided(Engine::explorer)});
  }
  return list;
}

class Mutator {
 public:
  Mutator(const MutateOptions& options, LawTrials& laws, EffectTrials& effects)
      : options_{options}, claims_{quick(options)}, laws_{laws}, effects_{effects} {}

  MutantResult try_mutant(const CatalogueEntry& entry) {
    return entry.kind == Kind::effect ? try_effect(entry) : try_out(entry);
  }

 private:
  static smt::Options quick(const MutateOptions& options) {
    smt::Options solver = options.solver;
    solver.second_solver = false;
    solver.export_dir.clear();
    return solver;
  }

  CheckRequest request(const Question& question, const checker::Mutant* mutant) {
    return {question.trial.scenario, claims_, mutant, 0, 1, options_.on_progress, question.readers};
  }

  std::vector<Question>& questions(model::ImplementationKind implementation) {
    std::vector<Question>& list = questions_[model::index_of(implementation)];
    if (list.empty()) list = questions_of(implementation);
    return list;
  }

  /// Those in which the explorer looks at several readers of one writer.
  std::vector<Question>& shared_questions(model::ImplementationKind implementation) {
    std::vector<Question>& list = shared_questions_[model::index_of(implementation)];
    if (!list.empty()) return list;
    for (const Trial& trial : trials(implementation)) {
      if (!trial.all_engines) continue;
      const Ids ids = decided_by(Engine::explorer, trial.scenario);
      list.push_back({trial, explorer::check, ids, options_.readers});
    }
    return list;
  }

  /// Which of the properties of the question hold without a mutant.
  const Ids& hold(Question& question) {
    if (!question.hold) {
      const Ids broken = violated(question.engine, question.properties, request(question, nullptr));
      question.hold = without(question.properties, broken);
    }
    return *question.hold;
  }

  /// Who notices the mutant, of `properties`.
  Ids ask(Question& question, const Ids& properties, const CatalogueEntry& entry) {
    Ids asked;
    std::ranges::set_intersection(question.properties, properties,
                                  std::inserter(asked, asked.end()));
    if (asked.empty()) return asked;
    const Ids& held = hold(question);
    std::erase_if(asked, [&](std::string_view id) { return !held.contains(id); });
    return violated(question.engine, asked, request(question, &entry.mutant));
  }

  /// Asks engine after engine, each on all implementations that are concerned, until somebody
  /// notices; everybody if that is wanted. Nobody asks the laws of what has been noticed.
  MutantResult try_out(const CatalogueEntry& entry) {
    Ids properties = whole_catalogue();
    if (!forgets(entry)) properties = without(properties, {of_causes.begin(), of_causes.end()});
    Ids killers;
    for (const EngineFunction engine : engines) {
      for (const auto implementation : entry.concerns) {
        for (Question& question : questions(implementation)) {
          if (question.engine != engine || (!options_.everybody && !killers.empty())) continue;
          killers.merge(ask(question, without(properties, killers), entry));
        }
      }
    }
    std::optional<std::vector<std::string>> laws;
    const bool wanted = options_.everybody || killers.empty();
    if (wanted && shows_in_runs(entry.mutant)) laws = laws_.killers(entry);
    return result_of(entry, killers, std::move(laws));
  }

  /// Runs first, then laws, the recorded composition and the search, then one with several readers
  /// if that was asked for, until somebody notices; last who executes the correct rules beside a
  /// run.
  MutantResult try_effect(const CatalogueEntry& entry) {
    Ids killers;
    const auto ask_on = [&](std::vector<Question>& list, EngineFunction engine,
                            const Ids& properties) {
      for (Question& question : list) {
        if (question.engine != engine || !killers.empty()) continue;
        killers = ask(question, properties, entry);
      }
    };
    std::vector<Question>& usual = questions(entry.concerns.front());
    const Ids from_outside = without(whole_catalogue(), {followed});
    ask_on(usual, exact::check, from_outside);
    EffectFindings random;
    if (killers.empty()) {
      random = effects_.try_out(entry);
      killers = random.objections;
    }
    std::optional<std::vector<std::string>> laws = laws_among(killers);
    if (killers.empty()) laws = laws_.killers(entry);
    const bool unnoticed = killers.empty() && (!laws || laws->empty());
    if (unnoticed) {
      ask_on(usual, tables::check, {"composition.total"});
      ask_on(usual, explorer::check, from_outside);
      if (options_.readers > 1) {
        ask_on(shared_questions(entry.concerns.front()), explorer::check, from_outside);
      }
    }
    if (laws && laws->empty()) laws.reset();
    const bool is_noticed = !killers.empty() || laws;
    if (!is_noticed && !random.are_followed) killers.insert(followed);
    if (!is_noticed) ask_on(usual, exact::check, {followed});
    MutantResult result = result_of(entry, killers, std::move(laws));
    if (is_noticed) return result;
    result.harm = random.harm;
    if (result.unseen()) {
      result.reason = fmt::format("no difference in {} random runs", EffectTrials::runs);
    }
    return result;
  }

  /// The laws among the ids, if there are any.
  static std::optional<std::vector<std::string>> laws_among(const Ids& ids) {
    std::vector<std::string> laws;
    for (const props::Law& law : props::laws()) {
      if (ids.contains(law.id)) laws.emplace_back(law.id);
    }
    return laws.empty() ? std::nullopt : std::optional{std::move(laws)};
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
      result.reason = entry.survives_because.empty() ? "no property and no law notices it"
                                                     : entry.survives_because;
    }
    return result;
  }

  const MutateOptions& options_;
  smt::Claims claims_;
  std::array<std::vector<Question>, model::implementation_traits.size()> questions_;
  std::array<std::vector<Question>, model::implementation_traits.size()> shared_questions_;
  LawTrials& laws_;
  EffectTrials& effects_;
};

std::vector<CatalogueEntry> wanted(const MutateOptions& options) {
  std::vector<CatalogueEntry> list = mutants();
  const auto is_wanted = [](const auto& chosen, const auto& value) {
    return chosen.empty() || std::ranges::find(chosen, value) != chosen.end();
  };
  std::erase_if(list, [&](const CatalogueEntry& entry) {
    return !is_wanted(options.only, entry.mutant.id) || !is_wanted(options.kinds, entry.kind);
  });
  return list;
}

/// The threads take one mutant after the other; each has a solver, and questions, of its own.
class Mutators {
 public:
  explicit Mutators(const MutateOptions& options)
      : entries_{wanted(options)}, results_{entries_.size()}, options_{options} {
    options_.on_progress = [this, ask = options.on_progress](std::string_view what) {
      if (ask) {
        const std::lock_guard lock{asking_};
        if (!stopped_ && !ask(what)) stopped_ = true;
      }
      return !stopped_;
    };
  }

  MutationReport run() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point started = Clock::now();
    const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
    {
      std::vector<std::jthread> others;
      for (std::size_t k = 1; k < std::min(cores, entries_.size()); ++k) {
        others.emplace_back([this] { work(); });
      }
      work();
    }
    MutationReport report;
    report.everybody = options_.everybody;
    for (std::optional<MutantResult>& result : results_) {
      if (result) report.mutants.push_back(*std::move(result));
    }
    report.interrupted = report.mutants.size() < entries_.size();
    report.seconds = std::chrono::duration<double>(Clock::now() - started).count();
    return report;
  }

 private:
  void work() {
    Mutator mutator{options_, laws_, effects_};
    for (std::size_t k = next_++; k < entries_.size(); k = next_++) {
      const std::string& id = entries_[k].mutant.id;
      if (!options_.on_progress(id)) return;
      MutantResult result = mutator.try_mutant(entries_[k]);
      if (!options_.on_progress(id)) return;  // it is not known what would have noticed it
      results_[k] = std::move(result);
    }
  }

  std::vector<CatalogueEntry> entries_;
  std::vector<std::optional<MutantResult>> results_;  // of each
  MutateOptions options_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex asking_;
  std::atomic<bool> stopped_ = false;
  const std::function<bool()> goes_on_ = [this] { return options_.on_progress("runs"); };
  LawTrials laws_{goes_on_};
  EffectTrials effects_{goes_on_};
};

}  // namespace

MutationReport mutate(const MutateOptions& options) { return Mutators{options}.run(); }

}  // namespace stormproof::mutate
