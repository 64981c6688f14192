// Fuzz target: numbers with units (model/config/tree/quantities.hpp).
#include "model/config/tree/quantities.hpp"

#include "tests/fuzzing/checks.hpp"
#include "tests/fuzzing/targets.hpp"

namespace stormproof::fuzzing {

namespace {

/// Whether `input` is a quantity; what it was read as must survive being written.
template <class Value>
bool reads_back(std::string_view input, model::config::Parsed<Value> (*parse)(std::string_view),
                auto print) {
  const auto value = parse(input);
  if (!value) {
    require(!value.error().empty(), "an error says what is wrong");
    return false;
  }
  const auto again = parse(print(*value));
  require(again && *again == *value, "a quantity reads back as an equal one");
  return true;
}

}  // namespace

Outcome quantities(std::string_view input) {
  using namespace model::config;
  bool accepted = reads_back(input, parse_duration, print_duration);
  accepted |= reads_back(input, parse_rate, print_rate);
  accepted |= reads_back(input, parse_count, [](std::int64_t n) { return std::to_string(n); });
  accepted |= reads_back(input, parse_fraction, print_fraction);
  return accepted ? Outcome::accepted : Outcome::refused;
}

}  // namespace stormproof::fuzzing
