// How long a packet of the open-loop traffic may take at most so that nothing is ever asked for
// twice. Where the channel keeps the order of what matters, a packet may take longer than the
// threshold of storm.free-threshold, which is about any network.
#pragma once

#include <string>

#include "checker/engines/calculus/open_loop.hpp"

namespace stormproof::calculus {

/// Which lemma it follows from.
enum class Lemma : std::uint8_t {
  none,
  any_order,       ///< pushed DATA; the reader is not faster than a packet
  in_order,        ///< pushed DATA; no HEARTBEAT overtakes it, only initial ACKNACKs could ask
  constant_delay,  ///< pushed DATA; every packet takes the same time
  patient_reader,  ///< stateful writer; a second ACKNACK comes after the DATA that the first caused
  long_suppression  ///< stateful writer, all endpoints from the start; suppression outlasts them
};

struct Threshold {
  Lemma lemma = Lemma::none;
  bool unlimited = false;
  model::Nanoseconds delta;  ///< no packet may take longer, unless `unlimited`
  std::string formula;       ///< "min(τ_A, τ_I)"
  std::string why;           ///< one clause: what it rests on, or why there is none

  [[nodiscard]] bool exists() const { return lemma != Lemma::none; }
};

/// Pushed DATA reaches its readers before whatever its source sends later. Each stage of a channel
/// serves the fragments in the order of their requests, so only a packet that requests one fragment
/// after the other can be overtaken; or one in another flow.
[[nodiscard]] bool pushes_keep_order(const model::WirelessProfile& wireless,
                                     const OpenLoop* traffic);

/// All endpoints exist when their participant starts, whatever is drawn.
[[nodiscard]] bool is_created_at_once(const model::Deployment& deployment);

/// `traffic`: the scenario's; null if it is not known (constant delay, or not covered).
[[nodiscard]] Threshold threshold_of(const model::Scenario& scenario, const OpenLoop* traffic);

}  // namespace stormproof::calculus
