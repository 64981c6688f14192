// What sends an event in the composition of Fast DDS (fsm/composition/fastdds.hpp): the rule or
// procedure, by its id, and the packet. Which effect of it that is follows from the composition and
// the profile (checker/evidence/conform/report/effect_coverage.hpp).
#pragma once

#include "checker/evidence/conform/conform.hpp"

namespace stormproof::conform::sends {

inline constexpr Sender announcement_due{"AnnouncementIsDue", "SpdpMulticast"};
inline constexpr Sender copies_due{"AnnouncementIsDue", "SpdpUnicast"};
inline constexpr Sender resent{"Hear", "SpdpMulticast"};
inline constexpr Sender copies_resent{"Hear", "SpdpUnicast"};
inline constexpr Sender opening{"ReaderIsMatched", "Heartbeat"};
inline constexpr Sender answer_to_initial{"AckNackArrives", "Heartbeat"};
inline constexpr Sender expiry{"ClockGoesOn", "Heartbeat"};
inline constexpr Sender pushed{"Deliver ToAll", "Data"};
inline constexpr Sender requested{"Deliver ToRequesters", "Data"};
inline constexpr Sender budget_of_pushed{"Deliver ToAll", "Heartbeat"};
inline constexpr Sender budget_of_requested{"Deliver ToRequesters", "Heartbeat"};
inline constexpr Sender reply{"AckNackDue", "AckNack"};
inline constexpr Sender initial{"InitialAckNackDue", "AckNack"};

/// The same in the composition of Cyclone DDS (fsm/composition/cyclone.hpp).
namespace cyclone {
inline constexpr Sender start{"AnnounceAndGoOn SpdpStartupPeriod", "Spdp"};
inline constexpr Sender announcement_due{"AnnounceAndGoOn SpdpPeriod", "Spdp"};
inline constexpr Sender reply_due{"ReplyTimerIsTaken", "Spdp"};
inline constexpr Sender expiry{"HeartbeatTimerIsTaken", "Heartbeat"};
inline constexpr Sender answer{"AnswerReader", "Heartbeat"};
inline constexpr Sender pushed{"DescriptorIsCreated", "Data"};
inline constexpr Sender requested{"RepeatListed", "Data"};
inline constexpr Sender preemptive{"AckTimerIsTaken", "AckNack"};
inline constexpr Sender reply{"Reply", "AckNack"};
}  // namespace cyclone

/// The same in what a Discovery Server adds (fsm/composition/server.hpp).
namespace server {
inline constexpr Sender announces_first{"AnnouncesToServer", "Registration",
                                        "if not KnownByLocator"};
inline constexpr Sender announces{"AnnouncesToServer", "Registration",
                                  "if not (not (AnnouncementsSent > 1))"};
inline constexpr Sender tick{"ClientSyncIsDue", "Registration"};
inline constexpr Sender first_heartbeat{"AnnouncesToServer", "RegistrationHeartbeat"};
inline constexpr Sender heartbeat_to_server_met{"RelayedDataArrives", "RegistrationHeartbeat"};
inline constexpr Sender asked_heartbeat{"RegistrationAckNackArrives", "RegistrationHeartbeat"};
inline constexpr Sender heartbeat_again{"RegistrationExpires", "RegistrationHeartbeat"};
inline constexpr Sender registered{"RegistrationReplyIsDue", "RegistrationAckNack"};
inline constexpr Sender initial_of_server{"RegistrationInitialDue", "RegistrationAckNack"};
inline constexpr Sender opening{"RelayOpened", "RelayHeartbeat"};
inline constexpr Sender answer_to_initial{"RelayedAckNackArrives", "RelayHeartbeat"};
inline constexpr Sender expiry{"RelayExpires", "RelayHeartbeat"};
inline constexpr Sender skipped{"ChangesAreSkipped", "Gap"};
inline constexpr Sender served{"ChangeIsServed", "RelayedData"};
inline constexpr Sender own{"RegistrationArrives", "RelayedData"};
inline constexpr Sender irrelevant{"RelayedAckNackArrives", "Gap"};
inline constexpr Sender reply{"LearnerReplyIsDue", "RelayedAckNack"};
inline constexpr Sender initial{"LearnerInitialDue", "RelayedAckNack"};
}  // namespace server

}  // namespace stormproof::conform::sends
