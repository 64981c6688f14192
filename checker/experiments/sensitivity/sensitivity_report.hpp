// The sensitivity report as a document, as JSON, and as an SVG tornado plot.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "checker/experiments/sensitivity/sensitivity.hpp"
#include "checker/presentation/document/document.hpp"
#include "checker/presentation/json/schema_form.hpp"

namespace stormproof::sensitivity {

/// What the output says about how the report came about.
struct Description {
  std::string scenario;  ///< as it was named
  Options options;
  model::DdsProfile dds;  ///< of the scenario
  bool has_schedule = false;
  std::size_t shown = 15;  ///< knobs in text and plot; the others are in the JSON

  /// Whether the runs of one scenario differ in their start times.
  [[nodiscard]] bool is_sampled() const { return has_schedule || options.start_jitter.count() > 0; }
};

/// "dds.sedp.heartbeat_period=800ms": of the changes of the DDS profile that its user can make the
/// one that makes the measure least; nothing if none makes it less.
[[nodiscard]] std::optional<std::string> best_change(const Report& report, Measure by,
                                                     const model::DdsProfile& dds);

[[nodiscard]] report::Document document_of(const Report& report, const Description& description);
[[nodiscard]] nlohmann::ordered_json to_json(const Report& report, const Description& description);
[[nodiscard]] nlohmann::ordered_json json_schema(report::SchemaDefinitions& definitions);
/// A bar for each of the first knobs that have an effect on `description.options.by`.
[[nodiscard]] std::string to_svg(const Report& report, const Description& description);

}  // namespace stormproof::sensitivity
