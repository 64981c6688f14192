// One relation of Fast DDS as order.commutation sees it: the writer's record of one generic
// descriptor, the reader's bits of it, the reader machine, the single-shot timers (reply,
// suppression, nack response, asynchronous run), the initial ACKNACK timer and the HEARTBEAT timer,
// all stepped by their tables. The rules between them are those of specs/guide/fastdds.md.
#include "checker/engines/tables/fastdds_relation_state.hpp"

namespace stormproof::tables {
namespace fastdds {
namespace {

namespace change = fsm::change_for_reader;
namespace reader = fsm::discovery_reader;
namespace initial = fsm::initial_acknack;
namespace timer = fsm::heartbeat_timer;
namespace shot = fsm::single_shot;
using smt::SymbolicBool;

class Rules {
 public:
  explicit Rules(Proof& proof)
      : writer_{proof.mistakes().tables},
        reader_{proof.mistakes().tables},
        initial_{proof.mistakes().tables},
        timer_{proof.mistakes().tables},
        shot_{proof.mistakes().tables} {}

  [[nodiscard]] Exprs knobs() const { return {others_waiting_}; }

  using Body = std::function<void(const Rules&, State&, Outputs&)>;

  EventInstance instance(Exprs inputs, const Expr& possible, const Expr& consistent,
                         Body body) const {
    const Rules& rules = *this;
    auto apply = [rules, body](const Exprs& flat) {
      State state = State::from(flat);
      Outputs outputs{output_kinds};
      body(rules, state, outputs);
      return Outcome{state.flat(), outputs.counts()};
    };
    return {std::move(inputs), possible, consistent, apply};
  }

  EventInstance data_received(const std::string& p, const Exprs& flat) const {
    const Expr carries = truth(p + "carries_it");
    const Expr completes = truth(p + "completes_others");
    const Expr later = truth(p + "carries_a_later_one");
    const Expr beat = truth(p + "carries_heartbeat");
    const Expr announces = truth(p + "announces_it");
    const State now = State::from(flat);
    const Expr exists = !Writer::is<change::Absent>(now.writer);
    return instance({carries, completes, later, beat, announces}, constant(true),
                    z3::implies(carries || later || announces, exists),
                    [=](const Rules& r, State& s, Outputs& out) {
                      const Expr taken =
                          s.reader.take_data(r.reader_, constant(false), carries, completes);
                      s.announced = s.announced || (taken && (carries || later));
                      r.take_heartbeat(s, out, beat, announces);
                    });
  }

  EventInstance heartbeat_received(const std::string& p, const Exprs& flat) const {
    const Expr announces = truth(p + "announces_it");
    const State now = State::from(flat);
    return instance({announces}, constant(true),
                    z3::implies(announces, !Writer::is<change::Absent>(now.writer)),
                    [=](const Rules& r, State& s, Outputs& out) {
                      r.take_heartbeat(s, out, constant(true), announces);
                    });
  }

  EventInstance acknack(const std::string& p, const Exprs& flat) const {
    const Expr listed = truth(p + "listed");
    const Expr below = truth(p + "below_base");
    const Expr others = truth(p + "lists_others");
    const Expr based = truth(p + "base_above_zero");
    const Expr is_initial = truth(p + "initial");
    const State now = State::from(flat);
    const Expr possible = !(listed && below) && z3::implies(below, based) &&
                          z3::implies(is_initial, !listed && !below && !others && !based);
    // What lies below the base its reader had received; what it lists had been announced to it.
    const Expr consistent =
        z3::implies(below, now.reader.received) && z3::implies(listed, now.announced);
    return instance({listed, below, others, based, is_initial}, possible, consistent,
                    [=](const Rules& r, State& s, Outputs& out) {
                      r.take_acknack(s, out, listed, below, others, based, is_initial);
                    });
  }

  EventInstance acknack_generation(const std::string&, const Exprs& flat) const {
    const State now = State::from(flat);
    return instance({}, Shot::is<shot::Pending>(now.reply), constant(true),
                    [](const Rules& r, State& s, Outputs& out) {
                      const Expr fire = r.fires(s.reply);
                      const auto effect =
                          r.reader_.step<reader::AckNackDue>(s.reader.state, {}, fire);
                      const Expr sends = effect.asks(&ReaderStep::Output::send_acknack);
                      s.reader.state = effect.next;
                      const Expr& received = s.reader.received;
                      out.add(acknack_listing, sends && !received && s.announced);
                      out.add(acknack_unannounced, sends && !received && !s.announced);
                      out.add(acknack_clean, sends && received);
                    });
  }

