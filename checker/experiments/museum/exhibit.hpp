// An exhibit of the museum: a defect that a DDS implementation had or has, as knobs of a profile
// before and after its repair, with the smallest scenario that shows it and the claim that it
// breaks. Exhibits are files, specs/museum/ID.yaml (specs/guide/museum.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/config/spec_path.hpp"
#include "model/config/tree/result.hpp"
#include "model/scenario.hpp"
#include "props/verdict.hpp"

namespace stormproof::museum {

/// Keys of a scenario with their values, as a file says them.
using Changes = std::vector<std::pair<std::string, std::string>>;

/// One set of rules, and what is expected of it.
struct Variant {
  std::string title;  ///< of a decoy: what somebody might try instead of the repair
  Changes changes;
  model::Scenario scenario;
  /// `violated`; `bounded` if no loss pattern within the scope breaks the claim; `proved` if,
  /// besides, it is known from the rules for all losses, delays and deployments.
  props::VerdictKind expected = props::VerdictKind::inconclusive;
};

struct Exhibit {
  std::string id;  ///< "E3"
  std::string vendor;
  std::uint32_t year = 0;
  std::string title;
  std::string sentence;            ///< what happens, and why
  std::string fix;                 ///< what repairs it
  std::vector<std::string> links;  ///< to the report and the repair
  std::vector<std::string> rules;  ///< ids of the composition that differ
  std::string claim;               ///< id of one of the claims (claims.hpp)
  std::optional<model::Nanoseconds> bound;
  // The scope: at most so many losses, each of one of the first packets.
  std::uint32_t losses = 0;
  std::uint32_t packets = 0;
  Variant before;
  Variant after;
  std::vector<Variant> decoys;
};

/// Reads the exhibit of this name, or the file. Errors have the place and what was expected.
[[nodiscard]] model::config::Result<Exhibit> read_exhibit(const std::string& reference,
                                                          const model::config::SpecPath& specs);
/// The changes as overrides of a DDS profile: "sedp.heartbeat_period=50ms". An exhibit whose
/// changes are of something else cannot be carried to another deployment; nothing then.
[[nodiscard]] std::optional<std::vector<std::string>> profile_overrides(const Changes& changes);
/// Their names, in the order of their numbers.
[[nodiscard]] std::vector<std::string> exhibit_names(const model::config::SpecPath& specs);

}  // namespace stormproof::museum
