// Audits runs of Fast DDS with a Discovery Server: where the server and its clients are, and what
// their packets carry. What the steps do is in model/fastdds/server_steps.hpp; what clients send to
// the server is audited by Fast DDS's rules.
#include <memory>
#include <tuple>
#include <utility>

#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/server_life.hpp"
#include "model/composition_of.hpp"
#include "model/fastdds/matching.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/fastdds/server_relays.hpp"
#include "model/servers.hpp"
#include "props/monitors/auditor.hpp"
#include "props/monitors/auditors.hpp"

namespace stormproof::props {

namespace {

namespace server = comp::server;
namespace relay = model::fastdds::relay;

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
template <class Server, class OfClients>
struct AuditedServer : Audited<Server> {
  using Things = model::Without<model::ThingsOf<Server>, model::ThingsOf<OfClients>>;
  using Columns = ServerColumns;
  using Heard = fsm::TypeList<server::RelayOpen>;
};

/// `Self` audits runs of `Server`, whose clients exchange descriptors by the rules `OfClients`.
template <class Self, class Server, class OfClients>
class ServerAuditorOf
    : public AuditedRules<Self, Auditor<OfClients>, AuditedServer<Server, OfClients>>,
      public model::fastdds::ServerSteps<Self> {
  using Rules = AuditedRules<Self, Auditor<OfClients>, AuditedServer<Server, OfClients>>;
  using Steps = model::fastdds::ServerSteps<Self>;

 protected:
  using Clients = Auditor<OfClients>;

 public:
  using typename Rules::Number;

  ServerAuditorOf(model::RunState& run, Audit& audit) : Rules{run, audit}, Steps{run} {}

  // What starts rules.
  void started() override {
    Rules::started();
    Steps::for_those_who_seek(
        [&](Number pair, std::int64_t at) { this->schedule(server::ClientSync{}, pair, at); });
  }
  void due(const model::Event& event) override {
    Rules::due(event);
    Clients::due(event);
  }
  void rescheduled(const model::Event& event, std::uint64_t insertion) override {
    Rules::rescheduled(event, insertion);
    Clients::rescheduled(event, insertion);
  }
  void received(const model::Packet& packet, Number receiver) override {
    if (!this->has_started(receiver)) return;
    if (!Steps::take_in(packet)) Clients::received(packet, receiver);
  }
  /// A reader of the server receives what is new to it.
  void take_descriptors(Number relation, const model::DescriptorSet& received) override {
    model::DescriptorSet before = this->planes().missing(relation);
    Clients::take_descriptors(relation, received);
    bool some = false;
    const model::Pair& ends = this->topology().pair(relation / 2);
    before.for_each([&](Number d) {
      if ((received.word(d / 64) >> d % 64 & 1) == 0) return;
      this->arrive(ends.destination, ends.source, model::streams[relation % 2], d);
      some = true;
    });
    if (some) this->template run<comp::Happens<server::Arrives>>(ends.destination);
  }
  /// Discovery needs what clients learn.
  [[nodiscard]] bool is_required(Number) const override { return false; }

  // The host of a RunningWorld.
  using Rules::answer;
  using Rules::perform;
  using Rules::renew;
  using Steps::answer;
  using Steps::changed;
  using Steps::perform;
  using Steps::readers;
  using Steps::renew;
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
      model::Relayed relayed = this->contents(P{}, relation, says_something);
      message.kind = asks ? model::PacketKind::relayed_acknack : model::PacketKind::relayed;
      message.initial = asks && says_something;
      message.carries_heartbeat = relayed.has_heartbeat;
      message.detail = relation % relay::count;
      const bool of_subscriptions = message.detail == relay::subscriptions;
      message.stream = of_subscriptions ? model::Stream::sub : model::Stream::pub;
      message.relayed.of = std::make_shared<const model::Relayed>(std::move(relayed));
    }
    this->audit_.expect(message);
  }

  // What steps ask of it.
  using Rules::run;
  template <class Occasion>
  void runs_for_clients(Number relation) {
    model::RunningWorld<Clients, Occasion::owner> w{static_cast<Clients&>(*this), relation};
    w.raise(Occasion{});
  }
  void open_builtin(Number pair) { Clients::open_sides(pair); }
  /// The first time. Discovery needs what is on a topic of which the client has the other side.
  void learn(Number client, const model::Relayed& relayed) {
    if (relayed.participant == client) return;
    const Number pair = this->topology().pair_between(relayed.participant, client);
    if (relayed.is_announcement) {
      if (this->value(comp::Recognised{}, pair)) return;
      this->assign(comp::Recognised{}, pair, true);
    } else {
      const auto relation = static_cast<Number>(2 * pair + index_of(relayed.stream));
      if (this->has(HandedOver{}, relation, relayed.descriptor)) return;
      this->assign(HandedOver{}, relation, relayed.descriptor, true);
      if (counts(pair, relayed.stream, relayed.descriptor)) --this->run_.missing;
      if (this->run_.ends_now()) return;
    }
    Clients::open_sides(pair);
  }

