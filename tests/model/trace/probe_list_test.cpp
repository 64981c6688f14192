// Each probe of a list sees what it would see alone.
#include "model/trace/probe_list.hpp"

#include <sstream>

#include <gtest/gtest.h>

#include "model/trace/perfetto.hpp"
#include "model/trace/trace_writer.hpp"
#include "tests/model/trace/recording.hpp"

namespace stormproof::model::trace {
namespace probe_list_test {

TEST(ProbeList, ForwardsEverythingToAll) {
  const Scenario& scenario = case_named("v3");
  std::ostringstream trace;
  std::ostringstream timeline;
  TraceWriter trace_writer{trace, scenario};
  PerfettoWriter perfetto_writer{timeline, scenario};
  ProbeList probes;
  EXPECT_TRUE(probes.empty());
  probes.add(trace_writer);
  probes.add(perfetto_writer);
  EXPECT_FALSE(probes.empty());
  RunOptions options;
  options.probe = &probes;
  trace_writer.finish(simulate(scenario, options));
  perfetto_writer.finish();
  EXPECT_EQ(trace.str(), record(scenario).text);
  EXPECT_EQ(nlohmann::ordered_json::parse(timeline.str()), record_timeline(scenario).document);
}

TEST(ProbeList, ObserversDoNotChangeTheRun) {
  for (const Case& c : trace_cases()) {
    const RunResult alone = simulate(c.scenario());
    const RunResult& observed = recorded(c).result;
    EXPECT_EQ(alone.end_time, observed.end_time) << c.name;
    EXPECT_EQ(alone.counts, observed.counts) << c.name;
    EXPECT_EQ(alone.events, observed.events) << c.name;
  }
}

}  // namespace probe_list_test
}  // namespace stormproof::model::trace
