// The finding about lookups of types says what each repair would gain; its table is what the grid
// `type-lookup-repairs` gives.
#include <fstream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "checker/experiments/grids/plan.hpp"
#include "model/simulator.hpp"
#include "tests/files.hpp"

namespace stormproof::grids {
namespace repairs_test {

using model::config::SpecPath;

/// As the table writes them: 4,151.
std::string with_commas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}
std::string cell(const model::RunResult& run) {
  const std::string time =
      run.completed()
          ? fmt::format("{:.2f} s", static_cast<double>(run.discovery_time->count()) / 1e9)
          : "never";
  return fmt::format("{}, {}", time, with_commas(run.counts.lookup));
}

/// All but the last column, ten hosts with two participants each, which takes longest.
TEST(Repairs, TheTableOfTheFindingIsWhatTheGridGives) {
  auto grid = read_grid("type-lookup-repairs", SpecPath::standard());
  ASSERT_TRUE(grid) << to_string(grid.error());
  const auto plan = make_plan(*std::move(grid), SpecPath::standard());
  ASSERT_TRUE(plan) << to_string(plan.error());
  constexpr std::size_t repairs = 9;
  constexpr std::size_t columns = 4;
  ASSERT_EQ(plan->size(), (columns + 1) * repairs);
  const std::string page = files::content(STORMPROOF_SOURCE_DIR "/specs/findings/type-lookup.md");
  for (std::size_t repair = 0; repair < repairs; ++repair) {
    const std::vector<std::string> values = plan->values(repair);
    std::string row = fmt::format("| `{}` | `{}` |", values[2], values[3]);
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t job = k * repairs + repair;
      ASSERT_FALSE(plan->error(job));
      row += " " + cell(model::simulate(plan->scenario(job))) + " |";
    }
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
  std::string off = "| `type_lookup: false` | |";
  for (std::size_t k = 0; k < columns; ++k) {
    model::Scenario scenario = plan->scenario(k * repairs);
    scenario.dds.version.type_lookup = model::Whether::no;
    off += " " + cell(model::simulate(scenario)) + " |";
  }
  EXPECT_NE(page.find(off), std::string::npos) << off;
}

}  // namespace repairs_test
}  // namespace stormproof::grids
