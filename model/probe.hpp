// What an observer of a run may see: every processed event, every transition of a machine, every
// packet on its way. The simulator calls a probe only if there is one, so an unobserved run pays
// nothing but a test. Probes never influence a run. Traces (model/trace/) are probes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "fsm/composition/effect_mutation.hpp"
#include "model/event.hpp"
#include "model/units.hpp"

namespace stormproof::model {

struct Packet;   // model/engine/packet.hpp
class Topology;  // model/engine/topology.hpp

/// Which machine has moved. `subject` is a relation, writer (2·participant + stream), participant,
/// channel or pair, as `kind` says. Participants of Cyclone DDS have more writers, and the
/// relations of these: numbered with another stride (model/cyclone/endpoints.hpp).
struct MachineRef {
  enum class Kind : std::uint8_t {
    relation,
    writer,
    participant,
    channel,
    control_relation,
    control_writer,  ///< of Fast DDS (model/fastdds/control.hpp)
    pair,
    endpoint_relation,
    endpoint_writer
  };
  std::string_view machine;
  Kind kind{};
  std::uint32_t subject = 0;
};

/// A row of a machine's table fired: on the event it went from one state to another, or to the
/// same.
struct Transition {
  MachineRef machine;
  std::string_view event;
  std::string_view before;
  std::string_view after;
  std::uint32_t first_word = 0;
  std::uint64_t descriptors = 0;  ///< that moved, of this word; 0 if the machine has none
};

/// Queue depths after an event.
struct Depths {
  std::uint64_t events = 0;           ///< scheduled events
  std::uint64_t backlog_packets = 0;  ///< over all participants
  std::int64_t admitted_bytes = 0;    ///< over all source queues
  std::uint64_t waiting = 0;          ///< fragments that wait for a channel
  std::uint64_t missing = 0;          ///< required deliveries that have not happened
};

/// What a probe may hear of, besides the start of a run.
enum class Report : std::uint8_t {
  event_started,
  event_finished,
  transition,             ///< of all other machines than
  reader_transition,      ///< the same function, of a DiscoveryReader
  descriptor_transition,  ///< of the machines of descriptors
  channel_transition,     ///< of channels
  effect,
  scheduled,
  rescheduled,
  emitted,
  service_started,
  dropped,
  source_completed,
  arrived,
  received,
  looped_back,
  backlog_changed,
  waiting_changed
};
inline constexpr std::size_t report_count = static_cast<std::size_t>(Report::waiting_changed) + 1;

/// A set of reports.
class Reports {
 public:
  static constexpr Reports all() { return Reports{(1U << report_count) - 1}; }
  constexpr Reports() = default;

  [[nodiscard]] constexpr bool has(Report one) const { return (bits_ & bit(one)) != 0; }
  /// Whether some of those change if a record of several packets is emitted instead of each of
  /// them.
  [[nodiscard]] constexpr bool tell_packets_apart() const {
    return has(Report::emitted) || has(Report::looped_back) || has(Report::backlog_changed) ||
           has(Report::waiting_changed);
  }
  constexpr void set(Report one, bool wanted = true) {
    bits_ = wanted ? bits_ | bit(one) : bits_ & ~bit(one);
  }
  constexpr void add(const Reports& others) { bits_ |= others.bits_; }

 private:
  constexpr explicit Reports(std::uint32_t bits) : bits_{bits} {}
  static constexpr std::uint32_t bit(Report one) { return 1U << static_cast<unsigned>(one); }

  std::uint32_t bits_ = 0;
};

/// How far a run has come.
struct RunClock {
  std::uint64_t event = 0;   ///< number of the event that is being processed
  std::uint64_t events = 0;  ///< that have begun
  Nanoseconds now;
  EventKind kind{};  ///< of the event

  void begin(const Event& next) {
    event = events++;
    now = next.time;
    kind = next.kind;
  }
};

/// Whose transition it is.
[[nodiscard]] inline Report report_of(const Transition& fired) {
  if (fired.machine.kind == MachineRef::Kind::channel) return Report::channel_transition;
  if (fired.descriptors != 0) return Report::descriptor_transition;
  const bool of_reader = fired.machine.machine == "DiscoveryReader";
  return of_reader ? Report::reader_transition : Report::transition;
}

struct Company;

class Probe {
 public:
  virtual ~Probe() = default;

