// Collects the reasons, worst first.
#include "checker/experiments/diff/summary.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/experiments/diff/judging.hpp"
#include "checker/experiments/diff/words.hpp"

namespace stormproof::diff {

namespace {

struct Reason {
  Judgment judgment{};
  std::string sentence;
};

using Reasons = std::vector<Reason>;

void add_verdicts(const DiffReport& report, Reasons& reasons) {
  for (const VerdictChange& change : report.verdicts.properties) {
    reasons.push_back(
        {change.judgment, fmt::format("{} is {} with the base and {} with the candidate ({})",
                                      change.property, props::name_of(change.before),
                                      props::name_of(change.after), report.verdicts.scenario)});
  }
}

/// What the policy asks and there was no time for is not known to be no regression.
void add_unasked(const DiffReport& report, Reasons& reasons) {
  if (!report.policy.verdicts) return;
  for (const std::string& what : report.unasked.left_out) {
    reasons.push_back({Judgment::unclear, "there was no time for " + what});
  }
}

void add_costs(const DiffReport& report, Reasons& reasons) {
  for (const Configuration& configuration : report.costs.configurations) {
    for (const MeasuredChange& change : configuration.measures) {
      if (!is_judged(report.policy, change.measure)) continue;
      reasons.push_back({change.judgment, fmt::format("{} at {}: {}", words_of(change.measure),
                                                      configuration.name, change.reason)});
    }
    for (const LimitCrossing& crossing : configuration.crossings) {
      reasons.push_back(
          {crossing.judgment,
           fmt::format("limit {} at {}: exceeded by {} of the runs before, by {} after",
                       crossing.text, configuration.name, share_text(crossing.before),
                       share_text(crossing.after))});
    }
  }
}

void add_profiles(const DiffReport& report, Reasons& reasons) {
  if (report.profiles.relation != Relation::unmodelled) return;
  std::string settings;
  for (const KnobChange& change : report.profiles.changes) {
    constexpr std::string_view prefix = "unmodelled.";
    if (!change.key.starts_with(prefix)) continue;
    settings += (settings.empty() ? "" : ", ") + change.key.substr(prefix.size());
  }
  reasons.push_back({Judgment::unclear,
                     "the profiles differ only in settings that the model has "
                     "not: " +
                         settings});
}

std::string worse_sentence(const DiffReport& report) {
  std::size_t better = 0;
  std::size_t worse = 0;
  for (const Configuration& configuration : report.costs.configurations) {
    const Judgment judgment = judgment_of(configuration, report.policy);
    better += judgment == Judgment::better ? 1 : 0;
    worse += judgment == Judgment::worse ? 1 : 0;
  }
  return fmt::format(
      "What is worse with the candidate stays within the policy; of {} it is better "
      "in {} and worse in {}.",
      plural(report.costs.configurations.size(), "configuration"), better, worse);
}

}  // namespace

void summarize(DiffReport& report) {
  Reasons reasons;
  add_profiles(report, reasons);
  add_verdicts(report, reasons);
  add_costs(report, reasons);
  add_unasked(report, reasons);
  reasons.push_back({report.margin.judgment, "storm-free margin: " + report.margin.reason});
  if (report.interrupted) {
    reasons.push_back({Judgment::unclear, "the comparison was interrupted"});
  }
  std::vector<Judgment> all;
  for (const Reason& reason : reasons) all.push_back(reason.judgment);
  report.judgment = together(all);
  std::erase_if(reasons, [](const Reason& reason) {
    return badness(reason.judgment) < badness(Judgment::unclear);
  });
  std::ranges::stable_sort(reasons, [](const Reason& a, const Reason& b) {
    return badness(a.judgment) > badness(b.judgment);
  });
  report.reasons.clear();
  for (Reason& reason : reasons) report.reasons.push_back(std::move(reason.sentence));
}

const char* headline(const DiffReport& report) {
  if (report.judgment == Judgment::regression) return "REGRESSION";
  return report.judgment == Judgment::unclear ? "INCONCLUSIVE" : "NO REGRESSION";
}

std::string headline_sentence(const DiffReport& report) {
  switch (report.profiles.relation) {
    case Relation::identical:
      return "The profiles are the same. " + report.profiles.proof;
    case Relation::equivalent:
      return "The profiles differ, but no run can tell them apart. " + report.profiles.proof;
    case Relation::elsewhere:
      return "No run that was compared can tell the profiles apart; they differ where somebody "
             "leaves, the network fails, or a host is crowded. " +
             report.profiles.proof;
    case Relation::unmodelled:
      return "The profiles differ only in settings that the model has not, so nothing is known "
             "about the difference.";
    case Relation::different:
      break;
  }
  switch (report.judgment) {
    case Judgment::regression:
      return "By the policy the candidate is worse than the base.";
    case Judgment::unclear:
      return report.interrupted
                 ? "The comparison was interrupted; what is known so far shows no regression."
                 : "No regression is shown, but something stays open.";
    case Judgment::better:
      return "The candidate is better than the base, and nothing that is judged is worse.";
    case Judgment::worse:
      return worse_sentence(report);
    case Judgment::same:
      break;
  }
  return "No change that the policy minds.";
}

}  // namespace stormproof::diff
