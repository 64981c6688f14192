// Everything the report knows, with ranks for both measures.
#include <algorithm>
#include <map>
#include <vector>

#include "checker/experiments/sensitivity/sensitivity_report.hpp"
#include "checker/presentation/json/schema.hpp"

namespace stormproof::sensitivity {

namespace {

/// Rank from 1 of each knob; equal effects share a rank.
std::map<std::string, std::size_t> ranks(const Report& report, Measure measure) {
  std::map<std::string, std::size_t> rank;
  for (const KnobResult& knob : report.knobs) {
    rank[knob.key] = 1 + static_cast<std::size_t>(
                             std::ranges::count_if(report.knobs, [&](const KnobResult& other) {
                               return other.swing(measure) > knob.swing(measure);
                             }));
  }
  return rank;
}

}  // namespace

template <class V>
void describe(V& v, const Effect& effect) {
  v("estimate", effect.median);
  v("low", effect.low);
  v("high", effect.high);
  v("confidence", effect.confidence);
  v("exactly_zero", effect.exactly_zero);
}

namespace {

/// On both measures.
struct OnBoth {
  const Effects& effects;
};

template <class V>
void describe(V& v, const OnBoth& both) {
  v("t_disc_ns", of(both.effects, Measure::completion));
  v("messages", of(both.effects, Measure::messages));
}

struct DirectedLevel {
  Direction direction{};
  const LevelResult& level;
};

template <class V>
void describe(V& v, const DirectedLevel& one) {
  v("direction", one.direction);
  v("value", one.level.value);
  describe(v, OnBoth{one.level.effects});
  v("incomplete", one.level.incomplete);
}

}  // namespace

template <class V>
void describe(V& v, const PairResult& pair) {
  v("keys", pair.keys);
  v("directions", pair.directions);
  v("joint", OnBoth{pair.joint});
  v("interaction", OnBoth{pair.interaction});
}

/// What is known of a knob before it is varied.
template <class V>
void describe(V& v, const KnobResult& knob) {
  v("key", knob.key);
  v("value", knob.value);
  v("doc", knob.doc);
  v.unless_empty("obstacle", knob.obstacle);
}

namespace {

struct RankedKnob {
  const KnobResult& knob;
  std::size_t rank_completion = 0, rank_messages = 0;
};

template <class V>
void describe(V& v, const RankedKnob& ranked) {
  std::vector<DirectedLevel> levels;
  for (const Direction direction : directions) {
    const auto& level = ranked.knob.levels[static_cast<std::size_t>(direction)];
    if (level) levels.push_back({direction, *level});
  }
  describe(v, ranked.knob);
  v("rank_completion", ranked.rank_completion);
  v("rank_messages", ranked.rank_messages);
  v("levels", levels);
}

/// The medians of the unchanged scenario.
struct Base {
  const Report& report;
};

struct TotalOfBase {
  const Report& report;
};

template <class V>
void describe(V& v, const TotalOfBase& base) {
  v("total", base.report.base[1]);
}

template <class V>
void describe(V& v, const Base& base) {
  v("t_disc_ns", base.report.base[0]);
  v("counts", TotalOfBase{base.report});
  v("incomplete", base.report.incomplete);
}

struct DescribedReport {
  const Report& report;
  const Description& description;
};

template <class V>
void describe(V& v, const DescribedReport& shown) {
  const Report& report = shown.report;
  const Options& options = shown.description.options;
  const auto by_completion = ranks(report, Measure::completion);
  const auto by_messages = ranks(report, Measure::messages);
  std::vector<RankedKnob> knobs;
  for (const KnobResult& knob : report.knobs) {
    knobs.push_back({knob, by_completion.at(knob.key), by_messages.at(knob.key)});
  }
  v("scenario", shown.description.scenario);
  v("range", options.range);
  v("wanted", options.samples);
  v("runs_each", report.samples);
  v("seed", options.first_seed);
  v("start_jitter_ns", options.start_jitter);
  v("sampled", shown.description.is_sampled());
  v("by", options.by);
  v("runs", report.runs);
  v("fitted_into_time", report.unasked.lacked_time());
  v("cut_at_ns", report.cut_at);
  v("not_asked", sentences_of(report.unasked));
  v("base", Base{report});
  v.unless_empty("unmodelled", shown.description.dds.unmodelled);
  v("knobs", knobs);
  v("not_varied", report.unvaried);
  v("pairs", report.pairs);
}

}  // namespace

nlohmann::ordered_json to_json(const Report& report, const Description& description) {
  return report::json_of(DescribedReport{report, description});
}

nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<DescribedReport>(definitions);
}

}  // namespace stormproof::sensitivity
