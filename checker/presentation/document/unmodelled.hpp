// The settings of the real system that the model has not got. A run says nothing about what they
// do, so every report of a run names them as what it assumes to make no difference: the same words
// in every report.
#pragma once

#include <string_view>

#include "checker/presentation/document/document.hpp"
#include "model/config/tree/tree.hpp"
#include "model/dds_profile.hpp"
#include "model/scenario.hpp"

namespace stormproof::report {

/// What an entry of `DdsProfile::unmodelled` means for a result, for a heading.
inline constexpr const char* unmodelled_heading = "Not in the model, assumed to make no difference";

/// One assumption for each setting. `whose` names the profile if there are several. With the places
/// of the scenario, each is a note among the findings, too, at the line that names it.
void add_unmodelled(Document& document, const model::DdsProfile& dds, std::string_view whose = {},
                    const model::config::Places* places = nullptr);

/// Of the scenario's profile, and of those that participants have beside it.
void add_unmodelled(Document& document, const model::Scenario& scenario,
                    const model::config::Places* places = nullptr);

}  // namespace stormproof::report
