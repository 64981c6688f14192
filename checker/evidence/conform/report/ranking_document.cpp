// The ranking for people: who fits best and whether the capture tells, then a line for each.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "checker/evidence/conform/report/findings.hpp"
#include "checker/evidence/conform/report/names.hpp"
#include "checker/evidence/conform/report/ranking_report.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"

namespace stormproof::conform {

namespace {

using report::Column;
using report::Tone;

/// "a, b and c".
std::string listed(const std::vector<std::string>& names) {
  if (names.size() < 2) return fmt::format("{}", fmt::join(names, ""));
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

class RankingPage {
 public:
  explicit RankingPage(const RankingReport& report)
      : report_{report}, ranking_{report.ranking}, names_{report.conversation} {
    for (std::size_t k = 0; k < ranking_.best; ++k) best_.push_back(ranking_.ranked[k].name);
  }

  [[nodiscard]] std::string answer() const {
    const std::string untold =
        best_.size() > 1 ? "; this capture does not tell them apart" : std::string{};
    if (ranking_.left_out > 0) return so_far();
    switch (ranking_.verdict()) {
      case Verdict::conforms:
        return best_.size() > 1
                   ? fmt::format("{} explain every message{}", listed(best_), untold)
                   : fmt::format("{} explains every message, and no other shipped profile does",
                                 best_.front());
      case Verdict::does_not_conform:
        return fmt::format("No shipped profile explains this capture; {} {} closest, with {}{}",
                           listed(best_), best_.size() > 1 ? "come" : "comes",
                           explained(ranking_.ranked.front().result), untold);
      case Verdict::inconclusive:
        break;
    }
    if (best_.empty()) return "No profile was held against this capture";
    return fmt::format("It is not known which profile fits; of {}: {}", best_.front(),
                       ranking_.ranked.front().result.why_inconclusive);
  }

  [[nodiscard]] report::Table table() const {
    report::Table table{{{"profile"},
                         {"verdict"},
                         {"explained", Column::Align::right},
                         {"first event that it does not explain", Column::Align::left, true},
                         {"ROS 2", Column::Align::left, false, report::Audience::verbose}},
                        {}};
    for (std::size_t k = 0; k < ranking_.ranked.size(); ++k) {
      const Ranked& one = ranking_.ranked[k];
      const Conformance& result = one.result;
      const auto of = report_.distributions.find(one.name);
      table.rows.push_back(
          {{report::code(one.name), verdict_badge(result.verdict),
            report::grouped(result.explained), report::grouped(result.checked), share(result),
            first_of(result), of == report_.distributions.end() ? "" : of->second},
           k < ranking_.best});
    }
    return table;
  }

 private:
  /// What is known when not all profiles were tried.
  [[nodiscard]] std::string so_far() const {
    const std::size_t tried = ranking_.ranked.size();
    std::string text =
        fmt::format("INTERRUPTED after {} of {} profiles", tried, tried + ranking_.left_out);
    if (best_.empty()) return text;
    const Conformance& first = ranking_.ranked.front().result;
    return text + (first.verdict == Verdict::conforms
                       ? fmt::format("; {} explain{} every message", listed(best_),
                                     best_.size() > 1 ? "" : "s")
                       : fmt::format("; of these {} come{} closest, with {}", listed(best_),
                                     best_.size() > 1 ? "" : "s", explained(first)));
  }

  static report::Text verdict_badge(Verdict verdict) {
    switch (verdict) {
      case Verdict::conforms:
        return report::badge(Tone::good, "conforms");
      case Verdict::does_not_conform:
        return report::badge(Tone::bad, "does not");
      case Verdict::inconclusive:
        break;
    }
    return report::badge(Tone::warn, "unknown");
  }

  static std::string share(const Conformance& result) {
    return report::percent(static_cast<double>(result.explained),
                           static_cast<double>(result.checked));
  }

  static std::string explained(const Conformance& result) {
    return fmt::format("{} of {} events ({})", report::grouped(result.explained),
                       report::grouped(result.checked), share(result));
  }

  [[nodiscard]] std::string first_of(const Conformance& result) const {
    if (result.unexplained.empty()) return result.why_inconclusive;
    const Unexplained& first = result.unexplained.front();
    return fmt::format("{}: {}", names_.elapsed(names_.event(first.event).time_ns), first.what);
  }

  const RankingReport& report_;
  const Ranking& ranking_;
  Names names_;
  std::vector<std::string> best_;
};

Tone tone_of_ranking(Verdict verdict) {
  return verdict == Verdict::conforms           ? Tone::good
         : verdict == Verdict::does_not_conform ? Tone::bad
                                                : Tone::warn;
}

}  // namespace

report::Document document_of(const RankingReport& report) {
  const RankingPage page{report};
  report::Document document;
  document.title = "stormproof conform";
  document.tone =
      report.ranking.left_out > 0 ? Tone::warn : tone_of_ranking(report.ranking.verdict());
  document.answer = page.answer();
  const auto& ranked = report.ranking.ranked;
  document.elaboration = fmt::format(
      "{} held against {} within these bounds: {}. A place is followed up to its first event that "
      "nothing explains, so a share says how far a profile got.",
      report::plural(ranked.size(), "shipped profile"),
      ranked.empty() ? "the capture" : report::plural(ranked.front().result.checked, "event"),
      bounds_text(report.bounds));
  document.blocks.emplace_back(page.table());
  report::Bullets others;
  for (const NotHeld& one : report.ranking.not_held) {
    others.items.push_back(report::code(one.name) + (": " + one.why));
  }
  if (!others.items.empty()) {
    document.blocks.emplace_back(
        report::Section{"Not held against it", "not-held", {others}, true});
  }
  if (!report.next.empty()) {
    const bool fits = report.ranking.verdict() == Verdict::conforms;
    document.blocks.emplace_back(
        report::Paragraph{fits ? "How it explains them:" : "All that it does not explain:"});
    document.blocks.emplace_back(report::Command{report.next});
  }
  document.complete =
      report.ranking.left_out == 0 && report.ranking.verdict() != Verdict::inconclusive;
  return document;
}

}  // namespace stormproof::conform
