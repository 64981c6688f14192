// Each demand takes the first ACKNACK that is used already and fits, otherwise the first unused
// one that fits. Windows only shrink; used ACKNACKs arrive in the order in which they were sent.
#include "checker/evidence/conform/requests.hpp"

#include <algorithm>

namespace stormproof::conform {

std::uint32_t existing_at_opening(const Relation& relation) {
  if (relation.sent.empty() || !relation.sent.front().heartbeat) return 0;
  return relation.sent.front().heartbeat->announced;
}

namespace {
/// A Discovery Server's own announcement that answers a client at once comes without a HEARTBEAT,
/// and not from the relay.
bool is_answer(const Relation& relation, std::size_t data) {
  if (relation.place.writer != capture::entity::spdp_writer) return false;
  const std::uint32_t datagram = relation.sent[data].datagram;
  for (std::size_t k = data + 1; k < relation.sent.size(); ++k) {
    if (relation.sent[k].datagram != datagram) break;
    if (relation.sent[k].heartbeat) return false;
  }
  return true;
}
}  // namespace

std::vector<Transmission> transmissions_of(const Relation& relation) {
  const std::uint32_t existing = existing_at_opening(relation);
  std::vector<Transmission> all;
  std::vector<bool> seen;
  for (std::size_t k = 0; k < relation.sent.size(); ++k) {
    const Submessage& one = relation.sent[k];
    if (!one.descriptor || is_answer(relation, k)) continue;
    const std::uint32_t d = *one.descriptor;
    if (d >= seen.size()) seen.resize(d + 1);
    const bool is_first = !seen[d];
    all.push_back({d, one.time_ns, one.event, is_first, is_first && d >= existing});
    seen[d] = true;
  }
  return all;
}

Requests::Requests(const Relation& relation, const std::vector<Transmission>& transmissions,
                   const Bounds& bounds, std::int64_t send_lag_ns)
    : relation_{relation} {
  // What has been acknowledged is not sent any more: no ACKNACK arrives before the last
  // transmission of what it acknowledges.
  std::vector<std::int64_t> last;
  for (const Transmission& one : transmissions) {
    if (one.descriptor >= last.size()) last.resize(one.descriptor + 1, INT64_MIN);
    last[one.descriptor] = std::max(last[one.descriptor], one.time_ns - send_lag_ns);
  }
  std::vector<std::int64_t> prefix = last;
  for (std::size_t d = 1; d < prefix.size(); ++d) prefix[d] = std::max(prefix[d], prefix[d - 1]);
  asking_.resize(last.size());
  served_.resize(last.size());
  for (std::size_t k = 0; k < relation.answers.size(); ++k) {
    const Answer& answer = relation.answers[k];
    Arrival arrival{answer.time_ns + bounds.least_delay_ns - bounds.clock_error_ns,
                    answer.time_ns + bounds.most_delay_ns + bounds.clock_error_ns, false};
    if (answer.base > 0 && !prefix.empty()) {
      const std::size_t below = std::min<std::size_t>(answer.base, prefix.size()) - 1;
      if (prefix[below] > INT64_MIN) arrival.from_ns = std::max(arrival.from_ns, prefix[below] + 1);
    }
    arrivals_.push_back(arrival);
    for (const std::uint32_t d : answer.missing) {
      if (d < asking_.size()) asking_[d].push_back(k);
    }
  }
}

/// The window of answer `k` if it also serves `demand`, between its used neighbours.
Arrival Requests::fitted(std::size_t k, const Demand& demand) const {
  Arrival window = arrivals_[k];
  window.from_ns = std::max(window.from_ns, demand.from_ns);
  window.to_ns = std::min(window.to_ns, demand.to_ns);
  for (std::size_t before = k; before-- > 0;) {
    if (!arrivals_[before].is_used) continue;
    window.from_ns = std::max(window.from_ns, arrivals_[before].from_ns);
    break;
  }
  for (std::size_t after = k + 1; after < arrivals_.size(); ++after) {
    if (!arrivals_[after].is_used) continue;
    window.to_ns = std::min(window.to_ns, arrivals_[after].to_ns);
    break;
  }
  return window;
}

std::optional<std::size_t> Requests::serve(const Demand& demand) {
  std::optional<std::size_t> chosen;  // the first used one that fits, or the first unused one
  const std::vector<std::size_t>& asking = asking_[demand.descriptor];
  std::size_t& served = served_[demand.descriptor];
  std::size_t next = served;
  for (std::size_t at = served; at < asking.size(); ++at) {
    const std::size_t k = asking[at];
    if (chosen && !arrivals_[k].is_used) continue;
    const Arrival window = fitted(k, demand);
    if (window.from_ns > window.to_ns) continue;
    chosen = k;
    next = at + 1;
    if (arrivals_[k].is_used) break;
  }
  if (!chosen) return chosen;
  served = next;
  arrivals_[*chosen] = fitted(*chosen, demand);
  arrivals_[*chosen].is_used = true;
  // Used ones keep their order: windows shrink on both sides.
  for (std::size_t k = *chosen + 1; k < arrivals_.size(); ++k) {
    if (arrivals_[k].is_used) {
      arrivals_[k].from_ns = std::max(arrivals_[k].from_ns, arrivals_[*chosen].from_ns);
    }
  }
  for (std::size_t k = *chosen; k-- > 0;) {
    if (arrivals_[k].is_used) {
      arrivals_[k].to_ns = std::min(arrivals_[k].to_ns, arrivals_[*chosen].to_ns);
    }
  }
  return chosen;
}

}  // namespace stormproof::conform
