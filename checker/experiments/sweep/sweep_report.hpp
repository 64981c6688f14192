// How a sweep went: what `stormproof sweep` answers beside the tables.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/sweep/collector.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::sweep {

/// `database` is the file that has the results.
[[nodiscard]] report::Document document_of(const Plan& plan, const Collector& results,
                                           const std::string& database);

/// Keys: grid, database, jobs, already_done, run_now, completed, incomplete, failed, first_error,
/// unmodelled (by profile, if there is any).
[[nodiscard]] nlohmann::ordered_json to_json(const Plan& plan, const Collector& results,
                                             const std::string& database);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::sweep
