// Deliberate mistakes of the oracles. An oracle can only judge if a comparison with it is able to
// fail: each of these breaks one rule at the place where the rule is, and a test wants the
// comparison with the product to notice every one of them. A mistake that nobody notices says that
// the random scenarios never reach its rule.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace stormproof::oracle {

/// What the paper's oracle does wrong (specs/guide/model.md has the rules).
enum class Mistake : std::uint8_t {
  none,
  // Events, packets and the channel.
  class_ignored,          ///< events of one time come in the order of insertion
  dispatch_first,         ///< the channel picks before the other events of the instant
  airtime_rounded_down,   ///< not to the nearest nanosecond
  queue_admits_one_more,  ///< a packet is admitted while anything of W is left
  queue_drops_demand,     ///< admission forgets the last fragment's bytes
  rank_ignored,           ///< waiting fragments are served by request time and number alone
  forwards_first,         ///< a fragment is forwarded before the source's next one is requested
  fragments_reversed,     ///< a whole packet's fragments are requested from the last on
  admits_first,           ///< the queue admits before the source completion is processed
  loss_ignored,           ///< lost packets are received
  multicast_as_unicast,   ///< a multicast frame takes a unicast frame's airtime
  // SPDP.
  startup_one_more,    ///< one startup announcement too many
  resend_too_early,    ///< the newcomer is not among those that the resend goes to
  copies_first,        ///< the copies of an announcement go before the multicast
  receives_unstarted,  ///< a participant processes what arrives before its start
  // The reader.
  one_acknack_pending,     ///< a HEARTBEAT adds no ACKNACK to one that is pending
  acknack_words_down,      ///< the bitmap takes floor(D/32) words
  initial_not_doubled,     ///< initial ACKNACKs keep their distance
  initial_always_doubled,  ///< initial ACKNACKs double a distance that is constant
  initial_never_ends,      ///< initial ACKNACKs go on after a HEARTBEAT
  bitmap_not_snapshot,     ///< an ACKNACK lists what is missing at its reception
  // The writer.
  opening_arms_first,        ///< the HEARTBEAT of an opening comes after its expiry is scheduled
  heartbeat_restarted,       ///< arming a pending timer moves it
  expiry_for_all,            ///< an expiry goes to readers that lack nothing, too
  confirms_unsent_only,      ///< an ACKNACK takes only U to A
  prefix_goes_too_far,       ///< `acknowledge: prefix` confirms what follows the first missing one
  repair_not_snapshot,       ///< a source completion suppresses all that is queued
  suppression_ignored,       ///< a repair that has left its source can be requested at once
  suppression_does_not_arm,  ///< the end of a suppression leaves the timer alone
  // DATA and its piggyback.
  heartbeat_keeps_budget,   ///< a HEARTBEAT of its own does not fill the budget
  budget_ends_at_zero,      ///< a budget of exactly 0 triggers the piggyback
  charge_starts_anew,       ///< the participant's byte counter starts anew with each HEARTBEAT
  piggyback_uncharged,      ///< piggyback HEARTBEATs do not count in the byte counter
  piggyback_to_one,         ///< the piggyback goes to the packet's receiver only
  grouping_forgets_header,  ///< a descriptor that joins a packet brings its headers along
  // The adaptive policy.
  early_end_at_the_end,      ///< a response at the very end of the period counts as in time
  stretch_rounded_down,      ///< T·H/A is not rounded to the nearest nanosecond
  batches_of_one,            ///< the paced HEARTBEATs go one by one
  late_response_ends_cycle,  ///< a second response of a reader can end the cycle, too
  // The life of participants (specs/guide/museum.md has the rules).
  lease_not_renewed,        ///< a lease runs from the recognition, whatever is heard
  lease_renewed_by_spdp,    ///< only announcements renew a lease
  forgets_reader_only,      ///< who forgets another one keeps the writer side towards it
  forgotten_events_happen,  ///< what was due for a forgotten side happens at the new one
  returns_with_memory,      ///< who comes back knows what it knew
  hears_in_outages,         ///< outages have no effect
  old_counts_forgotten,     ///< ACKNACKs of who comes back all count
  ends_before_settled,      ///< the first completion ends a run
  // Endpoints that are created and deleted in the run.
  exists_from_the_start,      ///< a descriptor that is created later exists from the start
  creation_not_pushed,        ///< what is created waits to be asked for
  creation_does_not_arm,      ///< a creation leaves the timer alone
  deletion_writes_nothing,    ///< a deletion sends nothing
  heartbeats_announce_start,  ///< HEARTBEATs announce what the participant started with
  acknack_confirms_unknown,   ///< an ACKNACK is about what its reader does not know, too
  numbers_not_forgotten,      ///< who forgets another one still knows how much it has written
  // A clock that measures its readers' answers (`measured_ack`).
  measuring_begins_anew,   ///< an arming schedules an expiry although one is pending
  silence_not_doubled,     ///< the period stays when somebody is silent
  first_answer_ends,       ///< the first answer ends a cycle, not the last
  measured_without_bound,  ///< a measured period may be shorter than 10 ms
  answered_expiry_stays,   ///< the expiry of a cycle that is over happens
};

