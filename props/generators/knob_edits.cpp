// Knobs back to their base, many at a time first; then rounder numbers, for equal durations
// together, so that ties survive.
#include <map>
#include <set>

#include "props/generators/edits.hpp"
#include "props/generators/knob_access.hpp"

namespace stormproof::props {

namespace {

using model::Scenario;
using Places = std::vector<std::size_t>;

// Beyond it, rounding up may leave 64 bits.
constexpr std::int64_t largest_rounded = 1'000'000'000'000'000'000;

std::int64_t power_of_ten(int exponent) {
  std::int64_t power = 1;
  for (; exponent > 0; --exponent) power *= 10;
  return power;
}

int exponent_of(std::int64_t value) {
  int exponent = 0;
  for (; value >= 10; value /= 10) ++exponent;
  return exponent;
}

/// Powers of ten from the base's order of magnitude to the value's, and the one above them.
void add_powers(std::int64_t value, std::int64_t base, std::vector<std::int64_t>& numbers) {
  const int from = exponent_of(std::min(base, largest_rounded));
  const int to = exponent_of(std::min(value, largest_rounded));
  const int step = from <= to ? 1 : -1;
  for (int exponent = from; exponent != to + step; exponent += step) {
    numbers.push_back(power_of_ten(exponent));
  }
  if (std::max(from, to) < 18) numbers.push_back(power_of_ten(std::max(from, to) + 1));
}

/// Numbers that are rounder than `value`, boldest first.
std::vector<std::int64_t> rounder(std::int64_t value, std::int64_t base, bool may_be_zero) {
  std::vector<std::int64_t> numbers;
  if (may_be_zero) numbers.push_back(0);
  add_powers(value, base, numbers);
  if (value < largest_rounded) {
    for (std::int64_t unit = power_of_ten(exponent_of(value)); unit > 0; unit /= 10) {
      const std::int64_t down = value / unit * unit;
      if (unit == power_of_ten(exponent_of(value))) {
        for (const std::int64_t digit : {2, 5}) numbers.push_back(digit * unit);
        if (down > unit) numbers.push_back(down - unit);
      }
      numbers.push_back(down);
      numbers.push_back(down + unit);
    }
  }
  std::erase_if(numbers, [&](std::int64_t number) {
    return (number == 0 && !may_be_zero) || number_cost(number, base) >= number_cost(value, base);
  });
  return numbers;
}

void set_all(Scenario& scenario, const Scenario& base, const Places& places, std::int64_t value) {
  const std::vector<Knob> knobs = knobs_of(scenario, base);
  for (const std::size_t place : places) knobs[place].set(value);
}

/// All changed durations to multiples of a unit.
void add_common_units(const Scenario& base, Edits& edits) {
  for (int exponent = 9; exponent >= 1; --exponent) {
    edits.push_back([&base, unit = power_of_ten(exponent)](Scenario& s) {
      for (const Knob& knob : knobs_of(s, base)) {
        if (knob.kind != Knob::Kind::duration || !knob.is_changed()) continue;
        const std::int64_t rounded = knob.get() / unit * unit;
        if (rounded > 0 || knob.may_be_zero) knob.set(rounded);
      }
    });
  }
}

}  // namespace

void add_reset_edits(const Scenario& scenario, const Scenario& base, Edits& edits) {
  Scenario copy = scenario;
  const std::vector<Knob> knobs = knobs_of(copy, base);
  Places changed;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    if (knobs[k].is_changed()) changed.push_back(k);
  }
  for_parts(changed.size(), [&](std::size_t first, std::size_t last) {
    const Places part(changed.begin() + static_cast<std::ptrdiff_t>(first),
                      changed.begin() + static_cast<std::ptrdiff_t>(last));
    edits.push_back([&base, part](Scenario& s) {
      const std::vector<Knob> all = knobs_of(s, base);
      for (const std::size_t place : part) all[place].set(all[place].base);
    });
  });
}

void add_rounding_edits(const Scenario& scenario, const Scenario& base, Edits& edits) {
  Scenario copy = scenario;
  const std::vector<Knob> knobs = knobs_of(copy, base);
  std::map<std::int64_t, Places> equal;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    if (knobs[k].kind == Knob::Kind::duration && knobs[k].is_changed()) {
      equal[knobs[k].get()].push_back(k);
    }
  }
  add_common_units(base, edits);
  const std::size_t most = edits.size() + most_edits;
  const auto add = [&](const Places& places) {
    const Knob& first = knobs[places.front()];
    for (const std::int64_t number : rounder(first.get(), first.base, first.may_be_zero)) {
      edits.push_back([&base, places, number](Scenario& s) { set_all(s, base, places, number); });
    }
  };
  for (const auto& [value, places] : equal) {
    if (places.size() > 1 && edits.size() < most) add(places);
  }
  for (std::size_t k = 0; k < knobs.size() && edits.size() < most; ++k) {
    if (knobs[k].kind != Knob::Kind::choice && knobs[k].is_changed()) add({k});
  }
}

}  // namespace stormproof::props
