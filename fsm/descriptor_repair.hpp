// The writer's view of one descriptor towards one reader: the paper's figure of the sender-side
// repair states.
//   U unacknowledged → R requested → Q queued for repair → S sent, suppressed → back to U; any of
//   them → A.
// Rules implemented: ACKNACK reception (U→R, →A), repair generation (R→Q), repair delivery at the
// source (Q→S), post-repair wait expiration (S→U).
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct DescriptorRepairIo {
  template <class D>
  struct Input {
    typename D::Bool listed{};  ///< the ACKNACK's bitmap lists the descriptor as missing
    typename D::Bool below_first_missing{};  ///< every listed descriptor has a higher number
    typename D::Bool prefix_only{};          ///< `acknowledge: prefix`
  };
  template <class D>
  struct Output {
    typename D::Bool requested{};  ///< newly requested: repair generation is due after τ_N
    typename D::Bool generate{};   ///< becomes part of the repair DATA generated now
    typename D::Bool
        returned{};  ///< open to requests again: its delivery must be checked after τ_H
  };
};

namespace descriptor_repair {

struct U : State {};
struct R : State {};
struct Q : State {};
struct S : State {};
struct A : State {};

struct AckNackReceived : Event<DescriptorRepairIo> {};
struct RepairDue : Event<DescriptorRepairIo> {};
struct RepairSent : Event<DescriptorRepairIo> {};
struct SuppressionEnded : Event<DescriptorRepairIo> {};

struct Listed : Holds<Listed> {
  static constexpr auto& flag(auto& in) { return in.listed; }
};
/// Outside the bitmap; with the prefix rule only below the first missing descriptor.
struct Confirmed : Guard<Confirmed> {
  template <class D>
  static constexpr typename D::Bool test(const DescriptorRepairIo::Input<D>& in) {
    return !in.listed && (!in.prefix_only || in.below_first_missing);
  }
};

struct Request : Sets<Request> {
  static constexpr auto& flag(auto& out) { return out.requested; }
};
struct Generate : Sets<Generate> {
  static constexpr auto& flag(auto& out) { return out.generate; }
};
struct Return : Sets<Return> {
  static constexpr auto& flag(auto& out) { return out.returned; }
};

using Transitions = Table<Row<U, AckNackReceived, R, Request, Listed>,  //
                          Row<R, RepairDue, Q, Generate>,               //
                          Row<Q, RepairSent, S>,                        //
                          Row<S, SuppressionEnded, U, Return>,          //
                          Row<U, AckNackReceived, A, none, Confirmed>,  //
                          Row<R, AckNackReceived, A, none, Confirmed>,  //
                          Row<Q, AckNackReceived, A, none, Confirmed>,  //
                          Row<S, AckNackReceived, A, none, Confirmed>>;

}  // namespace descriptor_repair

struct DescriptorRepair : FrontEnd<DescriptorRepair> {
  using Io = DescriptorRepairIo;
  using initial_state = descriptor_repair::U;
  using transition_table = descriptor_repair::Transitions;
};

}  // namespace stormproof::fsm
