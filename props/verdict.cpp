// Names of verdicts, as reports and `--require` spell them.
#include "props/verdict.hpp"

namespace stormproof::props {

const char* name_of(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::proved:
      return "proved";
    case VerdictKind::bounded:
      return "bounded";
    case VerdictKind::sampled:
      return "sampled";
    case VerdictKind::violated:
      return "violated";
    case VerdictKind::inconclusive:
      return "inconclusive";
  }
  return "";
}

}  // namespace stormproof::props
