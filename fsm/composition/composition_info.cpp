// Where an effect stands, in words.
#include "fsm/composition/composition_info.hpp"

namespace stormproof::fsm::composition {

std::string place_of(const EffectInfo& effect) {
  const std::size_t from = effect.file.rfind("fsm/composition/");
  const std::string_view file =
      from == std::string_view::npos ? effect.file : effect.file.substr(from);
  return effect.id + " at " + std::string{file} + ":" + std::to_string(effect.line);
}

}  // namespace stormproof::fsm::composition
