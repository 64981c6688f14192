// Collects what an event causes, and prints it as one line when the event is over.
#include "model/trace/trace_writer.hpp"

#include <bit>
#include <ostream>
#include <utility>

#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "model/cyclone/endpoints.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/trace/event_subject.hpp"
#include "model/trace/json_text.hpp"
#include "model/trace/packet_text.hpp"
#include "model/trace/scenario_names.hpp"

namespace stormproof::model::trace {

namespace {

std::string_view name_at(std::uint32_t stream) { return stream % 2 == 0 ? "pub" : "sub"; }

/// Whether rules start events of this kind, not the way of a packet.
/// Endpoints are created by the application, also after a return.
bool is_of_rules(EventKind kind) {
  return class_of(kind) == EventClass::protocol && kind != EventKind::source_completion &&
         kind != EventKind::endpoint_creation;
}

}  // namespace

TraceWriter::TraceWriter(std::ostream& out, const Scenario& scenario, Effects effects)
    : TraceWriter{[&out](std::string_view line) {
                    out.write(line.data(), static_cast<std::streamsize>(line.size()));
                  },
                  scenario, effects} {}

TraceWriter::TraceWriter(Sink sink, const Scenario& scenario, Effects effects)
    : sink_{std::move(sink)}, by_unit_{scenario.wireless.service == ServedBy::unit} {
  if (effects == Effects::named) effect_names_.emplace(scenario.dds);
  for (const std::string& name : channel_names(scenario)) {
    channels_.push_back(json_string(name));
  }
  serving_.resize(channels_.size());
  for (const Participant& participant : scenario.deployment.participants) {
    hosts_.push_back(participant.host);
  }
  for (const Stage& stage : scenario.wireless.stages) stages_.push_back(json_string(stage.name));
  nlohmann::ordered_json header;
  header["format"] = "stormproof-trace";
  header["version"] = trace_version;
  header["program"] = program_name();
  if (effect_names_) header["effects"] = true;
  header["scenario"] = config::effective_json(scenario);
  sink_(header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void TraceWriter::finish(const RunResult& result) {
  line_.clear();
  append(line_, R"({"end":")", name_of(result.end), R"(","t_disc_ns":)");
  if (result.discovery_time)
    append(line_, result.discovery_time->count());
  else
    line_ += "null";
  append(line_, R"(,"end_ns":)", result.end_time.count(), R"(,"counts":{)");
  for (const Counts::Entry& count : result.counts.entries()) {
    append(line_, "\"", count.name, "\":", count.value, ",");
  }
  if (result.counts.lookup > 0) append(line_, R"("lookup":)", result.counts.lookup, ",");
  append(line_, R"("total":)", result.counts.total(), R"(},"user_control":)", result.user_control,
         R"(,"missing":)", result.missing_count, R"(,"events":)", result.events, "}\n");
  sink_(line_);
}

void TraceWriter::run_started(const Topology& topology) {
  topology_ = &topology;
  generated_.resize(topology.relation_count());
}

void TraceWriter::event_started(const Event& event) {
  event_ = event;
  in_event_ = true;
  transitions_.clear();
  for (std::string* text : {&emitted_, &looped_back_, &service_, &dropped_, &left_source_,
                            &arrived_, &received_, &packet_, &effects_}) {
    text->clear();
  }
  if (effect_names_) effect_names_->event_started();
}

void TraceWriter::scheduled(std::uint64_t insertion, Nanoseconds, EventKind kind, std::uint32_t) {
  if (in_event_) causes_.emplace(insertion, next_number_);
  if (effect_names_ && is_of_rules(kind)) effect_names_->starts_timer(insertion);
}

void TraceWriter::rescheduled(const Event& event, std::uint64_t insertion) {
  if (auto cause = causes_.extract(event.insertion())) {
    cause.key() = insertion;
    causes_.insert(std::move(cause));
  }
  if (effect_names_) effect_names_->renumber_timer(event.insertion(), insertion);
}

void TraceWriter::effect(fsm::composition::EffectKey key) {
  if (!effect_names_) return;  // another observer wants them
  append(effects_, effects_.empty() ? "\"" : ",\"", effect_names_->happens(key), "\"");
}

void TraceWriter::transition(const Transition& fired) { transitions_.add(fired); }

void TraceWriter::emitted(const Packet& packet, std::uint32_t source,
                          std::span<const std::uint32_t> destinations) {
  append(emitted_, emitted_.empty() ? "" : ",", R"({"packet":)", packet.number, ",");
  append_packet(emitted_, packet, source, destinations);
  if (packet.kind == PacketKind::data) append_generated(packet);
  append_effect(emitted_);
  emitted_ += '}';
}

/// How many descriptors of a DATA packet go out for the first time on their relation, and how many
/// again.
void TraceWriter::append_generated(const Packet& packet) {
  int initial = 0;
  int again = 0;
  std::vector<std::uint64_t>& sent = generated_[packet.relation()];
  sent.resize(words_for(topology_->descriptor_count(packet.relation())));
  const DescriptorSet& set = packet.descriptors;
  for (std::uint32_t k = set.first_word(); k < set.end_word(); ++k) {
    initial += std::popcount(set.word(k) & ~sent[k]);
    again += std::popcount(set.word(k) & sent[k]);
    sent[k] |= set.word(k);
  }
  if (initial > 0) append(emitted_, R"(,"initial_data":)", initial);
  if (again > 0) append(emitted_, R"(,"repair_data":)", again);
}

void TraceWriter::looped_back(const Packet& packet, std::uint32_t receiver) {
  append(looped_back_, looped_back_.empty() ? "{" : ",{");
  append_packet(looped_back_, packet, packet_ends(packet, *topology_).from, {&receiver, 1});
  append_effect(looped_back_);
  looped_back_ += '}';
}

void TraceWriter::service_started(std::uint32_t channel, std::uint32_t stage, const Packet& packet,
                                  std::uint32_t fragment, Nanoseconds until) {
  Serving& serving = serving_[channel];
  if (service_.empty()) serving.unit.clear();
  serving = {packet.number, fragment, stage, std::move(serving.unit)};
  if (by_unit_) {
    append(serving.unit, serving.unit.empty() ? "" : ",", R"({"packet":)", packet.number,
           R"(,"fragment":)", fragment, "}");
  }
  service_.clear();
  append(service_, R"({"channel":)", channels_[channel]);
  append_serving(service_, serving_[channel]);
  append(service_, R"(,"until":)", until.count(), "}");
}

void TraceWriter::dropped(std::uint32_t channel, std::uint32_t stage, const Packet& packet,
                          std::uint32_t fragment) {
  append(dropped_, dropped_.empty() ? "" : ",", R"({"channel":)", channels_[channel],
         R"(,"stage":)", stages_[stage], R"(,"packet":)", packet.number, R"(,"fragment":)",
         fragment, "}");
}

void TraceWriter::source_completed(const Packet& packet) {
  if (!left_source_.empty()) left_source_ += ',';
  append(left_source_, packet.number);
  packet_ = left_source_;
}

void TraceWriter::arrived(const Packet& packet, bool lost) {
  packet_.clear();
  append(packet_, packet.number);
  append(arrived_, arrived_.empty() ? "" : ",", R"({"packet":)", packet.number, R"(,"kind":")",
         name_of(packet.kind), "\"");
  const auto [from, to] = packet_ends(packet, *topology_);
  append(arrived_, R"(,"from":)", from, R"(,"to":)");
  if (packet.multicast())
    arrived_ += R"("multicast")";
  else
    append_part(arrived_, to);
  append_stream(arrived_, packet);
  arrived_ += lost ? R"(,"lost":true})" : "}";
}

void TraceWriter::received(const Packet& packet, std::uint32_t receiver) {
  if (event_.kind != EventKind::reception) return;  // `arrived` says it all
  const std::uint32_t from = packet_ends(packet, *topology_).from;
  received_ += '{';
  if (hosts_[from] != hosts_[receiver]) append(received_, R"("packet":)", packet.number, ",");
  append(received_, R"("kind":")", name_of(packet.kind), R"(","from":)", from);
  append_stream(received_, packet);
  received_ += '}';
}

void TraceWriter::event_finished(const Depths& depths) {
  line_.clear();
  append(line_, R"({"n":)", next_number_, R"(,"t":)", event_.time.count(), R"(,"class":")",
         name_of(event_.event_class()), R"(","insertion":)", event_.insertion(), R"(,"event":")",
         name_of(event_.kind), "\"");
  append_event_subject();
  append_cause();
  append_effects();
  append_transitions();
  if (!emitted_.empty()) append(line_, R"(,"emitted":[)", emitted_, "]");
  if (!looped_back_.empty()) append(line_, R"(,"looped_back":[)", looped_back_, "]");
  if (!service_.empty()) append(line_, R"(,"service":)", service_);
  if (!dropped_.empty()) append(line_, R"(,"dropped":[)", dropped_, "]");
  append_whole_or_list("left_source", left_source_);
  append_whole_or_list("arrived", arrived_);
  if (!received_.empty()) append(line_, R"(,"received":)", received_);
  append(line_, R"(,"queues":{"events":)", depths.events, R"(,"backlog":)", depths.backlog_packets,
         R"(,"admitted_bytes":)", depths.admitted_bytes, R"(,"waiting":)", depths.waiting,
         R"(},"missing":)", depths.missing, "}\n");
  sink_(line_);
  ++next_number_;
  in_event_ = false;
}

void TraceWriter::append_event_subject() {
  const Subject subject = subject_of(event_.kind);
  if (subject != Subject::packet)
    append_subject(subject, event_.subject);
  else if (!packet_.empty())
    append(line_, R"(,"packet":)", packet_);
  if (const char* name = detail_name(event_.kind)) {
    append(line_, ",\"", name, "\":", event_.detail);
  }
  if (event_.kind == EventKind::service_finished) append_serving(line_, serving_[event_.subject]);
}

void TraceWriter::append_whole_or_list(const char* key, const std::string& elements) {
  if (elements.empty()) return;
  append(line_, ",\"", key, by_unit_ ? "\":[" : "\":", elements, by_unit_ ? "]" : "");
}

void TraceWriter::append_serving(std::string& out, const Serving& serving) const {
  if (by_unit_) {
    append(out, R"(,"stage":)", stages_[serving.stage], R"(,"unit":[)", serving.unit, "]");
    return;
  }
  append(out, R"(,"stage":)", stages_[serving.stage], R"(,"packet":)", serving.packet,
         R"(,"fragment":)", serving.fragment);
}

void TraceWriter::append_subject(Subject kind, std::uint32_t subject) {
  switch (kind) {
    case Subject::relation: {
      const Pair& pair = topology_->pair(subject / 2);
      append(line_, R"(,"relation":{"from":)", pair.source, R"(,"to":)", pair.destination,
             R"(,"stream":")", name_at(subject), "\"}");
      break;
    }
    case Subject::writer:
      append(line_, R"(,"writer":{"participant":)", subject / 2, R"(,"stream":")", name_at(subject),
             "\"}");
      break;
    case Subject::participant:
      append(line_, R"(,"participant":)", subject);
      break;
    case Subject::channel:
      append(line_, R"(,"channel":)", channels_[subject]);
      break;
    case Subject::control_relation:
      append(line_, R"(,"control_relation":)", subject);
      break;
    case Subject::control_writer:
      append(line_, R"(,"participant":)", subject / fastdds::control_writers, R"(,"topic":")",
             fastdds::control_writer_names[subject % fastdds::control_writers], "\"");
      break;
    case Subject::pair: {
      const Pair& pair = topology_->pair(subject);
      append(line_, R"(,"pair":{"from":)", pair.source, R"(,"to":)", pair.destination, "}");
      break;
    }
    case Subject::endpoint_relation: {
      const std::uint32_t stride = cyclone::writers_per_participant(*topology_);
      const Pair& pair = topology_->pair(subject / stride);
      append(line_, R"(,"relation":{"from":)", pair.source, R"(,"to":)", pair.destination,
             R"(,"writer":")", cyclone::name_of_writer(subject % stride), "\"}");
      break;
    }
    case Subject::endpoint_writer: {
      const std::uint32_t stride = cyclone::writers_per_participant(*topology_);
      append(line_, R"(,"writer":{"participant":)", subject / stride, R"(,"writer":")",
             cyclone::name_of_writer(subject % stride), "\"}");
      break;
    }
    case Subject::access_point:
      append(line_, R"(,"access_point":)", subject);
      break;
    case Subject::packet:
      break;
  }
}

