// A row for each packet, transition, and change of what is missing or waits.
#include "checker/python/recorder.hpp"

#include <limits>
#include <utility>

#include <pybind11/stl.h>

#include "checker/python/column.hpp"
#include "model/engine/packet.hpp"

namespace stormproof::python {

namespace py = pybind11;

namespace {

constexpr std::size_t no_row = std::numeric_limits<std::size_t>::max();

}  // namespace

std::uint16_t Vocabulary::number_of(std::string_view word) {
  const auto found = numbers_.find(word);
  if (found != numbers_.end()) return found->second;
  const auto number = static_cast<std::uint16_t>(words_.size());
  numbers_.emplace(word, number);
  words_.emplace_back(word);
  return number;
}

void Recorder::event_started(const model::Event& event) { now_ = event.time.count(); }

void Recorder::event_finished(const model::Depths& depths) {
  const bool is_news = progress_.time_ns.empty() || progress_.missing.back() != depths.missing ||
                       progress_.backlog.back() != depths.backlog_packets ||
                       progress_.waiting.back() != depths.waiting;
  if (!is_news) return;
  progress_.time_ns.push_back(now_);
  progress_.missing.push_back(depths.missing);
  progress_.backlog.push_back(depths.backlog_packets);
  progress_.waiting.push_back(depths.waiting);
}

void Recorder::transition(const model::Transition& fired) {
  transitions_.time_ns.push_back(now_);
  transitions_.subject.push_back(fired.machine.subject);
  transitions_.machine.push_back(machines_.number_of(fired.machine.machine));
  transitions_.event.push_back(events_.number_of(fired.event));
  transitions_.before.push_back(states_.number_of(fired.before));
  transitions_.after.push_back(states_.number_of(fired.after));
}

void Recorder::emitted(const model::Packet& packet, std::uint32_t source,
                       std::span<const std::uint32_t> destinations) {
  if (packet.number >= row_of_packet_.size()) row_of_packet_.resize(packet.number + 1, no_row);
  row_of_packet_[packet.number] = packets_.kind.size();
  packets_.emitted_ns.push_back(now_);
  packets_.arrived_ns.push_back(-1);
  packets_.source.push_back(source);
  packets_.destination.push_back(destinations.size() == 1 ? destinations.front() : to_everybody);
  packets_.payload_bytes.push_back(packet.payload_bytes);
  packets_.kind.push_back(kinds_.number_of(name_of(packet.kind)));
  packets_.lost.push_back(0);
}

void Recorder::arrived(const model::Packet& packet, bool lost) {
  if (packet.number >= row_of_packet_.size()) return;
  const std::size_t row = row_of_packet_[packet.number];
  if (row == no_row) return;
  packets_.arrived_ns[row] = now_;
  packets_.lost[row] = lost ? 1 : 0;
}

py::dict Recorder::tables() {
  py::dict packets;
  put(packets, "emitted_ns", std::move(packets_.emitted_ns));
  put(packets, "arrived_ns", std::move(packets_.arrived_ns));
  put(packets, "kind", std::move(packets_.kind));
  put(packets, "source", std::move(packets_.source));
  put(packets, "destination", std::move(packets_.destination));
  put(packets, "payload_bytes", std::move(packets_.payload_bytes));
  put(packets, "lost", std::move(packets_.lost));
  py::dict transitions;
  put(transitions, "time_ns", std::move(transitions_.time_ns));
  put(transitions, "machine", std::move(transitions_.machine));
  put(transitions, "subject", std::move(transitions_.subject));
  put(transitions, "event", std::move(transitions_.event));
  put(transitions, "before", std::move(transitions_.before));
  put(transitions, "after", std::move(transitions_.after));
  py::dict progress;
  put(progress, "time_ns", std::move(progress_.time_ns));
  put(progress, "missing", std::move(progress_.missing));
  put(progress, "backlog", std::move(progress_.backlog));
  put(progress, "waiting", std::move(progress_.waiting));
  py::dict words;
  words["kind"] = kinds_.words();
  words["machine"] = machines_.words();
  words["event"] = events_.words();
  words["before"] = states_.words();
  words["after"] = states_.words();
  py::dict tables;
  tables["packets"] = packets;
  tables["transitions"] = transitions;
  tables["progress"] = progress;
  tables["words"] = words;
  return tables;
}

}  // namespace stormproof::python
