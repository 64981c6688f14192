// The answer of `stormproof replay`.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "model/trace/replay.hpp"

namespace stormproof::counterexample {

/// Whether the trace in `file` happens again; if not, where it parts from what was recorded.
[[nodiscard]] report::Document document_of(const std::string& file,
                                           const model::trace::Replay& replay);

/// specs/guide/output.md describes the keys.
[[nodiscard]] nlohmann::ordered_json to_json(const std::string& file,
                                             const model::trace::Replay& replay);
[[nodiscard]] nlohmann::ordered_json replay_schema(report::SchemaDefinitions& definitions);

}  // namespace stormproof::counterexample
