// The least scenario that tells two profiles apart, and both runs of it up to where they part.
#include <fmt/core.h>

#include "checker/experiments/diff/diff_parts.hpp"
#include "checker/experiments/diff/paired_charts.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/counterexample/stepper.hpp"
#include "checker/verification/counterexample/story.hpp"

namespace stormproof::diff {

namespace {

using report::Facts;

Facts apart_facts(const TellingApart& apart, const Files& files) {
  Facts facts;
  const auto add = [&facts](const char* label, report::Text text) {
    facts.rows.emplace_back(label, std::move(text));
  };
  add("scenario", counterexample::deployment_text(apart.scenario));
  add("difference", apart.difference);
  const auto side = [](const props::Counterexample& run) {
    return fmt::format("event {}: {}", report::grouped(run.event), run.reason);
  };
  add("base", side(apart.base_run));
  add("candidate", side(apart.candidate_run));
  add("search", apart.how);
  const char* label = "files";
  for (const auto& [what, file] : files) {
    if (what.starts_with("telling-apart")) add(std::exchange(label, ""), report::code(file));
  }
  return facts;
}

}  // namespace

void add_apart(report::Blocks& blocks, const DiffReport& report, const Files& files) {
  const TellingApart& apart = report.telling_apart;
  if (apart.how.empty() && !apart.found) return;
  report::Section section{"The smallest scenario that tells them apart", "apart"};
  section.folded_in_comments = true;
  if (apart.found) {
    section.blocks.emplace_back(apart_facts(apart, files));
    std::set<std::string> machines;
    PairedCharts charts = paired_charts(apart, report.base.reference, report.candidate.reference,
                                        CommonStart::in_base);
    const auto add = [&](const props::Counterexample& run, sequence::Chart chart,
                         const char* side) {
      section.blocks.emplace_back(
          counterexample::walk(run, std::move(chart), fmt::format("apart-{}", side),
                               fmt::format("The run of the {}, up to where the two part", side),
                               machines),
          report::Audience::documents);
    };
    add(apart.base_run, std::move(charts.base), "base");
    add(apart.candidate_run, std::move(charts.candidate), "candidate");
    if (!machines.empty()) {
      section.blocks.emplace_back(counterexample::diagrams_of(machines), report::Audience::page);
    }
  } else {
    section.blocks.emplace_back(report::Paragraph{apart.how});
  }
  blocks.emplace_back(std::move(section));
}

}  // namespace stormproof::diff
