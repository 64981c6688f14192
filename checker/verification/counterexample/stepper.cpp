// The steps are the rows of the chart at which something happens, and its gaps.
#include "checker/verification/counterexample/stepper.hpp"

#include <fmt/core.h>

#include "checker/presentation/diagrams/machine_svg.hpp"
#include "checker/presentation/document/html_page.hpp"
#include "checker/presentation/text/time_text.hpp"
#include "checker/verification/counterexample/chart.hpp"
#include "checker/verification/counterexample/machine_states.hpp"
#include "fsm/machines.hpp"

namespace stormproof::counterexample {

namespace {

using report::html_text;
using RowKind = Chart::Row::Kind;

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : " ") + part;
  return text;
}

std::string states_html(const std::vector<StateRow>& states) {
  if (states.empty()) return {};
  std::string html =
      "<table><thead><tr><th scope=\"col\">after it</th><th scope=\"col\">machine</th>"
      "<th scope=\"col\">state</th></tr></thead><tbody>\n";
  for (const StateRow& row : states) {
    html += fmt::format(
        "<tr{} data-of=\"{}\" data-states=\"{}\"><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        row.moved ? " class=\"moved\"" : "", html_text(row.machine), html_text(joined(row.states)),
        html_text(row.owner), html_text(row.machine), html_text(row.text));
  }
  return html + "</tbody></table>\n";
}

std::string acts_html(const Chart& chart, const Chart::Row& row) {
  std::string html = "<ul class=\"acts\">\n";
  if (row.kind == RowKind::gap) html += "<li>left out: " + html_text(row.text) + "</li>\n";
  for (const Chart::Line& line : row.lines) {
    html += fmt::format("<li>{}: {}</li>\n", html_text(chart.lanes[line.lane].title),
                        html_text(words_of(line)));
  }
  if (row.violation)
    html += "<li class=\"violated\">" + html_text(chart.sign + " " + chart.reason) + "</li>\n";
  return html + "</ul>\n";
}

std::string step_html(const Chart& chart, std::size_t number, const std::vector<StateRow>* states) {
  const Chart::Row& row = chart.rows[number];
  std::set<std::size_t> packets;
  for (const Chart::Line& line : row.lines) {
    packets.insert(line.packets.begin(), line.packets.end());
  }
  std::string list;
  for (const std::size_t packet : packets)
    list += fmt::format("{}{}", list.empty() ? "" : " ", packet);
  const std::string what =
      row.kind == RowKind::gap ? "some events later" : fmt::format("event {}", row.event);
  return fmt::format(
      "<li data-row=\"{}\" data-packets=\"{}\"><p class=\"when\">{}{}, {} ms</p>\n{}{}</li>\n",
      number, list, row.violation ? html_text(chart.sign) + " " : "", what,
      report::milliseconds(row.time), acts_html(chart, row),
      states == nullptr ? "" : states_html(*states));
}

std::string controls_html(std::size_t steps, std::string_view id) {
  const auto button = [](const char* action, const char* words, const char* key) {
    return fmt::format("<button type=\"button\" data-go=\"{}\" title=\"key: {}\">{}</button>\n",
                       action, key, words);
  };
  return "<div class=\"controls only-script\" hidden>\n" + button("first", "⇤ first", "Home") +
         button("previous", "← previous", "←") + button("next", "next →", "→") +
         button("last", "last ⇥", "End") + button("play", "▶ play", "space") +
         fmt::format(
             "<input type=\"range\" min=\"0\" max=\"{}\" value=\"0\" aria-label=\"step\" "
             "id=\"{}-slider\">\n<output for=\"{}-slider\"></output>\n</div>\n"
             "<p class=\"keys soft only-script\" hidden>Keys: <kbd>←</kbd> <kbd>→</kbd> one step, "
             "<kbd>Home</kbd> <kbd>End</kbd> to the ends, <kbd>space</kbd> plays.</p>\n"
             "<p class=\"unseen\" aria-live=\"polite\"></p>\n",
             steps - 1, id, id);
}

/// The steps of a chart, and the events after which states are wanted.
struct Steps {
  std::vector<std::size_t> rows;
  std::vector<std::uint64_t> events;  // of those that are no gaps
};

Steps steps_of(const Chart& chart) {
  Steps steps;
  for (std::size_t r = 0; r < chart.rows.size(); ++r) {
    if (chart.rows[r].kind == RowKind::service) continue;
    steps.rows.push_back(r);
    if (chart.rows[r].kind == RowKind::event) steps.events.push_back(chart.rows[r].event);
  }
  return steps;
}

}  // namespace

report::Sequence walk(const props::Counterexample& counterexample, Chart chart, std::string id,
                      std::string caption, std::set<std::string>& machines) {
  const Steps steps = steps_of(chart);
  report::Sequence sequence;
  if (!steps.rows.empty()) {
    const auto states = states_after(counterexample, steps.events);
    for (const StateRow& row : states.empty() ? std::vector<StateRow>{} : states.back()) {
      if (row.machine != "received") machines.insert(row.machine);
    }
    std::string list;
    std::size_t event = 0;
    for (const std::size_t row : steps.rows) {
      const bool gap = chart.rows[row].kind == RowKind::gap;
      const auto* shown = gap || event >= states.size() ? nullptr : &states[event];
      if (!gap) ++event;
      list += step_html(chart, row, shown);
    }
    sequence.steps_html = fmt::format(
        "<div class=\"stepper\" role=\"group\" aria-label=\"Steps: {}\" tabindex=\"0\" "
        "data-drawing=\"{}\">\n{}<ol class=\"steps\">\n{}</ol></div>\n",
        html_text(caption), html_text(id), controls_html(steps.rows.size(), id), list);
  }
  sequence.chart = std::move(chart);
  sequence.id = std::move(id);
  sequence.caption = std::move(caption);
  return sequence;
}

report::Section diagrams_of(const std::set<std::string>& machines) {
  report::Section section{
      "State machines, as the simulator runs them; the states of the current step are marked"};
  section.folded = true;
  for (const fsm::MachineInfo& machine : fsm::machines()) {
    const std::string name{machine.name};
    if (!machines.contains(name)) continue;
    section.blocks.emplace_back(report::Drawing{draw::machine_svg(machine), name, "", name});
  }
  return section;
}

}  // namespace stormproof::counterexample
