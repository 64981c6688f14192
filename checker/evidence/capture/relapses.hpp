// Readers that begin anew in a capture: they had acknowledged more than they do now. Their
// participant forgot that of the writer, since its lease ended or it was started again; discovery
// happens once more between the two.
#pragma once

#include <cstdint>
#include <vector>

#include "checker/evidence/capture/events.hpp"

namespace stormproof::capture {

struct Relapse {
  GuidPrefix reader{};         ///< the participant that forgot
  GuidPrefix writer{};         ///< the one that it forgot
  std::int64_t before_ns = 0;  ///< when it acknowledged something of it last, before
  std::int64_t again_ns = 0;   ///< when it asked from the beginning, or from further back
};

/// Between hosts, in the order of `again_ns`. A single reader that claims less is no relapse: who
/// forgets a participant forgets both of its SEDP writers. Nor is one within a second, where
/// packets may have overtaken each other.
[[nodiscard]] std::vector<Relapse> relapses(const Conversation& conversation);

}  // namespace stormproof::capture
