// The hold model on the schedulers of ns-3: `stormproof_ns3_bench LENGTH HOLDS constant|random`
// prints a name and holds per second for each. It is a program of its own, because ns-3 is GPL; the
// table of benchmarks (engine_bench.cpp) starts it.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <ns3/calendar-scheduler.h>
#include <ns3/event-impl.h>
#include <ns3/heap-scheduler.h>
#include <ns3/list-scheduler.h>
#include <ns3/map-scheduler.h>
#include <ns3/object.h>
#include <ns3/priority-queue-scheduler.h>

#include "tests/bench/hold_model.hpp"

namespace {

template <class Scheduler>
class Queue {
 public:
  void put(std::int64_t time, unsigned kind) {
    scheduler_->Insert({nullptr, {static_cast<std::uint64_t>(time), number_++, kind}});
  }
  std::int64_t take(unsigned& kind) {
    const ns3::Scheduler::Event event = scheduler_->RemoveNext();
    kind = event.key.m_context;
    return static_cast<std::int64_t>(event.key.m_ts);
  }

 private:
  ns3::Ptr<Scheduler> scheduler_ = ns3::CreateObject<Scheduler>();
  std::uint32_t number_ = 0;
};

template <class Scheduler>
void measure(const char* name, std::size_t length, std::size_t holds, bool constant) {
  const double rate = hold_model::holds_per_second<Queue<Scheduler>>(length, holds, constant);
  std::printf("%s %.0f\n", name, rate);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const std::size_t length = std::strtoull(argv[1], nullptr, 10);
  const std::size_t holds = std::strtoull(argv[2], nullptr, 10);
  const bool constant = std::strcmp(argv[3], "constant") == 0;
  measure<ns3::MapScheduler>("Map", length, holds, constant);
  measure<ns3::HeapScheduler>("Heap", length, holds, constant);
  measure<ns3::PriorityQueueScheduler>("PriorityQueue", length, holds, constant);
  // These take time in proportion to the length, or nearly so where events lie unevenly.
  if (length <= 1'000) measure<ns3::CalendarScheduler>("Calendar", length, holds / 10, constant);
  if (length <= 1'000) measure<ns3::ListScheduler>("List", length, holds / 10, constant);
  return 0;
}
