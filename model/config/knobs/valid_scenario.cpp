// Holds a scenario in memory against the tables: the ranges and rules that the reader enforces,
// without a text. Whoever changes scenarios (fuzzing, generators, shrinking) asks this after each
// change.
#include <algorithm>
#include <concepts>
#include <numeric>

#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/knobs/scenario_knobs.hpp"

namespace stormproof::model::config {
namespace {

template <class Tag>
bool accepts(const NumberType& type, const Quantity<Tag>& value) {
  return type.contains(value.count());
}
template <std::integral Integer>
bool accepts(const NumberType& type, Integer value) {
  return std::in_range<std::int64_t>(value) && type.contains(static_cast<std::int64_t>(value));
}
bool accepts(const SeedType&, std::uint64_t) { return true; }
bool accepts(const BytesOrWordType& type, Bytes value) {
  return value == type.meaning || accepts(type.number, value);
}
template <class Enum>
bool accepts(const ChoiceType<Enum>&, Enum value) {
  return static_cast<std::size_t>(value) < enum_names<Enum>.size();
}
bool accepts(const TextType&, const std::string& value) {
  const auto is_control = [](char c) { return (c >= 0 && c < 0x20) || c == 0x7f; };
  return !value.empty() && std::ranges::none_of(value, is_control);
}
bool accepts(const TextMapType&, const std::map<std::string, std::string>& value) {
  return std::ranges::all_of(value,
                             [](const auto& entry) { return accepts(TextType{}, entry.second); });
}
bool accepts(const RatioType& type, const Ratio& value) {
  return value.numerator > 0 && value.denominator > 0 &&
         value.denominator <= type.max_denominator &&
         value.numerator <= type.maximum * value.denominator &&
         std::gcd(value.numerator, value.denominator) == 1;
}
bool accepts(const FractionType& type, FractionParts<const std::int64_t> value) {
  return accepts(RatioType{1, type.max_denominator}, Ratio{value.numerator, value.denominator});
}
bool accepts(const BytesPairType& type, const std::array<Bytes, 2>& value) {
  return accepts(type.number, value[0]) && accepts(type.number, value[1]);
}
bool accepts(const DurationRangeType& type, RangeParts<const Nanoseconds> value) {
  return accepts(type.number, value.low) && accepts(type.number, value.high) &&
         value.low <= value.high;
}
bool accepts(const NumberSetType& type, const std::vector<std::uint64_t>& value) {
  const auto fits = [&](std::uint64_t number) { return accepts(type.number, number); };
  return std::ranges::all_of(value, fits) &&
         std::ranges::adjacent_find(value, std::greater_equal<>{}) == value.end();
}

/// What the reader asks for beyond the table.
bool is_consistent(const auto&) { return true; }
bool is_consistent(const Participant& participant) {
  return participant.endpoints_done >= participant.start &&
         participant.open.value_or(participant.start) <= participant.start &&
         participant.ready.value_or(participant.start) >= participant.start;
}
bool is_consistent(const WirelessProfile& wireless) {
  const auto out_of_order = [](const PacketDelay& a, const PacketDelay& b) {
    return a.packet >= b.packet;
  };
  return std::ranges::adjacent_find(wireless.packet_delays, out_of_order) ==
         wireless.packet_delays.end();
}
/// Times beside a schedule have to be the drawn ones.
bool is_consistent(const Deployment& deployment) {
  if (fault_of_fleet(deployment)) return false;
  if (!deployment.schedule) return true;
  Deployment drawn = deployment;
  drawn.draw_schedule(deployment.schedule->seed);
  return drawn == deployment;
}

class Validator {
 public:
  void knob(std::string_view, const auto& member, const auto& type, std::string_view,
            Presence presence = {}) {
    if (presence == Presence::of_others) return;
    if constexpr (requires { member.has_value(); }) {
      if (member) valid = valid && accepts(type, *member);
    } else {
      valid = valid && accepts(type, member);
    }
  }
  void section(std::string_view, const auto& member, std::string_view, Presence presence = {},
               const auto&... context) {
    if (presence == Presence::of_others) return;
    if constexpr (requires { member.has_value(); }) {
      if (member) table(*member, context...);
    } else {
      table(member, context...);
    }
  }
  void list(std::string_view, const auto& members, ListSize size, std::string_view,
            Presence presence = {}) {
    if (presence == Presence::optional && members.empty()) return;  // it need not be there
    valid = valid && members.size() >= size.minimum && members.size() <= size.maximum;
    for (const auto& member : members) table(member);
  }
  void rule(bool holds, std::string_view, std::string_view) { valid = valid && holds; }

  void table(const auto& member, const auto&... context) {
    if (!valid) return;
    visit_knobs(*this, member, context...);
    valid = valid && is_consistent(member);
  }

  bool valid = true;
};

}  // namespace

bool is_valid(const Scenario& scenario) {
  Validator validator;
  // The rules of the whole compute with the parts, so the parts have to be within their ranges.
  validator.table(scenario.deployment);
  validator.table(scenario.dds);
  validator.table(scenario.wireless);
  validator.table(scenario);
  return validator.valid;
}

}  // namespace stormproof::model::config
