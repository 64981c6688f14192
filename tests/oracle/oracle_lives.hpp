// What `deployment.life` says (specs/guide/museum.md): who is away, cut off, replaced, and when all
// of it is over. The oracles of both implementations ask for it; it needs no state of a run.
#pragma once

#include <cstdint>

#include "model/scenario.hpp"

namespace stormproof::oracle {

/// How long i is remembered by those who hear nothing of it; 0: for ever.
[[nodiscard]] std::int64_t lease_of(const model::Scenario& scenario, std::uint32_t i);

/// i is gone for ever some day, under rules of which leases are a part: nothing of it is missing,
/// and nobody is to know it then.
[[nodiscard]] bool dies(const model::Scenario& scenario, std::uint32_t i);

/// i comes back as another one.
[[nodiscard]] bool is_replaced(const model::Scenario& scenario, std::uint32_t i);

/// At that time i neither sends nor hears.
[[nodiscard]] bool is_away(const model::Scenario& scenario, std::uint32_t i, std::int64_t at);

/// At that time it hears, if it is there.
[[nodiscard]] bool is_ready(const model::Scenario& scenario, std::uint32_t i, std::int64_t at);

/// At that time nothing of `from` reaches `to`.
[[nodiscard]] bool is_cut_off(const model::Scenario& scenario, std::uint32_t from, std::uint32_t to,
                              std::int64_t at);

/// When nobody can be forgotten any more who goes on; 0: nobody ever is.
[[nodiscard]] std::int64_t settled(const model::Scenario& scenario);

}  // namespace stormproof::oracle
