// The steps of recognition, and what the two certificates make together.
#include "checker/engines/tables/no_stall.hpp"

#include "checker/engines/bounds/resting.hpp"
#include "checker/engines/tables/certificate.hpp"
#include "checker/engines/tables/completion_certificate.hpp"
#include "checker/engines/tables/derived.hpp"
#include "checker/engines/tables/descriptor_system.hpp"
#include "checker/engines/tables/houdini.hpp"
#include "checker/engines/tables/properties.hpp"
#include "model/composition_of.hpp"

namespace stormproof::tables {
namespace {

/// An announcement has been sent to the peer of our pair.
constexpr const char* announced = "announced";

/// All rules about one generic pair, one relation of it, and one descriptor.
class RecognisingPair {
 public:
  RecognisingPair(const model::DdsProfile& dds, const model::Mutation& mistakes)
      : derivation_{Unsound::none} {
    derivation_.declare(announced, false);
    derivation_.declare(raised_back("WriterOpens"), false);
    const Expr yes = smt::SymbolicContext::current().bool_val(true);
    Derived derived{dds, mistakes, derivation_};
    derived.happens = [](const std::string&, const Expr&) {};  // all rules
    derived.emitted = [this, yes](std::string_view packet, const Expr& when, const auto&) {
      if (packet == "SpdpMulticast") derivation_.assign(announced, when, yes);
    };
    derive(model::program_of_exchange(dds), derived);
  }

  [[nodiscard]] const Expr& operator[](const std::string& name) const {
    return derivation_.variable(name);
  }
  [[nodiscard]] bool has(const std::string& name) const { return derivation_.has(name); }
  [[nodiscard]] TransitionSystem whole() const { return derivation_.system(); }

 private:
  Derivation derivation_;
};

struct StallStatement {
  std::vector<Clause> invariant;
  std::vector<StepClause> on_steps;
};

StallStatement about(const RecognisingPair& is, const model::DdsProfile& dds) {
  StallStatement statement;
  const Expr yes = smt::SymbolicContext::current().bool_val(true);
  const auto always = [&](const char* words, const Expr& condition, const Expr& consequence) {
    statement.invariant.push_back({words, z3::implies(condition, consequence)});
  };
  const auto then = [&](const char* words, const char* step, const Expr& before,
                        const Expr& after) {
    statement.on_steps.push_back({words, step, before, after});
  };
  const Expr& recognised = is["Recognised"];
  then("an announcement goes to the other one, and the next one is pending", "AnnouncementIsDue",
       !is[announced], is[announced] && is["pending Announcement"]);
  for (const char* step : {"MulticastArrives", "UnicastArrives"}) {
    then("who hears an announcement recognises its source", step, yes, recognised);
  }
  always("whoever is recognised finds the reader's side opened", recognised,
         is["raised ReaderOpens"]);
  then("a reader's side that is opened is open", "ReaderOpened", yes,
       is["Reader=Recognised"] || is["Reader=Complete"]);
  if (model::rules_of(dds).relation_opening == model::RelationOpening::receiver) {
    always("and the writer's side", recognised, is["raised WriterOpens"]);
  } else {
    always("who recognises another one opens the writer's side towards it", recognised,
           is[raised_back("WriterOpens")]);
  }
  const bool creates = is.has("Exists");
  then("a writer's side that is opened is open", creates ? "ReaderIsMatched" : "WriterSideOpens",
       yes, is["WriterOpen"]);
  if (creates) {
    always("what exists and is open to a reader waits for it", is["WriterOpen"] && is["Exists"],
           !is["C=Absent"]);
  }
  return statement;
}

Certificate certificate_of(const RecognisingPair& pair, const StallStatement& statement) {
  TransitionSystem whole = pair.whole();
  Exprs seen;
  for (const Clause& clause : statement.invariant) seen.push_back(!clause.holds);
  z3::context& context = smt::SymbolicContext::current();
  const z3::func_decl looked_at =
      context.function("looked at", context.bool_sort(), context.bool_sort(), context.bool_sort());
  for (const StepClause& clause : statement.on_steps) {
    seen.push_back(looked_at(clause.before, clause.after));
  }
  whole.bad = any_of(seen);
  const Moving moving{whole};
  Certificate certificate{.system = what_matters(moving.system)};
  for (const Clause& clause : statement.invariant) {
    certificate.invariant.push_back({clause.words, moving(clause.holds)});
    certificate.conclusions.push_back(certificate.invariant.back());
  }
  for (const StepClause& clause : statement.on_steps) {
    certificate.on_steps.push_back(
        {clause.words, clause.step, moving(clause.before), moving(clause.after)});
  }
  certificate.candidates = facts_of(certificate.system);
  return certificate;
}

Finding decided(const CheckRequest& request) {
  Proof proof{"live.no-stall.recognition", request};
  proof.assume(
      "Of the announcements to one participant, which go on, some arrives; what a rule raises "
      "happens.");
  const RecognisingPair pair{proof.scenario().dds, proof.mistakes()};
  return proved(proof, certificate_of(pair, about(pair, proof.scenario().dds)),
                "invariant over the steps of all rules, any number of them");
}

}  // namespace

Finding recognition_certificate(const CheckRequest& request) {
  return checker::known(request, "live.no-stall.recognition", [&] { return decided(request); });
}

Finding live_no_stall(const CheckRequest& request) {
  return of_certificates(
      request, "certificates from the rules",
      request.mutant != nullptr ? "with mistakes, runs and the explorer say more"
                                : not_certified(request.scenario.dds),
      {"Participants that have started go on; with what starts the first announcement is due.",
       "Δ and σ are any numbers: those of the packets until now, and of those that follow.",
       "In no instant do infinitely many events happen, so time goes on.",
       "What opens the writer's side here when the other one is recognised does so there, too: the "
       "rules are the same for all."},
      [&] {
        return std::vector{recognition_certificate(request), completion_certificate(request)};
      });
}

}  // namespace stormproof::tables
