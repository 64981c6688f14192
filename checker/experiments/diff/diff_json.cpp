// A comparison as JSON; specs/guide/output.md describes the keys. What does not exist is null, what
// is infinite is text ("infinity"), as JSON has no number for it.
#include <cmath>

#include <nlohmann/json.hpp>

#include "checker/experiments/diff/diff_report.hpp"
#include "checker/experiments/diff/summary.hpp"
#include "model/config/knobs/effective.hpp"

namespace stormproof::diff {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  if (std::isnan(value)) return nullptr;
  if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
  return value;
}

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json place_json(const model::config::Place& place) {
  if (!place.source) return nullptr;
  return {{"source", *place.source}, {"line", place.line}, {"column", place.column}};
}

Json profile_json(const model::config::TracedProfile& profile) {
  Json json;
  json["name"] = profile.reference;
  json["preset"] = profile.preset.empty() ? Json(nullptr) : Json(profile.preset);
  json["profile"] = model::config::effective_json(profile.profile);
  return json;
}

Json knobs_json(const Comparison& profiles) {
  Json changes = Json::array();
  for (const KnobChange& change : profiles.changes) {
    changes.push_back({{"key", change.key},
                       {"before", change.before},
                       {"after", change.after},
                       {"before_place", place_json(change.before_place)},
                       {"after_place", place_json(change.after_place)},
                       {"matters", change.modelled ? Json(change.matters) : Json(nullptr)},
                       {"why", change.why}});
  }
  return {{"relation", name_of(profiles.relation)},
          {"proof", profiles.proof.empty() ? Json(nullptr) : Json(profiles.proof)},
          {"changes", changes}};
}

Json counterexample_json(const props::Counterexample& run) {
  return {{"event", run.event}, {"time_ns", run.time.count()}, {"reason", run.reason}};
}

Json file_json(const Files& files, const std::string& what) {
  const auto file = files.find(what);
  return file == files.end() ? Json(nullptr) : Json(file->second);
}

Json verdicts_json(const VerdictComparison& verdicts, const Files& files) {
  if (!verdicts.done) return nullptr;
  Json properties = Json::array();
  for (const VerdictChange& change : verdicts.properties) {
    Json property;
    property["property"] = change.property;
    property["before"] = props::name_of(change.before);
    property["after"] = props::name_of(change.after);
    property["judgment"] = name_of(change.judgment);
    property["statement"] = change.statement;
    property["before_how"] = change.before_how;
    property["after_how"] = change.after_how;
    property["counterexample"] = nullptr;
    if (change.counterexample) {
      property["counterexample"] = counterexample_json(*change.counterexample);
      property["counterexample"]["file"] = file_json(files, change.property);
    }
    properties.push_back(std::move(property));
  }
  return {{"scenario", verdicts.scenario}, {"properties", properties}};
}

Json quantiles_json(const sampling::Quantiles& quantiles) {
  return {{"median", number(quantiles.median)},
          {"p10", number(quantiles.p10)},
          {"p90", number(quantiles.p90)},
          {"min", number(quantiles.min)},
          {"max", number(quantiles.max)}};
}

Json measure_json(const MeasuredChange& change) {
  Json json;
  json["before"] = quantiles_json(change.before);
  json["after"] = quantiles_json(change.after);
  json["shift"] = nullptr;
  if (change.shift) {
    json["shift"] = {{"estimate", number(change.shift->estimate)},
                     {"low", number(change.shift->low)},
                     {"high", number(change.shift->high)},
                     {"confidence", change.shift->confidence},
                     {"exact", change.shift->exact}};
  }
  json["relative"] = nullptr;
  if (change.relative) {
    json["relative"] = {{"estimate", number(change.relative)},
                        {"low", number(change.relative_low)},
                        {"high", number(change.relative_high)}};
  }
  json["judgment"] = name_of(change.judgment);
  json["reason"] = change.reason;
  return json;
}

