// Settings of one file that contradict each other or do nothing beside each other, and limits that
// users run into.
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
    look_at_receive_buffer();
  }

 private:
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
    if (cause == nullptr) return;  // nobody said anything of indices
    // The index after the one that was found is compared with the most, so the last is never taken
    // (q_init.c, ddsi_init.c).
    profile_.remarks.push_back(
        {Severity::note, "cyclonedds.participant-limit", cause->place,
         fmt::format("a host can have {} processes in this domain; the next one does not start",
                     settings_.value(path).number),
         "MaxAutoParticipantIndex raises it, and with it the ports that peers are asked at"});
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
