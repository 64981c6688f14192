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
#include "props/monitors/follower.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::props {

namespace {

/// Of protocol decisions; what the network schedules for itself is its own.
constexpr bool is_of_rules(model::EventKind kind) {
  return model::class_of(kind) == model::EventClass::protocol &&
         kind != model::EventKind::source_completion && kind != model::EventKind::thread_free;
}

class FollowedRun : public Observer {
 public:
  static constexpr bool reads_clock = false;
  static constexpr auto selection_of_kinds =
      model::trace::Selection{}.only_if(model::Report::scheduled, is_of_rules);

  FollowedRun(const model::Scenario& scenario, AuditorMaker make)
      : Observer{"composition.followed"}, scenario_{as_run(scenario)}, make_{make} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    follower_.reset();
    audit_ = std::make_unique<Audit>(topology);
    run_ = std::make_unique<model::RunState>(scenario_, audit_.get(), nullptr,
                                             same_host_pairs(scenario_.dds));
    follower_ = make_(*run_, *audit_);
    trigger_ = Trigger::start;
  }
  void event_started(const model::Event& event) override {
    follow_rule();
    Observer::event_started(event);
    if (follower_ == nullptr) return;
    ++followed_;
    run_->now = event.time;
    if (!is_of_rules(event.kind)) return;
    trigger_ = Trigger::due;
    due_ = event;
  }
  void received(const model::Packet& packet, std::uint32_t receiver) override {
    follow_rule();
    if (follower_ == nullptr) return;
    trigger_ = Trigger::received;
    take(packet);
    receiver_ = receiver;
  }
  void source_completed(const model::Packet& packet) override {
    follow_rule();
    if (follower_ == nullptr || !follower_->follows_leaving(packet.kind)) return;
    trigger_ = Trigger::left_source;
    take(packet);
  }
  void event_finished(const model::Depths& depths) override {
    follow_rule();
    if (follower_ == nullptr || depths.missing == run_->missing) return;
    object_now(fmt::format("At {} {} required descriptors are missing, by the rules {}.",
                           time_text(now()), depths.missing, run_->missing));
    follower_.reset();
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
    audit_->deeds().add(packet, packet.pair);
    if (packet.copies == 1) return;
    for (const std::uint32_t destination : destinations.subspan(1)) {
      audit_->deeds().add_copy(topology().pair_between(source, destination));
    }
  }
  void looped_back(const model::Packet& packet, std::uint32_t receiver) override {
    if (follower_ == nullptr) return;
    audit_->deeds().add(packet, packet.pair, packet.multicast() ? receiver : UINT32_MAX);
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
    return {fmt::format("{} events were followed.", followed_)};
  }

 private:
  /// What starts the next rule.
  enum class Trigger : std::uint8_t { nothing, start, due, received, left_source };

  /// The packet may be gone before its rule is followed.
  void take(const model::Packet& packet) {
    packet_.become(packet);
    if (!packet.descriptors.empty()) packet_.descriptors = Descriptors{packet.descriptors}.set();
    packet_.submessages = packet.submessages;
    packet_.relayed = packet.relayed;
  }
  template <class Kind>
  void add(Kind&& deed) {
    if (follower_ != nullptr) audit_->deeds().add(std::forward<Kind>(deed));
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
    if (!audit_->difference()) return;
    object_now("At " + time_text(now()) + ", " + *audit_->difference());
    follower_.reset();
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
  std::uint64_t followed_ = 0;
};

}  // namespace

MonitorPtr watch_composition(const model::Scenario& scenario) {
  return attentive<FollowedRun>(scenario, &make_auditor);
}
MonitorPtr watch_composition(const model::Scenario& scenario, AuditorMaker make) {
  return attentive<FollowedRun>(scenario, make);
}

}  // namespace stormproof::props
