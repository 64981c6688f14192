// The descriptor of the paper's writer. The contents of an ACKNACK, as far as one descriptor sees
// it: the descriptor is listed, or it is not and lies below the first listed one, or above it.
#include <optional>

#include "checker/engines/tables/descriptor_system.hpp"
#include "checker/engines/tables/machine_step.hpp"
#include "fsm/descriptor_repair.hpp"

namespace stormproof::tables {
namespace {

namespace repair = fsm::descriptor_repair;
using Writer = MachineStep<fsm::DescriptorRepair>;
using smt::SymbolicBool;

class PaperSystem {
 public:
  explicit PaperSystem(Proof& proof)
      : writer_{proof.mistakes().tables},
        live_{proof.mistakes().live_bitmaps},
        prefix_only_{proof.scenario().dds.sedp.acknowledge == model::Acknowledge::prefix} {}

  DescriptorSystem build() {
    add("DATA received", {}, yes(), {.received = yes()});
    add_generation();
    add_reception();
    add_writer_event<repair::RepairDue>("repair generation");
    add_writer_event<repair::RepairSent>("repair has left the source");
    add_writer_event<repair::SuppressionEnded>("suppression ends");
    const Exprs false_at_first{received_, listing_, below_, above_, asked_, unasked_repair_};
    const Expr initial = Writer::is_initial(state_) && !any_of(false_at_first);
    return {{variables(), initial, steps_, yes()},
            Writer::is<repair::A>(state_),
            received_,
            unasked_repair_};
  }

 private:
  /// New values; what is not named keeps its value.
  struct Change {
    std::optional<OneHot> state = std::nullopt;
    std::optional<Expr> received = std::nullopt;
    std::optional<Expr> listing = std::nullopt;
    std::optional<Expr> below = std::nullopt;
    std::optional<Expr> above = std::nullopt;
    std::optional<Expr> asked = std::nullopt;
    std::optional<Expr> unasked_repair = std::nullopt;
  };

  static Expr yes() { return smt::SymbolicContext::current().bool_val(true); }

  [[nodiscard]] Exprs variables() const {
    Exprs all = state_;
    all.insert(all.end(), {received_, listing_, below_, above_, asked_, unasked_repair_});
    return all;
  }

  void add(const std::string& name, Exprs inputs, const Expr& guard, const Change& change) {
    Exprs next = change.state.value_or(state_);
    next.insert(next.end(),
                {change.received.value_or(received_), change.listing.value_or(listing_),
                 change.below.value_or(below_), change.above.value_or(above_),
                 change.asked.value_or(asked_), change.unasked_repair.value_or(unasked_repair_)});
    steps_.push_back({name, std::move(inputs), guard, std::move(next)});
  }

  void add_generation() {
    const Expr below = SymbolicBool::named("below_first_missing").expr();
    add("ACKNACK generated", {below}, yes(),
        {.listing = listing_ || !received_,
         .below = below_ || (received_ && below),
         .above = above_ || (received_ && !below)});
  }

  void add_reception() {
    const SymbolicBool listed = SymbolicBool::named("listed");
    const SymbolicBool below = SymbolicBool::named("below_first_missing");
    const Expr sent = (listing_ && listed.expr() && !below.expr()) ||
                      (below_ && !listed.expr() && below.expr()) ||
                      (above_ && !listed.expr() && !below.expr());
    const Expr live = (listing_ || below_ || above_) && listed.expr() == !received_ &&
                      !(listed.expr() && below.expr());
    const auto effect = writer_.step<repair::AckNackReceived>(
        state_,
        {.listed = listed, .below_first_missing = below, .prefix_only = SymbolicBool{prefix_only_}},
        yes());
    add("ACKNACK received", {listed.expr(), below.expr()}, live_ ? live : sent,
        {.state = effect.next, .asked = asked_ || listed.expr()});
  }

  template <class Event>
  void add_writer_event(const std::string& name) {
    const auto effect = writer_.step<Event>(state_, {}, yes());
    const Expr generated = effect.asks(&Writer::Output::generate);
    add(name, {}, yes(),
        {.state = effect.next, .unasked_repair = unasked_repair_ || (generated && !asked_)});
  }

  Writer writer_;
  bool live_;
  bool prefix_only_;
  OneHot state_ = Writer::unknown_state("C=");
  Expr received_ = SymbolicBool::named("received").expr();
  Expr listing_ = SymbolicBool::named("listing_acknack_sent").expr();
  Expr below_ = SymbolicBool::named("confirming_acknack_sent").expr();
  Expr above_ = SymbolicBool::named("confirming_acknack_with_gap_sent").expr();
  Expr asked_ = SymbolicBool::named("listing_acknack_arrived").expr();
  Expr unasked_repair_ = SymbolicBool::named("unasked_repair").expr();
  std::vector<SystemStep> steps_;
};

}  // namespace

DescriptorSystem paper_descriptor_system(Proof& proof) { return PaperSystem{proof}.build(); }

}  // namespace stormproof::tables
