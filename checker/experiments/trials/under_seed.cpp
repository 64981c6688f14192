// Draws by remainders, because the distributions of the standard library differ between machines.
#include "checker/experiments/trials/under_seed.hpp"

#include <algorithm>
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
    start_later(participant, later);
  }
  return scenario;
}

void start_later(model::Participant& participant, model::Nanoseconds later) {
  const auto moved = [later](model::Nanoseconds time) {
    return std::max(model::Nanoseconds{}, time + later);
  };
  participant.start = moved(participant.start);
  participant.endpoints_done = moved(participant.endpoints_done);
  if (participant.open) participant.open = moved(*participant.open);
  if (participant.ready) participant.ready = moved(*participant.ready);
}

}  // namespace stormproof::trials
