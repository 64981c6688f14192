// The whole state of a run of the oracle of `implementation: fastdds` as plain structs, and the
// functions that its files call in each other. One header, so that a reader sees everything that
// exists in these rules on one page.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "model/scenario.hpp"
#include "tests/oracle/fastdds_oracle.hpp"
#include "tests/oracle/staged_channel.hpp"
#include "tests/oracle/threads.hpp"

namespace stormproof::oracle::fastdds {

using Mistake = FastddsMistake;

constexpr int pub = 0;
constexpr int sub = 1;
constexpr int participants_stream = 2;  // of a Discovery Server and its clients: announcements

// Bytes of a HEARTBEAT to one participant, of an ACKNACK without bitmap, and of a HEARTBEAT to
// several.
constexpr std::int64_t heartbeat_payload = 68;
constexpr std::int64_t acknack_payload = 64;
constexpr std::int64_t heartbeat_to_several = 52;

enum class EventKind {
  service_finished,
  reception,
  announcement,
  creation,
  initial_acknack,
  acknack_generation,
  nack_response,
  async_run,
  suppression_end,
  heartbeat_expiry,
  cycle_start,
  cycle_end,
  cycle_batch,
  control_initial,
  control_reply,
  lookup_expiry,         // of the HEARTBEAT of a writer of questions or answers
  client_tick,           // from here on: with a Discovery Server
  client_expiry,         // of the HEARTBEAT of a client's announcements
  registration_acknack,  // of the server, to a client's announcements
  registration_initial,
  learning_acknack,  // of a client, to a stream of the server
  learning_initial,
  routine,
  sending,
  relay_expiry,
  relay_response,
  relay_suppression_end,
  distribution,  // from here on: with listed hosts. A wired host's packet leaves its cable
  beacon,
  thread_free,  // with processors
  lease_check,  // from here on: of a life
  participant_return,
  dispatch,
};

struct Event {
  EventKind kind = EventKind::dispatch;
  Id from = 0;  // who acts or acted; for a reader's event the reader, for a reception the source
  Id to = 0;
  int stream = 0;
  Id descriptor = 0;         // of a creation
  int topic = 0;             // of a control-only relation
  std::int64_t number = 0;   // announcement number, or delay of an initial ACKNACK
  std::uint64_t token = 0;   // of an adaptive cycle
  std::uint64_t packet = 0;  // of a service event
  std::size_t stage = 0;
  std::size_t fragment = 0;
  std::string channel;
  std::string access_point;  // of a service on the way down, or of a beacon
  bool fails = false;        // a service, in the end
  std::vector<Id> deaf;      // hosts that do not hear it
  int epoch = 0;             // of its owner when it was scheduled; filled in by schedule
};

enum class PacketKind {
  spdp,
  sedp,
  acknack,
  control_heartbeat,
  control_acknack,
  lookup,                  // questions and answers about types, perhaps with a HEARTBEAT
  registration,            // from here on: with a Discovery Server. DATA(p) of a client
  registration_heartbeat,  // and what belongs to it
  registration_acknack,
  relayed,          // DATA, GAP and HEARTBEAT of the server
  learning_acknack  // of a client, to the server's
};

/// What a server passes on: an announcement (stream 2), also its own, or a descriptor.
struct Item {
  Id participant = 0;
  int stream = 0;
  Id descriptor = 0;

