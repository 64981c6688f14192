// Writes traces and charts of a check.
#include "checker/cli/counterexample_files.hpp"

#include <filesystem>

#include "checker/cli/output_file.hpp"
#include "checker/verification/counterexample/chart.hpp"
#include "checker/verification/counterexample/story.hpp"
#include "checker/verification/counterexample/write.hpp"

namespace stormproof::cli {

namespace {

/// Gives the file what `fill` writes; the reason if that fails.
template <class Fill>
std::optional<std::string> write_file(const std::string& path, Fill&& fill) {
  OutputFile file{path};
  if (auto error = file.open_error()) return error;
  if (std::optional<std::string> error = fill(file.stream())) return error;
  return file.commit();
}

}  // namespace

std::optional<std::string> write_text(const std::string& path, const std::string& text) {
  return write_file(path, [&](std::ostream& out) -> std::optional<std::string> {
    out << text;
    return std::nullopt;
  });
}

std::optional<std::string> write_counterexample(const props::Counterexample& counterexample,
                                                const std::string& stem) {
  auto error = write_file(stem + ".jsonl", [&](std::ostream& out) {
    return counterexample::write_counterexample(counterexample, out);
  });
  if (!error) {
    const counterexample::Chart chart = counterexample::chart_of(counterexample);
    error = write_text(stem + ".mmd", counterexample::mermaid_chart(chart));
    if (!error) error = write_text(stem + ".svg", counterexample::svg_chart(chart));
  }
  return error;
}

std::optional<std::string> write_counterexamples(const std::string& directory,
                                                 const checker::CheckReport& report,
                                                 checker::CheckContext& context) {
  for (const checker::PropertyResult& result : report.results) {
    const props::Counterexample* found = result.counterexample();
    if (found == nullptr) continue;
    if (auto failure = make_folder("--counterexamples", directory)) return failure;
    const std::string id{result.property->id};
    const std::string stem = (std::filesystem::path{directory} / id).string();
    if (auto failure = write_counterexample(*found, stem)) return failure;
    context.counterexamples.emplace(id, stem + ".jsonl");
    context.stories.emplace(id, counterexample::story(*found));
  }
  return std::nullopt;
}

}  // namespace stormproof::cli
