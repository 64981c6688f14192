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

Finding FoundOfRules::once(const std::string& question, const std::function<Finding()>& decide) {
  std::packaged_task<Finding()> task{decide};
  std::shared_future<Finding> answer;
  bool is_first = false;
  {
    const std::lock_guard lock{mutex_};
    const auto [entry, fresh] = found_.try_emplace(question);
    if (fresh) entry->second = task.get_future().share();
    is_first = fresh;
    answer = entry->second;
  }
  if (is_first) task();
  return answer.get();
}

std::size_t FoundOfRules::size() const {
  const std::lock_guard lock{mutex_};
  return found_.size();
}

Finding found_of_rules(const CheckRequest& request, const std::string& question,
                       const std::function<Finding()>& decide) {
  if (request.of_rules == nullptr || request.mutant != nullptr) return decide();
  return request.of_rules->once(question, decide);
}

}  // namespace stormproof::checker
