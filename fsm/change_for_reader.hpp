// Fast DDS's view of one descriptor towards one matched reader (its ChangeForReader), in the
// paper's letters. It differs from fsm/descriptor_repair.hpp where Fast DDS differs from the paper:
//   * a descriptor may not exist yet (Absent); created after the match it is pushed (Q), otherwise
//   pulled (U);
//   * an ACKNACK acknowledges the prefix below its base, whatever the state;
//   * S begins when the descriptor is serialized into a message, long before it leaves the source;
//   * an initial ACKNACK makes the writer forget what it took as acknowledged (A → U).
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct ChangeForReaderIo {
  template <class D>
  struct Input {
    typename D::Bool listed{};      ///< the ACKNACK's bitmap asks for the descriptor
    typename D::Bool below_base{};  ///< its number is below the ACKNACK's base
  };
  template <class D>
  struct Output {
    typename D::Bool requested{};  ///< newly requested: the nack response is due after τ_N
    typename D::Bool enqueue{};    ///< joins the participant's asynchronous queue
  };
};

namespace change_for_reader {

struct Absent : State {};
struct U : State {};
struct R : State {};
struct Q : State {};
struct S : State {};
struct A : State {};

struct ReaderMatched : Event<ChangeForReaderIo> {};  ///< the descriptor exists already
struct Created : Event<ChangeForReaderIo> {};        ///< the reader is matched already
struct AckNackReceived : Event<ChangeForReaderIo> {};
struct InitialAckNackReceived : Event<ChangeForReaderIo> {};
struct NackResponseDue : Event<ChangeForReaderIo> {};
struct Serialized : Event<ChangeForReaderIo> {};
struct SuppressionEnded : Event<ChangeForReaderIo> {};

struct Requests : Guard<Requests> {
  template <class D>
  static constexpr typename D::Bool test(const ChangeForReaderIo::Input<D>& in) {
    return in.listed && !in.below_base;
  }
};
struct BelowBase : Holds<BelowBase> {
  static constexpr auto& flag(auto& in) { return in.below_base; }
};

struct Request : Sets<Request> {
  static constexpr auto& flag(auto& out) { return out.requested; }
};
struct Enqueue : Sets<Enqueue> {
  static constexpr auto& flag(auto& out) { return out.enqueue; }
};

using Transitions = Table<Row<Absent, ReaderMatched, U>,                  //
                          Row<Absent, Created, Q>,                        //
                          Row<U, AckNackReceived, R, Request, Requests>,  //
                          Row<R, NackResponseDue, Q, Enqueue>,            //
                          Row<Q, Serialized, S>,                          //
                          Row<S, SuppressionEnded, U>,                    //
                          Row<U, AckNackReceived, A, none, BelowBase>,    //
                          Row<R, AckNackReceived, A, none, BelowBase>,    //
                          Row<Q, AckNackReceived, A, none, BelowBase>,    //
                          Row<S, AckNackReceived, A, none, BelowBase>,    //
                          Row<A, InitialAckNackReceived, U>>;

}  // namespace change_for_reader

struct ChangeForReader : FrontEnd<ChangeForReader> {
  using Io = ChangeForReaderIo;
  using initial_state = change_for_reader::Absent;
  using transition_table = change_for_reader::Transitions;
};

}  // namespace stormproof::fsm
