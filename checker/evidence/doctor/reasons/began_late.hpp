// What a capture shows of the time before it began.
#pragma once

#include <cstddef>
#include <cstdint>

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::doctor {

/// Of the missing keys those whose reader says that it has them.
[[nodiscard]] std::uint64_t known_before(const capture::Conversation& conversation,
                                         const capture::Counting& counting);

/// Participants of which the capture shows something before their first announcement: they were
/// there before it began.
[[nodiscard]] std::size_t there_before(const capture::Conversation& conversation);

}  // namespace stormproof::doctor
