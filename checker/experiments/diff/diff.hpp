// `stormproof diff` without its command line: what a change of a DDS profile does to discovery.
// The answer has five parts, each of which can be looked at alone: the knobs that differ (and
// whether they can make a difference at all), the verdicts of the catalogue before and after, the
// costs over a grid of deployments, the storm-free margin, and the least scenario that tells the
// two profiles apart. A policy says what of it is a regression.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/experiments/statistics/measure.hpp"
#include "checker/experiments/statistics/paired.hpp"
#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/budget.hpp"
#include "checker/experiments/trials/runner.hpp"
#include "checker/experiments/trials/unasked.hpp"
#include "model/config/scenario_file.hpp"
#include "model/config/spec_path.hpp"
#include "model/scenario.hpp"
#include "props/verdict.hpp"

namespace stormproof::diff {

// --- the profiles -------------------------------------------------------------------------------

/// One knob of the profile that has different values.
struct KnobChange {
  std::string key;            ///< "sedp.heartbeat_period", or "unmodelled.SETTING"
  std::string before, after;  ///< as a file would say it; "–" where the profile has not got it
  model::config::Place before_place, after_place;
  bool modelled = true;  ///< false: a setting that the model has not; nobody knows if it matters
  bool matters = true;   ///< false: no rule of these profiles reads it (`why`)
  std::string why;       ///< empty, or why it makes no difference
};

/// What can be said about two profiles without running them.
enum class Relation : std::uint8_t {
  identical,   ///< every knob has the same value
  equivalent,  ///< knobs differ, but none of them is read by the rules that both profiles choose
  elsewhere,   ///< as one of the above where nobody leaves, the network does not fail and all find
               ///< a port; what differs acts where that is otherwise
  unmodelled,  ///< as one of the above, but they differ in settings that the model has not
  different
};

[[nodiscard]] const char* name_of(Relation relation);

struct Comparison {
  Relation relation = Relation::different;
  std::string proof;                ///< of all but `different`: the argument, some sentences
  std::vector<KnobChange> changes;  ///< in the order of the table
};

/// Equal normal forms have equal runs: knobs that no rule reads under the profile's own choices
/// (`adaptive.*` with the periodic policy, …) are set to their defaults.
[[nodiscard]] model::DdsProfile normal_form(const model::DdsProfile& profile);

[[nodiscard]] Comparison compare_profiles(const model::config::TracedProfile& base,
                                          const model::config::TracedProfile& candidate);

// --- the verdicts -------------------------------------------------------------------------------

enum class Judgment : std::uint8_t {
  better,
  same,   ///< no change, or none that the policy minds
  worse,  ///< a change for the worse that the policy allows
  regression,
  unclear  ///< the samples do not settle whether it is a regression
};
[[nodiscard]] const char* name_of(Judgment judgment);

struct VerdictChange {
  std::string property;
  std::string statement;
  props::VerdictKind before{}, after{};
  std::string before_how, after_how;
  Judgment judgment = Judgment::same;
  std::optional<props::Counterexample> counterexample;  ///< of the side that violates it
};

struct VerdictComparison {
  bool done = false;  ///< false: left out by request
  std::string scenario;
  std::vector<VerdictChange> properties;  ///< all of the catalogue, in its order
};

// --- the costs over a grid ----------------------------------------------------------------------

using statistics::common_measure_count;
using statistics::Measure;
/// "ns", "packets", …; empty for counts and ratios.
[[nodiscard]] const char* unit_of(Measure measure);

/// Candidate − base, pair by pair of runs on the same schedule.
using statistics::Shift;

struct MeasuredChange {
  Measure measure{};
  statistics::Quantiles before, after;
  std::optional<Shift> shift;  ///< absent: no run on one of the sides reached it
  /// The relative change, candidate / base − 1, with the ends of its interval. Absent if the median
  /// before is 0 or there is no shift.
  std::optional<double> relative, relative_low, relative_high;
  /// Where runs were cut, for lack of time; absent: they were not.
  std::optional<model::Nanoseconds> cut_at;
  Judgment judgment = Judgment::same;
  std::string reason;  ///< why it is judged so; empty for `same`
};

/// A limit that a configuration keeps with one profile and not with the other.
struct LimitCrossing {
  std::string limit;             ///< "limit.completion"
  std::string text;              ///< "completion 5s"
  double before = 0, after = 0;  ///< share of runs that exceed it
  Judgment judgment = Judgment::same;
};

/// One configuration of the grid under both profiles.
struct Configuration {
  std::string name;  ///< "participants_per_host 5, endpoints_per_participant 20"
  std::vector<std::pair<std::string, std::string>> values;  ///< swept key → value
  std::uint32_t hosts = 0, participants = 0;
  std::uint64_t descriptors = 0;  ///< to be delivered across hosts: the load
  std::size_t samples = 0;        ///< of each side
  std::array<MeasuredChange, common_measure_count> measures;
  std::vector<LimitCrossing> crossings;
  /// Every pair of runs had the same result, in every number that a run has: times, counts, number
  /// of events, delays.
  bool identical_runs = false;
  /// At least half of the runs are a storm (checker/engines/exact/storm.hpp).
  bool storm_before = false, storm_after = false;

