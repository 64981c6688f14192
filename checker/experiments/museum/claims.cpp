// The list of claims, and which monitor decides each.
#include "checker/experiments/museum/claims.hpp"

#include <algorithm>
#include <array>

#include "props/monitors/monitors.hpp"
#include "props/property.hpp"

namespace stormproof::museum {

namespace {

constexpr std::string_view copy_per_loss = "storm.copy-per-loss";
/// The one of which an exhibit says the bound: the smallest scenarios recover sooner than any.
constexpr std::string_view recovery = "live.recovery";

constexpr std::array<std::string_view, 8> of_the_catalogue{recovery,
                                                           "live.isolation",
                                                           "timer.progress",
                                                           "safety.ack-implies-received",
                                                           "safety.ack-stable",
                                                           "storm.join-cost",
                                                           "storm.piggyback-rate",
                                                           "storm.feedback-gain"};

std::vector<Claim> all_claims() {
  std::vector<Claim> all;
  for (const std::string_view id : of_the_catalogue) {
    const props::Property& property = *props::find_property(id);
    all.push_back({property.id, property.statement, property.formal, id == recovery});
  }
  all.push_back({copy_per_loss, "A descriptor is sent again only if it was lost.",
                 "∀ i, j, s, d: generated(d) ≤ 1 + |{lost packets that carry d to j}|"});
  return all;
}

}  // namespace

const std::vector<Claim>& claims() {
  static const std::vector<Claim> all = all_claims();
  return all;
}

const Claim* find_claim(std::string_view id) {
  const auto found = std::ranges::find(claims(), id, &Claim::id);
  return found == claims().end() ? nullptr : &*found;
}

std::unique_ptr<props::Monitor> monitor_of(std::string_view claim, const model::Scenario& scenario,
                                           std::optional<model::Nanoseconds> bound) {
  if (claim == copy_per_loss) return watch_copies();
  if (claim == recovery) return props::watch_recovery(scenario, bound);
  return props::make_monitor(claim, scenario);
}

}  // namespace stormproof::museum
