// Counts through the combinations like an odometer and reads each through the memory of parts.
#include "checker/experiments/grids/plan.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "model/config/tree/quantities.hpp"

namespace stormproof::grids {

namespace config = model::config;
using config::InputError;

namespace {

constexpr const char* scenario_column = "scenario";
constexpr const char* seed_column = "seed";

/// The places of a value and of all that is in it.
void collect_places(const config::Node& node, std::unordered_set<std::string>& places) {
  places.insert(node.place.to_string());
  for (const config::Node& item : node.items) collect_places(item, places);
  for (const config::Member& member : node.members) {
    places.insert(member.key_place.to_string());
    collect_places(member.value, places);
  }
}

struct DigestHash {
  std::size_t operator()(const Digest& digest) const {
    std::size_t value = 0;
    for (std::size_t k = 0; k < sizeof value; ++k) value = value << 8U | digest[k];
    return value;
  }
};

}  // namespace

Choice Plan::choice(std::size_t combination) const {
  Choice choice{0, std::vector<std::size_t>(grid_->axes.size())};
  for (std::size_t k = choice.values.size(); k-- > 0;) {
    const std::size_t count = grid_->axes[k].values.size();
    choice.values[k] = combination % count;
    combination /= count;
  }
  choice.variant = combination;
  return choice;
}

const std::optional<InputError>& Plan::error(std::size_t job) const {
  return combination(job).error;
}

model::Scenario Plan::scenario(std::size_t job) const {
  const PartNumbers& parts = combination(job).parts;
  const Rest& rest = rests_[parts.rest].value;
  model::Scenario scenario;
  scenario.deployment = deployments_[parts.deployment].value;
  scenario.dds = dds_[parts.dds].value;
  scenario.wireless = wireless_[parts.wireless].value;
  scenario.time_limit = rest.time_limit;
  scenario.run_until = rest.run_until;
  scenario.hosts = rest.hosts;
  model::choose_multicast(scenario);
  model::choose_lease(scenario);
  if (grid_->samples) model::draw(scenario, seed(job));
  return scenario;
}

std::vector<std::string> Plan::keys() const {
  std::vector<std::string> keys;
  if (grid_->has_variants) keys.emplace_back(scenario_column);
  for (const Axis& axis : grid_->axes) keys.push_back(axis.key);
  if (grid_->samples) keys.emplace_back(seed_column);
  return keys;
}

std::vector<std::string> Plan::values(std::size_t job) const {
  const Choice chosen = choice(combination(job).number);
  std::vector<std::string> values;
  if (grid_->has_variants) values.push_back(grid_->variants[chosen.variant].name);
  for (std::size_t k = 0; k < grid_->axes.size(); ++k) {
    values.push_back(grid_->axes[k].values[chosen.values[k]].text);
  }
  if (grid_->samples) values.push_back(fmt::to_string(seed(job)));
  return values;
}

void Plan::write_members() {
  const auto member = [](const std::string& key, const std::string& text) {
    const auto count = config::parse_count(text);
    const nlohmann::json value = count ? nlohmann::json(*count) : nlohmann::json(text);
    return nlohmann::json(key).dump() + ":" + value.dump();
  };
  for (const Axis& axis : grid_->axes) {
    std::vector<std::string>& members = members_.emplace_back();
    for (const Axis::Value& value : axis.values) members.push_back(member(axis.key, value.text));
  }
  std::vector<std::string>& members = members_.emplace_back();
  for (const Variant& variant : grid_->variants) {
    members.push_back(nlohmann::json(scenario_column).dump() + ":" +
                      nlohmann::json(variant.name).dump());
  }
}

std::string Plan::values_json(std::size_t job) const {
  const Choice chosen = choice(combination(job).number);
  std::string json = "{";
  const auto add = [&json](const std::string& member) {
    json += json.size() > 1 ? "," : "";
    json += member;
  };
  if (grid_->has_variants) add(members_.back()[chosen.variant]);
  for (std::size_t k = 0; k < chosen.values.size(); ++k) add(members_[k][chosen.values[k]]);
  if (grid_->samples) add(fmt::format("\"{}\":{}", seed_column, seed(job)));
  return json + "}";
}

Digest Plan::digest() const {
  std::string all;
  for (const Digest& digest : digests_) all.append(digest.begin(), digest.end());
  return digest_of(all);
}

std::map<std::string, std::string> Plan::unmodelled() const {
  std::map<std::string, std::string> all;
  std::unordered_set<std::uint32_t> known;
  for (const Combination& one : combinations_) {
    if (one.error || !known.insert(one.parts.dds).second) continue;
    const auto& settings = dds_[one.parts.dds].value.unmodelled;
    all.insert(settings.begin(), settings.end());
  }
  return all;
}

void Plan::add_combination(PartReader& reader, std::size_t number) {
  const Choice chosen = choice(number);
  const PartNumbers parts = reader.read(chosen);
  std::optional<InputError> error = reader.error(chosen, parts);
  if (!error && grid_->samples && !reader.deployments[parts.deployment].value.schedule) {
    error = InputError{grid_->source,
                       "samples: the deployment has no schedule to draw from; expected one, such "
                       "as deployment.schedule: {start: [0ms, 20ms]}"};
  }
  const bool fits_together = !error || !reader.parts_are_right(parts);
  combinations_.push_back({number, parts, std::move(error), fits_together});
}

void Plan::add_job(std::size_t job) {
  const Combination& of_job = combination(job);
  if (of_job.error) {
    std::string text = "error " + to_string(*of_job.error) + "\n";
    for (const std::string& value : values(job)) text += value + "\n";
    digests_.push_back(digest_of(text));
    return;
  }
  const PartNumbers& parts = of_job.parts;
  Digest deployment = deployments_[parts.deployment].digest;
  if (grid_->samples) {
    model::Deployment drawn = deployments_[parts.deployment].value;
    drawn.draw_schedule(seed(job));
    deployment = digest_of(drawn);
  }
  std::string text;
  for (const Digest& part : {deployment, dds_[parts.dds].digest, wireless_[parts.wireless].digest,
                             rests_[parts.rest].digest}) {
    text.append(part.begin(), part.end());
  }
  // What else the seed draws.
  const bool fails = wireless_[parts.wireless].value.loss.has_value();
  if (grid_->samples && (fails || rests_[parts.rest].value.hosts)) {
    text += fmt::format("seed {}", seed(job));
  }
  digests_.push_back(digest_of(text));
}

void Plan::find_alike() {
  std::unordered_map<Digest, std::uint32_t, DigestHash> first;
  first.reserve(size());
  first_alike_.reserve(size());
  for (std::size_t job = 0; job < size(); ++job) {
    const auto number = static_cast<std::uint32_t>(job);
    first_alike_.push_back(first.try_emplace(digests_[job], number).first->second);
  }
}

std::optional<InputError> Plan::useless_value() const {
  const auto failed = [](const Combination& c) { return c.error.has_value(); };
  if (std::ranges::none_of(combinations_, failed)) return std::nullopt;
  if (std::ranges::all_of(combinations_, failed)) return combinations_.front().error;
  // For every value: does each combination with it fail, at this very value?
  const std::size_t slots = grid_->axes.size() + 1;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    const bool is_variant = slot == grid_->axes.size();
    const std::size_t count = is_variant ? grid_->variants.size() : grid_->axes[slot].values.size();
    std::vector<std::unordered_set<std::string>> places(count);
    for (std::size_t k = 0; k < count; ++k) {
      if (!is_variant) {
        collect_places(grid_->axes[slot].values[k].node, places[k]);
        continue;
      }
      for (const config::Override& change : grid_->variants[k].overrides) {
        collect_places(change.value, places[k]);
      }
    }
    std::vector<bool> always(count, true);
    std::vector<const Combination*> example(count, nullptr);
    for (const Combination& combination : combinations_) {
      const Choice chosen = choice(combination.number);
      const std::size_t value = is_variant ? chosen.variant : chosen.values[slot];
      const bool is_its_fault = combination.error && combination.fits_together &&
                                places[value].contains(combination.error->where);
      if (!is_its_fault) always[value] = false;
      example[value] = &combination;
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (always[k]) return example[k]->error;
    }
  }
  return std::nullopt;
}

