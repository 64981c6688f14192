// When a check passes. Three questions are kept apart: does it hold in this deployment as described
// (exact runs, network calculus), does it hold for every deployment with this profile up to stated
// delays and losses (timelines, explorer), and are the rules themselves sound (tables). What the
// rules are known not to promise, a weakness, fails only where it happens in this deployment;
// elsewhere it is possible. So is what a library does in every deployment: it is none of this
// one's.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/verification/check/check.hpp"

namespace stormproof::checker {

/// What a property means for the exit code.
enum class Standing : std::uint8_t {
  holds,
  possible,  ///< not promised by the rules: a run could break it, though those of this deployment
             ///< do not
  accepted,  ///< it fails, and the baseline says so
  unknown,   ///< not promised by the rules, and nobody has looked at it
  open,      ///< promised, and not established to the kind that is required
  fails,
  disputed  ///< there are answers that contradict each other: nothing counts until that is cleared
};
/// In the order in which reports show them.
inline constexpr std::array standings{Standing::disputed, Standing::fails,    Standing::accepted,
                                      Standing::open,     Standing::possible, Standing::unknown,
                                      Standing::holds};
/// "holds", "possible", "accepted", "unknown", "open", "fails", "disputed".
[[nodiscard]] const char* name_of(Standing standing);

/// Which question a finding answers.
[[nodiscard]] props::Reach reach_of(const props::Property& property, const props::Finding& finding);

/// The finding that decides one of the questions; null if no engine answers it. Of the profile a
/// run of it that breaks the property knows more than what was explored or proved up to some delay.
[[nodiscard]] const props::Finding* answer_to(props::Reach reach, const PropertyResult& result);

/// What stands for a storm among the things that can fail.
inline constexpr std::string_view storm_id = "deployment.storm";
/// And what for a discovery that does not complete, whatever a check was asked for.
inline constexpr std::string_view incomplete_id = "limit.time";

/// One thing that fails, as a baseline names it.
struct Failure {
  std::string property;  ///< id, or `storm_id`
  props::Reach reach{};

  bool operator==(const Failure&) const = default;
};

struct GateRules {
  props::VerdictKind require = props::VerdictKind::observed;  ///< the weakest kind that is accepted
  bool strict = false;                                        ///< weaknesses fail everywhere
  std::vector<Failure> baseline = {};                         ///< accepted for this scenario
};

struct Gate {
  GateRules rules;
  std::vector<Standing> standings;     ///< of the report's results, in their order
  Standing outlook = Standing::holds;  ///< of what the runs are like, beside the properties
  std::string_view outlook_id = {};    ///< `storm_id` or `incomplete_id`, where that does not hold
  std::vector<Failure> failures;       ///< accepted or not
  std::vector<Failure> outdated;       ///< accepted, and not failing any more
  int exit_code = 0;  ///< 0 passes, 1 something fails, 3 something is disputed, or open

  [[nodiscard]] std::size_t count(Standing standing) const;
};

[[nodiscard]] Gate judge(const CheckReport& report, const model::DdsProfile& dds, GateRules rules);

}  // namespace stormproof::checker
