// The page for people: the answer, who is there, what was sent, why, and what to change.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/evidence/capture/summary.hpp"
#include "checker/evidence/doctor/doctor.hpp"
#include "checker/experiments/trials/tone_of_health.hpp"
#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/figures.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::doctor {

namespace {

using report::Column;
using report::grouped;
using report::plural;
using report::Section;
using report::Table;
using report::Tone;

constexpr auto to_the_right = Column::Align::right;

std::string time_text(const std::optional<double>& ns) {
  return report::time_figure(ns, "not within the limit");
}

std::string amplification(const Report& report) {
  return report::ratio(static_cast<double>(report.messages()),
                       static_cast<double>(report.failure_free.total()));
}

/// "discovery took 2.231 s", or what is missing.
std::string completeness(const Report& report) {
  if (report.missing > 0) {
    return fmt::format("{} of {} descriptors were never sent to somebody who needs them",
                       grouped(report.missing), grouped(report.counting.required));
  }
  if (!report.completion_ns) return "every descriptor was known";
  std::string text = "everybody was told everything after " +
                     report::duration(model::Nanoseconds{*report.completion_ns});
  if (report.storm && report.known_late_ns) {
    text += fmt::format(", and had it after {}",
                        report::duration(model::Nanoseconds{*report.known_late_ns}));
  }
  return text;
}

/// "4,582 messages about types that participants do not know, beside "; empty if there are fewer
/// than others.
std::string lookups(const Report& report) {
  if (!report.lookups_prevail) return "";
  return fmt::format("{} messages about types that participants do not know, beside ",
                     grouped(report.counting.lookup_messages()));
}

std::string first_mismatch(const Report& report) {
  const auto found = std::ranges::find_if(
      report.reasons, [](const Reason& one) { return one.id.starts_with("unequal_"); });
  return found == report.reasons.end() ? "" : found->sentence;
}

std::string answer(const Report& report) {
  const std::string sent = fmt::format("{} messages, {} what a discovery without failures needs",
                                       grouped(report.messages()), amplification(report));
  switch (report.health) {
    case Health::healthy:
      return fmt::format("HEALTHY: {}, with {}{}.", completeness(report), lookups(report), sent);
    case Health::storm:
      return fmt::format(
          "{}: {}{}; needless repeats and the control traffic that they cause take "
          "{} what everything sent once takes; {}.",
          report.lookup_storm() ? "LOOKUP STORM" : "STORM", lookups(report), sent,
          report::ratio(report.took.ratio(), 1), completeness(report));
    case Health::unmatched:
      return fmt::format("DISCOVERED, AND NOT MATCHED: {}. {}, with {}.", first_mismatch(report),
                         completeness(report), sent);
    case Health::incomplete:
      if (const Reason* apart = report.what_keeps_apart()) {
        return fmt::format("INCOMPLETE{}: {}.", apart->probability < 1 ? ", probably" : "",
                           apart->sentence);
      }
      return fmt::format("INCOMPLETE{}: {}; {}.", report.storm ? ", and a storm" : "",
                         completeness(report), sent);
    case Health::unknown:
      break;
  }
  return fmt::format("CANNOT TELL: {}.", report.why_unknown);
}

Tone tone_of(Health health) {
  switch (health) {
    case Health::healthy:
      return Tone::good;
    case Health::storm:
    case Health::incomplete:
    case Health::unmatched:
      return Tone::bad;
    case Health::unknown:
      break;
  }
  return Tone::warn;
}

report::Facts who(const Report& report) {
  report::Facts facts;
  const capture::Topology& topology = report.conversation.topology;
  facts.rows.emplace_back(
      "there", fmt::format("{} on {}", plural(topology.participants.size(), "participant"),
                           plural(topology.hosts, "host")));
  for (const Product& one : report.products) {
    facts.rows.emplace_back("library",
                            fmt::format("{}{}{}: {}", one.vendor, one.version.empty() ? "" : " ",
                                        one.version, plural(one.participants, "participant")));
  }
  if (report.has_server) {
    facts.rows.emplace_back("discovers", "with a Discovery Server (PARTICIPANT_TYPE of DATA(p))");
  }
  if (!report.looked_for_presets) return facts;
  facts.rows.emplace_back(
      "behaves as", report.presets.empty()
                        ? "no shipped profile that could be held against it explains every message"
                        : fmt::format("{}", fmt::join(report.presets, ", ")));
  return facts;
}

/// What was captured beside what a discovery without failures needs; with `last_second`, of that,
/// too.
Table counts_table(const Report& report, const model::Counts* last_second = nullptr) {
  Table table{{{"messages"},
               {"captured", to_the_right},
               {"failure-free", to_the_right},
               {"amplification", to_the_right}},
              {}};
  const auto add = [&](std::string_view name, const auto& number) {
    const std::uint64_t sent = number(report.counting.counts);
    const std::uint64_t needed = number(report.failure_free);
    Table::Row row{{name, grouped(sent), grouped(needed),
                    report::ratio(static_cast<double>(sent), static_cast<double>(needed))}};
    if (last_second != nullptr) {
      row.cells.insert(row.cells.begin() + 1, grouped(number(*last_second)));
    }
    table.rows.push_back(std::move(row));
  };
  if (last_second != nullptr) {
    table.columns.insert(table.columns.begin() + 1, Column{"last second", to_the_right});
  }
  for (const model::MessageClass one : model::message_classes) {
    add(words_of(one), [one](const model::Counts& counts) { return counts[one]; });
  }
  add("total", [](const model::Counts& counts) { return counts.total(); });
  if (report.counting.counts.lookup > 0 && last_second == nullptr) {
    table.rows.push_back({{"lookup (in no total)", grouped(report.counting.counts.lookup),
                           grouped(report.types.lookups), ""}});
  }
  return table;
}

Section messages(const Report& report) {
  Table table = counts_table(report);
  if (report.later_announcements > 0) {
    table.caption = fmt::format(
        "{} announcements after the last descriptor go on forever and do "
        "not count as discovery",
        grouped(report.later_announcements));
  }
  return {"What was sent", "messages", {std::move(table)}};
}

/// Events of each class in the second before `now_ns`.
model::Counts of_last_second(const Report& report, std::int64_t now_ns) {
  constexpr std::int64_t second = 1'000'000'000;
  model::Counts counts;
  const auto& events = report.conversation.events;
  for (std::size_t k = report.counting.classes.size(); k-- > 0;) {
    const bool is_later = events[k].time_ns > now_ns;
    if (!is_later && events[k].time_ns <= now_ns - second) break;
    if (!is_later && report.counting.classes[k]) ++counts[*report.counting.classes[k]];
  }
  return counts;
}

Section why(const Report& report) {
  Table table{{{"cause"}, {"messages", to_the_right}, {"what the capture shows", {}, true}}, {}};
  for (const Cause& cause : report.causes) {
    table.rows.push_back({{cause.id, grouped(cause.messages),
                           cause.sentence + (cause.remedy.empty() ? "" : " Helps: ") +
                               cause.remedy + (cause.remedy.empty() ? "" : ".")}});
  }
  return {"Why", "causes", {std::move(table)}};
}

/// Each reason with how sure it is, and what to do.
Section why_apart(const Report& report) {
  Table table{{{"reason"},
               {"probability", to_the_right},
               {"what the capture shows, and what to do", {}, true}},
              {}};
  for (const Reason& one : report.reasons) {
    table.rows.push_back({{one.id, report::percent(one.probability, 1),
                           fmt::format("{}. To do: {}.", one.sentence, one.remedy)}});
  }
  const bool is_apart = std::ranges::any_of(report.reasons, &Reason::keeps_apart);
  return {
      is_apart ? "Why they do not see each other" : "What happened", "reasons", {std::move(table)}};
}

/// What was strange in the capture: damaged, cut, forged, or not to be looked into.
Section left_out(const Report& report) {
  report::Bullets list;
  for (const capture::Remark& one : report.conversation.remarks) {
    list.items.emplace_back(
        fmt::format("{}: {} (first: {})", one.what, grouped(one.count), one.first));
  }
  return {"What is strange in the capture", "remarks", {std::move(list)}};
}

Section what_to_change(const Report& report) {
  Section section{"What to change", "advice"};
  if (report.without_lookups) {
    const Advice& without = *report.without_lookups;
    section.blocks.emplace_back(report::Paragraph{fmt::format(
        "Let nobody ask for types: give every participant the property fastdds.type_propagation "
        "with the value registration_only. Then {} of {} messages are not sent, and endpoints "
        "match "
        "as soon as they are known. Programs that learn types from the network no longer can.",
        grouped(report.counting.lookup_messages()),
        grouped(report.messages() + report.counting.lookup_messages()))});
    if (without.before.messages && without.after.messages) {
      section.blocks.emplace_back(report::Paragraph{fmt::format(
          "The model of this deployment discovers in {} with {} messages, lookups among them; "
          "without "
          "them in {} with {}.",
          time_text(without.before.completion_ns), report::count_figure(without.before.messages),
          time_text(without.after.completion_ns), report::count_figure(without.after.messages))});
    }
    section.blocks.emplace_back(report::Listing{without.xml, "xml"});
  }
  if (report.advice.empty()) {
    section.blocks.emplace_back(report::Paragraph{
        (report.without_lookups ? "No other advice: " : "No advice: ") + report.no_advice + "."});
    return section;
  }
  Table table{{{"", to_the_right},
               {"settings", {}, true},
               {"completion", to_the_right},
               {"messages", to_the_right}},
              {}};
  table.rows.push_back({{"", "as it is", time_text(report.advice.front().before.completion_ns),
                         report::count_figure(report.advice.front().before.messages)}});
  for (std::size_t k = 0; k < report.advice.size(); ++k) {
    const Advice& one = report.advice[k];
    Table::Row row{{std::to_string(k + 1), one.settings, time_text(one.after.completion_ns),
                    report::count_figure(one.after.messages)}};
    row.summary = "the file to deploy";
    row.details.emplace_back(report::Listing{one.xml, "xml"}, report::Audience::documents);
    if (!one.prerequisites.empty()) {
      report::Bullets needs;
      for (const std::string& what : one.prerequisites) needs.items.emplace_back(what);
      row.details.emplace_back(std::move(needs));
    }
    table.rows.push_back(std::move(row));
  }
  table.caption =
      "medians that the model predicts for this deployment, until the last descriptor has arrived";
  section.blocks.emplace_back(std::move(table));
  section.blocks.emplace_back(report::Listing{report.advice.front().xml, "xml"},
                              report::Audience::explained);
  return section;
}

Section heard(const Report& report) {
  Table table{{{"capture"}}, {}};
  for (const Heard::From& from : report.heard.front().hosts) {
    table.columns.push_back({fmt::format("from host {}", from.host), to_the_right});
  }
  for (const Heard& one : report.heard) {
    Table::Row row{{one.capture}};
    for (const Heard::From& from : one.hosts) {
      row.cells.emplace_back(fmt::format("{} of {}", grouped(from.datagrams), grouped(from.sent)));
    }
    table.rows.push_back(std::move(row));
  }
  table.caption = "datagrams of each host that the capture holds, of those in any capture";
  return {"Who heard whom", "heard", {std::move(table)}};
}

Section unknowns(const Report& report) {
  report::Bullets list;
  if (report.basis) {
    const Basis& basis = *report.basis;
    list.items.emplace_back(fmt::format(
        "The predictions are those of {} over {}, the shipped channel over which the model comes "
        "nearest to this capture: the last descriptor is sent first after {:.2f} × its time, with "
        "{:.2f} × its messages in all. Trust what a change saves no further than that.",
        basis.dds, basis.wireless, basis.completion_ratio, basis.message_ratio));
  }
  list.items.emplace_back(
      "Traffic of the application, other networks on the channel, roaming, power save and busy "
      "processors are not in the model.");
  list.items.emplace_back(
      "A capture shows what left an interface, not what arrived: captures of all hosts show "
      "who heard whom.");
  return {"What the prediction cannot know", "unknown", {std::move(list)}};
}

}  // namespace

