// `stormproof draw composition`: what happens between the machines.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "checker/cli/answer.hpp"
#include "checker/cli/session.hpp"

namespace stormproof::cli {

/// All formats of `draw`: machines and compositions share some of them.
enum class DrawFormat : std::uint8_t { usual, mermaid, dot, svg, text, json };

struct CompositionRequest {
  /// Profile whose implementation is drawn, or name of a composition; empty: the paper's.
  std::string dds;
  bool compare = false;
  std::vector<std::string> profiles;  ///< or compositions to compare
  DrawFormat format = DrawFormat::usual;
  bool to_file = false;
};

/// The drawing, or what is wrong with the request.
[[nodiscard]] std::variant<std::string, Complaint> draw_composition(
    const CompositionRequest& request, const Session& session);

}  // namespace stormproof::cli
