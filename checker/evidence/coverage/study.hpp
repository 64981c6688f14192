// One comparison of measurements with predictions, from the rows of a file to all statistics: what
// `stormproof coverage` does.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/coverage/effect.hpp"
#include "checker/evidence/coverage/statistics.hpp"

namespace stormproof::prediction {

struct StudyRequest {
  std::vector<std::string> dds;  ///< profiles, at least one
  std::string wireless;
  std::vector<std::string> overrides;  ///< of all scenarios
  std::vector<std::string> change;     ///< of all but the baseline's
  std::string baseline;                ///< profile; empty: none
  ChannelSource channel = ChannelSource::profile;
  std::vector<std::string> words;   ///< as in `ScenarioOptions`
  std::vector<std::string> scopes;  ///< empty: all that occur
  PredictOptions predict;
};

/// Statistics of one profile in one scope for one measure.
struct FitRow {
  std::string scope;
  Measure measure{};
  Fit fit;
};

/// One profile on all configurations that it can predict.
struct ProfileStudy {
  std::string name;
  bool is_baseline = false;
  bool sampled = false;             ///< whether schedules or losses were drawn
  std::size_t measured_starts = 0;  ///< measured runs that say when each participant started
  std::size_t spread = 0;           ///< configurations whose starts follow one another, with hosts
  model::DdsProfile dds;            ///< of its scenarios
  std::map<std::string, std::size_t> skipped;  ///< measured runs of other channels, by difference
  std::vector<Configuration> configurations;
  std::vector<Prediction> predictions;  ///< one for each configuration
  std::vector<FitRow> rows;
  std::vector<Effect> effects;  ///< relative to the baseline, if there is one

  [[nodiscard]] std::vector<Pairing> pairings() const;
  /// What speaks for the whole: "all", or the first scope if somebody asked for some only. There
  /// are rows.
  [[nodiscard]] const std::string& overall_scope() const;
};

struct Study {
  std::vector<ProfileStudy> profiles;  ///< the baseline, if there is one, last
  bool interrupted = false;            ///< then only the runs that finished are evaluated
};

/// `rows` are the measurements; `baseline_rows` those of the baseline, if it was measured apart.
/// Without them, the changed system is predicted for the deployments of `rows`, which are taken to
/// be the baseline's.
[[nodiscard]] model::config::Result<Study> study(const std::vector<Observation>& rows,
                                                 const std::vector<Observation>& baseline_rows,
                                                 const StudyRequest& request);

}  // namespace stormproof::prediction
