// Who executes the rules of a composition beside a run: what happens starts them, and what they do
// is told to an audit (props/monitors/audit.hpp). Here is what no composition has of its own: who
// is there, who hears whom, and which endpoint is created when.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "model/engine/node_endpoints.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/run_state.hpp"
#include "model/event.hpp"
#include "model/implementations.hpp"
#include "props/monitors/audit.hpp"

namespace stormproof::props {

namespace comp = fsm::composition;

class Follower {
 public:
  using Number = std::uint32_t;
  using OwnThings = fsm::TypeList<>;

  /// Of a run that begins; both must live as long as it does.
  Follower(model::RunState& run, Audit& audit) : run_{run}, audit_{audit} {}
  virtual ~Follower() = default;

  // What starts rules: the deeds since then must be theirs.
  virtual void started();
  virtual void due(const model::Event& event) = 0;
  virtual void rescheduled(const model::Event& event, std::uint64_t insertion) = 0;
  virtual void received(const model::Packet& packet, Number receiver) = 0;
  virtual void left_source(const model::Packet& packet) = 0;
  /// Whether a packet that leaves its source starts one.
  [[nodiscard]] virtual bool follows_leaving(model::PacketKind kind) const = 0;

 protected:
  /// Announcement 0 of participant i, or what starts it otherwise.
  virtual void expect_start(Number i) = 0;
  /// What participant i sends is next; a multicast goes to every participant of its host, then to
  /// the others.
  void expect_from(Number i, Message message);
  /// What an announcement to everybody is.
  void announce(Number i);
  [[nodiscard]] bool has_started(Number participant) const {
    return run_.now >= run_.topology.start(participant);
  }
  /// The endpoints of participant i are created when the deployment says.
  void take_creations(Number i);
  /// Which endpoint that event creates; nothing if its participant has come back since.
  [[nodiscard]] std::optional<model::Endpoint> created_by(const model::Event& event);
  void forget_creations(Number i) { creations_[i].clear(); }
  [[nodiscard]] bool may_stall() const {
    return run_.scenario.wireless.sender == model::Sender::stalls;
  }

  [[nodiscard]] const model::RunState& numbering() const { return run_; }

  model::RunState& run_;
  Audit& audit_;

 private:
  void announce_to_ports(Number i);

  std::map<Number, std::set<std::uint64_t>> creations_;  // by participant; insertion numbers
  std::map<Number, Number> created_;                     // by participant, if it may stall
};

}  // namespace stormproof::props
