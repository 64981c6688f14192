// How reports name what a capture holds: participants, relations, submessages, packets, instants,
// bounds and faults. One name for one thing in all formats.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/conform/conform.hpp"

namespace stormproof::conform {

/// One sentence: which rule an event with this fault breaks.
[[nodiscard]] std::string_view rule_broken_by(Fault fault);

/// "delay 0 to 60s, send lag up to 20ms, …": one line.
[[nodiscard]] std::string bounds_text(const Bounds& bounds);

/// Exact, in milliseconds: "13.653072 ms".
[[nodiscard]] std::string milliseconds(std::int64_t ns);

/// "announcements", "publications", "subscriptions".
[[nodiscard]] std::string_view writer_name(capture::EntityId writer);

/// "3–5, 7": runs of ascending numbers, at most eight of them; "nothing".
[[nodiscard]] std::string numbers_text(const std::vector<std::int64_t>& numbers);
/// The same for the members of an ACKNACK's set.
[[nodiscard]] std::string numbers_text(const capture::SequenceNumberSet& set);

/// "ACKNACK 7 for publications: has 1–2, asks for 3–5", without source and destination.
[[nodiscard]] std::string event_text(const capture::Event& event);

/// "send lag 30ms (bound 20ms)"; exact, and as options take it.
[[nodiscard]] std::string need_text(const Need& need);

/// Names that depend on who takes part in the conversation.
class Names {
 public:
  explicit Names(const capture::Conversation& conversation) : conversation_{conversation} {}

  /// Index in Topology::participants; nothing if the prefix is not there.
  [[nodiscard]] std::optional<std::size_t> number(const capture::GuidPrefix& prefix) const;
  /// "2"; the prefix itself if it belongs to no participant.
  [[nodiscard]] std::string short_name(const capture::GuidPrefix& prefix) const;
  /// "participant 2 “camera” (host 0, 010f…)"
  [[nodiscard]] std::string participant(std::size_t index) const;
  /// The same for the end of an event: "everybody (multicast)", "an unknown participant".
  [[nodiscard]] std::string source(const capture::Event& event) const;
  [[nodiscard]] std::string destination(const capture::Event& event) const;
  /// "relation 2 → 5 (publications)", "announcements of participant 2".
  [[nodiscard]] std::string place(const Place& place) const;
  /// "packet 713 of a.pcap".
  [[nodiscard]] std::string packet(const capture::Event& event) const;
  /// "713"; "2:713", in the second capture, if there are several.
  [[nodiscard]] std::string packet_number(const capture::Event& event) const;
  /// "13.653072 ms": since the first packet of all captures.
  [[nodiscard]] std::string elapsed(std::int64_t time_ns) const;
  /// Shell command that shows the packet in full.
  [[nodiscard]] std::string tshark(const capture::Event& event) const;

  [[nodiscard]] const capture::Event& event(std::size_t index) const {
    return conversation_.events.at(index);
  }
  [[nodiscard]] const capture::DatagramRecord& datagram(const capture::Event& event) const {
    return conversation_.datagrams.at(event.datagram);
  }
  [[nodiscard]] const std::string& capture_name(const capture::Event& event) const {
    return conversation_.captures.at(datagram(event).capture).name;
  }

 private:
  const capture::Conversation& conversation_;
};

}  // namespace stormproof::conform
