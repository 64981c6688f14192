// dot diagrams of machines, and what graphviz says to them where it is installed.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "checker/presentation/diagrams/draw_machine.hpp"
#include "fsm/machines.hpp"

namespace stormproof::draw {
namespace dot_test {

class Dot : public testing::TestWithParam<fsm::MachineInfo> {};

TEST_P(Dot, HasEveryRow) {
  const std::string text = draw_machine(GetParam(), Format::dot);
  EXPECT_EQ(text.rfind("digraph " + std::string{GetParam().name} + " {\n", 0), 0U);
  for (const fsm::RowInfo& row : GetParam().rows) {
    const std::string edge = "\"" + std::string{GetParam().states[row.source]} + "\" -> \"" +
                             std::string{GetParam().states[row.target]} + "\" [label=\"";
    const std::size_t begin = text.find(edge);
    ASSERT_NE(begin, std::string::npos) << edge;
    const std::string line = text.substr(begin, text.find('\n', begin) - begin);
    EXPECT_NE(line.find(row_text(GetParam(), row) + "\\l"), std::string::npos) << line;
  }
}

TEST_P(Dot, GraphvizAcceptsIt) {
  if (std::system("command -v dot >/dev/null 2>&1") != 0) {
    SUCCEED() << "graphviz is not installed";
    return;
  }
  const auto path =
      std::filesystem::temp_directory_path() / ("stormproof-" + std::to_string(getpid()) + ".dot");
  std::ofstream{path} << draw_machine(GetParam(), Format::dot);
  EXPECT_EQ(std::system(("dot -Tsvg '" + path.string() + "' -o /dev/null").c_str()), 0);
  std::filesystem::remove(path);
}

INSTANTIATE_TEST_SUITE_P(All, Dot, testing::ValuesIn(fsm::machines()),
                         [](const auto& chosen) { return std::string{chosen.param.name}; });

}  // namespace dot_test
}  // namespace stormproof::draw