  /// Which of its functions below do something; the others need not be called.
  [[nodiscard]] virtual Reports reports() const { return Reports::all(); }
  /// Whether it must hear of each packet on its own, which slows a run down. Otherwise a record
  /// that stands for several may be emitted, admitted and requested at once, before what its
  /// message sends within the host.
  [[nodiscard]] virtual bool wants_single_packets() const { return true; }
  /// It is one of a list from now on; called before it is asked for `reports`. It may add
  /// gatherers.
  virtual void join(Company&) {}

  virtual void run_started(const Topology&) {}
  virtual void event_started(const Event&) {}
  virtual void event_finished(const Depths&) {}
  virtual void transition(const Transition&) {}
  /// Whether `effect` is wanted; it slows a run down.
  [[nodiscard]] virtual bool wants_effects() const { return false; }
  /// An effect of a rule is about to happen; `draw composition` names it.
  virtual void effect(fsm::composition::EffectKey) {}
  /// A condition of a rule is about to be decided; told where effects are.
  virtual void decided(fsm::composition::EffectKey, bool /*holds*/) {}
  virtual void scheduled(std::uint64_t /*insertion*/, Nanoseconds, EventKind,
                         std::uint32_t /*subject*/) {}
  /// The event was due, but its participant could not send (`sender: stalls`): it is pending still,
  /// from now on with another insertion number, and happens now.
  virtual void rescheduled(const Event&, std::uint64_t /*insertion*/) {}
  /// `source` emitted the packet, or `packet.copies` packets of consecutive numbers to
  /// `destinations`.
  virtual void emitted(const Packet&, std::uint32_t /*source*/,
                       std::span<const std::uint32_t> /*destinations*/) {}
  virtual void service_started(std::uint32_t /*channel*/, std::uint32_t /*stage*/, const Packet&,
                               std::uint32_t /*fragment*/, Nanoseconds /*until*/) {}
  /// A queue dropped the fragment, which waited for the channel in this stage.
  virtual void dropped(std::uint32_t /*channel*/, std::uint32_t /*stage*/, const Packet&,
                       std::uint32_t /*fragment*/) {}
  /// The last source-side fragment of the packet has been served.
  virtual void source_completed(const Packet&) {}
  /// The last fragment left the last stage; `lost` packets are not received.
  virtual void arrived(const Packet&, bool /*lost*/) {}
  /// `receiver` is about to process the packet; `everybody`: whoever it was sent to, now and at
  /// once.
  virtual void received(const Packet&, std::uint32_t /*receiver*/) {}
  static constexpr std::uint32_t everybody = UINT32_MAX;
  /// The packet, which has no number, goes to a participant on the host of its source.
  virtual void looped_back(const Packet&, std::uint32_t /*receiver*/) {}
  virtual void backlog_changed(std::uint32_t /*participant*/, std::uint64_t /*packets*/,
                               std::int64_t /*admitted_bytes*/) {}
  /// How many fragments wait for the channel now.
  virtual void waiting_changed(std::uint32_t /*channel*/, std::uint64_t /*fragments*/) {}
};

/// What the probes of one list have in common.
struct Company {
  std::shared_ptr<const RunClock> clock;  ///< may be read instead of counting events
  /// Probes that gather what several of the others need; they hear of everything before these.
  std::vector<std::shared_ptr<Probe>> gatherers;

  /// The gatherer that gathers the same as this one, which is added if there is none.
  template <class Gatherer>
  [[nodiscard]] std::shared_ptr<Gatherer> gatherer_like(std::shared_ptr<Gatherer> own) {
    for (const std::shared_ptr<Probe>& one : gatherers) {
      const auto other = std::dynamic_pointer_cast<Gatherer>(one);
      if (other != nullptr && other->gathers_as(*own)) return other;
    }
    gatherers.push_back(own);
    return own;
  }
};

}  // namespace stormproof::model
