// One relation of the paper's model as order.commutation sees it: the writer's state of one generic
// descriptor, the reader's bit, the reader machine, the initial ACKNACK timer and the writer's
// HEARTBEAT timer, all stepped by their tables. Whatever the relation asks for as a whole ("at
// least one descriptor was requested") is a disjunction over its descriptors; if two orders differ
// in such a disjunction they differ for one descriptor, so one generic descriptor is enough for any
// number.
#include "checker/engines/tables/relation_parts.hpp"
#include "fsm/descriptor_repair.hpp"

namespace stormproof::tables {
namespace {

namespace repair = fsm::descriptor_repair;
namespace reader = fsm::discovery_reader;
namespace initial = fsm::initial_acknack;
namespace timer = fsm::heartbeat_timer;
using Writer = MachineStep<fsm::DescriptorRepair>;
using smt::SymbolicBool;

struct State {
  OneHot writer = Writer::unknown_state("C=");
  ReaderPart reader = ReaderPart::unknown();
  OneHot initial = InitialStep::unknown_state("initial_timer=");
  TimerPart timer = TimerPart::unknown();

  [[nodiscard]] Exprs flat() const {
    Exprs all = writer;
    append(all, reader.state);
    append(all, {reader.received, reader.others_missing, reader.heartbeat_seen});
    append(all, initial);
    append(all, timer.state);
    append(all, {timer.pending});
    return all;
  }
  static State from(const Exprs& flat) {
    Reading reading{flat};
    State state;
    state.writer = reading.many(Writer::states);
    state.reader.state = reading.many(ReaderStep::states);
    state.reader.received = reading.one();
    state.reader.others_missing = reading.one();
    state.reader.heartbeat_seen = reading.one();
    state.initial = reading.many(InitialStep::states);
    state.timer.state = reading.many(TimerStep::states);
    state.timer.pending = reading.one();
    return state;
  }
};

enum Output : std::size_t {
  acknack_scheduled,
  acknack_listing,
  acknack_clean,
  initial_listing,
  initial_clean,
  initial_scheduled,
  repair_scheduled,
  repair_generated,
  suppression_scheduled,
  heartbeat,
  expiry_scheduled,
  output_kinds
};

/// The tables and the knobs; what each kind of event does.
class Rules {
 public:
  explicit Rules(Proof& proof)
      : writer_{proof.mistakes().tables},
        reader_{proof.mistakes().tables},
        initial_{proof.mistakes().tables},
        timer_{proof.mistakes().tables} {}

  [[nodiscard]] Exprs knobs() const {
    return {accepts_,           prefix_,     additive_,       answers_bitmap_,
            answers_heartbeat_, to_matched_, others_waiting_, other_relations_waiting_};
  }

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

  EventInstance data(const std::string& p, const Exprs&) const {
    const Expr carries = truth(p + "carries_it");
    const Expr completes = truth(p + "completes_others");
    const Expr beat = truth(p + "carries_heartbeat");
    return instance({carries, completes, beat}, constant(true), constant(true),
                    [=](const Rules& r, State& s, Outputs& out) {
                      s.reader.take_data(r.reader_, r.accepts_, carries, completes);
                      out.add(acknack_scheduled,
                              s.reader.take_heartbeat(r.reader_, r.accepts_, beat));
                    });
  }

  EventInstance heartbeat_received(const std::string&, const Exprs&) const {
    return instance({}, constant(true), constant(true), [](const Rules& r, State& s, Outputs& out) {
      out.add(acknack_scheduled, s.reader.take_heartbeat(r.reader_, r.accepts_, constant(true)));
    });
  }

  EventInstance acknack(const std::string& p, const Exprs& flat) const {
    const Expr listed = truth(p + "listed");
    const Expr below = truth(p + "below_first_missing");
    const Expr is_initial = truth(p + "initial");
    const State now = State::from(flat);
    // What an ACKNACK does not list its reader had received before.
    return instance({listed, below, is_initial}, !(listed && below), listed || now.reader.received,
                    [=](const Rules& r, State& s, Outputs& out) {
                      const Expr ordinary = !is_initial || r.answers_bitmap_;
                      out.add(heartbeat, !ordinary && r.answers_heartbeat_);
                      const auto effect = r.writer_.step<repair::AckNackReceived>(
                          s.writer,
                          {.listed = SymbolicBool{listed},
                           .below_first_missing = SymbolicBool{below},
                           .prefix_only = SymbolicBool{r.prefix_}},
                          ordinary);
                      s.writer = effect.next;
                      out.add(repair_scheduled, effect.asks(&Writer::Output::requested));
                    });
  }

  EventInstance acknack_generation(const std::string&, const Exprs&) const {
    return instance({}, constant(true), constant(true), [](const Rules& r, State& s, Outputs& out) {
      const auto effect = r.reader_.step<reader::AckNackDue>(s.reader.state, {}, constant(true));
      const Expr sends = effect.asks(&ReaderStep::Output::send_acknack);
      s.reader.state = effect.next;
      out.add(acknack_listing, sends && !s.reader.received);
      out.add(acknack_clean, sends && s.reader.received);
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
                      const Expr sends = sent.asks(&ReaderStep::Output::send_initial);
                      s.reader.state = sent.next;
                      out.add(initial_listing, sends && !s.reader.received);
                      out.add(initial_clean, sends && s.reader.received);
                    });
  }

