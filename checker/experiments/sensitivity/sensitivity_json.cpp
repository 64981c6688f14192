// Everything the report knows, with ranks for both measures.
#include <algorithm>
#include <map>

#include "checker/experiments/sensitivity/sensitivity_report.hpp"
#include "checker/presentation/json/describe.hpp"

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
  v("median", effect.median);
  v("low", effect.low);
  v("high", effect.high);
  v("confidence", effect.confidence);
  v("exactly_zero", effect.exactly_zero);
}

/// On both measures.
template <class V>
void describe_effects(V& v, const Effects& effects) {
  v("t_disc_ns", of(effects, Measure::completion));
  v("messages", of(effects, Measure::messages));
}

static nlohmann::ordered_json effects_json(const Effects& effects) {
  report::JsonObject v;
  describe_effects(v, effects);
  return std::move(v).take();
}

template <class V>
void describe(V& v, const PairResult& pair) {
  v("keys", pair.keys);
  v("directions", pair.directions);
  v("joint", effects_json(pair.joint));
  v("interaction", effects_json(pair.interaction));
}

/// What is known of a knob before it is varied.
template <class V>
void describe(V& v, const KnobResult& knob) {
  v("key", knob.key);
  v("value", knob.value);
  v("doc", knob.doc);
  if (!knob.obstacle.empty()) v("obstacle", knob.obstacle);
}

static nlohmann::ordered_json levels_json(const KnobResult& knob) {
  nlohmann::ordered_json levels = nlohmann::ordered_json::array();
  for (const Direction direction : directions) {
    const auto& level = knob.levels[static_cast<std::size_t>(direction)];
    if (!level) continue;
    report::JsonObject v;
    v("direction", direction);
    v("value", level->value);
    describe_effects(v, level->effects);
    v("incomplete", level->incomplete);
    levels.push_back(std::move(v).take());
  }
  return levels;
}

nlohmann::ordered_json to_json(const Report& report, const Description& description) {
  const Options& options = description.options;
  report::JsonObject base;
  base("t_disc_ns", report.base[0]);
  base("messages", report.base[1]);
  base("incomplete", report.incomplete);
  nlohmann::ordered_json knobs = nlohmann::ordered_json::array();
  const auto by_completion = ranks(report, Measure::completion);
  const auto by_messages = ranks(report, Measure::messages);
  for (const KnobResult& knob : report.knobs) {
    report::JsonObject entry;
    describe(entry, knob);
    entry("rank_completion", by_completion.at(knob.key));
    entry("rank_messages", by_messages.at(knob.key));
    entry("levels", levels_json(knob));
    knobs.push_back(std::move(entry).take());
  }
  report::JsonObject v;
  v("scenario", description.scenario);
  v("command", description.command);
  v("range", options.range);
  v("samples", report.samples);
  v("seed", options.first_seed);
  v("start_jitter_ns", options.start_jitter);
  v("sampled", description.is_sampled());
  v("by", options.by);
  v("finished", report.finished);
  v("runs", report.runs);
  v("base", std::move(base).take());
  v.unless_empty("unmodelled", description.dds.unmodelled);
  v("knobs", knobs);
  v("not_varied", report.unvaried);
  v("pairs", report.pairs);
  return std::move(v).take();
}

}  // namespace stormproof::sensitivity