  EventInstance initial_attempt(const std::string&, const Exprs& flat) const {
    const State now = State::from(flat);
    return instance({}, InitialStep::is<initial::Waiting>(now.initial), constant(true),
                    [](const Rules& r, State& s, Outputs& out) {
                      InitialStep::Input input;
                      input.heartbeat_seen = SymbolicBool{s.reader.heartbeat_seen};
                      const auto due =
                          r.initial_.step<initial::AttemptDue>(s.initial, input, constant(true));
                      s.initial = due.next;
                      out.add(initial_scheduled, due.asks(&InitialStep::Output::schedule));
                      const auto sent = r.reader_.step<reader::InitialAckNackDue>(
                          s.reader.state, {}, due.asks(&InitialStep::Output::attempt));
                      s.reader.state = sent.next;
                      out.add(initial_sent, sent.asks(&ReaderStep::Output::send_initial));
                    });
  }

  EventInstance creation(const std::string& p, const Exprs& flat) const {
    const Expr it = truth(p + "creates_it");
    const State now = State::from(flat);
    const Expr possible = z3::implies(it, Writer::is<change::Absent>(now.writer));
    return instance({it}, possible, constant(true), [=](const Rules& r, State& s, Outputs& out) {
      s.others_created = s.others_created || !it;
      s.writer = r.writer_.step<change::Created>(s.writer, {}, it).next;
      // The descriptor, or another one, is serialized at once.
      r.serialize(s, out, it);
      r.serialized_something(s, out, constant(true));
    });
  }

  EventInstance nack_response(const std::string&, const Exprs& flat) const {
    const State now = State::from(flat);
    return instance(
        {}, Shot::is<shot::Pending>(now.nack), constant(true),
        [](const Rules& r, State& s, Outputs& out) {
          const Expr fire = r.fires(s.nack);
          const auto effect = r.writer_.step<change::NackResponseDue>(s.writer, {}, fire);
          s.writer = effect.next;
          s.enqueued = s.enqueued || effect.asks(&Writer::Output::enqueue);
          r.request(s.async, out, async_run_scheduled, fire && (s.enqueued || s.others_enqueued));
        });
  }

  EventInstance async_run(const std::string& p, const Exprs& flat) const {
    const Expr serves = truth(p + "serves_another_of_this_relation");
    const State now = State::from(flat);
    return instance({serves}, Shot::is<shot::Pending>(now.async), constant(true),
                    [=](const Rules& r, State& s, Outputs& out) {
                      const Expr fire = r.fires(s.async);
                      const Expr own = fire && s.enqueued && Writer::is<change::Q>(s.writer);
                      r.serialize(s, out, own);
                      r.serialized_something(s, out, own || (fire && s.others_enqueued && serves));
                      s.enqueued = s.enqueued && !fire;
                      s.others_enqueued = s.others_enqueued && !fire;
                    });
  }

  EventInstance suppression_end(const std::string&, const Exprs& flat) const {
    const State now = State::from(flat);
    return instance({}, Shot::is<shot::Pending>(now.suppression), constant(true),
                    [](const Rules& r, State& s, Outputs& out) {
                      const Expr fire = r.fires(s.suppression);
                      s.writer = r.writer_.step<change::SuppressionEnded>(s.writer, {}, fire).next;
                      r.arm(s, out, fire);
                    });
  }

  EventInstance expiry(const std::string&, const Exprs& flat) const {
    const State now = State::from(flat);
    return instance(
        {}, now.timer.pending >= 1, constant(true), [](const Rules& r, State& s, Outputs& out) {
          s.timer.pending = s.timer.pending - 1;
          const Expr created = s.others_created || !Writer::is<change::Absent>(s.writer);
          const Expr needed =
              (created && s.low_is_zero) || Writer::is<change::U>(s.writer) || r.others_waiting_;
          const auto effect =
              s.timer.step<timer::Expired>(r.timer_, constant(false), needed, constant(true));
          out.add(heartbeat, effect.asks(&TimerStep::Output::send));
          out.add(expiry_scheduled, effect.asks(&TimerStep::Output::schedule_expiry));
        });
  }

  [[nodiscard]] Expr consistent(const State& s) const {
    const Expr exists = !Writer::is<change::Absent>(s.writer);
    return s.reader.consistent() && s.timer.consistent() && s.timer.pending <= 1 &&
           z3::implies(s.reader.received, s.announced) && z3::implies(s.announced, exists) &&
           z3::implies(Writer::is<change::A>(s.writer), s.reader.received) &&
           z3::implies(Writer::is<change::R>(s.writer), Shot::is<shot::Pending>(s.nack)) &&
           z3::implies(Writer::is<change::Q>(s.writer), s.enqueued) &&
           z3::implies(Writer::is<change::S>(s.writer), Shot::is<shot::Pending>(s.suppression)) &&
           (s.enqueued || s.others_enqueued) == Shot::is<shot::Pending>(s.async);
  }