/// What the oracle of `implementation: fastdds` does wrong (specs/guide/fastdds.md has the rules).
enum class FastddsMistake : std::uint8_t {
  none,
  // Deployment, packets, SPDP.
  creation_a_step_early,    ///< the k-th endpoint is created at k, not k+1, steps
  publications_first,       ///< all publications are created before the subscriptions
  creation_not_pushed,      ///< a descriptor that is created after the match waits to be asked for
  loopback_without_delay,   ///< same-host packets arrive at once
  loopback_takes_a_number,  ///< same-host packets have packet numbers
  receptions_reversed,      ///< the receptions of a multicast go from the last participant on
  multicast_first,          ///< the multicast of an announcement goes before the copies
  // The writer.
  expiry_to_several_larger,    ///< a HEARTBEAT to several readers has 68 B, too
  expiry_until_acknowledged,   ///< an expiry goes on until everything is acknowledged
  base_confirms_unsent_only,   ///< the base takes only U to A
  low_not_raised,              ///< a base leaves the low mark
  initial_keeps_low,           ///< an initial ACKNACK leaves the low mark
  initial_does_not_arm,        ///< an initial ACKNACK does not arm the timer
  vain_request_does_not_arm,   ///< a NACK that requests nothing new does not arm the timer
  response_per_request,        ///< every NACK that requests schedules a nack response
  run_per_response,            ///< a nack response adds an async run to one that is pending
  suppression_per_descriptor,  ///< every delivery schedules a suppression end
  suppression_end_arms_not,    ///< the end of a suppression leaves the timer alone
  // Messages.
  no_destination_bytes,   ///< a message to one reader lacks the 16 bytes of its destination
  sync_charges_message,   ///< a creation is charged like a DATA of an async run
  charge_per_packet,      ///< an async message counts once for each destination
  piggyback_rides_along,  ///< a piggyback goes to the message's own destinations only
  // The reader.
  initial_always_doubled,  ///< initial ACKNACKs double a distance that is constant
  data_announces_nothing,  ///< DATA does not raise what the reader knows of
  announces_all,           ///< a HEARTBEAT announces endpoints that do not exist yet
  acknack_per_heartbeat,   ///< a HEARTBEAT adds an ACKNACK to one that is pending
  // Control-only relations, adaptive policy.
  notified_late,            ///< an endpoint is known only when the next one has been received
  control_reply_doubled,    ///< every control HEARTBEAT is answered
  control_initial_ignored,  ///< a control writer does not answer initial ACKNACKs
  control_always_doubled,   ///< its initial ACKNACKs double a distance that is constant
  response_with_old_base,   ///< a clean ACKNACK counts whatever its base
  // The life of participants (specs/guide/museum.md has the rules).
  lease_not_renewed,        ///< a lease runs from the recognition, whatever is heard
  forgets_reader_only,      ///< who forgets another one keeps the writer side towards it
  topics_remembered,        ///< or the control-only relations
  forgotten_events_happen,  ///< what was due for a forgotten side happens at the new one
  returns_with_memory,      ///< who comes back knows what it knew
  returns_with_endpoints,   ///< or has its endpoints already
  holds_the_dead,           ///< discovery is complete while somebody is known who is gone
  hears_unready,            ///< a participant hears before it is ready
  hears_in_outages,         ///< outages have no effect
  ends_before_settled,      ///< the first completion ends a run
  // What later versions have.
  endpoints_always_first,     ///< `match_order` has no effect
  lookups_before_liveliness,  ///< what looks up types opens before liveliness
  lookup_writers_first,       ///< and its writer sides before its reader sides
  no_lookups_on_host,         ///< nobody looks up types on the own host
  lookups_on_host_count,      ///< or its HEARTBEATs and ACKNACKs count
  builtin_replies_like_user,  ///< all control HEARTBEATs are answered after 5 ms
  statistics_uncharged,       ///< what the statistics module adds does not count as sent
  full_message_charged,       ///< a message that takes no more is charged before it is sent
  group_starts_anew,          ///< what exceeds the threshold of a group is forgotten
  group_of_creations,         ///< a creation belongs to the group as well
  group_goes_on,              ///< a HEARTBEAT does not end a writer's group
  // Lookups of types.
  types_without_bytes,           ///< descriptors say nothing of their types
  complete_when_received,        ///< discovery is complete though descriptors wait for their types
  nobody_waits,                  ///< every type counts as known
  no_questions_on_host,          ///< what comes from the own host needs no type
  all_own_types_known,           ///< a participant knows types of endpoints that it will create
  everybody_is_asked,            ///< each descriptor that waits asks
  one_question,                  ///< the answer about dependencies is the last one
  one_list_only,                 ///< an answer lets those of its stream go
  subscriptions_first,           ///< or those of subscriptions before those of publications
  descriptors_before_samples,    ///< the queue of descriptors comes before that of samples
  samples_to_addressee,          ///< a sample goes to whom it is meant for
  samples_do_not_arm,            ///< no HEARTBEAT follows samples by itself
  samples_not_got,               ///< only a HEARTBEAT says what is acknowledged
  heartbeats_give_nothing,       ///< or only samples do
  initial_arms_no_lookups,       ///< an initial ACKNACK arms nothing
  expiry_of_lookups_to_lacking,  ///< an expiry goes to readers that lack samples
  questions_filtered,            ///< a filter of answers filters questions, too
  filtered_samples_lack,         ///< a reader lacks what did not go to it
  streams_ask_apart,             ///< a type is asked for by either stream, whatever the unit
  asks_without_answer,           ///< a participant is asked again though it has not answered
};

