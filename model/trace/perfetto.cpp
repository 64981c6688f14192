// Collects what an event does on each row and writes it when the event is over. Only the services
// of channels take time; their slices open with one event and close with a later one.
#include "model/trace/perfetto.hpp"

#include <bit>
#include <utility>

#include "model/implementations.hpp"
#include "model/life.hpp"
#include "model/servers.hpp"
#include "model/trace/json_text.hpp"
#include "model/trace/packet_text.hpp"
#include "model/trace/perfetto_labels.hpp"
#include "model/trace/perfetto_tracks.hpp"
#include "model/trace/scenario_names.hpp"

namespace stormproof::model::trace {

namespace {

constexpr const char* packet_flow = "packet";
constexpr const char* timer_flow = "timer";

void add_arg(std::string& args) {
  if (!args.empty()) args += ',';
}

}  // namespace

PerfettoWriter::PerfettoWriter(std::ostream& out, const Scenario& scenario, Effects effects)
    : events_{out}, fragmentation_{scenario.wireless}, channels_{channel_names(scenario)} {
  if (effects == Effects::named) effect_names_.emplace(scenario.dds);
  const Deployment& deployment = scenario.deployment;
  const std::uint32_t servers = traits_of(scenario.dds).has_server ? server_count(deployment) : 0;
  for (std::uint32_t i = 0; i < deployment.size() + servers; ++i) {
    hosts_.push_back(host_of(deployment, i));
  }
  for (const Stage& stage : scenario.wireless.stages) stages_.push_back(json_string(stage.name));
  serving_.resize(channels_.size());
  waiting_.resize(channels_.size());
  backlog_.resize(hosts_.size());
  name_tracks(events_, scenario);
  events_.flush();
}

void PerfettoWriter::finish() {
  write_counters();
  for (std::uint32_t c = 0; c < serving_.size(); ++c) {
    for (; serving_[c] > 0; --serving_[c]) events_.end_slice(channel_track(c), now_);
  }
  events_.flush(true);
}

void PerfettoWriter::run_started(const Topology& topology) { topology_ = &topology; }

void PerfettoWriter::event_started(const Event& event) {
  in_event_ = true;
  ++event_count_;
  if (event.time != now_) write_counters();
  now_ = event.time;
  used_ = 0;
  transitions_.clear();
  multicast_.reset();
  informed_.clear();
  if (effect_names_) effect_names_->event_started();
  if (event.kind == EventKind::service_finished) {
    std::uint32_t& open = serving_[event.subject];
    for (; open > 0; --open) events_.end_slice(channel_track(event.subject), now_);
  }
  if (!is_timer(event.kind)) return;
  Slice& slice =
      slice_on(timer_track(event.kind, event.subject, *topology_), timer_label(event.kind));
  const auto first = first_insertions_.extract(event.insertion());
  const std::uint64_t insertion = first ? first.mapped() : event.insertion();
  if (insertion >= scheduled_before_run_) {
    slice.flows.push_back({FlowPhase::end, timer_flow, insertion});
  }
  if (!effect_names_) return;
  const std::string_view starter = effect_names_->take_starter(event.insertion());
  if (starter.empty()) return;
  add_arg(slice.args);
  append(slice.args, R"("started by":")", starter, "\"");
}

void PerfettoWriter::effect(fsm::composition::EffectKey key) {
  if (effect_names_) effect_names_->happens(key);
}

void PerfettoWriter::scheduled(std::uint64_t insertion, Nanoseconds, EventKind kind,
                               std::uint32_t subject) {
  if (!in_event_) ++scheduled_before_run_;
  if (!in_event_ || !is_timer(kind)) return;
  Slice& slice = slice_on(timer_track(kind, subject, *topology_), timer_start_label(kind));
  slice.flows.push_back({FlowPhase::start, timer_flow, insertion});
  if (effect_names_) effect_names_->starts_timer(insertion);
}

void PerfettoWriter::rescheduled(const Event& event, std::uint64_t insertion) {
  const auto first = first_insertions_.extract(event.insertion());
  first_insertions_.emplace(insertion, first ? first.mapped() : event.insertion());
  if (effect_names_) effect_names_->renumber_timer(event.insertion(), insertion);
}

