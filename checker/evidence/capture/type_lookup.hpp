// What questions about types and their answers say (TypeLookup service, XTypes 1.3, section
// 7.6.3.3): who asks whom, by which number an answer names its question, and which types are meant.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "checker/evidence/capture/identifiers.hpp"
#include "checker/evidence/capture/rtps_message.hpp"

namespace stormproof::capture {

/// The identifier of a type: its kind and the hash of its complete description.
using TypeHash = std::array<std::uint8_t, 15>;

struct TypeLookup {
  GuidPrefix asker{};       ///< whose question it is, or answers
  std::int64_t number = 0;  ///< of the question
  bool is_answer = false;
  bool is_about_dependencies = false;  ///< otherwise about types themselves
  std::optional<GuidPrefix> asked{};   ///< a question: whom it is for
  std::vector<TypeHash> types{};       ///< a question: what it is about
};

/// By source, writer and sequence number: a sample that goes to several readers is here once.
using TypeLookups = std::map<std::tuple<GuidPrefix, EntityId, std::int64_t>, TypeLookup>;

/// Of a DATA of one of the two writers; nothing if it says something else, or breaks off.
[[nodiscard]] std::optional<TypeLookup> type_lookup(const DataSubmessage& data);
/// The complete type of a TypeInformation (PID_TYPE_INFORMATION); nothing if it has none.
[[nodiscard]] std::optional<TypeHash> type_hash(Bytes type_information, ByteOrder order);

}  // namespace stormproof::capture
