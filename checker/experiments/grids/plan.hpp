// The jobs of a grid or of one shard of it, in the grid's order: which scenario each one runs, the
// values that distinguish it, and the digest by which its result is found again.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "checker/experiments/grids/parts.hpp"

namespace stormproof::grids {

/// One of `count` equal parts of a grid, so that processes that know nothing of each other share
/// it: every `count`-th job from job `number` on, because neighbours take about as long.
struct Shard {
  std::size_t number = 0;
  std::size_t count = 1;

  /// How many of `jobs` are in it.
  [[nodiscard]] std::size_t size(std::size_t jobs) const {
    return jobs > number ? (jobs - number - 1) / count + 1 : 0;
  }
};

class Plan {
 public:
  [[nodiscard]] const Grid& grid() const { return *grid_; }
  [[nodiscard]] Shard shard() const { return shard_; }
  [[nodiscard]] std::size_t size() const { return digests_.size(); }

  /// Why the job cannot run: the error of its combination, with its place.
  [[nodiscard]] const std::optional<model::config::InputError>& error(std::size_t job) const;
  /// What the job runs; it must have no error.
  [[nodiscard]] model::Scenario scenario(std::size_t job) const;
  /// Of its effective inputs: jobs with the same digest are the same run. The digest of a job that
  /// cannot run is that of its values and its error.
  [[nodiscard]] const Digest& digest(std::size_t job) const { return digests_[job]; }
  /// The first job with the same digest.
  [[nodiscard]] std::size_t first_alike(std::size_t job) const { return first_alike_[job]; }
  /// Of all jobs in their order: equal plans have equal ones.
  [[nodiscard]] Digest digest() const;

  /// What distinguishes the jobs: "scenario" if there are several, each swept key, "seed" with
  /// samples.
  [[nodiscard]] std::vector<std::string> keys() const;
  /// The settings that the model has not got, of all profiles whose jobs can run.
  [[nodiscard]] std::map<std::string, std::string> unmodelled() const;

  /// The job's value of each of `keys()`, as text.
  [[nodiscard]] std::vector<std::string> values(std::size_t job) const;
  /// Keys and values as a JSON object on one line; counts are numbers.
  [[nodiscard]] std::string values_json(std::size_t job) const;

 private:
  friend model::config::Result<Plan> make_plan(Grid grid, const model::config::SpecPath& specs,
                                               Shard shard);

  struct Combination {
    std::size_t number = 0;  ///< in the grid
    PartNumbers parts;
    std::optional<model::config::InputError> error;
    bool fits_together = true;  ///< false if the parts are right and only their combination is not
  };

  Plan() = default;
  [[nodiscard]] Choice choice(std::size_t combination) const;
  [[nodiscard]] std::size_t samples() const { return grid_->samples.value_or(1); }
  /// Of a job, in the whole grid.
  [[nodiscard]] std::size_t number(std::size_t job) const {
    return shard_.number + job * shard_.count;
  }
  [[nodiscard]] const Combination& combination(std::size_t job) const {
    return combinations_[places_[job]];
  }
  [[nodiscard]] std::uint64_t seed(std::size_t job) const {
    return grid_->first_seed + number(job) % samples();
  }
  void add_combination(PartReader& reader, std::size_t number);
  void add_job(std::size_t job);
  void find_alike();
  [[nodiscard]] std::optional<model::config::InputError> useless_value() const;

  void write_members();

  std::shared_ptr<const Grid> grid_;
  Shard shard_;
  std::vector<std::vector<std::string>>
      members_;  ///< `"key":value` by axis and value; variants last
  std::vector<Part<model::Deployment>> deployments_;
  std::vector<Part<model::DdsProfile>> dds_;
  std::vector<Part<model::WirelessProfile>> wireless_;
  std::vector<Part<Rest>> rests_;
  std::vector<Combination> combinations_;   ///< those of its jobs, ascending
  std::vector<std::uint32_t> places_;       ///< by job: its combination
  std::vector<Digest> digests_;             ///< by job
  std::vector<std::uint32_t> first_alike_;  ///< by job
};

/// Reads all combinations of the shard's jobs. A combination that is wrong is a job with an error,
/// so that one corner of a grid does not cost the rest. What is wrong wherever it occurs is refused
/// as bad input, unless only a shard of it is seen: an error of all jobs, or a value (of an axis or
/// a variant) whose own fault every job with it has. More than `max_jobs` jobs are refused.
[[nodiscard]] model::config::Result<Plan> make_plan(Grid grid, const model::config::SpecPath& specs,
                                                    Shard shard = {});

}  // namespace stormproof::grids