/// What the oracle of the Wi-Fi channel does wrong (specs/guide/wifi.md has the rules): units,
/// flows, senders that stall, and when messages count.
enum class WifiMistake : std::uint8_t {
  none,
  // Turns.
  first_transmitter_first,  ///< the transmitter of the lowest number is next
  chosen_first_again,       ///< the one chosen last, not least recently
  access_point_first,       ///< the access point before the hosts
  oldest_in_turns,          ///< arbitration: oldest does not look at requests
  queues_by_number,         ///< the access point's queue of the lowest number is next
  queues_in_turns,          ///< the access point's queues take turns with ap_queue: oldest, too
  // Units.
  no_padding,                 ///< frames of a unit have their delimiter, but no padding
  no_delimiter,               ///< or no delimiter
  one_frame_padded,           ///< a frame alone costs what it would in a unit
  overhead_of_one_frame,      ///< several frames have the overhead of one
  limit_of_bytes_excluded,    ///< a unit has less than max_bytes
  limit_of_airtime_excluded,  ///< or takes less than max_airtime
  limit_of_frames_early,      ///< or has fewer than max_frames
  overhead_in_airtime,        ///< max_airtime is about the overhead, too
  multicast_in_units,         ///< the access point sends several multicast frames at once
  multicast_up,               ///< hosts send multicast as multicast
  admission_after_the_unit,   ///< packets are admitted when all frames of a unit have gone on
  // Flows.
  fragments_by_participant,  ///< several fragments are in their participant's flow
  ports_ignored,             ///< a flow has data of applications and all else
  flows_of_multicast,        ///< multicast is in the flow of its participant's unicast
  new_flows_behind_old,      ///< a new flow waits behind the old ones
  empty_flow_leaves,         ///< a new flow that is empty does not wait behind the old ones
  deficit_kept,              ///< a flow that comes back has what was left of its quantum
  zero_deficit_goes_on,      ///< a flow whose quantum is just used up goes on
  returned_frame_uncharged,  ///< what does not fit gives back what it was charged
  returned_frame_in_flow,    ///< or is the first of its flow again
  // Senders.
  creations_go_on,          ///< a participant that stalls creates endpoints
  acknacks_go_on,           ///< or answers HEARTBEATs
  held_again_first,         ///< what is held again is held before what was held since
  held_until_next_packet,   ///< held events happen when one packet has been admitted
  runs_never_stop,          ///< an async run goes on while its participant stalls
  stop_flushes,             ///< or sends its message before it stops
  stop_before_the_last,     ///< or stops though nothing is left
  stopped_run_not_pending,  ///< a run that has stopped can be asked for once more
  counted_at_generation,    ///< messages count at generation, whatever the profile says
  // Listed hosts (specs/guide/fleet.md).
  multicast_at_first_only,  ///< multicast leaves the distribution system at the first access point
  one_channel,              ///< all access points are on one channel
  equal_rates,              ///< every station has the rate of the profile
  nobody_sleeps,            ///< unicast does not wait for a beacon
  dtim_ignored,             ///< multicast follows each beacon
  // Transmissions that fail.
  losses_received,  ///< what failed goes on all the same
  retries_free,     ///< retries take no airtime
  no_bursts,        ///< links are never worse than usual
  // Processors.
  any_number_of_cores,        ///< threads run whenever they have something to do
  receptions_free,            ///< receptions take no time and wait for nothing
  submessages_received_free,  ///< a datagram is received in the same time whatever is in it
  nobody_deaf,                ///< a participant hears from its start on
  // Queues that drop.
  queues_keep_all,          ///< no queue drops anything
  stations_drop_too,        ///< `of` has no effect
  limit_for_each_queue,     ///< the limit is of a queue, not of all that a transmitter has
  returned_frame_limited,   ///< what did not fit into a unit counts towards it
  target_excluded,          ///< a frame that waited for exactly the target waited for less
  last_frames_dropped,      ///< frames are dropped though few bytes are left
  first_drop_at_once,       ///< the first frame is dropped without an interval of waiting
  drops_at_one_distance,    ///< the distance of drops does not shrink
  drops_counted_from_now,   ///< the next one is due a distance after this one, not after its time
  one_drop_at_a_time,       ///< several that are due together are not
  every_storm_begins_anew,  ///< a count is never taken up again
  count_always_taken_up,    ///< or however long ago it was
  longest_loses_one,        ///< over the limit the longest line loses one frame
  longest_loses_all,        ///< or all that it has, 64 at most
  longest_by_frames,        ///< the longest line is that with the most frames
  longest_loses_newest,     ///< it loses what came last
  dropped_frames_charged,   ///< a flow pays for frames that were dropped, too
  dropped_multicast_heard,  ///< what an access point drops is heard by those who hear the rest
  dropped_packet_stays,     ///< a packet whose last fragment was dropped stays in its source queue
};

