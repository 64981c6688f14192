// Chooses what a chart of an unexplained event shows, and writes it as text.
#include "checker/evidence/conform/report/chart.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "checker/evidence/conform/report/names.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::conform {

namespace {

using Fate = Chart::Arrow::Fate;

Fate fate_of(Hidden::Kind kind) {
  switch (kind) {
    case Hidden::Kind::received:
      return Fate::received;
    case Hidden::Kind::dropped:
      return Fate::dropped;
    case Hidden::Kind::lost:
      return Fate::lost;
    case Hidden::Kind::still_under_way:
      return Fate::under_way;
    case Hidden::Kind::recognised:
    case Hidden::Kind::timer:
      break;
  }
  return Fate::unknown;
}

class Planner {
 public:
  Planner(const Report& report, const Unexplained& unexplained)
      : report_{report},
        unexplained_{unexplained},
        names_{report.conversation},
        two_lanes_{unexplained.place.destination.has_value()} {}

  Chart run() {
    Chart chart;
    chart.title = fmt::format("{}: {}", names_.place(unexplained_.place), unexplained_.what);
    chart.rule =
        fmt::format("{}: {}", name_of(unexplained_.fault), rule_broken_by(unexplained_.fault));
    chart.nearest = unexplained_.nearest;
    for (const Need& need : unexplained_.needs) {
      chart.nearest += (chart.nearest.empty() ? "" : "; ") + need_text(need);
    }
    chart.left = lane(unexplained_.place.source);
    chart.right =
        two_lanes_ ? lane(*unexplained_.place.destination) : Chart::Lane{"the others", {}};
    std::vector<std::size_t> events = unexplained_.context;
    events.push_back(unexplained_.event);
    std::ranges::sort(events);
    const auto repeated = std::ranges::unique(events);
    events.erase(repeated.begin(), repeated.end());
    while (!events.empty()) chart.arrows.push_back(arrow(take_datagram(events)));
    find_fates(chart.arrows);
    chart.legend = legend();
    return chart;
  }

 private:
  [[nodiscard]] Chart::Lane lane(std::size_t participant) const {
    const auto& one = report_.conversation.topology.participants.at(participant);
    const std::string name = report::one_line(one.name);
    return {fmt::format("participant {}{}", participant,
                        name.empty() ? "" : fmt::format(" “{}”", name)),
            fmt::format("host {}, {}", one.host, to_string(one.prefix))};
  }

  [[nodiscard]] bool is_at(const capture::GuidPrefix& prefix, std::size_t participant) const {
    return report_.conversation.topology.participants.at(participant).prefix == prefix;
  }

  /// Removes and returns the first events as far as they share a datagram.
  [[nodiscard]] std::vector<std::size_t> take_datagram(std::vector<std::size_t>& events) const {
    const std::uint32_t datagram = names_.event(events.front()).datagram;
    const auto end = std::ranges::find_if(
        events, [&](std::size_t event) { return names_.event(event).datagram != datagram; });
    std::vector<std::size_t> taken{events.begin(), end};
    events.erase(events.begin(), end);
    return taken;
  }

  /// "DATA 1–3, 5 of publications": `events` from `k` on, as far as they are DATA of one writer.
  [[nodiscard]] std::string data_text(const std::vector<std::size_t>& events,
                                      std::size_t& k) const {
    const capture::Event& first = names_.event(events[k]);
    std::vector<std::int64_t> numbers;
    for (; k < events.size(); ++k) {
      const capture::Event& event = names_.event(events[k]);
      if (event.data() == nullptr || event.writer != first.writer) break;
      numbers.push_back(event.data()->sequence_number);
    }
    return fmt::format("DATA {} of {}", numbers_text(numbers), writer_name(first.writer));
  }

  [[nodiscard]] std::string label(const std::vector<std::size_t>& events) const {
    std::string text;
    for (std::size_t k = 0; k < events.size();) {
      const capture::Event& event = names_.event(events[k]);
      const bool follows = k + 1 < events.size() && names_.event(events[k + 1]).data() != nullptr;
      text += text.empty() ? "" : " + ";
      if (event.data() != nullptr && follows) {
        text += data_text(events, k);
      } else {
        text += event_text(event);
        ++k;
      }
    }
    return text;
  }

