// What a discovery storm is: the one definition that every verb asks which uses the word, be it
// about a simulated run, many of them, or a capture. Two things make one, both together:
//
// * Needless repeats and the control traffic that they cause take more airtime than everything sent
//   once by the same writer. A repeat is needless if nobody lacked what it brought. HEARTBEATs and
//   ACKNACKs beyond those that everything takes once are shared out among first sendings and
//   repeats; a share of them goes with the needless ones. Lookups of types are needless as a whole:
//   discovery needs none if types are not propagated. Traffic of control-only relations is among
//   everything sent once. Without needless traffic there is no storm, however busy a channel is.
// * Discovery is not complete, or late: it takes longer from the last start (or failure) on than
//   people wait for.
//
// Both numbers are limits of a scenario (limits.needless, limits.late). Where airtime is not known
// messages stand for it. What is less is no storm; from twice the messages of a discovery without
// failures on it is amplified: nobody has to act, and settings would help.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "model/counts.hpp"
#include "model/limits.hpp"
#include "model/run_result.hpp"
#include "model/units.hpp"

namespace stormproof::exact {

/// Messages over those of a discovery without failures from which on it is amplified.
inline constexpr double amplified_factor = 2;

/// Needless traffic over everything sent once that a storm has more of.
[[nodiscard]] double needless_limit(const std::optional<model::Limits>& limits);
/// Discovery that takes longer, counted from the last start, is late.
[[nodiscard]] model::Nanoseconds late_limit(const std::optional<model::Limits>& limits);

/// One kind of traffic: what was sent, in the unit of all of them, and which part of it discovery
/// takes if everything is sent once.
struct Traffic {
  double sent = 0;
  double once = 1;  ///< 0 … 1
};
/// The part of `sent` messages that `needed` ones are.
[[nodiscard]] double part_of(double needed, double sent);

/// What was sent until discovery was complete: airtime, or messages where it is not known.
struct Sent {
  double initial_data = 0;
  double repair_data = 0;
  double needed_repairs = 1;  ///< 0 … 1: the part of the repairs that brought what was lacking
  Traffic heartbeats, acknacks, announcements;
  double lookups = 0;       ///< of types, and their control
  double user_control = 0;  ///< of control-only relations
};

/// By class of traffic: airtime, or messages.
using PerClass = std::array<double, model::traffic_class_count>;
/// What `amount` says, in the unit of which it is, of the same traffic in `messages`, if a
/// discovery without failures takes `failure_free`.
[[nodiscard]] Sent sent_of(const PerClass& amount, const PerClass& messages,
                           const model::Counts& failure_free, double needed_repairs);

/// What a discovery took.
struct Expense {
  double once = 0;      ///< everything sent once
  double needless = 0;  ///< repeats that nobody lacked, and the control traffic that they cause
  bool is_late = false;

  /// Needless traffic over everything sent once.
  [[nodiscard]] double ratio() const { return once > 0 ? needless / once : 0; }
};
[[nodiscard]] Expense expense_of(const Sent& sent, bool is_late);

[[nodiscard]] bool is_storm(const Expense& took, const std::optional<model::Limits>& limits);
/// `messages` over those of a discovery without failures.
[[nodiscard]] constexpr bool is_amplified(double messages) { return messages > amplified_factor; }

/// The definition with its two numbers, for people: what stands in every answer that says STORM.
[[nodiscard]] std::string storm_definition(const std::optional<model::Limits>& limits);

}  // namespace stormproof::exact