/// What the oracle of Fast DDS's Discovery Server and its clients does wrong
/// (specs/guide/discovery-server.md has the rules).
enum class ServerMistake : std::uint8_t {
  none,
  // Clients.
  matches_at_first_tick,        ///< a client matches its endpoints before it knows the server
  silent_until_known,           ///< it does not announce itself again until then
  registers_once,               ///< what is not acknowledged is not followed by a HEARTBEAT(p)
  initial_acknowledges,         ///< an initial ACKNACK(p) acknowledges
  gaps_not_received,            ///< what a GAP names is missing still
  base_stays,                   ///< a HEARTBEAT does not raise the base
  heartbeats_announce_nothing,  ///< a HEARTBEAT does not raise what is announced
  // The database.
  periodic_run_stays,           ///< to wake the routine does not cancel its periodic run
  participants_need_no_notice,  ///< descriptors go to those who have not acknowledged the
                                ///< participant
  all_noted_for_good,           ///< new participants do not reset it
  waiting_for_all,              ///< with `relay: once` whoever is checked in the run waits
  announced_without_news,       ///< announcements are sent whether something is new or not
  topics_looked_at_once,        ///< a topic does not stay dirty
  everything_is_looked_at,      ///< nor does it ever leave
  known_topics_stay_clean,      ///< a new super client makes no topic dirty
  own_announcement_once,        ///< nor is the server's own announcement sent again
  // Relays.
  low_is_zero_at_opening,      ///< a new reader has acknowledged nothing
  old_changes_stay,            ///< a change that is in the history keeps its number
  repairs_first,               ///< what is sent again does not wait for new changes
  gaps_cost_nothing,           ///< the thread is not busy for GAPs
  only_other_hosts_cost,       ///< nor for what goes by loopback
  gap_from_low,                ///< a GAP begins above the low mark, whatever is listed between
  gap_each_time,               ///< and comes with a change that is sent again, too
  deliveries_do_not_arm,       ///< no expiry follows
  what_left_is_announced,      ///< a HEARTBEAT's last number may have left the history
  expiries_to_all,             ///< an expiry goes to readers that lack nothing, too
  empty_history_lacks,         ///< with an empty history whoever is below `first` lacks something
  low_does_not_lack,           ///< an expiry goes to those only who have something in U
  acknowledged_is_irrelevant,  ///< a GAP answers requests for what is acknowledged
  gone_is_irrelevant,          ///< or for what is before the history
  requests_never_arm,          ///< a request for what is on its way does not arm
  // A server that is known by its locator.
  announced_at_start,      ///< announcement 0 is sent
  waits_for_routine,       ///< the server does not answer a first announcement at once
  answers_with_heartbeat,  ///< a HEARTBEAT rides in that answer
  answers_before_relays,   ///< it goes before what the relays of descriptors say
  builtin_last,            ///< what is built in opens after the readers and relays
  anything_opens,          ///< a client's reader opens with whatever the server sends it
  meets_silently,          ///< a client that meets the server sends no HEARTBEAT(p)
  greets_once,             ///< or does not repeat it
  strangers_answered,      ///< a client that does not know the server answers it
  // Several servers.
  first_server_only,  ///< a client announces itself to the first of all, if that is one of its own
  told_by_any,        ///< a descriptor that another server has told counts as sent again
};