report::Document document_of(const Report& report, const Request& request) {
  report::Document document;
  document.title = "stormproof doctor";
  for (const std::string& name : request.files) document.title += " " + name;
  document.tone = tone_of(report.health);
  document.answer = answer(report);
  if (!report.causes.empty() && (report.storm || report.amplified)) {
    document.elaboration = report.causes.front().sentence;
  }
  const capture::Summary summary{report.conversation, report.counting};
  document.blocks.emplace_back(who(report));
  if (!report.reasons.empty()) document.blocks.emplace_back(why_apart(report));
  if (!report.conversation.remarks.empty()) document.blocks.emplace_back(left_out(report));
  document.blocks.emplace_back(messages(report));
  report::add_definition(document.blocks, report.storm, report.limits);
  if (!report.causes.empty()) document.blocks.emplace_back(why(report));
  document.blocks.emplace_back(what_to_change(report));
  if (!report.heard.empty()) document.blocks.emplace_back(heard(report));
  document.blocks.emplace_back(over_time(summary), report::Audience::verbose);
  document.blocks.emplace_back(participants(report.conversation), report::Audience::verbose);
  document.blocks.emplace_back(unknowns(report));
  document.complete = !report.interrupted;
  return document;
}

report::Document glance_at(const Report& report, std::int64_t now_ns) {
  report::Document document;
  document.title = "stormproof watch";
  document.tone = tone_of(report.health);
  document.answer = answer(report);
  document.blocks.emplace_back(who(report));
  const model::Counts last = of_last_second(report, now_ns);
  document.blocks.emplace_back(counts_table(report, &last));
  report::add_definition(document.blocks, report.storm, report.limits);
  if (!report.reasons.empty()) document.blocks.emplace_back(why_apart(report));
  if (!report.causes.empty()) document.blocks.emplace_back(why(report));
  return document;
}

}  // namespace stormproof::doctor
