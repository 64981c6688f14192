// The report, in the order in which people ask: does it conform; if not, which event, which rule,
// what would have to be different, where else; then what was checked and how much of the tables
// was exercised. CI systems get a test case for each place, and a result for each unexplained
// event (the file is the capture; captures have no lines).
#include <algorithm>
#include <map>
#include <set>

#include <fmt/core.h>

#include "checker/evidence/conform/report/chart.hpp"
#include "checker/evidence/conform/report/coverage.hpp"
#include "checker/evidence/conform/report/effect_coverage.hpp"
#include "checker/evidence/conform/report/findings.hpp"
#include "checker/evidence/conform/report/names.hpp"
#include "checker/evidence/conform/report/report.hpp"
#include "checker/presentation/composition/composition_words.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::conform {

namespace {

using report::Audience;
using report::Blocks;
using report::Column;
using report::Facts;
using report::Finding;
using report::grouped;
using report::Paragraph;
using report::Section;
using report::Table;
using report::Tone;

constexpr auto to_the_right = Column::Align::right;
constexpr auto to_the_left = Column::Align::left;

/// The parts of one report; `names_` is what they have in common.
class ConformPage {
 public:
  explicit ConformPage(const Report& report)
      : report_{report}, result_{report.result}, names_{report.conversation} {}

  [[nodiscard]] Blocks blocks() const {
    Blocks all;
    if (!result_.unexplained.empty()) all.emplace_back(unexplained());
    all.emplace_back(events());
    all.emplace_back(rules());
    if (!result_.rows.empty()) all.emplace_back(machines(), Audience::verbose);
    all.emplace_back(composition(), Audience::verbose);
    all.emplace_back(assignment());
    return all;
  }

  [[nodiscard]] std::vector<Finding> findings() const {
    std::vector<Finding> all;
    std::set<Place> failed;
    for (const Unexplained& one : result_.unexplained) {
      all.push_back(failure(one));
      failed.insert(one.place);
    }
    for (const PlaceResult& place : result_.places) {
      if (!failed.contains(place.place)) all.push_back(success(place));
    }
    if (result_.verdict == Verdict::inconclusive) all.push_back(uncertainty());
    return all;
  }

 private:
  [[nodiscard]] Section unexplained() const {
    constexpr std::size_t most_charts = 10;
    Section section{"What no assignment explains", "unexplained"};
    const std::size_t places = result_.unexplained.size();
    for (std::size_t k = 0; k < std::min(places, most_charts); ++k) {
      const Unexplained& one = result_.unexplained[k];
      const Audience who = k == 0 ? Audience::everybody : Audience::page;
      if (k == 0) section.blocks.emplace_back(first_event(one));
      section.blocks.emplace_back(
          report::Sequence{chart_of(report_, one), fmt::format("chart-{}", k),
                           fmt::format("{}: {}", names_.place(one.place), one.what)},
          who);
      section.blocks.emplace_back(Paragraph{"The packet in full:"}, who);
      section.blocks.emplace_back(report::Command{names_.tshark(names_.event(one.event))}, who);
      if (k == 0 && places > 1) section.blocks.emplace_back(faults());
    }
    section.blocks.emplace_back(
        Paragraph{"--format json has every place, --svg FILE draws the chart."},
        Audience::terminal);
    if (places > most_charts) {
      section.blocks.emplace_back(
          Paragraph{fmt::format("{} more places are in the JSON report.", places - most_charts)},
          Audience::page);
    }
    return section;
  }

  [[nodiscard]] Facts first_event(const Unexplained& one) const {
    const capture::Event& event = names_.event(one.event);
    Facts facts{
        {{"first", one.what},
         {"where", names_.place(one.place)},
         {"when", fmt::format("{} after the first packet, datagram {}, {}",
                              names_.elapsed(event.time_ns), event.datagram, names_.packet(event))},
         {"from", names_.source(event)},
         {"to", names_.destination(event)},
         {"breaks", fmt::format("{}: {}", name_of(one.fault), rule_broken_by(one.fault))}}};
    if (!one.nearest.empty()) facts.rows.emplace_back("nearest", one.nearest);
    for (const Need& need : one.needs) facts.rows.emplace_back("needs", need_text(need));
    return facts;
  }

  [[nodiscard]] Table faults() const {
    Table table{{{"fault"},
                 {"places", to_the_right},
                 {"first", to_the_right},
                 {"packet", to_the_right},
                 {"what", to_the_left, true}},
                {},
                "Places with an unexplained event, by fault"};
    for (const FaultGroup& group : by_fault(result_)) {
      const Unexplained& first = *group.first;
      const capture::Event& event = names_.event(first.event);
      table.rows.push_back({{std::string{name_of(group.fault)}, grouped(group.places),
                             names_.elapsed(event.time_ns), names_.packet_number(event),
                             fmt::format("{}: {}", names_.place(first.place), first.what)}});
    }
    return table;
  }

