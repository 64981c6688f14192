// The probe that writes the history.
#include "checker/verification/counterexample/history.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "model/simulator.hpp"
#include "model/trace/effect_names.hpp"
#include "model/trace/packet_text.hpp"
#include "model/trace/perfetto_labels.hpp"
#include "model/trace/scenario_names.hpp"

namespace stormproof::counterexample {

namespace {

using model::Packet;
using model::PacketKind;

std::vector<std::uint64_t> words_of(const model::DescriptorSet& set) {
  std::vector<std::uint64_t> words(set.end_word());
  for (std::uint32_t k = 0; k < words.size(); ++k) words[k] = set.word(k);
  return words;
}

std::string content_of(const Packet& packet) {
  const std::string members = members_text(words_of(packet.descriptors));
  if (packet.kind == PacketKind::acknack) {
    return members.empty() ? "lacks nothing" : "lacks " + members;
  }
  return members;
}

class Recorder final : public model::Probe {
 public:
  Recorder(History& history, std::uint64_t steps) : history_{history}, limit_{steps} {
    serving_.resize(history.channels.size());
    received_.resize(history.topology.relation_count());
  }

  [[nodiscard]] bool wants_effects() const override { return true; }
  void effect(fsm::composition::EffectKey key) override { effects_.happens(key); }

  void event_started(const model::Event& event) override {
    over_ = history_.steps.size() > limit_;
    effects_.event_started();
    if (over_) return;
    Step& step = history_.steps.emplace_back();
    step.event = event;
    if (const auto cause = causes_.find(event.insertion()); cause != causes_.end()) {
      step.cause = cause->second;
      causes_.erase(cause);
    }
    const auto local = locals_.find(event.insertion());
    local_ = local == locals_.end() ? std::nullopt : std::optional{local->second};
    transitions_.clear();
    running_ = true;
    if (event.kind != model::EventKind::service_finished) return;
    for (const std::uint64_t packet : serving_[event.subject]) {
      step.served = packet;
      history_.packets.at(packet).services.at(stages_[packet]).last = now();
    }
    serving_[event.subject].clear();
  }

  void event_finished(const model::Depths&) override {
    if (over_) return;
    running_ = false;
    judge_untaken();
    for (const auto& entry : transitions_.entries()) {
      if (entry.before != entry.after) step().transitions.push_back(entry);
    }
  }

  void transition(const model::Transition& fired) override {
    if (over_) return;
    transitions_.add(fired);
    if (fired.event == "DataReceived") take_data(fired.machine.subject);
  }

  void scheduled(std::uint64_t insertion, model::Nanoseconds due, model::EventKind kind,
                 std::uint32_t subject) override {
    if (over_ || !running_) return;
    causes_.emplace(insertion, now());
    if (looped_ && kind == model::EventKind::reception) {
      locals_.emplace(insertion, *looped_);
      looped_.reset();
    }
    if (class_of(kind) == model::EventClass::protocol) {
      step().timers.push_back({kind, due, subject, std::string{effects_.last()}});
    }
  }

  void rescheduled(const model::Event& event, std::uint64_t insertion) override {
    auto cause = causes_.extract(event.insertion());
    if (!cause) return;
    cause.key() = insertion;
    causes_.insert(std::move(cause));
  }

  void emitted(const Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    if (over_) return;
    PacketLog log;
    log.label = model::trace::packet_label(packet);
    log.content = content_of(packet);
    log.from = source;
    log.emitted = now();
    log.effect = effects_.last();
    if (packet.multicast() || destinations.empty()) {
      enter(packet.number, std::move(log));
      return;
    }
    for (std::uint64_t k = 0; k < destinations.size(); ++k) {
      log.to = destinations[k];
      log.relation = relation_of(packet, source, log.to);
      enter(packet.number + k, log);
    }
  }

  void looped_back(const Packet& packet, std::uint32_t receiver) override {
    if (over_) return;
    PacketLog log;
    log.label = model::trace::packet_label(packet);
    // The simulator counts no first transmissions here.
    if (packet.kind == PacketKind::data)
      log.label = packet.carries_heartbeat ? "DATA+HEARTBEAT" : "DATA";
    log.content = content_of(packet);
    log.from = model::trace::packet_ends(packet, history_.topology).from;
    log.to = receiver;
    log.relation = relation_of(packet, log.from, receiver);
    log.emitted = now();
    log.effect = effects_.last();
    enter(next_local_, std::move(log));
    looped_ = next_local_++;
  }

  void service_started(std::uint32_t channel, std::uint32_t stage, const Packet& packet,
                       std::uint32_t, model::Nanoseconds) override {
    if (over_) return;
    serving_[channel].push_back(packet.number);
    step().served = packet.number;
    auto& services = history_.packets.at(packet.number).services;
    const auto known = std::ranges::find(services, stage, &Service::stage);
    stages_[packet.number] = static_cast<std::size_t>(known - services.begin());
    if (known == services.end()) services.push_back({channel, stage, now(), {}});
  }

  void source_completed(const Packet& packet) override {
    if (over_) return;
    step().left_source = packet.number;
    history_.packets.at(packet.number).left_source = now();
  }

