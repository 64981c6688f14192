// Audits runs of Cyclone DDS: which submessages reach whom, and which sides of user topics open.
#include <bit>
#include <memory>
#include <optional>

#include "model/cyclone/endpoints.hpp"
#include "model/engine/submessage.hpp"
#include "props/monitors/audited_cyclone_messages.hpp"
#include "props/monitors/auditors.hpp"

namespace stormproof::props {

namespace {

namespace slot = model::cyclone::writer;
using model::Stream;
using model::Submessage;

std::uint32_t slot_of(Stream stream) {
  return stream == Stream::pub ? slot::publications : slot::subscriptions;
}
Stream other(Stream stream) { return stream == Stream::pub ? Stream::sub : Stream::pub; }

class CycloneAuditor final : public AuditedMessages<CycloneAuditor> {
 public:
  using Packet = Submessage;

  CycloneAuditor(model::RunState& run, Audit& audit) : AuditedMessages{run, audit} {
    for (Number i = 0; i < topology().participant_count(); ++i) {
      assign(cyclone::Exists{}, stride_ * i + slot::liveliness, 0, true);
      assign(cyclone::Sent{}, stride_ * i + slot::liveliness, 0, true);
    }
  }

  void due(const model::Event& event) override {
    const Number i = event.subject;
    if (event.kind == model::EventKind::participant_start) {
      run<comp::Happens<cyclone::Starts>>(i);
    } else if (event.kind == model::EventKind::endpoint_creation) {
      const std::optional<model::Endpoint> endpoint = created_by(event);
      run<comp::Happens<cyclone::Created>>(stride_ * i + slot_of(endpoint->stream), nullptr,
                                           endpoint->descriptor);
    } else {
      AuditedMessages::due(event);
    }
  }
  /// What reaches a participant before it listens is lost.
  void received(const model::Packet& packet, Number receiver) override {
    const model::Participant& participant = run_.scenario.deployment.participants[receiver];
    if (run_.now < participant.open.value_or(participant.start)) return;
    const Number sender = packet.multicast() ? packet.pair : topology().pair(packet.pair).source;
    for (const Submessage& content : *packet.submessages) {
      hear(content, sender, receiver);
      if (run_.ends_now()) return;
    }
    run<comp::Happens<cyclone::PacketEnds>>(receiver);
  }

  // The host of a RunningWorld.
  [[nodiscard]] model::WriterLayout writer_layout() const { return {stride_, slot::first_topic}; }
  [[nodiscard]] Number samples_of(Number writer) const {
    const Number number = writer % stride_;
    if (number > slot::subscriptions) return number == slot::liveliness ? 1 : 0;
    return topology().descriptor_count(writer / stride_, model::streams[number]);
  }
  using AuditedMessages::knob;
  [[nodiscard]] std::int64_t knob(cyclone::SendTime) const {
    return run_.scenario.deployment.time_to_send().count();
  }
  using AuditedMessages::assign_word;
  void assign_word(comp::X flag, Number relation, Number k, std::uint64_t received) {
    const std::uint64_t fresh = received & ~word(flag, relation, k);
    if (relation % stride_ <= slot::subscriptions && ends(relation).cross_host) {
      run_.missing -= static_cast<std::uint64_t>(std::popcount(fresh));
    }
    AuditedMessages::assign_word(flag, relation, k, received);
  }

  using AuditedMessages::perform;
  /// After a creation, or the notification of one.
  template <class W>
  void perform(cyclone::OpenTopics, W& w) {
    const Number writer = w.template number<comp::owner::writer>();
    const Number number = writer % stride_;
    if (number > slot::subscriptions) return;
    const Stream stream = model::streams[number];
    const Number topic = model::cyclone::topic_writer(stream, w.descriptor());
    if (topic == slot::none) return;
    const Number counterpart = model::cyclone::descriptor_of(topic, other(stream));
    if constexpr ((W::place.indices & comp::owner::peer_index) == 0) {
      const Number i = writer / stride_;
      for (Number p = topology().first_pair(i); p < topology().first_pair(i + 1); ++p) {
        const Number told = stride_ * topology().pair(p).reverse + slot_of(other(stream));
        if (has(cyclone::Notified{}, told, counterpart)) open_side(p, stream, topic);
      }
    } else {
      const Number own = stride_ * reader(w) + slot_of(other(stream));
      const Number back = topology().pair(w.template number<comp::owner::pair>()).reverse;
      if (has(cyclone::Exists{}, own, counterpart)) open_side(back, other(stream), topic);
    }
  }

 protected:
  void expect_start(Number i) override {
    audit_.expect(Scheduled{model::EventKind::participant_start, i, topology().start(i)});
  }

 private:
  using AuditedMessages::take_descriptors;  // X is a flag as any other

  void hear(const Submessage& content, Number sender, Number receiver) {
    const bool to_writer = content.kind == Submessage::Kind::acknack;
    const Number pair = to_writer ? topology().pair_between(receiver, sender)
                                  : topology().pair_between(sender, receiver);
    const Number relation = stride_ * pair + content.writer;
    switch (content.kind) {
      case Submessage::Kind::data:
        return run<comp::Received<cyclone::Data>>(relation, &content);
      case Submessage::Kind::heartbeat:
        return run<comp::Received<cyclone::Heartbeat>>(relation, &content);
      case Submessage::Kind::acknack:
        return run<comp::Received<cyclone::AckNack>>(relation, &content);
      default:
        return run<comp::Received<cyclone::Spdp>>(pair, &content);
    }
  }

  /// The source of the pair has created its endpoint of the topic and knows the
  /// destination's.
  void open_side(Number pair, Stream own, Number topic) {
    const bool writes = own == Stream::pub;
    const Number back = topology().pair(pair).reverse;
    World<comp::owner::relation> side{*this, stride_ * (writes ? pair : back) + topic};
    if (writes) side.raise(cyclone::WriterOpens{});
    if (!writes) side.raise(comp::ReaderOpens{});
  }
};

}  // namespace

std::unique_ptr<Follower> auditor_of(model::Of<cyclone::Cyclone>, model::RunState& run,
                                     Audit& audit) {
  return std::make_unique<CycloneAuditor>(run, audit);
}

}  // namespace stormproof::props