  [[nodiscard]] Chart::Arrow arrow(std::vector<std::size_t> events) const {
    const capture::Event& event = names_.event(events.front());
    Chart::Arrow one;
    one.sent_ns = event.time_ns - report_.conversation.first_ns;
    one.to_right = is_at(event.source, unexplained_.place.source);
    one.is_unexplained = std::ranges::find(events, unexplained_.event) != events.end();
    one.label = label(events);
    one.events = std::move(events);
    const bool from_lane =
        one.to_right || (two_lanes_ && is_at(event.source, *unexplained_.place.destination));
    if (!from_lane) one.label = names_.short_name(event.source) + ": " + one.label;
    if (!event.destination) {
      if (event.is_multicast) one.label += " (multicast)";
    } else if (!two_lanes_ && one.to_right) {
      one.label += " to " + names_.short_name(*event.destination);
    }
    const capture::DatagramRecord& datagram = names_.datagram(event);
    one.packet = report_.conversation.captures.size() > 1
                     ? fmt::format("{}:{}", datagram.capture + 1, datagram.packet)
                     : std::to_string(datagram.packet);
    return one;
  }

  /// Other places have a fate of their own for a multicast event.
  void find_fates(std::vector<Chart::Arrow>& arrows) const {
    for (const Hidden& hidden : report_.result.hidden) {
      if (!hidden.event || hidden.place != unexplained_.place) continue;
      if (fate_of(hidden.kind) == Fate::unknown) continue;
      const auto arrow = std::ranges::find_if(arrows, [&](const Chart::Arrow& one) {
        return std::ranges::find(one.events, *hidden.event) != one.events.end();
      });
      if (arrow == arrows.end()) continue;
      arrow->fate = fate_of(hidden.kind);
      arrow->received_ns = std::max(hidden.time_ns - report_.conversation.first_ns, arrow->sent_ns);
    }
  }

  [[nodiscard]] std::string legend() const {
    const auto& captures = report_.conversation.captures;
    if (captures.size() < 2) return "";
    std::string text = "packets";
    for (std::size_t k = 0; k < captures.size(); ++k) {
      text += fmt::format("{} {}:N of {}", k == 0 ? "" : ",", k + 1,
                          report::one_line(captures[k].name));
    }
    return text;
  }

  const Report& report_;
  const Unexplained& unexplained_;
  Names names_;
  bool two_lanes_;
};

std::string repeated(std::string_view piece, std::size_t times) {
  std::string text;
  for (std::size_t k = 0; k < times; ++k) text += piece;
  return text;
}

/// At most `width` columns, "…" where something is cut off.
std::string cut(const std::string& text, std::size_t width) {
  if (report::columns(text) <= width) return text;
  std::string result;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool begins = (static_cast<unsigned char>(text[k]) & 0xc0U) != 0x80U;
    if (begins && report::columns(result) + 1 == width) break;
    result += text[k];
  }
  return result + "…";
}

constexpr std::size_t span = 68;  ///< columns between the lifelines

/// "|── ACKNACK 7 … ──▷|"
std::string arrow_text(const Chart::Arrow& arrow) {
  const std::string label = " " + cut(arrow.label, span - 6) + " ";
  const std::size_t dashes = span - 1 - report::columns(label);
  const std::size_t before = dashes / 2;
  const std::string line = repeated("─", before) + label + repeated("─", dashes - before);
  return arrow.to_right ? "│" + line + "▷│" : "│◁" + line + "│";
}

std::string fate_text(const Chart::Arrow& arrow) {
  switch (arrow.fate) {
    case Fate::received:
      return "arrives " + milliseconds(arrow.received_ns);
    case Fate::dropped:
      return "arrives " + milliseconds(arrow.received_ns) + ", dropped: not open yet";
    case Fate::lost:
      return "is lost";
    case Fate::under_way:
      return "is still under way at the end";
    case Fate::unknown:
      break;
  }
  return "";
}

}  // namespace

Chart chart_of(const Report& report, const Unexplained& unexplained) {
  return Planner{report, unexplained}.run();
}

std::string text_chart(const Chart& chart) {
  const std::string left = cut(chart.left.title, span / 2);
  const std::string right = cut(chart.right.title, span / 2);
  const std::size_t gap = span + 2 - report::columns(left) - report::columns(right);
  std::string text = fmt::format("  {} {}   {}{}{}\n", report::right("after", 15),
                                 report::right("packet", 8), left, std::string(gap, ' '), right);
  for (const Chart::Arrow& arrow : chart.arrows) {
    text += fmt::format("{} {} {}   {}\n", arrow.is_unexplained ? "✗" : " ",
                        report::right(milliseconds(arrow.sent_ns), 15),
                        report::right(arrow.packet, 8), arrow_text(arrow));
    const std::string fate = arrow.is_unexplained ? "not explained" : fate_text(arrow);
    if (fate.empty()) continue;
    text += fmt::format(
        "  {}│{}│\n", std::string(27, ' '),
        arrow.to_right ? report::right(fate + " ", span) : report::left(" " + fate, span));
  }
  if (!chart.legend.empty()) text += report::paragraph("  ", chart.legend);
  return text;
}

}  // namespace stormproof::conform
