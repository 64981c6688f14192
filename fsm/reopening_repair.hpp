// The writer's view of one descriptor towards one reader that may have forgotten it: the paper's
// machine (fsm/descriptor_repair.hpp), and two ways out of A. Without them a writer that was told
// once never serves a reader that comes back under the same name.
// Rules implemented: those of DescriptorRepair; reception of an initial ACKNACK by a writer that
// forgets with its reader (A→U), and of a request for what was acknowledged (A→R).
#pragma once

#include <boost/mpl/push_back.hpp>
#include <boost/mpl/size.hpp>

#include "fsm/descriptor_repair.hpp"

namespace stormproof::fsm {

namespace reopening_repair {

using descriptor_repair::A;
using descriptor_repair::R;
using descriptor_repair::Request;
using descriptor_repair::U;

struct ReaderForgot : Event<DescriptorRepairIo> {};
struct RequestedAgain : Event<DescriptorRepairIo> {};

/// A table and one more row.
template <class Rows, class More>
using And = typename boost::mpl::push_back<
    Rows, detail::NumberedRow<static_cast<RowId>(boost::mpl::size<Rows>::value), More>>::type;

using Transitions = And<And<descriptor_repair::Transitions, Row<A, ReaderForgot, U>>,
                        Row<A, RequestedAgain, R, Request>>;

}  // namespace reopening_repair

struct ReopeningRepair : FrontEnd<ReopeningRepair> {
  using Io = DescriptorRepairIo;
  using initial_state = descriptor_repair::U;
  using transition_table = reopening_repair::Transitions;
};

}  // namespace stormproof::fsm
