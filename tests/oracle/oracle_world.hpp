// The whole state of an oracle run as plain structs, and the functions that the oracle's files call
// in each other. One header, so that a reader sees everything that exists in the model on one page.
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
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/oracle_sizes.hpp"
#include "tests/oracle/staged_channel.hpp"

namespace stormproof::oracle {

enum class EventKind {
  service_finished,
  delayed_reception,
  announcement,
  initial_acknack,
  acknack_generation,
  repair_generation,
  source_completion,
  suppression_end,
  heartbeat_expiry,
  cycle_start,
  cycle_end,
  cycle_batch,
  lease_check,
  participant_return,
  endpoint_change,
  dispatch,
};

struct Event {
  EventKind kind = EventKind::dispatch;
  EventClass event_class = EventClass::protocol;  // filled in by schedule
  Id from = 0;  // who acts or acted; for a reader's event the reader
  Id to = 0;
  int stream = 0;
  std::int64_t number = 0;   // announcement number, or delay of an initial ACKNACK
  std::uint64_t token = 0;   // of an adaptive cycle, or of one of measured_ack
  std::uint64_t packet = 0;  // of a service event
  std::size_t stage = 0;
  std::size_t fragment = 0;
  std::string channel;
  std::vector<Id> readers;  // of a batch
  int epoch = 0;            // of its owner when it was scheduled; filled in by schedule
};

enum class PacketKind { spdp, sedp, acknack };

struct Packet {
  PacketKind kind = PacketKind::spdp;
  Id source = 0;
  std::optional<Id> destination;  // none: multicast
  std::int64_t payload = 0;
  int stream = 0;
  std::vector<Id> descriptors;     // DATA in it
  bool carries_heartbeat = false;  // HEARTBEAT in it
  bool repair = false;             // its DATA was generated as a repair
  bool initial = false;            // an initial ACKNACK
  std::set<Id> bitmap;             // of an ACKNACK
  Id announces = 0;                // of a HEARTBEAT: so many exist; of an ACKNACK: are known
  std::uint64_t id = 0;            // from here on: filled in by emit
  Time emitted = 0;
  bool lost = false;
  std::vector<std::int64_t> fragments;        // bytes on the channel
  std::map<std::size_t, std::size_t> served;  // stage → fragments served in it
};

enum class DescriptorState { unsent, requested, queued, suppressed, acknowledged };  // U R Q S A

/// Everything about (source i, destination j, stream s).
struct Relation {
  bool writer_open = false;
  bool reader_open = false;
  bool heartbeat_seen = false;
  std::vector<DescriptorState> state;  // at i
  std::vector<bool> generated;         // at i
  std::vector<bool> received;          // at j
  int pending_acknacks = 0;            // at j; only a mistake asks for it
  int reader_epoch = 0;                // from here on: how often j forgot i
  int writer_epoch = 0;                // and i forgot j
  std::uint32_t old_counts = 0;        // at i: so many ACKNACKs of j count as old
  Id known = 0;                        // at j: so many descriptors exist
};

struct Writer {
  std::int64_t budget = 0;
  int pending_expiries = 0;
  bool active = false;  // from here on: adaptive policy, or measured_ack
  Time period = 0;
  Time cycle_start = 0;
  std::uint64_t token = 0;
  Id written_at_start = 0;  // so many descriptors exist when the participant starts
  Id written = 0;           // and now
  Id cycle_announced = 0;   // and when the cycle started
  std::set<Id> cycle_readers;
  std::set<Id> responded;
};

struct Participant {
  std::uint32_t host = 0;
  Time start = 0;
  std::int64_t sent_bytes = 0;  // of the cumulative piggyback charge
  std::set<Id> known;           // whose announcement it has processed
  std::map<Id, Time> forgets;   // when it forgets whom, if it hears nothing until then
  int lives = 0;                // how often it has come back
  std::deque<std::uint64_t> backlog;
  std::int64_t queued_bytes = 0;
};

struct World {
  explicit World(const model::Scenario& s, Mistake m = Mistake::none);

  [[nodiscard]] bool makes(Mistake m) const { return mistake == m; }

