// What writers say of themselves over a capture, and in which of several lives under one GUID.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "checker/evidence/doctor/reasons/contacts.hpp"

namespace stormproof::doctor {

struct WriterLife {
  std::int64_t last = 0;         ///< number that it has announced in its present life
  std::uint32_t count = 0;       ///< of its HEARTBEATs, the same
  std::int64_t back_ns = 0;      ///< when it came back; 0: it was there from the beginning
  std::int64_t before = 0;       ///< the last number of the life before
  std::set<std::size_t> deaf{};  ///< participants that acknowledge more than it has

  [[nodiscard]] bool is_back() const { return back_ns != 0; }
};
/// By the number of the participant, and the entity.
using WriterLives = std::map<std::pair<std::size_t, capture::EntityId>, WriterLife>;

[[nodiscard]] WriterLives writer_lives(const Contacts& contacts);

}  // namespace stormproof::doctor
