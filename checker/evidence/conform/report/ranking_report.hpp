// What `conform` says if no profile was named: which shipped one explains the capture best.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/evidence/conform/ranking.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::conform {

struct RankingReport {
  const capture::Conversation& conversation;
  const Ranking& ranking;
  Bounds bounds{};
  std::int64_t until_ns = INT64_MAX;
  /// The ROS 2 distributions that a profile stands for: "humble, iron".
  std::map<std::string, std::string> distributions{};
  std::string next{};  ///< the command that holds the best one against the capture
};

/// Without command and exit code, which only the caller knows.
[[nodiscard]] report::Document document_of(const RankingReport& report);
/// specs/guide/conforming.md has the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const RankingReport& report);
[[nodiscard]] nlohmann::ordered_json ranking_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::conform
