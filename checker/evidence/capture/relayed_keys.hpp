// "Every required descriptor key verified present", with a Discovery Server: a client needs only
// the descriptors on topics of which it has the other side (specs/guide/discovery-server.md,
// "Deployment with a server"), and gets them from the server.
//
// Required on the link is the description of each endpoint that is not gone and that somebody else
// needs: from its participant to the server, and from the server to each that needs it, where both
// are on different hosts. Of a client on the server's own host only those endpoints are known that
// the server tells others of.
#pragma once

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::capture {

/// Fills `required`, `missing` and `last_initial_ns` from the events until the cut. A missing key
/// names the participant whose endpoint it is.
void check_relayed_keys(const Conversation& conversation, const Participant& server,
                        Counting& counting);

}  // namespace stormproof::capture
