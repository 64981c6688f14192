// The sidecars of the shipped captures (NAME.json beside NAME.pcap.xz): what somebody else counted
// in them, and the same figures from here.
//
// Not compared, because the sidecar counted them on the link before the capture was reduced to
// discovery datagrams until completion: `datagrams`, `frames`, `wire_bytes`,
// `after_cutoff_datagrams`, and the `user` block.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::capture {

struct Sidecar {
  std::int64_t cutoff_ns = 0;
  std::size_t hosts = 0;
  std::size_t participants_per_host = 0;
  std::size_t endpoints_per_participant = 0;  ///< beside those that every node has
  bool completed = true;
  std::string discovery = "simple";
  /// "counts.initial", "hb_split.periodic", …; only those that can be compared.
  std::map<std::string, std::uint64_t> figures{};
  /// The same of the TypeLookup writers, counted until all that matches was matched.
  std::map<std::string, std::uint64_t> lookups{};
  std::int64_t matched_ns = 0;
  /// DATA to the sender's own host is in `counts` there.
  bool counts_same_host = false;
};

[[nodiscard]] Sidecar read_sidecar(const std::string& path);

/// The same figures, as counted here.
[[nodiscard]] std::map<std::string, std::uint64_t> figures_of(const Counting& counting,
                                                              bool counts_same_host);
/// Of the TypeLookup writers; without those that are 0, as the sidecars have them.
[[nodiscard]] std::map<std::string, std::uint64_t> lookups_of(const Counting& counting);

}  // namespace stormproof::capture
