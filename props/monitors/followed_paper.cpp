// Follows the paper's composition: which packets reach whom, and how `Generate` may pack.
#include <bit>
#include <set>

#include "props/monitors/followed_rules.hpp"

namespace stormproof::props {

namespace {

namespace paper = comp::paper;

class PaperFollower final : public FollowedRules<PaperFollower, paper::Paper> {
 public:
  static constexpr bool readers_in_order_of_match = false;
  static constexpr bool cancels_any_timer = false;

  PaperFollower(const model::Scenario& scenario, const model::Topology& topology)
      : FollowedRules{scenario, topology} {
    using Info = fsm::Reflect<fsm::DiscoveryReader>;
    for (std::uint32_t relation = 0; relation < topology.relation_count(); ++relation) {
      if (topology.descriptor_count(relation) > 0) continue;
      state<comp::Reader>(relation_place(relation)) =
          Info::id<fsm::discovery_reader::EarlyComplete>;
    }
  }

  void started() override {
    begin("The start");
    for (std::uint32_t i = 0; i < topology_.participant_count(); ++i) {
      expect_timer(comp::Announcement{}, i, topology_.start(i), {});
    }
  }
  void received(const Message& message, std::uint32_t, model::Nanoseconds) override {
    using enum model::PacketKind;
    if (message.kind == spdp_multicast) {
      for (std::uint32_t pair = topology_.first_pair(message.pair);
           pair < topology_.first_pair(message.pair + 1); ++pair) {
        if (!has_started(topology_.pair(pair).destination)) continue;
        run<comp::Received<comp::SpdpMulticast>>(relation_place(2 * pair));
      }
      return;
    }
    const model::Pair& pair = topology_.pair(message.pair);
    if (!has_started(message.kind == acknack ? pair.source : pair.destination)) return;
    const Place place = relation_place(message.relation());
    if (message.kind == spdp_unicast) run<comp::Received<comp::SpdpUnicast>>(place);
    if (message.kind == data) run<comp::Received<paper::Data>>(place, &message);
    if (message.kind == heartbeat) run<comp::Received<paper::Heartbeat>>(place, &message);
    if (message.kind == acknack) run<comp::Received<paper::AckNack>>(place, &message);
  }
  [[nodiscard]] bool follows_leaving(model::PacketKind kind) const override {
    return kind == model::PacketKind::data;
  }
  void left_source(const Message& message) override {
    run<comp::LeftSource<paper::Data>>(relation_place(message.relation()), &message);
  }

  static model::PacketKind kind_of(comp::SpdpUnicast) { return model::PacketKind::spdp_unicast; }
  static model::PacketKind kind_of(paper::Heartbeat) { return model::PacketKind::heartbeat; }
  static model::PacketKind kind_of(paper::AckNack) { return model::PacketKind::acknack; }
  using FollowedRules::say;
  /// It follows from the bitmap.
  template <class Term>
  static void say(Message&, World&, const comp::Says<comp::BelowBase, Term>&) {}
  using FollowedRules::says;
  static bool says(comp::BelowBase, const Message& message, std::uint32_t d) {
    return message.descriptors.empty() || d < message.descriptors.least();
  }

  using FollowedRules::emit;
  void emit(comp::SpdpMulticast, World& w, const std::tuple<>&, comp::Site site) {
    Message message;
    message.kind = model::PacketKind::spdp_multicast;
    message.pair = w.place().participant;
    expect(message, site);
  }

  using FollowedRules::perform;
  void perform(paper::Clock::SendBatch, World& w) { send_batch<paper::Implementation>(w); }
  /// DATA that together carry the set, in order; with several readers a HEARTBEAT to each may
  /// follow one, with a single reader it may ride.
  void perform(paper::Generate, World& w, Descriptors rest, bool repair) {
    const bool piggyback = dds().sedp.piggyback != model::Piggyback::off;
    const std::size_t readers = this->readers(w.place().writer).size();
    Message wanted;
    wanted.kind = model::PacketKind::data;
    wanted.pair = w.place().pair;
    wanted.stream = model::streams[w.place().relation % 2];
    wanted.repair = repair;
    while (!rest.empty() && !difference()) {
      const Message* next = deeds_.next<Message>();
      const std::size_t size = next == nullptr ? 0 : next->descriptors.size();
      const bool possible = size > 0 && size <= rest.size();
      wanted.descriptors = rest.take(possible ? size : rest.size());
      wanted.carries_heartbeat =
          piggyback && readers == 1 && next != nullptr && next->carries_heartbeat;
      expect(wanted, site_);
      if (piggyback && readers > 1 && heartbeats_follow(w)) {
        w.for_readers([](World& r) { r.emit(paper::Heartbeat{}, comp::says()); });
      }
    }
  }

 private:
  /// Whether the next packets are a HEARTBEAT to each reader.
  bool heartbeats_follow(World& w) {
    std::size_t number = 0;
    return std::ranges::all_of(readers(w.place().writer), [&](std::uint32_t relation) {
      const Message* message = deeds_.next<Message>(number++);
      return message != nullptr && message->kind == model::PacketKind::heartbeat &&
             message->relation() == relation;
    });
  }
};

}  // namespace

std::unique_ptr<Follower> follow(model::Of<paper::Paper>, const model::Scenario& scenario,
                                 const model::Topology& topology) {
  return std::make_unique<PaperFollower>(scenario, topology);
}

}  // namespace stormproof::props
