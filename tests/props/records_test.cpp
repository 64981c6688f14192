// HEARTBEATs of a message are one record where nobody hears of each packet: monitors find and
// measure the same in it.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "model/simulator.hpp"
#include "model/trace/probe_list.hpp"
#include "props/monitor.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof::props {
namespace records_test {

/// Counts the records of several packets that are emitted.
class RecordCounter final : public model::Probe {
 public:
  explicit RecordCounter(bool wants_single_packets) : wants_single_packets_{wants_single_packets} {}

  [[nodiscard]] bool wants_single_packets() const override { return wants_single_packets_; }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (packet.copies > 1) ++records;
  }

  int records = 0;

 private:
  const bool wants_single_packets_;
};

/// What all monitors say of the run.
std::vector<std::string> said_of(const model::Scenario& scenario, RecordCounter& counter) {
  std::vector<std::unique_ptr<Monitor>> monitors;
  model::trace::ProbeList probes;
  probes.add(counter);
  for (const std::string_view property : monitored_properties(scenario)) {
    monitors.push_back(make_monitor(property, scenario));
    probes.add(*monitors.back());
  }
  model::RunOptions options;
  options.probe = &probes;
  options.max_events = 20'000;
  const model::RunResult result = model::simulate(scenario, options);
  std::vector<std::string> lines;
  for (const auto& monitor : monitors) {
    monitor->finish(result.end_time);
    std::string line{monitor->property()};
    if (const auto& violation = monitor->violation()) {
      line += " " + std::to_string(violation->event) + ": " + violation->reason;
    }
    for (const std::string& remark : monitor->remarks()) line += " " + remark;
    lines.push_back(std::move(line));
  }
  return lines;
}

TEST(Records, MonitorsSayTheSameAsOfSinglePackets) {
  int records = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const model::Scenario scenario =
        oracle::random_scenario(seed, model::ImplementationKind::fastdds);
    RecordCounter each{true};
    RecordCounter together{false};
    EXPECT_EQ(said_of(scenario, together), said_of(scenario, each)) << "seed " << seed;
    EXPECT_EQ(each.records, 0) << "seed " << seed;
    records += together.records;
  }
  EXPECT_GT(records, 100);
}

}  // namespace records_test
}  // namespace stormproof::props
