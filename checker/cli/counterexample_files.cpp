// Charts first: a folder with a limit may have no room for the trace.
#include "checker/cli/counterexample_files.hpp"

#include "checker/verification/counterexample/chart.hpp"
#include "checker/verification/counterexample/story.hpp"
#include "checker/verification/counterexample/write.hpp"

namespace stormproof::cli {

std::optional<std::string> write_counterexample(OutputFolder& folder,
                                                const props::Counterexample& counterexample,
                                                const std::string& name) {
  const counterexample::Chart chart = counterexample::chart_of(counterexample);
  folder.write(name + ".mmd", counterexample::mermaid_chart(chart));
  folder.write(name + ".svg", counterexample::svg_chart(chart));
  return folder.write(name + ".jsonl", [&](std::ostream& out) {
    return counterexample::write_counterexample(counterexample, out);
  });
}

void write_counterexamples(OutputFolder& folder, const checker::CheckReport& report,
                           checker::CheckContext& context) {
  for (const checker::PropertyResult& result : report.results) {
    const props::Counterexample* found = result.counterexample();
    if (found == nullptr) continue;
    const std::string id{result.property->id};
    if (const auto trace = write_counterexample(folder, *found, id)) {
      context.counterexamples.emplace(id, *trace);
    }
    context.stories.emplace(id, counterexample::told(*found));
  }
}

}  // namespace stormproof::cli
