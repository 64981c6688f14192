// A sequence chart before anybody draws it: lanes for the participants with the channels between
// them, rows for the events, and packets that cross from one to another. Mermaid and SVG are
// renderings of it. Counterexamples and captures make such charts.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/units.hpp"

namespace stormproof::sequence {

struct Chart {
  struct Lane {
    std::string title;     ///< "participant 0", "air"
    std::string subtitle;  ///< "host 0, 1 pub + 1 sub", "shared channel"
    bool network = false;  ///< a channel, or the network if it has no channels
  };

  struct Line {
    enum class Kind : std::uint8_t { timer, sent, received, lost, change, service };
    Kind kind{};
    std::size_t lane = 0;
    std::string text;
    std::vector<std::size_t> packets;  ///< in `packets` of the chart: those that it is about
  };

  struct Row {
    enum class Kind : std::uint8_t {
      event,    ///< something happens at a party
      service,  ///< a channel starts or ends to serve a packet; nobody else does anything
      gap       ///< `text` says what is left out
    };
    Kind kind{};
    std::size_t event = 0;  ///< number; not of a gap
    model::Nanoseconds time;
    std::vector<Line> lines;
    std::string text;
    bool violation = false;
  };

  /// The service of a packet in one stage.
  struct Block {
    std::size_t lane = 0;
    std::string stage;
    std::size_t first_row = 0;
    std::size_t last_row = 0;
    bool finished = false;
  };

  struct Packet {
    std::string name;   ///< "p14"
    std::string label;  ///< "p14 ACKNACK 1→0 pub, lacks 0–9"
    std::vector<Block> blocks;
    bool lost = false;
    bool local = false;                 ///< between participants of one host, past the network
    std::optional<std::size_t> sender;  ///< its lane, if it has one
  };

  std::string property;
  std::string title;       ///< "timer.single-heartbeat is violated"
  std::string closing;     ///< heads `reason`: "Why the property breaks"
  std::string sign = "✗";  ///< marks title, closing and the last event
  std::string statement;   ///< empty if the catalogue does not have the property
  std::string reason;
  std::string deployment;
  std::string timers;
  std::vector<Lane> lanes;  ///< from left to right
  std::vector<Row> rows;    ///< downwards in time
  std::vector<Packet> packets;
};

/// Mermaid source, `sequenceDiagram`.
[[nodiscard]] std::string mermaid_chart(const Chart& chart);

/// A self-contained SVG document that follows the light or dark preference of its viewer.
[[nodiscard]] std::string svg_chart(const Chart& chart);

}  // namespace stormproof::sequence