  auto operator<=>(const Item&) const = default;
};

/// A question about a type, or an answer.
struct Sample {
  Id number = 0;  // of its writer
  Id from = 0;    // who sends it
  Id to = 0;      // who is meant, whoever hears it
  bool is_question = true;
  bool is_about_dependencies = true;  // otherwise about the type itself
  int stream = 0;                     // of the descriptor that the chain began with
  std::vector<std::string> types;     // one, or all that are asked for at once
};

struct Packet {
  PacketKind kind = PacketKind::spdp;
  Id source = 0;
  std::optional<Id> destination;  // none: multicast
  bool to_nobody = false;         // to a port of another host that nobody has
  std::int64_t payload = 0;
  int stream = 0;
  int topic = 0;
  int port = 0;                 // 1: data of applications
  std::vector<Id> descriptors;  // DATA in it
  std::optional<Id> announced;  // HEARTBEAT in it: how many descriptors it announces
  Id heartbeats = 0;            // HEARTBEATs that ride with DATA, or instead of it
  Id initial_data = 0;          // of the DATA: those that count as such
  Id repair_data = 0;
  bool initial = false;  // an initial ACKNACK
  Id base = 0;           // of an ACKNACK
  std::set<Id> bitmap;   // of an ACKNACK
  std::vector<Sample> samples;
  Id sample_count = 0;       // of questions or answers: announced by a HEARTBEAT, got by an ACKNACK
  std::optional<Item> item;  // from here on: of and to a server. What a DATA carries
  std::int64_t item_number = 0;
  std::set<std::int64_t> numbers;  // of a GAP, or requested by an ACKNACK
  bool has_heartbeat = false;
  std::int64_t first = 0;  // what the HEARTBEAT announces
  std::int64_t last = 0;
  std::int64_t number_base = 1;  // of an ACKNACK
  std::uint64_t id = 0;          // from here on: filled in by emit
  Time emitted = 0;
  bool lost = false;
  bool stopped = false;                       // a fragment did not get to the access point
  std::size_t gone = 0;                       // fragments that have left the station
  std::set<Id> deaf;                          // hosts that did not hear all of it
  std::vector<std::int64_t> fragments;        // bytes on the channel
  std::map<std::size_t, std::size_t> served;  // stage → fragments served in it
};

enum class DescriptorState { unsent, requested, queued, suppressed, acknowledged };  // U R Q S A

/// Everything about (source i, destination j, stream s).
struct Relation {
  bool writer_open = false;  // at i from here on
  std::vector<DescriptorState> state;
  Id low = 0;
  bool suppression_pending = false;
  std::vector<bool> delivered;
  bool reader_open = false;  // at j from here on
  bool heartbeat_seen = false;
  bool acknack_pending = false;
  std::vector<bool> received;
  Id announced = 0;
  Id handed_over = 0;    // descriptors below it have been notified, or wait for their types
  std::set<Id> waiting;  // for their types
  int reader_epoch = 0;  // from here on: how often j forgot i
  int writer_epoch = 0;  // and i forgot j
};

struct Writer {
  std::vector<Id> readers;  // M, in match order
  Id existing = 0;          // H
  std::int64_t budget = 0;
  std::int64_t group_number = 0;
  bool expiry_pending = false;
  bool response_pending = false;
  bool active = false;  // from here on: adaptive policy
  Time period = 0;
  Time cycle_start = 0;
  Id cycle_existing = 0;  // H at the cycle start
  std::uint64_t token = 0;
  std::set<Id> cycle_readers;
  std::vector<std::vector<Id>> batches;  // of the last cycle, that are due
  std::set<Id> responded;
};

/// A control-only relation: liveliness, or the user data of a topic.
struct Control {
  bool writer_open = false;
  bool reader_open = false;
  bool heartbeat_seen = false;
  bool reply_pending = false;
  int epoch = 0;  // how often the reader forgot the writer
  // Of questions and answers: how many samples the writer takes as acknowledged, and how many the
  // reader has got.
  Id low = 0;
  Id got = 0;
  Id told = 0;  // and the last one that went to the reader
};

/// The message that a creation or an async run fills.
struct Message {
  int stream = 0;                // or `questions` or `answers`
  std::vector<Id> destinations;  // in match order
  std::int64_t bytes = 0;
  std::vector<Id> descriptors;
  std::vector<Sample> samples;
  std::optional<Id> announced;
  Id heartbeats = 0;
  std::map<Id, Id> initial_data;  // by destination on another host
  std::map<Id, Id> repair_data;
};

struct Participant {
  threads::Thread<Event> thread;
  std::optional<Message> unfinished;  // of an async run that has stopped
  std::vector<Event> held;            // while it stalls
  std::vector<std::pair<int, Id>> to_create;
  std::uint32_t host = 0;
  Time start = 0;
  Time hears_from = 0;
  std::set<Id> known;          // whose announcement it has processed
  std::map<Id, Time> forgets;  // when it forgets whom, if it hears nothing until then
  int lives = 0;               // how often it has come back
  std::deque<std::pair<int, Id>> async_queue;  // (stream, descriptor)
  std::deque<Sample> samples;                  // the same, before descriptors
  std::set<std::string> looked_up;             // types
  std::set<Id> asked;                          // for all its types, and has not answered
  bool run_pending = false;
  std::int64_t sent_bytes = 0;  // of the cumulative piggyback charge
  std::int64_t group_bytes = 0;
  std::int64_t group_number = 0;
  std::deque<std::uint64_t> backlog;
  std::int64_t queued_bytes = 0;
};

/// A reader of one of the server's streams, as the server's writer sees it.
struct RelayReader {
  std::int64_t low = 0;
  std::map<std::int64_t, DescriptorState> list;  // by number; never `acknowledged`
  std::set<std::int64_t> sent;
  bool suppression_pending = false;
};

/// One of the server's three writers.
struct Relay {
  std::map<std::int64_t, Item> history;
  std::int64_t next = 1;
  std::vector<Id> readers;  // in match order
  std::map<Id, RelayReader> about;
  bool expiry_pending = false;
  bool response_pending = false;

