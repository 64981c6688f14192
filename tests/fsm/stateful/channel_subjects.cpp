// The channel against a server that is either busy or not, and the control-only relations of Fast
// DDS against two flags each.
#include "fsm/channel.hpp"
#include "fsm/control_relation.hpp"
#include "tests/fsm/stateful/machine_subject.hpp"

namespace stormproof::fsm::stateful {

namespace {

// ---- Channel: it serves one fragment at a time; a dispatch picks the next one, after every other
// event of the instant; there is never more than one dispatch pending, and none is missing.

enum ChannelCall : std::size_t { requested, dispatched, finished };

std::string channel_words(bool busy, std::int64_t waiting, bool dispatch_pending) {
  return std::string{busy ? "busy" : "idle"} + ", " + std::to_string(waiting) + " waiting" +
         (dispatch_pending ? ", dispatch pending" : "");
}

class OneServer final : public PlainModel<OneServer> {
 public:
  [[nodiscard]] bool possible(const Call& call) const override {
    if (call.event == dispatched) return dispatch_pending_;
    if (call.event == finished) return busy_;
    return true;
  }
  std::string react(const Call& call) override {
    if (call.event == requested) {
      ++waiting_;
      if (!busy_) dispatch_pending_ = true;
    } else if (call.event == dispatched) {
      dispatch_pending_ = false;
      if (!busy_ && waiting_ > 0) {
        busy_ = true;
        --waiting_;
      }
    } else {
      busy_ = false;
      waiting_ += call.payload[0];  // what the end of this service requests
      if (waiting_ > 0) dispatch_pending_ = true;
    }
    return channel_words(busy_, waiting_, dispatch_pending_);
  }

 private:
  bool busy_ = false;
  bool dispatch_pending_ = false;
  std::int64_t waiting_ = 0;
};

class ChannelUnderTest final : public Reactor {
 public:
  explicit ChannelUnderTest(Mutations mutations) : machine_{mutations} {}

  std::string react(const Call& call) override {
    if (call.event == requested) {
      request();
    } else if (call.event == dispatched) {
      dispatch_pending_ = false;
      step<channel::DispatchDue>();
    } else {
      step<channel::ServiceFinished>();
      for (std::int64_t k = 0; k < call.payload[0]; ++k) request();
      step<channel::EffectsDone>();
    }
    return channel_words(machine_.name(state_) == "Busy", waiting_, dispatch_pending_) + twice_;
  }

 private:
  template <class Event>
  void step() {
    const auto output = machine_.step<Event>(
        state_, {.waiting = waiting_ > 0, .dispatch_pending = dispatch_pending_});
    if (output.schedule_dispatch && dispatch_pending_) twice_ = ", two dispatches pending";
    dispatch_pending_ = dispatch_pending_ || output.schedule_dispatch;
    if (output.serve) --waiting_;
  }
  void request() {
    ++waiting_;
    step<channel::ServiceRequested>();
  }

  Stepper<Channel> machine_;
  StateId state_ = Stepper<Channel>::initial;
  bool dispatch_pending_ = false;
  std::int64_t waiting_ = 0;
  std::string twice_;
};

// ---- Control-only relations: the writer side answers initial ACKNACKs once it is open, the reader
// side answers HEARTBEATs once it is open; opening sends a HEARTBEAT or starts the initial
// ACKNACKs.

enum ControlCall : std::size_t { opened, reached };

class ControlSide final : public PlainModel<ControlSide> {
 public:
  explicit ControlSide(bool is_writer) : is_writer_{is_writer} {}
  [[nodiscard]] bool possible(const Call& call) const override {
    return call.event != opened || !open_;
  }
  std::string react(const Call& call) override {
    const bool answers = open_ && call.event == reached;
    const bool opens = call.event == opened;
    open_ = open_ || opens;
    std::string text = open_ ? "open" : "closed";
    if (is_writer_ && (opens || answers)) text += ", HEARTBEAT";
    if (!is_writer_ && opens) text += ", initial ACKNACK timer";
    if (!is_writer_ && answers) text += ", reply";
    return text;
  }

 private:
  bool is_writer_;
  bool open_ = false;
};

template <class Machine, class Reached>
class ControlUnderTest final : public Reactor {
 public:
  explicit ControlUnderTest(Mutations mutations) : machine_{mutations} {}
  std::string react(const Call& call) override {
    const auto output = call.event == opened
                            ? machine_.template step<control_relation::Opened>(state_)
                            : machine_.template step<Reached>(state_);
    std::string text = machine_.name(state_) == "Open" ? "open" : "closed";
    if (output.send_heartbeat) text += ", HEARTBEAT";
    if (output.start_initial) text += ", initial ACKNACK timer";
    if (output.reply) text += ", reply";
    return text;
  }

 private:
  Stepper<Machine> machine_;
  StateId state_ = Stepper<Machine>::initial;
};

using ControlWriterUnderTest =
    ControlUnderTest<ControlWriter, control_relation::InitialAckNackReceived>;
using ControlReaderUnderTest = ControlUnderTest<ControlReader, control_relation::HeartbeatReceived>;

}  // namespace

std::vector<MachineSubject> channel_subjects() {
  return {machine_subject(
              "Channel", "Channel", {{"request"}, {"dispatch"}, {"service finished", {3}}},
              [] { return std::make_unique<OneServer>(); },
              [](Mutations m) { return std::make_unique<ChannelUnderTest>(m); }),
          machine_subject(
              "ControlWriter", "ControlWriter", {{"opening"}, {"initial ACKNACK"}},
              [] { return std::make_unique<ControlSide>(true); },
              [](Mutations m) { return std::make_unique<ControlWriterUnderTest>(m); }),
          machine_subject(
              "ControlReader", "ControlReader", {{"opening"}, {"HEARTBEAT"}},
              [] { return std::make_unique<ControlSide>(false); },
              [](Mutations m) { return std::make_unique<ControlReaderUnderTest>(m); })};
}

}  // namespace stormproof::fsm::stateful
