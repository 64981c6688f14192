// The captured discovery as figures, cut where it counts as complete.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/validate/captured_deployment.hpp"
#include "checker/evidence/validate/figures.hpp"

namespace stormproof::validate {

/// What ends the discovery that is compared, on both sides.
enum class Cut : std::uint8_t {
  /// The instant that the caller gives, when the applications had discovered everything; in the
  /// model, the reception of the last missing descriptor (T_disc).
  given,
  /// When the last required DATA was sent for the first time; in the model, too.
  last_initial
};

struct Observation {
  Cut cut = Cut::last_initial;
  std::int64_t cut_ns = 0;  ///< ns since 1970, inclusive
  bool complete = false;    ///< every required descriptor was sent by then
  capture::Counting counting{};
  CapturedDeployment deployment{};
  /// Absent: the capture cannot show it (`user_control` in one that holds no such traffic).
  std::array<std::optional<double>, figure_count> values{};
  Growth growth{};  ///< from the first announcement to the cut

  [[nodiscard]] std::int64_t completion_ns() const { return cut_ns - deployment.zero_ns; }
};

/// Steps of `growth`, from the first announcement to the cut.
inline constexpr std::size_t observed_steps = 120;

/// `until_ns`: the given cut; without it, the last initial DATA, or the last packet if descriptors
/// are missing. Errors are those of `captured_deployment`, and a cut before the first announcement.
[[nodiscard]] model::config::Result<Observation> observe(const capture::Conversation& conversation,
                                                         std::optional<std::int64_t> until_ns,
                                                         const RunRecord& record = {});

}  // namespace stormproof::validate
