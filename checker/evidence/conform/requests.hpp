// When the ACKNACKs of a relation can have arrived at the writer, so that every transmission that
// needs a request has one: a schedule of arrival windows, in order of sending.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "checker/evidence/conform/dialogue.hpp"

namespace stormproof::conform {

/// A transmission of a descriptor, by its place in the relation.
struct Transmission {
  std::uint32_t descriptor = 0;
  std::int64_t time_ns = 0;  ///< of its capture
  std::size_t event = 0;
  bool is_first = false;
  bool is_pushed = false;
};

/// The DATA of a relation, in order. What existed when the relation opened, its first HEARTBEAT
/// announces; the rest is pushed.
[[nodiscard]] std::vector<Transmission> transmissions_of(const Relation& relation);
/// How many descriptors that HEARTBEAT announces; 0 if the relation begins with something else.
[[nodiscard]] std::uint32_t existing_at_opening(const Relation& relation);

/// When an ACKNACK arrives at the writer.
struct Arrival {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
  bool is_used = false;  ///< some transmission needs it
};

/// What a transmission needs: an ACKNACK that asks for its descriptor and arrives in here.
struct Demand {
  std::size_t transmission = 0;
  std::uint32_t descriptor = 0;
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
};

class Requests {
 public:
  /// `send_lag_ns`: how long before its capture a transmission may have been serialized.
  Requests(const Relation& relation, const std::vector<Transmission>& transmissions,
           const Bounds& bounds, std::int64_t send_lag_ns);

  /// The ACKNACK (index of the answer) that serves this demand together with all earlier ones;
  /// nothing if none fits. An ACKNACK causes one transmission of what it asks for: the next one of
  /// the same descriptor needs a later ACKNACK.
  [[nodiscard]] std::optional<std::size_t> serve(const Demand& demand);
  [[nodiscard]] const std::vector<Arrival>& arrivals() const { return arrivals_; }

 private:
  [[nodiscard]] Arrival fitted(std::size_t k, const Demand& demand) const;

  const Relation& relation_;
  std::vector<Arrival> arrivals_;  ///< by answer
  /// By descriptor: the answers that ask for it, ascending.
  std::vector<std::vector<std::size_t>> asking_;
  std::vector<std::size_t> served_;  ///< by descriptor: how many of these are no longer to be had
};

}  // namespace stormproof::conform
