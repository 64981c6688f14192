// `stormproof doctor`: one page about captures of a system whose participants do not find each
// other. Who is there, is discovery complete, is it a storm, why, and what to change.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/engines/exact/storm.hpp"
#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/capture/unknown_types.hpp"
#include "checker/evidence/doctor/reasons/one_machine.hpp"
#include "checker/evidence/doctor/reasons/reason.hpp"
#include "checker/evidence/doctor/symptoms.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "model/config/tree/result.hpp"
#include "model/limits.hpp"
#include "model/wireless_profile.hpp"

namespace stormproof::doctor {

struct Request {
  std::vector<std::string> files;
  std::int64_t until_ns = INT64_MAX;  ///< what was captured later is not looked at
  std::string dds;                    ///< profile to predict with; empty: the one that fits best
  std::string wireless;               ///< the same of the channel
  bool advise = true;                 ///< predict what changes would do
  std::size_t budget = 100;           ///< runs of the model that look for changes
  std::size_t threads = 0;            ///< 0: one for each core
  model::Limits limits{};             ///< what a storm is: `needless` and `late` count
  /// Called now and then; false interrupts.
  std::function<bool(std::string_view doing)> on_progress;
};

enum class Health : std::uint8_t {
  healthy,
  storm,       ///< `exact::is_storm`, and nobody lacks a descriptor
  incomplete,  ///< somebody lacks a descriptor, or is not discovered at all
  unmatched,   ///< everybody was told everything, and endpoints of some topic do not match
  unknown
};
[[nodiscard]] const char* name_of(Health health);

/// Participants of one library and version.
struct Product {
  std::string vendor;
  std::string version;  ///< as far as the wire shows it; may be empty
  std::size_t participants = 0;
};

/// How much of what each host sent is in one capture: who heard whom.
struct Heard {
  struct From {
    std::size_t host = 0;
    std::uint64_t datagrams = 0;  ///< of this host, in this capture
    std::uint64_t sent = 0;       ///< of this host, in all captures
  };
  std::string capture;
  std::vector<From> hosts;
};

/// One figure before and after a change: medians of the model's runs.
struct Predicted {
  std::optional<double> completion_ns;  ///< absent: most runs do not complete
  std::optional<double> messages;
};

struct Advice {
  std::string settings;  ///< in one line, in the vendor's words
  Predicted before, after;
  std::string xml;                         ///< to deploy
  std::vector<std::string> prerequisites;  ///< what the machine must allow
};

/// What the predictions come from.
struct Basis {
  std::string dds, wireless;
  /// Of the unchanged model to the capture: the time until the last initial DATA, and the messages
  /// until the end.
  double completion_ratio = 0;
  double message_ratio = 0;
};

struct Report {
  const capture::Conversation& conversation;
  capture::Counting counting{};
  Health health = Health::unknown;
  exact::Expense took{};   ///< until everybody had everything
  model::Limits limits{};  ///< what a storm was held against
  bool storm = false;      ///< `exact::is_storm`, whether it is complete or not
  bool amplified = false;  ///< `exact::is_amplified`: settings would help
  /// Questions about types, answers and what they are acknowledged with are more than all else.
  bool lookups_prevail = false;
  capture::UnknownTypes types{};
  std::vector<OneMachine> machines{};  ///< identities that several hosts have
  std::vector<Reason> reasons{};       ///< why they do not see each other, as they were decided
  std::string why_unknown{};
  std::vector<Product> products{};     ///< that of the most participants first
  std::vector<std::string> presets{};  ///< that explain every message; may be empty
  bool looked_for_presets = false;
  model::Counts failure_free{};
  /// Announcements after discovery was complete: they go on forever, and are no part of it.
  std::uint64_t later_announcements = 0;
  /// Keys that the capture does not show and whose reader acknowledged them: it began too late.
  std::uint64_t known_before = 0;
  std::uint64_t missing = 0;     ///< of the others
  std::size_t there_before = 0;  ///< participants that had begun when the capture did
  bool has_server = false;       ///< participants discover through a Discovery Server
  std::optional<std::int64_t> completion_ns{};  ///< since the first announcement
  /// When everybody had everything, since then, if that is late although all was told in time.
  std::optional<std::int64_t> known_late_ns{};
  std::vector<Cause> causes{};
  std::vector<Heard> heard{};  ///< only of several captures
  std::optional<Basis> basis{};
  std::vector<Advice> advice{};  ///< the best first, at most three
  std::string no_advice{};       ///< why there is none; empty if there is
  /// That nobody looks up types, if lookups prevail; figures only if the model predicts the
  /// capture.
  std::optional<Advice> without_lookups{};
  bool interrupted = false;

  /// The first that keeps participants apart and is more likely than not; null if there is none.
  [[nodiscard]] const Reason* what_keeps_apart() const;
  [[nodiscard]] bool complete() const { return missing == 0 && counting.required > 0; }
  /// A storm that would be none without them.
  [[nodiscard]] bool lookup_storm() const { return storm && lookups_prevail; }
  /// What is held against the failure-free count.
  [[nodiscard]] std::uint64_t messages() const {
    return counting.counts.total() - later_announcements;
  }
};

/// What the capture alone says: no preset, no advice. Without a channel messages stand for airtime.
[[nodiscard]] Report examine(const capture::Conversation& conversation,
                             std::int64_t until_ns = INT64_MAX,
                             const model::WirelessProfile* channel = nullptr,
                             const model::Limits& limits = {});

/// All of it. An error if the request names an unknown profile.
[[nodiscard]] model::config::Result<Report> diagnose(const capture::Conversation& conversation,
                                                     const Request& request);

[[nodiscard]] report::Document document_of(const Report& report, const Request& request);
/// What `watch` shows at the instant `now_ns` (as the capture counts time): the answer, who is
/// there, and the messages of the second before, of the capture, and of a failure-free discovery.
[[nodiscard]] report::Document glance_at(const Report& report, std::int64_t now_ns);
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::doctor
