// A grid: many scenarios in one file, as a base and what is varied over it. It exists so that an
// evaluation (two hosts, 1 to 6 participants, 2 to 30 endpoints) is an input of its own that can be
// read, kept and repeated, instead of a shell loop.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/config/spec_path.hpp"
#include "model/config/tree/overrides.hpp"
#include "model/config/tree/result.hpp"
#include "model/config/tree/tree.hpp"

namespace stormproof::grids {

/// Most jobs of one plan, which a process keeps in memory. More are refused: they are rather a
/// mistake than an evaluation, unless somebody says that it is only a shard of them.
inline constexpr std::size_t max_jobs = 1'000'000;
/// Most jobs of all shards of a grid together.
inline constexpr std::size_t max_jobs_of_all_shards = 1'000'000'000'000;

/// One entry of `scenarios`, or the grid's base alone.
struct Variant {
  std::string name;          ///< a scenario's file or name, or "key=value …"
  model::config::Node root;  ///< the scenario's tree, before overrides and profiles
  std::vector<model::config::Override> overrides;
};

/// One entry of `grid`: a key and its values.
struct Axis {
  struct Value {
    std::string text;  ///< as the file has it, on one line
    model::config::Node node;
  };

  std::string key;  ///< as `--set` takes it
  std::vector<Value> values;
};

/// Every variant with every combination of values and with every seed is one job. The last axis
/// changes fastest, but for the seed.
struct Grid {
  std::string source;             ///< file name, for messages
  model::config::Place place;     ///< where it starts
  bool has_variants = false;      ///< whether the file has `scenarios`
  std::vector<Variant> variants;  ///< at least one
  std::vector<Axis> axes;
  std::optional<std::size_t> samples;  ///< schedules of each combination; not given: its own one
  std::uint64_t first_seed = 0;        ///< sample k has seed first_seed + k

  [[nodiscard]] std::size_t combinations() const;
  /// At most `max_jobs_of_all_shards`.
  [[nodiscard]] std::size_t jobs() const { return combinations() * samples.value_or(1); }
};

/// Reads a grid file; `reference` is a path or the name of a file in specs/grids. Errors, each with
/// its place: unknown keys, values of the wrong kind, no values, keys that are given twice, no
/// scenario, scenario files that cannot be read, more than `max_jobs_of_all_shards` jobs. What the
/// combinations themselves have wrong with them, `make_plan` finds out.
[[nodiscard]] model::config::Result<Grid> read_grid(const std::string& reference,
                                                    const model::config::SpecPath& specs);

/// The same for text that is already in memory; scenario files are looked for beside `source`.
[[nodiscard]] model::config::Result<Grid> parse_grid(std::string_view text,
                                                     const std::string& source,
                                                     const model::config::SpecPath& specs);

/// The values of `node`, which is a list (of values and ranges) or one range {from, to, step}:
/// counts, durations or rates; step is 1 for counts if it is absent. `key` is for messages.
[[nodiscard]] model::config::Result<std::vector<Axis::Value>> read_values(
    const model::config::Node& node, const std::string& key);

/// `node` on one line, in YAML's flow notation.
[[nodiscard]] std::string flow_text(const model::config::Node& node);

}  // namespace stormproof::grids
