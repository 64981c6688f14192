// When participants started and had their endpoints, as they say themselves: of those on the host
// of a Discovery Server no capture of the link shows it. The live bed writes such records
// (tests/live), one file for each participant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "model/config/tree/result.hpp"

namespace stormproof::validate {

/// Times are ns since 1970.
struct Reported {
  std::size_t host = 0;       ///< 0: that of the server
  std::string guid_prefix{};  ///< "010f1c2d.a1b2c3d4.00000000", as `capture summarize` has it; or
                              ///< empty: any of its host
  std::int64_t created_ns = 0;
  std::int64_t endpoints_done_ns = 0;  ///< ≥ created_ns
};

struct RunRecord {
  std::string name{};
  std::vector<Reported> participants{};
};

/// A JSON file with one participant, a list of them, or an object that has one as `participants`;
/// or a folder of such files. Keys other than those of `Reported` say nothing.
[[nodiscard]] model::config::Result<RunRecord> read_run_record(const std::string& path);

}  // namespace stormproof::validate