  void arrived(const Packet& packet, bool lost) override {
    if (over_) return;
    step().arrived = packet.number;
    PacketLog& log = history_.packets.at(packet.number);
    log.arrived = now();
    log.lost = lost;
  }

  void received(const Packet& packet, std::uint32_t receiver) override {
    if (over_) return;
    arriving_ = packet.kind == PacketKind::data ? words_of(packet.descriptors)
                                                : std::vector<std::uint64_t>{};
    const bool single = receiver == everybody && !packet.multicast();
    const std::uint32_t to = model::trace::packet_ends(packet, history_.topology).to;
    if (local_) history_.packets.at(*local_).arrived = now();
    step().receptions.push_back({local_.value_or(packet.number), single ? to : receiver, {}});
  }

 private:
  [[nodiscard]] std::size_t now() const { return history_.steps.size() - 1; }
  Step& step() { return history_.steps.back(); }

  void enter(std::uint64_t number, PacketLog log) {
    // Before the first event nothing is emitted.
    step().emitted.push_back(number);
    history_.packets.emplace(number, std::move(log));
  }

  [[nodiscard]] std::uint32_t relation_of(const Packet& packet, std::uint32_t source,
                                          std::uint32_t destination) const {
    if (model::trace::is_spdp(packet) || model::trace::is_control(packet)) return no_relation;
    const bool to_writer = packet.to_writer();
    const std::uint32_t pair = to_writer ? history_.topology.pair_between(destination, source)
                                         : history_.topology.pair_between(source, destination);
    return 2 * pair + packet.relation() % 2;
  }

  /// The reader takes the DATA that is being received: what is new of it?
  void take_data(std::uint32_t relation) {
    if (step().receptions.empty() || arriving_.empty()) return;
    auto& have = received_[relation];
    have.resize(model::words_for(history_.topology.descriptor_count(relation)));
    std::vector<std::uint64_t> fresh(have.size());
    bool all_fresh = true;
    for (std::size_t k = 0; k < std::min(arriving_.size(), have.size()); ++k) {
      fresh[k] = arriving_[k] & ~have[k];
      all_fresh = all_fresh && fresh[k] == arriving_[k];
      have[k] |= arriving_[k];
    }
    arriving_.clear();
    const std::string members = members_text(fresh);
    step().receptions.back().news = members.empty() ? "all known already"
                                    : all_fresh     ? "all new"
                                                    : "new: " + members;
  }

  /// DATA that no reader took: it knew all of it, or it did not listen.
  void judge_untaken() {
    if (arriving_.empty() || step().receptions.empty()) return;
    const Step::Reception& last = step().receptions.back();
    const std::uint32_t relation = history_.packets.at(last.packet).relation;
    bool known = relation != no_relation;
    for (std::size_t k = 0; known && k < arriving_.size(); ++k) {
      const auto& have = received_[relation];
      known = (arriving_[k] & ~(k < have.size() ? have[k] : 0)) == 0;
    }
    step().receptions.back().news = known ? "all known already" : "not taken";
    arriving_.clear();
  }

  History& history_;
  std::uint64_t limit_;
  model::trace::EffectNames effects_{history_.scenario.dds};
  bool over_ = false;
  bool running_ = false;
  std::unordered_map<std::uint64_t, std::uint64_t> causes_;  // insertion → step
  std::uint64_t next_local_ = first_local;
  std::optional<std::uint64_t> looped_;                      // waits for its reception's insertion
  std::unordered_map<std::uint64_t, std::uint64_t> locals_;  // insertion → packet
  std::optional<std::uint64_t> local_;                       // that the event receives
  std::vector<std::vector<std::uint64_t>> serving_;          // by channel: packets
  std::unordered_map<std::uint64_t, std::size_t> stages_;  // packet → position of its last service
  std::vector<std::vector<std::uint64_t>> received_;       // by relation
  std::vector<std::uint64_t> arriving_;                    // the DATA that is being received
  model::trace::TransitionList transitions_;
};

}  // namespace

History record(const props::Counterexample& counterexample) {
  const model::Scenario& scenario = counterexample.scenario;
  History history{
      scenario, model::topology_of(scenario), model::trace::channel_names(scenario), {}, {}};
  Recorder recorder{history, counterexample.event};
  model::RunOptions options;
  options.probe = &recorder;
  options.max_events = counterexample.event + 1;
  static_cast<void>(simulate(scenario, options));
  return history;
}

std::string members_text(model::Words words) {
  std::string text;
  const auto member = [&](std::size_t d) {
    return d / 64 < words.size() && (words[d / 64] >> d % 64 & 1U) != 0;
  };
  for (std::size_t d = 0; d < words.size() * 64; ++d) {
    if (!member(d)) continue;
    const std::size_t first = d;
    while (member(d + 1)) ++d;
    text += text.empty() ? "" : ", ";
    text += first == d ? fmt::format("{}", d) : fmt::format("{}–{}", first, d);
  }
  return text;
}

}  // namespace stormproof::counterexample