  [[nodiscard]] const MeasuredChange& operator[](Measure measure) const {
    return measures[static_cast<std::size_t>(measure)];
  }
};

/// The configurations together that do not settle by themselves whether a measure regresses: the
/// median, over all their pairs of runs with the same schedule, of the relative change.
struct PooledChange {
  Measure measure{};
  std::size_t configurations = 0, pairs = 0;
  double estimate = 0, low = 0, high = 0;  ///< relative: 0.1 is 10 % more; may be infinite
  double confidence = 0;                   ///< of the interval
  Judgment judgment = Judgment::same;
};

struct CostComparison {
  std::string grid;         ///< its name
  std::size_t samples = 0;  ///< of each side at first; configurations that stay unclear get more
  std::uint64_t seed = 0;
  std::vector<Configuration> configurations;  ///< those that were finished
  std::vector<PooledChange> pooled;           ///< of measures that some configurations leave open
  double confidence = 0;   ///< of each single interval, so that all together have the policy's
  std::size_t wanted = 0;  ///< configurations
  std::string storm;       ///< what a storm is, by the limits of the first of them
};

// --- a rolling upgrade --------------------------------------------------------------------------

/// One host more runs the candidate.
struct RolloutStep {
  std::uint32_t host = 0;
  std::string configuration;  ///< what the fleet costs then: the name of a configuration
};

/// The orders in which the hosts of a fleet can be upgraded, one by one.
struct Rollout {
  std::string fleet;
  std::size_t kinds = 0;   ///< of hosts; those of one kind are interchangeable
  std::size_t fleets = 0;  ///< that were looked at: all that an order can pass through
  std::vector<RolloutStep> best, worst;
};

// --- the storm-free margin ----------------------------------------------------------------------

/// How far a profile is from needless repairs.
struct Margin {
  /// Δ* of the theorem (checker/engines/timeline/free_threshold.hpp): at delays up to it no
  /// descriptor is sent again without loss. Absent: there is none above 0, or it is not known.
  std::optional<model::Nanoseconds> threshold;
  bool unlimited = false;  ///< no delay is too long
  std::string formula;     ///< of the threshold, or why there is none
  /// Highest load of the grid (descriptors to be delivered) up to which no configuration storms.
  std::optional<std::uint64_t> load;
  std::string load_configuration;  ///< its name; empty if even the least storms
};

struct MarginComparison {
  Margin before, after;
  Judgment judgment = Judgment::same;
  std::string reason;
};

// --- the least scenario that tells them apart ---------------------------------------------------

struct TellingApart {
  bool found = false;
  std::string how;           ///< what was searched, or why there can be none
  model::Scenario scenario;  ///< with the base profile; deployment, channel and limit serve both
  model::DdsProfile candidate;
  std::uint64_t event = 0;  ///< number of the base's event; the other run may have it elsewhere
  std::string difference;   ///< one sentence: what one does and the other does not
  /// Both runs up to the first difference, as counterexamples that have a chart.
  props::Counterexample base_run, candidate_run;
  /// The packets that each of them sends in its last event and that make the difference, by number.
  std::vector<std::uint64_t> base_packets, candidate_packets;
  std::uint32_t tried = 0;  ///< scenarios
  bool finished = false;    ///< nothing simpler tells them apart; otherwise the effort was spent
};

// --- which knob does it -------------------------------------------------------------------------

/// The regression of the worst configuration, with single knobs set back to the base.
struct Blame {
  std::string configuration;
  struct Entry {
    std::vector<std::string> reverted;  ///< keys
    double completion_median = 0;       ///< ns; NaN: it does not complete
    double messages_median = 0;
    bool cures = false;  ///< without it there is no regression
  };
  std::vector<Entry> entries;  ///< one for each changed knob that matters
};

// --- policy -------------------------------------------------------------------------------------

/// What counts as a regression (specs/policies/default.yaml explains the keys).
struct Policy {
  struct Tolerance {
    Measure measure{};
    double increase = 0;  ///< of the median, relative: 0.1 is 10 %
  };
  std::string name;
  /// Each measure at most once.
  std::vector<Tolerance> tolerances{{Measure::completion, 0.25}, {Measure::messages, 0.25}};
  /// A completion that grows by no more is no regression, however large its share.
  model::Nanoseconds unnoticed{250'000'000};
  std::optional<model::Limits> limits;  ///< crossing one is a regression
  double limit_share = 0.05;     ///< a limit is kept if at most this share of runs exceeds it
  bool verdicts = true;          ///< a property that newly is violated is a regression
  bool strict_verdicts = false;  ///< and one whose answer is lost (inconclusive) is unclear
  bool margin = true;            ///< a smaller storm-free margin is a regression
  double confidence = 0.95;
  std::size_t samples = 12;       ///< of each configuration whose schedule is drawn
  std::size_t most_samples = 48;  ///< of one that fewer leave unclear
};

/// Reads specs/policies/NAME.yaml, or a path. Errors with their place.
[[nodiscard]] model::config::Result<Policy> read_policy(const std::string& reference,
                                                        const model::config::SpecPath& specs);

// --- all together -------------------------------------------------------------------------------

struct DiffReport {
  model::config::TracedProfile base, candidate;
  Policy policy;
  Comparison profiles;
  VerdictComparison verdicts;
  CostComparison costs;  ///< of a rolling upgrade: of all its fleets
  std::vector<Rollout> rollouts;
  MarginComparison margin;
  TellingApart telling_apart;
  std::optional<Blame> blame;
  trials::Unasked unasked;
  bool interrupted = false;
  double seconds = 0;

