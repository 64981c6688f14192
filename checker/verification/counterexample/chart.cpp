// Builds the chart from the history: which lanes there are, which rows, and where packets are
// served.
#include "checker/verification/counterexample/chart.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <regex>
#include <set>

#include <fmt/format.h>

#include "checker/verification/counterexample/acts.hpp"
#include "checker/verification/counterexample/selection.hpp"
#include "checker/verification/counterexample/story.hpp"
#include "fsm/state_words.hpp"
#include "model/implementations.hpp"
#include "props/monitors/describe.hpp"
#include "props/property.hpp"

namespace stormproof::counterexample {

namespace {

constexpr std::size_t drawn_events = 40;

Chart::Line::Kind line_kind(Act::Kind kind) {
  switch (kind) {
    case Act::Kind::timer:
      return Chart::Line::Kind::timer;
    case Act::Kind::sent:
      return Chart::Line::Kind::sent;
    case Act::Kind::received:
      return Chart::Line::Kind::received;
    case Act::Kind::lost:
      return Chart::Line::Kind::lost;
    case Act::Kind::change:
      return Chart::Line::Kind::change;
    case Act::Kind::channel:
      return Chart::Line::Kind::service;
  }
  return Chart::Line::Kind::change;
}

/// `packets` that were sent are relevant, too.
Relevance relevance_with(const History& history, std::span<const std::uint64_t> packets) {
  Relevance relevance = relevance_of(history);
  for (const std::uint64_t number : packets) {
    if (history.packets.contains(number)) relevance.packets.insert(number);
  }
  return relevance;
}

class Builder {
 public:
  Builder(const props::Counterexample& counterexample, std::span<const std::uint64_t> packets)
      : counterexample_{counterexample},
        history_{record(counterexample)},
        relevance_{relevance_with(history_, packets)},
        selected_{select(history_, relevance_, drawn_events)} {}

  Chart run() && {
    describe();
    for (const Selected& selected : selected_) {
      if (!selected.gap) acts_[selected.step] = acts_of(history_, selected.step, relevance_);
    }
    leave_out_repetition();
    add_lanes();
    find_packets();
    for (const Selected& selected : selected_) add_rows(selected);
    for (const auto& [number, position] : packets_) {
      if (shows_way(number)) add_blocks(number, chart_.packets[position]);
    }
    explain_letters();
    return std::move(chart_);
  }

 private:
  void describe() {
    chart_.title = counterexample_.property + " is violated";
    chart_.closing = "Why the property breaks";
    chart_.reason = counterexample_.reason;
    if (const auto* property = props::find_property(counterexample_.property)) {
      chart_.header = {statement_of(*property, model::kind_of(counterexample_.scenario.dds))};
    }
    chart_.header.push_back(deployment_text(counterexample_.scenario));
    chart_.header.push_back(timers_text(counterexample_.scenario));
  }

  void explain_letters() {
    const auto has_letter = [](const Chart::Line& line) {
      const std::size_t arrow = line.text.rfind("→");
      return line.kind == Chart::Line::Kind::change && arrow != std::string::npos &&
             !fsm::words_of_state(line.text.substr(arrow + std::strlen("→"))).empty();
    };
    const auto says_one = [&](const Chart::Row& row) {
      return std::ranges::any_of(row.lines, has_letter);
    };
    if (std::ranges::any_of(chart_.rows, says_one)) {
      chart_.legend = "a writer's view of a descriptor: " + fsm::state_legend();
    }
  }

  /// What a step is like: its acts without numbers.
  [[nodiscard]] std::string shape_of(std::size_t step) const {
    static const std::regex numbers{"[0-9][0-9.,]*(–[0-9]+)?"};
    std::string shape;
    for (const Act& act : acts_.at(step)) {
      shape += fmt::format("{} {} {}\n", static_cast<int>(act.kind), act.who,
                           std::regex_replace(act.text, numbers, "#"));
    }
    return shape;
  }

  void leave_out_repetition() {
    selected_ = without_repetition(selected_, [this](std::size_t step) { return shape_of(step); });
    std::set<std::size_t> kept;
    for (const Selected& selected : selected_) {
      if (!selected.gap) kept.insert(selected.step);
    }
    std::erase_if(acts_, [&](const auto& entry) { return !kept.contains(entry.first); });
  }

