// Settings of one file that contradict each other or do nothing beside each other, and limits that
// users run into.
#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "model/config/vendor/cyclonedds_settings.hpp"

namespace stormproof::model::config::vendor {
namespace {

class Contradictions {
 public:
  Contradictions(const CycloneSettings& settings, VendorProfile& profile)
      : settings_{settings}, profile_{profile} {}

  void find() {
    compare("Internal/HeartbeatInterval", "Internal/HeartbeatInterval[@max]",
            "the interval is longer than its maximum");
    compare("Internal/NackDelay", "Internal/AutoReschedNackDelay",
            "a reader asks again by itself before NackDelay is over");
    compare("General/MaxRexmitMessageSize", "General/MaxMessageSize",
            "repairs may be larger than messages");
    for (const char* path : {"Internal/SocketReceiveBufferSize", "Internal/SocketSendBufferSize"}) {
      compare(fmt::format("{}[@min]", path), fmt::format("{}[@max]", path),
              "a maximum below the minimum is ignored");
    }
    compare("Internal/Watermarks/WhcLow", "Internal/Watermarks/WhcHigh",
            "the low watermark is above the high one");
    needs("Internal/RetransmitMergingPeriod", "Internal/RetransmitMerging", "never",
          "it acts with RetransmitMerging adaptive or always only");
    look_at_indices();
    look_at_fixed_index();
    look_at_receive_buffer();
  }

 private:
  static constexpr std::int64_t most_that_counts = 1'000'000;  ///< of max_participants_per_host

  void warn(std::string_view rule, const CycloneReading& reading, std::string message) {
    profile_.remarks.push_back({Severity::warning, fmt::format("cyclonedds.{}", rule),
                                reading.place, std::move(message), ""});
  }

  void look_at_indices() {
    constexpr std::string_view path = "Discovery/MaxAutoParticipantIndex";
    const CycloneReading* most = settings_.find(path);
    const CycloneReading* index = settings_.find("Discovery/ParticipantIndex");
    if (settings_.participant_index() != "auto") {
      if (most == nullptr) return;
      return warn("no-effect", *most,
                  "MaxAutoParticipantIndex has no effect: ParticipantIndex is not auto");
    }
    const CycloneReading* cause = most != nullptr ? most : index;
    if (cause == nullptr) cause = settings_.silencer();
    if (cause == nullptr && settings_.peers.empty()) return;
    if (cause == nullptr) return set_limit(settings_.peers.front().place);
    if (settings_.value(path).number == 0) {
      profile_.remarks.push_back({Severity::error, "cyclonedds.participant-limit", cause->place,
                                  "MaxAutoParticipantIndex 0: no process starts",
                                  "at least the number of processes on a host"});
      return;
    }
    limit(*cause,
          "MaxAutoParticipantIndex raises it, and with it the ports that peers are asked at");
  }

  /// A number is the index of one process, whose ports the next one finds taken.
  void look_at_fixed_index() {
    const CycloneReading* index = settings_.find("Discovery/ParticipantIndex");
    if (index == nullptr || !settings_.participant_index().empty()) return;
    limit(*index, "with ParticipantIndex auto each finds a free one");
  }

  void limit(const CycloneReading& cause, std::string hint) {
    const auto most = settings_.participants_of_a_host();
    if (!most) return;
    set_limit(cause.place);
    profile_.remarks.push_back(
        {Severity::note, "cyclonedds.participant-limit", cause.place,
         fmt::format("a host can have {} process{} in this domain; the next one does not start",
                     *most, *most == 1 ? "" : "es"),
         std::move(hint)});
  }
  void set_limit(const Place& place) {
    const auto most = settings_.participants_of_a_host();
    if (!most) return;
    (void)set_path(profile_.changes, "max_participants_per_host",
                   Node::scalar(place, fmt::format("{}", std::min(*most, most_that_counts))));
  }

  /// The library does not start without a minimum that somebody set.
  void look_at_receive_buffer() {
    constexpr std::int64_t usual_rmem_max = 212'992;  // net.core.rmem_max of Linux
    const CycloneReading* least = settings_.find("Internal/SocketReceiveBufferSize[@min]");
    if (least == nullptr || least->value.number <= usual_rmem_max) return;
    profile_.remarks.push_back(
        {Severity::warning, "cyclonedds.kernel-buffer", least->place,
         fmt::format("Cyclone DDS does not start where Linux grants less than {} bytes; it grants "
                     "{} unless net.core.rmem_max is raised",
                     least->value.number, usual_rmem_max),
         fmt::format("sysctl -w net.core.rmem_max={}", least->value.number)});
  }

  /// A remark if `low` is above `high`, which one of the two settings in the file causes.
  void compare(std::string_view low, std::string_view high, std::string_view what) {
    const CycloneReading* cause = settings_.find(low);
    if (cause == nullptr) cause = settings_.find(high);
    if (cause == nullptr) return;
    const CycloneValue below = settings_.value(low), above = settings_.value(high);
    const bool is_fine = above.word == "inf" || above.word == "default" || below.word == "default";
    if (is_fine || (below.word != "inf" && below.number <= above.number)) return;
    warn("contradiction", *cause,
         fmt::format("{} {} and {} {}: {}", low, settings_.shown(low), high, settings_.shown(high),
                     what));
  }

  void needs(std::string_view path, std::string_view other, std::string_view idle,
             std::string_view what) {
    const CycloneReading* reading = settings_.find(path);
    if (reading == nullptr || settings_.value(other).word != idle) return;
    warn("no-effect", *reading, fmt::format("{} has no effect: {}", path, what));
  }

  const CycloneSettings& settings_;
  VendorProfile& profile_;
};

}  // namespace

void look_for_contradictions(const CycloneSettings& settings, VendorProfile& profile) {
  Contradictions{settings, profile}.find();
}

}  // namespace stormproof::model::config::vendor
