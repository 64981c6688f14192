// Digests of events, with times and numbers translated as the reading asks for.
#include "props/laws/run_log.hpp"

#include <algorithm>
#include <bit>
#include <functional>

#include <fmt/core.h>

#include "model/cyclone/endpoints.hpp"
#include "model/engine/submessage.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/fastdds/relayed.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::props {

using model::EventKind;
using model::Nanoseconds;

std::size_t RunLog::first_bitmap() const { return first_bitmap_.value_or(entries_.size()); }

void RunLog::run_started(const model::Topology& topology) {
  topology_ = &topology;
  stride_ = model::cyclone::writers_per_participant(topology);
}

void RunLog::event_started(const model::Event& event) {
  current_ = {Nanoseconds{event.time.count() * reading_.time_factor} + reading_.time_shift,
              event.kind, 0};
  drop_current_ = false;
  note(static_cast<std::uint64_t>(event.event_class()));
  note_subject(model::trace::subject_of(event.kind), event.subject);
  if (event.kind == EventKind::reception)
    note_participant(event.detail);
  else
    note(event.detail);
  if (reading_.insertions) note(event.insertion());
}

void RunLog::event_finished(const model::Depths& depths) {
  note(depths.missing);
  if (!drop_current_) entries_.push_back(current_);
}

void RunLog::transition(const model::Transition& fired) {
  note(fired.machine.machine);
  note_subject(model::trace::subject_of(fired.machine.kind), fired.machine.subject);
  note(fired.event);
  note(fired.before);
  note(fired.after);
  note(fired.first_word);
  note(fired.descriptors);
}

void RunLog::scheduled(std::uint64_t insertion, Nanoseconds time, EventKind kind,
                       std::uint32_t subject) {
  if (!reading_.schedule) return;
  note(static_cast<std::uint64_t>(kind));
  note_time(time);
  note_subject(model::trace::subject_of(kind), subject);
  if (reading_.insertions) note(insertion);
}

void RunLog::emitted(const model::Packet& packet, std::uint32_t source,
                     std::span<const std::uint32_t> destinations) {
  note_packet(packet);
  note(packet.copies);
  note_participant(source);
  for (const std::uint32_t destination : destinations) note_participant(destination);
  const bool has_bitmap = packet.kind == model::PacketKind::acknack && !packet.initial_acknack &&
                          !packet.descriptors.empty();
  if (has_bitmap && !first_bitmap_) first_bitmap_ = entries_.size() + 1;
}

void RunLog::service_started(std::uint32_t channel, std::uint32_t stage,
                             const model::Packet& packet, std::uint32_t fragment,
                             Nanoseconds until) {
  note(channel);
  note(stage);
  note(packet.number);
  note(fragment);
  note_time(until);
}

void RunLog::arrived(const model::Packet& packet, bool lost) {
  note(packet.number);
  note(lost ? 1 : 0);
  if (lost && !reading_.lost_arrivals) drop_current_ = true;
}

void RunLog::received(const model::Packet& packet, std::uint32_t receiver) {
  note_packet(packet);
  if (receiver != everybody) note_participant(receiver);
}

void RunLog::looped_back(const model::Packet& packet, std::uint32_t receiver) {
  note_packet(packet);
  note_participant(receiver);
}

void RunLog::note(std::uint64_t what) {
  current_.deeds = std::rotl((current_.deeds ^ what) * 0x9E3779B97F4A7C15U, 29);
}

void RunLog::note(std::string_view text) { note(std::hash<std::string_view>{}(text)); }

void RunLog::note_time(Nanoseconds time) {
  const std::int64_t read = time.count() * reading_.time_factor + reading_.time_shift.count();
  note(static_cast<std::uint64_t>(read));
}

void RunLog::note_participant(std::uint32_t i) {
  note(reading_.number.empty() ? i : reading_.number[i]);
}

void RunLog::note_pair(std::uint32_t pair) {
  note_participant(topology_->pair(pair).source);
  note_participant(topology_->pair(pair).destination);
}

void RunLog::note_subject(model::trace::Subject subject, std::uint32_t number) {
  using enum model::trace::Subject;
  switch (subject) {
    case participant:
      note_participant(number);
      break;
    case pair:
      note_pair(number);
      break;
    case writer:
      note_participant(number / 2);
      note(number % 2);
      break;
    case relation:
      note_pair(number / 2);
      note(number % 2);
      break;
    case control_writer:
      note_participant(number / model::fastdds::control_writers);
      note(number % model::fastdds::control_writers);
      break;
    case endpoint_writer:
      note_participant(number / stride_);
      note(number % stride_);
      break;
    case endpoint_relation:
      note_pair(number / stride_);
      note(number % stride_);
      break;
    case channel:
      note(number);
      break;
    case control_relation:  // numbered by pair; the packets tell which
    case access_point:
    case packet:  // places in memory
      break;
  }
}

