// RapidCheck's side of the generators: a seed from its random source, and shrinking along the
// simplifying edits of simpler.hpp, tried one by one until one of them still fails.
#include "props/generators/scenarios.hpp"

#include <memory>

#include <nlohmann/json.hpp>

#include "model/config/knobs/effective.hpp"
#include "props/generators/edits.hpp"

namespace stormproof::props {

namespace {

using model::Scenario;
using Shrinks = rc::Seq<rc::Shrinkable<Scenario>>;

rc::Shrinkable<Scenario> shrinkable(Scenario scenario, std::shared_ptr<const Scenario> base);

/// The scenarios one step simpler than `scenario`, each built only when it is its turn.
class Steps {
 public:
  Steps(Scenario scenario, std::shared_ptr<const Scenario> base)
      : scenario_{std::move(scenario)},
        base_{std::move(base)},
        edits_{simplifying_edits(scenario_, *base_)},
        complexity_{complexity(scenario_, *base_)} {}

  rc::Maybe<rc::Shrinkable<Scenario>> operator()() {
    while (next_ < edits_.size()) {
      const Edit& edit = edits_[next_++];
      std::optional<Scenario> simpler = edited(edit, scenario_, *base_, complexity_);
      if (simpler) return shrinkable(*std::move(simpler), base_);
    }
    return rc::Nothing;
  }

 private:
  Scenario scenario_;
  std::shared_ptr<const Scenario> base_;
  Edits edits_;
  Complexity complexity_;
  std::size_t next_ = 0;
};

rc::Shrinkable<Scenario> shrinkable(Scenario scenario, std::shared_ptr<const Scenario> base) {
  return rc::shrinkable::lambda(
      [scenario] { return scenario; },
      [scenario, base]() -> Shrinks { return rc::makeSeq<Steps>(scenario, base); });
}

/// The default profiles, as far as the space has them, and the given time limit.
Scenario base_of(const Scenario& scenario, const ScenarioSpace& space) {
  Scenario base;
  base.dds.implementation = scenario.dds.implementation;
  base.wireless.kind = space.service.value_or(base.wireless.kind);
  base.time_limit = scenario.time_limit;
  base.run_until = space.run_until.value_or(base.run_until);
  return base;
}

/// A part of a random scenario; the rest is the base's, with the smallest deployment that makes
/// every profile valid.
template <class Part>
rc::Gen<Part> parts(const ScenarioSpace& space, Part Scenario::*part) {
  return [space, part](rc::Random random, int size) {
    const Scenario drawn = draw_scenario(random.next(), size, space);
    const Scenario base = base_of(drawn, space);
    Scenario scenario = base;
    scenario.deployment = model::Deployment::homogeneous(2, 1, 1);
    scenario.*part = drawn.*part;
    return rc::shrinkable::map(shrinkable(scenario, std::make_shared<const Scenario>(base)),
                               [part](const Scenario& whole) { return whole.*part; });
  };
}

}  // namespace

rc::Gen<Scenario> scenarios(const ScenarioSpace& space) {
  return [space](rc::Random random, int size) {
    Scenario scenario = draw_scenario(random.next(), size, space);
    auto base = std::make_shared<const Scenario>(base_of(scenario, space));
    return shrinkable(std::move(scenario), std::move(base));
  };
}

rc::Gen<model::Deployment> deployments(const ScenarioSpace& space) {
  return parts(space, &Scenario::deployment);
}
rc::Gen<model::DdsProfile> dds_profiles(const ScenarioSpace& space) {
  return parts(space, &Scenario::dds);
}
rc::Gen<model::WirelessProfile> wireless_profiles(const ScenarioSpace& space) {
  return parts(space, &Scenario::wireless);
}

}  // namespace stormproof::props

namespace stormproof::model {

void showValue(const Scenario& scenario, std::ostream& out) {
  out << '\n' << config::effective_yaml(scenario);
}
void showValue(const DdsProfile& dds, std::ostream& out) {
  out << config::effective_json(dds).dump();
}
void showValue(const WirelessProfile& wireless, std::ostream& out) {
  out << config::effective_json(wireless).dump();
}
void showValue(const Deployment& deployment, std::ostream& out) {
  Scenario scenario;
  scenario.deployment = deployment;
  out << config::effective_json(scenario)["deployment"].dump();
}

}  // namespace stormproof::model
