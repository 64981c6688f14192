// From properties to searches and back: which claims are looked for in which scope, what becomes of
// an objection, and what the finding says.
#include <array>
#include <chrono>
#include <memory>

#include "checker/engines/explorer/answer.hpp"
#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/relation_world.hpp"
#include "checker/engines/explorer/replay.hpp"
#include "props/applicability.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/quiescence.hpp"

namespace stormproof::explorer {

namespace {

using Clock = std::chrono::steady_clock;
using props::Finding;

struct Entry {
  std::string_view property;
  Claim claim;
};
constexpr std::array<Entry, claim_count> entries{{
    {"safety.ack-implies-received", Claim::ack_implies_received},
    {"safety.repair-only-if-asked", Claim::repair_only_if_asked},
    {"safety.snapshot", Claim::snapshot},
    {"timer.single-heartbeat", Claim::single_heartbeat},
    {"timer.suppression-honoured", Claim::suppression_honoured},
    {"live.no-stall", Claim::no_stall},
    {"live.completion", Claim::completion},
    {"live.quiescence", Claim::quiescence},
    {"storm.single-copy", Claim::single_copy},
    {"storm.free-threshold", Claim::free_threshold},
}};

/// Claims that are looked for in one search. Each bound on a time adds a mark to the states, which
/// are more then, so what refers to one is looked for by itself. Limits count states, so that an
/// answer is the same on every machine.
struct Group {
  Claims claims = 0;
  std::uint64_t most_states = 0;  ///< of one search
  std::uint64_t in_all = 0;       ///< of all searches with the same number of readers
};
constexpr std::array<Group, 3> groups{{
    {bit(Claim::completion), 200'000, 1'000'000},
    {static_cast<Claims>(~(bit(Claim::completion) | bit(Claim::quiescence))), 400'000, 2'000'000},
    {bit(Claim::quiescence), 100'000, 500'000},
}};
/// In one of the many checks of `mutate`, a mistake that matters shows early: so much less.
constexpr std::uint64_t share_of_mutant = 12;

class Exploration {
 public:
  Exploration(const Request& request, Claims claims)
      : request_{request}, running_{request.scenario}, open_{claims} {
    mutation_ = request.misread;
    if (request.mutant == nullptr) return;
    mutation_ = request.mutant->rules;
    if (request.mutant->knobs) request.mutant->knobs(running_);
  }

  [[nodiscard]] bool adaptive() const {
    return running_.dds.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive;
  }

  void run() {
    const bool is_alone = props::has_samples(running_);
    where_.readers = is_alone ? 1 : request_.readers;
    where_.writers = is_alone ? 1 : request_.writers;
    where_.delay = delay_bound(request_.scenario, [&] { return go_on("measuring packet delays"); });
    where_.assumptions = assumptions_of(running_, where_);
    run(scopes(running_, where_.delay.delay));
    for (unsigned readers = 2; readers <= where_.readers; ++readers) {
      run(shared_scopes(running_, where_.delay.delay, readers));
    }
    if (where_.writers > 1) {
      run(shared_scopes(running_, where_.delay.delay, 1, where_.writers));
    }
  }

  [[nodiscard]] Finding finding(Claim claim) const {
    return answers_[static_cast<std::size_t>(claim)].finding(claim, where_);
  }

 private:
  void run(const std::vector<Scope>& list) {
    for (const Group& group : groups) {
      std::uint64_t left = request_.mutant == nullptr ? group.in_all * request_.effort
                                                      : group.in_all / share_of_mutant;
      for (std::size_t k = 0; k < list.size(); ++k) {
        claims_ = open_ & group.claims;
        if (claims_ == 0 || where_.interrupted) break;
        // What a scope does not need of its share is left to those after it.
        limit_ = std::min(group.most_states * request_.effort, left / (list.size() - k));
        const Scope& scope = list[k];
        explore<RelationWorld>(scope);
        left -= std::min(left, searched_);
      }
    }
  }

  bool go_on(const std::string& what) {
    if (request_.on_progress && !request_.on_progress(what)) where_.interrupted = true;
    return !where_.interrupted;
  }

  template <class World>
  void explore(const Scope& scope) {
    searched_ = 0;
    Bounds bounds;
    if ((claims_ & bit(Claim::completion)) != 0) {
      bounds.completion = completion_bound(request_.scenario.dds, scope);
      if (!bounds.completion) return;
    }
    if ((claims_ & bit(Claim::quiescence)) != 0) {
      bounds.quiescence = props::quiescence_bound(request_.scenario.dds, scope.largest_delay);
    }
    search<World>(scope, bounds);
  }

  template <class World>
  void search(Scope scope, const Bounds& bounds) {
    const Clock::time_point start = Clock::now();
    // Whether a budget is used up is known afterwards: then it has to be counted.
    const auto rides_after = generated_before_heartbeat(running_);
    scope.counts_bytes = rides_after == 0U;
    auto world = std::make_unique<World>(running_, request_.scenario, scope, mutation_);
    SearchResult result = search(*world, bounds, rides_after.value_or(0));
    if (!scope.counts_bytes && rides_after && result.most_generated > *rides_after) {
      scope.counts_bytes = true;
      world = std::make_unique<World>(running_, request_.scenario, scope, mutation_);
      result = search(*world, bounds, 0);
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    for (const Entry& entry : entries) {
      if ((claims_ & bit(entry.claim)) == 0) continue;
      Answer& answer = answers_[static_cast<std::size_t>(entry.claim)];
      answer.note_effort(result.states, seconds);
      const auto& path = result.objections[static_cast<std::size_t>(entry.claim)];
      if (path) {
        judge(*world, *path, entry, bounds, answer);
      } else {
        answer.note_scope(scope, entry.claim, result, bounds);
      }
    }
  }
  template <class World>
  SearchResult search(World& world, const Bounds& bounds, std::uint32_t counted) {
    SearchOptions options;
    options.claims = claims_;
    options.max_states = limit_;
    options.bounds = bounds;
    options.stop_when_complete = bounds.completion.has_value();
    options.count_generated = counted;
    options.go_on = [&] { return go_on("exploring " + to_text(world.scope())); };
    SearchResult result = Search<World>{world, options}.run();
    searched_ += result.states;
    return result;
  }

  template <class World>
  void judge(World& world, const std::vector<Label>& path, const Entry& entry, const Bounds& bounds,
             Answer& answer) {
    const auto concrete = concrete_path(world, path, entry.claim, bounds);
    if (!concrete) {
      answer.note_dispute(world.scope(), path.size(), "it has no concrete times.");
      return;
    }
    const ReplayRequest request{running_, request_.scenario,
                                request_.mutant == nullptr ? nullptr : &mutation_, world.scope(),
                                bounds};
    ReplayOutcome outcome = replay(request, *concrete, entry.property);
    if (!outcome.counterexample) {
      answer.note_dispute(world.scope(), path.size(), outcome.why_not);
      return;
    }
    answer.note_counterexample(world.scope(), path.size(), std::move(*outcome.counterexample));
    open_ = static_cast<Claims>(open_ & ~bit(entry.claim));
  }

  const Request& request_;
  model::Scenario running_;
  model::Mutation mutation_;
  Claims open_;  ///< claims that nothing has broken yet
  Surroundings where_;
  // Of the scope that is explored: what is looked for, the limit of a search, and all states.
  Claims claims_ = 0;
  std::uint64_t limit_ = 0;
  std::uint64_t searched_ = 0;
  std::array<Answer, claim_count> answers_;
};

}  // namespace

checker::Findings check(std::span<const std::string_view> properties,
                        const checker::CheckRequest& request) {
  return explore(properties, {request.scenario,
                              request.mutant,
                              request.on_progress,
                              request.readers,
                              request.effort,
                              {},
                              request.readers > 1 ? most_writers : 1U});
}

checker::Findings explore(std::span<const std::string_view> properties, const Request& request) {
  Claims claims = 0;
  for (const Entry& entry : entries) {
    const bool is_asked = std::ranges::find(properties, entry.property) != properties.end();
    const props::Applicability answer = props::applicability_of(entry.property, request.scenario);
    if (is_asked && answer.is_decided_by(props::Engine::explorer)) claims |= bit(entry.claim);
  }
  checker::Findings findings;
  if (claims == 0) return findings;
  Exploration exploration{request, claims};
  if (!exploration.adaptive()) exploration.run();
  for (const std::string_view property : properties) {
    const auto entry = std::ranges::find(entries, property, &Entry::property);
    if (entry == entries.end() || (claims & bit(entry->claim)) == 0) continue;
    Finding finding;
    if (exploration.adaptive()) {
      finding.engine = "explorer";
      finding.how =
          "the adaptive policy's periods depend on response times, which difference "
          "constraints cannot express";
    } else {
      finding = exploration.finding(entry->claim);
    }
    findings.emplace_back(entry->property, std::move(finding));
  }
  return findings;
}

}  // namespace stormproof::explorer
