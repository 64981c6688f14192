// The JSON of what two profiles cost, configuration by configuration.
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <variant>

#include "checker/experiments/diff/diff.hpp"
#include "checker/experiments/statistics/quantiles_json.hpp"
#include "checker/presentation/json/type.hpp"

namespace stormproof::diff {

/// A number, or which infinity.
using Extended = std::variant<double, std::string>;

inline Extended number(double value) {
  if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
  return value;
}

inline std::optional<Extended> number(const std::optional<double>& value) {
  return value ? std::optional{number(*value)} : std::nullopt;
}

/// As the JSON of runs has it.
inline std::string key_of(Measure measure) {
  if (measure == Measure::completion) return "t_disc_ns";
  return measure == Measure::backlog ? "peak_packets" : name_of(measure);
}

struct ShownShift {
  const Shift& shift;
};

template <class V>
void describe(V& v, const ShownShift& shown) {
  v("estimate", number(shown.shift.estimate));
  v("low", number(shown.shift.low));
  v("high", number(shown.shift.high));
  v("confidence", shown.shift.confidence);
  v("exact", shown.shift.exact);
}

struct Relative {
  const MeasuredChange& change;
};

template <class V>
void describe(V& v, const Relative& relative) {
  v("estimate", number(relative.change.relative));
  v("low", number(relative.change.relative_low));
  v("high", number(relative.change.relative_high));
}

template <class V>
void describe(V& v, const MeasuredChange& change) {
  std::optional<ShownShift> shift;
  if (change.shift) shift.emplace(ShownShift{*change.shift});
  std::optional<Relative> relative;
  if (change.relative) relative.emplace(Relative{change});
  v("before", change.before);
  v("after", change.after);
  v("shift", shift);
  v("relative", relative);
  v("verdict", change.judgment);
  v("reason", change.reason);
}

template <class V>
void describe(V& v, const LimitCrossing& crossing) {
  v("id", crossing.limit);
  v("text", crossing.text);
  v("before", crossing.before);
  v("after", crossing.after);
  v("verdict", crossing.judgment);
}

struct MeasuresOf {
  const Configuration& configuration;
};

template <class V>
void describe(V& v, const MeasuresOf& all) {
  for (const MeasuredChange& change : all.configuration.measures) v(key_of(change.measure), change);
}

template <class V>
void describe(V& v, const Configuration& configuration) {
  std::map<std::string, std::string> values;
  for (const auto& [key, value] : configuration.values) values[key] = value;
  v("name", configuration.name);
  v("swept", values);
  v("hosts", configuration.hosts);
  v("participant_count", configuration.participants);
  v("descriptor_count", configuration.descriptors);
  v("runs", configuration.samples);
  v("identical_runs", configuration.identical_runs);
  v("cut_at_ns", configuration[Measure::completion].cut_at);
  v("storm_before", configuration.storm_before);
  v("storm_after", configuration.storm_after);
  v("measures", MeasuresOf{configuration});
  v("crossings", configuration.crossings);
}

template <class V>
void describe(V& v, const PooledChange& pooled) {
  v("measure", key_of(pooled.measure));
  v("configuration_count", pooled.configurations);
  v("runs", pooled.pairs);
  v("estimate", number(pooled.estimate));
  v("low", number(pooled.low));
  v("high", number(pooled.high));
  v("confidence", pooled.confidence);
  v("verdict", pooled.judgment);
}

template <class V>
void describe(V& v, const CostComparison& costs) {
  v("grid", costs.grid);
  v("wanted", costs.samples);
  v("seed", costs.seed);
  v("wanted_configurations", costs.wanted);
  v("confidence", costs.confidence);
  v("configurations", costs.configurations);
  v("pooled", costs.pooled);
}

/// Each measure is there, by its name.
inline Configuration example_of(report::Type<Configuration>) {
  Configuration configuration;
  for (std::size_t k = 0; k < common_measure_count; ++k) {
    configuration.measures[k].measure = static_cast<Measure>(k);
  }
  return configuration;
}

}  // namespace stormproof::diff
