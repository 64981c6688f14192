// How fast the engine is, as a table: whole simulations beside the hold model of
// std::priority_queue, the event queue beside it and ns-3's schedulers from a thousand to a million
// pending events, what monitors cost, what the largest collapse takes as a process of its own, and
// how fast the explorer steps, beside SPIN (explorer_bench.cpp).
// `--watched` prints what monitors cost alone, and what each of them does.
// Processor time; both sides of a ratio are measured in turns, and the median of the ratios counts.
// Nothing here is a test.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <queue>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "model/engine/event_queue.hpp"
#include "model/keep_memory.hpp"
#include "model/simulator.hpp"
#include "model/trace/probe_list.hpp"
#include "props/limits.hpp"
#include "props/monitor.hpp"
#include "tests/bench/hold_model.hpp"
#include "tests/bench/workloads.hpp"

namespace {

using namespace stormproof;
using hold_model::holds_per_second;
using hold_model::processor_seconds;

constexpr std::size_t rounds = 5;
constexpr std::size_t holds = 1'000'000;

class StandardQueue {
 public:
  void put(std::int64_t time, unsigned kind) {
    queue_.push({model::Nanoseconds{time}, insertion_++, kind, 0, {}});
  }
  std::int64_t take(unsigned& kind) {
    const model::Event event = queue_.top();
    queue_.pop();
    kind = event.subject;
    return event.time.count();
  }

 private:
  struct Later {
    bool operator()(const model::Event& a, const model::Event& b) const { return b.before(a); }
  };
  std::priority_queue<model::Event, std::vector<model::Event>, Later> queue_;
  std::uint64_t insertion_ = 0;
};

class OurQueue {
 public:
  void put(std::int64_t time, unsigned kind) {
    // Protocol events, so that the class is the same for all.
    constexpr auto first = static_cast<unsigned>(model::EventKind::announcement_due);
    queue_.schedule(model::Nanoseconds{time}, static_cast<model::EventKind>(first + kind), kind);
  }
  std::int64_t take(unsigned& kind) {
    const model::Event event = queue_.pop();
    kind = event.subject;
    return event.time.count();
  }

 private:
  model::EventQueue queue_;
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

using Properties = std::vector<std::string_view>;

/// Events per second of processor time while these are watched, with what is set up for the run.
double events_per_second(const model::Scenario& scenario, const Properties& watched = {}) {
  std::uint64_t events = 0;
  const double start = processor_seconds();
  do {
    std::vector<std::unique_ptr<props::Monitor>> monitors;
    model::trace::ProbeList probes;
    for (const std::string_view id : watched) {
      monitors.push_back(props::make_monitor(id, scenario));
      probes.add(*monitors.back());
    }
    model::RunOptions options;
    if (!probes.empty()) options.probe = &probes;
    const model::RunResult result = model::simulate(scenario, options);
    for (const auto& monitor : monitors) monitor->finish(result.end_time);
    events += result.events;
  } while (processor_seconds() - start < 0.2);
  return static_cast<double>(events) / (processor_seconds() - start);
}

/// Mean number of scheduled events over a run.
class MeanQueueLength final : public model::Probe {
 public:
  void event_finished(const model::Depths& depths) override {
    sum_ += depths.events;
    ++events_;
  }
  [[nodiscard]] std::size_t value() const { return static_cast<std::size_t>(sum_ / events_); }

