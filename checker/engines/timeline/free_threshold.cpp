// One exchange is enough to decide whether a repair is possible: until the first repair, an ACKNACK
// lists a descriptor exactly if the one DATA that carries it has not arrived. So each part asks
// whether a single ACKNACK can request the descriptor, whatever HEARTBEAT has caused it.
#include "checker/engines/timeline/free_threshold.hpp"

#include <algorithm>

namespace stormproof::timeline {
namespace {

/// All that the network decides about the packets of one part.
struct FreeDelays {
  Int data;
  Int heartbeat;
  Int acknack;
  Int sent;    ///< when the HEARTBEAT is sent, or the second ACKNACK generated
  Int leaves;  ///< how long the DATA needs to leave its source

  [[nodiscard]] z3::expr_vector unknowns(z3::context& context) const {
    z3::expr_vector all{context};
    for (const Int* unknown : {&data, &heartbeat, &acknack, &sent, &leaves}) {
      all.push_back(unknown->expr());
    }
    return all;
  }
  [[nodiscard]] Bool admitted(const Int& delta) const {
    Bool all = sent >= 0;
    for (const Int* delay : {&data, &heartbeat, &acknack, &leaves}) {
      all = all && *delay >= 0 && *delay <= delta;
    }
    return all;
  }
};

struct Profile {
  Int delta;
  Timers<Sym> timers;
  Int initial;  ///< τ_I
};

using Possible = Bool (*)(const Profile&, const FreeDelays&);

Descriptor<Sym> pushed(const FreeDelays& delays) {
  Descriptor<Sym> d;
  deliver<Sym>(d, 0, {delays.data, delays.leaves, false}, true);
  return d;
}

Bool by_heartbeat(const Profile& p, const FreeDelays& n) {
  Descriptor<Sym> d = pushed(n);
  const auto report = answer<Sym>(n.sent, {n.heartbeat, 0, false}, {n.acknack, 0, false}, p.timers);
  return acknack<Sym>(d, report, {}, p.timers).requested;
}

Bool by_initial(const Profile& p, const FreeDelays& n) {
  Descriptor<Sym> d = pushed(n);
  const Report<Sym> report{p.initial, p.initial + n.acknack, false};
  const Bool unseen = n.heartbeat > p.initial;  // the HEARTBEAT of the opening, sent at 0
  return p.initial > 0 && unseen && acknack<Sym>(d, report, {}, p.timers).requested;
}

Bool by_heartbeat_in_order(const Profile& p, const FreeDelays& n) {
  return n.sent + n.heartbeat >= n.data && by_heartbeat(p, n);
}

/// Everything takes Δ: the answer to the HEARTBEAT of the opening is the first that finds the DATA
/// received; if it arrives in time it takes the request back.
Bool by_initial_constant(const Profile& p, const FreeDelays&) {
  Descriptor<Sym> d;
  const Passage<Sym> passage{p.delta, 0, false};
  deliver<Sym>(d, 0, passage, true);
  acknack<Sym>(d, {p.initial, p.initial + p.delta, false}, passage, p.timers);
  acknack<Sym>(d, answer<Sym>(0, passage, passage, p.timers), passage, p.timers);
  generate<Sym>(d, true);
  return p.initial > 0 && p.initial < p.delta && d.repairs > 0;
}

/// The first request at 0; it is answered, and another ACKNACK requests the descriptor again.
Bool by_second_request(const Profile& p, const FreeDelays& n) {
  Descriptor<Sym> d;
  acknack<Sym>(d, {0, 0, false}, {n.data, n.leaves, false}, p.timers);
  generate<Sym>(d, true);
  const Report<Sym> report{n.sent, n.sent + n.acknack, false};
  return acknack<Sym>(d, report, {}, p.timers).requested;
}

Bool by_heartbeat_fastdds(const Profile& p, const FreeDelays& n) {
  Descriptor<Sym> d = pushed(n);
  d.asked = true;
  d.busy_until = p.timers.suppression;
  const auto report = answer<Sym>(n.sent, {n.heartbeat, 0, false}, {n.acknack, 0, false}, p.timers);
  return acknack<Sym>(d, report, {}, p.timers).requested;
}

struct Part {
  RepairCause cause;
  const char* name;
  const char* simplified;
  Possible possible;
  Bool condition;      ///< claimed to be equivalent to: some delays make it possible
  FreeDelays example;  ///< delays that make it possible if the condition holds
};

std::string in_one_line(std::string text) {
  std::string line;
  for (const char c : text) {
    const char plain = c == '\n' ? ' ' : c;
    if (plain != ' ' || line.empty() || line.back() != ' ') line += plain;
  }
  return line;
}

z3::expr eliminate(const z3::expr& formula) {
  z3::context& context = formula.ctx();
  z3::goal goal{context};
  goal.add(formula);
  const z3::tactic tactic = z3::tactic{context, "qe2"} & z3::tactic{context, "ctx-solver-simplify"};
  const z3::apply_result result = tactic(goal);
  if (result.size() == 1) return result[0].as_expr();
  z3::expr_vector parts{context};
  for (unsigned k = 0; k < result.size(); ++k)
    parts.push_back(result[static_cast<int>(k)].as_expr());
  return z3::mk_or(parts);
}

EliminatedCondition decide(Theorem& t, const Profile& p, const Part& part) {
  const std::string name = part.name;
  const FreeDelays free{t.number("data_delay"), t.number("heartbeat_delay"),
                        t.number("acknack_delay"), t.number("sent"), t.number("leaves")};
  t.holds(name + ": only under the condition",
          implies(free.admitted(p.delta) && part.possible(p, free), part.condition));
  t.holds(
      name + ": always under the condition",
      implies(part.condition, part.example.admitted(p.delta) && part.possible(p, part.example)));
  EliminatedCondition found{part.cause, {}, part.simplified};
  try {
    const Bool some = free.admitted(p.delta) && part.possible(p, free);
    const z3::expr eliminated =
        eliminate(t.assumptions() && z3::exists(free.unknowns(t.context()), some.expr()));
    t.holds(name + ": the eliminated formula says the same", Bool{eliminated} == part.condition);
    found.eliminated = in_one_line(eliminated.to_string());
  } catch (const z3::exception& error) {
    t.give_up(name + ": quantifier elimination: " + error.msg());
  }
  return found;
}

}  // namespace

std::vector<EliminatedCondition> prove_free_threshold(Theorem& theorem,
                                                      const ThresholdShift& shift) {
  const Profile p{
      theorem.at_least("delta", 0),
      {theorem.at_least("tau_A", 0), theorem.at_least("tau_N", 0), theorem.at_least("tau_S", 0)},
      theorem.at_least("tau_I", 0)};
  const Int delta = p.delta + shift.nanoseconds;
  const Int suppressed = p.timers.suppression + 2;
  const Int before = p.delta - 1;  // the last instant at which DATA that takes Δ is missing
  const std::vector<Part> parts{
      {RepairCause::heartbeat,
       "an ACKNACK to a HEARTBEAT",
       "Δ > τ_A",
       by_heartbeat,
       delta > p.timers.response,
       {p.delta, 0, 0, 0, 0}},
      {RepairCause::initial_acknack,
       "an initial ACKNACK",
       "0 < τ_I < Δ",
       by_initial,
       p.initial > 0 && delta > p.initial,
       {p.delta, p.delta, 0, 0, 0}},
      {RepairCause::in_order,
       "no HEARTBEAT overtakes the DATA",
       "false",
       by_heartbeat_in_order,
       delta < shift.nanoseconds,
       {p.delta, p.delta, 0, 0, 0}},
      {RepairCause::constant_delay,
       "an initial ACKNACK, constant delay",
       "0 < τ_I < Δ ∧ τ_I + τ_N < Δ + τ_A",
       by_initial_constant,
       p.initial > 0 && delta > p.initial &&
           p.initial + p.timers.nack < p.delta + p.timers.response,
       {0, 0, 0, 0, 0}},
      {RepairCause::second_request,
       "a second request",
       "2Δ ≥ τ_S + 2",
       by_second_request,
       delta + p.delta >= suppressed,
       {p.delta, 0, p.delta, before + p.timers.nack, 0}},
      {RepairCause::fastdds_heartbeat,
       "an ACKNACK to a HEARTBEAT, Fast DDS",
       "Δ > τ_A ∧ 2Δ ≥ τ_S + 2",
       by_heartbeat_fastdds,
       delta > p.timers.response && p.delta + p.delta >= suppressed,
       {p.delta, 0, p.delta, before - p.timers.response, 0}},
  };
  std::vector<EliminatedCondition> found;
  for (const Part& part : parts) found.push_back(decide(theorem, p, part));
  return found;
}

FreeThreshold free_threshold(const model::SedpProfile& sedp, bool constant_delay) {
  const bool asks = sedp.initial_acknack == model::InitialAckNackReply::bitmap &&
                    sedp.initial_acknack_delay > model::Nanoseconds{0};
  if (sedp.initial_data == model::InitialData::pull) {
    // Δ ≤ (τ_S + 1)/2 is enough for a relation whose DATA is one packet; with several, one packet's
    // suppression end sets the descriptors of another free.
    return {false, false, {}, "none that holds for several packets"};
  }
  // A side that opens alone drops DATA, or asks for it before the other side has opened: its
  // initial ACKNACK can arrive just after the DATA has left.
  if (sedp.relation_opening == model::RelationOpening::each_side &&
      (sedp.unmatched == model::Unmatched::drop || asks)) {
    return {false, false, {}, "none"};
  }
  if (constant_delay) {
    if (!asks) return {true, true, {}, "unlimited"};
    const model::Nanoseconds longer = sedp.nack_response_delay - sedp.heartbeat_response_delay;
    return {true, false, sedp.initial_acknack_delay + std::max(model::Nanoseconds{0}, longer),
            "τ_I + max(0, τ_N − τ_A)"};
  }
  if (!asks) return {true, false, sedp.heartbeat_response_delay, "τ_A"};
  return {true, false, std::min(sedp.heartbeat_response_delay, sedp.initial_acknack_delay),
          "min(τ_A, τ_I)"};
}

}  // namespace stormproof::timeline
