// The receiving side of a relation, its initial ACKNACKs, and the announcements of a participant,
// against the rules in plain code.
#include "fsm/announcer.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/initial_acknack.hpp"
#include "tests/fsm/stateful/machine_subject.hpp"

namespace stormproof::fsm::stateful {

namespace {

// ---- The reader of one relation of three descriptors. DATA and HEARTBEATs count once the source's
// announcement has been processed, before that only if the profile accepts them; every HEARTBEAT
// that counts makes an ACKNACK due, with what is missing when it is generated.

enum ReaderCall : std::size_t { announced, data, heartbeat, acknack_due, initial_due };
constexpr std::int64_t everything = 7;

struct ReaderView {
  bool open = false;
  std::int64_t received = 0;  // bit d: X_d
  int acknacks_due = 0;
  std::string sent;  // by the last call

  [[nodiscard]] std::string in_words() const {
    return std::string{open ? "open" : "not open"} + ", received " + std::to_string(received) +
           ", ACKNACKs due " + std::to_string(acknacks_due) + (sent.empty() ? "" : ", " + sent);
  }
};

std::string acknack_words(const char* kind, std::int64_t received) {
  return std::string{kind} + " that misses " + std::to_string(everything & ~received);
}

class ReaderRules final : public PlainModel<ReaderRules> {
 public:
  explicit ReaderRules(bool accepts) : accepts_{accepts} {}
  [[nodiscard]] bool possible(const Call& call) const override {
    if (call.event == announced) return !view_.open;  // only the first one is processed
    if (call.event == acknack_due) return view_.acknacks_due > 0;
    if (call.event == initial_due) return view_.open;
    return true;
  }
  std::string react(const Call& call) override {
    view_.sent.clear();
    const bool counts = view_.open || accepts_;
    if (call.event == announced) {
      view_.open = true;
      view_.sent = "initial ACKNACK timer";
    } else if (call.event == data && counts) {
      view_.received |= call.payload[0];
    } else if (call.event == heartbeat && counts) {
      ++view_.acknacks_due;
    } else if (call.event == acknack_due) {
      --view_.acknacks_due;
      view_.sent = acknack_words("ACKNACK", view_.received);
    } else if (call.event == initial_due) {
      view_.sent = acknack_words("initial ACKNACK", view_.received);
    }
    return view_.in_words() + (view_.received == everything ? ", complete" : "");
  }

 private:
  bool accepts_;
  ReaderView view_;
};

class ReaderUnderTest final : public Reactor {
 public:
  ReaderUnderTest(Mutations mutations, bool accepts) : machine_{mutations}, accepts_{accepts} {}
  std::string react(const Call& call) override {
    using namespace discovery_reader;
    view_.sent.clear();
    if (call.event == announced) {
      if (step<AnnouncementReceived>().opened) view_.sent = "initial ACKNACK timer";
    } else if (call.event == data) {
      const std::int64_t with = view_.received | call.payload[0];
      std::int64_t missing = 0;
      for (std::int64_t rest = everything & ~with; rest != 0; rest >>= 1) missing += rest & 1;
      if (step<DataReceived>(missing).take_data) view_.received = with;
    } else if (call.event == heartbeat) {
      if (step<HeartbeatReceived>().schedule_acknack) ++view_.acknacks_due;
    } else if (call.event == acknack_due) {
      --view_.acknacks_due;
      if (step<AckNackDue>().send_acknack) view_.sent = acknack_words("ACKNACK", view_.received);
    } else if (step<InitialAckNackDue>().send_initial) {
      view_.sent = acknack_words("initial ACKNACK", view_.received);
    }
    const std::string state = machine_.name(state_);
    view_.open = state == "Recognised" || state == "Complete";
    return view_.in_words() + (state == "Complete" || state == "EarlyComplete" ? ", complete" : "");
  }

 private:
  template <class Event>
  Stepper<DiscoveryReader>::Output step(std::int64_t missing = 0) {
    return machine_.step<Event>(state_, {.accepts_unmatched = accepts_, .missing_after = missing});
  }

  Stepper<DiscoveryReader> machine_;
  bool accepts_;
  StateId state_ = Stepper<DiscoveryReader>::initial;
  ReaderView view_;
};

MachineSubject reader(const char* name, bool accepts) {
  return machine_subject(
      name, "DiscoveryReader",
      {{"announcement"},
       {"DATA", {everything}},
       {"HEARTBEAT"},
       {"ACKNACK due"},
       {"initial ACKNACK due"}},
      [accepts] { return std::make_unique<ReaderRules>(accepts); },
      [accepts](Mutations m) { return std::make_unique<ReaderUnderTest>(m, accepts); });
}

// ---- Initial ACKNACKs: the first after τ_I (never, if that is 0), each next one after twice the
// delay or after τ_I again, none once a HEARTBEAT has been seen.

enum InitialCall : std::size_t { reader_opened, attempt_due, heartbeat_seen };

std::string initial_words(bool waits, std::int64_t now, std::int64_t due, bool sent) {
  return "at " + std::to_string(now) + (waits ? ", next at " + std::to_string(due) : "") +
         (sent ? ", sent" : "");
}

class InitialRules final : public PlainModel<InitialRules> {
 public:
  explicit InitialRules(int growth) : growth_{growth} {}
  [[nodiscard]] bool possible(const Call& call) const override {
    if (call.event == reader_opened) return !opened_;
    if (call.event == attempt_due) return delay_ > 0 && now_ < 1'000'000'000;
    return true;
  }
  std::string react(const Call& call) override {
    bool sent = false;
    if (call.event == reader_opened) {
      opened_ = true;
      now_ = call.payload[0];
      delay_ = call.payload[1];
    } else if (call.event == attempt_due) {
      now_ += delay_;
      sent = !seen_;
      delay_ = seen_ ? 0 : growth_ * delay_;
    } else {
      seen_ = true;
    }
    return initial_words(delay_ > 0, now_, now_ + delay_, sent);
  }

