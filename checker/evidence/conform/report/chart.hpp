// The context of an unexplained event as a message sequence chart, before anybody draws it: two
// lifelines, the writer's participant on the left, and rows downwards in time. Text and SVG are two
// renderings of this.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/conform/report/report.hpp"

namespace stormproof::conform {

struct Chart {
  struct Lane {
    std::string title{};     ///< "participant 2 “camera”", "the others"
    std::string subtitle{};  ///< "host 0, 010f…"
  };
  /// The captured submessages of one datagram. What the assignment does to them is known where the
  /// assignment has it.
  struct Arrow {
    enum class Fate : std::uint8_t { unknown, received, dropped, lost, under_way };
    std::vector<std::size_t> events{};
    std::int64_t sent_ns = 0;      ///< since the first packet
    std::int64_t received_ns = 0;  ///< since the first packet, if it arrived
    bool to_right = true;
    bool is_unexplained = false;
    Fate fate = Fate::unknown;
    std::string label{};

    [[nodiscard]] bool arrives() const { return fate == Fate::received || fate == Fate::dropped; }
    std::string packet{};  ///< "713"; "2:713" if there are several captures
  };
  std::string title{};
  std::string rule{};     ///< which rule the event breaks
  std::string nearest{};  ///< the nearest assignment and what it would need
  Lane left{};
  Lane right{};
  std::vector<Arrow> arrows{};  ///< by time of sending
  std::string legend{};         ///< names of the captures, if there are several
};

[[nodiscard]] Chart chart_of(const Report& report, const Unexplained& unexplained);

/// Lines of at most 100 columns.
[[nodiscard]] std::string text_chart(const Chart& chart);
/// A self-contained SVG document.
[[nodiscard]] std::string svg_chart(const Chart& chart);

}  // namespace stormproof::conform