  [[nodiscard]] std::int64_t first() const {
    return history.empty() ? next : history.begin()->first;
  }
  [[nodiscard]] std::int64_t last() const {
    return history.empty() ? next - 1 : history.rbegin()->first;
  }
};

/// A client's reader of one of the server's streams.
struct Learner {
  bool open = false;
  bool heartbeat_seen = false;
  bool acknack_pending = false;
  std::int64_t base = 1;
  std::int64_t announced = 0;
  std::set<std::int64_t> received;
};

/// A client's announcements, and what the server knows of them.
struct Registration {
  bool acknowledged = false;
  bool expiry_pending = false;
  bool knows_server = false;
  bool joined = false;  // at the server from here on
  bool heartbeat_seen = false;
  bool reply_pending = false;
};

struct Topic {
  std::vector<Item> publications;  // in arrival order
  std::vector<Item> subscriptions;
};

/// A Discovery Server; they have the numbers after all participants.
struct Server {
  std::map<Id, Registration> clients;
  std::map<std::pair<Id, int>, Learner> learners;  // (client, stream)
  std::map<int, Relay> relays;             // 0 publications, 1 subscriptions, 2 participants
  std::deque<std::pair<int, Item>> fresh;  // items to be sent, oldest first
  std::deque<std::pair<int, Item>> stale;  // the same, to be sent again
  bool sending = false;
  std::vector<Id> joining;    // waiting for the routine
  std::vector<Item> arrived;  // waiting for the routine
  std::set<std::pair<Item, Id>> marked;
  std::set<std::pair<Item, Id>> noted;
  std::set<std::pair<Item, Id>> waiting;
  std::set<std::pair<Item, Id>> told;  // descriptors, by it
  using TopicKey = std::tuple<int, Id, int, Id>;
  std::map<TopicKey, Topic> topics;
  std::vector<TopicKey> dirty;
  std::vector<Id> supers;
  std::int64_t news = 0;
  bool all_noted = false;
  bool routine_pending = false;  // an immediate one
  std::uint64_t token = 0;       // of the periodic run that still counts
};

/// A fragment that waits for a place in a unit.
struct Frame {
  std::uint64_t number = 0;  // of its request
  std::uint64_t packet = 0;
  std::size_t fragment = 0;
  std::int64_t bytes = 0;
  std::string flow;
  Time since = 0;
};

/// What CoDel remembers of a line of frames, by the names of RFC 8289.
struct CodelState {
  bool dropping = false;
  std::optional<Time> first_above_time;
  Time drop_next = 0;
  std::int64_t count = 0;
  std::int64_t lastcount = 0;
};

/// A frame that a station, or else an access point, has dropped.
struct Drop {
  Frame frame;
  std::optional<std::string> access_point;
};

/// What a transmitter has for one destination.
struct UnitQueue {
  std::optional<std::string> access_point;  // that it is at
  std::map<std::string, CodelState> codel;  // by flow
  std::uint64_t chosen = 0;
  std::vector<Frame> frames;  // by arrival
  std::optional<Frame> returned;
  std::vector<std::string> new_flows;
  std::vector<std::string> old_flows;
  std::map<std::string, std::int64_t> deficits;
};

struct Transmitter {
  std::uint64_t chosen = 0;
  std::map<Id, UnitQueue> queues;  // of the access point: 0 multicast, 1 + host; of a host: 0
};

/// The channel of `service: unit`.
struct Air {
  bool busy = false;
  bool dispatch_pending = false;
  std::uint64_t choices = 0;
  std::map<Id, Transmitter> transmitters;  // by host; the access point's number is the last
  bool down = false;
  std::vector<Frame> unit;   // being sent
  std::vector<bool> fails;   // by frame, in the end
  std::vector<Id> deaf;      // hosts that do not hear the multicast in it
  std::string access_point;  // that sends it
};

struct World {
  explicit World(const model::Scenario& s, FastddsMistake m = FastddsMistake::none,
                 WifiMistake of_wifi = WifiMistake::none,
                 ServerMistake of_server = ServerMistake::none);

