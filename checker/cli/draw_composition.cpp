// Which composition is drawn, and how.
#include "checker/cli/draw_composition.hpp"

#include <algorithm>

#include "checker/cli/frame.hpp"
#include "checker/cli/terminal.hpp"
#include "checker/presentation/composition/composition_comparison.hpp"
#include "checker/presentation/composition/composition_drawing.hpp"
#include "checker/presentation/json/dumped.hpp"
#include "fsm/composition/compositions.hpp"
#include "model/composition_of.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::cli {

namespace {

using fsm::composition::CompositionInfo;
using model::config::Result;

/// The composition of this name, for those that no profile alone says (those of lives) and all
/// others; or that of the profile's implementation.
Result<CompositionInfo> composition_of(const std::string& name) {
  const auto& all = fsm::composition::compositions();
  const auto named = std::ranges::find(all, name, &CompositionInfo::name);
  if (named != all.end()) return *named;
  const auto dds = model::config::read_dds_profile(name, {}, model::config::SpecPath::standard());
  if (dds) return model::composition_of(*dds);
  std::string names;
  for (const CompositionInfo& each : all)
    names += (names.empty() ? "" : ", ") + std::string{each.name};
  return model::config::InputError{dds.error().where,
                                   dds.error().message + "; or a composition: " + names};
}

std::string json_text(nlohmann::ordered_json content, const Session& session) {
  return report::dumped(with_head(std::move(content), session.command(), established, false));
}

report::Terminal terminal_of(const CompositionRequest& request) {
  return request.to_file ? report::Terminal{} : standard_output();
}

std::variant<std::string, Complaint> compared(const CompositionRequest& request,
                                              const Session& session) {
  if (!request.dds.empty() || request.profiles.size() != 2) {
    return Complaint{
        "--compare takes two DDS profiles or compositions: draw composition --compare A B"};
  }
  const auto first = composition_of(request.profiles[0]);
  if (!first) return Complaint{first.error()};
  const auto second = composition_of(request.profiles[1]);
  if (!second) return Complaint{second.error()};
  const draw::CompositionComparison comparison = draw::compare(*first, *second);
  if (request.format == DrawFormat::json) {
    return json_text(draw::comparison_json(comparison), session);
  }
  if (request.format == DrawFormat::usual || request.format == DrawFormat::text) {
    return to_text(draw::comparison_document(comparison), terminal_of(request));
  }
  return Complaint{"a comparison is shown as text or json; a drawing shows one composition: --dds"};
}

}  // namespace

std::variant<std::string, Complaint> draw_composition(const CompositionRequest& request,
                                                      const Session& session) {
  if (request.compare) return compared(request, session);
  if (!request.profiles.empty()) return Complaint{"profiles are compared with --compare"};
  const auto composition = request.dds.empty()
                               ? Result<CompositionInfo>{model::composition_of(model::DdsProfile{})}
                               : composition_of(request.dds);
  if (!composition) return Complaint{composition.error()};
  switch (request.format) {
    case DrawFormat::usual:
    case DrawFormat::text:
      return to_text(draw::composition_document(*composition, terminal_of(request).columns),
                     terminal_of(request));
    case DrawFormat::json:
      return json_text(draw::composition_json(*composition), session);
    case DrawFormat::svg:
      return draw::composition_svg(*composition);
    case DrawFormat::mermaid:
      return draw::composition_mermaid(*composition);
    case DrawFormat::dot:
      break;
  }
  return Complaint{"a composition is drawn as text, svg, mermaid or json"};
}

}  // namespace stormproof::cli
