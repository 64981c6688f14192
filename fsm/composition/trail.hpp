// Where a world is in the source as it runs a rule, and with it which effect is next: one is known
// by the rule or procedure that it stands in, the conditions and loops around it, its place in the
// source, and what it is. The recorder and the worlds that execute agree on this, so that a
// mistake, a trace or a story can name an effect of the page.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

#include "fsm/composition/effect_mutation.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "fsm/reflect.hpp"

namespace stormproof::fsm::composition {

/// What a name adds to a trail: FNV-1a. That of a literal or a type is known when the program is
/// compiled, as each effect of a watched run is named anew.
struct Digest {
  // NOLINTNEXTLINE(google-explicit-constructor): a literal is its digest
  consteval Digest(const char* literal) : Digest{std::string_view{literal}} {}
  explicit constexpr Digest(std::string_view text) {
    for (const char letter : text) {
      value = (value ^ static_cast<unsigned char>(letter)) * 1'099'511'628'211U;
    }
  }

  std::uint64_t value = 14'695'981'039'346'656'037U;
};
template <class T>
inline constexpr Digest digest_of{name_of<T>()};

class Trail {
 public:
  /// At the beginning of a rule or procedure.
  explicit constexpr Trail(Digest scope) { step(scope.value); }

  /// In the block, or at the effect, that stands at `site`.
  [[nodiscard]] Trail inside(Site site) const {
    Trail trail = *this;
    trail.step(end_of(site.file));
    trail.step(site.line);
    return trail;
  }
  /// The effect of this kind on `target`, or the condition or loop, that stands here.
  [[nodiscard]] EffectKey key(Digest kind, Digest target = "") const {
    Trail trail = *this;
    trail.step(kind.value);
    trail.step(target.value);
    return EffectKey{trail.hash_};
  }

 private:
  /// The last letters of a path before its `.hpp`: the same wherever the source lies.
  static std::uint64_t end_of(std::string_view path) {
    constexpr std::size_t suffix = std::string_view{".hpp"}.size();
    std::uint64_t word = 0;
    if (path.size() >= suffix + sizeof word) {
      std::memcpy(&word, path.data() + path.size() - suffix - sizeof word, sizeof word);
    }
    return word;
  }
  constexpr void step(std::uint64_t word) {
    hash_ = (hash_ ^ word) * 1'099'511'628'211U;
    hash_ ^= hash_ >> 32;
  }

  std::uint64_t hash_ = 14'695'981'039'346'656'037U;
};

}  // namespace stormproof::fsm::composition
