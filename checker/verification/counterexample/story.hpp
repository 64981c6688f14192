// A counterexample as text for a person: which property breaks and why, the deployment, the timers,
// then the events that led there, one by one, each showing only what changes.
#pragma once

#include <cstddef>
#include <string>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "props/verdict.hpp"

namespace stormproof::counterexample {

/// Lines of at most `columns` where words allow it. Of more than 40 relevant events, those in the
/// middle are left out and counted.
[[nodiscard]] std::string story(const props::Counterexample& counterexample,
                                std::size_t columns = report::report_width);
/// The same for a document, which is told when it is known how wide it is shown.
[[nodiscard]] report::Story told(props::Counterexample counterexample);

/// "2 participants: 0 (host 0, 1 pub + 1 sub), 1 (host 1, …)": one line.
[[nodiscard]] std::string deployment_text(const model::Scenario& scenario);
/// The durations that decide when something is repaired, and what the network loses.
[[nodiscard]] std::string timers_text(const model::Scenario& scenario);

}  // namespace stormproof::counterexample
