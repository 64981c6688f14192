// `stormproof properties`: the catalogue.
#include "checker/cli/commands.hpp"
#include "checker/cli/frame.hpp"
#include "checker/verification/check/properties_report.hpp"

namespace stormproof::cli {

namespace {

struct PropertiesArguments {};

Outcome run(PropertiesArguments& /*none*/, Session& /*session*/) {
  return Answer{checker::properties_document(), checker::properties_json()};
}

void declare(Options& /*none*/, PropertiesArguments& /*none*/) {}

}  // namespace

void declare_properties(Frame& frame) {
  frame.add<PropertiesArguments>({.name = "properties",
                                  .help = "List the properties that check knows",
                                  .exit_codes = "Exit code: 0.",
                                  .formats = Formats::pages,
                                  .schemas = {checker::properties_schema},
                                  .takes_long = false},
                                 declare, run);
}

}  // namespace stormproof::cli
