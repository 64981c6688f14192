// Runs scenarios with the trace writers on, and keeps what they wrote.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "model/simulator.hpp"
#include "model/trace/effect_names.hpp"

namespace stormproof::model::trace {

/// The trace of one run.
struct Recording {
  RunResult result;
  std::string text;                ///< the whole file
  std::vector<std::string> lines;  ///< without line feeds
  nlohmann::ordered_json header;
  std::vector<nlohmann::ordered_json> events;
  nlohmann::ordered_json end;
};

using OnProgress = std::function<bool(const Progress&)>;

[[nodiscard]] Recording record(const Scenario& scenario, const OnProgress& on_progress = {},
                               Effects effects = Effects::left_out);

/// The timeline of one run.
struct Timeline {
  RunResult result;
  nlohmann::ordered_json document;
};
[[nodiscard]] Timeline record_timeline(const Scenario& scenario, const OnProgress& on_progress = {},
                                       Effects effects = Effects::left_out);

/// A scenario and its name, for parametrised tests, which copy it often.
struct Case {
  Case(std::string its_name, Scenario its_scenario)
      : name{std::move(its_name)},
        shared{std::make_shared<const Scenario>(std::move(its_scenario))} {}
  [[nodiscard]] const Scenario& scenario() const { return *shared; }

  std::string name;
  std::shared_ptr<const Scenario> shared;
};
/// The trace and the timeline of a case, recorded once in a process.
[[nodiscard]] const Recording& recorded(const Case& recorded_case);
[[nodiscard]] const Timeline& recorded_timeline(const Case& recorded_case);
/// One scenario for each thing that changes what a trace contains.
[[nodiscard]] const std::vector<Case>& trace_cases();
[[nodiscard]] const Scenario& case_named(const std::string& name);
/// Not one of them: participants of Fast DDS that were there before, are out of reach, are
/// forgotten and come back, whose machines are new ones then.
[[nodiscard]] Scenario living_scenario();
/// Nor this: a run of more events than pass between two calls of `on_progress`.
[[nodiscard]] Scenario long_scenario();

/// The name of a case, for the names of parametrised tests.
struct CaseName {
  template <class Info>
  std::string operator()(const Info& info) const {
    return info.param.name;
  }
};
inline std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

/// Lines with their line feeds, as a file.
[[nodiscard]] std::string joined(const std::vector<std::string>& lines);

}  // namespace stormproof::model::trace
