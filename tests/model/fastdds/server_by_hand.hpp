// A Discovery Server whose clients are the test: what it receives is said one packet after the
// other, its events happen as time goes on, and what it sends is kept and goes nowhere. So a rule
// of its database or relays can be met alone, with times that can be worked out by hand.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "model/engine/network.hpp"
#include "model/engine/run_state.hpp"
#include "model/fastdds/server_protocol.hpp"
#include "model/probe.hpp"

namespace stormproof::model::fastdds {

class ServerByHand : private Probe {
 public:
  using Numbers = std::vector<std::int64_t>;

  /// What the server has sent to a client's reader of one relay.
  struct Sent {
    std::int64_t time_ns = 0;
    std::uint32_t client = 0;
    std::uint32_t relay = 0;
    Relayed what;
  };

  /// All clients are on the server's host, with default endpoints. A datagram keeps the thread busy
  /// for 50 µs; what the server passes on is confirmed, asked for and repeated after 1 s, 1 ms and
  /// 10 ms, announcements after 350, 100 and 11 ms.
  explicit ServerByHand(std::uint32_t clients, Discovery discovery = Discovery::server);

  // What clients do, now.
  void registers(std::uint32_t i);
  /// Descriptor 0 of a stream is on the topic that everybody has.
  void advertises(std::uint32_t i, Stream s, std::uint32_t d = 0);
  void acknowledges(std::uint32_t j, std::uint32_t relay, std::int64_t base,
                    const Numbers& asks_for = {});

  /// The server's events happen up to this instant, which is now then.
  void until(std::int64_t time_ns);

  /// What has been sent since the last time it was asked for; DATA, GAPs or HEARTBEATs alone.
  std::vector<Sent> sent();
  std::vector<Sent> data();
  std::vector<Sent> gaps();
  std::vector<Sent> heartbeats();
  /// For when events of this kind were scheduled, since the last time that it was asked for.
  std::vector<std::int64_t> scheduled_for(EventKind kind);

  [[nodiscard]] ServerProtocol& protocol() { return protocol_; }
  [[nodiscard]] std::uint32_t server_id() const { return scenario_.deployment.size(); }

 private:
  void scheduled(std::uint64_t insertion, Nanoseconds time, EventKind kind,
                 std::uint32_t subject) override;
  void looped_back(const Packet& packet, std::uint32_t receiver) override;
  void receive(Packet&& packet, std::uint32_t from, bool to_writer);
  template <class Is>
  std::vector<Sent> those(Is is);

  Scenario scenario_;
  RunState run_;
  Network network_;
  ServerProtocol protocol_;
  std::vector<Sent> sent_;
  std::map<EventKind, std::vector<std::int64_t>> scheduled_;
};

}  // namespace stormproof::model::fastdds