config::Result<Plan> make_plan(Grid grid, const config::SpecPath& specs, Shard shard) {
  Plan plan;
  plan.grid_ = std::make_shared<const Grid>(std::move(grid));
  plan.shard_ = shard;
  const std::size_t jobs = shard.size(plan.grid_->jobs());
  if (jobs > max_jobs) {
    return config::error_at(
        plan.grid_->place,
        fmt::format("more than {} jobs; expected at most so many, in several shards "
                    "(sweep --shard) or grids if need be",
                    max_jobs));
  }
  plan.write_members();
  PartReader reader{*plan.grid_, specs};
  plan.places_.reserve(jobs);
  for (std::size_t job = 0; job < jobs; ++job) {
    const std::size_t number = plan.number(job) / plan.samples();
    if (plan.combinations_.empty() || plan.combinations_.back().number != number) {
      plan.add_combination(reader, number);
    }
    plan.places_.push_back(static_cast<std::uint32_t>(plan.combinations_.size() - 1));
  }
  // A shard does not see what is wrong wherever it occurs.
  if (shard.count == 1) {
    if (auto error = plan.useless_value()) return *std::move(error);
  }
  plan.deployments_ = std::move(reader.deployments);
  plan.dds_ = std::move(reader.dds);
  plan.wireless_ = std::move(reader.wireless);
  plan.rests_ = std::move(reader.rests);
  plan.digests_.reserve(jobs);
  for (std::size_t job = 0; job < jobs; ++job) plan.add_job(job);
  plan.find_alike();
  return plan;
}

}  // namespace stormproof::grids