  [[nodiscard]] bool makes(FastddsMistake m) const { return mistake == m; }
  [[nodiscard]] bool makes(WifiMistake m) const { return wifi_mistake == m; }
  [[nodiscard]] bool makes(ServerMistake m) const { return server_mistake == m; }

  const model::Scenario& scenario;
  const model::SedpProfile& sedp;  // of all, with a Discovery Server
  const FastddsMistake mistake;
  const WifiMistake wifi_mistake;
  const ServerMistake server_mistake;
  Time now = 0;
  bool ended = false;  // by the completion of discovery
  std::map<std::tuple<Time, EventClass, std::uint64_t>, Event> queue;
  std::uint64_t insertions = 0;
  std::uint64_t requests = 0;
  std::vector<Participant> participants;
  std::map<std::tuple<Id, Id, int>, Relation> relations;
  std::map<std::pair<Id, int>, Writer> writers;
  std::map<std::tuple<Id, Id, int>, Control> controls;  // (source, destination, topic)
  /// Descriptors (of whom, which) that wait at a participant: by it, their stream and their type.
  std::map<std::tuple<Id, int, std::string>, std::vector<std::pair<Id, Id>>> waiting;
  std::map<std::string, Channel> channels;
  std::map<std::string, Air> airs;  // by channel of access points
  std::deque<Drop> drops;           // of this event
  std::map<std::pair<std::string, Time>, std::vector<std::pair<std::uint64_t, std::size_t>>>
      asleep;                           // (access point, beacon) → packets and fragments
  std::map<Id, std::deque<Id>> queues;  // for a core, by host
  std::map<Id, std::uint32_t> running;
  Time cost = 0;  // of what a thread does now
  std::mt19937_64 random;
  std::map<Id, bool> worse;                 // links, by station
  std::map<std::uint64_t, Packet> packets;  // loopback packets too
  std::set<std::uint64_t> lost_packets;
  std::map<std::pair<Id, Id>, int> lease_epochs;  // (who is remembered, by whom)
  Time settled = 0;                               // the run does not end before
  std::int64_t missing = 0;
  std::map<Id, Server> servers;
  Server* server = nullptr;  // that whose business is done, if there is any
  Id serving = 0;
  FastddsOutcome outcome;
  FastddsOutcome admitted;  // its counts, of admitted packets

