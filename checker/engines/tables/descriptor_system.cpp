// Which of the compositions, what is watched, and what every proof about it assumes.
#include "checker/engines/tables/descriptor_system.hpp"

#include <map>

#include "checker/engines/tables/derived.hpp"
#include "checker/engines/tables/proof.hpp"
#include "model/composition_of.hpp"
#include "model/implementations.hpp"

namespace stormproof::tables {

DescriptorSystem::DescriptorSystem(const model::DdsProfile& dds, const model::Mutation& mistakes,
                                   Unsound unsound)
    : DescriptorSystem{model::program_of_exchange(dds), dds, mistakes, unsound} {}

DescriptorSystem::DescriptorSystem(const fsm::program::Program& program,
                                   const model::DdsProfile& dds, const model::Mutation& mistakes,
                                   Unsound unsound)
    : derivation_{unsound} {
  Derivation& system = derivation_;
  for (const char* bit : {watched::asked, watched::unasked_repair, watched::wrong_list,
                          watched::generated, watched::lists, watched::listed_at_first}) {
    system.declare(bit, false);
  }
  const Expr yes = smt::SymbolicContext::current().bool_val(true);
  Derived derived{dds, mistakes, system};
  derived.received = [&](std::string_view packet, const auto& says) {
    if (packet == "AckNack") system.assign(watched::asked, says.at("Listed"), yes);
  };
  derived.emitted = [&](std::string_view packet, const Expr& when, const auto& says) {
    if (packet == "Data" && says.contains("IsRepair")) {  // what is not said is false
      const Expr repaired = when && says.at("Carries") && says.at("IsRepair");
      system.assign(watched::unasked_repair, repaired && !system.now(watched::asked), yes);
      system.assign(watched::asked, repaired, !yes);
    } else if (packet == "AckNack" && says.contains("Listed")) {
      Expr missing = !system.now("X");
      if (system.has("Known")) missing = missing && system.now("Known");
      system.assign(watched::wrong_list, when && says.at("Listed") != missing, yes);
      const Expr taken = (when && !system.now(watched::generated)).simplify();
      for (const char* bit : {watched::lists, watched::listed_at_first}) {
        system.assign(bit, taken, says.at("Listed"));
      }
      system.assign(watched::generated, taken, yes);
    }
  };
  if (mistakes.live_bitmaps) {
    derived.ended = [&](const Expr& listed_now) {
      system.assign(watched::lists, system.now(watched::generated), listed_now);
    };
  }
  derive(program, derived);
}

TransitionSystem DescriptorSystem::with_bad(const Expr& bad) const {
  TransitionSystem system = derivation_.system();
  system.bad = bad;
  return what_matters(system);
}

void assume_for_descriptors(Proof& proof) {
  proof.assume(
      "ACKNACKs, HEARTBEATs and DATA may be delayed, lost, duplicated and reordered without bound; "
      "a timer that was started may be due at any time, any number of times.");
  proof.assume(
      "The numbers of descriptors and readers are arbitrary: one is looked at, and what the rules "
      "read of the others ranges freely.");
  proof.assume(hosts_keep_contracts);
  if (model::traits_of(proof.scenario().dds).has_server) {
    proof.assume(
        "It is about what clients tell the server, which goes by Fast DDS's rules; either side of "
        "a relation opens at any time.");
  }
}

DescriptorSystem descriptor_system(Proof& proof) {
  assume_for_descriptors(proof);
  return {proof.scenario().dds, proof.mistakes()};
}

}  // namespace stormproof::tables