  /// The worst of all parts. `unclear` if something is undecided and nothing is a regression; also
  /// if the profiles differ in unmodelled settings.
  Judgment judgment = Judgment::same;
  /// Everything that is a regression or unclear, one sentence each, worst first.
  std::vector<std::string> reasons;
};

struct DiffRequest {
  model::config::TracedProfile base, candidate;
  Policy policy;
  std::string grid;      ///< name or path; empty: "review"
  std::string scenario;  ///< name or path, for the verdicts; empty: one that fits both profiles
  /// Schedules of each configuration; absent: the grid's own number, or that of the policy, which
  /// may grow where it leaves something unclear.
  std::optional<std::size_t> samples;
  std::optional<std::uint64_t> seed;  ///< of the first schedule; absent: the grid's, or 0
  bool check_verdicts = true;
  bool tell_apart = true;
  bool rolling = false;  ///< hosts get the candidate one by one
  std::size_t threads = 0;
  trials::Budget time;                ///< pairs of runs and verdicts are made to fit
  trials::StudyProgress on_progress;  ///< false interrupts; told of pairs of runs
  std::function<bool()> interrupted;  ///< the same, asked by any thread
};

/// Errors: a grid or scenario that cannot be read, a grid that sweeps the DDS profile.
[[nodiscard]] model::config::Result<DiffReport> diff(const DiffRequest& request,
                                                     const model::config::SpecPath& specs);

}  // namespace stormproof::diff
