// The reader side of a relation of Cyclone DDS with three samples and its timer, against the rules
// in plain code. All delays are drawn with the opening.
#include <optional>

#include "fsm/cautious_reader.hpp"
#include "tests/fsm/stateful/machine_subject.hpp"
#include "tests/fsm/stateful/moved_timer.hpp"

namespace stormproof::fsm::stateful {

namespace {

enum CautiousCall : std::size_t { side_opened, sample, heard, timer_due };
constexpr std::int64_t samples = 3;

/// Most DATA are lost; a reader that has everything has little left to do.
bool arrives(const Call& data) { return data.payload[1] == 0; }

/// What can be seen of a reader, and what both sides keep alike: times, delays and samples.
struct CautiousView {
  bool open = false;
  bool seen = false;
  bool since = false;
  bool directed = false;
  std::int64_t last = 0;
  std::int64_t has = 0;  // bit d: sample d + 1
  MovedTimer timer;
  std::int64_t ack_delay = 0;
  std::int64_t nack_delay = 0;
  std::int64_t again_delay = 0;
  std::int64_t preemptive_delay = 0;
  std::int64_t repeat_delay = 0;
  std::string sent;  // by the last call

  void draw(const Call& call) {
    preemptive_delay = call.payload[0];
    repeat_delay = 1 + call.payload[1];
    ack_delay = call.payload[2];
    nack_delay = 1 + call.payload[3];
    again_delay = 1 + call.payload[4];
  }
  [[nodiscard]] std::int64_t first_missing() const {
    std::int64_t b = 1;
    while (b <= samples && (has >> (b - 1) & 1) != 0) ++b;
    return b;
  }
  void send(const char* kind) {
    std::string missing;
    for (std::int64_t d = first_missing(); d <= last; ++d) {
      if ((has >> (d - 1) & 1) == 0) missing += " " + std::to_string(d);
    }
    sent = std::string{kind} + " from " + std::to_string(first_missing()) + ", missing" + missing;
  }
  [[nodiscard]] std::string in_words() const {
    return std::string{open ? "open" : "closed"} + (seen ? ", seen" : "") +
           (since ? ", since" : "") + (directed ? ", directed" : "") + ", last " +
           std::to_string(last) + ", has " + std::to_string(has) + ", " + timer.in_words() +
           (sent.empty() ? "" : ", " + sent);
  }
};

class CautiousRules final : public PlainModel<CautiousRules> {
 public:
  [[nodiscard]] bool possible(const Call& call) const override {
    return call.event != timer_due || v_.timer.due.has_value();
  }
  std::string react(const Call& call) override {
    v_.sent.clear();
    if (call.event == side_opened) {
      if (!v_.open) {
        v_.open = true;
        v_.draw(call);
        v_.timer.move(v_.timer.now + v_.preemptive_delay);
      }
    } else if (call.event == sample) {
      if (v_.seen && arrives(call)) {
        v_.has |= 1 << call.payload[0];
        v_.last = std::max(v_.last, call.payload[0] + 1);
      }
    } else if (call.event == heard) {
      v_.timer.wait(call.payload[0]);
      if (v_.open) hear(call.payload[1], call.payload[2] == 1, call.payload[3] == 1);
    } else {
      v_.timer.take();
      fire();
    }
    return v_.in_words();
  }

 private:
  enum class Said { nothing, ack, hush, nack };

  [[nodiscard]] bool is_over(std::int64_t delay, const std::optional<std::int64_t>& from) const {
    return !from || v_.timer.now >= *from + delay;
  }
  /// C8; whether a request repeats another one.
  Said judge(bool& delayed) const {
    const std::int64_t b = v_.first_missing();
    Said said = Said::ack;
    delayed = false;
    if (b <= v_.last) {
      const bool over = is_over(v_.nack_delay, nacked_);
      if (b >= end_ || (v_.directed && (!by_delay_ || over))) return Said::nack;
      delayed = over;
      if (over) return Said::nack;
      said = Said::hush;
    }
    const bool news = b > base_ || is_over(v_.ack_delay, acked_);
    return v_.since && news ? said : Said::nothing;
  }
  void hear(std::int64_t announced, bool fresh, bool directed) {
    v_.seen = true;
    v_.last = std::max(v_.last, announced);
    if (!fresh) return;
    v_.since = true;
    v_.directed = v_.directed || directed;
    bool delayed = false;
    const Said said = judge(delayed);
    if (said == Said::hush) v_.timer.move(*nacked_ + v_.nack_delay);
    if (said == Said::ack || said == Said::nack) v_.timer.move(v_.timer.now);
  }
  void fire() {
    if (!v_.seen) {
      v_.sent = "pre-emptive";
      acked_ = v_.timer.now;
      v_.timer.move(v_.timer.now + v_.repeat_delay);
      return;
    }
    bool delayed = false;
    const Said said = judge(delayed);
    if (said == Said::nothing) return;
    if (!v_.since && !is_over(v_.again_delay, nacked_)) {
      v_.timer.move(*nacked_ + v_.again_delay);
      return;
    }
    v_.since = v_.directed = false;
    base_ = v_.first_missing();
    acked_ = v_.timer.now;
    if (said == Said::nack) {
      v_.send("request");
      by_delay_ = delayed;
      end_ = v_.last + 1;
      nacked_ = v_.timer.now;
      v_.timer.move(v_.timer.now + v_.again_delay);
    } else {
      v_.send("reply");
      if (said == Said::hush) v_.timer.move(*nacked_ + v_.nack_delay);
    }
  }

