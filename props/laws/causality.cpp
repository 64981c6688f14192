// Laws of causality: no effect before its cause, none of a packet that is not delivered, and no
// reader that claims to know what it has not received.
#include <set>

#include <fmt/core.h>

#include "model/airtime.hpp"
#include "props/laws/families.hpp"
#include "props/laws/watching.hpp"
#include "props/monitors/delay_meter.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/observer.hpp"
#include "props/monitors/packet_fates.hpp"
#include "props/monitors/received_descriptors.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;
using model::Packet;
using model::PacketKind;
using model::Scenario;
using Kind = model::MachineRef::Kind;

/// Packets from emission to reception.
class PacketWatch : public Observer {
 public:
  explicit PacketWatch(const Scenario& scenario)
      : Observer{"law.causality"},
        wireless_{scenario.wireless},
        fragmentation_{scenario.wireless} {}

  void event_started(const model::Event& event) override {
    if (event.time < now()) object_now("Time runs backwards.");
    Observer::event_started(event);
  }
  void scheduled(std::uint64_t, Nanoseconds time, model::EventKind kind, std::uint32_t) override {
    if (time < now()) {
      object_now(fmt::format("At {} {} is scheduled for {}.", time_text(now()), name_of(kind),
                             time_text(time)));
    }
  }
  void emitted(const Packet& packet, std::uint32_t, std::span<const std::uint32_t>) override {
    if (packet.emitted != now() || packet.number != emitted_.size()) {
      object_now(fmt::format("Packet {} is emitted at {} as number {}.", packet.number,
                             time_text(packet.emitted), emitted_.size()));
    }
    emitted_.resize(packet.number + packet.copies, now());
  }
  void received(const Packet& packet, std::uint32_t receiver) override {
    if (!crosses_hosts(topology(), packet, receiver)) return;
    const std::uint64_t number = packet.number;
    if (number >= emitted_.size()) {
      object_now(fmt::format("Packet {} is received, but not emitted.", number));
      return;
    }
    if (is_lost(wireless_, number))
      object_now(fmt::format("Packet {} is received, but lost.", number));
    if (!received_.emplace(number, receiver).second) {
      object_now(fmt::format("Packet {} is received twice.", number));
    }
    const Nanoseconds earliest = emitted_[number] + least_delay(packet);
    if (now() >= earliest) return;
    object_now(fmt::format("Packet {} is emitted at {} and received at {}, before {}.", number,
                           time_text(emitted_[number]), time_text(now()), time_text(earliest)));
  }

 private:
  /// The constant delay; or all fragments in the first stage, and the last one in the others.
  [[nodiscard]] Nanoseconds least_delay(const Packet& packet) const {
    if (wireless_.kind == model::ServiceKind::constant_delay) {
      return one_way_of(wireless_, packet.number);
    }
    const std::int64_t last = fragmentation_.count(packet.payload_bytes) - 1;
    std::int64_t sum = 0;
    for (std::size_t x = 0; x < wireless_.stages.size(); ++x) {
      const auto rate = service_rate(wireless_, wireless_.stages[x], packet.multicast());
      for (std::int64_t k = x == 0 ? 0 : last; k <= last; ++k) {
        sum += rate.airtime_ns(fragmentation_.bytes(packet.payload_bytes, k));
      }
    }
    return Nanoseconds{sum};
  }

  const model::WirelessProfile& wireless_;
  model::Fragmentation fragmentation_;
  std::vector<Nanoseconds> emitted_;  // by packet number
  std::set<std::pair<std::uint64_t, std::uint32_t>> received_;
};

