// Whether a run of the live bed is what it has to be: complete, with exactly F initial DATA, every
// required key, and nothing lost on the way into the captures. What fails is said in words.
#pragma once

#include <string>
#include <vector>

#include "tests/live/report/run_record.hpp"

namespace stormproof::live {

enum class Outcome {
  as_expected,   ///< complete, and every check holds
  check_failed,  ///< a check of a complete run fails, or packets were lost before they were counted
  incomplete     ///< not everybody knew everything within the limit
};

struct Judgement {
  Outcome outcome = Outcome::as_expected;
  std::vector<std::string> remarks{};  ///< what failed, or what the incomplete participants lack
  std::vector<std::string> notes{};    ///< what happened to the hosts, and is no mistake of the bed
};

[[nodiscard]] Judgement judge(const RunRecord& run);

/// One line per run, their range if there are several, the remarks and the notes.
[[nodiscard]] std::string to_text(const std::vector<RunRecord>& runs);
/// The same as JSON: `runs`, each with times in ns (null: not complete), counts, remarks and
/// notes.
[[nodiscard]] std::string to_json(const std::vector<RunRecord>& runs);

}  // namespace stormproof::live
