// Finds the numeric knobs by visiting the tables of the two profiles. Keys that only the other
// implementation or the other kind of service has are marked as such by the tables (`of_others`, or
// optional although the member always has a value) and passed over: nothing depends on them.
#include "model/config/knobs/numeric_knobs.hpp"

#include <concepts>

#include <fmt/format.h>

#include "model/config/knobs/scenario_knobs.hpp"

namespace stormproof::model::config {
namespace {

/// What `count` reads and `set` writes: a quantity or an integer.
template <class Tag>
std::int64_t count(const Quantity<Tag>& value) {
  return value.count();
}
std::int64_t count(std::integral auto value) { return static_cast<std::int64_t>(value); }

template <class Tag>
void set(Quantity<Tag>& value, std::int64_t count) {
  value = Quantity<Tag>{count};
}
template <std::integral Integer>
void set(Integer& value, std::int64_t count) {
  value = static_cast<Integer>(count);
}

NumericKnob::Unit unit_of(const NumberType& type) {
  switch (type.unit()) {
    case NumberType::Unit::nanoseconds:
      return NumericKnob::Unit::nanoseconds;
    case NumberType::Unit::bits_per_second:
      return NumericKnob::Unit::bits_per_second;
    case NumberType::Unit::bytes:
      return NumericKnob::Unit::bytes;
    case NumberType::Unit::things:
      break;
  }
  return NumericKnob::Unit::things;
}

/// Calls `use(key, member, number type, doc)` for each numeric knob of a table.
template <class Use>
class NumericVisitor {
 public:
  NumericVisitor(std::string prefix, Use& use) : prefix_{std::move(prefix)}, use_{use} {}

  template <class Member, class Type>
  void knob(std::string_view key, Member&& member, const Type& type, std::string_view doc,
            Presence presence = Presence::required) {
    if (presence == Presence::of_others) return;
    if constexpr (requires { member.has_value(); }) {
      if (member) knob(key, *member, type, doc);
    } else if (presence != Presence::optional) {
      number(prefix_ + std::string{key}, member, type, doc);
    }
  }
  void section(std::string_view key, auto& member, std::string_view, Presence presence = {},
               const auto&... context) {
    if (presence == Presence::of_others) return;
    if constexpr (requires { member.has_value(); }) {
      if (member) section(key, *member, {}, presence, context...);
    } else {
      NumericVisitor inner{prefix_ + std::string{key} + ".", use_};
      visit_knobs(inner, member, context...);
    }
  }
  void list(std::string_view key, auto& members, ListSize, std::string_view,
            Presence presence = Presence::required) {
    if (presence != Presence::required) return;
    for (std::size_t k = 0; k < members.size(); ++k) {
      NumericVisitor inner{fmt::format("{}{}.{}.", prefix_, key, k), use_};
      visit_knobs(inner, members[k]);
    }
  }
  void rule(bool, std::string_view, std::string_view) {}

 private:
  template <class Member, class Type>
  void number(const std::string& key, Member& member, const Type& type, std::string_view doc) {
    if constexpr (std::same_as<Type, NumberType>) {
      use_(key, member, type, doc);
    } else if constexpr (std::same_as<Type, BytesOrWordType>) {
      if (member != type.meaning) use_(key, member, type.number, doc);
    } else if constexpr (std::same_as<Type, BytesPairType>) {
      use_(key + ".0", member[0], type.number, doc);
      use_(key + ".1", member[1], type.number, doc);
    }
  }

  std::string prefix_;
  Use& use_;
};

void visit_numbers(auto& scenario, auto use) {
  NumericVisitor dds{fmt::format("{}.", dds_key), use};
  visit_knobs(dds, scenario.dds);
  NumericVisitor wireless{fmt::format("{}.", wireless_key), use};
  visit_knobs(wireless, scenario.wireless);
  if (!scenario.deployment.life) return;
  NumericVisitor life{"deployment.life.", use};
  visit_knobs(life, *scenario.deployment.life);
}

}  // namespace

std::vector<NumericKnob> numeric_knobs(const Scenario& scenario) {
  std::vector<NumericKnob> knobs;
  visit_numbers(scenario, [&](const std::string& key, const auto& member, const NumberType& type,
                              std::string_view doc) {
    knobs.push_back(
        {key, unit_of(type), count(member), type.minimum(), type.maximum(), std::string{doc}});
  });
  return knobs;
}

std::optional<std::int64_t> numeric_knob(const DdsProfile& dds, std::string_view key) {
  std::optional<std::int64_t> value;
  auto use = [&](const std::string& candidate, const auto& member, const NumberType&,
                 std::string_view) {
    if (candidate == key) value = count(member);
  };
  NumericVisitor visitor{"", use};
  visit_knobs(visitor, dds);
  return value;
}

bool set_numeric_knob(Scenario& scenario, std::string_view key, std::int64_t value) {
  bool done = false;
  visit_numbers(scenario, [&](const std::string& candidate, auto& member, const NumberType& type,
                              std::string_view) {
    if (candidate != key || !type.contains(value)) return;
    set(member, value);
    done = true;
  });
  return done;
}

std::string print_quantity(NumericKnob::Unit unit, std::int64_t value) {
  switch (unit) {
    case NumericKnob::Unit::nanoseconds:
      return print_duration(Nanoseconds{value});
    case NumericKnob::Unit::bits_per_second:
      return print_rate(BitsPerSecond{value});
    case NumericKnob::Unit::bytes:
    case NumericKnob::Unit::things:
      break;
  }
  return fmt::to_string(value);
}

}  // namespace stormproof::model::config
