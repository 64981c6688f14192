// When drawn runs are enough. The report compares means over the N_E of one N_P with published
// ones, and says of each whether it is close; once no likely draw could change any of these answers
// the configurations of that N_P get no more draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "checker/experiments/reproduce/run.hpp"

namespace stormproof::reproduce {

/// After how many draws it is asked, ascending; the last is `most`.
[[nodiscard]] std::vector<std::size_t> looks(std::size_t most);

/// Of each look, so that all looks at one figure together err with at most 5 %.
[[nodiscard]] double confidence_of_look(std::size_t most);

/// Whether of each published figure about the means of this N_P (observed_means, upper_range) the
/// model's interval lies within `close_share` of the published value, or beyond it; or a run did
/// not complete, so that the mean does not exist. There must be two draws of each configuration.
[[nodiscard]] bool means_are_decided(const Published& published, const Results& results,
                                     std::size_t variant, std::uint32_t participants,
                                     double confidence);

}  // namespace stormproof::reproduce
