// safety.snapshot: an ACKNACK's bitmap never changes after generation. One generic descriptor and
// one generic ACKNACK: what it says of the descriptor while it is on its way, against what the
// reader's bitmap said when it was generated.
#include "checker/engines/tables/machine_step.hpp"
#include "checker/engines/tables/properties.hpp"
#include "checker/engines/tables/transition_system.hpp"
#include "fsm/discovery_reader.hpp"

namespace stormproof::tables {
namespace {

namespace reader = fsm::discovery_reader;
using Reader = MachineStep<fsm::DiscoveryReader>;
using smt::SymbolicBool;
using smt::SymbolicInt;

class SnapshotSystem {
 public:
  explicit SnapshotSystem(Proof& proof)
      : reader_{proof.mistakes().tables}, live_{proof.mistakes().live_bitmaps} {}

  TransitionSystem build() {
    add<reader::AnnouncementReceived>("announcement received");
    add<reader::DataReceived>("DATA received");
    add<reader::HeartbeatReceived>("HEARTBEAT received");
    add<reader::AckNackDue>("ACKNACK generation");
    add<reader::InitialAckNackDue>("initial ACKNACK");
    Exprs variables = state_;
    variables.insert(variables.end(), {received_, generated_, asks_, asked_at_generation_});
    const Expr initial =
        Reader::is_initial(state_) && !received_ && !generated_ && !asks_ && !asked_at_generation_;
    return {variables, initial, steps_, generated_ && asks_ != asked_at_generation_};
  }

 private:
  template <class Event>
  void add(const std::string& name) {
    const SymbolicBool accepts = SymbolicBool::named("accepts_unmatched");
    const SymbolicInt missing = SymbolicInt::named("missing_after");
    const Expr yes = smt::SymbolicContext::current().bool_val(true);
    const auto effect =
        reader_.step<Event>(state_, {.accepts_unmatched = accepts, .missing_after = missing}, yes);
    const Expr received = received_ || effect.asks(&Reader::Output::take_data);
    const Expr sends =
        effect.asks(&Reader::Output::send_acknack) || effect.asks(&Reader::Output::send_initial);
    const Expr taken = sends && !generated_;  // the one ACKNACK that is looked at
    const Expr on_its_way = live_ ? z3::ite(generated_, !received, asks_) : asks_;
    Exprs next = effect.next;
    next.insert(next.end(), {received, generated_ || taken, z3::ite(taken, !received_, on_its_way),
                             z3::ite(taken, !received_, asked_at_generation_)});
    steps_.push_back({name, {accepts.expr(), missing.expr()}, missing.expr() >= 0, next});
  }

  Reader reader_;
  bool live_;
  OneHot state_ = Reader::unknown_state("reader=");
  Expr received_ = SymbolicBool::named("received").expr();
  Expr generated_ = SymbolicBool::named("generated").expr();
  Expr asks_ = SymbolicBool::named("bitmap_lists_it").expr();
  Expr asked_at_generation_ = SymbolicBool::named("bitmap_listed_it_at_generation").expr();
  std::vector<SystemStep> steps_;
};

}  // namespace

Finding safety_snapshot(const CheckRequest& request) {
  Proof proof{"safety.snapshot", request};
  proof.assume(
      "A packet is a value: after its generation nothing writes to its bitmap, unless the "
      "rules themselves say so.");
  proof.assume("Any number of descriptors and ACKNACKs: one of each is looked at.");
  const TransitionSystem system = SnapshotSystem{proof}.build();
  return proof.finish(
      prove_unreachable(proof, system, "the bitmap of an ACKNACK has changed on its way"));
}

}  // namespace stormproof::tables