void TraceWriter::append_cause() {
  const auto cause = causes_.find(event_.insertion());
  if (cause == causes_.end()) {
    line_ += R"(,"cause":null)";
    return;
  }
  append(line_, R"(,"cause":)", cause->second);
  causes_.erase(cause);
}

void TraceWriter::append_effects() {
  if (!effect_names_) return;
  const std::string_view starter = effect_names_->take_starter(event_.insertion());
  if (!starter.empty()) append(line_, R"(,"started_by":")", starter, "\"");
  if (!effects_.empty()) append(line_, R"(,"effects":[)", effects_, "]");
}

void TraceWriter::append_effect(std::string& out) const {
  if (!effect_names_ || effect_names_->last().empty()) return;
  append(out, R"(,"effect":")", effect_names_->last(), "\"");
}

void TraceWriter::append_transitions() {
  const char* separator = R"(,"transitions":[{"machine":")";
  for (const TransitionList::Entry& entry : transitions_.entries()) {
    append(line_, separator, entry.machine.machine, "\"");
    const Subject kind = subject_of(entry.machine.kind);
    const bool own = kind == subject_of(event_.kind) && entry.machine.subject == event_.subject;
    if (!own) append_subject(kind, entry.machine.subject);
    append(line_, R"(,"event":")", entry.event, R"(","before":")", entry.before, R"(","after":")",
           entry.after, "\"");
    if (!entry.words.empty()) {
      line_ += R"(,"descriptors":)";
      append_members(line_, Words{entry.words});
    }
    separator = R"(},{"machine":")";
  }
  if (!transitions_.entries().empty()) line_ += "}]";
}

}  // namespace stormproof::model::trace
