// How much of the composition (fsm/composition) a capture exercises: which effects of which rules
// sent what it shows, which never did, and of these the ones that cannot happen under the profile.
// A capture shows packets, so only effects that send some can be seen; which these are follows from
// the composition. The others are named, and counted nowhere.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "checker/engines/tables/impossible_effects.hpp"
#include "checker/evidence/conform/conform.hpp"
#include "fsm/composition/composition_info.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::conform {

/// An effect that sends what a capture shows.
struct EffectCoverage {
  const fsm::composition::EffectInfo* effect = nullptr;
  std::vector<std::string_view> packets{};  ///< that it can send, itself or by a step
  std::uint64_t times = 0;                  ///< events that it sent
  std::string ruled_out_by{};  ///< "spdp.resend: all_known"; empty: no knob is known to
};

/// A rule or procedure with such effects.
struct RuleCoverage {
  std::string_view rule;
  std::vector<EffectCoverage> effects{};

  [[nodiscard]] std::uint64_t seen() const;
  /// Those that are seen or not ruled out.
  [[nodiscard]] std::uint64_t possible() const;
};

struct CompositionCoverage {
  std::string_view composition;
  std::vector<RuleCoverage> rules{};                   ///< in the order of the composition's page
  std::vector<std::string_view> unobservable_rules{};  ///< those without such an effect
  std::vector<std::string_view> unobservable{};        ///< all other effects of rules, by id
  /// Explained events that no effect is known for: what sent them was on the sender's own host.
  std::uint64_t unattributed = 0;

  [[nodiscard]] std::uint64_t seen() const;
  [[nodiscard]] std::uint64_t possible() const;
  /// How many effects a capture can show under some profile.
  [[nodiscard]] std::uint64_t observable() const;
  [[nodiscard]] std::uint64_t rules_seen() const;
  [[nodiscard]] std::uint64_t rules_possible() const;
};

/// The packets of SPDP and SEDP that the effect can send, itself or by a step that it begins;
/// empty: a capture does not show it.
[[nodiscard]] std::vector<std::string_view> packets_sent_by(
    const fsm::composition::CompositionInfo& composition,
    const fsm::composition::EffectInfo& effect);

/// `impossible`: what the profile rules out. An event whose sender can be several of the effects
/// that are left counts for none of them.
[[nodiscard]] CompositionCoverage effect_coverage(
    const Conformance& result, const model::DdsProfile& dds,
    const std::vector<tables::ImpossibleEffects>& impossible);

}  // namespace stormproof::conform
