// The auditor of each composition.
#include "props/monitors/auditors.hpp"

#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/fastdds_life.hpp"
#include "fsm/composition/paper.hpp"
#include "model/composition_of.hpp"
#include "props/monitors/auditor.hpp"

namespace stormproof::props {

namespace {

template <class Composition>
std::unique_ptr<Follower> auditor_of(model::Of<Composition>, model::RunState& run, Audit& audit) {
  return std::make_unique<Auditor<Composition>>(run, audit);
}
/// Nobody audits amended rules, whose contracts are the paper's.
std::unique_ptr<Follower> auditor_of(model::Of<comp::amended::Amended>, model::RunState&, Audit&) {
  throw std::logic_error{"nobody follows this composition"};
}

}  // namespace

std::unique_ptr<Follower> make_auditor(model::RunState& run, Audit& audit) {
  const model::ImplementationTraits& traits = model::traits_of(run.scenario.dds);
  if (is_living(run.scenario) && !traits.has_event_thread && !traits.has_server) {
    return std::make_unique<Auditor<comp::fastdds::FastDdsLiving>>(run, audit);
  }
  return model::visit_composition(
      run.scenario.dds, [&](auto composition) { return auditor_of(composition, run, audit); });
}

}  // namespace stormproof::props
