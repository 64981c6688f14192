// Patterns in the order of their size; of one size, in that of their numbers.
#include "checker/experiments/museum/search.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/experiments/museum/claims.hpp"
#include "model/simulator.hpp"

namespace stormproof::museum {

namespace {

/// A run with more events than this is taken to stand still in time; the claim about time objects
/// before, and no other one can say anything.
constexpr std::uint64_t most_events = 1'000'000;

class Search {
 public:
  Search(const Exhibit& exhibit, const Variant& variant, const std::function<bool()>& go_on)
      : exhibit_{exhibit}, scenario_{variant.scenario}, go_on_{go_on} {
    scenario_.run_until = model::RunUntil::time_limit;
    given_ = scenario_.wireless.lost_packets;
  }

  Found run() {
    for (std::uint32_t losses = 0; losses <= exhibit_.losses && !is_over(); ++losses) {
      std::vector<std::uint64_t> lost;
      try_all(lost, losses, 0);
    }
    if (found_.counterexample) {
      found_.verdict = props::VerdictKind::violated;
    } else if (!stopped_ && !undecided_) {
      found_.verdict = props::VerdictKind::bounded;
    }
    found_.how = words();
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool is_over() const { return stopped_ || found_.counterexample.has_value(); }

  /// All patterns that add `more` losses, from packet `first` on, to those in `lost`.
  void try_all(std::vector<std::uint64_t>& lost, std::uint32_t more, std::uint64_t first) {
    if (more == 0) return try_one(lost);
    for (std::uint64_t packet = first; packet + more <= exhibit_.packets && !is_over(); ++packet) {
      lost.push_back(packet);
      try_all(lost, more - 1, packet + 1);
      lost.pop_back();
    }
  }

  void try_one(const std::vector<std::uint64_t>& lost) {
    if (!go_on_()) {
      stopped_ = true;
      return;
    }
    scenario_.wireless.lost_packets = given_;
    scenario_.wireless.lost_packets.insert(scenario_.wireless.lost_packets.end(), lost.begin(),
                                           lost.end());
    std::ranges::sort(scenario_.wireless.lost_packets);
    const auto monitor = monitor_of(exhibit_.claim, scenario_, exhibit_.bound);
    model::RunOptions options;
    options.probe = monitor.get();
    options.max_events = most_events;
    options.on_progress = [&](const model::Progress&) {
      stopped_ = stopped_ || !go_on_();
      return !stopped_ && !monitor->violation();
    };
    const model::RunResult result = simulate(scenario_, options);
    ++found_.runs;
    const bool is_whole = result.end != model::RunEnd::interrupted;
    if (is_whole) monitor->finish(scenario_.time_limit);
    if (const auto& violation = monitor->violation()) {
      found_.lost = lost;
      found_.counterexample = props::Counterexample{
          exhibit_.claim, scenario_, violation->event, violation->time, violation->reason, {}};
      return;
    }
    if (stopped_) return;
    undecided_ = undecided_ || !is_whole || monitor->is_undecided();
    if (result.discovery_time) {
      found_.latest =
          std::max(found_.latest.value_or(model::Nanoseconds{}), *result.discovery_time);
    }
  }

  [[nodiscard]] std::string words() const {
    const std::string scope = exhibit_.losses == 0
                                  ? "no packet lost"
                                  : fmt::format("at most {} of the first {} packets lost",
                                                exhibit_.losses, exhibit_.packets);
    const std::string until = fmt::format("with {}, every other packet as in the scenario", scope);
    if (found_.counterexample) {
      if (found_.lost.empty()) return "violated without a loss";
      return fmt::format("violated if packet{} {} {} lost; no fewer of the first {} packets do it",
                         found_.lost.size() == 1 ? "" : "s", fmt::join(found_.lost, ", "),
                         found_.lost.size() == 1 ? "is" : "are", exhibit_.packets);
    }
    if (stopped_) return fmt::format("interrupted after {} runs {}", found_.runs, until);
    if (undecided_)
      return fmt::format("some of {} runs {} are too short to say", found_.runs, until);
    return fmt::format("no violation in {} run{} {}",
                       found_.runs == 1 ? "the one" : fmt::format("all {}", found_.runs),
                       found_.runs == 1 ? "" : "s", until);
  }

  const Exhibit& exhibit_;
  model::Scenario scenario_;
  const std::function<bool()>& go_on_;
  std::vector<std::uint64_t> given_;  ///< lost in the scenario as it is
  Found found_;
  bool stopped_ = false;
  bool undecided_ = false;
};

}  // namespace

Found search(const Exhibit& exhibit, const Variant& variant, const std::function<bool()>& go_on) {
  return Search{exhibit, variant, go_on}.run();
}

}  // namespace stormproof::museum