/// What the oracle of `implementation: cyclone` does wrong (specs/guide/cyclone.md has the rules).
enum class CycloneMistake : std::uint8_t {
  none,
  // Deployment and the event thread.
  hears_before_open,        ///< what arrives before `open` is not lost
  always_ready,             ///< what arrives before `ready` is received at once
  timers_move_later,        ///< a timer moves to a later time, too
  stale_events_fire,        ///< a timer is due at each time that it was ever moved to
  queue_before_timers,      ///< messages of the queue come before timers that are due
  last_copy_takes_no_time,  ///< after the last copy of a packet the thread goes on at once
  name_without_bytes,       ///< a packet to one participant by name lacks 16 bytes
  ports_ignored,            ///< user traffic shares packets with the rest
  version_ignored,          ///< sets of a writer fit, whoever has matched between them
  equal_sets_fit,           ///< sets of several equal addresses fit
  repairs_fill_packets,     ///< retransmissions share packets up to the larger size
  // SPDP.
  announces_to_group_only,  ///< without copies to those that are known
  replies_to_replies,       ///< a directed announcement is answered, too
  reader_opens_first,       ///< the reader side of a pair opens before the writer side
  // Match and creation.
  matched_without_history,  ///< a new reader has acknowledged nothing
  match_keeps_n,            ///< a match does not shorten the HEARTBEAT interval again
  sent_without_readers,     ///< what is created without readers does not count as sent
  creation_keeps_n,         ///< nor does a creation shorten the interval
  creation_leaves_timer,    ///< a creation does not move the HEARTBEAT timer
  // HEARTBEATs.
  interval_not_doubled,  ///< the interval stays
  interval_not_kept,     ///< HEARTBEATs come whenever the timer fires
  replies_not_awaited,   ///< readers that have not replied get none
  heartbeats_to_all,     ///< a HEARTBEAT never goes to a single reader
  single_without_all,    ///< the one who is behind gets it even if nobody has everything
  group_for_one,         ///< a single reader is addressed by the group
  // The reader.
  unseen_data_taken,        ///< DATA is taken before a HEARTBEAT was seen
  data_announces_nothing,   ///< DATA does not raise `last`
  fresh_samples_wait,       ///< what is newer than the first HEARTBEAT is told in order, too
  each_heartbeat_is_first,  ///< nor is it fresh once a later HEARTBEAT announced it
  old_heartbeats_count,     ///< counts of HEARTBEATs are not compared
  asks_once,                ///< the pre-emptive ACKNACK is not repeated
  ack_delay_ignored,        ///< the same ACK is repeated at once
  nack_delay_ignored,       ///< the same request is repeated at once
  new_gaps_wait,            ///< new samples are asked for like old ones
  answers_are_heartbeats,   ///< a directed HEARTBEAT is one like any other
  never_delayed,            ///< the reader forgets that the last request was delayed
  hush_answers_at_once,     ///< a reader that keeps quiet is asked again at once
  never_asks_again,         ///< a reader does not ask again by itself
  bitmap_words_down,        ///< the bitmap takes floor(k/32) words
  // ACKNACKs at the writer.
  old_acknacks_count,    ///< counts of ACKNACKs are not compared
  replies_take_back,     ///< an ACKNACK counts as reply even if it acknowledges less than before
  unsent_repaired,       ///< samples are repeated that have never been sent
  refusals_ignored,      ///< after a refusal the next sample is tried
  repairs_not_merged,    ///< each reader gets a retransmission of its own
  merges_with_itself,    ///< a retransmission that is asked for twice goes to all readers
  repairs_not_answered,  ///< no HEARTBEAT follows retransmissions
  repairs_keep_n,        ///< nor do they shorten the interval
  repairs_leave_timer,   ///< nor move the timer
  answers_replaced,      ///< of two answers in a packet only the last is sent
  answers_at_once,       ///< answers do not wait for the end of the packet
  // Processors, in scenarios that have some.
  receptions_free,         ///< what is received takes no thread
  messages_received_free,  ///< nor do the messages in it
  answers_undirected,      ///< answers are HEARTBEATs like all others
};

