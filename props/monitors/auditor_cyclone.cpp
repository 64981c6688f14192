// Audits runs of Cyclone DDS. What its event threads do is in model/cyclone/thread_steps.hpp; which
// packets they send, copy by copy and with their sizes, is held against the run.
#include <bit>
#include <memory>

#include "model/composition_of.hpp"
#include "model/cyclone/living_steps.hpp"
#include "props/monitors/auditor.hpp"
#include "props/monitors/auditors.hpp"

namespace stormproof::props {

namespace {

namespace cyclone = comp::cyclone;

template <class Composition>
struct CycloneColumns : model::cyclone::Numbers {
  template <class T>
  static constexpr auto column(T thing) {
    if constexpr (std::is_same_v<T, comp::X>) {
      return model::way::Bits{};
    } else {
      return AuditColumns<Composition>::column(thing);
    }
  }
};
template <class Composition>
struct AuditedCyclone : Audited<Composition> {
  using Columns = CycloneColumns<Composition>;
  using Heard = fsm::TypeList<cyclone::WriterOpen>;
  using Packet = model::Submessage;
};

/// `Self` is the auditor, and `Steps_` what it has of ThreadSteps.
template <class Self, class Composition, class Steps_>
class CycloneAuditorOf : public AuditedRules<Self, Follower, AuditedCyclone<Composition>>,
                         public Steps_ {
 protected:
  using Rules = AuditedRules<Self, Follower, AuditedCyclone<Composition>>;
  using Steps = Steps_;

 public:
  using Number = std::uint32_t;
  using Packet = model::Submessage;

  CycloneAuditorOf(model::RunState& run, Audit& audit) : Rules{run, audit}, Steps{run} {
    this->begin_liveliness();
  }

  void due(const model::Event& event) override {
    if (event.kind == model::EventKind::participant_start) {
      run<comp::Happens<cyclone::Starts>>(event.subject);
    } else if (event.kind == model::EventKind::endpoint_creation) {
      this->create(event.subject, *this->created_by(event));
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
    this->run_.missing -=
        static_cast<std::uint64_t>(std::popcount(this->required(relation, k, received)));
    Rules::assign_word(flag, relation, k, received);
  }

  // What steps ask of it, besides.
  /// A multicast reaches those of the same host, too.
  void send_copy(Number i, Number to) { this->expect_from(i, copy_to(i, to)); }
  [[nodiscard]] props::Message copy_to(Number i, Number to) const {
    props::Message copy;
    copy.kind = model::PacketKind::rtps_message;
    copy.to_group = to == model::cyclone::group;
    copy.pair = copy.to_group ? i : this->topology().pair_between(i, to);
    copy.bytes = static_cast<Number>(this->threads_[i].bytes);
    copy.contents.of = this->threads_[i].contents;
    return copy;
  }
  /// If that takes time; whether it does because the participant stalls shows in the run.
  [[nodiscard]] bool pauses(Number) {
    if (Steps::knob(cyclone::SendTime{}) > 0) return true;
    const Move* next = this->may_stall() ? this->audit_.deeds().template next<Move>() : nullptr;
    return next != nullptr && next->event == fsm::name_of<fsm::event_thread::CopySent>();
  }

 protected:
  void expect_start(Number i) override {
    this->audit_.expect(
        Scheduled{model::EventKind::participant_start, i, this->topology().start(i)});
  }

 private:
  using Rules::take_descriptors;  // X is a flag as any other
  using Steps::create;
};

class CycloneAuditor final : public CycloneAuditorOf<CycloneAuditor, cyclone::Cyclone,
                                                     model::cyclone::ThreadSteps<CycloneAuditor>> {
 public:
  using CycloneAuditorOf::CycloneAuditorOf;
};

class LivingAuditor final : public CycloneAuditorOf<LivingAuditor, cyclone::CycloneLiving,
                                                    model::cyclone::LivingSteps<LivingAuditor>> {
  using Below = CycloneAuditorOf<LivingAuditor, cyclone::CycloneLiving,
                                 model::cyclone::LivingSteps<LivingAuditor>>;

 public:
  using Below::Below;

  void due(const model::Event& event) override {
    if (event.kind == model::EventKind::endpoint_creation) {
      return change(event.subject, event.detail);
    }
    const Number actor = model::actor_of_timer(*this, event).value_or(event.subject);
    if (has_timers(actor, event.kind)) Below::due(event);
  }
  void received(const model::Packet& packet, Number receiver) override {
    if (hears_packet(packet, receiver)) Steps::take_in(packet, receiver);
  }

  // The host of a RunningWorld.
  using Below::answer;
  template <class W>
  [[nodiscard]] std::int64_t answer(comp::LeaseDuration lease, const W& w) const {
    return Steps::answer(lease, w);
  }
  using Below::assign_word;
  void assign_word(comp::X flag, Number relation, Number k, std::uint64_t received) {
    Rules::assign_word(flag, relation, k, received);
  }
  void send_copy(Number i, Number to) {
    if (to == model::cyclone::group || !addresses().is_port(to)) return Below::send_copy(i, to);
    const auto& participants = run_.scenario.deployment.participants;
    const model::HostId host = addresses().host_of(to);
    if (host == participants[i].host) return;
    const auto somebody = std::ranges::find(participants, host, &model::Participant::host);
    props::Message copy = copy_to(i, static_cast<Number>(somebody - participants.begin()));
    copy.to_nobody = true;
    expect_from(i, std::move(copy));
  }
};

}  // namespace

std::unique_ptr<Follower> auditor_of(model::Of<cyclone::Cyclone>, model::RunState& run,
                                     Audit& audit) {
  if (is_living(run.scenario)) return std::make_unique<LivingAuditor>(run, audit);
  return std::make_unique<CycloneAuditor>(run, audit);
}

}  // namespace stormproof::props
