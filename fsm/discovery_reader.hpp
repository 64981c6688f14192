// The receiver of one relation (writer i, reader j, one stream): what j knows of i's descriptors.
// Its extended state, the bitmap X of received descriptors, lives outside the machine; the input
// says how many are still missing. Rules implemented: SPDP reception at the reader side, DATA and
// HEARTBEAT reception, ACKNACK generation, initial ACKNACK (its content; fsm/initial_acknack.hpp
// has its timer).
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct DiscoveryReaderIo {
  template <class D>
  struct Input {
    typename D::Bool
        accepts_unmatched{};          ///< a reader side that is not open processes what reaches it
    typename D::Int missing_after{};  ///< descriptors missing once this DATA is taken
  };
  template <class D>
  struct Output {
    typename D::Bool opened{};     ///< the reader side opens now: start the initial ACKNACK timer
    typename D::Bool take_data{};  ///< set X for the descriptors of the DATA
    typename D::Bool
        schedule_acknack{};           ///< a HEARTBEAT counts as seen; its ACKNACK is due after τ_A
    typename D::Bool send_acknack{};  ///< snapshot the bitmap and emit an ACKNACK
    typename D::Bool send_initial{};  ///< the same, marked initial
  };
};

namespace discovery_reader {

struct Unknown : State {};     ///< i's announcement has not been processed, something is missing
struct Recognised : State {};  ///< reader side open, something is missing
struct EarlyComplete : State {
};                           ///< nothing missing, though i's announcement has not been processed
struct Complete : State {};  ///< reader side open, nothing missing

struct AnnouncementReceived : Event<DiscoveryReaderIo> {};
struct DataReceived : Event<DiscoveryReaderIo> {};
struct HeartbeatReceived : Event<DiscoveryReaderIo> {};
struct AckNackDue : Event<DiscoveryReaderIo> {};
struct InitialAckNackDue : Event<DiscoveryReaderIo> {};

struct AcceptsUnmatched : Holds<AcceptsUnmatched> {
  static constexpr auto& flag(auto& in) { return in.accepts_unmatched; }
};
struct NothingMissing : Guard<NothingMissing> {
  template <class D>
  static constexpr typename D::Bool test(const DiscoveryReaderIo::Input<D>& in) {
    return in.missing_after == 0;
  }
};

struct Open : Sets<Open> {
  static constexpr auto& flag(auto& out) { return out.opened; }
};
struct TakeData : Sets<TakeData> {
  static constexpr auto& flag(auto& out) { return out.take_data; }
};
struct ScheduleAckNack : Sets<ScheduleAckNack> {
  static constexpr auto& flag(auto& out) { return out.schedule_acknack; }
};
struct SendAckNack : Sets<SendAckNack> {
  static constexpr auto& flag(auto& out) { return out.send_acknack; }
};
struct SendInitial : Sets<SendInitial> {
  static constexpr auto& flag(auto& out) { return out.send_initial; }
};

using StillMissing = Not<NothingMissing>;

using Transitions = Table<
    Row<Unknown, AnnouncementReceived, Recognised, Open>,
    Row<EarlyComplete, AnnouncementReceived, Complete, Open>,
    Row<Unknown, DataReceived, Unknown, TakeData, All<AcceptsUnmatched, StillMissing>>,
    Row<Unknown, DataReceived, EarlyComplete, TakeData, All<AcceptsUnmatched, NothingMissing>>,
    Row<Recognised, DataReceived, Recognised, TakeData, StillMissing>,
    Row<Recognised, DataReceived, Complete, TakeData, NothingMissing>,
    Row<Unknown, HeartbeatReceived, Unknown, ScheduleAckNack, AcceptsUnmatched>,
    Row<EarlyComplete, HeartbeatReceived, EarlyComplete, ScheduleAckNack, AcceptsUnmatched>,
    Row<Recognised, HeartbeatReceived, Recognised, ScheduleAckNack>,
    Row<Complete, HeartbeatReceived, Complete, ScheduleAckNack>,
    Row<Unknown, AckNackDue, Unknown, SendAckNack>,
    Row<EarlyComplete, AckNackDue, EarlyComplete, SendAckNack>,
    Row<Recognised, AckNackDue, Recognised, SendAckNack>,
    Row<Complete, AckNackDue, Complete, SendAckNack>,
    Row<Recognised, InitialAckNackDue, Recognised, SendInitial>,
    Row<Complete, InitialAckNackDue, Complete, SendInitial>>;

}  // namespace discovery_reader

struct DiscoveryReader : FrontEnd<DiscoveryReader> {
  using Io = DiscoveryReaderIo;
  using initial_state = discovery_reader::Unknown;
  using transition_table = discovery_reader::Transitions;
};

}  // namespace stormproof::fsm
