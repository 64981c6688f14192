// The words for the settings that the model has not got.
#include "checker/presentation/text/assumptions.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace stormproof::report {

std::string unmodelled_line(const model::DdsProfile& dds) {
  constexpr std::size_t named = 3;
  std::string text;
  std::size_t k = 0;
  for (const auto& [setting, effect] : dds.unmodelled) {
    if (k < named) text += (k == 0 ? "not in the model: " : ", ") + setting;
    ++k;
  }
  if (k > named) text += fmt::format(" and {} more", k - named);
  return text;
}

nlohmann::ordered_json unmodelled_json(const model::DdsProfile& dds) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [setting, effect] : dds.unmodelled) json[setting] = effect;
  return json;
}

void add_unmodelled(nlohmann::ordered_json& report, const model::DdsProfile& dds) {
  if (!dds.unmodelled.empty()) report["unmodelled"] = unmodelled_json(dds);
}

}  // namespace stormproof::report
