// The answer of a check: whether it passes and what kind of discovery it is, in one line; then the
// three questions behind it, which are never mixed.
#include "checker/verification/check/check_answer.hpp"

#include <map>

#include <fmt/core.h>

#include "checker/presentation/document/verdicts.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::checker {

namespace {

using props::VerdictKind;
using report::Paragraph;
using report::Table;
using report::Text;

std::string ids_of(const std::vector<std::string_view>& ids) {
  std::string text;
  for (const std::string_view id : ids) text += (text.empty() ? "" : ", ") + std::string{id};
  return text;
}

/// Whether the rules are known not to promise it, and nobody asks them to.
bool is_weakness(const PropertyResult& result, const CheckContext& context) {
  return !context.gate.rules.strict &&
         !applicability_of(*result.property, context.scenario).is_promised();
}

/// How many hold, and of them up to which delays, or in small scopes only.
class Holding {
 public:
  void add(std::string_view id, const props::Finding& answer) {
    ++count_;
    if (answer.kind == VerdictKind::bounded) {
      ++in_small_scopes_;
    } else if (answer.longest_delay) {
      up_to_[*answer.longest_delay].push_back(id);
    }
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] bool is_limited() const { return in_small_scopes_ > 0 || !up_to_.empty(); }
  /// "7 properties hold, 3 of them in small scopes; storm.single-copy if no packet takes longer
  /// than 10 µs (Δ*)".
  [[nodiscard]] std::string in_words() const {
    std::string text = count_ == 1 ? "1 property holds" : fmt::format("{} properties hold", count_);
    if (in_small_scopes_ == count_) {
      text += " in small scopes";
    } else if (in_small_scopes_ > 0) {
      text += fmt::format(", {} of them in small scopes", in_small_scopes_);
    }
    for (const auto& [delay, ids] : up_to_) {
      text += fmt::format("; {} if no packet takes longer than {} (Δ*)", ids_of(ids),
                          props::time_text(delay));
    }
    return text;
  }

