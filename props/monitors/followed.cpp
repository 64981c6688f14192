// composition.followed: what a run does is what the rules say. The rules of fsm/composition are
// executed a second time beside the run, over plain columns (props/monitors/auditor.hpp): facts by
// their definitions, opaque steps by their contracts. Timers, receptions and packets that leave
// their source start them. What they do must be what the run did, in order: every transition, every
// event that is scheduled, every packet; and what is missing then. What a rule leaves to its host
// may be whatever its contract allows.
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "model/implementations.hpp"
#include "model/life.hpp"
#include "props/monitors/auditors.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/event_ends.hpp"
#include "props/monitors/follower.hpp"
#include "props/monitors/monitors.hpp"

namespace stormproof::props {

namespace {

/// Of protocol decisions; what the network schedules for itself is its own.
constexpr bool is_of_rules(model::EventKind kind) {
  return model::class_of(kind) == model::EventClass::protocol &&
         kind != model::EventKind::source_completion && kind != model::EventKind::thread_free;
}

class FollowedRun : public EndObserver {
 public:
  static constexpr auto selection_of_kinds = model::trace::Selection{}
                                                 .only_if(model::Report::event_started, is_of_rules)
                                                 .only_if(model::Report::scheduled, is_of_rules);

  FollowedRun(const model::Scenario& scenario, AuditorMaker make)
      : EndObserver{"composition.followed"}, scenario_{as_run(scenario)}, make_{make} {}

  void run_started(const model::Topology& topology) override {
    EndObserver::run_started(topology);
    follower_.reset();
    audit_ = std::make_unique<Audit>(topology);
    run_ = std::make_unique<model::RunState>(scenario_, audit_.get(), nullptr,
                                             same_host_pairs(scenario_.dds));
    follower_ = make_(*run_, *audit_);
    trigger_ = Trigger::start;
  }
  /// The first event is one of the rules.
  void event_started(const model::Event& event) override {
    if (trigger_ == Trigger::start) follow_rule();
    EndObserver::event_started(event);
    if (follower_ == nullptr || !is_of_rules(event.kind)) return;
    await(Trigger::due);
    due_ = event;
  }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    follow_rule();
    if (follower_ == nullptr) return;
    await(Trigger::received);
    take(packet);
    receiver_ = receiver;
  }
  void source_completed(const model::Packet& packet) override {
    follow_rule();
    if (follower_ == nullptr || !follower_->follows_leaving(packet.kind)) return;
    await(Trigger::left_source);
    take(packet);
  }

  void transition(const model::Transition& fired) override {
    if (fired.machine.kind == model::MachineRef::Kind::channel) return;
    add(fired);
  }
  void scheduled(std::uint64_t insertion, model::Nanoseconds time, model::EventKind kind,
                 std::uint32_t subject) override {
    if (is_of_rules(kind)) add(Scheduled{kind, subject, time, insertion});
  }
  void rescheduled(const model::Event& event, std::uint64_t insertion) override {
    if (follower_ != nullptr) follower_->rescheduled(event, insertion);
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override {
    if (follower_ == nullptr) return;
    deeds().add(packet, packet.pair);
    if (packet.copies == 1) return;
    for (const std::uint32_t destination : destinations.subspan(1)) {
      audit_->deeds().add_copy(topology().pair_between(source, destination));
    }
  }
  void looped_back(const model::Packet& packet, std::uint32_t receiver) override {
    if (follower_ == nullptr) return;
    deeds().add(packet, packet.pair, packet.multicast() ? receiver : UINT32_MAX);
  }

  [[nodiscard]] std::vector<std::string> assumptions() const override {
    std::vector<std::string> taken{
        "the network carries packets as it should, and what is scheduled happens when it is due",
        "DATA are filled and piggyback budgets used up wherever the contracts allow it"};
    if (traits_of(scenario_.dds).creates_endpoints_over_time) {
      taken.emplace_back("endpoints are created when they should be");
    }
    return taken;
  }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("{} events were followed.", follower_ != nullptr ? events() : followed_)};
  }

 private:
  /// What starts the next rule.
  enum class Trigger : std::uint8_t { nothing, start, due, received, left_source };

  void judge_event(const model::Depths& depths) override {
    follow_rule();
    if (follower_ == nullptr || depths.missing == run_->missing) return;
    object_to(fmt::format(" {} required descriptors are missing, by the rules {}.", depths.missing,
                          run_->missing));
  }
  void object_to(const std::string& what) {
    object(event_, run_->now, fmt::format("At {}{}", time_text(run_->now), what));
    followed_ = events();
    follower_.reset();
  }
  /// What is done from now on is held against that rule, in this event.
  void await(Trigger trigger) {
    trigger_ = trigger;
    await_this_event();
  }
  void await_this_event() {
    event_ = event();
    run_->now = now();
    await_end();
  }
  /// Something is done; before the first event the start is followed when that begins.
  Deeds& deeds() {
    if (trigger_ != Trigger::start) await_this_event();
    return audit_->deeds();
  }
  /// The packet may be gone before its rule is followed.
  void take(const model::Packet& packet) {
    packet_.become(packet);
    if (!packet.descriptors.empty()) packet_.descriptors = Descriptors{packet.descriptors}.set();
    packet_.submessages = packet.submessages;
    packet_.relayed = packet.relayed;
  }
  template <class Kind>
  void add(Kind&& deed) {
    if (follower_ != nullptr) deeds().add(std::forward<Kind>(deed));
  }
  void run_rule(Trigger trigger) {
    switch (trigger) {
      case Trigger::nothing:
        return;
      case Trigger::start:
        return follower_->started();
      case Trigger::due:
        return follower_->due(due_);
      case Trigger::received:
        return follower_->received(packet_, receiver_);
      case Trigger::left_source:
        return follower_->left_source(packet_);
    }
  }
  /// Holds what was done since the last trigger against the rule that it started.
  void follow_rule() {
    if (follower_ == nullptr) return;
    if (trigger_ != Trigger::nothing || !audit_->deeds().empty()) compare_with_rule();
  }
  [[gnu::noinline]] void compare_with_rule() {
    run_rule(std::exchange(trigger_, Trigger::nothing));
    audit_->nothing_more();
    if (audit_->difference()) object_to(", " + *audit_->difference());
  }

  const model::Scenario scenario_;
  const AuditorMaker make_;
  std::unique_ptr<Audit> audit_;
  std::unique_ptr<model::RunState> run_;  // beside it
  std::unique_ptr<Follower> follower_;
  Trigger trigger_ = Trigger::nothing;
  model::Event due_;            // if it is
  model::Packet packet_;        // that is received or has left its source
  std::uint32_t receiver_ = 0;  // of it
  std::uint64_t event_ = 0;     // in which that is
  std::uint64_t followed_ = 0;  // events, up to an objection
};

}  // namespace

MonitorPtr watch_composition(const model::Scenario& scenario) {
  return attentive<FollowedRun>(scenario, &make_auditor);
}
MonitorPtr watch_composition(const model::Scenario& scenario, AuditorMaker make) {
  return attentive<FollowedRun>(scenario, make);
}

}  // namespace stormproof::props
