// Who is at no port that announcements go to: the reason why some never find each other, said by
// every verb that runs such a scenario.
#pragma once

#include <string>

#include "model/scenario.hpp"

namespace stormproof::report {

/// Sentences about static peers of which some are at no port (`dds.peer_ports`); empty if
/// announcements reach everybody.
[[nodiscard]] std::string unreached(const model::Scenario& scenario);

}  // namespace stormproof::report