 private:
  /// A single-shot timer is due: whether what was asked for happens.
  Expr fires(OneHot& state) const {
    const auto effect = shot_.step<shot::Due>(state, {}, constant(true));
    state = effect.next;
    return effect.asks(&Shot::Output::fire);
  }
  void request(OneHot& state, Outputs& out, Output scheduled, const Expr& when) const {
    const auto effect = shot_.step<shot::Requested>(state, {}, when);
    state = effect.next;
    out.add(scheduled, effect.asks(&Shot::Output::schedule));
  }
  void arm(State& s, Outputs& out, const Expr& when) const {
    const auto effect =
        s.timer.step<timer::ArmRequested>(timer_, constant(false), constant(true), when);
    out.add(expiry_scheduled, effect.asks(&TimerStep::Output::schedule_expiry));
  }
  void take_heartbeat(State& s, Outputs& out, const Expr& when, const Expr& announces) const {
    const Expr taken = s.reader.take_heartbeat(reader_, constant(false), when);
    s.announced = s.announced || (taken && announces);
    request(s.reply, out, acknack_scheduled, taken);
  }
  void take_acknack(State& s, Outputs& out, const Expr& listed, const Expr& below,
                    const Expr& others, const Expr& based, const Expr& is_initial) const {
    const auto effect = writer_.step<change::AckNackReceived>(
        s.writer, {.listed = SymbolicBool{listed}, .below_base = SymbolicBool{below}}, !is_initial);
    const Expr requested = effect.asks(&Writer::Output::requested);
    s.writer = writer_.step<change::InitialAckNackReceived>(effect.next, {}, is_initial).next;
    s.low_is_zero = is_initial || (s.low_is_zero && !based);
    request(s.nack, out, nack_response_scheduled, requested);
    out.add(heartbeat, is_initial);
    arm(s, out, is_initial || (!requested && (listed || others)));
  }
  void serialize(State& s, Outputs& out, const Expr& when) const {
    const auto effect = writer_.step<change::Serialized>(s.writer, {}, when);
    s.writer = effect.next;
    out.add(data, when);
  }
  void serialized_something(State& s, Outputs& out, const Expr& when) const {
    request(s.suppression, out, suppression_scheduled, when);
    arm(s, out, when);
  }

  Writer writer_;
  ReaderStep reader_;
  InitialStep initial_;
  TimerStep timer_;
  Shot shot_;
  Expr others_waiting_ = truth("others_unacknowledged");
};

}  // namespace
}  // namespace fastdds

RelationModel fastdds_relation(Proof& proof) {
  using fastdds::Rules;
  using fastdds::Shot;
  using fastdds::State;
  using fastdds::Writer;
  const Rules rules{proof};
  const State s;
  const auto kind = [&](const char* name, bool repeats,
                        EventInstance (Rules::*make)(const std::string&, const Exprs&) const) {
    return EventKindModel{name, repeats, [rules, make](const std::string& p, const Exprs& flat) {
                            return (rules.*make)(p, flat);
                          }};
  };
  const Expr possible = exactly_one(s.writer) && s.reader.possible() && exactly_one(s.initial) &&
                        exactly_one(s.reply) && exactly_one(s.suppression) && exactly_one(s.nack) &&
                        exactly_one(s.async) && s.timer.possible();
  return {s.flat(),
          rules.knobs(),
          possible,
          rules.consistent(s),
          {"ACKNACKs scheduled", "ACKNACKs that list it", "ACKNACKs for which it is unannounced",
           "ACKNACKs after it was received", "initial ACKNACKs", "initial ACKNACKs scheduled",
           "nack responses scheduled", "async runs scheduled", "DATA with it",
           "suppression ends scheduled", "HEARTBEATs", "HEARTBEAT expiries scheduled"},
          {kind("DATA received", true, &Rules::data_received),
           kind("HEARTBEAT received", true, &Rules::heartbeat_received),
           kind("ACKNACK received", true, &Rules::acknack),
           kind("ACKNACK generation", false, &Rules::acknack_generation),
           kind("initial ACKNACK", false, &Rules::initial_attempt),
           kind("creation", true, &Rules::creation),
           kind("nack response", false, &Rules::nack_response),
           kind("async run", false, &Rules::async_run),
           kind("suppression end", false, &Rules::suppression_end),
           kind("HEARTBEAT expiry", false, &Rules::expiry)}};
}

}  // namespace stormproof::tables
