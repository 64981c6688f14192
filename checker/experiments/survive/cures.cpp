// The few that there are; versions come last, as settings are changed sooner.
#include "checker/experiments/survive/cures.hpp"

#include "model/implementations.hpp"

namespace stormproof::survive {

namespace {

void add_of_cyclone(const model::DdsProfile& dds, std::vector<Cure>& cures) {
  constexpr model::Nanoseconds interval{5'000'000'000};
  if (dds.spdp.discovered_prune_delay) {
    if (dds.spdp.period > interval) {
      cures.push_back({"SPDPInterval 5 s",
                       {"dds.spdp.period=5s"},
                       "addresses at which nobody answers are announced to every 5 s, not once "
                       "(ddsi_spdp_schedule.c; exhibit E18)"});
    }
    cures.push_back(
        {"PruneDelay inf",
         {"dds.spdp.initial_prune_delay=1000000s", "dds.spdp.discovered_prune_delay=1000000s"},
         "no address is ever dropped, as in 0.10: InitialLocatorPruneDelay and "
         "DiscoveredLocatorPruneDelay (exhibit E18)"});
  }
  if (dds.allow_multicast == model::AllowMulticast::never) {
    cures.push_back({"AllowMulticast spdp",
                     {"dds.allow_multicast=spdp"},
                     "the group is announced to whoever is known (exhibit E18)"});
  }
}

/// Where everybody learns everybody again at once, 2.6 to 2.10 storm as at the start, or worse.
void add_of_fastdds(const model::DdsProfile& dds, std::vector<Cure>& cures) {
  constexpr model::Bytes large{4'000'000};
  if (dds.sedp.piggyback_threshold_bytes < large) {
    cures.push_back({"sendBufferSize 4 MB",
                     {"dds.sedp.piggyback_threshold_bytes=4000000"},
                     "HEARTBEATs ride on fewer packets; live, rediscovery storms with the default "
                     "and not with this"});
  }
  cures.push_back({"Fast DDS 2.14.5",
                   {"dds=fastdds-2.14.5"},
                   "longer delays (#5540) and fewer announcements; live, it does not storm"});
}

void add_of_server(const model::DdsProfile& dds, std::vector<Cure>& cures) {
  if (dds.server.rejoin != model::Rejoin::known) {
    cures.push_back({"a server with #5780",
                     {"dds.rejoin=known"},
                     "a goodbye is withdrawn if the client is heard again: Fast DDS 2.14.5, 3.1.3, "
                     "3.2.3, 3.3 and later"});
  }
}

}  // namespace

std::vector<Cure> cures_for(const model::Scenario& scenario) {
  const model::DdsProfile& dds = scenario.dds;
  const model::ImplementationTraits& traits = traits_of(dds);
  std::vector<Cure> cures;
  if (traits.says_goodbye) add_of_cyclone(dds, cures);
  const bool is_simple = dds.discovery == model::Discovery::simple;
  if (traits.vendor == model::vendor::fastdds && is_simple) add_of_fastdds(dds, cures);
  if (!traits.has_server) return cures;
  add_of_server(dds, cures);
  cures.push_back({"Fast DDS 3.6",
                   {"dds=fastdds-server-3.6"},
                   "what 2.14 to 3.6 changed; clients know the server by its address"});
  return cures;
}

}  // namespace stormproof::survive
