// Names of verdicts, as reports and `--require` spell them, and what becomes of a contradiction.
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
    case VerdictKind::observed:
      return "observed";
    case VerdictKind::violated:
      return "violated";
    case VerdictKind::inconclusive:
      return "inconclusive";
    case VerdictKind::disputed:
      return "disputed";
  }
  return "";
}

void dispute(Finding& finding, const std::string& why) {
  finding.kind = VerdictKind::disputed;
  finding.how += (finding.how.empty() ? "disputed: " : "; disputed: ") + why;
}

}  // namespace stormproof::props
