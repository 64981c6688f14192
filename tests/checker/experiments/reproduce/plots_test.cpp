// The plots hold all configurations, and no two texts overlap.
#include "checker/experiments/reproduce/plots.hpp"

#include <gtest/gtest.h>

#include "tests/checker/experiments/reproduce/examples.hpp"
#include "tests/checker/presentation/diagrams/svg_texts.hpp"

namespace stormproof::reproduce {
namespace plots_test {

Report full_report() {
  const Published published = shipped_figures();
  return report_of(published, made_up(plan_of(published, {{}, 2})));
}

void expect_readable(const std::string& svg, const std::string& says) {
  const auto texts = draw::read_svg(svg);
  ASSERT_TRUE(texts.has_value());
  EXPECT_EQ(texts->fault(), "");
  EXPECT_TRUE(texts->says(says)) << says;
}

TEST(Plots, AreReadable) {
  const Report report = full_report();
  expect_readable(counts_plot(report, Network::wired), "published");
  expect_readable(counts_plot(report, Network::wireless), "heartbeat");
  expect_readable(surface_plot(report, 0), "paper");
  expect_readable(environments_plot(report, 1, Class::total), "loopback");
  expect_readable(environments_plot(report, 1, Class::acknack), "failure-free");
  expect_readable(completion_plot(report), "open loop");
  expect_readable(messages_plot(report), "published mean");
  expect_readable(ratio_plot(report, "completion_s"), "equal");
  expect_readable(ratio_plot(report, "messages"), "equal");
  expect_readable(policies_plot(report, 3), "adaptive");
  expect_readable(spreads_plot(report), "published maximum");
}

TEST(Plots, HaveAMarkForEachConfiguration) {
  const Report report = full_report();
  const std::string svg = surface_plot(report, 0);
  std::size_t cells = 0;
  for (std::size_t at = svg.find(">2</text>"); at != std::string::npos;
       at = svg.find(">2</text>", at + 1)) {
    ++cells;
  }
  EXPECT_EQ(cells, 90U + 3U)
      << "the made-up ratio is 2 everywhere; N_P 2, N_E 2 and the least of the colours are labels";
}

TEST(Plots, AreDrawnWithoutResults) {
  Report report = full_report();
  report.results.outcomes.clear();
  expect_readable(counts_plot(report, Network::wired), "published");
  expect_readable(surface_plot(report, 0), "ratio");
  expect_readable(completion_plot(report), "open loop");
  expect_readable(spreads_plot(report), "published median");
}

}  // namespace plots_test
}  // namespace stormproof::reproduce
