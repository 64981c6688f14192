// The two sides of a relation of which only HEARTBEATs and ACKNACKs are modelled: liveliness, and
// user topics. Its traffic shares the channel with discovery, so it must be there, but nothing is
// delivered by it.
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct ControlRelationIo {
  template <class D>
  struct Input {};
  template <class D>
  struct Output {
    typename D::Bool send_heartbeat{};  ///< writer side
    typename D::Bool start_initial{};   ///< reader side: the initial ACKNACK timer starts
    typename D::Bool reply{};           ///< reader side: an ACKNACK is due after the response delay
  };
};

namespace control_relation {

struct Closed : State {};
struct Open : State {};

struct Opened : Event<ControlRelationIo> {};
struct InitialAckNackReceived : Event<ControlRelationIo> {};
struct HeartbeatReceived : Event<ControlRelationIo> {};

struct SendHeartbeat : Sets<SendHeartbeat> {
  static constexpr auto& flag(auto& out) { return out.send_heartbeat; }
};
struct StartInitial : Sets<StartInitial> {
  static constexpr auto& flag(auto& out) { return out.start_initial; }
};
struct Reply : Sets<Reply> {
  static constexpr auto& flag(auto& out) { return out.reply; }
};

using WriterTransitions = Table<Row<Closed, Opened, Open, SendHeartbeat>,
                                Row<Open, InitialAckNackReceived, Open, SendHeartbeat>>;
using ReaderTransitions =
    Table<Row<Closed, Opened, Open, StartInitial>, Row<Open, HeartbeatReceived, Open, Reply>>;

}  // namespace control_relation

struct ControlWriter : FrontEnd<ControlWriter> {
  using Io = ControlRelationIo;
  using initial_state = control_relation::Closed;
  using transition_table = control_relation::WriterTransitions;
};

struct ControlReader : FrontEnd<ControlReader> {
  using Io = ControlRelationIo;
  using initial_state = control_relation::Closed;
  using transition_table = control_relation::ReaderTransitions;
};

}  // namespace stormproof::fsm