 private:
  int growth_;  // of the delay, with each attempt
  std::int64_t now_ = 0;
  std::int64_t delay_ = 0;  // of the pending attempt; 0: none
  bool opened_ = false;
  bool seen_ = false;
};

class InitialUnderTest final : public Reactor {
 public:
  InitialUnderTest(Mutations mutations, bool constant) : machine_{mutations}, constant_{constant} {}
  std::string react(const Call& call) override {
    Output output{};
    if (call.event == reader_opened) {
      now_ = call.payload[0];
      output = step<initial_acknack::ReaderOpened>(call.payload[1]);
    } else if (call.event == attempt_due) {
      waits_ = false;
      now_ = due_;
      output = step<initial_acknack::AttemptDue>(0);
    } else {
      seen_ = true;
    }
    if (output.schedule) {
      waits_ = true;
      delay_ = output.next_delay;
      due_ = output.next_at;
    }
    return initial_words(waits_, now_, due_, output.attempt);
  }

 private:
  using Output = Stepper<InitialAckNack>::Output;
  template <class Event>
  Output step(std::int64_t first_delay) {
    return machine_.step<Event>(state_, {.now = now_,
                                         .first_delay = first_delay,
                                         .last_delay = delay_,
                                         .heartbeat_seen = seen_,
                                         .constant = constant_});
  }

  Stepper<InitialAckNack> machine_;
  bool constant_;
  StateId state_ = Stepper<InitialAckNack>::initial;
  std::int64_t now_ = 0;
  std::int64_t delay_ = 0;
  std::int64_t due_ = 0;
  bool waits_ = false;
  bool seen_ = false;
};

MachineSubject attempts(const char* name, bool constant) {
  return machine_subject(
      name, "InitialAckNack", {{"opening (time, delay)", {5, 3}}, {"attempt due"}, {"HEARTBEAT"}},
      [constant] { return std::make_unique<InitialRules>(constant ? 1 : 2); },
      [constant](Mutations m) { return std::make_unique<InitialUnderTest>(m, constant); });
}

// ---- Announcements: number 0 at the start, some more at the startup period, then one every τ_P.

constexpr std::int64_t startup_period = 100;
constexpr std::int64_t announcement_period = 3'000;

class AnnouncementRules final : public PlainModel<AnnouncementRules> {
 public:
  explicit AnnouncementRules(std::int64_t startup) : startup_left_{startup} {}
  [[nodiscard]] bool possible(const Call&) const override { return true; }
  std::string react(const Call&) override {
    const std::string text = "announced at " + std::to_string(due_);
    due_ += startup_left_ > 0 ? startup_period : announcement_period;
    --startup_left_;
    return text + ", next at " + std::to_string(due_);
  }

 private:
  std::int64_t startup_left_;
  std::int64_t due_ = 0;
};

class AnnouncerUnderTest final : public Reactor {
 public:
  AnnouncerUnderTest(Mutations mutations, std::int64_t startup)
      : machine_{mutations}, startup_{startup} {}
  std::string react(const Call&) override {
    const auto output =
        machine_.step<announcer::AnnouncementDue>(state_, {.now = due_,
                                                           .number = number_++,
                                                           .startup = startup_,
                                                           .startup_period = startup_period,
                                                           .period = announcement_period});
    const std::string text = output.announce ? "announced at " + std::to_string(due_) : "silent";
    due_ = output.next_at;
    return text + ", next at " + std::to_string(due_);
  }

 private:
  Stepper<Announcer> machine_;
  std::int64_t startup_;
  StateId state_ = Stepper<Announcer>::initial;
  std::int64_t due_ = 0;
  std::int64_t number_ = 0;
};

MachineSubject announcements(const char* name, std::int64_t startup) {
  return machine_subject(
      name, "Announcer", {{"announcement due"}},
      [startup] { return std::make_unique<AnnouncementRules>(startup); },
      [startup](Mutations m) { return std::make_unique<AnnouncerUnderTest>(m, startup); });
}

}  // namespace

std::vector<MachineSubject> reader_subjects() {
  return {reader("DiscoveryReader", false),  reader("DiscoveryReaderThatAccepts", true),
          attempts("InitialAckNack", false), attempts("InitialAckNackOfConstantInterval", true),
          announcements("Announcer", 5),     announcements("AnnouncerWithoutStartup", 0)};
}

}  // namespace stormproof::fsm::stateful
