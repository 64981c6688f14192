// Records every composition once.
#include "fsm/composition/compositions.hpp"

#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/paper.hpp"
#include "fsm/composition/recorder.hpp"

namespace stormproof::fsm::composition {

std::string_view label(Owner owner) {
  if (owner == owner::participant) return "participant";
  if (owner == owner::pair) return "pair";
  if (owner == owner::writer) return "writer";
  if (owner == owner::relation) return "relation";
  if (owner == owner::entry) return "entry";
  if (owner == owner::descriptor) return "descriptor";
  return "control relation";
}

std::vector<CompositionInfo> compositions() {
  return {recorded<paper::Paper>(), recorded<fastdds::FastDds>()};
}

}  // namespace stormproof::fsm::composition
