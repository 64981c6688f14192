// A deployment as it would be with more robots, more processes on each, or more endpoints of each:
// what "where does it break" is asked of. And the two ways to place what there is: all nodes of a
// host in one process, and a host that a Discovery Server has for itself.
#pragma once

#include <cstdint>
#include <vector>

#include "model/deployment.hpp"

namespace stormproof::compare {

enum class Grows : std::uint8_t { robots, participants, endpoints };
/// "robots", "participants", "endpoints".
[[nodiscard]] const char* name_of(Grows what);
/// "robots", "participants per robot", "endpoints per participant".
[[nodiscard]] const char* words_of(Grows what);

/// Hosts, participants of a host, or user endpoints of a participant; the most, if they differ.
[[nodiscard]] std::uint32_t size_of(const model::Deployment& deployment, Grows what);

/// The deployment with this size of at least 1, itself if it has it. Further hosts are like the
/// first, the second, …; so are further participants of a host; user endpoints grow in proportion.
[[nodiscard]] model::Deployment grown(const model::Deployment& deployment, Grows what,
                                      std::uint32_t size);

/// The own size, with two smaller and three larger ones of a series in steps of about 1.6; none
/// below `least`.
[[nodiscard]] std::vector<std::uint32_t> usual_sizes(std::uint32_t own, std::uint32_t least);

/// All participants of a host as nodes of one, as in a component container; it starts with the
/// first of them and has all endpoints with the last.
[[nodiscard]] model::Deployment composed(const model::Deployment& deployment);

/// No participant on host 0, where a Discovery Server runs.
[[nodiscard]] model::Deployment beside_a_server(model::Deployment deployment);

}  // namespace stormproof::compare