  [[nodiscard]] Section events() const {
    Table table{{{"events"}, {"", to_the_right}}, {}};
    const auto add = [&table](const char* what, std::uint64_t value) {
      table.rows.push_back({{what, grouped(value)}});
    };
    add("checked: they need a cause", result_.checked);
    add("explained", result_.explained);
    add("not checked", result_.not_checked);
    if (result_.not_replayed > 0) {
      add("explanations not confirmed by the machines", result_.not_replayed);
    }
    if (result_.undecided > 0) add("relations given up", result_.undecided);
    return {"Events",
            "events",
            {std::move(table),
             Paragraph{"Not checked is what stays on one host, goes to an address that nobody "
                       "announced, or belongs to neither SPDP nor SEDP. A place is not followed "
                       "beyond its first unexplained event."}}};
  }

  [[nodiscard]] Section rules() const {
    Table table{{{"rule"}, {"events", to_the_right}, {"when it sends", to_the_left, true}}, {}};
    for (std::size_t k = 0; k < rule_count; ++k) {
      const auto rule = static_cast<Rule>(k);
      if (!is_rule_of(rule, report_.dds)) continue;
      std::string sentence{statement_of(rule)};
      if (rule == Rule::heartbeat_same_host || rule == Rule::data_same_host)
        sentence += " (an assumption)";
      table.rows.push_back(
          {{std::string{name_of(rule)}, grouped(result_.by_rule[k]), std::move(sentence)}});
    }
    const std::size_t all = table.rows.size();
    return {fmt::format("Rules: {} of {} explain something", rules_used(result_), all),
            "rules",
            {std::move(table)},
            false,
            true};
  }

  /// How many rows fired, and below each machine those that did not.
  [[nodiscard]] Section machines() const {
    Table table{{{"machine"}, {"fired", to_the_right}, {"can fire", to_the_right}}, {}};
    std::uint64_t used = 0;
    std::uint64_t possible = 0;
    for (const MachineCoverage& machine : coverage_of(result_.rows, report_.dds)) {
      const std::uint64_t can = machine.rows.size() - machine.ruled_out;
      used += machine.used;
      possible += can;
      Table::Row row{{machine.machine, grouped(machine.used), grouped(can)}};
      Facts never = never_fired(machine);
      if (!never.rows.empty()) {
        row.summary = report::plural(machine.rows.size() - machine.used, "row") + " never fired";
        row.details = {std::move(never)};
      }
      table.rows.push_back(std::move(row));
    }
    return {fmt::format("Rows of the machines: {} fired of {} that this profile can fire", used,
                        possible),
            "machines",
            {std::move(table)},
            false,
            true};
  }

  [[nodiscard]] static Facts never_fired(const MachineCoverage& machine) {
    Facts facts;
    std::map<std::string, std::uint64_t> reasons;
    for (const RowCoverage& row : machine.rows) {
      if (row.use->times > 0) continue;
      if (row.ruled_out_by.empty()) {
        facts.rows.emplace_back("never", row.use->text);
      } else {
        ++reasons[row.ruled_out_by];
      }
    }
    for (const auto& [reason, rows] : reasons) {
      facts.rows.emplace_back(
          "cannot", fmt::format("{}, because of {}", report::plural(rows, "row"), reason));
    }
    return facts;
  }

  /// Which rules of the composition are seen sending, and below each what it never sent.
  [[nodiscard]] Section composition() const {
    const CompositionCoverage coverage = effect_coverage(result_, report_.dds, report_.impossible);
    Table table{{{"rule"},
                 {"events", to_the_right},
                 {"effects seen", to_the_right},
                 {"can be seen", to_the_right}},
                {}};
    for (const RuleCoverage& rule : coverage.rules) {
      std::uint64_t events = 0;
      for (const EffectCoverage& one : rule.effects) events += one.times;
      Table::Row row{{std::string{rule.rule}, grouped(events), grouped(rule.seen()),
                      grouped(rule.possible())}};
      Facts never = never_seen(rule);
      if (!never.rows.empty()) {
        row.summary = report::plural(rule.effects.size() - rule.seen(), "effect") + " never seen";
        row.details = {std::move(never)};
      }
      table.rows.push_back(std::move(row));
    }
    std::string text = fmt::format(
        "Only what sends can be seen: {} of the composition's {} effects. The others feed "
        "machines, set state, start timers or belong to liveliness, user topics and lookups of "
        "types, and are counted nowhere. "
        "stormproof draw composition --dds {} shows all of them.",
        coverage.observable(), coverage.observable() + coverage.unobservable.size(),
        report_.profile.substr(0, report_.profile.find(' ')));
    if (coverage.unattributed > 0) {
      text +=
          fmt::format(" {} put down to what the capture does not show, and to no effect.",
                      coverage.unattributed == 1 ? "1 event is"
                                                 : grouped(coverage.unattributed) + " events are");
    }
    return {
        fmt::format("Rules of the composition: {} seen sending of {} that this profile can show, "
                    "{} of {} effects",
                    coverage.rules_seen(), coverage.rules_possible(), coverage.seen(),
                    coverage.possible()),
        "composition",
        {std::move(table), Paragraph{std::move(text)}},
        false,
        true};
  }