  const model::Scenario& scenario;
  const model::SedpProfile& sedp;
  const Mistake mistake;
  Time now = 0;
  bool ended = false;                                           // by the completion of discovery
  std::map<std::tuple<Time, int, std::uint64_t>, Event> queue;  // (time, class, insertion number)
  std::uint64_t insertions = 0;
  std::uint64_t requests = 0;
  std::vector<Participant> participants;
  std::map<std::tuple<Id, Id, int>, Relation> relations;  // cross-host only
  std::map<std::pair<Id, int>, Writer> writers;
  std::map<std::string, Channel> channels;
  std::map<std::uint64_t, Packet> packets;
  std::set<std::uint64_t> lost_packets;
  std::map<std::pair<Id, Id>, int> lease_epochs;  // (who is remembered, by whom)
  Time settled = 0;                               // the run does not end before
  std::int64_t missing = 0;
  Outcome outcome;
};

// oracle_world.cpp
void schedule(World& w, Time at, EventClass event_class, const Event& event);
[[nodiscard]] bool cross_host(const World& w, Id i, Id j);
[[nodiscard]] bool started(const World& w, Id i);
[[nodiscard]] bool completion_ends(const World& w);
[[nodiscard]] Relation& relation(World& w, Id i, Id j, int s);
[[nodiscard]] bool all_acknowledged(World& w, Id i, Id j, int s);
[[nodiscard]] std::vector<Id> open_readers(World& w, Id i, int s);
[[nodiscard]] std::vector<Id> lacking_readers(World& w, Id i, int s);

// oracle_sizes.cpp (and oracle_sizes.hpp)
[[nodiscard]] Id descriptor_count(const model::Scenario& scenario, Id i, int s);
[[nodiscard]] Id count_at_start(const model::Scenario& scenario, Id i, int s);
[[nodiscard]] std::int64_t descriptor_bytes(const model::Scenario& scenario, int s, Id d);
[[nodiscard]] std::int64_t grouping_limit(const model::SedpProfile& sedp);

// oracle_channel.cpp
void emit(World& w, Packet packet);
void request(World& w, std::uint64_t packet, std::size_t fragment, std::size_t stage);
void leave_source(World& w, const Packet& packet);
void arrive(World& w, const Packet& packet);
void dispatch(World& w, const std::string& channel);
void service_finished(World& w, const Event& event);

// oracle_spdp.cpp
void announce(World& w, Id i, std::int64_t k);
void receive_spdp(World& w, Id j, Id i);

// oracle_reader.cpp
void receive(World& w, const Packet& packet);
void generate_acknack(World& w, Id j, Id i, int s);
void initial_acknack(World& w, Id j, Id i, int s, Time delay);

// oracle_writer.cpp
void open_writer(World& w, Id i, Id j, int s);
void write_descriptor(World& w, Id i, int s);
void arm_heartbeat(World& w, Id i, int s);
void heartbeat_expiry(World& w, const Event& event);
void receive_acknack(World& w, const Packet& packet);
void generate_repair(World& w, Id i, Id j, int s);
void source_completion(World& w, const Packet& packet);
void suppression_end(World& w, Id i, Id j, int s);

// oracle_data.cpp
void generate_heartbeat(World& w, Id i, Id j, int s);
void generate_data(World& w, Id i, Id j, int s, const std::vector<Id>& descriptors, bool repair);

// oracle_life.cpp
void begin_life(World& w);
[[nodiscard]] bool is_away(const World& w, Id i, Time at);
[[nodiscard]] bool is_asked_for(const World& w, Id i, Id j);
[[nodiscard]] bool is_heard(const World& w, const Packet& packet, Id j);
[[nodiscard]] int epoch_of(World& w, const Event& event);
[[nodiscard]] bool is_void(World& w, const Event& event);
void heard(World& w, Id j, Id i);
void lease_check(World& w, Id i, Id j);
void participant_return(World& w, Id i);
void change_endpoints(World& w, const model::LateEndpoints& late);

// oracle_adaptive.cpp
void activate_cycles(World& w, Id i, int s);
void cycle_start(World& w, Id i, int s, std::uint64_t token);
void cycle_end(World& w, Id i, int s, std::uint64_t token);
void cycle_batch(World& w, const Event& event);
void response(World& w, Id i, Id j, int s);

// oracle_measured.cpp
[[nodiscard]] bool measures(const World& w);
void begin_measuring(World& w, Id i, int s);
void measured_expiry(World& w, Id i, int s, std::uint64_t token);
void answered(World& w, Id i, Id j, int s);

}  // namespace stormproof::oracle
