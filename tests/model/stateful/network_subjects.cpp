// The network against servers that are either busy or not: emission, admission, fragments over the
// stages of a route, and their reception, for every service order, for both ways to request
// fragments, for stages on one channel and on two, and with a constant delay.
#include "model/engine/network.hpp"
#include "tests/model/stateful/naive_network.hpp"

namespace stormproof::model::stateful {

namespace {

/// Airtimes of a few round sizes, so that services of two channels end together now and then.
Scenario scenario_of(const Setup& setup) {
  Scenario s;
  s.deployment = Deployment::homogeneous(sources, 1, 2);
  WirelessProfile& w = s.wireless;
  w.kind = setup.kind;
  w.order = setup.order;
  w.fragment_request = setup.request;
  w.source_queue_bytes = Bytes{4'000};
  w.overhead_unicast = Nanoseconds{10};
  w.overhead_multicast = Nanoseconds{20};
  w.rate_unicast = BitsPerSecond{3'000'000'000'000};
  w.rate_multicast = BitsPerSecond{700'000'000'000};
  w.lost_packets = {2, 3, 7, 8, 13, 20};
  w.one_way = Nanoseconds{5};
  if (setup.two_channels) w.stages[1].channel = "down";
  return s;
}

// The product's network, with an implementation that only notes what it hears.
class NetworkUnderTest final : public Reactor, private Implementation {
 public:
  explicit NetworkUnderTest(Setup setup) : scenario_{scenario_of(setup)} { network_.attach(*this); }

  std::string react(const Call& call) override {
    happened_.clear();
    if (call.event == emission) {
      Packet packet;
      packet.kind = call.payload[2] == 0 ? PacketKind::spdp_multicast : PacketKind::heartbeat;
      packet.payload_bytes = static_cast<std::uint32_t>(payloads[call.payload[1]]);
      network_.emit(static_cast<std::uint32_t>(call.payload[0]), std::move(packet));
    } else {
      const Event event = run_.queue.pop();
      run_.now = event.time;
      network_.handle(event);
    }
    const Depths depths = network_.depths();
    return network_words(run_.now.count(), happened_, depths.backlog_packets, depths.admitted_bytes,
                         depths.waiting, run_.queue.size());
  }

 private:
  void start() override {}
  void handle(const Event&) override {}
  void source_completed(const Packet& packet) override {
    happened_ += ", completed " + std::to_string(packet.number);
  }
  [[nodiscard]] bool receives_separately() const override { return false; }
  [[nodiscard]] std::vector<std::uint32_t> receivers(const Packet&) const override { return {}; }
  void received(const Packet& packet, std::uint32_t) override {
    happened_ += ", received " + std::to_string(packet.number);
  }
  void renew_bitmap(Packet&) override {}
  [[nodiscard]] std::uint32_t next_recipient(const Packet&, std::uint32_t pair) const override {
    return pair;
  }
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t) override { return {}; }

  Scenario scenario_;
  RunState run_{scenario_, nullptr};
  Network network_{run_};
  std::string happened_;
};

EngineSubject network(const char* name, Setup setup, std::vector<Wrong> wrongs) {
  return engine_subject<Servers, NetworkUnderTest>(
      name,
      {{"packet (source, size, not multicast)", {sources - 1, std::size(payloads) - 1, 2}},
       {"next event"}},
      std::move(wrongs), setup);
}

}  // namespace

std::vector<EngineSubject> network_subjects() {
  using Kind = ServiceKind;
  using Order = ServiceOrder;
  using Request = FragmentRequest;
  constexpr auto shared = Kind::shared_channel;
  constexpr auto one_by_one = Request::sequential;
  constexpr auto together = Request::at_admission;
  return {
      network("NetworkUplinkFirst", {shared, Order::fifo_uplink, one_by_one, false},
              {Wrong::admits_one_more, Wrong::airtime_rounded_down, Wrong::serves_two_at_once,
               Wrong::loses_nothing, Wrong::receives_by_fragment, Wrong::completes_late}),
      network("NetworkDownlinkFirst", {shared, Order::fifo_downlink, one_by_one, false},
              {Wrong::rank_ignored}),
      network("NetworkFifo", {shared, Order::fifo, one_by_one, false}, {Wrong::forwards_first}),
      network("NetworkDatagrams", {shared, Order::datagram_uplink, one_by_one, false}, {}),
      network("NetworkAtAdmission", {shared, Order::fifo_uplink, together, false}, {}),
      network("NetworkDatagramsAtAdmission", {shared, Order::datagram_uplink, together, false}, {}),
      network("NetworkTwoChannels", {shared, Order::fifo_uplink, one_by_one, true}, {}),
      network("NetworkConstantDelay", {Kind::constant_delay, Order::fifo, one_by_one, false},
              {Wrong::loses_nothing})};
}

}  // namespace stormproof::model::stateful
