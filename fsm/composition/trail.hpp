// Where a world is in the source as it runs a rule, and with it which effect is next: one is known
// by the rule or procedure that it stands in, the conditions and loops around it, its place in the
// source, and what it is. The recorder and the worlds that execute agree on this, so that a
// mistake, a trace or a story can name an effect of the page.
#pragma once

#include <cstdint>
#include <string_view>

#include "fsm/composition/effect_mutation.hpp"
#include "fsm/composition/vocabulary.hpp"

namespace stormproof::fsm::composition {

class Trail {
 public:
  /// At the beginning of a rule or procedure.
  explicit Trail(std::string_view scope) { mix(scope); }

  [[nodiscard]] Trail inside(Site block) const {
    Trail trail = *this;
    trail.mix(block);
    return trail;
  }
  /// The effect of this kind on `target`, or the condition or loop, at `site`.
  [[nodiscard]] EffectKey at(std::string_view kind, std::string_view target, Site site) const {
    Trail trail = *this;
    trail.mix(kind);
    trail.mix(target);
    trail.mix(site);
    return EffectKey{trail.hash_};
  }

 private:
  // FNV-1a.
  void mix(std::string_view text) {
    for (const char c : text) step(static_cast<unsigned char>(c));
    step(0);
  }
  void mix(Site site) {
    mix(site.file.substr(site.file.rfind('/') + 1));
    for (unsigned line = site.line; line != 0; line >>= 8) step(line & 255);
    step(0);
  }
  void step(unsigned byte) { hash_ = (hash_ ^ byte) * 1'099'511'628'211U; }

  std::uint64_t hash_ = 14'695'981'039'346'656'037U;
};

}  // namespace stormproof::fsm::composition
