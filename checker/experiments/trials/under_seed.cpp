// Draws by remainders, because the distributions of the standard library differ between machines.
#include "checker/experiments/trials/under_seed.hpp"

#include <random>

namespace stormproof::trials {

model::Scenario under_seed(model::Scenario scenario, std::uint64_t seed,
                           model::Nanoseconds start_jitter) {
  model::Deployment& deployment = scenario.deployment;
  model::draw(scenario, seed);
  if (start_jitter.count() == 0) return scenario;
  std::mt19937_64 random{seed};
  const auto values = static_cast<std::uint64_t>(start_jitter.count()) + 1;
  for (model::Participant& participant : deployment.participants) {
    const model::Nanoseconds later{static_cast<std::int64_t>(random() % values)};
    participant.start = participant.start + later;
    participant.endpoints_done = participant.endpoints_done + later;
    if (participant.open) participant.open = *participant.open + later;
    if (participant.ready) participant.ready = *participant.ready + later;
  }
  return scenario;
}

}  // namespace stormproof::trials