  CautiousView v_;
  bool by_delay_ = false;
  std::int64_t base_ = 0;
  std::int64_t end_ = 0;
  std::optional<std::int64_t> acked_;
  std::optional<std::int64_t> nacked_;
};

class CautiousUnderTest final : public Reactor {
 public:
  explicit CautiousUnderTest(Mutations mutations) : machine_{mutations} {}
  std::string react(const Call& call) override {
    using namespace cautious_reader;
    v_.sent.clear();
    if (call.event == side_opened) {
      if (!v_.open) v_.draw(call);
      step<Opened>(v_.last, false, false);
    } else if (call.event == sample) {
      if (arrives(call) && step<DataReceived>(v_.last, false, false).take_data) {
        v_.has |= 1 << call.payload[0];
        v_.last = std::max(v_.last, call.payload[0] + 1);
      }
    } else if (call.event == stateful::heard) {
      v_.timer.wait(call.payload[0]);
      const std::int64_t last = std::max(v_.last, call.payload[1]);
      const bool directed = call.payload[3] == 1;
      if (step<HeartbeatReceived>(last, call.payload[2] == 1, directed).learn) v_.last = last;
    } else {
      v_.timer.take();
      fire();
    }
    const std::string state = machine_.name(state_);
    v_.open = state != "Closed";
    v_.seen = v_.open && state != "Unheard";
    v_.since = state == "Heard" || state == "Addressed";
    v_.directed = state == "Addressed";
    return v_.in_words();
  }

 private:
  void fire() {
    const auto output = step<cautious_reader::TimerFired>(v_.last, false, false);
    if (output.preempt) v_.sent = "pre-emptive";
    if (output.reply) {
      v_.send(output.request ? "request" : "reply");
      base_ = v_.first_missing();
      if (output.request) {
        by_delay_ = output.delayed;
        end_ = v_.last + 1;
        hush_until_ = v_.timer.now + v_.nack_delay;
        again_at_ = v_.timer.now + v_.again_delay;
      }
    }
    if (output.preempt || output.reply) quiet_until_ = v_.timer.now + v_.ack_delay;
  }
  template <class Event>
  Stepper<CautiousReader>::Output step(std::int64_t last, bool fresh, bool directed) {
    const auto output = machine_.step<Event>(state_, {.fresh = fresh,
                                                      .directed = directed,
                                                      .by_delay = by_delay_,
                                                      .first_missing = v_.first_missing(),
                                                      .last = last,
                                                      .asked_end = end_,
                                                      .base = base_,
                                                      .now = v_.timer.now,
                                                      .quiet_until = quiet_until_,
                                                      .hush_until = hush_until_,
                                                      .again_at = again_at_,
                                                      .preemptive_delay = v_.preemptive_delay,
                                                      .repeat_delay = v_.repeat_delay,
                                                      .again_delay = v_.again_delay});
    if (output.move) v_.timer.move(output.next_at);
    return output;
  }

  Stepper<CautiousReader> machine_;
  StateId state_ = Stepper<CautiousReader>::initial;
  CautiousView v_;
  bool by_delay_ = false;
  std::int64_t base_ = 0;
  std::int64_t end_ = 0;
  std::int64_t quiet_until_ = 0;
  std::int64_t hush_until_ = 0;
  std::int64_t again_at_ = 0;
};

}  // namespace

MachineSubject cautious_subject() {
  return machine_subject(
      "CautiousReader", "CautiousReader",
      {{"opening (delays)", {3, 9, 9, 9, 9}},
       {"DATA (sample, lost unless 0)", {samples - 1, 9}},
       {"HEARTBEAT (wait, announces, fresh, directed)", {6, samples, 1, 1}},
       {"timer"}},
      [] { return std::make_unique<CautiousRules>(); },
      [](Mutations m) { return std::make_unique<CautiousUnderTest>(m); });
}

}  // namespace stormproof::fsm::stateful
