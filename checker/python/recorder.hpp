// What happens in a run, as columns: the packets with their ways, the transitions of the machines,
// and how far discovery is. A trace (model/trace) says more of each event, as text.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <pybind11/pybind11.h>

#include "model/probe.hpp"

namespace stormproof::python {

/// Words as numbers, in the order in which they came.
class Vocabulary {
 public:
  [[nodiscard]] std::uint16_t number_of(std::string_view word);
  [[nodiscard]] const std::vector<std::string>& words() const { return words_; }

 private:
  std::map<std::string, std::uint16_t, std::less<>> numbers_;
  std::vector<std::string> words_;
};

class Recorder final : public model::Probe {
 public:
  void event_started(const model::Event& event) override;
  void event_finished(const model::Depths& depths) override;
  void transition(const model::Transition& fired) override;
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override;
  void arrived(const model::Packet& packet, bool lost) override;

  /// "packets", "transitions" and "progress", each columns by name; "words": of those that are
  /// numbers of words, these by the name of the column. Once.
  [[nodiscard]] pybind11::dict tables();

 private:
  struct Packets {
    std::vector<std::int64_t> emitted_ns, arrived_ns;  ///< −1: not before the end
    std::vector<std::uint32_t> source, destination;    ///< to_everybody: more than one
    std::vector<std::uint32_t> payload_bytes;
    std::vector<std::uint16_t> kind;
    std::vector<std::uint8_t> lost;
  };
  struct Transitions {
    std::vector<std::int64_t> time_ns;
    std::vector<std::uint32_t> subject;
    std::vector<std::uint16_t> machine, event, before, after;
  };
  struct Progress {
    std::vector<std::int64_t> time_ns;
    std::vector<std::uint64_t> missing, backlog, waiting;
  };
  static constexpr std::uint32_t to_everybody = UINT32_MAX;

  std::int64_t now_ = 0;
  Packets packets_;
  std::vector<std::size_t> row_of_packet_;  ///< by its number
  Transitions transitions_;
  Progress progress_;
  Vocabulary kinds_, machines_, events_, states_;
};

}  // namespace stormproof::python
