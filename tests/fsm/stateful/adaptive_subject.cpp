// The HEARTBEAT timer under the adaptive policy, for three readers, against the paper's rules in
// plain code. A cycle sends to the readers that lack something and waits for one period; answers of
// all of them in time end it early with the time that they took; otherwise the period grows to
// T·H/A, but at most 20-fold, and the silent readers are asked again in batches over what it has
// grown by. Times are small numbers, so that they meet often.
#include <algorithm>
#include <optional>

#include "fsm/heartbeat_timer.hpp"
#include "tests/fsm/stateful/machine_subject.hpp"

namespace stormproof::fsm::stateful {

namespace {

constexpr std::int64_t heartbeat_period = 10;

std::string with_time(const char* what, std::int64_t at) { return what + std::to_string(at); }

enum AdaptiveCall : std::size_t {
  relation_opened,
  time_goes_on,
  responded,
  lacking_changed,
  ended
};
constexpr int readers = 3;
constexpr std::int64_t all_readers = (1 << readers) - 1;
constexpr std::int64_t shortest = 4;
constexpr std::int64_t longest = 60;

/// The reader of this number, or all of them one after the other.
std::vector<std::int64_t> answering(std::int64_t number) {
  return number < readers ? std::vector<std::int64_t>{std::int64_t{1} << number}
                          : std::vector<std::int64_t>{1, 2, 4};
}

std::int64_t size_of(std::int64_t set) { return (set & 1) + (set >> 1 & 1) + (set >> 2 & 1); }

/// What both sides show. A pending event is "start", "end" or "batch", with its time.
struct CycleView {
  std::int64_t now = 0;
  std::int64_t lacking = 0;    // readers with something unacknowledged
  std::int64_t contacted = 0;  // U
  std::int64_t answered = 0;
  std::int64_t start = 0;  // c
  std::int64_t period = heartbeat_period;
  std::int64_t sent = 0;  // to whom, by the last call
  std::optional<std::int64_t> next_start;
  std::optional<std::int64_t> next_end;
  std::vector<std::pair<std::int64_t, std::int64_t>> batches;  // (time, readers), ascending

  void forget_events() {
    next_start.reset();
    next_end.reset();
    batches.clear();
  }
  [[nodiscard]] bool active() const { return next_start || next_end; }
  /// Batches precede the next start, and come first at the same time.
  [[nodiscard]] std::int64_t next_time() const {
    if (!batches.empty()) return batches.front().first;
    return next_end ? *next_end : *next_start;
  }
  /// Whether the time of the next event is reached; otherwise time just goes on.
  bool reach_next(std::int64_t wait) {
    if (!active()) {
      now += wait;
      return false;
    }
    const bool reached = now + wait >= next_time();
    now = reached ? next_time() : now + wait;
    return reached;
  }
  void plan_batches(std::int64_t stretched, std::int64_t size) {
    std::vector<std::int64_t> sets;
    std::int64_t filled = size;
    for (int j = 0; j < readers; ++j) {
      if ((contacted >> j & 1) == 0 || (answered >> j & 1) != 0) continue;
      if (filled == size) {
        sets.push_back(0);
        filled = 0;
      }
      sets.back() |= 1 << j;
      ++filled;
    }
    const auto count = static_cast<std::int64_t>(sets.size());
    for (std::int64_t k = 0; k < count; ++k) {
      batches.emplace_back(now + (stretched - period) * k / count,
                           sets[static_cast<std::size_t>(k)]);
    }
  }
  [[nodiscard]] std::string in_words() const {
    std::string text = with_time("at ", now) + with_time(", T ", period);
    text += with_time(", contacted ", contacted) + with_time(", answered ", answered);
    if (sent != 0) text += with_time(", sent to ", sent);
    if (next_start) text += with_time(", next start ", *next_start);
    if (next_end) text += with_time(", end ", *next_end);
    for (const auto& [at, set] : batches) {
      text += with_time(", batch at ", at) + with_time(" to ", set);
    }
    return text;
  }
};

class AdaptiveRules final : public PlainModel<AdaptiveRules> {
 public:
  [[nodiscard]] bool possible(const Call&) const override { return v_.now < 100'000; }
  std::string react(const Call& call) override {
    v_.sent = 0;
    if (call.event == relation_opened && !v_.active()) {
      v_.period = heartbeat_period;
      v_.next_start = v_.now + v_.period;
    } else if (call.event == time_goes_on) {
      go_on(call.payload[0]);
    } else if (call.event == responded) {
      for (const std::int64_t reader : answering(call.payload[0])) answer(reader);
    } else if (call.event == lacking_changed) {
      v_.lacking = call.payload[0] & all_readers;
    }
    return v_.in_words();
  }

 private:
  static std::int64_t clamp(std::int64_t t) { return std::clamp(t, shortest, longest); }

  void stop() {
    v_.forget_events();
    v_.period = heartbeat_period;
  }
  void go_on(std::int64_t wait) {
    if (!v_.reach_next(wait)) return;
    if (!v_.batches.empty()) {
      v_.sent = v_.batches.front().second & v_.lacking;
      v_.batches.erase(v_.batches.begin());
    } else if (v_.next_end) {
      end_cycle();
    } else {
      start_cycle();
    }
  }
  void start_cycle() {
    v_.forget_events();
    v_.contacted = v_.lacking;
    v_.answered = 0;
    if (v_.contacted == 0) return stop();
    v_.start = v_.now;
    v_.sent = v_.contacted;
    v_.next_end = v_.now + v_.period;
  }
  void end_cycle() {
    v_.forget_events();
    const std::int64_t h = size_of(v_.contacted);
    const std::int64_t a = size_of(v_.answered);
    std::int64_t grown = clamp(20 * v_.period);
    if (20 * a >= h) grown = clamp((2 * v_.period * h + a) / (2 * a));
    grown = std::max(grown, v_.period);
    v_.plan_batches(grown, std::max({std::int64_t{1}, a, (h + 19) / 20}));
    v_.next_start = v_.now + std::max<std::int64_t>(grown - v_.period, 1);
    v_.period = grown;
  }
  void answer(std::int64_t reader) {
    if (!v_.active() || (v_.contacted & reader) == 0 || (v_.answered & reader) != 0) return;
    v_.answered |= reader;
    if (v_.answered != v_.contacted || v_.now >= v_.start + v_.period) return;
    if (v_.lacking == 0) return stop();
    v_.forget_events();
    v_.period = clamp(v_.now - v_.start);
    v_.next_start = std::max(v_.now, v_.start + v_.period);
  }

  CycleView v_;
};

class AdaptiveUnderTest final : public Reactor {
 public:
  explicit AdaptiveUnderTest(Mutations mutations) : machine_{mutations} {}
  std::string react(const Call& call) override {
    using namespace heartbeat_timer;
    v_.sent = 0;
    if (call.event == relation_opened) {
      step<ArmRequested>();
    } else if (call.event == time_goes_on) {
      go_on(call.payload[0]);
    } else if (call.event == responded) {
      for (const std::int64_t reader : answering(call.payload[0])) {
        const bool awaited = (v_.contacted & ~v_.answered & reader) != 0;
        if (awaited) step<ResponseReceived>(reader);
      }
    } else if (call.event == lacking_changed) {
      v_.lacking = call.payload[0] & all_readers;
    } else {
      step<SuppressionEnded>();
    }
    return v_.in_words();
  }