/// State changes that a reception causes, and the reception.
class ReceptionWatch : public Observer {
 public:
  explicit ReceptionWatch(const Scenario& scenario)
      : Observer{"law.delivered"}, scenario_{scenario} {}

  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    arriving_.reset();
  }
  void received(const Packet& packet, std::uint32_t receiver) override {
    arriving_ = Arrival{packet.kind, packet.pair, packet.multicast() ? 0 : packet.relation(),
                        packet.detail, receiver};
  }
  void transition(const model::Transition& fired) override {
    if (!fired.event.ends_with("Received")) return;
    if (arriving_ && causes(*arriving_, fired.machine, fired.event)) return;
    object_now(fmt::format("At {} {} of {} {} happens without such a packet.", time_text(now()),
                           fired.event, fired.machine.machine, fired.machine.subject));
  }

 private:
  struct Arrival {
    PacketKind kind;
    std::uint32_t pair;
    std::uint32_t relation;
    std::uint32_t control_relation;
    std::uint32_t receiver;
  };

  [[nodiscard]] bool has_started(std::uint32_t participant) const {
    return now() >= scenario_.deployment.participants[participant].start;
  }
  [[nodiscard]] bool causes(const Arrival& arrival, const model::MachineRef& machine,
                            std::string_view event) const {
    const std::uint32_t subject = machine.subject;
    if (machine.kind == Kind::control_relation) {
      const bool acknack = event == "InitialAckNackReceived";
      const bool rides = arrival.kind == PacketKind::lookup && !acknack;
      return arrival.control_relation == subject &&
             (rides ||
              arrival.kind == (acknack ? PacketKind::user_acknack : PacketKind::user_heartbeat));
    }
    if (machine.kind == Kind::writer) {  // a response to the adaptive policy
      return arrival.kind == PacketKind::acknack &&
             2 * topology().pair(arrival.pair).source + arrival.relation % 2 == subject &&
             has_started(subject / 2);
    }
    const model::Pair& ends = topology().pair(subject / 2);
    if (event == "AnnouncementReceived") {
      const bool multicast = arrival.kind == PacketKind::spdp_multicast;
      const bool addressed =
          multicast ? arrival.pair == ends.source
                    : arrival.kind == PacketKind::spdp_unicast && arrival.pair == subject / 2;
      return addressed && has_started(ends.destination);
    }
    const bool by_writer = arrival.kind == PacketKind::acknack;
    return arrival.kind != PacketKind::spdp_multicast && arrival.relation == subject &&
           has_started(by_writer ? ends.source : ends.destination);
  }

  const Scenario& scenario_;
  std::optional<Arrival> arriving_;
};

/// What ACKNACKs claim to have, and what was sent and taken.
class KnowledgeWatch : public Observer {
 public:
  explicit KnowledgeWatch(const Scenario& scenario)
      : Observer{"law.knowledge"}, bases_{traits_of(scenario).acknacks_have_bases} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    sent_.reset(topology);
    received_.reset(topology);
  }
  void emitted(const Packet& packet, std::uint32_t, std::span<const std::uint32_t>) override {
    note(packet);
  }
  void looped_back(const Packet& packet, std::uint32_t) override { note(packet); }
  void received(const Packet& packet, std::uint32_t) override { received_.arriving(packet); }
  void transition(const model::Transition& fired) override {
    const Packet* data = received_.taken(fired.machine, fired.event);
    if (data == nullptr) return;
    const std::uint32_t unsent = sent_.first_of(data->relation(), data->descriptors, false);
    if (unsent != UINT32_MAX) {
      object_now(fmt::format("{} is received, but was never sent.",
                             descriptor_text(topology(), data->relation(), unsent)));
    }
    received_.take(*data);
  }

 private:
  void note(const Packet& packet) {
    if (packet.kind == PacketKind::data) sent_.add(packet.relation(), packet.descriptors);
    if (packet.kind == PacketKind::acknack) check_claims(packet);
  }
  void check_claims(const Packet& acknack) {
    if (bases_ && acknack.initial_acknack) return;  // it claims nothing
    const std::uint32_t relation = acknack.relation();
    const std::uint32_t end = bases_ ? acknack.detail : topology().descriptor_count(relation);
    for (std::uint32_t d = 0; d < end; ++d) {
      const bool asked = (acknack.descriptors.word(d / 64) >> d % 64 & 1) != 0;
      if (asked || received_.words().test(relation, d)) continue;
      object_now(fmt::format("At {} an ACKNACK confirms {}, which was not received.",
                             time_text(now()), descriptor_text(topology(), relation, d)));
      return;
    }
  }

  bool bases_;
  RelationWords sent_;
  ReceivedDescriptors received_;
};

constexpr Law causality_list[] = {
    watched_law<PacketWatch>(
        "law.causality",
        "Nothing is scheduled in the past, and a packet is received at most once, only if it is "
        "not lost, and not before its emission and its airtime.",
        always),
    watched_law<ReceptionWatch>(
        "law.delivered",
        "Only a packet that is delivered to a started participant changes a state that depends on "
        "it.",
        is_of_two_writers),
    watched_law<KnowledgeWatch>(
        "law.knowledge",
        "A reader knows only what was sent and received, and an ACKNACK confirms nothing else.",
        says_one_thing),
};

}  // namespace

std::span<const Law> causality_laws() { return causality_list; }

}  // namespace stormproof::props
