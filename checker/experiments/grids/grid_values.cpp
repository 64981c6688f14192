// The values of one axis: a list, or a range that is counted out exactly, in integers of its unit.
#include <array>
#include <limits>

#include <fmt/format.h>

#include "checker/experiments/grids/grid.hpp"
#include "model/config/knobs/knob_reader.hpp"
#include "model/config/tree/quantities.hpp"

namespace stormproof::grids {

namespace config = model::config;
using config::error_at;
using config::InputError;
using config::Node;
using config::Result;

namespace {

/// What the numbers of a range can be, and how each is read and written.
struct RangeUnit {
  std::optional<std::int64_t> (*read)(std::string_view text);
  std::string (*write)(std::int64_t value);
};

template <class T>
std::optional<std::int64_t> count_of(const config::Parsed<T>& parsed) {
  if (!parsed) return std::nullopt;
  return parsed->count();
}

constexpr std::array<RangeUnit, 3> range_units{{
    {[](std::string_view text) -> std::optional<std::int64_t> {
       const auto parsed = config::parse_count(text);
       return parsed ? std::optional{*parsed} : std::nullopt;
     },
     [](std::int64_t value) { return fmt::to_string(value); }},
    {[](std::string_view text) { return count_of(config::parse_duration(text)); },
     [](std::int64_t value) { return config::print_duration(model::Nanoseconds{value}); }},
    {[](std::string_view text) { return count_of(config::parse_rate(text)); },
     [](std::int64_t value) { return config::print_rate(model::BitsPerSecond{value}); }},
}};

constexpr const char* expected_range =
    "a range {from, to, step} of counts, durations or rates, such as {from: 1, to: 6} or "
    "{from: 500ms, to: 2s, step: 500ms}";

/// A missing step is the text "1".
std::optional<InputError> append_range(const Node& range, const std::string& key,
                                       std::vector<Axis::Value>& values) {
  if (auto error = config::check_keys(range, key, {{"from", "to", "step"}, {}})) return error;
  const Node* ends[] = {range.find("from"), range.find("to"), range.find("step")};
  if (ends[0] == nullptr || ends[1] == nullptr) {
    return error_at(range.place, fmt::format("{}: a map without {}; expected {}", key,
                                             ends[0] == nullptr ? "from" : "to", expected_range));
  }
  for (const RangeUnit& unit : range_units) {
    std::array<std::optional<std::int64_t>, 3> parts;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const bool is_text = ends[k] != nullptr && ends[k]->is_scalar();
      if (is_text) parts[k] = unit.read(ends[k]->text);
      if (ends[k] == nullptr && &unit == &range_units.front()) parts[k] = 1;
    }
    const auto [from, to, step] = parts;
    if (!from || !to || !step) continue;
    if (*from > *to || *step < 1) {
      return error_at(range.place,
                      fmt::format("{}: from {} to {} in steps of {}; expected a first "
                                  "value of at most the last one, and a positive step",
                                  key, unit.write(*from), unit.write(*to), unit.write(*step)));
    }
    if ((*to - *from) / *step >= static_cast<std::int64_t>(max_jobs)) {
      return error_at(range.place, fmt::format("{}: {} values; expected at most {}", key,
                                               (*to - *from) / *step + 1, max_jobs));
    }
    for (std::int64_t value = *from;; value += *step) {
      const std::string text = unit.write(value);
      values.push_back({text, Node::scalar(range.place, text)});
      if (value > *to - *step) return std::nullopt;
    }
  }
  return error_at(range.place,
                  fmt::format("{}: {}; expected {}", key, flow_text(range), expected_range));
}

bool is_range(const Node& node) {
  return node.is_map() && (node.find("from") != nullptr || node.find("to") != nullptr);
}

}  // namespace

std::string flow_text(const Node& node) {
  std::string text;
  switch (node.kind) {
    case Node::Kind::null:
      return "null";
    case Node::Kind::scalar:
      return node.text;
    case Node::Kind::sequence:
      for (const Node& item : node.items) text += (text.empty() ? "" : ", ") + flow_text(item);
      return "[" + text + "]";
    case Node::Kind::map:
      for (const config::Member& member : node.members) {
        text += (text.empty() ? "" : ", ") + member.key + ": " + flow_text(member.value);
      }
      return "{" + text + "}";
  }
  return text;
}

Result<std::vector<Axis::Value>> read_values(const Node& node, const std::string& key) {
  std::vector<Axis::Value> values;
  std::optional<InputError> error;
  if (node.is_map()) {
    error = append_range(node, key, values);
  } else if (node.is_sequence() && !node.items.empty()) {
    for (const Node& item : node.items) {
      if (error) break;
      if (is_range(item)) {
        error = append_range(item, key, values);
      } else {
        values.push_back({flow_text(item), item});
      }
    }
  } else {
    const std::string shown = node.is_sequence() ? "an empty list" : node.shown();
    error = error_at(node.place, fmt::format("{}: {}; expected a list of values, or {}", key, shown,
                                             expected_range));
  }
  if (error) return *std::move(error);
  return values;
}

}  // namespace stormproof::grids
