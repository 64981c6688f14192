// Inputs of the repair state of one descriptor, whether or not its reader may forget: all there
// are.
#include "fsm/reopening_repair.hpp"
#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

namespace {

/// Both machines have the same.
Inputs<DescriptorRepair> all_inputs() {
  Inputs<DescriptorRepair> inputs;
  for (const bool listed : {false, true}) {
    for (const bool below : {false, true}) {
      for (const bool prefix : {false, true}) inputs.push_back({listed, below, prefix});
    }
  }
  return inputs;
}

}  // namespace

MachineSurvey survey_descriptor_repair() { return survey<DescriptorRepair>(all_inputs()); }

MachineSurvey survey_reopening_repair() { return survey<ReopeningRepair>(all_inputs()); }

}  // namespace stormproof::fsm
