// Holds messages against the rules of Cyclone DDS (specs/guide/cyclone.md). Each message is
// explained by itself: it has a cause in the capture, or a timer that is due, within the bounds.
// What is asked for is necessary; one assignment for all messages together is not searched. What a
// machine sends when, the machines of fsm/ say, asked with whatever suits the message best.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/conform/context.hpp"
#include "checker/evidence/conform/ledger.hpp"
#include "checker/evidence/conform/sent_heartbeats.hpp"

namespace stormproof::conform::cyclone {

/// Copies of one packet leave one after the other, in less time.
inline constexpr std::int64_t most_apart_ns = 20'000'000;

/// SPDP: the schedule of announcements, their copies, and replies by name.
[[nodiscard]] std::optional<Unexplained> explain_announcements(const Context& context,
                                                               std::size_t participant,
                                                               Ledger& ledger);
/// The HEARTBEATs of a writer.
[[nodiscard]] std::optional<Unexplained> explain_heartbeats(const Context& context,
                                                            const WriterRelations& writer,
                                                            Ledger& ledger);
/// The DATA of a writer.
[[nodiscard]] std::optional<Unexplained> explain_data(const Context& context,
                                                      const WriterRelations& writer,
                                                      Ledger& ledger);
/// The ACKNACKs of a reader.
[[nodiscard]] std::optional<Unexplained> explain_reader(const Context& context,
                                                        const Relation& relation, Ledger& ledger);

/// What a verdict by these rules does not say.
[[nodiscard]] std::vector<std::string> assumptions(const Bounds& bounds);

}  // namespace stormproof::conform::cyclone
