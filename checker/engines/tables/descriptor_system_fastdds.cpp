// The descriptor of Fast DDS's writer. The contents of an ACKNACK, as far as one descriptor sees
// it: the bitmap lists it, or it lies below the base (and so has been received), or neither.
// Initial ACKNACKs carry nothing. DATA is due to a request, or a push when the descriptor is
// created.
#include <optional>

#include "checker/engines/tables/descriptor_system.hpp"
#include "checker/engines/tables/machine_step.hpp"
#include "fsm/change_for_reader.hpp"

namespace stormproof::tables {
namespace {

namespace change = fsm::change_for_reader;
using ChangeStep = MachineStep<fsm::ChangeForReader>;
using smt::SymbolicBool;

class FastDdsSystem {
 public:
  explicit FastDdsSystem(Proof& proof)
      : writer_{proof.mistakes().tables}, live_{proof.mistakes().live_bitmaps} {}

  DescriptorSystem build() {
    add("DATA received", {}, yes(), {.received = yes()});
    add_generation();
    add_reception();
    add_writer_event<change::ReaderMatched>("reader matched", yes());
    add_creation();
    add_writer_event<change::InitialAckNackReceived>("initial ACKNACK received", yes());
    add_writer_event<change::NackResponseDue>("nack response", yes());
    add_writer_event<change::Serialized>("serialized", ChangeStep::is<change::Q>(state_));
    add_writer_event<change::SuppressionEnded>("suppression ends", yes());
    const Exprs false_at_first{received_, listing_, below_, asked_, pushed_, unasked_repair_};
    const Expr initial = ChangeStep::is_initial(state_) && !any_of(false_at_first);
    return {{variables(), initial, steps_, yes()},
            ChangeStep::is<change::A>(state_),
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
    std::optional<Expr> asked = std::nullopt;
    std::optional<Expr> pushed = std::nullopt;
    std::optional<Expr> unasked_repair = std::nullopt;
  };

  static Expr yes() { return smt::SymbolicContext::current().bool_val(true); }

  [[nodiscard]] Exprs variables() const {
    Exprs all = state_;
    all.insert(all.end(), {received_, listing_, below_, asked_, pushed_, unasked_repair_});
    return all;
  }

  void add(const std::string& name, Exprs inputs, const Expr& guard, const Change& to) {
    Exprs next = to.state.value_or(state_);
    next.insert(next.end(),
                {to.received.value_or(received_), to.listing.value_or(listing_),
                 to.below.value_or(below_), to.asked.value_or(asked_), to.pushed.value_or(pushed_),
                 to.unasked_repair.value_or(unasked_repair_)});
    steps_.push_back({name, std::move(inputs), guard, std::move(next)});
  }

  void add_generation() {
    const Expr announced = SymbolicBool::named("announced").expr();
    const Expr below = SymbolicBool::named("below_base").expr();
    add("ACKNACK generated", {announced, below}, yes(),
        {.listing = listing_ || (!received_ && announced),
         .below = below_ || (received_ && below)});
  }

  void add_reception() {
    const SymbolicBool listed = SymbolicBool::named("listed");
    const SymbolicBool below = SymbolicBool::named("below_base");
    const Expr sent =
        (listing_ && listed.expr() && !below.expr()) || (below_ && !listed.expr() && below.expr());
    const Expr live = (listing_ || below_) && !(listed.expr() && received_) &&
                      z3::implies(below.expr(), received_);
    const auto effect = writer_.step<change::AckNackReceived>(
        state_, {.listed = listed, .below_base = below}, yes());
    add("ACKNACK received", {listed.expr(), below.expr()}, live_ ? live : sent,
        {.state = effect.next, .asked = asked_ || listed.expr()});
  }

  void add_creation() {
    const auto effect = writer_.step<change::Created>(state_, {}, yes());
    add("descriptor created", {}, yes(),
        {.state = effect.next, .pushed = pushed_ || effect.fires()});
  }

  template <class Event>
  void add_writer_event(const std::string& name, const Expr& guard) {
    const auto effect = writer_.step<Event>(state_, {}, yes());
    Expr unasked = effect.asks(&ChangeStep::Output::enqueue) && !asked_;
    if constexpr (std::is_same_v<Event, change::Serialized>) {
      unasked = effect.fires() && !asked_ && !pushed_;
    }
    add(name, {}, guard, {.state = effect.next, .unasked_repair = unasked_repair_ || unasked});
  }

  ChangeStep writer_;
  bool live_;
  OneHot state_ = ChangeStep::unknown_state("C=");
  Expr received_ = SymbolicBool::named("received").expr();
  Expr listing_ = SymbolicBool::named("listing_acknack_sent").expr();
  Expr below_ = SymbolicBool::named("confirming_acknack_sent").expr();
  Expr asked_ = SymbolicBool::named("listing_acknack_arrived").expr();
  Expr pushed_ = SymbolicBool::named("pushed_at_creation").expr();
  Expr unasked_repair_ = SymbolicBool::named("unasked_repair").expr();
  std::vector<SystemStep> steps_;
};

}  // namespace

DescriptorSystem fastdds_descriptor_system(Proof& proof) { return FastDdsSystem{proof}.build(); }

}  // namespace stormproof::tables