 protected:
  using HandedOver = comp::fastdds::HandedOver;

  /// Whether discovery needs that the pair's destination learns the descriptor.
  [[nodiscard]] virtual bool counts(Number pair, model::Stream s, Number d) const {
    const model::Pair& ends = this->topology().pair(pair);
    return !this->topology().is_server(ends.source) &&
           !this->topology().is_server(ends.destination) &&
           model::fastdds::has_other_side(this->topology(), ends.destination, s, d);
  }
  void expect_start(Number i) override {
    const Number first = servers_of(this->run_.scenario.deployment, i).front();
    this->schedule(server::ClientAnnouncement{}, this->topology().pair_between(i, first),
                   this->topology().start(i).count());
  }
};

class ServerAuditor final
    : public ServerAuditorOf<ServerAuditor, server::FastDdsServer, comp::fastdds::FastDds> {
 public:
  using ServerAuditorOf::ServerAuditorOf;
};

class LivingServerAuditor final
    : public ServerAuditorOf<LivingServerAuditor, server::FastDdsServerLiving,
                             comp::fastdds::FastDdsLiving> {
 public:
  LivingServerAuditor(model::RunState& run, Audit& audit) : ServerAuditorOf{run, audit} {
    for (Number pair = 0; pair < run.topology.pair_count(); ++pair) {
      if (waits_for(pair)) continue;
      const model::Pair& ends = run.topology.pair(pair);
      run.missing -= run.topology.matching_descriptors(ends.source, ends.destination,
                                                       run.scenario.dds.descriptors);
    }
  }
  void started() override {
    ServerAuditorOf::started();
    for (Number k = 0; k < topology().server_count(); ++k) {
      schedule(comp::Announcement{}, topology().first_server() + k, 0);
    }
  }
  void received(const model::Packet& packet, Number receiver) override {
    const model::Pair& ends = topology().pair(packet.pair);
    const Number sender = packet.to_writer() ? ends.destination : ends.source;
    const model::Deployment& deployment = run_.scenario.deployment;
    if (hears(deployment, sender, receiver, packet.emitted, run_.now)) {
      ServerAuditorOf::received(packet, receiver);
    }
  }

  // What steps ask of it.
  void forget_exchange(Number pair) {
    model::RunningWorld<Clients, comp::owner::pair>{*this, pair}.call(
        comp::fastdds::Life::Forget{});
  }
  /// A goodbye is heeded, and a descriptor taken, of somebody who is known.
  void learn(Number client, const model::Relayed& relayed) {
    if (relayed.participant == client) return;
    const Number pair = topology().pair_between(relayed.participant, client);
    const bool is_known = value(comp::Recognised{}, pair);
    if (relayed.is_goodbye) {
      if (is_known) forget(pair);
    } else if (is_known || relayed.is_announcement) {
      ServerAuditorOf::learn(client, relayed);
    }
  }

 private:
  [[nodiscard]] bool waits_for(Number pair) const {
    const model::Pair& ends = topology().pair(pair);
    const auto stays = [&](Number i) { return !is_replaced(life_, i) && !dying_[i]; };
    return stays(ends.source) && stays(ends.destination);
  }
  [[nodiscard]] bool counts(Number pair, model::Stream s, Number d) const override {
    return waits_for(pair) && ServerAuditorOf::counts(pair, s, d);
  }
  void forget(Number pair) {
    const Number source = topology().pair(pair).source;
    for (const model::Stream s : model::streams) {
      const auto relation = static_cast<Number>(2 * pair + index_of(s));
      for (Number d = 0; d < topology().descriptor_count(source, s); ++d) {
        if (has(HandedOver{}, relation, d) && counts(pair, s, d)) ++run_.missing;
      }
    }
    forget_exchange(pair);
  }
};

}  // namespace

std::unique_ptr<Follower> auditor_of(model::Of<server::FastDdsServer>, model::RunState& run,
                                     Audit& audit) {
  if (is_living(run.scenario)) return std::make_unique<LivingServerAuditor>(run, audit);
  return std::make_unique<ServerAuditor>(run, audit);
}

}  // namespace stormproof::props