void RunLog::note_packet(const model::Packet& packet) {
  note(packet.number);
  note(static_cast<std::uint64_t>(packet.kind));
  if (packet.multicast())
    note_participant(packet.pair);
  else
    note_pair(packet.pair);
  note(static_cast<std::uint64_t>(packet.stream));
  if (reading_.sizes) note(packet.payload_bytes);
  for (std::uint32_t k = 0; !packet.descriptors.empty() && k < packet.descriptors.end_word(); ++k) {
    note(packet.descriptors.word(k));
  }
  note(packet.heartbeats);
  note(packet.initial_acknack ? 1 : 0);
  note_numbers(packet);
  if (packet.relayed) note_relayed(*packet.relayed);
  if (packet.submessages == nullptr) return;
  for (const model::Submessage& each : *packet.submessages) note_submessage(each);
}

/// What it announces or claims, and what counts as repeated; control-only relations have numbers
/// that follow from the pair.
void RunLog::note_numbers(const model::Packet& packet) {
  using enum model::PacketKind;
  const bool claims = packet.kind == data || packet.kind == heartbeat || packet.kind == acknack;
  if (claims) note(packet.detail);
  note(packet.initial_data);
  note(packet.repair_data);
  note((packet.from_repair ? 2U : 0U) + (packet.carries_heartbeat ? 1U : 0U));
}

void RunLog::note_relayed(const model::Relayed& relayed) {
  note((relayed.is_goodbye ? 8U : 0U) + (relayed.has_data ? 4U : 0U) +
       (relayed.is_announcement ? 2U : 0U) + (relayed.has_heartbeat ? 1U : 0U));
  note_participant(relayed.participant);
  note(static_cast<std::uint64_t>(relayed.stream));
  note(relayed.descriptor);
  for (const std::int64_t number : {relayed.number, relayed.first, relayed.last, relayed.base}) {
    note(static_cast<std::uint64_t>(number));
  }
  for (const std::int64_t number : relayed.numbers) note(static_cast<std::uint64_t>(number));
}

void RunLog::note_submessage(const model::Submessage& submessage) {
  note(static_cast<std::uint64_t>(submessage.kind));
  note_participant(submessage.participant);
  note(submessage.writer);
  note(submessage.sample);
  note(static_cast<std::uint64_t>(submessage.count));
  note((submessage.directed ? 2U : 0U) + (submessage.initial ? 1U : 0U));
  submessage.bitmap.for_each([&](std::uint32_t d) { note(d); });
}

std::optional<std::string> first_difference(const RunLog& one, const RunLog& other,
                                            std::size_t events) {
  const std::size_t count = std::min(events, one.entries().size());
  if (other.entries().size() < count) {
    return fmt::format("The runs differ: one has {} events, the other {}.", count,
                       other.entries().size());
  }
  if (events == SIZE_MAX && other.entries().size() > count) {
    return fmt::format("The runs differ: one has {} events, the other {}.", count,
                       other.entries().size());
  }
  for (std::size_t k = 0; k < count; ++k) {
    const RunLog::Entry& a = one.entries()[k];
    const RunLog::Entry& b = other.entries()[k];
    if (a.time == b.time && a.kind == b.kind && a.deeds == b.deeds) continue;
    if (a.time != b.time || a.kind != b.kind) {
      return fmt::format("Event {} should be {} at {} and is {} at {}.", k, name_of(a.kind),
                         time_text(a.time), name_of(b.kind), time_text(b.time));
    }
    return fmt::format("Event {}, {} at {}, does something else.", k, name_of(a.kind),
                       time_text(a.time));
  }
  return std::nullopt;
}

std::optional<std::string> result_difference(const model::RunResult& one,
                                             const model::RunResult& other,
                                             const Reading& reading) {
  if (one.completed() != other.completed()) {
    return fmt::format("One run completes discovery, the other leaves {} descriptors missing.",
                       std::max(one.missing_count, other.missing_count));
  }
  if (one.completed()) {
    const Nanoseconds expected =
        Nanoseconds{one.discovery_time->count() * reading.time_factor} + reading.time_shift;
    if (expected != *other.discovery_time) {
      return fmt::format("Discovery should take {} and takes {}.", time_text(expected),
                         time_text(*other.discovery_time));
    }
  }
  const auto entries = one.counts.entries();
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const std::uint64_t value = other.counts.entries()[k].value;
    if (entries[k].value == value) continue;
    return fmt::format("{} should be {} and is {}.", entries[k].name, entries[k].value, value);
  }
  if (one.useful_deliveries != other.useful_deliveries ||
      one.duplicate_deliveries != other.duplicate_deliveries) {
    return fmt::format("Deliveries should be {} + {} and are {} + {}.", one.useful_deliveries,
                       one.duplicate_deliveries, other.useful_deliveries,
                       other.duplicate_deliveries);
  }
  return std::nullopt;
}

std::optional<std::string> run_difference(const model::Scenario& one, const model::Scenario& other,
                                          const Simulate& simulate, const Reading& reading) {
  Reading plain = reading;
  plain.time_factor = 1;
  plain.time_shift = Nanoseconds{};
  plain.number.clear();
  RunLog first{reading};
  RunLog second{plain};
  const model::RunResult a = simulate(one, &first);
  const model::RunResult b = simulate(other, &second);
  if (was_cut_off(a) || was_cut_off(b)) return std::nullopt;
  if (const auto difference = first_difference(first, second)) return difference;
  return result_difference(a, b, reading);
}

}  // namespace stormproof::props
