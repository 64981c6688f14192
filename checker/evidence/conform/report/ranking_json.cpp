// The ranking for programs.
#include <algorithm>
#include <optional>

#include "checker/evidence/capture/describe_capture.hpp"
#include "checker/evidence/conform/report/describe_bounds.hpp"
#include "checker/evidence/conform/report/findings.hpp"
#include "checker/evidence/conform/report/ranking_report.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::conform {

template <class V>
void describe(V& v, const NotHeld& one) {
  v("profile_name", one.name);
  v("why", one.why);
}

static RankingReport example_of(report::Type<RankingReport>) {
  static const auto conversation = example_of(report::Type<capture::Conversation>{});
  static const Ranking ranking;
  return {conversation, ranking};
}

namespace {

struct RankedRow {
  const RankingReport& report;
  const Ranked& ranked;
};

struct FirstFault {
  const RankingReport& report;
  const Unexplained& first;
};

template <class V>
void describe(V& v, const FirstFault& one) {
  v("event", one.first.event);
  v("time_ns", one.report.conversation.events.at(one.first.event).time_ns);
  v("fault", one.first.fault);
  v("what", one.first.what);
  v("nearest", one.first.nearest);
}

template <class V>
void describe(V& v, const RankedRow& row) {
  const Conformance& result = row.ranked.result;
  v("profile_name", row.ranked.name);
  const auto of = row.report.distributions.find(row.ranked.name);
  v("distributions", of == row.report.distributions.end() ? "" : of->second);
  v("verdict", verdict_token(result.verdict));
  v.unless_empty("why_inconclusive", result.why_inconclusive);
  v("checked", result.checked);
  v("explained", result.explained);
  v("lost", result.lost);
  v("unexplained_count", result.unexplained.size());
  std::optional<FirstFault> first;
  if (!result.unexplained.empty())
    first.emplace(FirstFault{row.report, result.unexplained.front()});
  v.unless_empty("first_unexplained", first);
}

}  // namespace

template <class V>
void describe(V& v, const RankingReport& report) {
  const Ranking& ranking = report.ranking;
  std::vector<std::string> best;
  for (std::size_t k = 0; k < ranking.best; ++k) best.push_back(ranking.ranked[k].name);
  std::vector<RankedRow> rows;
  for (const Ranked& one : ranking.ranked) rows.push_back({report, one});
  v("verdict", verdict_token(ranking.verdict()));
  v("best", best);
  v("captures", report.conversation.captures);
  v("first_ns", report.conversation.first_ns);
  v("until_ns", std::min(report.until_ns, report.conversation.last_ns));
  v("bounds", report.bounds);
  v("profiles", rows);
  v("not_held", ranking.not_held);
}

nlohmann::ordered_json to_json(const RankingReport& report) { return report::json_of(report); }

nlohmann::ordered_json ranking_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<RankingReport>(definitions);
}

}  // namespace stormproof::conform