void PerfettoWriter::emitted(const Packet& packet, std::uint32_t source,
                             std::span<const std::uint32_t> destinations) {
  const std::string label = emission_label(packet, destinations);
  Slice& slice = slice_on(sender_track(packet, source), label);
  add_arg(slice.args);
  std::string numbers = "packet ";
  append_part(numbers, packet.number);
  if (packet.copies > 1) append(numbers, " to ", packet.number + packet.copies - 1);
  append(slice.args, "\"", numbers, "\":\"", label, ", ", packet.payload_bytes, " bytes\"");
  if (effect_names_ && !effect_names_->last().empty()) {
    append(slice.args, ",\"effect of ", numbers, "\":\"", effect_names_->last(), "\"");
  }
  for (std::uint32_t copy = 0; copy < packet.copies; ++copy) {
    slice.flows.push_back({FlowPhase::start, packet_flow, packet.number + copy});
  }
}

void PerfettoWriter::service_started(std::uint32_t channel, std::uint32_t stage,
                                     const Packet& packet, std::uint32_t fragment, Nanoseconds) {
  std::string args;
  append(args, R"("packet":)", packet.number, R"(,"fragment":)", fragment, R"(,"stage":)",
         stages_[stage], R"(,"bytes":)", fragmentation_.bytes(packet.payload_bytes, fragment),
         R"(,"class":")", name_of(traffic_class(packet)), "\"");
  const Track track = channel_track(channel);
  events_.begin_slice(track, now_, "service", service_label(packet, *topology_), args);
  if (fragment == 0) events_.flow({FlowPhase::step, packet_flow, packet.number}, track, now_);
  ++serving_[channel];
}

void PerfettoWriter::dropped(std::uint32_t, std::uint32_t stage, const Packet& packet,
                             std::uint32_t fragment) {
  const std::uint32_t source = packet_ends(packet, *topology_).from;
  Slice& slice =
      slice_on(sender_track(packet, source), std::string{"dropped: "} + packet_label(packet));
  add_arg(slice.args);
  append(slice.args, R"("packet )", packet.number, R"( fragment )", fragment, R"(":)",
         stages_[stage]);
}

void PerfettoWriter::arrived(const Packet& packet, bool lost) {
  if (!lost) return;
  const std::uint32_t source = packet_ends(packet, *topology_).from;
  Slice& slice =
      slice_on(sender_track(packet, source), std::string{"lost: "} + packet_label(packet));
  add_packet(slice, packet);
}

void PerfettoWriter::received(const Packet& packet, std::uint32_t receiver) {
  const auto [from, to] = packet_ends(packet, *topology_);
  if (packet.multicast() && receiver == everybody) {
    multicast_ = Multicast{packet.number, from};
    return;
  }
  const std::uint32_t at = receiver == everybody ? to : receiver;
  Slice& slice = slice_on(receiver_track(packet, at), arrival_label(packet, from));
  if (hosts_[from] != hosts_[at]) add_packet(slice, packet);
}

/// A packet ends its way in this slice.
void PerfettoWriter::add_packet(Slice& slice, const Packet& packet) {
  add_arg(slice.args);
  append(slice.args, R"("packet":)", packet.number);
  slice.flows.push_back({FlowPhase::end, packet_flow, packet.number});
}

void PerfettoWriter::transition(const Transition& fired) {
  transitions_.add(fired);
  const bool first_of_pair = fired.machine.subject % 2 == 0;
  if (multicast_ && fired.event == "AnnouncementReceived" && first_of_pair) {
    informed_.push_back(topology_->pair(fired.machine.subject / 2).destination);
  }
}

void PerfettoWriter::backlog_changed(std::uint32_t participant, std::uint64_t packets,
                                     std::int64_t admitted_bytes) {
  Counter& counter = backlog_[participant];
  if (counter.value == packets && counter.bytes == admitted_bytes) return;
  if (!counter.changed) backlogs_changed_.push_back(participant);
  counter = {packets, admitted_bytes, true};
}

