// Prints the catalogue.
#include "checker/cli/properties_command.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "checker/cli/exit_code.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/json/dumped.hpp"
#include "checker/verification/check/properties_report.hpp"

namespace stormproof::cli {

int properties(bool json) {
  fmt::print("{}", json ? report::dumped(checker::properties_json())
                        : to_text(checker::properties_document()));
  return established;
}

}  // namespace stormproof::cli
