// Says what the model leaves out.
#include "checker/presentation/document/unmodelled.hpp"

namespace stormproof::report {

void add_unmodelled(Document& document, const model::DdsProfile& dds, std::string_view whose) {
  const std::string of = whose.empty() ? std::string{} : ", of " + std::string{whose};
  for (const auto& [setting, effect] : dds.unmodelled) {
    document.assumptions.push_back(code(setting) + (" (not in the model" + of + "): " + effect));
  }
}

}  // namespace stormproof::report
