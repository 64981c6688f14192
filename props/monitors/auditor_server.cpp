// Audits runs of Fast DDS with a Discovery Server: where the server and its clients are, and what
// their packets carry. What the steps do is in model/fastdds/server_steps.hpp; what clients send to
// the server is audited by Fast DDS's rules.
#include <memory>
#include <tuple>
#include <utility>

#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/server.hpp"
#include "model/fastdds/matching.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/fastdds/server_relays.hpp"
#include "props/monitors/auditor.hpp"
#include "props/monitors/auditors.hpp"

namespace stormproof::props {

namespace {

namespace server = comp::server;
namespace relay = model::fastdds::relay;
using Clients = Auditor<comp::fastdds::FastDds>;

struct ServerColumns : model::fastdds::ServerNumbers {
  template <class T>
  static constexpr auto column(T thing) {
    if constexpr (requires { T::counted; }) {
      return model::way::Nothing{};
    } else if constexpr (std::is_same_v<T, server::Change>) {
      return model::way::Elsewhere{};
    } else {
      return PlainColumns::column(thing);
    }
  }
};
struct AuditedServer : Audited<server::FastDdsServer> {
  using Things = model::Without<model::ThingsOf<server::FastDdsServer>,
                                model::ThingsOf<comp::fastdds::FastDds>>;
  using Columns = ServerColumns;
  using Heard = fsm::TypeList<server::RelayOpen>;
};

class ServerAuditor final : public AuditedRules<ServerAuditor, Clients, AuditedServer>,
                            public model::fastdds::ServerSteps<ServerAuditor> {
  using Rules = AuditedRules<ServerAuditor, Clients, AuditedServer>;
  using Steps = ServerSteps;

 public:
  using Number = Rules::Number;

  ServerAuditor(model::RunState& run, Audit& audit) : Rules{run, audit}, Steps{run} {}

  // What starts rules.
  void due(const model::Event& event) override {
    Rules::due(event);
    Clients::due(event);
  }
  void rescheduled(const model::Event& event, std::uint64_t insertion) override {
    Rules::rescheduled(event, insertion);
    Clients::rescheduled(event, insertion);
  }
  void received(const model::Packet& packet, Number receiver) override {
    if (!has_started(receiver)) return;
    if (!Steps::take_in(packet)) Clients::received(packet, receiver);
  }
  /// A reader of the server receives what is new to it.
  void take_descriptors(Number relation, const model::DescriptorSet& received) override {
    model::DescriptorSet before = planes().missing(relation);
    Clients::take_descriptors(relation, received);
    bool some = false;
    const model::Pair& ends = topology().pair(relation / 2);
    before.for_each([&](Number d) {
      if ((received.word(d / 64) >> d % 64 & 1) == 0) return;
      arrive(ends.source, model::streams[relation % 2], d);
      some = true;
    });
    if (some) run<comp::Happens<server::Arrives>>(server_id());
  }
  /// Discovery needs what clients learn.
  [[nodiscard]] bool is_required(Number) const override { return false; }

  // The host of a RunningWorld.
  using Rules::answer;
  using Rules::perform;
  using Steps::answer;
  using Steps::changed;
  using Steps::perform;
  using Steps::readers;
  template <class P, class W, class... Sayings>
  void emit(P, W& w, const std::tuple<Sayings...>&) {
    constexpr bool says_something = sizeof...(Sayings) > 0;
    Message message;
    message.pair = w.template number<comp::owner::pair>();
    if constexpr (P::owner == comp::owner::pair) {
      message.kind = packet_kind_of<P>;
      message.initial = says_something;
    } else {
      const auto relation = w.template number<comp::owner::relation>();
      const bool asks = std::is_same_v<P, server::RelayedAckNack>;
      model::Relayed relayed = contents(P{}, relation, says_something);
      message.kind = asks ? model::PacketKind::relayed_acknack : model::PacketKind::relayed;
      message.initial = asks && says_something;
      message.carries_heartbeat = relayed.has_heartbeat;
      message.detail = relation % relay::count;
      const bool of_subscriptions = message.detail == relay::subscriptions;
      message.stream = of_subscriptions ? model::Stream::sub : model::Stream::pub;
      message.relayed.of = std::make_shared<const model::Relayed>(std::move(relayed));
    }
    audit_.expect(message);
  }

  // What steps ask of it.
  using Rules::run;
  template <class Occasion>
  void runs_for_clients(Number relation) {
    model::RunningWorld<Clients, Occasion::owner> w{*this, relation};
    w.raise(Occasion{});
  }
  void open_builtin(Number pair) { Clients::open_sides(pair); }
  /// The first time. Discovery needs what is on a topic of which the client has the other side.
  void learn(Number client, const model::Relayed& relayed) {
    if (relayed.participant == client) return;
    const Number pair = topology().pair_between(relayed.participant, client);
    if (relayed.is_announcement) {
      if (value(comp::Recognised{}, pair)) return;
      assign(comp::Recognised{}, pair, true);
    } else {
      using HandedOver = comp::fastdds::HandedOver;
      const auto relation = static_cast<Number>(2 * pair + index_of(relayed.stream));
      if (has(HandedOver{}, relation, relayed.descriptor)) return;
      assign(HandedOver{}, relation, relayed.descriptor, true);
      if (model::fastdds::has_other_side(topology(), client, relayed.stream, relayed.descriptor) &&
          relayed.participant != server_id()) {
        --run_.missing;
      }
      if (run_.ends_now()) return;
    }
    Clients::open_sides(pair);
  }

 protected:
  void expect_start(Number i) override {
    schedule(server::ClientAnnouncement{}, topology().pair_between(i, server_id()),
             topology().start(i).count());
  }
};

}  // namespace

std::unique_ptr<Follower> auditor_of(model::Of<server::FastDdsServer>, model::RunState& run,
                                     Audit& audit) {
  return std::make_unique<ServerAuditor>(run, audit);
}

}  // namespace stormproof::props
