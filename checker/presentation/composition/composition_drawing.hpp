// A composition for readers: what there is and every rule with all its effects, on one page and as
// data. All of it comes from the rules that run and that proofs are derived from.
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/presentation/document/document.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/json/schema_form.hpp"
#include "fsm/composition/composition_info.hpp"

namespace stormproof::draw {

/// The page, to be read from the top to the bottom; the ids of effects stand at the right margin of
/// a text of this width.
[[nodiscard]] report::Document composition_document(
    const fsm::composition::CompositionInfo& composition,
    std::size_t columns = report::Terminal{}.columns);

/// `composition`, `machines`, `packets`, `timers`, `state`, `facts`, `rules`, `procedures`,
/// `steps`.
[[nodiscard]] nlohmann::ordered_json composition_json(
    const fsm::composition::CompositionInfo& composition);
[[nodiscard]] nlohmann::ordered_json composition_schema(report::SchemaDefinitions& definitions);

/// A self-contained SVG document: the sides, then a band for each rule; names lead to their rules.
[[nodiscard]] std::string composition_svg(const fsm::composition::CompositionInfo& composition);

/// Mermaid source, `flowchart`: rules as nodes, packets, timers and calls as edges.
[[nodiscard]] std::string composition_mermaid(const fsm::composition::CompositionInfo& composition);

}  // namespace stormproof::draw
