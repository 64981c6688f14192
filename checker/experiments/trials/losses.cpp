// One draw for each packet.
#include "checker/experiments/trials/losses.hpp"

#include <cmath>
#include <random>

namespace stormproof::trials {

std::vector<std::uint64_t> draw_losses(double probability, std::uint64_t seed) {
  constexpr std::uint64_t packets = 2'000'000;
  constexpr std::uint64_t other_than_schedules = 0x6c6f7373;  // the schedule has the plain seed
  std::mt19937_64 random{seed ^ other_than_schedules};
  std::vector<std::uint64_t> lost;
  const double scale = std::ldexp(1.0, -64);
  for (std::uint64_t packet = 0; packet < packets; ++packet) {
    if (static_cast<double>(random()) * scale < probability) lost.push_back(packet);
  }
  return lost;
}

}  // namespace stormproof::trials
