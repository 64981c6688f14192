// `stormproof conform CAPTURE…`: reads the captures and the profile, and has them held against each
// other; without a profile, which shipped one fits best.
#include <chrono>
#include <filesystem>
#include <map>

#include <fmt/core.h>

#include "checker/cli/commands.hpp"
#include "checker/cli/durations.hpp"
#include "checker/cli/frame.hpp"
#include "checker/cli/on_captures.hpp"
#include "checker/cli/output_file.hpp"
#include "checker/evidence/conform/report/changes_report.hpp"
#include "checker/evidence/conform/report/ranking_report.hpp"
#include "checker/evidence/conform/report/report.hpp"
#include "model/config/distributions.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::cli {

namespace {

using conform::Bounds;
using model::config::Result;

struct ConformArguments {
  std::vector<std::string> files;
  std::string dds;                     ///< empty: all shipped ones
  std::vector<std::string> overrides;  ///< key.path=value, without "dds."
  std::string until;                   ///< empty: everything
  std::string delay;                   ///< LO..HI; empty: the default, as the next three
  std::string send_lag;
  std::string lateness;
  std::string clock_age;
  std::string same_host;
  std::string queueing;
  std::string clock_error;
  bool no_loss = false;
  double seconds_each = 20;  ///< without `dds`
  bool changes = false;
  OutputFile svg;
  OutputFile assignment;
};

Result<Bounds, std::string> parse_bounds(const ConformArguments& arguments) {
  constexpr model::Nanoseconds most{86'400'000'000'000};
  Bounds bounds;
  if (!arguments.delay.empty()) {
    const auto delay = parse_duration_range("--delay", arguments.delay, most);
    if (!delay) return delay.error();
    bounds.least_delay_ns = delay->first.count();
    bounds.most_delay_ns = delay->second.count();
  }
  const auto read = [&](const char* option, const std::string& text,
                        std::int64_t& bound) -> std::optional<std::string> {
    if (text.empty()) return std::nullopt;
    const auto value = parse_duration(option, text, most);
    if (!value) return value.error();
    bound = value->count();
    return std::nullopt;
  };
  auto error = read("--send-lag", arguments.send_lag, bounds.most_send_lag_ns);
  if (!error) error = read("--lateness", arguments.lateness, bounds.most_lateness_ns);
  if (!error) error = read("--clock-age", arguments.clock_age, bounds.most_clock_age_ns);
  if (!error) error = read("--same-host", arguments.same_host, bounds.most_same_host_ns);
  if (!error) error = read("--queueing", arguments.queueing, bounds.most_queueing_ns);
  if (!error) error = read("--clock-error", arguments.clock_error, bounds.clock_error_ns);
  if (error) return *error;
  bounds.may_lose = !arguments.no_loss;
  return bounds;
}

/// The profile as reports name it.
std::string profile_name(const ConformArguments& arguments) {
  std::string name = arguments.dds;
  for (std::size_t k = 0; k < arguments.overrides.size(); ++k) {
    name += (k == 0 ? " with " : ", ") + arguments.overrides[k];
  }
  return name;
}

ExitCode exit_code(conform::Verdict verdict) {
  switch (verdict) {
    case conform::Verdict::conforms:
      return established;
    case conform::Verdict::does_not_conform:
      return not_conformant;
    case conform::Verdict::inconclusive:
      break;
  }
  return inconclusive;
}

/// What to run after one profile was held against captures; nothing if that is not decided.
std::optional<report::NextStep> next_of(const ConformArguments& arguments,
                                        conform::Verdict verdict) {
  switch (verdict) {
    case conform::Verdict::conforms:
      return report::NextStep{
          on_captures({"validate"}, arguments.files,
                      {"--dds", arguments.dds, "--wireless", "wifi-80211n"}),
          "how long the model takes over such a channel; list wireless has more"};
    case conform::Verdict::does_not_conform:
      return report::NextStep{on_captures({"conform"}, arguments.files),
                              "which shipped profile explains it best"};
    case conform::Verdict::inconclusive:
      break;
  }
  return std::nullopt;
}

/// The files beside the report.
void write_beside(ConformArguments& arguments, const conform::Report& report, Answer& answer) {
  if (arguments.assignment.wanted()) {
    arguments.assignment.stream() << conform::assignment_lines(report);
  }
  if (!arguments.svg.wanted()) return;
  if (report.result.unexplained.empty()) {
    answer.notes.push_back(
        fmt::format("stormproof: {} is not written: there is no unexplained event to draw",
                    arguments.svg.path()));
    arguments.svg.discard();
  } else {
    arguments.svg.stream() << to_svg(report);
  }
}

/// The shipped profiles, and which distributions each stands for.
model::config::Result<std::vector<conform::Candidate>> candidates(
    const model::config::SpecPath& specs, std::map<std::string, std::string>& distributions) {
  std::vector<conform::Candidate> all;
  for (const std::string& name : specs.names(model::config::SpecKind::dds)) {
    const auto dds = model::config::read_dds_profile(name, {}, specs);
    if (!dds) return dds.error();
    all.push_back({name, *dds});
  }
  const auto known = model::config::read_distributions(specs.directories);
  if (!known) return known.error();
  for (const model::config::Distribution& one : *known) {
    std::string& names = distributions[one.profile];
    names += (names.empty() ? "" : ", ") + one.name;
  }
  return all;
}

Outcome rank_all(const ConformArguments& arguments, const Bounds& bounds,
                 const capture::Conversation& conversation, std::int64_t until, Session& session) {
  std::map<std::string, std::string> distributions;
  auto all = candidates(model::config::SpecPath::standard(), distributions);
  if (!all) return all.error();
  conform::RankingRequest request{conversation, until, bounds, *std::move(all)};
  request.each =
      std::chrono::milliseconds{static_cast<std::int64_t>(arguments.seconds_each * 1'000)};
  request.progress = [&session](const std::string& name, std::size_t done, std::size_t of) {
    return session.proceed([&] { return fmt::format("{}: relation {} of {}", name, done, of); });
  };
  const auto ranking = conform::rank(request);
  if (!ranking) return ranking.error();
  conform::RankingReport report{conversation, *ranking, bounds, until, std::move(distributions)};
  if (!ranking->ranked.empty()) {
    report.next = session.command({"--seconds-each"}) + " --dds " + ranking->ranked.front().name;
  }
  Answer answer{document_of(report), to_json(report)};
  answer.document.complete = !Session::interrupted();
  answer.document.exit_code = Session::interrupted() ? inconclusive : exit_code(ranking->verdict());
  return answer;
}

Outcome hold_one(ConformArguments& arguments, const model::DdsProfile& dds, const Bounds& bounds,
                 const capture::Conversation& conversation, std::int64_t until, Session& session) {
  const auto on_progress = [&session](std::size_t done, std::size_t all) {
    return session.proceed([&] { return fmt::format("relation {} of {}", done, all); });
  };
  const auto result =
      conform::conform({conversation, until, dds, bounds, on_progress, Session::interrupted});
  if (!result) return result.error();
  const conform::Report report{
      conversation, *result, dds, profile_name(arguments), until, tables::impossible_effects(dds)};
  Answer answer{document_of(report), to_json(report)};
  answer.document.exit_code = exit_code(result->verdict);
  Session::note_interruption(answer.document);
  if (auto next = next_of(arguments, result->verdict)) answer.document.next = {*std::move(next)};
  write_beside(arguments, report, answer);
  return answer;
}

/// Each capture by itself, against its profile and against each change of it.
Outcome hold_changes(const ConformArguments& arguments, const Bounds& bounds, Session& session) {
  conform::ChangesReport report{{}, bounds, false};
  for (const std::string& file : arguments.files) {
    std::string name = profile_name(arguments);
    if (arguments.dds.empty()) {
      const auto known = conform::profile_of_capture(file);
      if (!known) return known.error();
      name = *known;
    }
    const auto dds =
        model::config::read_dds_profile(arguments.dds.empty() ? name : arguments.dds,
                                        arguments.overrides, model::config::SpecPath::standard());
    if (!dds) return dds.error();
    const auto conversation = capture::read_conversation({{file}}, session.on_packets());
    if (!conversation) return conversation.error();
    const std::string capture = std::filesystem::path{file}.filename().string();
    const auto tried = conform::try_changes(
        {*conversation, capture.substr(0, capture.find(".pcap")), name, *dds, bounds,
         [&](const std::string& change) {
           return session.proceed([&] { return fmt::format("{}: {}", capture, change); });
         },
         Session::interrupted});
    if (!tried) return tried.error();
    report.captures.push_back(*tried);
    if (Session::interrupted()) break;
  }
  report.interrupted = Session::interrupted();
  Answer answer{document_of(report), to_json(report)};
  answer.document.exit_code = report.interrupted              ? inconclusive
                              : !conform::all_conform(report) ? not_conformant
                                                              : established;
  return answer;
}

Outcome run(ConformArguments& arguments, Session& session) {
  const auto bounds = parse_bounds(arguments);
  if (!bounds) return Complaint{bounds.error()};
  if (arguments.changes) return hold_changes(arguments, *bounds, session);
  std::optional<model::DdsProfile> dds;
  if (!arguments.dds.empty()) {
    const auto read = model::config::read_dds_profile(arguments.dds, arguments.overrides,
                                                      model::config::SpecPath::standard());
    if (!read) return read.error();
    dds = *read;
  }
  const auto conversation = capture::read_conversation(arguments.files, session.on_packets());
  if (!conversation) return conversation.error();
  const auto until = parse_until(arguments.until, conversation->first_ns);
  if (!until) return Complaint{until.error()};
  return dds ? hold_one(arguments, *dds, *bounds, *conversation, *until, session)
             : rank_all(arguments, *bounds, *conversation, *until, session);
}

void declare_bounds(Options& options, ConformArguments& arguments) {
  const Bounds defaults;
  const auto printed = [](std::int64_t bound) {
    return bound == 0 ? "0" : model::config::print_duration(model::Nanoseconds{bound});
  };
  const auto add = [&](const char* name, std::string& value, const char* help,
                       const std::string& usual, const char* type) {
    options.text(name, value, fmt::format("{} (default: {})", help, usual), type);
  };
  add("--delay", arguments.delay, "From the capture of a datagram to its reception",
      printed(defaults.least_delay_ns) + ".." + printed(defaults.most_delay_ns), "LO..HI");
  add("--send-lag", arguments.send_lag,
      "From a rule's sending to the capture of the datagram, at most",
      printed(defaults.most_send_lag_ns), "DURATION");
  add("--lateness", arguments.lateness, "How late a timer may act, at most",
      printed(defaults.most_lateness_ns), "DURATION");
  add("--clock-age", arguments.clock_age,
      "How old the clock may be from which the first initial ACKNACK waits, at most",
      printed(defaults.most_clock_age_ns), "DURATION");
  add("--same-host", arguments.same_host,
      "From the last cause to the end of what participants of one host exchange, at most",
      printed(defaults.most_same_host_ns), "DURATION");
  add("--queueing", arguments.queueing,
      "How long a message of Cyclone DDS may wait in its participant's queue, at most",
      printed(defaults.most_queueing_ns), "DURATION");
  add("--clock-error", arguments.clock_error, "How far the clocks of the captures may be apart",
      printed(defaults.clock_error_ns), "DURATION");
  options.flag("--no-loss", arguments.no_loss, "Every captured datagram arrives");
}

void declare(Options& options, ConformArguments& arguments) {
  options.captures(arguments.files);
  const Option dds = options.text(
      "--dds", arguments.dds,
      "DDS profile: name, YAML file or vendor XML file (default: all shipped ones, ranked)",
      "PROFILE");
  options.overrides(arguments.overrides, "the profile").needs(dds);
  options
      .number("--seconds-each", arguments.seconds_each,
              "Without --dds: at most so long for each profile (default 20)", "S")
      .within(0.001, 86'400.0)
      .excludes(dds);
  options.until(arguments.until, "Look at events until this instant");
  declare_bounds(options, arguments);
  options.flag("--changes", arguments.changes,
               "Hold each capture by itself against each change of one knob of its profile (--dds, "
               "or profiles.yaml beside it)");
  options.svg(arguments.svg, "Draw what surrounds the first unexplained event, if there is one")
      .needs(dds);
  options
      .output("--assignment", arguments.assignment,
              "Write the receptions, losses and timers that explain the capture (JSON Lines)")
      .needs(dds);
}

}  // namespace

void declare_conform(Frame& frame) {
  frame.add<ConformArguments>(
      {"conform",
       "Whether captures of real discovery are a behaviour of a DDS profile",
       "Exit code: 0 conforms within the bounds, 4 does not, 3 inconclusive or interrupted,\n"
       "2 bad input; without --dds that of the profile that fits best.",
       Formats::findings,
       {conform::json_schema, conform::ranking_schema}},
      declare, run);
}

}  // namespace stormproof::cli
