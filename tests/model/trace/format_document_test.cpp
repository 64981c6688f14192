// The excerpts in the documentation of the trace format are what the program writes.
#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"
#include "tests/model/trace/recording.hpp"

namespace stormproof::model::trace {
namespace format_document_test {

/// The JSON blocks of the document, each as one line.
std::vector<std::string> excerpts() {
  std::ifstream in{std::string{STORMPROOF_SPECS_DIR} + "/guide/trace-format.md"};
  std::vector<std::string> blocks;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("```", 0) == 0) {
      inside = line == "```json";
      if (inside) blocks.emplace_back();
      continue;
    }
    if (inside) blocks.back() += line.substr(line.find_first_not_of(' '));
  }
  return blocks;
}

TEST(FormatDocument, ItsExcerptsAreLinesOfTheTrace) {
  const auto scenario = config::read_scenario("smallest", {}, config::source_specs());
  ASSERT_TRUE(scenario);
  const std::vector<std::string> lines = record(*scenario).lines;
  ASSERT_GE(excerpts().size(), 5U);
  for (const std::string& excerpt : excerpts()) {
    EXPECT_NE(std::ranges::find(lines, excerpt), lines.end()) << excerpt;
  }
}

}  // namespace format_document_test
}  // namespace stormproof::model::trace
