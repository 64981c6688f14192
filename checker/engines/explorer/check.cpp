// From properties to searches and back: which claims are looked for in which scope, what becomes of
// an objection, and what the finding says.
#include <array>
#include <chrono>

#include <fmt/core.h>

#include "checker/engines/explorer/explorer.hpp"
#include "checker/engines/explorer/fastdds_packing.hpp"
#include "checker/engines/explorer/paper_packing.hpp"
#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/replay.hpp"
#include "model/implementations.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/quiescence.hpp"

namespace stormproof::explorer {

namespace {

using Clock = std::chrono::steady_clock;
using props::Finding;
using props::VerdictKind;

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

/// Most states of one search, and longest time for all of them: of a check, and of one of the many
/// checks of `mutate`, where a mistake that matters shows early.
constexpr std::uint64_t most_states = 400'000;
constexpr std::chrono::milliseconds most_time{8'000};
constexpr std::chrono::milliseconds most_time_for_mutant{2'000};

/// What is known about one claim.
struct Answer {
  std::optional<props::Counterexample> counterexample;
  std::string found_in;               ///< scope of the counterexample
  std::string not_replayed;           ///< why an objection does not count
  std::vector<std::string> complete;  ///< scopes that were exhausted
  std::vector<std::string> partial;   ///< scopes that were not, and how far the search came
  std::string scopes;                 ///< all of them, in short
  std::vector<std::string> remarks;
  std::uint64_t states = 0;
  double seconds = 0;
};

class Exploration {
 public:
  Exploration(const Request& request, Claims claims)
      : request_{request}, running_{request.scenario}, open_{claims} {
    if (request.mutant == nullptr) return;
    mutation_ = request.mutant->rules;
    if (request.mutant->knobs) request.mutant->knobs(running_);
  }

  [[nodiscard]] bool adaptive() const {
    return running_.dds.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive;
  }

  void run() {
    delay_ = delay_bound(request_.scenario, [&] { return go_on("measuring packet delays"); });
    run(scopes(running_, delay_.delay));
    if (request_.readers > 1) run(shared_scopes(running_, delay_.delay));
  }

  [[nodiscard]] Finding finding(Claim claim) const;

 private:
  void run(const std::vector<Scope>& list) {
    const Clock::time_point end =
        Clock::now() + (request_.mutant == nullptr ? most_time : most_time_for_mutant);
    for (std::size_t k = 0; k < list.size() && !interrupted_ && open_ != 0; ++k) {
      // What a scope does not need of its share is left to those after it.
      const auto share = (end - Clock::now()) / static_cast<std::ptrdiff_t>(list.size() - k);
      deadline_ = Clock::now() + std::max(share, Clock::duration::zero());
      const Scope& scope = list[k];
      model::visit_composition(running_.dds,
                               [&](auto composition) { explore(composition, scope); });
    }
  }

  bool go_on(const std::string& what) {
    if (request_.on_progress && !request_.on_progress(what)) interrupted_ = true;
    return !interrupted_;
  }

  void explore(model::Of<comp::paper::Paper>, const Scope& scope) {
    scope.readers > 1 ? explore<SharedPaperWorld>(scope) : explore<PaperWorld>(scope);
  }
  void explore(model::Of<comp::fastdds::FastDds>, const Scope& scope) {
    scope.readers > 1 ? explore<SharedFastDdsWorld>(scope) : explore<FastDdsWorld>(scope);
  }
  template <class World>
  void explore(const Scope& scope) {
    if ((open_ & bit(Claim::completion)) != 0) {
      const auto bound = completion_bound(request_.scenario.dds, scope);
      if (bound) search<World>(scope, bit(Claim::completion), {bound, std::nullopt});
    }
    const auto rest = static_cast<Claims>(open_ & ~bit(Claim::completion));
    if (rest == 0 || interrupted_) return;
    Bounds bounds;
    if ((rest & bit(Claim::quiescence)) != 0) {
      bounds.quiescence = props::quiescence_bound(request_.scenario.dds, scope.largest_delay);
    }
    search<World>(scope, rest, bounds);
  }

  template <class World>
  void search(const Scope& scope, Claims claims, const Bounds& bounds) {
    const Clock::time_point start = Clock::now();
    World world{running_, request_.scenario, scope, mutation_};
    SearchOptions options;
    options.claims = claims;
    options.max_states = most_states;
    options.deadline = deadline_;
    options.bounds = bounds;
    options.stop_when_complete = bounds.completion.has_value();
    options.go_on = [&] { return go_on("exploring " + to_text(scope)); };
    const SearchResult result = Search<World>{world, options}.run();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    for (const Entry& entry : entries) {
      if ((claims & bit(entry.claim)) == 0) continue;
      Answer& answer = answers_[static_cast<std::size_t>(entry.claim)];
      answer.seconds += seconds;
      answer.states += result.states;
      const auto& path = result.objections[static_cast<std::size_t>(entry.claim)];
      if (path) {
        judge(world, *path, entry, bounds, answer);
      } else {
        note_scope(scope, result, bounds, answer);
      }
    }
  }

  template <class World>
  void judge(World& world, const std::vector<Label>& path, const Entry& entry, const Bounds& bounds,
             Answer& answer) {
    const auto concrete = concrete_path(world, path, entry.claim, bounds);
    if (!concrete) {
      answer.not_replayed = "The path has no concrete times.";
      return;
    }
    const ReplayRequest request{running_, request_.scenario,
                                request_.mutant == nullptr ? nullptr : &mutation_, world.scope(),
                                bounds};
    ReplayOutcome outcome = replay(request, *concrete, entry.property);
    if (!outcome.counterexample) {
      answer.not_replayed = fmt::format("A path of {} events ({}) was found, but: {}", path.size(),
                                        to_text(world.scope()), outcome.why_not);
      return;
    }
    answer.counterexample = std::move(outcome.counterexample);
    answer.found_in = fmt::format("{} events; {}", path.size(), to_text(world.scope()));
    open_ = static_cast<Claims>(open_ & ~bit(entry.claim));
  }

  static void note_scope(const Scope& scope, const SearchResult& result, const Bounds& bounds,
                         Answer& answer) {
    answer.scopes += (answer.scopes.empty() ? "" : "; ") + short_text(scope);
    if (!result.exhausted) answer.scopes += fmt::format(" (up to {} events)", result.depth);
    if (result.exhausted) {
      answer.complete.push_back(fmt::format("{}: {} zone states", to_text(scope), result.states));
    } else {
      answer.partial.push_back(fmt::format("{}: {} zone states, all paths of up to {} events",
                                           to_text(scope), result.states, result.depth));
    }
    if (bounds.completion) {
      answer.remarks.push_back(fmt::format(
          "{}: the latest completion is at {}, B = {}.", to_text(scope),
          props::time_text(result.latest_completion), props::time_text(*bounds.completion)));
    }
  }

  const Request& request_;
  model::Scenario running_;
  model::Mutation mutation_;
  Claims open_;  ///< claims that nothing has broken yet
  DelayBound delay_;
  Clock::time_point deadline_;
  bool interrupted_ = false;
  std::array<Answer, claim_count> answers_;
};

Finding Exploration::finding(Claim claim) const {
  const Answer& answer = answers_[static_cast<std::size_t>(claim)];
  Finding finding;
  finding.engine = "explorer";
  finding.seconds = answer.seconds;
  const bool shared = request_.readers > 1;
  finding.assumptions = {
      shared
          ? fmt::format("One relation, or {} of one writer; every packet of theirs has a delay of "
                        "its own, or the one that the scope names, whatever other relations do.",
                        most_readers)
          : "One relation; every packet of it has a delay of its own, whatever other relations "
            "do.",
      delay_.origin};
  if (creates_over_time(running_)) {
    finding.assumptions.emplace_back("No HEARTBEATs ride in DATA packets.");
  }
  const model::SedpProfile& sedp = running_.dds.sedp;
  if (sedp.initial_acknack_delay.count() > 0 &&
      sedp.initial_acknack_interval == model::InitialAckNackInterval::doubling) {
    finding.assumptions.emplace_back("The delay between initial ACKNACKs doubles six times.");
  }
  finding.details = answer.complete;
  for (const std::string& scope : answer.partial) finding.details.push_back(scope);
  for (const std::string& remark : answer.remarks) finding.details.push_back(remark);
  if (answer.counterexample) {
    finding.kind = VerdictKind::violated;
    finding.counterexample = answer.counterexample;
    finding.how = "the first path that breaks it, " + answer.found_in + "; replayed";
    return finding;
  }
  if (!answer.not_replayed.empty()) {
    finding.how = answer.not_replayed;
    return finding;
  }
  if (answer.complete.empty() && answer.partial.empty()) {
    finding.how = claim == Claim::completion && !interrupted_
                      ? "no scope in which the bound counts from the start of the explored world"
                      : "interrupted";
    return finding;
  }
  finding.kind = VerdictKind::bounded;
  finding.how = fmt::format(
      "all interleavings of one relation{} with packet delays up to {}, {} zone "
      "states: {}",
      shared ? fmt::format(", and of {} of one writer,", most_readers) : "",
      props::time_text(delay_.delay), answer.states, answer.scopes);
  return finding;
}

}  // namespace

checker::Findings check(std::span<const std::string_view> properties,
                        const checker::CheckRequest& request) {
  return explore(properties,
                 {request.scenario, request.mutant, request.on_progress, request.readers});
}

checker::Findings explore(std::span<const std::string_view> properties, const Request& request) {
  Claims claims = 0;
  for (const Entry& entry : entries) {
    if (std::ranges::find(properties, entry.property) != properties.end())
      claims |= bit(entry.claim);
  }
  checker::Findings findings;
  if (claims == 0) return findings;
  Exploration exploration{request, claims};
  if (!exploration.adaptive()) exploration.run();
  for (const std::string_view property : properties) {
    const auto entry = std::ranges::find(entries, property, &Entry::property);
    if (entry == entries.end()) continue;
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
