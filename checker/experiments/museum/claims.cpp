// The list of claims, and which monitor decides each.
#include "checker/experiments/museum/claims.hpp"

#include <algorithm>
#include <array>

namespace stormproof::museum {

namespace {
constexpr std::array all_claims{
    Claim{"live.recovery",
          "Once nothing fails any more, everybody has what it lacks within a bound.",
          "∀ t* such that no packet is lost, no outage lasts and nobody starts after t*: "
          "X_ij,d = 1 at t* + B for all d of all living i, j",
          true},
    Claim{"live.isolation", "A participant that is dead delays nobody else.",
          "∀ dead k, ∀ i, j ≠ k: X_ij,d = 1 at t* + B, where B says nothing of k", true},
    Claim{"timer.progress", "Time goes on: no instant carries infinitely many events.",
          "∀ t: |{e : time(e) = t}| < ∞ (a run is held to 10000)"},
    Claim{"safety.ack-implies-received", "Who is believed to have a descriptor has it.",
          "□ (C_ij,d = A ⇒ X_ij,d = 1) for relations that nobody has forgotten"},
    Claim{"safety.ack-stable", "What is acknowledged stays so unless the reader forgot it.",
          "□ (C_ij,d leaves A ⇒ X_ij,d = 0)"},
    Claim{"storm.copy-per-loss", "A descriptor is sent again only if it was lost.",
          "∀ i, j, s, d: generated(d) ≤ 1 + |{lost packets that carry d to j}|"},
    Claim{"storm.join-cost", "Who is recognised costs one announcement.",
          "∀ event in which r participants are recognised: announcements sent in it ≤ r"},
    Claim{"storm.piggyback-rate", "DATA causes HEARTBEATs in proportion to its bytes.",
          "∀ t: HEARTBEATs that ride in DATA up to t ≤ bytes of DATA up to t / threshold + "
          "|writers|"},
    Claim{"storm.feedback-gain",
          "An ACKNACK that changes nothing causes no HEARTBEAT at once, and none causes two.",
          "∀ reception of an ordinary ACKNACK: HEARTBEATs sent in it ≤ 1, and 0 unless some C "
          "changes"}};
}  // namespace

std::span<const Claim> claims() { return all_claims; }

const Claim* find_claim(std::string_view id) {
  const auto* const found = std::ranges::find(all_claims, id, &Claim::id);
  return found == all_claims.end() ? nullptr : found;
}

std::unique_ptr<ClaimMonitor> monitor_of(std::string_view claim, const model::Scenario& scenario,
                                         std::optional<model::Nanoseconds> bound) {
  if (claim == "live.recovery" || claim == "live.isolation") {
    return watch_recovery(claim, scenario, bound.value_or(scenario.time_limit));
  }
  if (claim == "timer.progress") return watch_progress();
  if (claim == "safety.ack-implies-received") return watch_acknowledgments(false);
  if (claim == "safety.ack-stable") return watch_acknowledgments(true);
  if (claim == "storm.copy-per-loss") return watch_copies();
  if (claim == "storm.join-cost") return watch_joins();
  if (claim == "storm.piggyback-rate") return watch_piggybacks(scenario);
  return watch_feedback();
}

}  // namespace stormproof::museum
