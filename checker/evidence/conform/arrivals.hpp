// Which messages must have arrived for one ACKNACK: given how far the reader has got with the
// messages of its writer, which of them arrived and which were lost is determined by what the
// ACKNACK says. Pure sets, no times. A reader takes the submessages of a datagram one after the
// other, and another thread may generate an ACKNACK in between; but a datagram is lost as a whole.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "checker/evidence/conform/dialogue.hpp"

namespace stormproof::conform {

/// An ACKNACK lists at most so many descriptors from its base on.
inline constexpr std::uint32_t bitmap_limit = 256;

/// What the reader knows: X, and what was announced to it.
struct Knowledge {
  std::vector<bool> has{};      ///< X, by descriptor; and what a writer says is not to come
  std::uint32_t announced = 0;  ///< descriptors that it knows to exist
  std::uint32_t count = 0;      ///< of the latest HEARTBEAT; an older one is not accepted
  bool has_heartbeat = false;
  std::optional<std::uint32_t> datagram{};  ///< that the last submessage came in
  /// Datagram of the last submessage that was sent to the reader, if it did not arrive: what is
  /// left of it does not, either.
  std::optional<std::uint32_t> missed{};

  [[nodiscard]] bool knows(std::uint32_t d) const { return d < has.size() && has[d]; }
  /// Takes a submessage in; returns whether it was a HEARTBEAT and accepted.
  bool take(const Submessage& submessage);
  void learn(std::uint32_t descriptor);
  /// The first descriptor that has not arrived.
  [[nodiscard]] std::uint32_t base() const;
};

/// Submessages that were under way, and what became of them.
struct Arrivals {
  std::vector<bool> arrived{};             ///< by submessage; false: lost
  std::optional<std::size_t> heartbeat{};  ///< the first HEARTBEAT that arrived and was accepted
  std::size_t heartbeats = 0;              ///< how many did
  Knowledge after{};
  std::size_t lost = 0;
  /// Why base or bitmap would be different; empty: the reader would send just this.
  std::string mismatch{};
};

/// The most that can have arrived of `sent` if the reader that knew `before` then sends `answer`.
/// What is marked in `lost` has not; it may be empty.
[[nodiscard]] Arrivals arrivals_for(const Answer& answer, const Knowledge& before,
                                    std::span<const Submessage> sent,
                                    const std::vector<bool>& lost = {});

}  // namespace stormproof::conform
