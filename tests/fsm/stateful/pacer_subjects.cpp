// What a writer of Cyclone DDS knows of a reader, and when it sends HEARTBEATs, against the rules
// in plain code. Times are small numbers, so that they meet often.
#include <algorithm>
#include <optional>

#include "fsm/heartbeat_pacer.hpp"
#include "fsm/matched_reader.hpp"
#include "tests/fsm/stateful/machine_subject.hpp"
#include "tests/fsm/stateful/moved_timer.hpp"

namespace stormproof::fsm::stateful {

namespace {

// ---- A reader as its writer sees it. It has replied once an ACKNACK that counts asks for nothing
// and takes nothing back.

enum PeerCall : std::size_t { peer_opened, acknack };

struct PeerView {
  std::int64_t acked = 0;
  int matches = 0;
  bool replied = false;

  [[nodiscard]] std::string in_words() const {
    return "matched " + std::to_string(matches) + " times, acknowledged " + std::to_string(acked) +
           (replied ? ", replied" : "");
  }
};

class PeerRules final : public PlainModel<PeerRules> {
 public:
  [[nodiscard]] bool possible(const Call&) const override { return true; }
  std::string react(const Call& call) override {
    if (call.event == peer_opened) {
      view_.matches = 1;
    } else if (view_.matches == 1 && call.payload[0] == 1) {
      const bool asks = call.payload[1] == 1;
      if (!asks && call.payload[2] >= view_.acked) view_.replied = true;
      view_.acked = std::max(view_.acked, call.payload[2]);
    }
    return view_.in_words();
  }

 private:
  PeerView view_;
};

class PeerUnderTest final : public Reactor {
 public:
  explicit PeerUnderTest(Mutations mutations) : machine_{mutations} {}
  std::string react(const Call& call) override {
    using namespace matched_reader;
    if (call.event == peer_opened) {
      if (machine_.step<Opened>(state_).matched) ++view_.matches;
    } else {
      const bool replies = call.payload[1] == 0 && call.payload[2] >= view_.acked;
      const auto output = machine_.step<AckNackReceived>(
          state_, {.accepted = call.payload[0] == 1, .replies = replies});
      if (output.take) view_.acked = std::max(view_.acked, call.payload[2]);
    }
    view_.replied = machine_.name(state_) == "Replied";
    return view_.in_words();
  }

 private:
  Stepper<MatchedReader> machine_;
  StateId state_ = Stepper<MatchedReader>::initial;
  PeerView view_;
};

// ---- HEARTBEATs of a writer: while somebody waits, at an interval that doubles with every second
// one beyond the sixth, stays below its limit, and begins anew with a match or a new sample.

enum PacerCall : std::size_t { pacer_matched, hastened, fired, waiting_changed };
constexpr std::int64_t interval = 5;
constexpr std::int64_t interval_max = 41;
constexpr std::int64_t match_delay = 1;

struct PacerView {
  MovedTimer timer;
  bool waiting = true;
  std::vector<std::int64_t> sent;  // by the last call

  [[nodiscard]] std::string in_words(bool pacing) const {
    return timer.in_words() + ", sent " + stateful::in_words(sent) + (pacing ? "" : ", at rest");
  }
};

class PacerRules final : public PlainModel<PacerRules> {
 public:
  [[nodiscard]] bool possible(const Call& call) const override {
    return call.event != fired || v_.timer.due.has_value();
  }
  std::string react(const Call& call) override {
    v_.sent.clear();
    if (call.event == waiting_changed) {
      v_.waiting = call.payload[0] == 1;
    } else if (call.event == fired) {
      for (std::int64_t k = 0; k <= call.payload[0] && v_.timer.due; ++k) fire();
    } else {
      v_.timer.wait(call.payload[0]);
      number_ = 0;
      v_.timer.move(v_.timer.now + (call.event == hastened ? interval : match_delay));
    }
    return v_.in_words(v_.timer.due.has_value());
  }

 private:
  [[nodiscard]] std::int64_t wait_after() const {
    std::int64_t length = interval;
    for (std::int64_t twice = (number_ - 5) / 2; twice > 0 && 2 * length < interval_max; --twice) {
      length *= 2;
    }
    return length;
  }
  void fire() {
    v_.timer.take();
    if (!v_.waiting) return;
    const std::int64_t now = v_.timer.now;
    if (!last_ || now >= *last_ + wait_after()) {
      v_.sent.push_back(now);
      last_ = now;
      ++number_;
    }
    v_.timer.move(now + wait_after());
  }

  PacerView v_;
  std::optional<std::int64_t> last_;
  std::int64_t number_ = 0;
};

class PacerUnderTest final : public Reactor {
 public:
  explicit PacerUnderTest(Mutations mutations) : machine_{mutations} {}
  std::string react(const Call& call) override {
    using namespace heartbeat_pacer;
    v_.sent.clear();
    if (call.event == waiting_changed) {
      v_.waiting = call.payload[0] == 1;
    } else if (call.event == stateful::fired) {
      for (std::int64_t k = 0; k <= call.payload[0] && v_.timer.due; ++k) {
        v_.timer.take();
        step<Fired>();
      }
    } else {
      v_.timer.wait(call.payload[0]);
      if (call.event == stateful::hastened) step<Hastened>();
      if (call.event == pacer_matched) step<Matched>();
    }
    return v_.in_words(machine_.name(state_) == "Pacing");
  }

 private:
  template <class Event>
  void step() {
    const auto output = machine_.step<Event>(state_, {.waiting = v_.waiting,
                                                      .sent_before = last_.has_value(),
                                                      .now = v_.timer.now,
                                                      .last_sent = last_.value_or(0),
                                                      .number = number_,
                                                      .interval = interval,
                                                      .interval_max = interval_max,
                                                      .match_delay = match_delay});
    if (output.send) {
      v_.sent.push_back(v_.timer.now);
      last_ = v_.timer.now;
      ++number_;
    }
    if (output.restart) number_ = 0;
    if (output.move) v_.timer.move(output.next_at);
  }

  Stepper<HeartbeatPacer> machine_;
  StateId state_ = Stepper<HeartbeatPacer>::initial;
  PacerView v_;
  std::optional<std::int64_t> last_;
  std::int64_t number_ = 0;
};

}  // namespace

std::vector<MachineSubject> pacer_subjects() {
  return {machine_subject(
              "MatchedReader", "MatchedReader",
              {{"opening"}, {"ACKNACK (accepted, asks, has)", {1, 1, 3}}},
              [] { return std::make_unique<PeerRules>(); },
              [](Mutations m) { return std::make_unique<PeerUnderTest>(m); }),
          machine_subject(
              "HeartbeatPacer", "HeartbeatPacer",
              {{"match (wait)", {12}},
               {"new sample (wait)", {12}},
               {"timer (times more)", {12}},
               {"somebody waits", {1}}},
              [] { return std::make_unique<PacerRules>(); },
              [](Mutations m) { return std::make_unique<PacerUnderTest>(m); }),
          cautious_subject()};
}

}  // namespace stormproof::fsm::stateful
