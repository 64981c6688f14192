// Which effects of a composition cannot happen under a profile, and which of its knobs is why: the
// part of `composition.live` that those need who count effects that did happen.
#pragma once

#include <string>
#include <vector>

#include "model/dds_profile.hpp"

namespace stormproof::tables {

struct ImpossibleEffects {
  std::string by;                    ///< "dds.sedp.heartbeat_policy: periodic"
  std::vector<std::string> effects;  ///< their ids
};

/// Only what is proved, by every solver that there is, or what a server adds and a condition of the
/// profile alone excludes: an effect that is in no group may be impossible all the same. If they do
/// not agree or have no answer, nothing is said of any effect.
[[nodiscard]] std::vector<ImpossibleEffects> impossible_effects(const model::DdsProfile& dds);

}  // namespace stormproof::tables