void PerfettoWriter::waiting_changed(std::uint32_t channel, std::uint64_t fragments) {
  if (waiting_[channel].value == fragments) return;
  waiting_[channel].value = fragments;
  waiting_[channel].changed = true;
}

void PerfettoWriter::event_finished(const Depths& depths) {
  add_transitions();
  if (multicast_) end_multicast_flow();
  write_slices();
  missing_changed_ = missing_changed_ || missing_ != depths.missing;
  missing_ = depths.missing;
  events_.flush();
  in_event_ = false;
}

/// Machines that changed their state, as arguments of the slice on their row.
void PerfettoWriter::add_transitions() {
  for (const TransitionList::Entry& entry : transitions_.entries()) {
    if (entry.before == entry.after) continue;
    const std::optional<Track> track = machine_track(entry.machine, *topology_);
    if (!track) continue;
    Slice& slice = slice_on(*track, entry.event);
    add_arg(slice.args);
    append(slice.args, "\"", entry.machine.machine, " ", entry.event);
    if (entry.machine.kind == MachineRef::Kind::relation) {
      const Pair& pair = topology_->pair(entry.machine.subject / 2);
      append(slice.args, " ", pair.source, "→", pair.destination);
    }
    append(slice.args, " ", entry.before, "→", entry.after, "\":");
    int moved = entry.words.empty() ? 1 : 0;
    for (const std::uint64_t word : entry.words) moved += std::popcount(word);
    append_part(slice.args, moved);
  }
}

void PerfettoWriter::end_multicast_flow() {
  std::string name;
  append(name, "SPDP from ", multicast_->source);
  for (const std::uint32_t participant : informed_) {
    Slice& slice = slice_on(participant_track(participant), name);
    slice.name = name;  // it may have got a name from what the receiver sends in return
    slice.flows.insert(slice.flows.begin(), {FlowPhase::end, packet_flow, multicast_->packet});
  }
  if (!informed_.empty()) return;
  Slice& slice = slice_on(participant_track(multicast_->source), "SPDP known to all");
  slice.flows.push_back({FlowPhase::end, packet_flow, multicast_->packet});
}

void PerfettoWriter::write_slices() {
  for (std::size_t k = 0; k < used_; ++k) {
    const Slice& slice = slices_[k];
    events_.begin_slice(slice.track, now_, "protocol", slice.name, slice.args);
    for (const Flow& flow : slice.flows) events_.flow(flow, slice.track, now_);
    events_.end_slice(slice.track, now_);
  }
}

/// Once per instant: many events happen at the same time, and only the last value can be seen.
void PerfettoWriter::write_counters() {
  std::string values;
  for (const std::uint32_t i : backlogs_changed_) {
    values.clear();
    append(values, R"("backlog packets":)", backlog_[i].value, R"(,"admitted bytes":)",
           backlog_[i].bytes);
    events_.counter(participant_process(i), now_, "source", values);
    backlog_[i].changed = false;
  }
  backlogs_changed_.clear();
  for (std::size_t c = 0; c < waiting_.size(); ++c) {
    if (!std::exchange(waiting_[c].changed, false)) continue;
    values.clear();
    append(values, R"("fragments":)", waiting_[c].value);
    events_.counter(network_process, now_, "waiting for " + channels_[c], values);
  }
  if (!std::exchange(missing_changed_, false)) return;
  values.clear();
  append(values, R"("descriptors":)", missing_);
  events_.counter(network_process, now_, "missing", values);
}

PerfettoWriter::Slice& PerfettoWriter::slice_on(Track track, std::string_view name) {
  if (track.thread >= places_.size()) places_.resize(track.thread + 1);
  Place& place = places_[track.thread];
  if (place.event == event_count_) return slices_[place.slice];
  place = {event_count_, used_};
  if (used_ == slices_.size()) slices_.emplace_back();
  Slice& slice = slices_[used_++];
  slice.track = track;
  slice.name = name;
  slice.args.clear();
  slice.flows.clear();
  return slice;
}

}  // namespace stormproof::model::trace
