// The names, and one sentence for each fault.
#include "checker/evidence/conform/report/names.hpp"

#include <fmt/format.h>

#include "checker/presentation/text/plain_text.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::conform {

namespace {

std::string duration_text(std::int64_t ns) {
  return ns == 0 ? "0" : model::config::print_duration(model::Nanoseconds{ns});
}

/// "96.521ms": exact, as options take it.
std::string decimal_milliseconds(std::int64_t ns) {
  std::string text = milliseconds(ns);
  text.resize(text.find(' '));
  text.resize(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + "ms";
}

/// "1–9", "3"; "nothing" if the range is empty.
std::string range_text(std::int64_t first, std::int64_t last) {
  if (last < first) return "nothing";
  return first == last ? fmt::format("{}", first) : fmt::format("{}–{}", first, last);
}

std::string acknack_text(const capture::AcknackEvent& acknack, std::string_view stream) {
  if (acknack.is_initial()) return fmt::format("initial ACKNACK {} for {}", acknack.count, stream);
  std::string text = fmt::format("ACKNACK {} for {}: has {}", acknack.count, stream,
                                 range_text(1, acknack.missing.base - 1));
  if (acknack.missing.size() > 0) text += ", asks for " + numbers_text(acknack.missing);
  return text;
}

std::string data_text(const capture::DataEvent& data, std::string_view stream) {
  std::string text = fmt::format("DATA {} of {}", data.sequence_number, stream);
  if (data.fragment != 0) text += fmt::format(", fragment {}", data.fragment);
  if (data.is_gone) text += ", disposed of";
  return text;
}

}  // namespace

std::string_view rule_broken_by(Fault fault) {
  switch (fault) {
    case Fault::not_announced:
      return "nobody sends to a participant before its first announcement can have arrived";
    case Fault::not_opened:
      return "a writer sends to a reader only after it has opened the relation with a HEARTBEAT";
    case Fault::announcement_extra:
      return "an announcement is scheduled, or caused by the recognition of a participant";
    case Fault::announcement_due:
      return "the announcement timer acts at its time, at most the lateness after it";
    case Fault::heartbeat_cause:
      return "a HEARTBEAT opens a relation, answers an initial ACKNACK, rides on DATA, or is "
             "periodic";
    case Fault::heartbeat_range:
      return "a HEARTBEAT announces from 1 on, and never less than what was sent before";
    case Fault::heartbeat_copies:
      return "a HEARTBEAT that is not for one reader goes to all to which the writer has opened";
    case Fault::heartbeat_due:
      return "a writer's timer acts at its time, at most the lateness after it";
    case Fault::heartbeat_count:
      return "the counts of a writer's HEARTBEATs grow, by what somebody else can have got at most";
    case Fault::data_cause:
      return "DATA is pushed when its endpoint is created, or asked for by an ACKNACK";
    case Fault::data_order:
      return "descriptors are created in the order of their numbers, and each is pushed then";
    case Fault::data_early:
      return "DATA that was asked for waits τ_N, and τ_S after the previous copy";
    case Fault::data_acknowledged:
      return "DATA is not sent after its acknowledgment has arrived";
    case Fault::gap_cause:
      return "a GAP names what an ACKNACK asks for and its reader need not have, or what comes "
             "before a DATA";
    case Fault::acknack_cause:
      return "an ACKNACK answers a HEARTBEAT that can have arrived";
    case Fault::acknack_early:
      return "an ACKNACK waits τ_A after the HEARTBEAT, and so after the previous ACKNACK";
    case Fault::acknack_count:
      return "the counts of a reader's ACKNACKs grow, by what somebody else can have got at most";
    case Fault::acknack_content:
      return "an ACKNACK has what can have arrived, and asks for the rest of what was announced";
    case Fault::initial_early:
      return "an initial ACKNACK waits τ_I, from the second one on doubled or constant";
    case Fault::initial_late:
      return "an initial ACKNACK comes at its time, at most the lateness after it";
    case Fault::initial_after_heartbeat:
      return "a reader that has seen a HEARTBEAT sends no initial ACKNACK";
    case Fault::unanswered:
      return "what was received is answered in time; without losses everything is received";
    case Fault::other_version:
      return "announcements are those of a version that the profile speaks of (dds.sizes)";
    case Fault::lookup_cause:
      return "who lacks a type asks once for each stream whom it was told of it by, and is "
             "answered";
    case Fault::number_beyond:
      return "descriptors are numbered from 1 on, as many as the writer has endpoints";
    case Fault::no_such_rule:
      return "the profile's implementation sends no such submessage";
  }
  return "";
}

std::string bounds_text(const Bounds& bounds) {
  return fmt::format(
      "delay {} to {}, send lag up to {}, timers up to {} late, clock up to {} old, same host done "
      "within "
      "{}, {}, {}",
      duration_text(bounds.least_delay_ns), duration_text(bounds.most_delay_ns),
      duration_text(bounds.most_send_lag_ns), duration_text(bounds.most_lateness_ns),
      duration_text(bounds.most_clock_age_ns), duration_text(bounds.most_same_host_ns),
      bounds.clock_error_ns == 0
          ? std::string{"clocks equal"}
          : "clocks up to " + duration_text(bounds.clock_error_ns) + " apart",
      bounds.may_lose ? "losses allowed" : "no losses");
}

std::string milliseconds(std::int64_t ns) {
  const std::uint64_t size =
      ns < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(ns) : static_cast<std::uint64_t>(ns);
  return fmt::format("{}{}.{:06} ms", ns < 0 ? "-" : "", size / 1'000'000, size % 1'000'000);
}

std::string_view writer_name(capture::EntityId writer) {
  switch (writer) {
    case capture::entity::spdp_writer:
      return "announcements";
    case capture::entity::publications_writer:
      return "publications";
    case capture::entity::subscriptions_writer:
      return "subscriptions";
    default:
      return "another writer";
  }
}

std::string numbers_text(const std::vector<std::int64_t>& numbers) {
  constexpr int most_runs = 8;
  std::string text;
  int runs = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (runs++ == most_runs) return text + ", …";
    const std::int64_t first = numbers[k];
    while (k + 1 < numbers.size() && numbers[k + 1] == numbers[k] + 1) ++k;
    text += (text.empty() ? "" : ", ") + range_text(first, numbers[k]);
  }
  return text.empty() ? "nothing" : text;
}

