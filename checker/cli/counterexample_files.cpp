// Writes traces, charts and test cases of a check.
#include "checker/cli/counterexample_files.hpp"

#include <filesystem>

#include <fmt/core.h>

#include "checker/cli/output_file.hpp"
#include "checker/verification/counterexample/chart.hpp"
#include "checker/verification/counterexample/gtest_case.hpp"
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

std::optional<std::string> write_counterexamples(const CheckArguments& arguments,
                                                 const checker::CheckReport& report,
                                                 checker::CheckContext& context) {
  std::vector<props::Counterexample> all;
  for (const checker::PropertyResult& result : report.results) {
    const props::Counterexample* found = result.counterexample();
    if (found == nullptr) continue;
    if (all.empty()) {
      std::error_code error;
      std::filesystem::create_directories(arguments.output_directory, error);
      if (error) {
        return fmt::format("--counterexamples {}: cannot be created: {}",
                           arguments.output_directory, error.message());
      }
    }
    const std::string id{result.property->id};
    const std::string stem = (std::filesystem::path{arguments.output_directory} / id).string();
    if (auto error = write_counterexample(*found, stem)) return error;
    context.counterexamples.emplace(id, stem + ".jsonl");
    context.stories.emplace(id, counterexample::story(*found));
    all.push_back(*found);
  }
  if (arguments.emit_test.empty()) return std::nullopt;
  return write_text(arguments.emit_test,
                    counterexample::gtest_file(all, "stormproof check " + arguments.scenario));
}

}  // namespace stormproof::cli
