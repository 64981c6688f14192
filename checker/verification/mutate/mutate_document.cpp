// Mutants first, then what each property and each law is good for.
#include <fmt/format.h>

#include "checker/presentation/text/numbers.hpp"
#include "checker/verification/mutate/effect_trials.hpp"
#include "checker/verification/mutate/mutate_report.hpp"
#include "props/laws/law.hpp"
#include "props/property.hpp"

namespace stormproof::mutate {

namespace {

using report::Column;
using report::Paragraph;

std::string share_text(std::size_t part, std::size_t whole) {
  return report::percent(static_cast<double>(part), static_cast<double>(whole));
}

/// What the property tests say about a mutant, after what the properties say; nothing if they were
/// not asked.
std::string laws_text(const MutantResult& mutant, bool everybody) {
  if (!mutant.killed_by_laws) {
    const bool asked = everybody && mutant.kind != Kind::effect;
    return asked ? "; property tests: – (no run shows it)" : "";
  }
  if (mutant.killed_by_laws->empty()) return "; property tests: none";
  return fmt::format("; property tests: {}", fmt::join(*mutant.killed_by_laws, ", "));
}

std::string noticed_by(const MutantResult& mutant) {
  if (mutant.unseen()) return "unseen: " + mutant.reason;
  if (!mutant.noticed()) return "SURVIVES: " + mutant.reason;
  return mutant.killed_by.empty() ? "→ a law"
                                  : fmt::format("→ {}", fmt::join(mutant.killed_by, ", "));
}

report::Table mutants_table(const MutationReport& report) {
  report::Table table;
  table.columns = {
      {"mutant"},
      {"what is wrong", Column::Align::left, true},
      {report.everybody ? "who notices" : "who notices first", Column::Align::left, true}};
  for (const MutantResult& mutant : report.mutants) {
    report::Text who = noticed_by(mutant) + laws_text(mutant, report.everybody);
    table.rows.push_back({{report::code(mutant.id), mutant.description, std::move(who)},
                          !mutant.noticed() && !mutant.unseen()});
  }
  return table;
}

/// "property  12": how many mutants each of `all` notices.
template <class All, class Count>
report::Table counts_table(const char* what, const All& all, Count count) {
  report::Table table;
  table.columns = {{what}, {"mutants that it notices", Column::Align::right}};
  for (const auto& one : all) {
    table.rows.push_back({{report::code(one.id), report::grouped(count(one.id))}});
  }
  return table;
}

/// A survivor fails; the laws do not count.
report::Finding finding_of(const MutantResult& mutant, bool everybody) {
  report::Finding finding;
  finding.id = mutant.id;
  finding.group = "stormproof.mutate";
  finding.statement = mutant.description;
  using enum report::Finding::Outcome;
  finding.outcome = mutant.noticed() ? passed : mutant.unseen() ? note : failed;
  finding.word = mutant.noticed() ? "noticed" : mutant.unseen() ? "unseen" : "survives";
  finding.message = noticed_by(mutant);
  finding.details =
      mutant.description + "\n" + noticed_by(mutant) + laws_text(mutant, everybody) + "\n";
  finding.shown = report::Finding::Shown::tests;
  return finding;
}

/// What a mistake that nobody notices from outside changes for a user.
std::string_view harm_in_words(const MutantResult& mutant) {
  switch (mutant.harm.value_or(Harm::unseen)) {
    case Harm::unseen:
      return "nothing in any of the runs";
    case Harm::nothing:
      return "nothing that a user sees: what machines remember, or the order at one instant";
    case Harm::time:
      return "when something happens";
    case Harm::messages:
      return "how many messages there are";
    case Harm::discovery:
      return "discovery, which lacks descriptors in the end";
  }
  return "";
}

/// If the rules themselves are wrong, who notices is somebody who does not execute them.
report::Table shares_table(const MutationReport& report) {
  report::Table table;
  table.columns = {{"rules of"},
                   {"mistakes that runs show", Column::Align::right},
                   {"noticed if the rules are wrong", Column::Align::right},
                   {"share", Column::Align::right},
                   {"expected", Column::Align::right}};
  for (const Share& share : report.shares()) {
    table.rows.push_back({{report::code(share.composition), report::grouped(share.seen),
                           report::grouped(share.noticed), share_text(share.noticed, share.seen),
                           share.is_expected ? "60 %" : "–"},
                          !share.suffices()});
  }
  return table;
}

/// The ends of long lists are what one sees of them.
void add_survivors(report::Document& document, const MutationReport& report) {
  report::Bullets survivors;
  report::Bullets restated;
  for (const MutantResult& mutant : report.mutants) {
    if (mutant.noticed_in_rules() || mutant.unseen()) continue;
    report::Text item = report::code(mutant.id);
    if (mutant.harm) item += fmt::format(": changes {}", harm_in_words(mutant));
    if (!mutant.noticed()) item += ": " + mutant.reason;
    (mutant.noticed() ? restated : survivors).items.emplace_back(std::move(item));
  }
  if (!restated.items.empty()) {
    document.blocks.emplace_back(
        report::Section{"Noticed only beside correct rules: nobody would if the rules were wrong",
                        "restated",
                        {std::move(restated)}});
  }
  if (survivors.items.empty()) return;
  document.blocks.emplace_back(
      report::Section{"Nobody notices", "survivors", {std::move(survivors)}});
}

}  // namespace

report::Document document_of(const MutationReport& report) {
  const std::size_t total = report.mutants.size();
  report::Document document;
  document.title = "stormproof mutate";
  document.tone = report.interrupted        ? report::Tone::warn
                  : report.notices_enough() ? report::Tone::good
                                            : report::Tone::bad;
  const std::size_t seen = total - report.unseen();
  document.answer = fmt::format("{} of {} mutants are noticed ({}), in {:.1f} s", report.killed(),
                                seen, share_text(report.killed(), seen), report.seconds);
  if (report.unseen() > 0) {
    document.answer +=
        fmt::format("; {} more are unseen in {} random runs, which proves nothing of them",
                    report.unseen(), EffectTrials::runs);
  }
  if (const std::size_t effects = report.seen_at_effects(); effects > 0) {
    document.answer += fmt::format(
        "; of {} at effects {} ({}) if the rules themselves are wrong, and {} only because "
        "composition.followed executes correct rules beside the run",
        effects, report.noticed_in_rules(), share_text(report.noticed_in_rules(), effects),
        report.only_followed());
    document.answer += fmt::format(" (of each at most {} random runs that differ are judged)",
                                   EffectTrials::differing_runs);
  }
  document.elaboration =
      report.everybody
          ? fmt::format("killed by property tests: {} of the {} that a run can show ({})",
                        report.killed_by_laws(), report.tried_on_laws(),
                        share_text(report.killed_by_laws(), report.tried_on_laws()))
          : "runs are asked first, then proofs and searches, until somebody notices; "
            "--everybody asks all properties and laws";
  if (report.interrupted) {
    document.blocks.emplace_back(
        Paragraph{"Interrupted: the other mutants were not tried.", report::Tone::warn});
  }
  document.blocks.emplace_back(mutants_table(report));
  if (report.seen_at_effects() > 0) {
    document.blocks.emplace_back(
        report::Section{"If the rules themselves are wrong", "shares", {shares_table(report)}});
  }
  const auto of_property = [&](auto id) { return report.killed_by(id); };
  const auto of_law = [&](auto id) { return report.killed_by_law(id); };
  document.blocks.emplace_back(
      report::Section{report.everybody ? "Who notices how many" : "Who notices how many first",
                      "noticed",
                      {counts_table("property", props::catalogue(), of_property),
                       counts_table("law", props::laws(), of_law)}},
      report::Audience::verbose);
  add_survivors(document, report);
  for (const MutantResult& mutant : report.mutants) {
    document.findings.push_back(finding_of(mutant, report.everybody));
  }
  document.complete = !report.interrupted;
  document.seconds = report.seconds;
  return document;
}

}  // namespace stormproof::mutate
