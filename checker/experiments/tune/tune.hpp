// `stormproof tune` without its command line: which settings that a user can change make discovery
// as short as possible, and what they cost in messages. Three separate sets of seeds keep chance
// from being taken for merit: the search finds settings under the first, the second takes away the
// changes that do not matter and chooses, and what is reported comes from the third.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checker/engines/exact/health.hpp"
#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/budget.hpp"
#include "checker/experiments/trials/unasked.hpp"
#include "checker/experiments/tune/reduce.hpp"
#include "checker/experiments/tune/search.hpp"
#include "checker/experiments/tune/subject.hpp"

namespace stormproof::tune {

struct Options {
  std::size_t budget = 1'200;  ///< runs of the search
  std::size_t samples = 40;    ///< runs of each setting in reduction and comparison, at least 6; 1
                               ///< if all runs of the scenario are the same
  std::uint64_t seed = 0;
  double least = 0.02;  ///< what is worth a line of XML: this part of completion, or of messages
  bool plans = false;   ///< launch plans vary, too
  std::vector<std::string> keep;      ///< what every run must keep; empty: all that holds unchanged
  model::Nanoseconds start_jitter;    ///< each participant starts up to this much later
  std::size_t threads = 0;            ///< 0: one for each core
  trials::Budget time;                ///< search and comparison are made to fit
  trials::StudyProgress on_progress;  ///< false interrupts
};

/// One changed setting.
struct Change {
  std::string key;      ///< "dds.sedp.piggyback_threshold_bytes"
  std::string setting;  ///< the vendor's element; empty: no user can set it
  std::string before, after;
  std::string note;  ///< how the element's value relates to the knob's; may be empty
};

/// Order statistics over the runs of one setting.
struct Summary {
  std::size_t runs = 0, completed = 0;
  statistics::Quantiles completion_ns, messages, heartbeat, repair_data, acknack, spdp;
};

/// One line of the comparison.
struct Row {
  enum class Kind : std::uint8_t {
    unchanged,
    front,      ///< found by the search
    comparison  ///< fixed, to compare with
  };
  Kind kind = Kind::front;
  std::string name;
  std::optional<Point> point;  ///< absent: not a setting of the search
  bool is_choice = false;      ///< chosen before the comparison
  std::vector<Change> changes;
  model::Scenario scenario;
  std::optional<launch::Plan> plan;  ///< absent: as the scenario says
  Summary summary;
  std::optional<exact::Outlook> outlook;          ///< of its runs; absent: none
  std::optional<Difference> against_unchanged;    ///< absent: it is the unchanged one, or
                                                  ///< interrupted
  std::optional<Difference> recommended_against;  ///< the recommended setting compared with it
  std::vector<std::string> broken;                ///< what must be kept and is not
  std::string note;
};

enum class Answer : std::uint8_t {
  better,          ///< the recommended setting clearly shortens discovery
  nothing_better,  ///< no setting was found that clearly does
  interrupted
};

struct Report {
  Answer answer = Answer::nothing_better;
  Space space;
  std::vector<std::string> kept;          ///< ids that every setting is held to
  std::vector<std::string> not_required;  ///< ids that break unchanged
  bool is_sampled = false;                ///< runs of one setting differ
  Seeds searched, chosen, compared;       ///< seeds
  std::size_t runs = 0, settings = 0;
  trials::Unasked unasked;  ///< what there was no time for, and which runs of the search were cut
  SearchResult found;
  std::size_t undone = 0;   ///< changes that were set back because they do not matter
  std::size_t dropped = 0;  ///< settings of the front that others dominate under new seeds, or
                            ///< that break something there
  model::Nanoseconds compared_until;  ///< simulated time of a run of the rows
  std::vector<Cost> tried;            ///< of all settings that the search ran under all its seeds
  std::vector<Row> rows;              ///< unchanged, the front by completion, comparisons
  std::optional<std::size_t> recommended;  ///< position in `rows`
  Seeds basis;                             ///< what the rows' numbers come from
};

/// Errors: nothing can be changed, an unknown id in `keep`, a profile that no user can set.
[[nodiscard]] model::config::Result<Report> tune(const Subject& subject, const Options& options);

}  // namespace stormproof::tune
