// What `conform` says about a capture: a document for people, CI systems and reviews, JSON for
// scripts, the chart of the first event that nothing explains, and the assignment of hidden events.
//
// Every form says the same: the verdict with the bounds that it is relative to, what is not
// explained and what the nearest assignment would need, what was checked and what was not, and how
// much of the tables and rules the capture exercised.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "checker/engines/tables/impossible_effects.hpp"
#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/conform/conform.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::conform {

/// A result with everything that reports name.
struct Report {
  const capture::Conversation& conversation;
  const Conformance& result;
  const model::DdsProfile& dds;
  std::string profile{};              ///< as the user named it
  std::int64_t until_ns = INT64_MAX;  ///< as in the request
  /// Effects that the profile rules out; of what is not in here, nobody says why it never happened.
  std::vector<tables::ImpossibleEffects> impossible{};
};

/// Without command and exit code, which only the caller knows.
[[nodiscard]] report::Document document_of(const Report& report);
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

/// The context of the first unexplained event as a message sequence chart; empty if there is none.
[[nodiscard]] std::string to_svg(const Report& report);

/// The hidden events as JSON Lines: a line about the run, then one line for each event.
[[nodiscard]] std::string assignment_lines(const Report& report);

}  // namespace stormproof::conform
