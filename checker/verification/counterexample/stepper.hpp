// A counterexample that a reader walks through: its sequence chart, and under it the events one by
// one with what they change and the states after them. Buttons, a slider and keys move; the row of
// the chart is marked. Without JavaScript it is a list.
#pragma once

#include <set>
#include <string>

#include "checker/presentation/document/document.hpp"
#include "checker/verification/counterexample/chart.hpp"
#include "props/verdict.hpp"

namespace stormproof::counterexample {

/// The chart with the steps of a page. `chart` is that of `counterexample`; `id` is unique in the
/// document; `caption` says what is shown. Names of machines whose states it shows are added to
/// `machines`. It runs the counterexample once more.
[[nodiscard]] report::Sequence walk(const props::Counterexample& counterexample, Chart chart,
                                    std::string id, std::string caption,
                                    std::set<std::string>& machines);

/// Diagrams of these machines, in which the states of the current step are marked; folded, for
/// pages.
[[nodiscard]] report::Section diagrams_of(const std::set<std::string>& machines);

}  // namespace stormproof::counterexample
