// A sequence chart before anybody draws it: lanes for the participants with the channels between
// them, rows for the events, and packets that cross from one to another. Text, Mermaid and SVG are
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
    enum class Kind : std::uint8_t { timer, sent, received, lost, change, service, unexplained };
    Kind kind{};
    std::size_t lane = 0;
    std::string text;
    std::vector<std::size_t> packets;  ///< in `packets` of the chart: those that it is about
    std::string effect{};              ///< of a composition, that does it; empty: not known
  };

  struct Row {
    enum class Kind : std::uint8_t {
      event,    ///< something happens at a party
      service,  ///< a channel starts or ends to serve a packet; nobody else does anything
      gap       ///< `text` says what is left out
    };
    Kind kind{};
    std::size_t event = 0;  ///< number; not of a gap
    std::string packet;     ///< of a capture, as tshark numbers it: "713"; instead of the event
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
    /// The lane that it is sent to if nobody knows whether it arrives.
    std::optional<std::size_t> unknown_end;
  };

  std::string title;                 ///< "timer.single-heartbeat is violated"
  std::string closing;               ///< heads `reason`: "Why the property breaks"
  std::string sign = "✗";            ///< marks title, closing and the violation
  std::vector<std::string> header;   ///< what stands below the title; empty lines are left out
  std::string legend;                ///< what the notation means beside dashed arrows; may be empty
  std::string reason;                ///< may be empty
  std::string row_number = "event";  ///< what rows are numbered by
  std::vector<Lane> lanes;           ///< from left to right
  std::vector<Row> rows;             ///< downwards in time
  std::vector<Packet> packets;
};

/// What happens, and the id of the effect that does it, in every story and chart alike.
[[nodiscard]] std::string with_effect(const std::string& text, const std::string& effect);
/// The text of a line, with the effect that does it: "sends p11 ACKNACK [AckNackDue.2]".
[[nodiscard]] std::string words_of(const Chart::Line& line);

/// "101", "713": what a row is numbered with; empty for a gap.
[[nodiscard]] std::string number_of(const Chart::Row& row);

/// What the notation of this chart means, dashed arrows included; may be empty.
[[nodiscard]] std::string legend_of(const Chart& chart);

/// Gives both charts the lanes of both, in one order: that of the first, and what only the second
/// has at the end. A lane on which nothing happens stays empty.
void share_lanes(Chart& first, Chart& second);
/// How many rows two charts with the same lanes begin with that say the same.
[[nodiscard]] std::size_t common_rows(const Chart& one, const Chart& other);
/// Replaces the first `rows` rows by a gap that says `text`.
void fold_start(Chart& chart, std::size_t rows, std::string text);

/// Rows of at most 100 columns, without title, header and reason.
[[nodiscard]] std::string text_chart(const Chart& chart);

/// Mermaid source, `sequenceDiagram`.
[[nodiscard]] std::string mermaid_chart(const Chart& chart);

/// A self-contained SVG document that follows the light or dark preference of its viewer.
[[nodiscard]] std::string svg_chart(const Chart& chart);

}  // namespace stormproof::sequence
