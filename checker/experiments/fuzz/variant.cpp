// Draws with one generator for the values of a variant and another for its losses, so that the
// number of packets looked at changes nothing else. All draws are of integers: the sequence of
// mt19937_64 is fixed by the standard, distributions and floating point are not.
#include "checker/experiments/fuzz/variant.hpp"

#include <algorithm>
#include <random>

#include "checker/experiments/trials/launch_plan.hpp"
#include "model/life.hpp"

namespace stormproof::fuzz {

namespace {

using Random = std::mt19937_64;

/// The finalizer of SplitMix64: neighbouring numbers become unrelated ones.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

enum class Purpose : std::uint8_t { values, losses, life };

Random generator(std::uint64_t seed, std::uint64_t number, Purpose purpose) {
  constexpr std::uint64_t of_life = 0x6c696665U;  // in a stream of its own: others stay as they are
  if (purpose == Purpose::life) seed ^= of_life;
  const auto stream = static_cast<std::uint64_t>(purpose) % 2;
  return Random{mixed(mixed(seed) + 2 * number + stream)};
}

/// From low to high, both included. The bias of the remainder is below 10^-3 for every range here.
std::int64_t between(Random& random, std::int64_t low, std::int64_t high) {
  const auto values = static_cast<std::uint64_t>(high - low) + 1;
  return low + static_cast<std::int64_t>(random() % values);
}

/// value · ratio for ratio ≤ 1, rounded down; the products stay within 64 bits.
std::int64_t part_of(std::int64_t value, const model::Ratio& ratio) {
  return value / ratio.denominator * ratio.numerator +
         value % ratio.denominator * ratio.numerator / ratio.denominator;
}

/// What happens to participants: two times in the range, the earlier one first, for each failure.
class Fate {
 public:
  Fate(Random& random, const model::Variation& vary, model::Deployment& deployment)
      : random_{random}, vary_{vary}, deployment_{deployment} {}

  void draw() {
    for (std::int64_t k = some(vary_.late_joiners); k > 0; --k) {
      model::Participant& late = deployment_.participants[anybody()];
      const model::Nanoseconds later{between(random_, 0, latest())};
      late.endpoints_done += later;
      late.start += later;
    }
    for (std::int64_t k = some(vary_.outages); k > 0; --k) {
      const std::uint32_t from = anybody();
      const std::uint32_t to = anybody();
      const auto [start, end] = times();
      const auto& all = deployment_.participants;
      if (all[from].host == all[to].host || start == end) continue;
      life().outages.push_back({from, to, start, end});
    }
    for (std::int64_t k = some(vary_.restarts); k > 0; --k) {
      const std::uint32_t who = anybody();
      const auto [stop, start] = times();
      const model::Nanoseconds begin = deployment_.participants[who].start;
      life().restarts.push_back({who, begin + stop, begin + std::max(start, stop + one), {}});
      if (!comes_back_in_order(deployment_)) life().restarts.pop_back();
    }
    for (std::int64_t k = some(vary_.new_endpoints); k > 0; --k) {
      const std::uint32_t who = anybody();
      const auto [at, until] = times();
      const model::Nanoseconds begin = deployment_.participants[who].start;
      life().endpoints.push_back({who, 1, 1, begin + at, {}});
      if (until > at && between(random_, 0, 1) == 1) {
        life().endpoints.back().until = begin + until;
      }
      if (!creates_while_there(deployment_)) life().endpoints.pop_back();
    }
  }

 private:
  static constexpr model::Nanoseconds one{1};

  [[nodiscard]] std::int64_t latest() const { return vary_.time_of_failures().count(); }
  std::int64_t some(const std::optional<std::uint32_t>& most) {
    return most ? between(random_, 0, *most) : 0;
  }
  std::uint32_t anybody() {
    return static_cast<std::uint32_t>(between(random_, 0, deployment_.size() - 1));
  }
  std::pair<model::Nanoseconds, model::Nanoseconds> times() {
    const std::int64_t a = between(random_, 0, latest());
    const std::int64_t b = between(random_, 0, latest());
    return {model::Nanoseconds{std::min(a, b)}, model::Nanoseconds{std::max(a, b)}};
  }
  model::Life& life() {
    if (!deployment_.life) deployment_.life.emplace();
    return *deployment_.life;
  }

  Random& random_;
  const model::Variation& vary_;
  model::Deployment& deployment_;
};

void add_relative(std::vector<KnobRange>& ranges,
                  const std::vector<model::config::NumericKnob>& knobs,
                  const std::optional<model::Ratio>& ratio) {
  if (!ratio) return;
  for (const model::config::NumericKnob& knob : knobs) {
    const std::int64_t half = part_of(knob.value, *ratio);
    ranges.push_back({knob.key, knob.unit, std::max(knob.minimum, knob.value - half),
                      std::min(knob.maximum, knob.value + half)});
  }
}

}  // namespace

VariantSource::VariantSource(const model::Scenario& base, const Ranges& ranges)
    : base_{base}, ranges_{ranges} {
  add_relative(knobs_, size_knobs(base), ranges.vary.sizes);
  add_relative(knobs_, delay_knobs(base), ranges.vary.delays);
  add_relative(knobs_, timer_knobs(base), ranges.vary.timers);
  for (const KnobRange& range : ranges.knobs) {
    if (range.key == launch::plan_key) {
      spread_ = range;
    } else {
      knobs_.push_back(range);
    }
  }
}

std::optional<Variant> VariantSource::draw(std::uint64_t seed, std::uint64_t number) const {
  Random random = generator(seed, number, Purpose::values);
  Random of_life = generator(seed, number, Purpose::life);
  for (std::uint32_t rejected = 0; rejected < most_draws; ++rejected) {
    Variant variant{base_, rejected};
    model::Scenario& scenario = variant.scenario;
    scenario.vary.reset();
    if (ranges_.schedule) scenario.deployment.draw_schedule(random());
    if (spread_) {
      const bool is_host = between(random, 0, 1) == 1;
      const model::Nanoseconds step{between(random, spread_->low, spread_->high)};
      launch::follow({is_host ? launch::Order::by_host : launch::Order::by_process, step},
                     base_.deployment, scenario);
    }
    scenario.deployment.schedule.reset();
    for (model::Participant& participant : scenario.deployment.participants) {
      if (!ranges_.vary.start_jitter) break;
      const model::Nanoseconds later{between(random, 0, ranges_.vary.start_jitter->count())};
      participant.start += later;
      participant.endpoints_done += later;
    }
    Fate{of_life, ranges_.vary, scenario.deployment}.draw();
    bool in_range = true;
    for (const KnobRange& knob : knobs_) {
      const std::int64_t value = between(random, knob.low, knob.high);
      in_range = model::config::set_numeric_knob(scenario, knob.key, value) && in_range;
    }
    if (in_range && model::config::is_valid(scenario)) return variant;
  }
  return std::nullopt;
}

std::vector<std::uint64_t> VariantSource::losses(std::uint64_t seed, std::uint64_t number,
                                                 std::uint64_t packets) const {
  std::vector<std::uint64_t> lost;
  if (!ranges_.vary.loss) return lost;
  const auto numerator = static_cast<std::uint64_t>(ranges_.vary.loss->numerator);
  const auto denominator = static_cast<std::uint64_t>(ranges_.vary.loss->denominator);
  Random random = generator(seed, number, Purpose::losses);
  for (std::uint64_t packet = 0; packet < packets; ++packet) {
    if (random() % denominator < numerator) lost.push_back(packet);
  }
  return lost;
}

}  // namespace stormproof::fuzz
