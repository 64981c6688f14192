// How often something happens at most in any window of time: the arrival curves of network
// calculus, counted in occasions. An event that answers a packet comes after the packet, whose
// delay is known only up to a bound D: its window is D longer for each packet between the cause and
// it.
#pragma once

#include <cstdint>

#include "model/dds_profile.hpp"

namespace stormproof::calculus {

/// No bound.
inline constexpr std::int64_t endless = INT64_MAX;

/// a·b and a + b for a, b ≥ 0, `endless` if that is too much.
[[nodiscard]] std::int64_t times(std::int64_t a, std::int64_t b);
[[nodiscard]] std::int64_t plus(std::int64_t a, std::int64_t b);

struct Recurrence {
  enum class Kind : std::uint8_t {
    once,           ///< in the whole run
    periodic,       ///< at least `period` apart
    announcements,  ///< `startup` times `startup_period` apart, then `period`
    attempts,       ///< initial ACKNACKs: `period` is their first delay
    unheard         ///< the same, of a reader whose first HEARTBEAT left when it opened
  };
  Kind kind = Kind::once;
  std::int64_t period = 1;  ///< ns, ≥ 1
  std::int64_t startup_period = 1;
  std::int64_t startup = 0;
  bool doubling = true;       ///< the distance of attempts doubles
  std::uint32_t packets = 0;  ///< how many packets lie between the cause and it
  auto operator<=>(const Recurrence&) const = default;

  /// How often at most in a closed window of length `window` ≥ 0, if no packet takes longer than
  /// `delay`; ns.
  [[nodiscard]] std::int64_t most(std::int64_t window, std::int64_t delay) const;
  /// The same, of what answers it.
  [[nodiscard]] Recurrence answered() const;

  [[nodiscard]] static Recurrence every(model::Nanoseconds period);
  [[nodiscard]] static Recurrence announcements(const model::SpdpProfile& spdp);
  /// τ_I > 0.
  [[nodiscard]] static Recurrence attempts(const model::SedpProfile& sedp);
  [[nodiscard]] static Recurrence unheard(const model::SedpProfile& sedp);
};

}  // namespace stormproof::calculus
