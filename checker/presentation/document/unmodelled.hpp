// The settings of the real system that the model has not got, as assumptions of a document: the
// same words in every report.
#pragma once

#include <string_view>

#include "checker/presentation/document/document.hpp"
#include "model/config/provenance.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::report {

/// One assumption for each setting. `whose` names the profile if there are several. With the places
/// of the scenario, each is a note among the findings, too, at the line that names it.
void add_unmodelled(Document& document, const model::DdsProfile& dds, std::string_view whose = {},
                    const model::config::Places* places = nullptr);

}  // namespace stormproof::report
