// A counterexample that a reader walks through: its sequence chart, and under it the events one by
// one with what they change and the states after them. Buttons, a slider and keys move; the row of
// the chart is marked. Without JavaScript it is a list.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/document/drawings.hpp"
#include "checker/verification/counterexample/chart.hpp"
#include "props/verdict.hpp"

namespace stormproof::report {

/// `chart`, which is that of `counterexample`, with its steps; `id` is unique in the document.
/// Names of machines whose states it shows are added to `machines`.
[[nodiscard]] Sequence walk(const props::Counterexample& counterexample,
                            counterexample::Chart chart, std::string id, std::string caption,
                            std::set<std::string>& machines);

/// Diagrams of these machines, in which the states of the current step are marked; folded.
void add_machines(Blocks& blocks, const std::set<std::string>& machines);

/// HTML of chart and stepper. `chart` is that of `counterexample`; `id` is unique in the page;
/// `caption` (plain) says what is shown. Names of machines whose states it shows are added to
/// `machines`.
[[nodiscard]] std::string walk_html(const props::Counterexample& counterexample,
                                    const counterexample::Chart& chart, std::string_view id,
                                    std::string_view caption, Drawings& drawings,
                                    std::set<std::string>& machines);

/// Diagrams of these machines, in which the states of the current step are marked; folded.
[[nodiscard]] std::string machines_html(const std::set<std::string>& machines, Drawings& drawings);

}  // namespace stormproof::report
