// The event thread of a participant of Cyclone DDS beside a run: it fires timers, takes what is
// queued, packs both, and sends packets copy by copy (specs/guide/cyclone.md, "The event thread").
// How messages share packets is no choice there: each packet is what the rules say, with its size.
// Which of them fit together is said in model/cyclone/packer.hpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "fsm/composition/cyclone.hpp"
#include "model/cyclone/endpoints.hpp"
#include "model/cyclone/packer.hpp"
#include "model/engine/submessage.hpp"
#include "props/monitors/auditor.hpp"

namespace stormproof::props {

namespace cyclone = comp::cyclone;

struct CycloneColumns : AuditColumns<cyclone::Cyclone> {
  template <class T>
  static constexpr auto column(T thing) {
    if constexpr (std::is_same_v<T, comp::X>) {
      return model::way::Bits{};
    } else {
      return AuditColumns::column(thing);
    }
  }
  template <comp::Owner owner>
  static std::uint32_t rows(const model::RunState& run) {
    const std::uint32_t rows = AuditColumns::rows<owner>(run);
    const bool by_stream = (owner.indices & comp::owner::stream_index) != 0;
    return by_stream ? rows / 2 * model::cyclone::writers_per_participant(run.topology) : rows;
  }
  static constexpr model::MachineRef::Kind kind(comp::Owner owner) {
    using enum model::MachineRef::Kind;
    if (owner == comp::owner::relation) return endpoint_relation;
    return owner == comp::owner::writer ? endpoint_writer : AuditColumns::kind(owner);
  }
};
struct AuditedCyclone : Audited<cyclone::Cyclone> {
  using Columns = CycloneColumns;
  using Heard = fsm::TypeList<cyclone::WriterOpen>;
  using Packet = model::Submessage;
};

/// What the thread of a participant has to do, and the packet that is being sent.
struct EventThread {
  explicit EventThread(const model::SedpProfile& sedp) : packer{sedp} {}

  std::deque<std::function<void()>> list;  ///< timers that are due, as what firing them does
  std::deque<model::cyclone::Message> queue;
  std::optional<model::cyclone::Message> given;  ///< by the timer that fires
  std::optional<std::pair<std::uint32_t, model::cyclone::Message>>
      kept;  ///< an answer, and of which relation
  model::cyclone::Packer packer;
  model::Packet sent;
  std::deque<std::uint32_t> left;  ///< addresses
};

template <class Self>
class AuditedThreads : public AuditedRules<Self, Follower, AuditedCyclone> {
  using Rules = AuditedRules<Self, Follower, AuditedCyclone>;

 public:
  using Number = typename Rules::Number;

  AuditedThreads(model::RunState& run, Audit& audit)
      : Rules{run, audit}, stride_{model::cyclone::writers_per_participant(run.topology)} {
    for (Number i = 0; i < run.topology.participant_count(); ++i) {
      threads_.emplace_back(run.scenario.dds.sedp);
    }
  }

 protected:
  void work(Number i) {
    EventThread& thread = threads_[i];
    while (!this->audit_.difference()) {
      if (!thread.left.empty()) {
        send_copy(i);
        if (pauses()) return this->template run<comp::Happens<cyclone::ThreadPauses>>(i);
        continue;
      }
      thread.packer.open_held();
      while (!thread.packer.is_complete() && take_next(thread)) {
      }
      if (!thread.packer.has_open())
        return this->template run<comp::Happens<cyclone::ThreadSleeps>>(i);
      begin_to_send(thread);
    }
  }

  const Number stride_;  ///< writers of each participant
  std::deque<EventThread> threads_;

 private:
  /// Fires a timer, or takes a message, and packs what that gives; false if there is neither.
  static bool take_next(EventThread& thread) {
    if (!thread.list.empty()) {
      const std::function<void()> fire = std::move(thread.list.front());
      thread.list.pop_front();
      fire();
    } else if (!thread.queue.empty()) {
      thread.given = std::move(thread.queue.front());
      thread.queue.pop_front();
    } else {
      return false;
    }
    if (auto given = std::exchange(thread.given, {})) thread.packer.add(std::move(*given));
    return true;
  }
  void begin_to_send(EventThread& thread) {
    model::cyclone::Bundle bundle = thread.packer.take_open();
    for (const model::Submessage& m : bundle.contents) {
      if (m.kind != model::Submessage::Kind::data) continue;
      const Number writer = stride_ * m.participant + m.writer;
      if (this->template first<cyclone::Sent>(writer) <= m.sample)
        this->template set_first<cyclone::Sent>(writer, m.sample + 1);
    }
    thread.left.assign(bundle.to.addresses.begin(), bundle.to.addresses.end());
    thread.sent.kind = model::PacketKind::rtps_message;
    thread.sent.payload_bytes = static_cast<Number>(bundle.bytes);
    thread.sent.submessages =
        std::make_shared<const std::vector<model::Submessage>>(std::move(bundle.contents));
  }
  void send_copy(Number i) {
    EventThread& thread = threads_[i];
    const Number to = thread.left.front();
    thread.left.pop_front();
    thread.sent.to_group = to == model::cyclone::group;
    thread.sent.pair = thread.sent.to_group ? i : this->topology().pair_between(i, to);
    Message copy = props::message_of(thread.sent);
    for (Number p = this->topology().first_pair(i);
         copy.to_group && p < this->topology().first_pair(i + 1); ++p) {
      if (this->topology().pair(p).cross_host) continue;
      copy.loops_to = this->topology().pair(p).destination;
      this->audit_.expect(copy);
    }
    copy.loops_to = UINT32_MAX;
    this->audit_.expect(copy);
  }
  /// After each copy if that takes time; whether it does because the participant stalls shows in
  /// the run.
  [[nodiscard]] bool pauses() {
    if (this->self().knob(cyclone::SendTime{}) > 0) return true;
    const Move* next = this->may_stall() ? this->audit_.deeds().template next<Move>() : nullptr;
    return next != nullptr && next->event == fsm::name_of<fsm::event_thread::CopySent>();
  }
};

}  // namespace stormproof::props
