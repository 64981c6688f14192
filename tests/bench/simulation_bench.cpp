// How fast the simulator is: events per second on the high-load scenario, beside the hold model of
// std::priority_queue at the same queue length in the same run, and the large deployments that must
// stay affordable. Nothing here is a test; times are compared as ratios within one run.
#include <queue>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "checker/experiments/trials/sample_runs.hpp"
#include "model/simulator.hpp"

namespace {

using namespace stormproof::model;

Scenario homogeneous(std::uint32_t hosts, std::uint32_t participants, std::uint32_t endpoints) {
  Scenario scenario;
  scenario.deployment = Deployment::homogeneous(hosts, participants, endpoints);
  return scenario;
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Mean number of scheduled events over a run.
class MeanQueueLength final : public Probe {
 public:
  void event_finished(const Depths& depths) override {
    sum_ += depths.events;
    ++events_;
  }
  [[nodiscard]] std::size_t value() const { return static_cast<std::size_t>(sum_ / events_); }

 private:
  std::uint64_t sum_ = 0;
  std::uint64_t events_ = 0;
};

std::size_t mean_queue_length(const Scenario& scenario) {
  MeanQueueLength probe;
  RunOptions options;
  options.probe = &probe;
  benchmark::DoNotOptimize(simulate(scenario, options));
  return probe.value();
}

void report_run(benchmark::State& state, const RunResult& last, std::uint64_t events) {
  state.counters["events/s"] =
      benchmark::Counter(static_cast<double>(events), benchmark::Counter::kIsRate);
  state.counters["events"] = static_cast<double>(last.events);
  state.counters["messages"] = static_cast<double>(last.counts.total());
  state.counters["peak_MiB"] = peak_memory_mib();
}

void run_scenario(benchmark::State& state, const Scenario& scenario) {
  RunResult last;
  std::uint64_t events = 0;
  for (auto _ : state) {
    last = simulate(scenario);
    events += last.events;
  }
  report_run(state, last, events);
}

void high_load_6x30(benchmark::State& state) { run_scenario(state, homogeneous(2, 6, 30)); }
BENCHMARK(high_load_6x30)->Unit(benchmark::kMillisecond)->MinTime(2);

/// The live machine's access point and endpoint creation: 2 hosts, one schedule drawn from `seed`.
Scenario live(std::uint32_t participants, std::uint32_t endpoints, std::uint64_t seed) {
  Scenario scenario = homogeneous(2, participants, endpoints);
  scenario.dds.implementation = ImplementationKind::fastdds;
  scenario.wireless.overhead_unicast = Nanoseconds{150'000};
  scenario.wireless.overhead_multicast = Nanoseconds{150'000};
  scenario.wireless.link_overhead_bytes = Bytes{14};
  scenario.wireless.order = ServiceOrder::fifo;
  scenario.wireless.fragment_request = FragmentRequest::at_admission;
  scenario.wireless.source_queue_bytes = WirelessProfile::unlimited;
  // The live machine's endpoints are done within these times, in ns.
  const std::int64_t processes = participants;
  const std::int64_t work = processes * (17 + endpoints);
  const std::int64_t earliest =
      std::max<std::int64_t>(0, -700'000 + 2'900'000 * processes + 200'000 * work);
  const std::int64_t latest =
      std::max<std::int64_t>(earliest, -27'000'000 + 15'400'000 * processes + 455'000 * work);
  scenario.deployment.schedule = {Nanoseconds{3'000'000}, Nanoseconds{12'000'000 * processes},
                                  Nanoseconds{earliest}, Nanoseconds{latest}, seed};
  scenario.deployment.draw_schedule(seed);
  return scenario;
}

void fastdds_5x20(benchmark::State& state) { run_scenario(state, live(5, 20, 1)); }
BENCHMARK(fastdds_5x20)->Unit(benchmark::kMillisecond);
void fastdds_6x30(benchmark::State& state) { run_scenario(state, live(6, 30, 1)); }
BENCHMARK(fastdds_6x30)->Unit(benchmark::kMillisecond);

/// The 90 configurations of the evaluation, 12 sampled schedules each.
void fastdds_90_configurations_12_samples(benchmark::State& state) {
  for (auto _ : state) {
    for (std::uint32_t participants = 1; participants <= 6; ++participants) {
      for (std::uint32_t endpoints = 2; endpoints <= 30; endpoints += 2) {
        stormproof::trials::SampleOptions options;
        options.samples = 12;
        const Scenario scenario = live(participants, endpoints, 0);
        benchmark::DoNotOptimize(stormproof::trials::sample_runs(scenario, options));
      }
    }
  }
}
BENCHMARK(fastdds_90_configurations_12_samples)
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseRealTime();

/// One "hold" takes the least event out and puts one in at a random later time.
void hold_model_priority_queue(benchmark::State& state) {
  struct Later {
    bool operator()(const Event& a, const Event& b) const { return b.before(a); }
  };
  const std::size_t length = mean_queue_length(homogeneous(2, 6, 30));
  std::mt19937_64 random{1};
  std::priority_queue<Event, std::vector<Event>, Later> queue;
  std::uint64_t insertion = 0;
  const auto push = [&](Nanoseconds now) {
    const auto delay = static_cast<std::int64_t>(random() % 2'000'000);
    queue.push({now + Nanoseconds{delay}, insertion++, 0, 0, EventKind::acknack_generation});
  };
  for (std::size_t k = 0; k < length; ++k) push(Nanoseconds{0});
  for (auto _ : state) {
    const Event event = queue.top();
    queue.pop();
    push(event.time);
  }
  state.counters["events/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["queue_length"] = static_cast<double>(length);
}
BENCHMARK(hold_model_priority_queue)->MinTime(2);

void collapse(benchmark::State& state, std::uint32_t hosts, std::uint32_t participants,
              std::uint32_t endpoints) {
  Scenario scenario = homogeneous(hosts, participants, endpoints);
  scenario.time_limit = Nanoseconds{60'000'000'000};
  run_scenario(state, scenario);
}
void collapse_4x10x20(benchmark::State& state) { collapse(state, 4, 10, 20); }
BENCHMARK(collapse_4x10x20)->Unit(benchmark::kMillisecond)->Iterations(5);
void collapse_10x10x20(benchmark::State& state) { collapse(state, 10, 10, 20); }
BENCHMARK(collapse_10x10x20)->Unit(benchmark::kMillisecond)->Iterations(3);
void collapse_50x10x30(benchmark::State& state) { collapse(state, 50, 10, 30); }
BENCHMARK(collapse_50x10x30)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
