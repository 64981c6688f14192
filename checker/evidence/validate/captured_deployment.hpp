// The deployment that a capture shows, in the terms of the model: who takes part on which host, how
// many endpoints each participant has, when it announced itself first, and between what instants it
// had created all its endpoints. Participants that are not equal stay so.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/validate/run_record.hpp"
#include "model/config/tree/result.hpp"
#include "model/scenario.hpp"

namespace stormproof::validate {

struct CapturedParticipant {
  std::size_t number = 0;  ///< in the topology of the capture
  std::size_t host = 0;
  std::uint32_t publications = 0;   ///< that it described and did not dispose of, by the cut
  std::uint32_t subscriptions = 0;  ///< so are the endpoints that every node has
  model::Nanoseconds start;         ///< first announcement, since the first one of all
  bool announced = true;            ///< otherwise `start` is its first message of any kind
  /// Otherwise it is on the host of its Discovery Server, and not on the link: how many endpoints
  /// it has is what the server tells of, and its times are assumed or come from a record.
  bool is_seen = true;
  model::Nanoseconds created_earliest;  ///< its last endpoint, since the same instant
  model::Nanoseconds created_latest;
  /// By how much the creations that the capture shows differ from equal intervals between `start`
  /// and the last one, at most. The model's are at equal intervals.
  model::Nanoseconds unevenness;
  std::size_t creations_seen = 0;

  /// What `endpoints_done` is drawn from: the model's creations can be as far from the real ones as
  /// equal intervals are from those that were seen.
  [[nodiscard]] model::Nanoseconds done_earliest() const {
    return std::max(start, created_earliest - unevenness);
  }
  [[nodiscard]] model::Nanoseconds done_latest() const { return created_latest + unevenness; }
};

struct CapturedDeployment {
  std::int64_t zero_ns = 0;  ///< the first announcement, ns since 1970
  std::size_t hosts = 0;
  std::vector<CapturedParticipant> participants{};  ///< in the order of the topology
  /// That of the Discovery Server, which is host 0 in a scenario.
  std::optional<std::size_t> server_host{};
  /// If endpoints announce types that can be looked up: how many of each participant others lack.
  std::optional<std::uint32_t> unknown_types{};
};

/// What was there until `until_ns`. An error if nobody announces itself by then, or all are on one
/// host. Participants that are not seen have the times of the record; without one they start with
/// the first that is seen, and take as long as those to create their endpoints.
[[nodiscard]] model::config::Result<CapturedDeployment> captured_deployment(
    const capture::Conversation& conversation, std::int64_t until_ns, const RunRecord& record = {});

/// The participants of a scenario whose profile gives everybody `defaults`. Endpoints of the
/// capture beyond those are the user's; whoever has fewer than the defaults gets the defaults,
/// because the model has no smaller participant. `endpoints_done` is the middle of what the capture
/// proves.
[[nodiscard]] std::vector<model::Participant> model_participants(
    const CapturedDeployment& deployment, const model::DescriptorProfile& defaults);

}  // namespace stormproof::validate