Json configuration_json(const Configuration& configuration) {
  Json json;
  json["name"] = configuration.name;
  json["values"] = Json::object();
  for (const auto& [key, value] : configuration.values) json["values"][key] = value;
  json["hosts"] = configuration.hosts;
  json["participants"] = configuration.participants;
  json["descriptors"] = configuration.descriptors;
  json["samples"] = configuration.samples;
  json["identical_runs"] = configuration.identical_runs;
  json["storm_before"] = configuration.storm_before;
  json["storm_after"] = configuration.storm_after;
  for (const MeasuredChange& change : configuration.measures) {
    json["measures"][name_of(change.measure)] = measure_json(change);
  }
  json["crossings"] = Json::array();
  for (const LimitCrossing& crossing : configuration.crossings) {
    json["crossings"].push_back({{"limit", crossing.limit},
                                 {"text", crossing.text},
                                 {"before", crossing.before},
                                 {"after", crossing.after},
                                 {"judgment", name_of(crossing.judgment)}});
  }
  return json;
}

Json costs_json(const CostComparison& costs) {
  if (costs.wanted == 0) return nullptr;
  Json json;
  json["grid"] = costs.grid;
  json["samples"] = costs.samples;
  json["seed"] = costs.seed;
  json["wanted"] = costs.wanted;
  json["confidence"] = costs.confidence;
  json["configurations"] = Json::array();
  for (const Configuration& configuration : costs.configurations) {
    json["configurations"].push_back(configuration_json(configuration));
  }
  json["pooled"] = Json::array();
  for (const PooledChange& pooled : costs.pooled) {
    json["pooled"].push_back({{"measure", name_of(pooled.measure)},
                              {"configurations", pooled.configurations},
                              {"pairs", pooled.pairs},
                              {"estimate", number(pooled.estimate)},
                              {"low", number(pooled.low)},
                              {"high", number(pooled.high)},
                              {"confidence", pooled.confidence},
                              {"judgment", name_of(pooled.judgment)}});
  }
  return json;
}

Json margin_json(const Margin& margin) {
  Json json;
  json["threshold_ns"] = margin.threshold ? Json(margin.threshold->count()) : Json(nullptr);
  json["unlimited"] = margin.unlimited;
  json["formula"] = margin.formula;
  json["load"] = margin.load ? Json(*margin.load) : Json(nullptr);
  json["load_configuration"] = margin.load_configuration;
  return json;
}

Json telling_apart_json(const TellingApart& apart, const Files& files) {
  Json json;
  json["found"] = apart.found;
  json["how"] = apart.how;
  json["tried"] = apart.tried;
  json["finished"] = apart.finished;
  if (!apart.found) return json;
  json["difference"] = apart.difference;
  json["event"] = apart.event;
  json["scenario"] = model::config::effective_json(apart.scenario);
  json["candidate"] = model::config::effective_json(apart.candidate);
  json["base_run"] = counterexample_json(apart.base_run);
  json["candidate_run"] = counterexample_json(apart.candidate_run);
  json["files"] = Json::object();
  for (const auto& [what, file] : files) {
    if (what.starts_with("telling-apart")) json["files"][what] = file;
  }
  return json;
}

Json blame_json(const Blame& blame) {
  Json entries = Json::array();
  for (const Blame::Entry& entry : blame.entries) {
    entries.push_back({{"reverted", entry.reverted},
                       {"completion_median_ns", number(entry.completion_median)},
                       {"messages_median", number(entry.messages_median)},
                       {"cures", entry.cures}});
  }
  return {{"configuration", blame.configuration}, {"entries", entries}};
}

}  // namespace

Json to_json(const DiffReport& report, const Files& files) {
  const bool ran = report.costs.wanted > 0;
  Json json;
  json["judgment"] = name_of(report.judgment);
  json["summary"] = std::string{headline(report)} + ": " + headline_sentence(report);
  json["reasons"] = report.reasons;
  json["policy"] = report.policy.name;
  json["interrupted"] = report.interrupted;
  json["seconds"] = report.seconds;
  json["command"] = report.command;
  json["base"] = profile_json(report.base);
  json["candidate"] = profile_json(report.candidate);
  json["knobs"] = knobs_json(report.profiles);
  json["verdicts"] = verdicts_json(report.verdicts, files);
  json["costs"] = costs_json(report.costs);
  json["margin"] = nullptr;
  if (ran) {
    json["margin"] = {{"before", margin_json(report.margin.before)},
                      {"after", margin_json(report.margin.after)},
                      {"judgment", name_of(report.margin.judgment)},
                      {"reason", report.margin.reason}};
  }
  json["blame"] = report.blame ? blame_json(*report.blame) : Json(nullptr);
  json["telling_apart"] = ran ? telling_apart_json(report.telling_apart, files) : Json(nullptr);
  return json;
}

}  // namespace stormproof::diff
