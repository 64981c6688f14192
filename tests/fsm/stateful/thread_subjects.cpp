// The timer of Cyclone DDS that only moves to earlier times, and the thread that fires it, against
// the rules in plain code. Times are small numbers, so that they meet often.
#include <algorithm>
#include <optional>

#include "fsm/event_thread.hpp"
#include "fsm/movable_timer.hpp"
#include "tests/fsm/stateful/machine_subject.hpp"

namespace stormproof::fsm::stateful {

namespace {

// ---- A timer. Each move to an earlier time schedules an event; the one that comes when the timer
// is due puts it on the list, and the others find nothing.

enum TimerCall : std::size_t { moved, time_came, taken };

struct TimerView {
  std::int64_t now = 0;
  std::vector<std::int64_t> events;  // ascending
  std::string state = "never due";

  /// Time goes on, but not past an event.
  void wait(std::int64_t time) {
    now = events.empty() ? now + time : std::min(now + time, events.front());
  }
  void schedule(std::int64_t at) {
    events.insert(std::upper_bound(events.begin(), events.end(), at), at);
  }
  void next() {
    now = events.front();
    events.erase(events.begin());
  }
  [[nodiscard]] std::string in_words() const {
    return "at " + std::to_string(now) + ", scheduled " + stateful::in_words(events) + ", " + state;
  }
};

class TimerRules final : public PlainModel<TimerRules> {
 public:
  [[nodiscard]] bool possible(const Call& call) const override {
    if (call.event == time_came) return !view_.events.empty();
    return call.event == moved || listed_;
  }
  std::string react(const Call& call) override {
    if (call.event == moved) {
      view_.wait(call.payload[0]);
      const std::int64_t to = view_.now + call.payload[1];
      if (!due_ || to < *due_) {
        due_ = to;
        view_.schedule(to);
      }
    } else if (call.event == time_came) {
      view_.next();
      if (due_ == view_.now) listed_ = true;
    } else {
      due_.reset();
      listed_ = false;
    }
    view_.state = listed_ ? "listed" : due_ ? "due at " + std::to_string(*due_) : "never due";
    return view_.in_words();
  }

 private:
  std::optional<std::int64_t> due_;
  bool listed_ = false;
  TimerView view_;
};

class TimerUnderTest final : public Reactor {
 public:
  explicit TimerUnderTest(Mutations mutations) : machine_{mutations} {}
  std::string react(const Call& call) override {
    if (call.event == moved) {
      view_.wait(call.payload[0]);
      const std::int64_t to = view_.now + call.payload[1];
      if (step<movable_timer::Moved>(to).schedule) {
        due_ = to;
        view_.schedule(to);
      }
    } else if (call.event == time_came) {
      view_.next();
      joins_ = joins_ || step<movable_timer::Came>().join;
    } else {
      step<movable_timer::Taken>();
      joins_ = false;
    }
    const std::string name = machine_.name(state_);
    view_.state = name == "Idle"     ? "never due"
                  : name == "Listed" ? "listed"
                                     : "due at " + std::to_string(due_);
    if (joins_ != (name == "Listed")) view_.state += ", not as its list says";
    return view_.in_words();
  }

 private:
  template <class Event>
  Stepper<MovableTimer>::Output step(std::int64_t to = 0) {
    return machine_.step<Event>(state_, {.now = view_.now, .due = due_, .to = to});
  }

  Stepper<MovableTimer> machine_;
  StateId state_ = Stepper<MovableTimer>::initial;
  std::int64_t due_ = 0;
  bool joins_ = false;
  TimerView view_;
};

// ---- The thread: woken, it runs at once; while a copy goes out it waits; what wakes it while it
// waits or works changes nothing.

enum ThreadCall : std::size_t { woken, run_due, copy_sent, nothing_left };

std::string thread_words(std::int64_t now, const std::optional<std::int64_t>& run, bool works) {
  return "at " + std::to_string(now) + (run ? ", run at " + std::to_string(*run) : "") +
         (works ? ", works" : "");
}

class ThreadRules final : public PlainModel<ThreadRules> {
 public:
  [[nodiscard]] bool possible(const Call& call) const override {
    if (call.event == run_due) return run_.has_value();
    return call.event == woken || works_;
  }
  std::string react(const Call& call) override {
    if (call.event == run_due) {
      now_ = *run_;
      run_.reset();
      works_ = true;
    } else if (call.event == woken) {
      if (!run_ && !works_) {
        now_ += call.payload[0];
        run_ = now_;
      }
    } else {
      works_ = false;
      if (call.event == copy_sent) run_ = now_ + call.payload[0];
    }
    return thread_words(now_, run_, works_);
  }

 private:
  std::int64_t now_ = 0;
  std::optional<std::int64_t> run_;
  bool works_ = false;
};

class ThreadUnderTest final : public Reactor {
 public:
  explicit ThreadUnderTest(Mutations mutations) : machine_{mutations} {}
  std::string react(const Call& call) override {
    using namespace event_thread;
    if (call.event == run_due) {
      now_ = run_.value_or(now_);
      run_.reset();
      works_ = step<RunDue>().work;
    } else if (call.event == woken) {
      if (!run_ && !works_) now_ += call.payload[0];
      step<Woken>();
    } else if (call.event == copy_sent) {
      works_ = false;
      step<CopySent>(call.payload[0]);
    } else {
      works_ = false;
      step<NothingLeft>();
    }
    return thread_words(now_, run_, works_ && machine_.name(state_) == "Working");
  }

 private:
  template <class Event>
  Stepper<EventThread>::Output step(std::int64_t send_time = 0) {
    const auto output = machine_.step<Event>(state_, {.now = now_, .send_time = send_time});
    if (output.schedule) run_ = output.next_at;
    return output;
  }

  Stepper<EventThread> machine_;
  StateId state_ = Stepper<EventThread>::initial;
  std::int64_t now_ = 0;
  std::optional<std::int64_t> run_;
  bool works_ = false;
};

}  // namespace

std::vector<MachineSubject> thread_subjects() {
  return {machine_subject(
              "MovableTimer", "MovableTimer", {{"move (wait, delay)", {3, 6}}, {"time"}, {"taken"}},
              [] { return std::make_unique<TimerRules>(); },
              [](Mutations m) { return std::make_unique<TimerUnderTest>(m); }),
          machine_subject(
              "EventThread", "EventThread",
              {{"woken (wait)", {3}}, {"run"}, {"copy sent (time)", {3}}, {"nothing left"}},
              [] { return std::make_unique<ThreadRules>(); },
              [](Mutations m) { return std::make_unique<ThreadUnderTest>(m); })};
}

}  // namespace stormproof::fsm::stateful