inline constexpr std::size_t mistake_count =
    static_cast<std::size_t>(Mistake::answered_expiry_stays) + 1;
/// From this one on they are about the life of participants.
inline constexpr std::size_t first_mistake_of_life =
    static_cast<std::size_t>(Mistake::lease_not_renewed);
inline constexpr std::size_t fastdds_mistake_count =
    static_cast<std::size_t>(FastddsMistake::asks_without_answer) + 1;
/// From this one on they are about the life of participants.
inline constexpr std::size_t first_fastdds_mistake_of_life =
    static_cast<std::size_t>(FastddsMistake::lease_not_renewed);
/// From this one on they are about later versions.
inline constexpr std::size_t first_fastdds_mistake_of_versions =
    static_cast<std::size_t>(FastddsMistake::endpoints_always_first);
/// From this one on they are about lookups of types.
inline constexpr std::size_t first_fastdds_mistake_of_lookups =
    static_cast<std::size_t>(FastddsMistake::types_without_bytes);
inline constexpr std::size_t wifi_mistake_count =
    static_cast<std::size_t>(WifiMistake::dropped_packet_stays) + 1;
/// From this one on they are about queues that drop.
inline constexpr std::size_t first_wifi_mistake_of_queues =
    static_cast<std::size_t>(WifiMistake::queues_keep_all);
/// The last one that scenarios without listed hosts, failing transmissions and processors can show.
inline constexpr WifiMistake last_of_one_access_point = WifiMistake::counted_at_generation;
inline constexpr std::size_t server_mistake_count =
    static_cast<std::size_t>(ServerMistake::told_by_any) + 1;
inline constexpr std::size_t cyclone_mistake_count =
    static_cast<std::size_t>(CycloneMistake::answers_undirected) + 1;

namespace detail {
template <auto Value>
constexpr std::string_view enumerator() {
  const std::string_view text = __PRETTY_FUNCTION__;
  const auto begin = text.rfind("::", text.find_first_of(";]", text.find("Value = "))) + 2;
  return text.substr(begin, text.find_first_of(";]", begin) - begin);
}
template <class Enum, std::size_t... Ks>
constexpr auto enumerators(std::index_sequence<Ks...>) {
  return std::array{enumerator<static_cast<Enum>(Ks)>()...};
}
}  // namespace detail

[[nodiscard]] inline std::string_view name_of(Mistake mistake) {
  constexpr auto names = detail::enumerators<Mistake>(std::make_index_sequence<mistake_count>{});
  return names[static_cast<std::size_t>(mistake)];
}
[[nodiscard]] inline std::string_view name_of(FastddsMistake mistake) {
  constexpr auto names =
      detail::enumerators<FastddsMistake>(std::make_index_sequence<fastdds_mistake_count>{});
  return names[static_cast<std::size_t>(mistake)];
}
[[nodiscard]] inline std::string_view name_of(WifiMistake mistake) {
  constexpr auto names =
      detail::enumerators<WifiMistake>(std::make_index_sequence<wifi_mistake_count>{});
  return names[static_cast<std::size_t>(mistake)];
}
[[nodiscard]] inline std::string_view name_of(ServerMistake mistake) {
  constexpr auto names =
      detail::enumerators<ServerMistake>(std::make_index_sequence<server_mistake_count>{});
  return names[static_cast<std::size_t>(mistake)];
}
[[nodiscard]] inline std::string_view name_of(CycloneMistake mistake) {
  constexpr auto names =
      detail::enumerators<CycloneMistake>(std::make_index_sequence<cyclone_mistake_count>{});
  return names[static_cast<std::size_t>(mistake)];
}

}  // namespace stormproof::oracle