 private:
  std::uint64_t sum_ = 0;
  std::uint64_t events_ = 0;
};

std::size_t mean_queue_length(const model::Scenario& scenario) {
  MeanQueueLength probe;
  model::RunOptions options;
  options.probe = &probe;
  return model::simulate(scenario, options).events > 0 ? probe.value() : 0;
}

void row(const std::string& what, const std::string& measured, const std::string& beside,
         double ratio) {
  std::puts(fmt::format("{:<58} {:>12} {:>12} {:>7.2f}", what, measured, beside, ratio).c_str());
  std::fflush(stdout);
}
std::string millions(double rate) { return fmt::format("{:.1f} M/s", rate / 1e6); }

/// Both rates are measured in turns.
void compare(const std::string& what, const std::function<double()>& ours,
             const std::function<double()>& other) {
  std::vector<double> a;
  std::vector<double> b;
  std::vector<double> ratios;
  for (std::size_t k = 0; k < rounds; ++k) {
    a.push_back(ours());
    b.push_back(other());
    ratios.push_back(a.back() / b.back());
  }
  row(what, millions(median(a)), millions(median(b)), median(ratios));
}

void whole_simulations() {
  const model::Scenario paper = bench::homogeneous(2, 6, 30);
  const std::size_t length = mean_queue_length(paper);
  const auto hold = [&] { return holds_per_second<StandardQueue>(length, holds, false); };
  std::puts(fmt::format("\nWhole simulations, events/s, beside std::priority_queue held at {} "
                        "events with random delays",
                        length)
                .c_str());
  compare(
      "2x6x30, the paper's implementation", [&] { return events_per_second(paper); }, hold);
  for (const auto& [participants, endpoints] : {std::pair{5U, 20U}, std::pair{6U, 30U}}) {
    const model::Scenario live = bench::live(participants, endpoints, 1);
    compare(
        fmt::format("2x{}x{}, Fast DDS", participants, endpoints),
        [&] { return events_per_second(live); }, hold);
  }
}

void queues() {
  for (const bool constant : {true, false}) {
    std::puts(fmt::format("\nThe event queue alone, holds/s with {}, beside std::priority_queue",
                          constant ? "constant delays of 8 kinds" : "random delays")
                  .c_str());
    for (const std::size_t length : {80UL, 1'000UL, 10'000UL, 100'000UL, 1'000'000UL}) {
      compare(
          fmt::format("{} pending", length),
          [&] { return holds_per_second<OurQueue>(length, holds, constant); },
          [&] { return holds_per_second<StandardQueue>(length, holds, constant); });
    }
  }
}

/// What the programs beside this one are called.
std::string sibling(const char* name) {
  std::error_code error;
  return (std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / name).string();
}

void ns3() {
  const std::string program = sibling("stormproof_ns3_bench");
  std::puts("\nThe event queue beside ns-3's schedulers, holds/s, constant delays of 8 kinds");
  if (!std::filesystem::exists(program)) {
    std::puts("skipped: ns-3 was not there when this was built (Debian: libns3-dev)");
    return;
  }
  for (const std::size_t length : {80UL, 1'000UL, 100'000UL}) {
    const double ours = holds_per_second<OurQueue>(length, holds, true);
    const std::string command = fmt::format("'{}' {} {} constant", program, length, holds / 4);
    std::FILE* const output = popen(command.c_str(), "r");
    char name[64];
    double rate = 0;
    while (output != nullptr && std::fscanf(output, "%63s %lf", name, &rate) == 2) {
      row(fmt::format("{} pending, {}", length, name), millions(ours), millions(rate), ours / rate);
    }
    if (output != nullptr) pclose(output);
  }
}

/// What a run costs that these watch, beside the same run without monitors.
void watched(const std::string& name, const model::Scenario& scenario, const Properties& ids) {
  std::vector<double> rates;
  std::vector<double> alone;
  std::vector<double> ratios;
  for (std::size_t k = 0; k < rounds; ++k) {
    rates.push_back(events_per_second(scenario, ids));
    alone.push_back(events_per_second(scenario));
    ratios.push_back(alone.back() / rates.back());
  }
  row(name, millions(median(rates)), millions(median(alone)), median(ratios));
}

std::vector<std::pair<std::string, model::Scenario>> watched_scenarios() {
  model::Scenario cyclone = bench::live(5, 20, 1);
  cyclone.dds.implementation = model::ImplementationKind::cyclone;
  std::vector<std::pair<std::string, model::Scenario>> scenarios{
      {"2x5x20, the paper's implementation", bench::homogeneous(2, 5, 20)},
      {"2x5x20, Fast DDS", bench::live(5, 20, 1)},
      {"2x5x20, Cyclone DDS", cyclone},
      {"2x6x30, the paper's implementation", bench::homogeneous(2, 6, 30)},
      {"2x6x30, Fast DDS", bench::live(6, 30, 1)}};
  for (auto& [name, scenario] : scenarios) {
    scenario.limits.emplace();
    scenario.limits->completion = scenario.time_limit;
    scenario.limits->messages = 1'000'000'000;
    scenario.limits->backlog = 1'000'000'000;
  }
  return scenarios;
}

void monitors() {
  std::puts("\nWatched runs, time, beside the same runs without monitors (rates; ratio of times)");
  for (const auto& [name, scenario] : watched_scenarios()) {
    watched(name + ", limits", scenario, props::limits_of(scenario));
    watched(name + ", all properties", scenario, props::monitored_properties(scenario));
  }
}

/// What each property costs that is watched alone.
void each_monitor() {
  for (const auto& [name, scenario] : watched_scenarios()) {
    std::puts(fmt::format("\n{}, watched by one property", name).c_str());
    for (const std::string_view id : props::monitored_properties(scenario)) {
      watched(std::string{id}, scenario, {id});
    }
  }
}

/// This program again, to run one collapse in a process of its own.
void collapses(const char* self) {
  std::puts("\nCollapses, 60 s of model time, as processes of their own (processor time; memory)");
  for (const char* size : {"4 10 20", "10 10 20", "50 10 30"}) {
    const pid_t child = fork();
    if (child == 0) {
      execl(self, self, "--collapse", size, static_cast<char*>(nullptr));
      _exit(127);
    }
    int status = 0;
    rusage usage{};
    if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) {
      std::puts("failed");
      continue;
    }
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) / 1e6;
    };
    std::puts(fmt::format("{:<58} {:>10.2f} s {:>9} MB", size,
                          seconds(usage.ru_utime) + seconds(usage.ru_stime), usage.ru_maxrss / 1024)
                  .c_str());
  }
}

/// A program of its own, which prints its own rows.
void explorer() {
  const std::string program = sibling("stormproof_explorer_bench");
  std::puts("\nThe explorer, fired events (steps)/s, beside SPIN on the exported composition");
  std::fflush(stdout);
  if (!std::filesystem::exists(program)) {
    std::puts("skipped: this was built without the explorer");
  } else if (std::system(fmt::format("'{}'", program).c_str()) != 0) {
    std::puts("failed");
  }
}

int run_collapse(const char* size) {
  unsigned hosts = 0;
  unsigned participants = 0;
  unsigned endpoints = 0;
  if (std::sscanf(size, "%u %u %u", &hosts, &participants, &endpoints) != 3) return 2;
  return model::simulate(bench::collapse(hosts, participants, endpoints)).events > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  model::keep_memory();
  if (argc == 2 && std::strcmp(argv[1], "--watched") == 0) {
    monitors();
    each_monitor();
    return 0;
  }
  if (argc == 3 && std::strcmp(argv[1], "--collapse") == 0) return run_collapse(argv[2]);
  std::puts(fmt::format("{:<58} {:>12} {:>12} {:>7}", "", "ours", "beside", "ratio").c_str());
  collapses("/proc/self/exe");
  whole_simulations();
  queues();
  ns3();
  monitors();
  explorer();
  return 0;
}
