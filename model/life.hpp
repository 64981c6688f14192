// What a life (`deployment.life`) means for a run as a whole: who is away when, when the last
// failure is over, and from when on nobody forgets anybody any more.
#pragma once

#include <vector>

#include "model/deployment.hpp"
#include "model/scenario.hpp"

namespace stormproof::model {

/// Whether it is away at that time, having stopped or fallen silent.
[[nodiscard]] bool is_away(const Life& life, std::uint32_t participant, Nanoseconds time);
/// Whether somebody else comes back for it; it is never there again.
[[nodiscard]] bool is_replaced(const Life& life, std::uint32_t participant);
/// By participant, a Discovery Server's too: whether it is gone for ever some day, and nobody may
/// hold it then. Discovery waits for nothing of it. Only under rules whose leases act by
/// themselves; by others who falls silent is missing for ever.
[[nodiscard]] std::vector<bool> those_who_die(const Scenario& scenario);
/// Whether j takes now what i has emitted then: neither is away, j is ready, and no outage is
/// between them.
[[nodiscard]] bool hears(const Deployment& deployment, std::uint32_t i, std::uint32_t j,
                         Nanoseconds emitted, Nanoseconds now);
/// The host of a participant, which may be a Discovery Server.
[[nodiscard]] HostId host_of(const Deployment& deployment, std::uint32_t participant);
/// Whether j forgets i once i's lease is over. With a Discovery Server that looks after its
/// clients' leases and they after its, and of each other they hear from the server.
[[nodiscard]] bool checks_lease(const Scenario& scenario, std::uint32_t i, std::uint32_t j);
/// Its lease; nothing: it is never forgotten.
[[nodiscard]] std::optional<Nanoseconds> lease_of(const Life& life, std::uint32_t participant);
/// Whether somebody may have to be learned again.
[[nodiscard]] bool forgets(const Life& life);

/// How many samples its writer of the stream writes in the run: one for each endpoint that it
/// creates, and one for each that it deletes.
[[nodiscard]] std::uint32_t late_descriptors(const Life& life, std::uint32_t participant, Stream s);

/// The latest of all starts, returns, creations and deletions of endpoints.
[[nodiscard]] Nanoseconds last_start(const Deployment& deployment);
/// The last start, or the end of an outage or a silence if that is later.
[[nodiscard]] Nanoseconds last_failure(const Deployment& deployment);
/// From then on who hears of somebody once in a lease forgets nobody: the last failure and the
/// longest lease are over. 0 if nobody forgets.
[[nodiscard]] Nanoseconds settled_at(const Deployment& deployment);

/// Whether the restarts of each participant follow each other, none before its start.
[[nodiscard]] bool comes_back_in_order(const Deployment& deployment);
/// Whether participants create and delete endpoints while they are there.
[[nodiscard]] bool creates_while_there(const Deployment& deployment);
/// Whether somebody comes back as somebody new.
[[nodiscard]] bool has_successors(const Deployment& deployment);
/// The deployment with a participant more for each that comes back as somebody new.
[[nodiscard]] Deployment with_successors(const Deployment& deployment);
/// The scenario as it is run: with successors, and with the library's own lease where it acts
/// whether it is written down or not: wherever something happens to somebody, and always if
/// participants say that they are alive.
[[nodiscard]] Scenario as_run(const Scenario& scenario);

}  // namespace stormproof::model
