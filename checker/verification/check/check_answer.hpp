// The first lines of a check's document.
#pragma once

#include "checker/verification/check/check_report.hpp"

namespace stormproof::checker {

/// Answer, tone, exit code, subject, and the table of the three questions.
void add_answer(report::Document& document, const CheckReport& report, const CheckContext& context);

}  // namespace stormproof::checker
