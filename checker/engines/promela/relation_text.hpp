// What the models of both writers have in common, as text: names, what is in flight, the reader,
// losses and the claims.
#pragma once

#include <string>
#include <string_view>

namespace stormproof::promela {

/// `pattern` once for each descriptor, with its number in place of every "{0}".
[[nodiscard]] std::string each_descriptor(unsigned descriptors, std::string_view pattern);

/// First lines of a model.
[[nodiscard]] std::string preamble(std::string_view machine, unsigned descriptors);

/// The states, the outboxes, the reader's bitmap, and what is in flight or due.
[[nodiscard]] std::string variables(unsigned descriptors);

/// Processes that both models have: HEARTBEATs while something is not acknowledged, DATA that
/// arrives, ACKNACKs that overtake each other, and losses until they end for good.
[[nodiscard]] std::string processes(unsigned descriptors);

/// safe_d for each descriptor, and progress.
[[nodiscard]] std::string claims(unsigned descriptors);

}  // namespace stormproof::promela
