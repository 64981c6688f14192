// Laws of the response-aware HEARTBEAT policy: its periods stay in their range, and it dies when
// there is nobody left to ask.
#include <map>

#include <fmt/core.h>

#include "props/laws/families.hpp"
#include "props/laws/watching.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::props {

namespace {

using model::EventKind;
using model::Nanoseconds;
using model::Scenario;

bool is_adaptive(const Scenario& scenario) {
  return scenario.dds.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive;
}

/// What the cycle events of the writers do.
class CycleWatch : public Observer {
 public:
  using Observer::Observer;

  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    finish_event();
    in_cycle_start_ = event.kind == EventKind::cycle_start;
    writer_ = event.subject;
  }
  void scheduled(std::uint64_t, Nanoseconds time, EventKind kind, std::uint32_t) override {
    if (!in_cycle_start_) return;
    if (kind == EventKind::cycle_start) next_ = true;
    if (kind == EventKind::cycle_end) period_ = time - now();
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (packet.kind == model::PacketKind::heartbeat) heartbeats_ += packet.copies;
  }
  void looped_back(const model::Packet& packet, std::uint32_t) override {
    if (packet.kind == model::PacketKind::heartbeat) ++heartbeats_;
  }

 protected:
  struct CycleStart {
    std::uint32_t writer;
    std::uint64_t heartbeats;
    std::optional<Nanoseconds> period;  ///< from its start to its end, if it has one
    bool next;                          ///< whether it schedules another start
  };
  virtual void cycle_started(const CycleStart& cycle) = 0;

 private:
  void finish_event() {
    if (in_cycle_start_) cycle_started({writer_, heartbeats_, period_, next_});
    heartbeats_ = 0;
    period_.reset();
    next_ = false;
  }

  bool in_cycle_start_ = false;
  std::uint32_t writer_ = 0;
  std::uint64_t heartbeats_ = 0;
  std::optional<Nanoseconds> period_;
  bool next_ = false;
};

class PeriodWatch : public CycleWatch {
 public:
  explicit PeriodWatch(const Scenario& scenario)
      : CycleWatch{"law.adaptive-period"}, sedp_{scenario.dds.sedp} {}

 private:
  void cycle_started(const CycleStart& cycle) override {
    if (!cycle.period || *cycle.period == sedp_.heartbeat_period) return;
    if (*cycle.period >= sedp_.adaptive.min_period && *cycle.period <= sedp_.adaptive.max_period) {
      return;
    }
    object_now(fmt::format("A cycle of {} has the period {}, outside {} to {}.",
                           writer_text(cycle.writer), time_text(*cycle.period),
                           time_text(sedp_.adaptive.min_period),
                           time_text(sedp_.adaptive.max_period)));
  }

  model::SedpProfile sedp_;
};

class LifeWatch : public CycleWatch {
 public:
  explicit LifeWatch(const Scenario&) : CycleWatch{"law.adaptive-dies"} {}

 private:
  void cycle_started(const CycleStart& cycle) override {
    const bool goes_on = cycle.period || cycle.next;
    if (goes_on == (cycle.heartbeats > 0)) return;
    object_now(fmt::format("A cycle of {} sends {} HEARTBEATs and {}.", writer_text(cycle.writer),
                           cycle.heartbeats, goes_on ? "goes on" : "ends at once"));
  }
};

/// Whom HEARTBEATs of a cycle go to, in the paper's model: only to readers that have not
/// acknowledged everything.
class RecipientWatch : public Observer {
 public:
  explicit RecipientWatch(const Scenario&) : Observer{"law.adaptive-recipients"} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    acknowledged_.assign(topology.relation_count(), 0);
  }
  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    of_cycle_ = event.kind == EventKind::cycle_start || event.kind == EventKind::batch_due;
  }
  void transition(const model::Transition& fired) override {
    if (fired.machine.machine != "DescriptorRepair" || fired.before == fired.after) return;
    const auto moved = static_cast<std::uint32_t>(std::popcount(fired.descriptors));
    if (fired.after == "A") acknowledged_[fired.machine.subject] += moved;
    if (fired.before == "A") acknowledged_[fired.machine.subject] -= moved;
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    if (!of_cycle_ || packet.kind != model::PacketKind::heartbeat) return;
    const std::uint32_t relation = packet.relation();
    if (acknowledged_[relation] < topology().descriptor_count(relation)) return;
    object_now(fmt::format("At {} a cycle asks for {}, which has acknowledged everything.",
                           time_text(now()), relation_text(topology(), relation)));
  }

 private:
  bool of_cycle_ = false;
  std::vector<std::uint32_t> acknowledged_;  // descriptors in A, by relation
};

bool is_adaptive_of_paper(const Scenario& scenario) {
  return is_adaptive(scenario) && traits_of(scenario).writer == model::Writer::of_the_paper;
}

constexpr Law adaptive_list[] = {
    watched_law<PeriodWatch>("law.adaptive-period",
                             "Every period is τ_H or lies between T_min and T_max.", is_adaptive),
    watched_law<LifeWatch>(
        "law.adaptive-dies",
        "A cycle that has nobody to ask ends the policy's activity; one that asks has an end.",
        is_adaptive),
    watched_law<RecipientWatch>("law.adaptive-recipients",
                                "A cycle asks nobody who has acknowledged everything.",
                                is_adaptive_of_paper),
};

}  // namespace

std::span<const Law> adaptive_laws() { return adaptive_list; }

}  // namespace stormproof::props
