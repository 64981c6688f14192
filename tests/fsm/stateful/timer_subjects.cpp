// The HEARTBEAT timer under the periodic policy, and the timer that is pending at most once,
// against the rules in plain code. Times are small numbers, so that they meet often.
#include <algorithm>
#include <optional>

#include "fsm/heartbeat_timer.hpp"
#include "fsm/single_shot.hpp"
#include "tests/fsm/stateful/machine_subject.hpp"

namespace stormproof::fsm::stateful {

namespace {

std::string with_time(const char* what, std::int64_t at) { return what + std::to_string(at); }

// ---- A timer that is pending at most once.

enum ShotCall : std::size_t { shot_requested, shot_due };

std::string shot_words(std::int64_t now, const std::optional<std::int64_t>& due, bool fired) {
  return with_time("at ", now) + (due ? with_time(", due at ", *due) : "") +
         (fired ? ", fired" : "");
}

class ShotRules final : public PlainModel<ShotRules> {
 public:
  [[nodiscard]] bool possible(const Call& call) const override {
    return call.event == shot_requested || due_.has_value();
  }
  std::string react(const Call& call) override {
    const bool fires = call.event == shot_due;
    if (fires) {
      now_ = *due_;
      due_.reset();
    } else if (!due_) {
      now_ += call.payload[0];
      due_ = now_ + call.payload[1];
    }
    return shot_words(now_, due_, fires);
  }

 private:
  std::int64_t now_ = 0;
  std::optional<std::int64_t> due_;
};

class ShotUnderTest final : public Reactor {
 public:
  explicit ShotUnderTest(Mutations mutations) : machine_{mutations} {}
  std::string react(const Call& call) override {
    using namespace single_shot;
    Stepper<SingleShot>::Output output{};
    if (call.event == shot_due) {
      now_ = due_.value_or(now_);
      due_.reset();
      output = machine_.step<Due>(state_);
    } else {
      // A request while the timer is pending comes at the time of the last call.
      if (!due_) now_ += call.payload[0];
      output = machine_.step<Requested>(state_, {.now = now_, .delay = call.payload[1]});
    }
    if (output.schedule) due_ = output.next_at;
    return shot_words(now_, due_, output.fire);
  }

 private:
  Stepper<SingleShot> machine_;
  StateId state_ = Stepper<SingleShot>::initial;
  std::int64_t now_ = 0;
  std::optional<std::int64_t> due_;
};

// ---- Periodic policy. Opening a relation arms the timer if nothing is pending; the end of a
// suppression does so, too, or adds an expiry if the timer is additive; an expiry sends and arms
// again while something is not acknowledged, and otherwise ends.

enum PeriodicCall : std::size_t { opened, suppression_ended, expired, acknowledgment_changed };
constexpr std::int64_t heartbeat_period = 10;

struct Expiries {
  std::int64_t now = 0;
  bool unacknowledged = true;
  std::vector<std::int64_t> due;  // ascending

  /// Time goes on, but not past an expiry.
  void wait(std::int64_t time) {
    now = due.empty() ? now + time : std::min(now + time, due.front());
  }
  void add(std::int64_t at) { due.insert(std::upper_bound(due.begin(), due.end(), at), at); }
  void expire() {
    now = due.front();
    due.erase(due.begin());
  }
  [[nodiscard]] std::string in_words_with(bool sent) const {
    return with_time("at ", now) + ", due " + in_words(due) + (sent ? ", sent" : "");
  }
};

class PeriodicRules final : public PlainModel<PeriodicRules> {
 public:
  explicit PeriodicRules(bool additive) : additive_{additive} {}
  [[nodiscard]] bool possible(const Call& call) const override {
    return call.event != expired || !e_.due.empty();
  }
  std::string react(const Call& call) override {
    bool sent = false;
    if (call.event == expired) {
      e_.expire();
      sent = e_.unacknowledged;
      if (sent && (additive_ || e_.due.empty())) e_.add(e_.now + heartbeat_period);
    } else if (call.event == acknowledgment_changed) {
      e_.unacknowledged = call.payload[0] == 1;
    } else {
      e_.wait(call.payload[0]);
      const bool adds = additive_ && call.event == suppression_ended;
      if (adds || e_.due.empty()) e_.add(e_.now + heartbeat_period);
    }
    return e_.in_words_with(sent) + (e_.due.empty() ? ", idle" : ", armed");
  }

 private:
  bool additive_;
  Expiries e_;
};

class PeriodicUnderTest final : public Reactor {
 public:
  PeriodicUnderTest(Mutations mutations, bool additive)
      : machine_{mutations}, additive_{additive} {}
  std::string react(const Call& call) override {
    using namespace heartbeat_timer;
    bool sent = false;
    if (call.event == expired) {
      e_.expire();
      sent = step<Expired>();
    } else if (call.event == acknowledgment_changed) {
      e_.unacknowledged = call.payload[0] == 1;
    } else {
      e_.wait(call.payload[0]);
      sent = call.event == opened ? step<ArmRequested>() : step<SuppressionEnded>();
    }
    return e_.in_words_with(sent) + (machine_.name(state_) == "Idle" ? ", idle" : ", armed");
  }

 private:
  template <class Event>
  bool step() {
    const auto output =
        machine_.step<Event>(state_, {.now = e_.now,
                                      .heartbeat_period = heartbeat_period,
                                      .adaptive = false,
                                      .additive = additive_,
                                      .pending = static_cast<std::int64_t>(e_.due.size()),
                                      .unacknowledged = e_.unacknowledged,
                                      .cycle = {}});
    if (output.schedule_expiry) e_.add(output.next_at);
    return output.send;
  }

  Stepper<HeartbeatTimer> machine_;
  bool additive_;
  StateId state_ = Stepper<HeartbeatTimer>::initial;
  Expiries e_;
};

MachineSubject periodic(const char* name, bool additive) {
  return machine_subject(
      name, "HeartbeatTimer",
      {{"opening (wait)", {12}},
       {"suppression end (wait)", {12}},
       {"expiry"},
       {"something unacknowledged", {1}}},
      [additive] { return std::make_unique<PeriodicRules>(additive); },
      [additive](Mutations m) { return std::make_unique<PeriodicUnderTest>(m, additive); });
}

}  // namespace

std::vector<MachineSubject> timer_subjects() {
  return {machine_subject(
              "SingleShot", "SingleShot", {{"request (wait, delay)", {3, 3}}, {"due"}},
              [] { return std::make_unique<ShotRules>(); },
              [](Mutations m) { return std::make_unique<ShotUnderTest>(m); }),
          periodic("HeartbeatTimerSingle", false), periodic("HeartbeatTimerAdditive", true),
          adaptive_subject()};
}

}  // namespace stormproof::fsm::stateful
