// Reads the scenarios of a grid as any scenario is read, but part by part. Thousands of jobs share
// a few deployments and profiles, and reading a profile takes as long as simulating a small system,
// so each different part is read, checked and digested once.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "checker/experiments/grids/digest.hpp"
#include "checker/experiments/grids/grid.hpp"
#include "model/config/profile_files.hpp"
#include "model/scenario.hpp"

namespace stormproof::grids {

/// One part of a scenario, or what is wrong with it.
template <class T>
struct Part {
  T value{};
  Digest digest{};
  std::optional<model::config::InputError> error;
};

/// What a scenario has beside deployment and profiles. Limits and ranges change no run, so they are
/// checked and dropped.
struct Rest {
  model::Nanoseconds time_limit;
  model::RunUntil run_until{};
  std::optional<model::Processor> hosts = {};
};

/// Where the parts of one combination stand in `PartReader`.
struct PartNumbers {
  std::uint32_t deployment = 0;
  std::uint32_t dds = 0;
  std::uint32_t wireless = 0;
  std::uint32_t rest = 0;
};

/// A variant and a value of each axis, by their numbers.
struct Choice {
  std::size_t variant = 0;
  std::vector<std::size_t> values;  ///< by axis
};

class PartReader {
 public:
  /// Both must live as long as the reader.
  PartReader(const Grid& grid, const model::config::SpecPath& specs);

  /// Reads what is not yet read.
  [[nodiscard]] PartNumbers read(const Choice& choice);

  /// The first error in the parts of a combination, by their order in a scenario; or, if each part
  /// is right by itself, in how they go together.
  [[nodiscard]] std::optional<model::config::InputError> error(const Choice& choice,
                                                               const PartNumbers& numbers);
  /// Whether each part is right by itself.
  [[nodiscard]] bool parts_are_right(const PartNumbers& numbers) const;

  std::vector<Part<model::Deployment>> deployments;
  std::vector<Part<model::DdsProfile>> dds;
  std::vector<Part<model::WirelessProfile>> wireless;
  std::vector<Part<Rest>> rests;

 private:
  enum class Kind { deployment, dds, wireless, rest };
  using Key = std::vector<std::size_t>;
  using Tree = model::config::Result<model::config::Resolved>;
  /// What is remembered of one kind of part.
  struct Memory {
    std::vector<std::size_t> axes;      ///< that concern it
    std::vector<std::size_t> choosing;  ///< those of them that choose a profile
    std::map<Key, std::uint32_t> numbers;
    std::map<Key, Tree> profiles;  ///< before overrides of their keys
  };

  [[nodiscard]] static Kind kind_of(std::string_view path);
  [[nodiscard]] static Key key_of(const Choice& choice, const std::vector<std::size_t>& axes);
  /// The overrides that concern the part.
  [[nodiscard]] std::vector<model::config::Override> changes(const Choice& choice, Kind kind) const;
  /// The scenario of a variant, with no other part than this one.
  [[nodiscard]] model::config::Node part_root(std::size_t variant, Kind kind) const;
  /// The same with all that is put into it.
  [[nodiscard]] Tree tree(const Choice& choice, Kind kind);
  /// Of the choice's DDS profile.
  [[nodiscard]] std::size_t implementation_of(const Choice& choice);

  template <class T, class ValueOf>
  std::uint32_t part_number(const Choice& choice, Kind kind, std::vector<Part<T>>& parts,
                            const ValueOf& value_of);

  const Grid& grid_;
  const model::config::SpecPath& specs_;
  std::map<Kind, Memory> memory_;
  std::map<Key, std::size_t> implementations_;
};

}  // namespace stormproof::grids
