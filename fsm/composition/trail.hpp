// Where a world is in the source as it runs a rule, and with it which effect is next: one is known
// by the rule or procedure that it stands in, the conditions and loops around it, its place in the
// source, and what it is. The recorder and the worlds that execute agree on this, so that a
// mistake, a trace or a story can name an effect of the page.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "fsm/composition/effect_mutation.hpp"
#include "fsm/composition/vocabulary.hpp"

namespace stormproof::fsm::composition {

class Trail {
 public:
  /// At the beginning of a rule or procedure.
  explicit Trail(std::string_view scope) { mix(scope); }

  /// In the block, or at the effect, that stands at `site`.
  [[nodiscard]] Trail inside(Site site) const {
    Trail trail = *this;
    trail.mix(site.file.substr(site.file.rfind('/') + 1));
    trail.step(site.line);
    return trail;
  }
  /// The effect of this kind on `target`, or the condition or loop, that stands here.
  [[nodiscard]] EffectKey key(std::string_view kind, std::string_view target = "") const {
    Trail trail = *this;
    trail.mix(kind);
    trail.mix(target);
    return EffectKey{trail.hash_};
  }

 private:
  // As FNV-1a, but eight characters at a time: each effect of a watched run is named anew.
  void mix(std::string_view text) {
    for (; text.size() >= sizeof(std::uint64_t); text.remove_prefix(sizeof(std::uint64_t))) {
      step(word_of(text));
    }
    step(word_of(text) ^ 0x80);
  }
  static std::uint64_t word_of(std::string_view text) {
    std::uint64_t word = 0;
    std::memcpy(&word, text.data(), std::min(text.size(), sizeof word));
    return word;
  }
  void step(std::uint64_t word) {
    hash_ = (hash_ ^ word) * 1'099'511'628'211U;
    hash_ ^= hash_ >> 32;
  }

  std::uint64_t hash_ = 14'695'981'039'346'656'037U;
};

}  // namespace stormproof::fsm::composition
