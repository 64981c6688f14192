// Draws by remainders, because the distributions of the standard library differ between machines.
#include "checker/evidence/coverage/start_times.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "checker/experiments/trials/under_seed.hpp"

namespace stormproof::prediction {

model::Nanoseconds nanoseconds(double ms) {
  return model::Nanoseconds{std::llround(std::max(0.0, ms) * 1e6)};
}

namespace {

/// A storm is another one if a participant starts a microsecond later; no measurement is nearer.
constexpr model::Nanoseconds most_later{1'000'000};

/// A program that creates its endpoints keeps its core busy with that, and what arrives waits for
/// the threads that receive. When these have their turn nobody measured: half the way.
model::Nanoseconds listens_at(const model::Participant& participant) {
  const model::Nanoseconds creates = participant.endpoints_done - participant.start;
  return participant.start + model::Nanoseconds{creates.count() / 2};
}

}  // namespace

void StartTimes::put(model::Deployment& deployment, std::size_t sample, std::uint64_t seed) const {
  if (measured_.empty() && spread_.step_ms == 0) return;
  const bool is_repeated = sample >= measured_.size();
  std::mt19937_64 random{seed};
  for (std::uint32_t i = 0; i < deployment.size(); ++i) {
    model::Participant& participant = deployment.participants[i];
    if (measured_.empty()) {
      const double planned = spread_.planned(participant.host.value, i);
      trials::start_later(participant, nanoseconds(planned));
      continue;
    }
    const Times& times = measured_[sample % measured_.size()][i];
    trials::start_later(participant, nanoseconds(times.start) - participant.start);
    participant.endpoints_done = nanoseconds(times.endpoints_done);
    if (deployment.schedule && deployment.schedule->open_before) {
      participant.open =
          std::max(model::Nanoseconds{}, participant.start - *deployment.schedule->open_before);
      participant.ready = listens_at(participant);
    }
    if (!is_repeated) continue;
    const auto later = static_cast<std::int64_t>(random() % (most_later.count() + 1));
    trials::start_later(participant, model::Nanoseconds{later});
  }
}

}  // namespace stormproof::prediction
