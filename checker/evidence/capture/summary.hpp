// What `capture summarize` says about a conversation: a document for people, JSON for scripts (with
// the names of `simulate --format json`), and a plot of the counts over time.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/events.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::capture {

/// A conversation and what was counted in it.
struct Summary {
  const Conversation& conversation;
  const Counting& counting;

  /// The instant that counting ends at: the cut, or the last packet if it is earlier.
  [[nodiscard]] std::int64_t end_ns() const {
    return counting.until_ns < conversation.last_ns ? counting.until_ns : conversation.last_ns;
  }
};

/// How the counts grow, as a table and a plot.
[[nodiscard]] report::Section over_time(const Summary& summary);
/// Who takes part, on which host, with which library.
[[nodiscard]] report::Section participants(const Conversation& conversation);
/// Without command and exit code, which only the caller knows.
[[nodiscard]] report::Document document_of(const Summary& summary);
[[nodiscard]] nlohmann::ordered_json to_json(const Summary& summary);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);
/// Cumulative counts by class over the time since the first packet.
[[nodiscard]] std::string to_svg(const Summary& summary);

}  // namespace stormproof::capture
