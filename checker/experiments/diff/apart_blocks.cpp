// The least scenario that tells two profiles apart, and both runs of it up to where they part.
#include <fmt/core.h>

#include "checker/experiments/diff/diff_parts.hpp"
#include "checker/experiments/diff/words.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/counterexample/chart.hpp"
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
  add("search", fmt::format("{} ({} tried{})", apart.how, plural(apart.tried, "scenario"),
                            apart.finished ? "" : ", the effort was spent"));
  const char* label = "files";
  for (const auto& [what, file] : files) {
    if (what.starts_with("telling-apart")) add(std::exchange(label, ""), report::code(file));
  }
  return facts;
}

report::Sequence run_of(const DiffReport& report, bool candidate, std::set<std::string>& machines) {
  const TellingApart& apart = report.telling_apart;
  const props::Counterexample& run = candidate ? apart.candidate_run : apart.base_run;
  counterexample::Chart chart =
      counterexample::chart_of(run, candidate ? apart.candidate_packets : apart.base_packets);
  chart.title =
      candidate ? "Candidate: " + report.candidate.reference : "Base: " + report.base.reference;
  chart.closing = "Here the runs part";
  chart.sign = "≠";
  return report::walk(
      run, std::move(chart), candidate ? "apart-candidate" : "apart-base",
      fmt::format("The run of the {}, up to where the two part", candidate ? "candidate" : "base"),
      machines);
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
    for (const bool candidate : {false, true}) {
      section.blocks.emplace_back(run_of(report, candidate, machines), report::Audience::documents);
    }
    report::add_machines(section.blocks, machines);
  } else {
    section.blocks.emplace_back(report::Paragraph{apart.how});
  }
  blocks.emplace_back(std::move(section));
}

}  // namespace stormproof::diff
