// The chart as a Mermaid sequence diagram, for README files, issues and wikis that draw it.
#include <utility>

#include <fmt/format.h>

#include "checker/presentation/diagrams/mermaid_text.hpp"
#include "checker/presentation/sequence/chart.hpp"
#include "checker/presentation/text/time_text.hpp"

namespace stormproof::sequence {

namespace {

class Mermaid {
 public:
  explicit Mermaid(const Chart& chart) : chart_{chart} {}

  std::string run() && {
    text_ = "sequenceDiagram\n";
    text_ += fmt::format("  %% {}: {}\n", chart_.title, plain(chart_.reason));
    for (std::size_t k = 0; k < chart_.lanes.size(); ++k) {
      const Chart::Lane& lane = chart_.lanes[k];
      text_ += fmt::format("  participant {} as {}<br/>{}\n", id(k), escaped(lane.title),
                           escaped(lane.subtitle));
    }
    const std::string legend = legend_of(chart_);
    if (!legend.empty()) text_ += fmt::format("  Note over {}: {}\n", across(), escaped(legend));
    for (const Chart::Row& row : chart_.rows) add(row);
    return std::move(text_);
  }

 private:
  static std::string escaped(std::string_view text) { return draw::mermaid_text(text); }
  /// A comment ends at the end of the line.
  static std::string plain(std::string text) {
    for (char& c : text) {
      if (c == '\n') c = ' ';
    }
    return text;
  }
  static std::string id(std::size_t lane) { return fmt::format("L{}", lane); }

  [[nodiscard]] std::size_t network() const {
    for (std::size_t k = 0; k < chart_.lanes.size(); ++k) {
      if (chart_.lanes[k].network) return k;
    }
    return 0;
  }

  /// All lanes, as the place of a note.
  [[nodiscard]] std::string across() const { return id(0) + "," + id(chart_.lanes.size() - 1); }

  void add(const Chart::Row& row) {
    if (row.kind == Chart::Row::Kind::service) return;
    if (row.kind == Chart::Row::Kind::gap) {
      text_ += fmt::format("  Note over {}: … {}\n", across(), escaped(row.text));
      return;
    }
    if (row.violation) text_ += "  rect rgba(220, 38, 38, 0.25)\n";
    time_ = report::milliseconds(row.time) + " ms: ";
    for (std::size_t k = 0; k < row.lines.size();) k = add_line(row.lines, k);
    if (!row.violation) return;
    text_ += fmt::format("  Note over {}: {} {} at {} {}{}\n", across(), chart_.sign,
                         escaped(chart_.title), chart_.row_number, number_of(row),
                         chart_.reason.empty() ? "" : "<br/>" + escaped(chart_.reason));
    text_ += "  end\n";
  }

  /// Adds line k, with those after it that belong into the same note; returns the next one.
  std::size_t add_line(const std::vector<Chart::Line>& lines, std::size_t k) {
    const Chart::Line& line = lines[k];
    const std::string text = time() + escaped(words_of(line));
    switch (line.kind) {
      case Chart::Line::Kind::sent:
        if (is_local(line)) break;
        if (const auto end = unknown_end(line)) {
          text_ += fmt::format("  {}-->>{}: {}\n", id(line.lane), id(*end), text);
          return k + 1;
        }
        text_ += fmt::format("  {}->>{}: {}\n", id(line.lane), id(network_of(line)), text);
        return k + 1;
      case Chart::Line::Kind::received:
        text_ += fmt::format("  {}{}{}: {}\n", id(origin_of(line)), is_local(line) ? "-->>" : "->>",
                             id(line.lane), text);
        return k + 1;
      case Chart::Line::Kind::lost:
        text_ += fmt::format("  {0}-x{0}: {1}\n", id(line.lane), text);
        return k + 1;
      case Chart::Line::Kind::timer:
      case Chart::Line::Kind::change:
      case Chart::Line::Kind::service:
      case Chart::Line::Kind::unexplained:
        break;
    }
    std::string note = text;
    std::size_t next = k + 1;
    while (next < lines.size() && lines[next].lane == line.lane &&
           (lines[next].kind == Chart::Line::Kind::change ||
            lines[next].kind == Chart::Line::Kind::timer)) {
      note += "<br/>" + escaped(words_of(lines[next++]));
    }
    text_ += fmt::format("  Note over {}: {}\n", id(line.lane), note);
    return next;
  }

  [[nodiscard]] bool is_local(const Chart::Line& line) const {
    return !line.packets.empty() && chart_.packets[line.packets.front()].local;
  }
  [[nodiscard]] std::optional<std::size_t> unknown_end(const Chart::Line& line) const {
    return line.packets.empty() ? std::nullopt : chart_.packets[line.packets.front()].unknown_end;
  }
  /// The channel that a packet enters.
  [[nodiscard]] std::size_t network_of(const Chart::Line& line) const {
    const auto& blocks = chart_.packets[line.packets.front()].blocks;
    return blocks.empty() ? network() : blocks.front().lane;
  }
  /// Where a received packet comes from: the channel that it leaves, or its sender.
  [[nodiscard]] std::size_t origin_of(const Chart::Line& line) const {
    const Chart::Packet& packet = chart_.packets[line.packets.front()];
    if (packet.local) return packet.sender.value_or(network());
    return packet.blocks.empty() ? network() : packet.blocks.back().lane;
  }

  /// Only the first text of a row says when.
  std::string time() { return std::exchange(time_, ""); }

  const Chart& chart_;
  std::string text_;
  std::string time_;
};

}  // namespace

std::string mermaid_chart(const Chart& chart) { return Mermaid{chart}.run(); }

}  // namespace stormproof::sequence
