// Whose turn it is, and for how long.
#include "model/engine/processors.hpp"

#include <random>

#include "model/engine/fleet.hpp"
#include "model/engine/submessage.hpp"

namespace stormproof::model {

namespace {

std::uint32_t submessages_of(const Packet& packet) {
  if (packet.submessages != nullptr) return static_cast<std::uint32_t>(packet.submessages->size());
  const bool has_data = packet.kind == PacketKind::data;
  return has_data ? packet.descriptors.count() + packet.heartbeats : 1;
}

}  // namespace

Processors::Processors(RunState& run, const Processor& processor, const Fleet& fleet)
    : run_{run},
      processor_{processor},
      fleet_{fleet},
      threads_(run.topology.participant_count()),
      hosts_(fleet.host_count()) {
  for (Cores& cores : hosts_) cores.free = processor.cores;
  std::mt19937_64 random{processor.deaf_seed};
  const Nanoseconds range = processor.deaf_max - processor.deaf_min;
  for (const Participant& participant : run.scenario.deployment.participants) {
    const std::uint64_t drawn = random() % (static_cast<std::uint64_t>(range.count()) + 1);
    hears_from_.push_back(participant.open.value_or(participant.start) + processor.deaf_min +
                          Nanoseconds{static_cast<std::int64_t>(drawn)});
  }
  hears_from_.resize(threads_.size());  // a server has been there before
}

bool Processors::begins(std::uint32_t participant, const Event& event) {
  Thread& thread = threads_[participant];
  Cores& cores = hosts_[fleet_.host_of(participant)];
  const bool is_granted = thread.granted == event.insertion();
  const bool is_idle = !thread.has_core && thread.line.empty();
  if (!is_granted && (!is_idle || cores.free == 0)) {
    if (thread.line.empty()) thread.line_since = run_.now;
    if (is_idle) cores.waiting.push_back(participant);
    thread.line.push_back(event);
    return false;
  }
  if (!is_granted) --cores.free;
  thread.granted.reset();
  thread.has_core = true;
  acting_ = participant;
  cost_ = {};
  return true;
}

void Processors::finish() { run_.schedule(run_.now + cost_, EventKind::thread_free, acting_); }

void Processors::handle(const Event& event) {
  Thread& thread = threads_[event.subject];
  Cores& cores = hosts_[fleet_.host_of(event.subject)];
  thread.has_core = false;
  ++cores.free;
  if (!thread.line.empty()) cores.waiting.push_back(event.subject);
  give(cores);
}

void Processors::give(Cores& cores) {
  while (cores.free > 0 && !cores.waiting.empty()) {
    Thread& thread = threads_[cores.waiting.front()];
    cores.waiting.pop_front();
    --cores.free;
    thread.has_core = true;
    thread.granted = run_.schedule_again(thread.line.front());
    thread.line.pop_front();
    if (thread.line.empty()) thread.waited += run_.now - thread.line_since;
  }
}

Nanoseconds Processors::of_submessages(const Packet& packet) const {
  return processor_.submessage * submessages_of(packet);
}

Nanoseconds Processors::waited(std::uint32_t participant) const {
  const Thread& thread = threads_[participant];
  return thread.line.empty() ? thread.waited : thread.waited + (run_.now - thread.line_since);
}

}  // namespace stormproof::model
