// How much a capture tells about the knobs of its profile: it is held against the profile with one
// knob changed, for each of a list of changes, and may notice that. A capture that conforms to a
// profile and to the same with another knob says nothing about that knob.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/evidence/conform/conform.hpp"

namespace stormproof::conform {

/// One knob is different.
struct Change {
  std::string name{};  ///< "τ_N × 10"
  std::string set{};   ///< as an override: "sedp.nack_response_delay=1ms"
  model::DdsProfile dds{};
  std::vector<Rule> rules{};  ///< in which the knob acts
};

/// The changes of a profile: timers, both alternatives of a choice, another threshold.
[[nodiscard]] std::vector<Change> changes_of(const model::DdsProfile& dds);

/// The mistakes that are no knob of any implementation that captures can be held against: the name,
/// and why no capture can tell.
struct NoKnob {
  std::string_view change;
  std::string_view why;
};
[[nodiscard]] const std::vector<NoKnob>& changes_without_knob();

/// What the capture says about a change.
enum class Notice : std::uint8_t {
  rejected,
  explained,     ///< the knob acts, and yet the changed profile explains everything
  inconclusive,  ///< the knob acts
  does_not_act   ///< no event of the capture is explained by a rule in which the knob acts
};
[[nodiscard]] std::string_view name_of(Notice notice);

struct Tried {
  std::string change{};
  std::string set{};
  Notice notice{};
  std::optional<Fault> fault{};  ///< `rejected`: of the first event
  std::size_t places = 0;        ///< `rejected`: with an event that nothing explains
};

/// One capture with its profile.
struct Sensitivity {
  std::string capture{};
  std::string profile{};
  Verdict verdict{};  ///< of the unchanged profile
  std::vector<Tried> tried{};
};

struct ChangesRequest {
  const capture::Conversation& conversation;
  std::string capture{};
  std::string profile{};
  model::DdsProfile dds{};
  Bounds bounds{};
  /// Called before each change; false stops, and what was not tried is left out.
  std::function<bool(const std::string& change)> progress{};
  std::function<bool()> interrupted{};
};

/// Errors as of `conform`.
[[nodiscard]] model::config::Result<Sensitivity> try_changes(const ChangesRequest& request);

/// Which profile the captures of a folder show: its file profiles.yaml, a map of names (without
/// endings) to profiles. Errors, with their place: no such file, or no entry for the capture.
[[nodiscard]] model::config::Result<std::string> profile_of_capture(const std::string& file);

}  // namespace stormproof::conform
