// Chooses what a chart of an unexplained event shows: a row for each captured datagram, and a row
// for each instant at which the assignment has one received.
#include "checker/evidence/conform/report/chart.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "checker/evidence/conform/report/names.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::conform {

namespace {

using sequence::Chart;
using LineKind = Chart::Line::Kind;

class Planner {
 public:
  Planner(const Report& report, const Unexplained& unexplained)
      : report_{report},
        unexplained_{unexplained},
        names_{report.conversation},
        two_lanes_{unexplained.place.destination.has_value()} {}

  Chart run() && {
    describe();
    std::vector<std::size_t> events = unexplained_.context;
    events.push_back(unexplained_.event);
    std::ranges::sort(events);
    events.erase(std::unique(events.begin(), events.end()), events.end());
    while (!events.empty()) add_datagram(take_datagram(events));
    std::ranges::stable_sort(chart_.rows, {}, &Chart::Row::time);
    return std::move(chart_);
  }

 private:
  static constexpr std::size_t left = 0;
  static constexpr std::size_t network = 1;
  static constexpr std::size_t right = 2;

  void describe() {
    chart_.title =
        fmt::format("{}: {}", names_.place(unexplained_.place), name_of(unexplained_.fault));
    chart_.header = {unexplained_.what,
                     fmt::format("breaks the rule: {}", rule_broken_by(unexplained_.fault))};
    chart_.closing = "What the nearest assignment would need";
    chart_.reason = unexplained_.nearest;
    for (const Need& need : unexplained_.needs) {
      chart_.reason += (chart_.reason.empty() ? "" : "; ") + need_text(need);
    }
    chart_.row_number = "packet";
    chart_.legend = "times since the first packet";
    const auto& captures = report_.conversation.captures;
    for (std::size_t k = 0; captures.size() > 1 && k < captures.size(); ++k) {
      chart_.legend += fmt::format("{} {}:N of {}", k == 0 ? "; packets" : ",", k + 1,
                                   report::one_line(captures[k].name));
    }
    chart_.lanes = {
        lane(unexplained_.place.source),
        {"network", "", true},
        two_lanes_ ? lane(*unexplained_.place.destination) : Chart::Lane{"the others", "", false}};
  }

  [[nodiscard]] Chart::Lane lane(std::size_t participant) const {
    const auto& one = report_.conversation.topology.participants.at(participant);
    const std::string name = report::one_line(one.name);
    return {fmt::format("participant {}{}", participant,
                        name.empty() ? "" : fmt::format(" “{}”", name)),
            fmt::format("host {}, {}", one.host, to_string(one.prefix)), false};
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

  void add_datagram(const std::vector<std::size_t>& events) {
    const capture::Event& event = names_.event(events.front());
    const std::size_t from = is_at(event.source, unexplained_.place.source) ? left : right;
    const std::size_t packet = chart_.packets.size();
    Chart::Row row = row_at(event, event.time_ns);
    Chart::Packet& made = chart_.packets.emplace_back();
    made.name = row.packet;
    made.sender = from;
    row.lines.push_back({LineKind::sent, from, label(event, from, events), {packet}});
    if (std::ranges::find(events, unexplained_.event) != events.end()) {
      row.violation = true;
      row.lines.push_back({LineKind::unexplained, from, "not explained", {}});
    }
    add_fate(events, from == left ? right : left, packet, std::move(row));
  }

  [[nodiscard]] Chart::Row row_at(const capture::Event& event, std::int64_t time_ns) const {
    Chart::Row row;
    row.time = model::Nanoseconds{time_ns - report_.conversation.first_ns};
    row.packet = names_.packet_number(event);
    return row;
  }

  /// Adds the row of sending, with what the assignment does to the datagram on its way to `to`.
  void add_fate(const std::vector<std::size_t>& events, std::size_t to, std::size_t packet,
                Chart::Row sent) {
    const Hidden* fate = fate_of(events);
    const auto on_the_way = [&](LineKind kind, const char* text) {
      sent.lines.push_back({kind, network, text, {packet}});
    };
    if (fate == nullptr)
      chart_.packets[packet].unknown_end = to;
    else if (fate->kind == Hidden::Kind::lost)
      on_the_way(LineKind::lost, "is lost");
    else if (fate->kind == Hidden::Kind::still_under_way)
      on_the_way(LineKind::service, "is still under way at the end");
    const model::Nanoseconds at = sent.time;
    chart_.packets[packet].lost = fate != nullptr && fate->kind == Hidden::Kind::lost;
    chart_.rows.push_back(std::move(sent));
    const bool arrives = fate != nullptr && (fate->kind == Hidden::Kind::received ||
                                             fate->kind == Hidden::Kind::dropped);
    if (!arrives) return;
    Chart::Row row = row_at(names_.event(events.front()), fate->time_ns);
    row.time = std::max(row.time, at);
    row.lines.push_back(
        {LineKind::received,
         to,
         fmt::format("packet {} arrives{}", row.packet,
                     fate->kind == Hidden::Kind::dropped ? ", is dropped: not open yet" : ""),
         {packet}});
    chart_.rows.push_back(std::move(row));
  }

  /// What the assignment has of a datagram; nothing if it does not say. Other places have a fate of
  /// their own for a multicast event.
  [[nodiscard]] const Hidden* fate_of(const std::vector<std::size_t>& events) const {
    const Hidden* found = nullptr;
    for (const Hidden& hidden : report_.result.hidden) {
      if (!hidden.event || hidden.place != unexplained_.place) continue;
      if (hidden.kind == Hidden::Kind::recognised || hidden.kind == Hidden::Kind::timer) continue;
      if (std::ranges::find(events, *hidden.event) != events.end()) found = &hidden;
    }
    return found;
  }

  /// "ACKNACK 7 …", with source and destination where the lanes do not say them.
  [[nodiscard]] std::string label(const capture::Event& event, std::size_t from,
                                  const std::vector<std::size_t>& events) const {
    std::string text = submessages(events);
    const bool from_lane =
        from == left || (two_lanes_ && is_at(event.source, *unexplained_.place.destination));
    if (!from_lane) text = names_.short_name(event.source) + ": " + text;
    if (!event.destination) return event.is_multicast ? text + " (multicast)" : text;
    return two_lanes_ || from == right ? text
                                       : text + " to " + names_.short_name(*event.destination);
  }

  [[nodiscard]] std::string submessages(const std::vector<std::size_t>& events) const {
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

  const Report& report_;
  const Unexplained& unexplained_;
  const Names names_;
  const bool two_lanes_;
  Chart chart_;
};

}  // namespace

sequence::Chart chart_of(const Report& report, const Unexplained& unexplained) {
  return Planner{report, unexplained}.run();
}

std::string to_svg(const Report& report) {
  const auto& unexplained = report.result.unexplained;
  return unexplained.empty() ? "" : sequence::svg_chart(chart_of(report, unexplained.front()));
}

}  // namespace stormproof::conform