std::string numbers_text(const capture::SequenceNumberSet& set) {
  std::vector<std::int64_t> members;
  for (std::uint32_t k = 0; k < set.num_bits; ++k) {
    if (set.has(k)) members.push_back(set.base + k);
  }
  return numbers_text(members);
}

std::string event_text(const capture::Event& event) {
  const std::string_view stream = writer_name(event.writer);
  if (const auto* data = event.data()) {
    const bool is_passed_on = data->participant && *data->participant != event.source;
    if (event.traffic() != capture::Traffic::spdp || is_passed_on) return data_text(*data, stream);
    return data->is_gone ? "SPDP, leaves" : "SPDP announcement";
  }
  if (const auto* heartbeat = event.heartbeat()) {
    return fmt::format("HEARTBEAT {} of {}: {}", heartbeat->count, stream,
                       range_text(heartbeat->first, heartbeat->last));
  }
  if (const auto* acknack = event.acknack()) return acknack_text(*acknack, stream);
  const capture::GapEvent* gap = event.gap();
  return fmt::format("GAP of {} from {}", stream, gap == nullptr ? 0 : gap->start);
}

std::string need_text(const Need& need) {
  std::string text = need.what;
  if (need.needed_ns) text += " " + decimal_milliseconds(*need.needed_ns);
  if (need.bound_ns) text += " (bound " + decimal_milliseconds(*need.bound_ns) + ")";
  return text;
}

std::optional<std::size_t> Names::number(const capture::GuidPrefix& prefix) const {
  const capture::Participant* found = conversation_.topology.find(prefix);
  if (found == nullptr) return std::nullopt;
  return conversation_.topology.index_of(*found);
}

std::string Names::short_name(const capture::GuidPrefix& prefix) const {
  const auto index = number(prefix);
  return index ? std::to_string(*index) : to_string(prefix);
}

std::string Names::participant(std::size_t index) const {
  const capture::Participant& one = conversation_.topology.participants.at(index);
  const std::string name = report::one_line(one.name);
  return fmt::format("participant {}{} (host {}, {})", index,
                     name.empty() ? "" : fmt::format(" “{}”", name), one.host,
                     to_string(one.prefix));
}

std::string Names::source(const capture::Event& event) const {
  const auto index = number(event.source);
  return index ? participant(*index) : to_string(event.source);
}

std::string Names::destination(const capture::Event& event) const {
  if (!event.destination) {
    return event.is_multicast ? "everybody (multicast)" : "an address that nobody announced";
  }
  const auto index = number(*event.destination);
  return index ? participant(*index) : to_string(*event.destination);
}

std::string Names::place(const Place& place) const {
  if (!place.destination) {
    return fmt::format("{} of participant {}", writer_name(place.writer), place.source);
  }
  return fmt::format("relation {} → {} ({})", place.source, *place.destination,
                     writer_name(place.writer));
}

std::string Names::packet(const capture::Event& event) const {
  return fmt::format("packet {} of {}", datagram(event).packet,
                     report::one_line(capture_name(event)));
}

std::string Names::packet_number(const capture::Event& event) const {
  const capture::DatagramRecord& one = datagram(event);
  return conversation_.captures.size() > 1 ? fmt::format("{}:{}", one.capture + 1, one.packet)
                                           : std::to_string(one.packet);
}

std::string Names::elapsed(std::int64_t time_ns) const {
  return milliseconds(time_ns - conversation_.first_ns);
}

std::string Names::tshark(const capture::Event& event) const {
  const std::string file = report::shell_word(capture_name(event));
  const std::string filter = fmt::format("-Y 'frame.number == {}' -O rtps", datagram(event).packet);
  return capture_name(event).ends_with(".xz")
             ? fmt::format("xz -dc {} | tshark -r - {}", file, filter)
             : fmt::format("tshark -r {} {}", file, filter);
}

}  // namespace stormproof::conform
