// Inputs of Cyclone DDS's reader, around each of its guards.
#include "fsm/cautious_reader.hpp"

#include "tests/fsm/survey.hpp"

namespace stormproof::fsm {

MachineSurvey survey_cautious_reader() {
  // It lacks sample 3 of 5, has asked for all of them, and may ask again from 2'000 on, by itself
  // from 9'000 on.
  const Inputs<CautiousReader>::value_type asked{.fresh = true,
                                                 .directed = false,
                                                 .by_delay = false,
                                                 .first_missing = 3,
                                                 .last = 5,
                                                 .asked_end = 6,
                                                 .base = 3,
                                                 .now = 1'000,
                                                 .quiet_until = 1'500,
                                                 .hush_until = 2'000,
                                                 .again_at = 9'000,
                                                 .preemptive_delay = 10,
                                                 .repeat_delay = 1'000,
                                                 .again_delay = 3'000};
  Inputs<CautiousReader> inputs(7, asked);
  inputs[1].last = inputs[1].first_missing = 6;  // a new gap
  inputs[2].now = 2'000;                         // late
  inputs[3].first_missing = 6;                   // complete
  inputs[4].quiet_until = 0;
  inputs[5].now = 9'000;
  inputs[6].first_missing = inputs[6].base = 6;
  const std::size_t count = inputs.size();
  for (std::size_t k = 0; k < count; ++k) {
    inputs.push_back(inputs[k]);
    inputs.back().fresh = false;
    inputs.push_back(inputs[k]);
    inputs.back().directed = true;
    inputs.push_back(inputs[k]);
    inputs.back().by_delay = true;
  }
  return survey<CautiousReader>(inputs);
}

}  // namespace stormproof::fsm
