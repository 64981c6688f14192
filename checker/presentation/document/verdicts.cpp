// A colour and a sign for each verdict: what covers less than everything looks alike, but is not
// the same.
#include "checker/presentation/document/verdicts.hpp"

namespace stormproof::report {

using props::VerdictKind;

Tone tone_of(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::proved:
      return Tone::good;
    case VerdictKind::bounded:
    case VerdictKind::sampled:
    case VerdictKind::observed:
      return Tone::info;
    case VerdictKind::violated:
    case VerdictKind::disputed:
      return Tone::bad;
    case VerdictKind::inconclusive:
      break;
  }
  return Tone::warn;
}

Text badge(VerdictKind kind) {
  const char* const sign = kind == VerdictKind::bounded    ? "≤"
                           : kind == VerdictKind::observed ? "·"
                           : kind == VerdictKind::disputed ? "≠"
                                                           : "";
  return badge(tone_of(kind), name_of(kind), sign);
}

}  // namespace stormproof::report