  static bool on_network(const Act& act) {
    return act.kind == Act::Kind::channel || act.kind == Act::Kind::lost;
  }

  /// The host of the relation's writer on the left of the channels, all other hosts on the right;
  /// the two ends of the relation next to the channels.
  void add_lanes() {
    std::set<std::uint32_t> present;
    for (const auto& [step, acts] : acts_) {
      for (const Act& act : acts) {
        if (!on_network(act) && !act.aside) present.insert(act.who);
      }
    }
    say_who_is_left_out(present);
    std::uint32_t source = present.empty() ? 0 : *present.begin();
    std::uint32_t destination = to_everybody;
    if (!relevance_.relations.empty()) {
      const model::Pair& pair = history_.topology.pair(*relevance_.relations.begin() / 2);
      source = pair.source;
      destination = pair.destination;
    }
    const auto& participants = history_.scenario.deployment.participants;
    const auto left_host = participants[source].host;
    std::vector<std::uint32_t> left;
    std::vector<std::uint32_t> right;
    for (const std::uint32_t who : present) {
      if (who == source || who == destination) continue;
      (participants[who].host == left_host ? left : right).push_back(who);
    }
    if (present.contains(source)) left.push_back(source);
    if (present.contains(destination)) right.insert(right.begin(), destination);
    for (const std::uint32_t who : left) add_participant(who);
    add_channels();
    for (const std::uint32_t who : right) add_participant(who);
  }

  /// Participants that take no part get no lane.
  void say_who_is_left_out(const std::set<std::uint32_t>& present) {
    std::set<std::uint32_t> others;
    for (const auto& [step, acts] : acts_) {
      for (const Act& act : acts) {
        if (act.aside && !present.contains(act.who)) others.insert(act.who);
      }
    }
    if (others.empty()) return;
    std::string text;
    for (const std::uint32_t who : others)
      text += fmt::format("{}{}", text.empty() ? "" : ", ", who);
    chart_.header.push_back(
        fmt::format("not drawn: participant{} {}, sending only what belongs to "
                    "other relations",
                    others.size() == 1 ? "" : "s", text));
  }

  void add_participant(std::uint32_t who) {
    const model::Participant& p = history_.scenario.deployment.participants[who];
    participant_lane_[who] = chart_.lanes.size();
    chart_.lanes.push_back(
        {fmt::format("participant {}", who),
         fmt::format("host {}, {} pub + {} sub", p.host.value, p.publications, p.subscriptions),
         false});
  }
  void add_channels() {
    first_channel_ = chart_.lanes.size();
    for (const std::string& name : history_.channels) {
      chart_.lanes.push_back({name, "shared channel", true});
    }
    if (!history_.channels.empty()) return;
    chart_.lanes.push_back(
        {"network", "constant delay " + props::time_text(history_.scenario.wireless.one_way),
         true});
  }

  /// Packets that a shown event sends, receives or loses.
  void find_packets() {
    for (const auto& [step, acts] : acts_) {
      for (const Act& act : acts) {
        for (const std::uint64_t number : act.packets) {
          if (!packets_.emplace(number, chart_.packets.size()).second) continue;
          Chart::Packet packet;
          const PacketLog& log = history_.packets.at(number);
          packet.local = number >= first_local;
          packet.name = packet.local ? "local" : fmt::format("p{}", number);
          packet.label = packet_text(history_, number);
          packet.lost = log.lost;
          const auto sender = participant_lane_.find(log.from);
          if (sender != participant_lane_.end()) packet.sender = sender->second;
          chart_.packets.push_back(std::move(packet));
        }
      }
    }
    for (const auto& [number, position] : packets_) {
      if (!shows_way(number)) continue;
      for (const Service& service : history_.packets.at(number).services) {
        service_steps_.insert(service.first);
        if (service.last) service_steps_.insert(*service.last);
      }
    }
  }

  /// A packet of which only the start is shown gets no blocks when there are many.
  [[nodiscard]] bool shows_way(std::uint64_t number) const {
    constexpr std::size_t few = 16;
    if (packets_.size() <= few) return true;
    const auto& arrived = history_.packets.at(number).arrived;
    return arrived && acts_.contains(*arrived);
  }