  [[nodiscard]] Id server_id() const { return serving; }
  [[nodiscard]] bool is_server(Id i) const { return i >= scenario.deployment.size(); }
  void serve(Id id) {
    serving = id;
    server = &servers.at(id);
  }
};

// fastdds_world.cpp
[[nodiscard]] Event make_event(EventKind kind, Id from, Id to, int s);
void schedule(World& w, Time at, EventClass event_class, const Event& event);
void schedule_after(World& w, model::Nanoseconds delay, const Event& event);
[[nodiscard]] bool cross_host(const World& w, Id i, Id j);
[[nodiscard]] bool started(const World& w, Id i);
[[nodiscard]] bool adaptive(const World& w, Id i);
// What participant i runs, and what it says of the streams.
[[nodiscard]] const model::DdsProfile& profile(const World& w, Id i);
[[nodiscard]] inline const model::SedpProfile& sedp(const World& w, Id i) {
  return profile(w, i).sedp;
}
[[nodiscard]] Relation& relation(World& w, Id i, Id j, int s);
[[nodiscard]] Writer& writer(World& w, Id i, int s);

[[nodiscard]] inline bool knows_guid(const World& w) {
  return w.scenario.dds.server.known == model::ServerKnown::guid;
}

// fastdds_descriptors.cpp
[[nodiscard]] Id descriptor_count(const model::Scenario& scenario, Id i, int s);
[[nodiscard]] std::vector<std::pair<int, Id>> creation_order(const model::Scenario& scenario, Id i);
[[nodiscard]] inline bool has_sizes_of_3(const World& w, Id i) {
  return profile(w, i).version.sizes != model::SizesSince::v2_6;
}
[[nodiscard]] std::int64_t submessage_bytes(const World& w, Id i, int s, Id d);
constexpr int no_topic = -2;
constexpr int liveliness = -1;
constexpr int questions = -3;  // of types
constexpr int answers = -4;
[[nodiscard]] inline bool is_builtin(int topic) { return topic < 0; }
[[nodiscard]] inline bool is_lookup(int topic) { return topic == questions || topic == answers; }
[[nodiscard]] int topic_of(int s, Id d);
[[nodiscard]] Id descriptor_of(int s, int topic);

// fastdds_channel.cpp
void emit(World& w, Packet packet);
void request(World& w, std::uint64_t packet, std::size_t fragment, std::size_t stage);
void leave_source(World& w, const Packet& packet);
void arrive(World& w, const Packet& packet);
void arrive_at(World& w, const Packet& packet, const std::string& access_point);
void arrive_on_cable(World& w, const Packet& packet);
void request_frame(World& w, const Packet& packet, std::size_t fragment, std::size_t stage,
                   const std::string& access_point);
void request_up(World& w, const Packet& packet, std::size_t fragment);
void dispatch(World& w, const std::string& name);
void service_finished(World& w, const Event& event);

// fastdds_units.cpp
void request_unit(World& w, const Packet& packet, std::size_t fragment, bool down,
                  const std::string& access_point);
void dispatch_unit(World& w, const std::string& radio);
void unit_finished(World& w, const std::string& radio);

// fastdds_queues.cpp
/// The flow of each frame where flows are kept apart; otherwise all are in one line.
[[nodiscard]] bool finds_room(World& w, Transmitter& at, UnitQueue& queue, const Frame& frame);
void shorten(World& w, Transmitter& at, UnitQueue& joined);
[[nodiscard]] Frame take_from_line(World& w, UnitQueue& queue, const std::string& flow);
void settle_drops(World& w);

// fastdds_fleet.cpp
[[nodiscard]] bool over_access_points(const World& w);
[[nodiscard]] bool is_wired(const World& w, Id host);
[[nodiscard]] Id host_total(const World& w);
[[nodiscard]] std::vector<std::string> access_points(const World& w);
[[nodiscard]] std::string access_point_of(const World& w, Id host);
[[nodiscard]] std::string radio_of(const World& w, const std::string& access_point);
[[nodiscard]] bool is_station(const World& w, Id host, const std::string& access_point);
[[nodiscard]] std::int64_t rate_of(const World& w, Id host, std::int64_t usual);
[[nodiscard]] bool transmission_fails(World& w, Id host);
[[nodiscard]] std::vector<Id> deaf_to_multicast(World& w, const Packet& packet,
                                                const std::string& access_point);
void distribute(World& w, std::uint64_t packet, std::size_t fragment);
void distribution(World& w, std::uint64_t packet);
void beacon(World& w, const std::string& access_point);
void leave_wired_host(World& w, const Packet& packet);

// fastdds_run.cpp
void schedule_creations(World& w, Id i, Time start);

// fastdds_life.cpp
void begin_life(World& w);
/// How many who live know somebody who does not.
[[nodiscard]] std::int64_t count_held_in_vain(const World& w);
/// j has heard of i.
void get_to_know(World& w, Id i, Id j);
void schedule_returns(World& w);
[[nodiscard]] bool ends_complete(const World& w);
[[nodiscard]] bool is_away(const World& w, Id i, Time at);
[[nodiscard]] bool is_heard(const World& w, const Packet& packet, Id j);
[[nodiscard]] int epoch_of(World& w, const Event& event);
[[nodiscard]] bool is_void(World& w, EventClass event_class, const Event& event);
void heard(World& w, Id j, Id i);
void lease_check(World& w, Id i, Id j);
void participant_return(World& w, Id i);

// fastdds_stalls.cpp
[[nodiscard]] bool stalls(const World& w, Id i);
[[nodiscard]] bool is_held(World& w, const Event& event);
void wake(World& w, Id i);
void count_admitted(World& w, const Packet& packet);

// fastdds_threads.cpp
[[nodiscard]] std::optional<Id> who_acts(const World& w, EventClass event_class,
                                         const Event& event);
[[nodiscard]] bool begins(World& w, Id i, std::uint64_t number, EventClass event_class,
                          const Event& event);
void finish(World& w, Id i);
void thread_free(World& w, Id i);
[[nodiscard]] bool hears(const World& w, Id i);
void charge_sending(World& w, const Packet& packet);
void charge_reception(World& w, const Packet& packet);

// fastdds_spdp.cpp
void announce(World& w, Id i, std::int64_t k);
void receive_spdp(World& w, Id j, Id i);

// fastdds_reader.cpp
void note_completion(World& w);
void receive(World& w, const Packet& packet, Id j);
void generate_acknack(World& w, Id j, Id i, int s);
void initial_acknack(World& w, Id j, Id i, int s, Time delay);

// fastdds_writer.cpp
void open_writer(World& w, Id i, Id j, int s);
void arm(World& w, Id i, int s);
void heartbeat(World& w, Id i, Id j, int s, std::int64_t payload);
void heartbeat_expiry(World& w, Id i, int s);
void receive_acknack(World& w, const Packet& packet);
void nack_response(World& w, Id i, int s);
void suppression_end(World& w, Id i, Id j, int s);

// fastdds_message.cpp
void create(World& w, Id i, int s, Id d);
void async_run(World& w, Id i);

// fastdds_lookups.cpp
[[nodiscard]] bool with_types(const World& w);
// Whether both have endpoints that ask for types; whether there is something to ask for, too.
[[nodiscard]] bool asks_for_types_of(const World& w, Id i, Id j);
[[nodiscard]] bool asks_for_types(const World& w, Id i, Id j);
[[nodiscard]] std::int64_t sample_bytes(const World& w, const Sample& sample);
void hand_over(World& w, Id i, Id j, int s, Id d);
void ask_for_all(World& w, Id j, Id i);
void receive_samples(World& w, const Packet& packet);
void arm_lookups(World& w, Id i, int topic);
void lookup_expiry(World& w, Id i, int topic);

// fastdds_control.cpp
[[nodiscard]] Control& control(World& w, Id i, Id j, int topic);
void send_control(World& w, PacketKind kind, Id from, Id to, int topic, bool initial,
                  std::int64_t payload);
void open_control_writer(World& w, Id i, Id j, int topic);
void open_control_reader(World& w, Id i, Id j, int topic);
void open_builtin(World& w, Id i, Id j);
void created(World& w, Id i, int s, Id d);
void notified(World& w, Id i, Id j, int s, Id d);
void receive_control_heartbeat(World& w, const Packet& packet);
void receive_control_acknack(World& w, const Packet& packet);
void control_reply(World& w, Id j, Id i, int topic);
void control_initial(World& w, Id j, Id i, int topic, Time delay);

// server_client.cpp
[[nodiscard]] bool is_needed(const World& w, Id i, Id j, int s, Id d);
void announce_to_servers(World& w, Id i, std::int64_t k);
void client_tick(World& w, Id i);
void client_expiry(World& w, Id i);
void receive_registration_acknack(World& w, const Packet& packet);
void receive_relayed(World& w, const Packet& packet);
void learning_acknack(World& w, Id j, int stream);
void learning_initial(World& w, Id j, int stream, Time delay);

// server_database.cpp
void receive_registration(World& w, const Packet& packet);
void receive_registration_heartbeat(World& w, Id i);
void registration_acknack(World& w, Id i);
void registration_initial(World& w, Id i, Time delay);
void server_learns(World& w, Id i, int s, const std::vector<Id>& descriptors);
void routine(World& w, std::uint64_t token);
[[nodiscard]] bool is_relevant(const World& w, const Item& item, Id j);

// server_relay.cpp
void open_relay(World& w, int stream, Id j);
void send_own_announcement(World& w, Id j);
void insert(World& w, int stream, const Item& item);
void remove(World& w, int stream, const Item& item);
void send_next(World& w);
void relay_expiry(World& w, int stream);
void relay_response(World& w, int stream);
void relay_suppression_end(World& w, int stream, Id j);
void receive_learning_acknack(World& w, const Packet& packet);

// fastdds_spdp.cpp
void open_reader(World& w, Id j, Id i, int s);

// fastdds_adaptive.cpp
void activate_cycles(World& w, Id i, int s);
void cycle_start(World& w, Id i, int s, std::uint64_t token);
void cycle_end(World& w, Id i, int s, std::uint64_t token);
void cycle_batch(World& w, const Event& event);
void response(World& w, Id i, Id j, int s);

}  // namespace stormproof::oracle::fastdds
