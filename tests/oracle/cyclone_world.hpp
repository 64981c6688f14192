// The whole state of a run of the oracle of `implementation: cyclone` as plain structs, and the
// functions that its files call in each other.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "model/scenario.hpp"
#include "tests/oracle/cyclone_oracle.hpp"
#include "tests/oracle/staged_channel.hpp"
#include "tests/oracle/threads.hpp"

namespace stormproof::oracle::cyclone {

using Mistake = CycloneMistake;
using Sample = std::int64_t;  // from 1

constexpr Time never = INT64_MAX;
constexpr Time long_ago = INT64_MIN / 4;
constexpr Time half_second = 500'000'000;

// The writers of a participant: five builtin ones, then one for each topic.
constexpr int publications = 0;
constexpr int subscriptions = 1;
constexpr int liveliness = 2;
constexpr int builtins = 5;

enum class EventKind {
  service_finished,
  reception,
  start,
  creation,
  timer,
  run,
  lease,
  death,
  dispatch,
  thread_free  // with processors
};

struct Event {
  EventKind kind = EventKind::dispatch;
  Id who = 0;                // who acts, or receives
  Id peer = 0;               // of a lease: whose
  int stream = 0;            // of a creation
  Sample sample = 0;         // of a creation
  std::size_t timer = 0;     // position in the world's list
  std::uint64_t packet = 0;  // of a service event
  std::size_t stage = 0;
  std::size_t fragment = 0;
  std::string channel;
};

enum class TimerKind { announcement, reply, heartbeat, acknack, liveliness };

struct Timer {
  TimerKind kind = TimerKind::announcement;
  Id owner = 0;  // whose event thread it is
  Id peer = 0;   // of a reply, or the writer's participant of an ACKNACK
  int writer = 0;
  Time due = never;
  bool listed = false;
  int sent = 0;           // of a reply
  bool given_up = false;  // of a reply: who it is for has been forgotten
};

constexpr Id group = UINT32_MAX;  // as an address: the multicast group

struct Destination {
  bool set = false;           // otherwise one participant by name
  std::vector<Id> addresses;  // the group first, then ascending
  Id owner = 0;               // of a set: the writer's participant
  int writer = -1;            // −1: an announcement's set
  std::uint64_t version = 0;
};

enum class MessageKind { spdp, data, heartbeat, acknack, gap };

struct Message {
  MessageKind kind = MessageKind::spdp;
  Id owner = 0;    // the writer's participant; of an SPDP the announced one
  int writer = 0;  // which of its writers
  Destination to;
  std::int64_t bytes = 0;
  bool directed = false;        // SPDP, HEARTBEAT
  bool retransmission = false;  // DATA
  Sample sample = 0;            // DATA: its number; HEARTBEAT: what it announces
  std::int64_t count = 0;       // HEARTBEAT, ACKNACK
  Sample base = 0;              // ACKNACK
  Sample first = 1;             // HEARTBEAT: the lowest that exists
  bool completes = false;       // the packet that it joins is sent at once
  std::set<Sample> bitmap;      // ACKNACK; GAP: what exists no more
};

struct Packet {
  Id source = 0;
  std::optional<Id> destination;  // none: the group
  std::int64_t payload = 0;
  std::vector<Message> messages;
  std::uint64_t id = 0;  // from here on: filled in by emit
  bool lost = false;
  Time emitted = 0;
  std::vector<std::int64_t> fragments;
  std::map<std::size_t, std::size_t> served;
};

struct Matched {
  Sample acked = 0;
  bool replied = false;
  std::int64_t last_count = 0;
  Time accepted = long_ago;
};

struct Writer {
  Sample history = 0;
  Sample first = 1;  // lower ones exist no more
  Sample sent = 0;
  std::int64_t count = 0;
  std::int64_t n = 0;
  Time t_hb = long_ago;
  std::size_t timer = 0;
  std::map<Id, Matched> readers;
  std::uint64_t version = 0;
};

/// The reader side of (writer of i, reader j).
struct Reader {
  bool open = false;
  Time opened = 0;
  bool seen = false;
  bool since = false;
  bool wanted = false;
  bool directed = false;
  bool by_delay = false;
  std::set<Sample> received;
  Sample last = 0;
  std::int64_t last_count = 0;
  Time accepted = long_ago;
  Time t_ack = long_ago;
  Time t_nack = long_ago;
  Sample base = 0;
  Sample end = 0;
  std::int64_t next_count = 1;
  std::size_t timer = 0;
  Sample first_heard = 0;  // announced by the first HEARTBEAT
  std::set<Sample> notified;
};

struct Participant {
  threads::Thread<Event> thread;  // with processors
  std::uint32_t host = 0;
  Time start = 0;
  Time open = 0;
  Time ready = 0;
  Time hears_from = 0;
  std::set<Id> known;
  std::size_t announcement = 0;  // its timer
  std::set<std::pair<int, Sample>> created;
  // The event thread.
  bool run_scheduled = false;
  bool running = false;
  std::deque<std::size_t> due;
  std::deque<Message> given;  // by the timer that fires
  std::deque<Message> queue;
  std::vector<Message> open_packet;
  std::optional<Message> held;
  std::vector<Message> sending;
  std::deque<Id> left;  // destinations of what is being sent
  // The source queue.
  std::deque<std::uint64_t> backlog;
  std::int64_t queued_bytes = 0;
};

struct World {
  World(const model::Scenario& s, Mistake m);

