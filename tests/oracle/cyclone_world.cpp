// How a world of the oracle of `implementation: cyclone` begins, and what a ROS 2 participant has.
#include "tests/oracle/cyclone_world.hpp"

#include <stdexcept>

namespace stormproof::oracle::cyclone {

namespace {

constexpr Id default_endpoints[] = {9, 8};

const std::vector<std::int64_t>& default_bytes(int stream) {
  static const std::vector<std::int64_t> pub{248, 240, 264, 268, 264, 276, 268, 264, 248};
  static const std::vector<std::int64_t> sub{264, 284, 288, 284, 292, 288, 284, 264};
  return stream == publications ? pub : sub;
}

void add_participant(World& w, const model::Participant& p) {
  Participant participant;
  participant.host = p.host.value;
  participant.start = p.start.count();
  participant.open = p.open.value_or(p.start).count();
  participant.ready = p.ready.value_or(p.start).count();
  if (p.endpoints_done < p.start || participant.ready < participant.start ||
      participant.open > participant.start) {
    throw std::invalid_argument{"open, start, ready and done in another order"};
  }
  w.participants.push_back(participant);
}

void add_writers(World& w, Id i) {
  Timer timer;
  timer.owner = i;
  w.participants.at(i).announcement = new_timer(w, timer);
  timer.kind = TimerKind::heartbeat;
  const int topics = 2 + static_cast<int>(w.scenario.deployment.participants.at(i).publications);
  for (int writer = 0; writer < builtins + topics; ++writer) {
    timer.writer = writer;
    Writer state;
    state.timer = new_timer(w, timer);
    if (writer == liveliness) state.history = state.sent = 1;
    w.writers[{i, writer}] = state;
  }
}

void add_readers(World& w, Id i, Id j) {
  Timer timer;
  timer.kind = TimerKind::acknack;
  timer.owner = j;
  timer.peer = i;
  for (int writer = 0; w.writers.contains({i, writer}); ++writer) {
    timer.writer = writer;
    Reader state;
    state.timer = new_timer(w, timer);
    w.readers[{i, writer, j}] = state;
  }
  if (!cross_host(w, i, j)) return;
  w.missing += endpoint_count(w, i, publications) + endpoint_count(w, i, subscriptions);
}

}  // namespace

World::World(const model::Scenario& s, Mistake m)
    : scenario{s},
      spdp{s.dds.spdp},
      sedp{s.dds.sedp},
      multicast{s.dds.allow_multicast == model::AllowMulticast::always},
      mistake{m},
      lives{s.deployment.life.has_value()} {
  for (const model::Participant& p : s.deployment.participants) add_participant(*this, p);
  const Id n = s.deployment.size();
  for (Id i = 0; i < n; ++i) add_writers(*this, i);
  for (Id i = 0; i < n; ++i) {
    for (Id j = 0; j < n; ++j) {
      if (i != j) add_readers(*this, i, j);
    }
  }
  threads::draw_deafness(*this, [](const Participant& p) { return p.open; });
  if (missing == 0) throw std::invalid_argument{"the deployment has no cross-host pair"};
  for (const model::Stage& stage : s.wireless.stages) channels[stage.channel];
  lost_packets.insert(s.wireless.lost_packets.begin(), s.wireless.lost_packets.end());
}

void schedule(World& w, Time at, EventClass event_class, const Event& event) {
  w.queue[{at, event_class, w.insertions}] = event;
  ++w.insertions;
}

bool cross_host(const World& w, Id i, Id j) {
  return w.participants.at(i).host != w.participants.at(j).host;
}

Id endpoint_count(const World& w, Id i, int stream) {
  const model::Participant& p = w.scenario.deployment.participants.at(i);
  return default_endpoints[stream] + (stream == publications ? p.publications : p.subscriptions);
}

std::vector<std::pair<int, Sample>> creation_order(const World& w, Id i) {
  const int pub = publications;
  const int sub = subscriptions;
  std::vector<std::pair<int, Sample>> order{{pub, 1}, {sub, 1}, {pub, 2}};
  for (Sample k = 2; k <= 7; ++k) {
    order.emplace_back(sub, k);
    order.emplace_back(pub, k + 1);
  }
  order.emplace_back(pub, 9);
  order.emplace_back(sub, 8);
  for (const int stream : {pub, sub}) {
    for (Sample k = default_endpoints[stream] + 1; k <= endpoint_count(w, i, stream); ++k) {
      order.emplace_back(stream, k);
    }
  }
  return order;
}

std::int64_t descriptor_bytes(int stream, Sample sample) {
  const auto& defaults = default_bytes(stream);
  if (sample <= static_cast<Sample>(defaults.size()))
    return defaults.at(static_cast<std::size_t>(sample - 1));
  return stream == publications ? 248 : 264;
}

std::optional<int> topic_writer(int stream, Sample sample) {
  const Sample defaults = default_endpoints[stream];
  if (sample == 1) return builtins;
  if (sample == defaults) return builtins + 1;
  if (sample < defaults) return {};
  return builtins + 1 + static_cast<int>(sample - defaults);
}

Sample sample_on(int stream, int writer) {
  const Sample defaults = default_endpoints[stream];
  if (writer == builtins) return 1;
  return defaults + writer - builtins - 1;
}

}  // namespace stormproof::oracle::cyclone
