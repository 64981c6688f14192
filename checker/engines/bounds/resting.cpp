// Kinds, and what is said of them.
#include "checker/engines/bounds/resting.hpp"

#include <algorithm>

namespace stormproof::checker {

using props::Finding;
using props::VerdictKind;

void leave_open(Finding& finding, const std::string& why) {
  if (finding.kind == VerdictKind::disputed) return;
  finding.kind = VerdictKind::inconclusive;
  finding.how += "; inconclusive: " + why;
}

void rest_on(Finding& finding, const Finding& certificate) {
  finding.how += "; what it takes from the rules: " + certificate.how;
  for (const std::string& sentence : certificate.assumptions) {
    if (std::ranges::find(finding.assumptions, sentence) != finding.assumptions.end()) continue;
    finding.assumptions.push_back(sentence);
  }
  finding.details.push_back("taken from the rules:");
  for (const std::string& line : certificate.details) finding.details.push_back("  " + line);
  finding.seconds += certificate.seconds;
  if (certificate.kind == VerdictKind::disputed) {
    dispute(finding, "so is what it takes from the rules");
  }
  if (certificate.kind != VerdictKind::proved) {
    leave_open(finding, "the rules are not known to do what the theorem starts from");
  }
}

Finding known(const CheckRequest& request, const std::string& name,
              const std::function<Finding()>& decide) {
  if (request.known == nullptr) return decide();
  const auto found = request.known->find(name);
  if (found != request.known->end()) return found->second;
  return request.known->emplace(name, decide()).first->second;
}

}  // namespace stormproof::checker
