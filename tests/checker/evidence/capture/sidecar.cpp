// Sidecars and their figures.
#include "tests/checker/evidence/capture/sidecar.hpp"

#include <fstream>
#include <set>

#include <nlohmann/json.hpp>

namespace stormproof::capture {

Sidecar read_sidecar(const std::string& path) {
  const std::set<std::string> not_comparable{"datagrams", "frames", "wire_bytes",
                                             "after_cutoff_datagrams"};
  std::ifstream in{path};
  const auto json = nlohmann::json::parse(in);
  Sidecar sidecar;
  sidecar.cutoff_ns = json.at("cutoff_ns");
  sidecar.hosts = json.at("hosts");
  sidecar.participants_per_host = json.at("participants_per_host");
  sidecar.endpoints_per_participant = json.at("endpoints_per_participant");
  // Those with a note were corrected.
  sidecar.counts_same_host =
      json.at("implementation") != "Fast DDS 2.6.11" && !json.contains("note");
  sidecar.completed = json.value("completed", true);
  sidecar.discovery = json.value("discovery", sidecar.discovery);
  if (json.contains("typelookup") && json["typelookup"].is_object() && sidecar.completed) {
    const double matched_ms = json.at("T_match_ms");
    sidecar.matched_ns =
        json.at("start_ns").get<std::int64_t>() + static_cast<std::int64_t>(matched_ms * 1e6);
    sidecar.lookups = json["typelookup"];
  }
  if (!json.contains("hb_split") && !json.contains("typelookup")) {
    // Those sidecars leave out what is 0.
    for (const char* name : {"repair", "hb_piggyback", "hb_empty", "ack_nonempty", "ack_final",
                             "ack_initial_like", "nacked_seqs"}) {
      sidecar.figures[std::string{"counts."} + name] = 0;
    }
  }
  for (const char* block : {"counts", "hb_split", "ack_split"}) {
    if (!json.contains(block)) continue;
    for (const auto& [name, value] : json[block].items()) {
      if (!not_comparable.contains(name)) sidecar.figures[block + ("." + name)] = value;
    }
  }
  return sidecar;
}

std::map<std::string, std::uint64_t> figures_of(const Counting& counting, bool counts_same_host) {
  model::Counts counts = counting.counts;
  if (counts_same_host) {
    counts.initial_data += counting.same_host.initial_data;
    counts.repair_data += counting.same_host.repair_data;
  }
  const HeartbeatFigures& heartbeats = counting.heartbeats;
  const AcknackFigures& acknacks = counting.acknacks;
  const auto kind = [&](HeartbeatKind one) { return heartbeats.of(one); };
  return {{"counts.spdp_m", counts.spdp_multicast},
          {"counts.spdp_u", counts.spdp_unicast + counts.pdp_data},
          {"counts.initial", counts.initial_data},
          {"counts.repair", counts.repair_data},
          {"counts.hb", counts.heartbeat},
          {"counts.ack", counts.acknack},
          {"counts.total", counts.total() - counts.pdp_heartbeat - counts.pdp_acknack},
          {"counts.hb_piggyback", heartbeats.behind_data},
          {"counts.hb_empty", heartbeats.empty},
          {"counts.ack_nonempty", acknacks.negative},
          {"counts.ack_initial_like", acknacks.initial},
          {"counts.ack_final", acknacks.final_flag},
          {"counts.nacked_seqs", acknacks.requested},
          {"hb_split.nodst", heartbeats.no_info_dst},
          {"hb_split.with_data", heartbeats.behind_data},
          {"hb_split.piggyback", kind(HeartbeatKind::fan_out_piggyback)},
          {"hb_split.periodic", kind(HeartbeatKind::fan_out_periodic)},
          {"hb_split.forced", kind(HeartbeatKind::reply)},
          {"hb_split.directed", kind(HeartbeatKind::directed)},
          // The sidecar has those behind DATA here as well.
          {"hb_split.match",
           kind(HeartbeatKind::relation_open) + kind(HeartbeatKind::directed_piggyback)},
          {"ack_split.nack", acknacks.negative},
          {"ack_split.initial", acknacks.initial},
          {"ack_split.positive", acknacks.positive}};
}

std::map<std::string, std::uint64_t> lookups_of(const Counting& counting) {
  std::map<std::string, std::uint64_t> found;
  const auto add = [&found](const std::string& writer, const LookupFigures& figures) {
    found[writer + "_DATA"] = figures.data;
    found[writer + "_samples"] = figures.samples;
    found[writer + "_bytes"] = figures.data_bytes;
    found[writer + "_HB"] = figures.heartbeat;
    found[writer + "_ACK"] = figures.acknack;
    found[writer + "_GAP"] = figures.gap;
  };
  add("req", counting.lookup_requests);
  add("rep", counting.lookup_replies);
  std::erase_if(found, [](const auto& one) { return one.second == 0; });
  return found;
}

}  // namespace stormproof::capture
