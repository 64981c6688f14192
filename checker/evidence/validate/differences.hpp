// What the capture has and the model has not, found in the capture: a difference that is not there
// is not listed, and each has its figures. A ratio that is off is judged beside this list.
#pragma once

#include <string>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/validate/observation.hpp"
#include "model/scenario.hpp"

namespace stormproof::validate {

struct Difference {
  std::string id;    ///< "same-host", a stable name
  std::string text;  ///< one sentence with the figures
  std::uint64_t count = 0;
};

/// `sizes` are those of the model's datagrams.
[[nodiscard]] std::vector<Difference> differences(const capture::Conversation& conversation,
                                                  const Observation& observation,
                                                  const model::Scenario& scenario,
                                                  const Sizes& sizes);

}  // namespace stormproof::validate
