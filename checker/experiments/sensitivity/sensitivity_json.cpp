// Everything the report knows, with ranks for both measures.
#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "checker/experiments/sensitivity/sensitivity_report.hpp"
#include "checker/presentation/text/assumptions.hpp"

namespace stormproof::sensitivity {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Effect& effect, const char* median_key) {
  return {{median_key, effect.median},
          {"low", effect.low},
          {"high", effect.high},
          {"confidence", effect.confidence},
          {"exactly_zero", effect.exactly_zero}};
}

Json to_json(const Effects& effects) {
  return {{"completion", to_json(of(effects, Measure::completion), "median_ns")},
          {"messages", to_json(of(effects, Measure::messages), "median")}};
}

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

Json to_json(const KnobResult& knob) {
  Json json{{"key", knob.key}, {"value", knob.value}, {"doc", knob.doc}};
  if (!knob.obstacle.empty()) json["obstacle"] = knob.obstacle;
  return json;
}

Json levels_of(const KnobResult& knob) {
  Json levels = Json::array();
  for (const Direction direction : directions) {
    const auto& level = knob.levels[static_cast<std::size_t>(direction)];
    if (!level) continue;
    Json json{{"direction", name_of(direction)}, {"value", level->value}};
    json.update(to_json(level->effects));
    json["incomplete"] = level->incomplete;
    levels.push_back(std::move(json));
  }
  return levels;
}

}  // namespace

Json to_json(const Report& report, const Description& description) {
  const Options& options = description.options;
  Json json{{"scenario", description.scenario},
            {"command", description.command},
            {"range", options.range},
            {"samples", report.samples},
            {"seed", options.first_seed},
            {"start_jitter_ns", options.start_jitter.count()},
            {"sampled", description.is_sampled()},
            {"by", name_of(options.by)},
            {"finished", report.finished},
            {"runs", report.runs},
            {"base",
             {{"completion_ns", report.base[0]},
              {"messages", report.base[1]},
              {"incomplete", report.incomplete}}}};
  const auto by_completion = ranks(report, Measure::completion);
  const auto by_messages = ranks(report, Measure::messages);
  report::add_unmodelled(json, description.dds);
  json["knobs"] = Json::array();
  for (const KnobResult& knob : report.knobs) {
    Json entry = to_json(knob);
    entry["rank_completion"] = by_completion.at(knob.key);
    entry["rank_messages"] = by_messages.at(knob.key);
    entry["levels"] = levels_of(knob);
    json["knobs"].push_back(std::move(entry));
  }
  json["not_varied"] = Json::array();
  for (const KnobResult& knob : report.unvaried) json["not_varied"].push_back(to_json(knob));
  json["pairs"] = Json::array();
  for (const PairResult& pair : report.pairs) {
    json["pairs"].push_back(
        {{"keys", pair.keys},
         {"directions", {name_of(pair.directions[0]), name_of(pair.directions[1])}},
         {"joint", to_json(pair.joint)},
         {"interaction", to_json(pair.interaction)}});
  }
  return json;
}

}  // namespace stormproof::sensitivity