  [[nodiscard]] bool makes(Mistake m) const { return mistake == m; }

  const model::Scenario& scenario;
  const model::SpdpProfile& spdp;
  const model::SedpProfile& sedp;
  const bool multicast;
  const Mistake mistake;
  Time now = 0;
  bool ended = false;
  std::map<std::tuple<Time, EventClass, std::uint64_t>, Event> queue;
  std::uint64_t insertions = 0;
  std::uint64_t requests = 0;
  std::vector<Participant> participants;
  std::vector<Timer> timers;
  std::map<std::pair<Id, int>, Writer> writers;
  std::map<std::tuple<Id, int, Id>, Reader> readers;    // (i, writer of i, j)
  std::set<std::tuple<Id, int, Sample, Id>> delivered;  // first copies: to whom, or the group
  std::map<std::string, Channel> channels;
  std::map<std::uint64_t, Packet> packets;
  std::set<std::uint64_t> lost_packets;
  std::map<Id, std::deque<Id>> queues;  // for a core, by host
  std::map<Id, std::uint32_t> running;
  Time cost = 0;  // of what a thread does now
  /// An answer that is kept while a packet is processed.
  std::optional<Message> kept;
  std::int64_t missing = 0;
  CycloneOutcome outcome;
  // With a life: when who is forgotten by whom, whose checks are pending, and what had been sent
  // when discovery was complete for the last time.
  const bool lives;
  std::map<std::pair<Id, Id>, Time> deadlines;
  std::set<std::pair<Id, Id>> leases;
  std::map<Id, std::set<Id>> ever_known;
  CycloneOutcome until_discovery;
};

// cyclone_world.cpp
void schedule(World& w, Time at, EventClass event_class, const Event& event);
[[nodiscard]] bool cross_host(const World& w, Id i, Id j);
[[nodiscard]] Id endpoint_count(const World& w, Id i, int stream);
[[nodiscard]] std::vector<std::pair<int, Sample>> creation_order(const World& w, Id i);
[[nodiscard]] std::int64_t descriptor_bytes(int stream, Sample sample);
/// The user writer of a descriptor's topic, or nothing.
[[nodiscard]] std::optional<int> topic_writer(int stream, Sample sample);
/// The sample of a stream on the topic of a user writer.
[[nodiscard]] Sample sample_on(int stream, int writer);

// cyclone_thread.cpp
std::size_t new_timer(World& w, Timer timer);
void move(World& w, std::size_t timer, Time to);
void timer_event(World& w, std::size_t timer);
void enqueue(World& w, Id i, Message message);
void run_thread(World& w, Id i);

// cyclone_channel.cpp
void emit(World& w, Packet packet);
void request(World& w, std::uint64_t packet, std::size_t fragment, std::size_t stage);
void leave_source(World& w, const Packet& packet);
void arrive(World& w, const Packet& packet);
void dispatch(World& w, const std::string& name);
void service_finished(World& w, const Event& event);

// cyclone_processors.cpp
[[nodiscard]] bool hears(const World& w, Id i);
[[nodiscard]] std::optional<Id> who_acts(const World& w, const Event& event);
void finish(World& w, Id i);
void charge_sending(World& w, const Packet& packet);
void charge_reception(World& w, const Packet& packet);

// cyclone_discovery.cpp
void start(World& w, Id i);
void announce(World& w, Id i);
void receive_spdp(World& w, Id j, const Message& m);
void create(World& w, Id i, int stream, Sample sample);
void receive_data(World& w, Id j, const Message& m);
std::optional<Message> fire_announcement(World& w, const Timer& timer, std::size_t number);
std::optional<Message> fire_reply(World& w, std::size_t number);

// cyclone_life.cpp
[[nodiscard]] Time lease_of(const World& w, Id i);
[[nodiscard]] Time liveliness_period(const World& w, Id i);
[[nodiscard]] Time announcement_period(const World& w, Id i);
[[nodiscard]] int replies_due(const World& w, Id i);
[[nodiscard]] bool is_dead(const World& w, Id i, Time at);
[[nodiscard]] bool reaches(const World& w, const Packet& packet, Id j);
void hear(World& w, Id j, Id i);
void begin_lease(World& w, Id j, Id i);
void lease_event(World& w, Id i, Id j);
void say_liveliness(World& w, Id i, std::size_t timer);
void note_completeness(World& w);

// cyclone_writer.cpp
[[nodiscard]] Message heartbeat_to(World& w, Id i, int writer, const Destination& to);
void open_writer(World& w, Id i, int writer, Id j);
[[nodiscard]] Destination readers_of(const World& w, Id i, int writer);
[[nodiscard]] Destination only(Id j);
std::optional<Message> fire_heartbeat(World& w, Id i, int writer);
void receive_acknack(World& w, Id i, const Message& m, Id from);
void let_answer_go(World& w, Id i);
[[nodiscard]] Message data_message(const World& w, Id i, int writer, Sample sample);

// cyclone_reader.cpp
void open_reader(World& w, Id i, int writer, Id j);
void receive_gap(World& w, Id j, const Message& m);
void receive_heartbeat(World& w, Id j, const Message& m);
std::optional<Message> fire_acknack(World& w, Id i, int writer, Id j);

}  // namespace stormproof::oracle::cyclone
