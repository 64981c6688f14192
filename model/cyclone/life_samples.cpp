// Puts the changes of each participant in the order of time, and numbers their samples.
#include "model/cyclone/life_samples.hpp"

#include <algorithm>

#include "model/cyclone/life_periods.hpp"
#include "model/engine/node_endpoints.hpp"

namespace stormproof::model::cyclone {

namespace {

/// A change that has no sample yet: of which endpoint, or of all.
struct Planned {
  Change change;
  std::uint32_t descriptor = 0;
};

std::uint32_t of_the_node(Stream s) {
  return s == Stream::pub ? default_publications : default_subscriptions;
}

void plan_late(const LateEndpoints& late, std::array<std::uint32_t, 2>& endpoints,
               std::vector<Planned>& all) {
  for (const Stream s : streams) {
    const std::uint32_t count = s == Stream::pub ? late.publications : late.subscriptions;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t descriptor = endpoints[index_of(s)]++;
      all.push_back({{late.at, Change::Kind::creates, s, 0}, descriptor});
      if (late.until) all.push_back({{*late.until, Change::Kind::deletes, s, 0}, descriptor});
    }
  }
}

}  // namespace

LifeSamples::LifeSamples(const Scenario& scenario, const Topology& topology)
    : samples_(topology.participant_count()),
      endpoints_(topology.participant_count()),
      changes_(topology.participant_count()),
      signs_of_life_(topology.participant_count(), 1) {
  for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
    for (const Stream s : streams) {
      const std::uint32_t count = topology.descriptor_count(i, s);
      endpoints_[i][index_of(s)] = count;
      for (std::uint32_t d = 0; d < count; ++d) samples_[i][index_of(s)].push_back({d, false});
    }
    if (scenario.deployment.life) plan(i, scenario);
  }
}

void LifeSamples::plan(std::uint32_t i, const Scenario& scenario) {
  const Life& life = *scenario.deployment.life;
  const Nanoseconds lease = lease_of(life, i).value_or(lease_of(dds_of(scenario, i)));
  signs_of_life_[i] +=
      static_cast<std::uint32_t>(scenario.time_limit.count() / base_period(lease).count());
  std::vector<Planned> all;
  for (const LateEndpoints& late : life.endpoints) {
    if (late.participant == i) plan_late(late, endpoints_[i], all);
  }
  for (const Deletion& deletion : life.deletions) {
    if (deletion.participant != i) continue;
    const Stream s = deletion.publication ? Stream::pub : Stream::sub;
    const std::uint32_t which = deletion.publication.value_or(deletion.subscription.value_or(0));
    all.push_back({{deletion.at, Change::Kind::deletes, s, 0}, of_the_node(s) + which});
  }
  const auto ends = [&](Nanoseconds at, Change::Kind kind) {
    all.push_back({{at, kind, Stream::pub, 0}, 0});
  };
  for (const Leave& leave : life.leaves) {
    if (leave.participant == i) ends(leave.at, Change::Kind::leaves);
  }
  for (const Restart& restart : life.restarts) {
    if (restart.participant != i) continue;
    ends(restart.stop, restart.goodbye == Goodbye::yes ? Change::Kind::leaves : Change::Kind::dies);
  }
  for (const Mute& mute : life.mute) {
    if (mute.participant == i) ends(mute.from, Change::Kind::dies);
  }
  std::ranges::stable_sort(all, {}, [](const Planned& planned) { return planned.change.at; });
  for (const Planned& planned : all) {
    Change change = planned.change;
    if (change.kind == Change::Kind::leaves) leave(i, change.at, changes_[i]);
    if (change.kind == Change::Kind::creates || change.kind == Change::Kind::deletes) {
      std::vector<Sample>& samples = samples_[i][index_of(change.stream)];
      change.sample = static_cast<std::uint32_t>(samples.size());
      samples.push_back({planned.descriptor, change.kind == Change::Kind::deletes});
    }
    changes_[i].push_back(change);
    if (change.kind == Change::Kind::leaves || change.kind == Change::Kind::dies) return;
  }
}

/// All publications are deleted, then all subscriptions, the latest first.
void LifeSamples::leave(std::uint32_t i, Nanoseconds at, std::vector<Change>& changes) {
  for (const Stream s : streams) {
    std::vector<Sample>& samples = samples_[i][index_of(s)];
    std::vector<std::uint32_t> there;
    for (const Sample& sample : samples) {
      if (sample.deletes) {
        std::erase(there, sample.descriptor);
      } else {
        there.push_back(sample.descriptor);
      }
    }
    std::ranges::reverse(there);
    for (const std::uint32_t descriptor : there) {
      changes.push_back({at, Change::Kind::deletes, s, static_cast<std::uint32_t>(samples.size())});
      samples.push_back({descriptor, true});
    }
  }
}

}  // namespace stormproof::model::cyclone
