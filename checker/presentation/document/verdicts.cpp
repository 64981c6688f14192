// A colour and a sign for each verdict: a bound and a sample look alike, but are not the same.
#include "checker/presentation/document/verdicts.hpp"

namespace stormproof::report {

using props::VerdictKind;

Tone tone_of(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::proved:
      return Tone::good;
    case VerdictKind::bounded:
    case VerdictKind::sampled:
      return Tone::info;
    case VerdictKind::violated:
      return Tone::bad;
    case VerdictKind::inconclusive:
      break;
  }
  return Tone::warn;
}

Text badge(VerdictKind kind) {
  return badge(tone_of(kind), name_of(kind), kind == VerdictKind::bounded ? "≤" : "");
}

}  // namespace stormproof::report
