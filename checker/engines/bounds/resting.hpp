// Findings that rest on others: a theorem that takes something from a certificate about the rules,
// a certificate that several properties take something from, and what several checks find alike.
#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <string>

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::checker {

/// Turns a finding into one without an answer, unless it is disputed.
void leave_open(props::Finding& finding, const std::string& why);

/// Adds what a theorem takes from a certificate about the rules: its assumptions, and how it is
/// known. Without that certificate there is no proof.
void rest_on(props::Finding& finding, const props::Finding& certificate);

/// What `decide` finds, which is asked once in a check.
[[nodiscard]] props::Finding known(const CheckRequest& request, const std::string& name,
                                   const std::function<props::Finding()>& decide);

/// Answers that several checks share, which may run side by side. They are about the rules, not
/// about the numbers of a profile, and a question says all that its answer depends on.
class FoundOfRules {
 public:
  /// What `decide` finds, which is asked once: whoever comes second waits for the first.
  [[nodiscard]] props::Finding once(const std::string& question,
                                    const std::function<props::Finding()>& decide);
  /// How many questions were asked.
  [[nodiscard]] std::size_t size() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_future<props::Finding>> found_;
};

/// What `decide` finds, or what another check has found; mutants have rules of their own.
[[nodiscard]] props::Finding found_of_rules(const CheckRequest& request,
                                            const std::string& question,
                                            const std::function<props::Finding()>& decide);

}  // namespace stormproof::checker
