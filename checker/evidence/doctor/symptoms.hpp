// Why a captured discovery sends more than it needs: each repeat and each control message that the
// failure-free count does not have is put down to what the capture shows before it (repairs:
// repairs.hpp). Nothing here needs a model; the rules are those of the protocol.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::doctor {

/// One thing that causes messages.
struct Cause {
  std::string id;              ///< stable: "piggyback", "loss", …
  std::uint64_t messages = 0;  ///< that it caused; a message may count for one cause only
  std::string sentence;        ///< what happened, with its evidence
  std::string remedy;          ///< what helps against it in general; may be empty
};

/// The causes that the capture shows, the one with the most messages first. `failure_free` is what
/// the same participants need.
[[nodiscard]] std::vector<Cause> causes(const capture::Conversation& conversation,
                                        const capture::Counting& counting,
                                        const model::Counts& failure_free);

}  // namespace stormproof::doctor
