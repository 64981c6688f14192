// Which knobs of a DDS profile no rule reads, given the profile's other choices. Two profiles whose
// other knobs are equal have equal runs; this list is what a claim of that kind rests on, so each
// rule is a datum of its own that a test can take away, negate or confront with random runs.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "model/dds_profile.hpp"

namespace stormproof::diff {

/// A reason why the value of one knob makes no difference.
struct UnreadRule {
  std::string_view key;  ///< "sedp.adaptive.min_period"
  /// Whether it holds for a profile. Only the choices that the sentence names are looked at.
  bool (*applies)(const model::DdsProfile&);
  /// Gives the knob the value that it has in `from`; a rule about values that mean the same chooses
  /// one of them.
  void (*set)(model::DdsProfile& profile, const model::DdsProfile& from);
  std::string_view why;  ///< one sentence; empty: it is built into the implementation
};

/// The sentence about a profile for which the rule holds.
[[nodiscard]] std::string why_unread(const UnreadRule& rule, const model::DdsProfile& profile);

/// In the order of the table. A knob may have several rules.
[[nodiscard]] std::span<const UnreadRule> unread_rules();

/// The first rule for `key` that applies to the profile, or null: the knob is read.
[[nodiscard]] const UnreadRule* unread_rule(const model::DdsProfile& profile, std::string_view key);

/// The fractions of the profile in lowest terms: the same values.
[[nodiscard]] model::DdsProfile with_reduced_fractions(model::DdsProfile profile);

}  // namespace stormproof::diff
