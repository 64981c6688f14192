// The properties that this engine decides, one function and one source file each. They may throw
// z3::exception; checker/engines/tables/check.cpp catches it.
#pragma once

#include "checker/engines/bounds/check_request.hpp"

namespace stormproof::tables {

using checker::CheckRequest;
using props::Finding;

[[nodiscard]] Finding fsm_determinism(const CheckRequest& request);
[[nodiscard]] Finding fsm_totality(const CheckRequest& request);
[[nodiscard]] Finding fsm_reachability(const CheckRequest& request);
[[nodiscard]] Finding order_total(const CheckRequest& request);
[[nodiscard]] Finding order_reception_first(const CheckRequest& request);
[[nodiscard]] Finding order_commutation(const CheckRequest& request);
[[nodiscard]] Finding safety_ack_implies_received(const CheckRequest& request);
[[nodiscard]] Finding safety_repair_only_if_asked(const CheckRequest& request);
[[nodiscard]] Finding safety_snapshot(const CheckRequest& request);
[[nodiscard]] Finding composition_total(const CheckRequest& request);
[[nodiscard]] Finding composition_live(const CheckRequest& request);
[[nodiscard]] Finding composition_pending(const CheckRequest& request);
[[nodiscard]] Finding timer_single_heartbeat(const CheckRequest& request);
[[nodiscard]] Finding live_no_stall(const CheckRequest& request);
[[nodiscard]] Finding live_recovery(const CheckRequest& request);

}  // namespace stormproof::tables
