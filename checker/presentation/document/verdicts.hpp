// How verdicts look in reports.
#pragma once

#include "checker/presentation/document/document.hpp"
#include "props/verdict.hpp"

namespace stormproof::report {

[[nodiscard]] Tone tone_of(props::VerdictKind kind);

/// "✓ proved", "≤ bounded", "≈ sampled", "· observed", "✗ violated", "? inconclusive", "≠
/// disputed".
[[nodiscard]] Text badge(props::VerdictKind kind);

}  // namespace stormproof::report