 private:
  std::size_t count_ = 0;
  std::size_t in_small_scopes_ = 0;
  std::map<model::Nanoseconds, std::vector<std::string_view>> up_to_;
};

/// The answers to one question: what is violated, what nobody knows, how many hold.
Table::Row question_row(props::Reach reach, std::string_view question, const CheckReport& report,
                        const CheckContext& context) {
  std::vector<std::string_view> disputed, failing, possible, open;
  Holding holding;
  for (std::size_t k = 0; k < report.results.size(); ++k) {
    const PropertyResult& result = report.results[k];
    const props::Finding* const answer = answer_to(reach, result);
    if (answer == nullptr) continue;
    const bool margin = result.property->is_margin;
    const bool weak = (reach != props::Reach::deployment || margin) && is_weakness(result, context);
    if (result.verdict == VerdictKind::disputed)
      disputed.push_back(result.property->id);
    else if (answer->kind == VerdictKind::violated)
      (weak ? possible : failing).push_back(result.property->id);
    else if (holds(answer->kind))
      holding.add(result.property->id, *answer);
    else if (context.gate.standings[k] == Standing::open)
      open.push_back(result.property->id);
    else if (reach == props::Reach::deployment && margin)
      possible.push_back(result.property->id);
  }
  if (reach == props::Reach::deployment && context.gate.outlook != Standing::holds) {
    failing.insert(failing.begin(), context.gate.outlook_id);
  }
  std::string text;
  const auto add = [&](const char* word, const std::vector<std::string_view>& ids) {
    if (!ids.empty()) text += fmt::format("{}: {}; ", word, ids_of(ids));
  };
  add("disputed", disputed);
  add("violated", failing);
  add("not established", open);
  add("possible", possible);
  if (holding.count() > 0) {
    text += holding.in_words();
  } else if (text.ends_with("; ")) {
    text.resize(text.size() - 2);
  } else {
    text = "not asked";
  }
  const bool nothing = disputed.empty() && failing.empty() && open.empty() && possible.empty() &&
                       holding.count() == 0;
  const Text badge = !disputed.empty()      ? report::badge(VerdictKind::disputed)
                     : !failing.empty()     ? report::badge(report::Tone::bad, "no")
                     : nothing              ? report::badge(report::Tone::plain, "–")
                     : !open.empty()        ? report::badge(report::Tone::warn, "open")
                     : !possible.empty()    ? report::badge(report::Tone::info, "not promised")
                     : holding.is_limited() ? report::badge(report::Tone::good, "within limits")
                                            : report::badge(report::Tone::good, "yes");
  return {{std::string{question}, badge, text}};
}

void add_questions(report::Document& document, const CheckReport& report,
                   const CheckContext& context) {
  Table table{{{"question"}, {"answer"}, {"by", report::Column::Align::left, true}}, {}};
  table.rows.push_back(question_row(
      props::Reach::deployment, "does it hold in this deployment, as described?", report, context));
  table.rows.push_back(question_row(props::Reach::profile, "in every deployment with this profile?",
                                    report, context));
  table.rows.push_back(
      question_row(props::Reach::rules, "are the rules themselves sound?", report, context));
  document.blocks.emplace_back(std::move(table));
}

/// What a CI job wants to know.
const char* word_of(const Gate& gate) {
  if (gate.count(Standing::disputed) > 0) return "DISPUTED";
  return gate.exit_code == 0 ? "PASS" : gate.exit_code == 1 ? "FAIL" : "OPEN";
}

/// "; storm.single-copy is violated", "; 2 of 21 properties are violated".
std::string count_text(const CheckReport& report, const Gate& gate, Standing standing,
                       std::string_view word) {
  std::vector<std::string_view> ids;
  for (std::size_t k = 0; k < report.results.size(); ++k) {
    if (gate.standings[k] == standing) ids.push_back(report.results[k].property->id);
  }
  if (ids.empty()) return "";
  if (ids.size() == 1) return fmt::format("; {} is {}", ids.front(), word);
  return fmt::format("; {} of {} properties are {}", ids.size(), report.results.size(), word);
}

void say_whether_it_passes(report::Document& document, const CheckReport& report,
                           const CheckContext& context) {
  const Gate& gate = context.gate;
  document.exit_code = gate.exit_code;
  document.tone = gate.exit_code == 1 || gate.count(Standing::disputed) > 0 ? report::Tone::bad
                  : gate.exit_code == 0                                     ? report::Tone::good
                                                                            : report::Tone::warn;
  std::string answer = word_of(gate);
  if (report.outlook) {
    const bool fine = report.outlook->health() == exact::Health::fine;
    if (!fine) answer += ", " + report.outlook->headline();
    answer += ": " + report.outlook->sentence();
  } else if (gate.exit_code == 0) {
    const std::size_t all = report.results.size();
    answer += gate.count(Standing::unknown) == all
                  ? std::string{": nobody has looked at what was asked"}
              : all == 1 ? fmt::format(": {} is {}", report.results.front().property->id,
                                       name_of(report.results.front().verdict))
                         : fmt::format(": all {} properties hold", all);
  }
  const bool disputed = gate.count(Standing::disputed) > 0;
  answer += count_text(report, gate, Standing::disputed, "disputed");
  answer += count_text(report, gate, Standing::fails, "violated");
  if (gate.exit_code != 1 && !disputed)
    answer += count_text(report, gate, Standing::open, "not established");
  if (const std::size_t accepted = gate.count(Standing::accepted); accepted > 0) {
    answer += fmt::format("; {} accepted by the baseline", report::plural(accepted, "failure"));
  }
  document.answer = answer;
  const std::size_t possible = gate.count(Standing::possible);
  if (possible > 0) {
    document.elaboration =
        possible == 1 ? "Possible under other delays or losses: 1 known weakness of the rules."
                      : fmt::format(
                            "Possible under other delays or losses: {} known weaknesses of "
                            "the rules.",
                            possible);
  }
}

/// A line for each reason.
void add_inapplicable(report::Document& document, const CheckReport& report) {
  std::vector<std::pair<std::string_view, std::vector<std::string_view>>> by_reason;
  for (const auto& [id, reason] : report.not_applicable) {
    auto known = by_reason.begin();
    while (known != by_reason.end() && known->first != reason) ++known;
    if (known == by_reason.end()) known = by_reason.insert(known, {reason, {}});
    known->second.push_back(id);
  }
  for (const auto& [reason, ids] : by_reason) {
    const std::string what =
        ids.size() == 1 ? std::string{"1 property does not apply to this scenario"}
                        : fmt::format("{} properties do not apply to this composition", ids.size());
    document.blocks.emplace_back(Paragraph{
        fmt::format("{}, because {}: {}.", what, reason, ids_of(ids)), report::Tone::info});
  }
}

void add_subject(report::Document& document, const CheckReport& report,
                 const CheckContext& context) {
  std::string counts;
  for (const VerdictKind kind : props::verdict_kinds) {
    if (report.count(kind) == 0) continue;
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", report.count(kind), name_of(kind));
  }
  document.subject =
      report::code(context.name) +
      fmt::format(": {}, {}; {} ({:.1f} s)",
                  report::plural(context.scenario.deployment.participants.size(), "participant"),
                  model::traits_of(context.scenario.dds).rules, counts, report.seconds);
  if (report.interrupted) {
    document.blocks.emplace_back(
        Paragraph{"Interrupted: what was not checked is inconclusive.", report::Tone::warn});
  }
  add_inapplicable(document, report);
  for (const Failure& one : context.gate.outdated) {
    document.blocks.emplace_back(Paragraph{
        fmt::format("The baseline accepts {}, which does not fail any more.", one.property),
        report::Tone::info});
  }
}

}  // namespace

void add_answer(report::Document& document, const CheckReport& report,
                const CheckContext& context) {
  say_whether_it_passes(document, report, context);
  add_subject(document, report, context);
  add_questions(document, report, context);
}

}  // namespace stormproof::checker
