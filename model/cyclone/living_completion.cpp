// Counts anew what a pair lacks whenever something of it changes.
#include "model/cyclone/living_completion.hpp"

namespace stormproof::model::cyclone {

LivingCompletion::LivingCompletion(RunState& run, const LifeSamples& samples)
    : run_{run},
      samples_{samples},
      owned_(run.topology.participant_count()),
      known_(run.topology.pair_count()),
      recognised_(run.topology.pair_count()),
      gone_(run.topology.participant_count()),
      lacking_(run.topology.pair_count()) {
  const Topology& topology = run.topology;
  for (Number i = 0; i < topology.participant_count(); ++i) {
    for (const Stream s : streams) {
      Set& owned = owned_[i][index_of(s)];
      owned.assign(topology.descriptor_count(i, s), true);
      owned.resize(samples.endpoints(i, s));
    }
  }
  run.missing = 0;
  for (Number pair = 0; pair < topology.pair_count(); ++pair) {
    for (const Stream s : streams) {
      known_[pair][index_of(s)].resize(samples.endpoints(topology.pair(pair).source, s));
    }
    count(pair);
  }
}

/// Everything that the two do not agree on; whether one knows the other, if that is all.
std::uint64_t LivingCompletion::lacking(Number pair) const {
  const Pair& ends = run_.topology.pair(pair);
  if (!ends.cross_host || gone_[ends.destination]) return 0;
  if (gone_[ends.source]) return recognised_[pair] ? 1 : 0;
  std::uint64_t lacking = 0;
  for (const Stream s : streams) {
    const Set& owned = of(owned_[ends.source], s);
    const Set& known = of(known_[pair], s);
    for (std::size_t d = 0; d < owned.size(); ++d) lacking += owned[d] != known[d] ? 1U : 0U;
  }
  return lacking == 0 && !recognised_[pair] ? 1 : lacking;
}

void LivingCompletion::count(Number pair) {
  const std::uint64_t before = lacking_[pair];
  lacking_[pair] = lacking(pair);
  run_.missing += lacking_[pair];
  run_.missing -= before;
}

void LivingCompletion::count_all(Number i) {
  const Topology& topology = run_.topology;
  for (Number pair = topology.first_pair(i); pair < topology.first_pair(i + 1); ++pair) {
    count(pair);
    count(topology.pair(pair).reverse);
  }
}

void LivingCompletion::recognise(Number pair) {
  recognised_[pair] = true;
  count(pair);
}

void LivingCompletion::forget(Number pair) {
  recognised_[pair] = false;
  for (Set& known : known_[pair]) known.assign(known.size(), false);
  count(pair);
}

void LivingCompletion::follow(Number pair, Stream s, Sample said) {
  known_[pair][index_of(s)][said.descriptor] = !said.deletes;
  const Pair& ends = run_.topology.pair(pair);
  if (ends.cross_host) {
    if (!said.deletes) ++run_.useful_deliveries;
    run_.last_delivered = {ParticipantId{ends.source}, ParticipantId{ends.destination}, s,
                           DescriptorId{said.descriptor}};
  }
  count(pair);
}

void LivingCompletion::set(Number i, Stream s, Number sample, bool exists) {
  owned_[i][index_of(s)][samples_.of(i, s, sample).descriptor] = exists;
  count_all(i);
}
void LivingCompletion::create(Number i, Stream s, Number sample) { set(i, s, sample, true); }
void LivingCompletion::remove(Number i, Stream s, Number sample) { set(i, s, sample, false); }

void LivingCompletion::die(Number i) {
  gone_[i] = true;
  count_all(i);
}

std::vector<MissingDescriptor> LivingCompletion::missing(std::size_t limit) const {
  std::vector<MissingDescriptor> list;
  for (Number pair = 0; pair < run_.topology.pair_count(); ++pair) {
    const Pair& ends = run_.topology.pair(pair);
    if (!ends.cross_host || gone_[ends.source] || gone_[ends.destination]) continue;
    for (const Stream s : streams) {
      const Set& owned = of(owned_[ends.source], s);
      for (Number d = 0; d < owned.size(); ++d) {
        if (list.size() == limit) return list;
        if (!owned[d] || of(known_[pair], s)[d]) continue;
        list.push_back(
            {ParticipantId{ends.source}, ParticipantId{ends.destination}, s, DescriptorId{d}});
      }
    }
  }
  return list;
}

}  // namespace stormproof::model::cyclone