 private:
  void go_on(std::int64_t wait) {
    using namespace heartbeat_timer;
    if (!v_.reach_next(wait)) return;
    if (!v_.batches.empty()) {
      const std::int64_t batch = v_.batches.front().second;
      v_.batches.erase(v_.batches.begin());
      if (step<BatchDue>().send_batch) v_.sent = batch & v_.lacking;
    } else if (v_.next_end) {
      v_.next_end.reset();
      step<CycleEnded>();
    } else {
      v_.next_start.reset();
      v_.contacted = v_.lacking;  // H is counted as the cycle starts
      v_.answered = 0;
      step<CycleStarted>();
    }
  }
  template <class Event>
  Stepper<HeartbeatTimer>::Output step(std::int64_t reader = 0) {
    const AdaptiveCycle<Plain> cycle{.start = v_.start,
                                     .period = v_.period,
                                     .contacted = size_of(v_.contacted),
                                     .responded = size_of(v_.answered),
                                     .min_period = shortest,
                                     .max_period = longest};
    const auto output = machine_.step<Event>(state_, {.now = v_.now,
                                                      .heartbeat_period = heartbeat_period,
                                                      .adaptive = true,
                                                      .unacknowledged = v_.lacking != 0,
                                                      .cycle = cycle});
    if (output.count_response) v_.answered |= reader;
    if (output.invalidate) v_.forget_events();
    if (output.send) {
      v_.sent = v_.contacted;
      v_.start = v_.now;
    }
    if (output.pace) v_.plan_batches(output.period, batch_size<Plain>(cycle));
    if (output.schedule_cycle) v_.next_start = output.next_at;
    if (output.schedule_end) v_.next_end = output.next_at;
    if (output.schedule_expiry) v_.next_end = output.next_at;  // of the other policy
    if (output.period != 0) v_.period = output.period;
    return output;
  }

  Stepper<HeartbeatTimer> machine_;
  StateId state_ = Stepper<HeartbeatTimer>::initial;
  CycleView v_;
};

}  // namespace

MachineSubject adaptive_subject() {
  return machine_subject(
      "HeartbeatTimerAdaptive", "HeartbeatTimer",
      {{"opening"},
       {"wait", {12}},
       {"response of reader (3: all)", {readers}},
       {"readers that lack something", {all_readers + 1}},
       {"suppression end"}},
      [] { return std::make_unique<AdaptiveRules>(); },
      [](Mutations m) { return std::make_unique<AdaptiveUnderTest>(m); });
}

}  // namespace stormproof::fsm::stateful
