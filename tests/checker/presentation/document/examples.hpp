// Reports made by hand, with names that try to break out of every format.
#pragma once

#include <string>

#include "checker/experiments/diff/diff_report.hpp"
#include "checker/verification/check/check_report.hpp"

namespace stormproof::report {

/// HTML, Markdown, a mention, a table cell's end, quotes, a backtick and a byte that is not UTF-8.
inline const std::string hostile = "<script>pwned=1</script>|`x` @team #1 & \"q\" 'a' ]]> */\xff";

/// A check with two violations that have counterexamples, one open question and one proof.
class CheckExample {
 public:
  CheckExample();
  [[nodiscard]] const checker::CheckReport& report() const { return report_; }
  [[nodiscard]] checker::CheckContext& context() { return context_; }

 private:
  model::Scenario scenario_;
  checker::CheckReport report_;
  checker::CheckContext context_;
};

/// A comparison that regresses in every part.
[[nodiscard]] diff::DiffReport regression();
/// Two profiles that are the same.
[[nodiscard]] diff::DiffReport equality();

/// How often `part` stands in `text`.
[[nodiscard]] std::size_t occurrences(const std::string& text, const std::string& part);

}  // namespace stormproof::report
