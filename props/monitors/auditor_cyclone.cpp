// Audits runs of Cyclone DDS. What its event threads do is in model/cyclone/thread_steps.hpp; which
// packets they send, copy by copy and with their sizes, is held against the run.
#include <bit>
#include <memory>

#include "model/cyclone/thread_steps.hpp"
#include "props/monitors/auditor.hpp"
#include "props/monitors/auditors.hpp"

namespace stormproof::props {

namespace {

namespace cyclone = comp::cyclone;

struct CycloneColumns : model::cyclone::Numbers {
  template <class T>
  static constexpr auto column(T thing) {
    if constexpr (std::is_same_v<T, comp::X>) {
      return model::way::Bits{};
    } else {
      return AuditColumns<cyclone::Cyclone>::column(thing);
    }
  }
};
struct AuditedCyclone : Audited<cyclone::Cyclone> {
  using Columns = CycloneColumns;
  using Heard = fsm::TypeList<cyclone::WriterOpen>;
  using Packet = model::Submessage;
};

class CycloneAuditor final : public AuditedRules<CycloneAuditor, Follower, AuditedCyclone>,
                             public model::cyclone::ThreadSteps<CycloneAuditor> {
  using Rules = AuditedRules<CycloneAuditor, Follower, AuditedCyclone>;
  using Steps = ThreadSteps;

 public:
  using Number = std::uint32_t;
  using Packet = model::Submessage;

  CycloneAuditor(model::RunState& run, Audit& audit) : Rules{run, audit}, Steps{run} {
    begin_liveliness();
  }

  void due(const model::Event& event) override {
    if (event.kind == model::EventKind::participant_start) {
      run<comp::Happens<cyclone::Starts>>(event.subject);
    } else if (event.kind == model::EventKind::endpoint_creation) {
      create(event.subject, *created_by(event));
    } else {
      Rules::due(event);
    }
  }
  void received(const model::Packet& packet, Number receiver) override {
    Steps::take_in(packet, receiver);
  }

  // The host of a RunningWorld.
  template <class Trigger>
  void run(Number n, const Packet* content = nullptr, Number descriptor = 0) {
    Rules::template run<Trigger>(n, content, descriptor);
  }
  using Rules::answer;
  using Rules::assign_word;
  using Rules::knob;
  using Rules::perform;
  using Rules::word;
  using Steps::answer;
  using Steps::changed;
  using Steps::emit;
  using Steps::knob;
  using Steps::perform;
  using Steps::readers;
  using Steps::said;
  using Steps::word;
  void assign_word(comp::X flag, Number relation, Number k, std::uint64_t received) {
    run_.missing -= static_cast<std::uint64_t>(std::popcount(required(relation, k, received)));
    Rules::assign_word(flag, relation, k, received);
  }

  // What steps ask of it, besides.
  /// A multicast reaches those of the same host, too.
  void send_copy(Number i, Number to) {
    model::Packet packet;
    packet.kind = model::PacketKind::rtps_message;
    packet.to_group = to == model::cyclone::group;
    packet.pair = packet.to_group ? i : topology().pair_between(i, to);
    packet.payload_bytes = static_cast<Number>(threads_[i].bytes);
    packet.submessages = threads_[i].contents;
    expect_from(i, props::message_of(packet));
  }
  /// If that takes time; whether it does because the participant stalls shows in the run.
  [[nodiscard]] bool pauses(Number) {
    if (knob(cyclone::SendTime{}) > 0) return true;
    const Move* next = may_stall() ? audit_.deeds().next<Move>() : nullptr;
    return next != nullptr && next->event == fsm::name_of<fsm::event_thread::CopySent>();
  }

 protected:
  void expect_start(Number i) override {
    audit_.expect(Scheduled{model::EventKind::participant_start, i, topology().start(i)});
  }

 private:
  using Rules::take_descriptors;  // X is a flag as any other
  using Steps::create;
};

}  // namespace

std::unique_ptr<Follower> auditor_of(model::Of<cyclone::Cyclone>, model::RunState& run,
                                     Audit& audit) {
  return std::make_unique<CycloneAuditor>(run, audit);
}

}  // namespace stormproof::props
