// What a run did, event by event, in a form in which two runs can be compared: laws say that a run
// of a changed scenario is the run of the original, read in another way (times scaled, participants
// renumbered, sizes left out).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/probe.hpp"
#include "model/run_result.hpp"
#include "model/trace/event_subject.hpp"
#include "props/laws/law.hpp"

namespace stormproof::props {

/// How to read a run so that it looks like another one.
struct Reading {
  std::int64_t time_factor = 1;         ///< times of the other run are this many times as large …
  model::Nanoseconds time_shift{};      ///< … and this much later
  bool sizes = true;                    ///< whether payloads have to be the same
  bool insertions = true;               ///< whether insertion numbers have to be the same
  bool schedule = true;                 ///< whether events that are only scheduled count
  bool lost_arrivals = true;            ///< whether the arrival of a lost packet is an event
  std::vector<std::uint32_t> number{};  ///< of each participant in the other run; empty: the same
};

class RunLog final : public model::Probe {
 public:
  explicit RunLog(Reading reading = {}) : reading_{std::move(reading)} {}

  struct Entry {
    model::Nanoseconds time;
    model::EventKind kind{};
    std::uint64_t deeds = 0;  ///< digest of the event and of everything that it did
  };
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  /// How many events there were when an ACKNACK with a bitmap was first sent; all, if none was.
  [[nodiscard]] std::size_t first_bitmap() const;

  void run_started(const model::Topology& topology) override;
  void event_started(const model::Event& event) override;
  void event_finished(const model::Depths& depths) override;
  void transition(const model::Transition& fired) override;
  void scheduled(std::uint64_t insertion, model::Nanoseconds time, model::EventKind kind,
                 std::uint32_t subject) override;
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override;
  void service_started(std::uint32_t channel, std::uint32_t stage, const model::Packet& packet,
                       std::uint32_t fragment, model::Nanoseconds until) override;
  void arrived(const model::Packet& packet, bool lost) override;
  void received(const model::Packet& packet, std::uint32_t receiver) override;
  void looped_back(const model::Packet& packet, std::uint32_t receiver) override;

 private:
  void note(std::uint64_t what);
  void note(std::string_view text);
  void note_time(model::Nanoseconds time);
  void note_participant(std::uint32_t i);
  void note_pair(std::uint32_t pair);
  void note_subject(model::trace::Subject subject, std::uint32_t number);
  void note_packet(const model::Packet& packet);
  void note_numbers(const model::Packet& packet);
  void note_relayed(const model::Relayed& relayed);
  void note_submessage(const model::Submessage& submessage);

  Reading reading_;
  const model::Topology* topology_ = nullptr;
  std::uint32_t stride_ = 1;  // of Cyclone DDS's writers
  std::vector<Entry> entries_;
  Entry current_;
  bool drop_current_ = false;
  std::optional<std::size_t> first_bitmap_;
};

/// The first of the first `events` events in which the runs differ, in one sentence, or nothing.
[[nodiscard]] std::optional<std::string> first_difference(const RunLog& one, const RunLog& other,
                                                          std::size_t events = SIZE_MAX);

/// The first of T_disc, counts, deliveries and missing descriptors in which the results differ when
/// `one` is read as `reading` says, or nothing.
[[nodiscard]] std::optional<std::string> result_difference(const model::RunResult& one,
                                                           const model::RunResult& other,
                                                           const Reading& reading = {});

/// Runs both scenarios. The first difference between the run of `one`, read as `reading` says, and
/// that of `other`; nothing if there is none, or if somebody stopped a run.
[[nodiscard]] std::optional<std::string> run_difference(const model::Scenario& one,
                                                        const model::Scenario& other,
                                                        const Simulate& simulate,
                                                        const Reading& reading = {});

/// Whether somebody stopped the run, so that its end says nothing.
[[nodiscard]] inline bool was_cut_off(const model::RunResult& result) {
  return result.end == model::RunEnd::interrupted;
}

}  // namespace stormproof::props