  EventInstance repair_generation(const std::string&, const Exprs&) const {
    return instance({}, constant(true), constant(true), [](const Rules& r, State& s, Outputs& out) {
      const auto effect = r.writer_.step<repair::RepairDue>(s.writer, {}, constant(true));
      s.writer = effect.next;
      out.add(repair_generated, effect.asks(&Writer::Output::generate));
    });
  }

  EventInstance source_completion(const std::string& p, const Exprs& flat) const {
    const Expr carries = truth(p + "carries_it");
    const State now = State::from(flat);
    // A descriptor in a repair packet that is on its way is in Q, or acknowledged meanwhile.
    const Expr consistent =
        !carries || Writer::is<repair::Q>(now.writer) || Writer::is<repair::A>(now.writer);
    return instance({carries}, constant(true), consistent,
                    [=](const Rules& r, State& s, Outputs& out) {
                      const auto effect = r.writer_.step<repair::RepairSent>(s.writer, {}, carries);
                      s.writer = effect.next;
                      out.add(suppression_scheduled, constant(true));
                    });
  }

  EventInstance suppression_end(const std::string&, const Exprs&) const {
    return instance({}, constant(true), constant(true), [](const Rules& r, State& s, Outputs& out) {
      const auto effect = r.writer_.step<repair::SuppressionEnded>(s.writer, {}, constant(true));
      s.writer = effect.next;
      const auto armed = s.timer.step<timer::SuppressionEnded>(
          r.timer_, r.additive_, constant(true), effect.asks(&Writer::Output::returned));
      out.add(expiry_scheduled, armed.asks(&TimerStep::Output::schedule_expiry));
    });
  }

  EventInstance expiry(const std::string&, const Exprs& flat) const {
    const State now = State::from(flat);
    return instance(
        {}, now.timer.pending >= 1, constant(true), [](const Rules& r, State& s, Outputs& out) {
          s.timer.pending = s.timer.pending - 1;
          const Expr waiting = !Writer::is<repair::A>(s.writer) || r.others_waiting_;
          const auto effect = s.timer.step<timer::Expired>(
              r.timer_, r.additive_, waiting || r.other_relations_waiting_, constant(true));
          out.add(heartbeat, effect.asks(&TimerStep::Output::send) && (r.to_matched_ || waiting));
          out.add(expiry_scheduled, effect.asks(&TimerStep::Output::schedule_expiry));
        });
  }

  /// What is known of the states of runs.
  [[nodiscard]] Expr consistent(const State& s) const {
    const Expr acknowledged = Writer::is<repair::A>(s.writer);
    const Expr all_done = acknowledged && !others_waiting_ && !other_relations_waiting_;
    return s.reader.consistent() && s.timer.consistent() &&
           z3::implies(!additive_, s.timer.pending <= 1) &&
           z3::implies(TimerStep::is<timer::Idle>(s.timer.state), all_done) &&
           z3::implies(acknowledged, s.reader.received);
  }

 private:
  Writer writer_;
  ReaderStep reader_;
  InitialStep initial_;
  TimerStep timer_;
  Expr accepts_ = truth("accepts_unmatched");
  Expr prefix_ = truth("acknowledge_prefix");
  Expr additive_ = truth("additive_timer");
  Expr answers_bitmap_ = truth("initial_acknack_bitmap");
  Expr answers_heartbeat_ = truth("initial_acknack_heartbeat");
  Expr to_matched_ = truth("heartbeat_to_matched");
  Expr others_waiting_ = truth("others_unacknowledged");
  Expr other_relations_waiting_ = truth("other_relations_unacknowledged");
};

}  // namespace

RelationModel paper_relation(Proof& proof) {
  const Rules rules{proof};
  const State state;
  const auto kind = [&](const char* name, bool repeats,
                        EventInstance (Rules::*make)(const std::string&, const Exprs&) const) {
    return EventKindModel{name, repeats, [rules, make](const std::string& p, const Exprs& flat) {
                            return (rules.*make)(p, flat);
                          }};
  };
  const Expr possible = exactly_one(state.writer) && state.reader.possible() &&
                        exactly_one(state.initial) && state.timer.possible();
  return {state.flat(),
          rules.knobs(),
          possible,
          rules.consistent(state),
          {"ACKNACKs scheduled", "ACKNACKs that list it", "ACKNACKs that do not list it",
           "initial ACKNACKs that list it", "initial ACKNACKs that do not list it",
           "initial ACKNACKs scheduled", "repair generations scheduled", "repairs generated",
           "suppression ends scheduled", "HEARTBEATs", "HEARTBEAT expiries scheduled"},
          {kind("DATA received", true, &Rules::data),
           kind("HEARTBEAT received", true, &Rules::heartbeat_received),
           kind("ACKNACK received", true, &Rules::acknack),
           kind("ACKNACK generation", true, &Rules::acknack_generation),
           kind("initial ACKNACK", false, &Rules::initial_attempt),
           kind("repair generation", true, &Rules::repair_generation),
           kind("source completion", true, &Rules::source_completion),
           kind("suppression end", true, &Rules::suppression_end),
           kind("HEARTBEAT expiry", true, &Rules::expiry)}};
}

}  // namespace stormproof::tables
