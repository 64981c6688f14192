// The report for people, in the order in which they ask: does it conform; if not, which event,
// which rule, what would have to be different, where else; then what was checked and how much of
// the tables was exercised.
#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/conform/report/chart.hpp"
#include "checker/evidence/conform/report/coverage.hpp"
#include "checker/evidence/conform/report/findings.hpp"
#include "checker/evidence/conform/report/names.hpp"
#include "checker/evidence/conform/report/report.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/paragraph.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::conform {

namespace {

using report::grouped;
using report::left;
using report::paragraph;
using report::right;

std::string first_unexplained(const Report& report, const Names& names) {
  if (report.result.unexplained.empty()) return "";
  const Unexplained& one = report.result.unexplained.front();
  const capture::Event& event = names.event(one.event);
  std::string text = "\nThe first event that no assignment explains\n";
  text += paragraph("  what     ", one.what);
  text += paragraph("  where    ", names.place(one.place));
  text += paragraph("  when     ",
                    fmt::format("{} after the first packet, datagram {}, {}",
                                names.elapsed(event.time_ns), event.datagram, names.packet(event)));
  text += paragraph("  from     ", names.source(event));
  text += paragraph("  to       ", names.destination(event));
  text += paragraph("  breaks   ",
                    fmt::format("{}: {}", name_of(one.fault), rule_broken_by(one.fault)));
  if (!one.nearest.empty()) text += paragraph("  nearest  ", one.nearest);
  for (const Need& need : one.needs) text += paragraph("  needs    ", need_text(need));
  return text + "\n" + text_chart(chart_of(report, one));
}

std::string all_faults(const Report& report, const Names& names) {
  constexpr std::size_t most = 10;
  if (report.result.unexplained.size() < 2) return "";
  std::string text = fmt::format(
      "\nPlaces with an unexplained event, by fault\n  {} places  first\n", left("fault", 24));
  const std::vector<FaultGroup> groups = by_fault(report.result);
  for (std::size_t k = 0; k < std::min(groups.size(), most); ++k) {
    const Unexplained& first = *groups[k].first;
    const capture::Event& event = names.event(first.event);
    text += paragraph(fmt::format("  {} {}  ", left(std::string{name_of(first.fault)}, 24),
                                  right(grouped(groups[k].places), 6)),
                      fmt::format("{}, {}, {}: {}", names.elapsed(event.time_ns),
                                  names.packet(event), names.place(first.place), first.what));
  }
  if (groups.size() > most) text += fmt::format("  and {} other faults\n", groups.size() - most);
  return text;
}

std::string more(const Report& report, const Names& names) {
  if (report.result.unexplained.empty()) return "";
  const capture::Event& event = names.event(report.result.unexplained.front().event);
  return "\nTo see more: --format json has every place, --svg FILE draws the chart; the packet in "
         "full:\n  " +
         names.tshark(event) + "\n";
}

std::string checked(const Report& report) {
  const Conformance& result = report.result;
  std::string text = "\nEvents\n";
  const auto line = [&text](const char* what, std::uint64_t value) {
    text += fmt::format("  {} {}\n", left(what, 46), right(grouped(value), 10));
  };
  line("checked: they need a cause", result.checked);
  line("explained", result.explained);
  line("not checked", result.not_checked);
  if (result.not_replayed > 0) {
    line("explanations not confirmed by the machines", result.not_replayed);
  }
  if (result.undecided > 0) line("relations given up", result.undecided);
  text += paragraph("  ",
                    "Not checked is what stays on one host, goes to an address that nobody "
                    "announced, or belongs to neither SPDP nor SEDP. A place is not followed "
                    "beyond its first unexplained event.");
  return text;
}

std::string rules_text(const Conformance& result) {
  std::string text =
      fmt::format("\nRules: {} of {} explain something\n", rules_used(result), rule_count);
  std::string never;
  for (std::size_t k = 0; k < rule_count; ++k) {
    const auto rule = static_cast<Rule>(k);
    if (result.by_rule[k] == 0) {
      never += (never.empty() ? "" : ", ") + std::string{name_of(rule)};
      continue;
    }
    std::string sentence{statement_of(rule)};
    if (rule == Rule::heartbeat_same_host) sentence += " (an assumption)";
    text += paragraph(fmt::format("  {} {}  ", left(std::string{name_of(rule)}, 23),
                                  right(grouped(result.by_rule[k]), 9)),
                      sentence);
  }
  if (!never.empty()) text += paragraph("  none by ", never);
  return text;
}

std::string never_fired(const MachineCoverage& machine) {
  std::string text;
  std::vector<std::pair<std::string, std::uint64_t>> reasons;
  for (const RowCoverage& row : machine.rows) {
    if (row.use->times > 0) continue;
    if (row.ruled_out_by.empty()) {
      text += paragraph("    never   ", row.use->text);
      continue;
    }
    const auto known =
        std::ranges::find(reasons, row.ruled_out_by, &std::pair<std::string, std::uint64_t>::first);
    if (known == reasons.end()) {
      reasons.emplace_back(row.ruled_out_by, 1);
    } else {
      ++known->second;
    }
  }
  for (const auto& [reason, rows] : reasons) {
    text += fmt::format("    cannot  {}, because of {}\n", report::plural(rows, "row"), reason);
  }
  return text;
}

std::string coverage(const Report& report) {
  const auto machines = coverage_of(report.result.rows, report.dds);
  if (machines.empty()) return "";
  std::uint64_t used = 0;
  std::uint64_t possible = 0;
  std::string lines;
  for (const MachineCoverage& machine : machines) {
    const std::uint64_t can = machine.rows.size() - machine.ruled_out;
    used += machine.used;
    possible += can;
    lines += fmt::format("  {} {} of {}\n", left(machine.machine, 20),
                         right(grouped(machine.used), 4), can);
    lines += never_fired(machine);
  }
  return fmt::format("\nRows of the machines: {} fired of {} that this profile can fire\n", used,
                     possible) +
         lines;
}

std::string assignment(const Report& report) {
  const Conformance& result = report.result;
  std::string text = "\nThe assignment\n";
  text += fmt::format("  {} {}{}\n", left("datagrams taken as lost", 44),
                      right(grouped(result.lost), 12),
                      result.bounds.may_lose ? "" : "  (losses are not allowed)");
  const auto line = [&text](const char* what, std::int64_t used, std::int64_t bound) {
    text += fmt::format("  {} {}  of {}\n", left(what, 44), right(milliseconds(used), 15),
                        milliseconds(bound));
  };
  line("longest send lag that was needed", result.used_send_lag_ns, result.bounds.most_send_lag_ns);
  line("latest timer that was needed", result.used_lateness_ns, result.bounds.most_lateness_ns);
  return text;
}

std::string assumptions(const Report& report) {
  const Conformance& result = report.result;
  std::string text;
  for (const std::string& one : result.assumptions) text += paragraph("  - ", one);
  if (!text.empty()) text = "\nAssumptions\n" + text;
  return text;
}

}  // namespace

std::string to_text(const Report& report) {
  const Names names{report.conversation};
  const Conformance& result = report.result;
  std::string text = verdict_line(report) + "\n";
  text += paragraph("  ", verdict_meaning(report));
  text += paragraph(
      "  ", fmt::format("{}: {} participants on {}, {} places (relations, writers, announcers).",
                        captures_text(report), report.conversation.topology.participants.size(),
                        report::plural(report.conversation.topology.hosts, "host"),
                        grouped(result.places.size())));
  return text + first_unexplained(report, names) + all_faults(report, names) + more(report, names) +
         checked(report) + rules_text(result) + coverage(report) + assignment(report) +
         assumptions(report);
}

}  // namespace stormproof::conform