  void add_rows(const Selected& selected) {
    if (!selected.gap) {
      Chart::Row row = row_at(selected.step, Chart::Row::Kind::event);
      row.violation = selected.step + 1 == history_.steps.size();
      for (const Act& act : acts_.at(selected.step)) {
        if (act.aside && !participant_lane_.contains(act.who)) continue;
        const std::size_t lane =
            on_network(act) ? first_channel_ + act.who : participant_lane_.at(act.who);
        Chart::Line line{line_kind(act.kind), lane, act.text, {}, act.effect};
        for (const std::uint64_t number : act.packets) line.packets.push_back(packets_.at(number));
        row.lines.push_back(std::move(line));
      }
      chart_.rows.push_back(std::move(row));
      return;
    }
    // A gap that leaves out relevant events is shown; in other gaps only the service of packets is.
    const bool leaves_out =
        std::any_of(relevance_.steps.begin() + std::ptrdiff_t(selected.step),
                    relevance_.steps.begin() + std::ptrdiff_t(selected.last) + 1,
                    [](bool relevant) { return relevant; });
    if (leaves_out) {
      Chart::Row row = row_at(selected.step, Chart::Row::Kind::gap);
      row.text = gap_text(history_, relevance_, selected);
      gap_rows_[selected.last] = chart_.rows.size();
      chart_.rows.push_back(std::move(row));
      return;
    }
    for (auto step = service_steps_.lower_bound(selected.step);
         step != service_steps_.end() && *step <= selected.last; ++step) {
      chart_.rows.push_back(row_at(*step, Chart::Row::Kind::service));
    }
  }

  Chart::Row row_at(std::size_t step, Chart::Row::Kind kind) {
    rows_[step] = chart_.rows.size();
    Chart::Row row;
    row.kind = kind;
    row.event = step;
    row.time = history_.steps[step].event.time;
    return row;
  }

  /// The row of a step, or that of the gap around it.
  [[nodiscard]] std::size_t row_of(std::size_t step) const {
    if (const auto row = rows_.find(step); row != rows_.end()) return row->second;
    const auto gap = gap_rows_.lower_bound(step);
    return gap == gap_rows_.end() ? chart_.rows.size() - 1 : gap->second;
  }

  /// Service that begins and ends in what one gap leaves out is left out with it.
  [[nodiscard]] bool in_one_gap(const Service& service) const {
    return service.last && !rows_.contains(service.first) && !rows_.contains(*service.last) &&
           row_of(service.first) == row_of(*service.last);
  }

  void add_blocks(std::uint64_t number, Chart::Packet& packet) const {
    for (const Service& service : history_.packets.at(number).services) {
      if (in_one_gap(service)) continue;
      const auto& stages = history_.scenario.wireless.stages;
      const std::size_t last = service.last ? row_of(*service.last) : chart_.rows.size() - 1;
      packet.blocks.push_back({first_channel_ + service.channel, stages[service.stage].name,
                               row_of(service.first), last, service.last.has_value()});
    }
  }

  const props::Counterexample& counterexample_;
  const History history_;
  const Relevance relevance_;
  std::vector<Selected> selected_;
  Chart chart_;
  std::map<std::size_t, std::vector<Act>> acts_;  // by step
  std::map<std::uint32_t, std::size_t> participant_lane_;
  std::size_t first_channel_ = 0;
  std::map<std::uint64_t, std::size_t> packets_;  // number → position
  std::set<std::size_t> service_steps_;
  std::map<std::size_t, std::size_t> rows_;      // step → row
  std::map<std::size_t, std::size_t> gap_rows_;  // last step → row
};

}  // namespace

Chart chart_of(const props::Counterexample& counterexample,
               std::span<const std::uint64_t> packets) {
  return Builder{counterexample, packets}.run();
}

std::string mermaid_chart(const props::Counterexample& counterexample) {
  return mermaid_chart(chart_of(counterexample));
}

std::string svg_chart(const props::Counterexample& counterexample) {
  return svg_chart(chart_of(counterexample));
}

}  // namespace stormproof::counterexample