  [[nodiscard]] static Facts never_seen(const RuleCoverage& rule) {
    Facts facts;
    for (const EffectCoverage& one : rule.effects) {
      if (one.times > 0) continue;
      std::string text = one.effect->id + ": " + draw::sentence(*one.effect);
      if (!one.ruled_out_by.empty()) text += ", because of " + one.ruled_out_by;
      facts.rows.emplace_back(one.ruled_out_by.empty() ? "never" : "cannot", std::move(text));
    }
    return facts;
  }

  [[nodiscard]] Section assignment() const {
    Table table{{{""}, {"needed", to_the_right}, {"bound", to_the_right}}, {}};
    table.rows.push_back({{"datagrams taken as lost", grouped(result_.lost),
                           result_.bounds.may_lose ? "" : "losses are not allowed"}});
    const auto add = [&table](const char* what, std::int64_t used, std::int64_t bound) {
      table.rows.push_back({{what, milliseconds(used), milliseconds(bound)}});
    };
    add("longest send lag", result_.used_send_lag_ns, result_.bounds.most_send_lag_ns);
    add("latest timer", result_.used_lateness_ns, result_.bounds.most_lateness_ns);
    add("oldest clock", result_.used_clock_age_ns, result_.bounds.most_clock_age_ns);
    return {"The assignment", "assignment", {std::move(table)}};
  }

  [[nodiscard]] Finding finding_at(const Place& place) const {
    Finding finding;
    finding.group = "stormproof.conform." + report_.profile;
    finding.name = names_.place(place);
    finding.identity = {identity(), finding.name};
    return finding;
  }

  [[nodiscard]] Finding failure(const Unexplained& one) const {
    const capture::Event& event = names_.event(one.event);
    Finding finding = finding_at(one.place);
    finding.id = fmt::format("conform.{}", name_of(one.fault));
    finding.statement = rule_broken_by(one.fault);
    finding.outcome = Finding::Outcome::failed;
    finding.word = name_of(one.fault);
    finding.message = fmt::format("{}: {} ({} after the first packet, {})", finding.name, one.what,
                                  names_.elapsed(event.time_ns), names_.packet(event));
    if (!one.nearest.empty()) finding.message += ". Nearest assignment: " + one.nearest;
    finding.details = fmt::format("breaks: {}\n", finding.statement);
    for (const Need& need : one.needs) finding.details += "needs " + need_text(need) + "\n";
    finding.details += text_chart(chart_of(report_, one));
    report::Location location;
    location.file = names_.capture_name(event);
    location.message = names_.packet(event);
    finding.locations = {std::move(location)};
    return finding;
  }

  [[nodiscard]] Finding success(const PlaceResult& place) const {
    Finding finding = finding_at(place.place);
    finding.id = "conform.place";
    finding.details = fmt::format("{} events explained, {} datagrams taken as lost\n",
                                  place.explained, place.lost);
    finding.shown = Finding::Shown::tests;
    return finding;
  }

  [[nodiscard]] Finding uncertainty() const {
    Finding finding;
    finding.group = "stormproof.conform." + report_.profile;
    finding.name = "all places";
    finding.id = "conform.inconclusive";
    finding.statement = "nobody knows whether the capture conforms";
    finding.outcome = Finding::Outcome::unknown;
    finding.word = verdict_token(result_.verdict);
    finding.message = verdict_meaning(report_);
    finding.identity = {identity()};
    return finding;
  }

  [[nodiscard]] std::string identity() const {
    std::string text = report_.profile;
    for (const auto& capture : report_.conversation.captures) text += " " + capture.name;
    return text;
  }

  const Report& report_;
  const Conformance& result_;
  const Names names_;
};

Tone tone_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::conforms:
      return Tone::good;
    case Verdict::does_not_conform:
      return Tone::bad;
    case Verdict::inconclusive:
      break;
  }
  return Tone::warn;
}

}  // namespace

report::Document document_of(const Report& report) {
  const ConformPage page{report};
  const capture::Topology& topology = report.conversation.topology;
  report::Document document;
  document.title =
      fmt::format("stormproof conform {} to {}", captures_text(report), report.profile);
  document.tone = tone_of(report.result.verdict);
  document.answer = verdict_line(report);
  document.elaboration = fmt::format(
      "{} {}: {} on {}, {} (relations, writers, announcers).", verdict_meaning(report),
      captures_text(report), report::plural(topology.participants.size(), "participant"),
      report::plural(topology.hosts, "host"), report::plural(report.result.places.size(), "place"));
  document.blocks = page.blocks();
  document.findings = page.findings();
  for (const std::string& one : report.result.assumptions) document.assumptions.emplace_back(one);
  document.complete = report.result.verdict != Verdict::inconclusive;
  return document;
}

}  // namespace stormproof::conform
