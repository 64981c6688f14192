// Visits the knob tables of the profiles twice, in the scenario and in the base, and pairs what it
// finds; members of lists, whose number differs, get their base from the profile.
#include "props/generators/knob_access.hpp"

#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/knobs/wireless_knobs.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;
using model::Quantity;
using model::Scenario;
using model::config::FractionParts;
using model::config::ListSize;
using model::config::Presence;
using model::config::visit_knobs;

// A fraction as one integer; no denominator comes near the factor.
constexpr std::int64_t fraction_factor = 1'000'000'000;

/// A place in the table; `is_used` tells whether the implementation has it.
struct Place {
  Knob knob;
  bool is_used = true;
};

class Collector {
 public:
  void knob(std::string_view, auto&& member, const auto& type, std::string_view,
            Presence presence = {}) {
    add(member, type, presence != Presence::of_others);
  }
  template <class Section>
  void section(std::string_view, Section& member, std::string_view, Presence presence = {},
               const auto&... context) {
    if constexpr (!requires { member.has_value(); }) {  // those are not in every scenario
      const bool was_used = is_used_;
      is_used_ = is_used_ && presence != Presence::of_others;
      visit_knobs(*this, member, context...);
      is_used_ = was_used;
    }
  }
  void list(std::string_view, auto&, ListSize, std::string_view, Presence = {}) {}
  void rule(bool, std::string_view, std::string_view) {}

  std::vector<Place> places;

 private:
  template <class Tag>
  void add(Quantity<Tag>& member, const auto& type, bool is_used) {
    const auto kind =
        std::same_as<Quantity<Tag>, Nanoseconds> ? Knob::Kind::duration : Knob::Kind::amount;
    bool may_be_zero = false;
    if constexpr (requires { type.contains(0); }) may_be_zero = type.contains(0);
    push(
        kind, may_be_zero, is_used, [&member] { return member.count(); },
        [&member](std::int64_t value) { member = Quantity<Tag>{value}; });
  }
  void add(std::uint32_t& member, const auto& type, bool is_used) {
    push(
        Knob::Kind::amount, type.contains(0), is_used, [&member] { return std::int64_t{member}; },
        [&member](std::int64_t value) { member = static_cast<std::uint32_t>(value); });
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(Enum& member, const auto&, bool is_used) {
    push(
        Knob::Kind::choice, false, is_used, [&member] { return static_cast<std::int64_t>(member); },
        [&member](std::int64_t value) { member = static_cast<Enum>(value); });
  }
  void add(FractionParts<std::int64_t>& parts, const auto&, bool is_used) {
    std::int64_t* const numerator = &parts.numerator;
    std::int64_t* const denominator = &parts.denominator;
    push(
        Knob::Kind::choice, false, is_used,
        [=] { return *numerator * fraction_factor + *denominator; },
        [=](std::int64_t value) {
          *numerator = value / fraction_factor;
          *denominator = value % fraction_factor;
        });
  }
  void add(std::array<model::Bytes, 2>& pair, const auto& type, bool is_used) {
    for (model::Bytes& member : pair) add(member, type.number, is_used);
  }
  template <class Tag>
  void add(std::optional<Quantity<Tag>>& member, const auto& type, bool) {
    if (member) add(*member, type, true);
  }
  // Another implementation has other knobs: it changes with the whole profile only.
  void add(model::ImplementationKind&, const auto&, bool) {}
  // Text is no number, and the set of lost packets has edits of its own.
  void add(std::string&, const auto&, bool) {}
  void add(std::vector<std::uint64_t>&, const auto&, bool) {}
  // What no run depends on.
  void add(std::map<std::string, std::string>&, const auto&, bool) {}

  void push(Knob::Kind kind, bool may_be_zero, bool is_used, auto get, auto set) {
    places.push_back({{kind, may_be_zero, 0, std::move(get), std::move(set)}, is_used_ && is_used});
  }

  bool is_used_ = true;
};

void add_table(auto& scenario_part, auto base_part, std::vector<Knob>& knobs) {
  Collector of_scenario;
  Collector of_base;
  visit_knobs(of_scenario, scenario_part);
  visit_knobs(of_base, base_part);
  for (std::size_t k = 0; k < of_scenario.places.size(); ++k) {
    Place& place = of_scenario.places[k];
    place.knob.base = of_base.places[k].knob.get();
    if (place.is_used) knobs.push_back(std::move(place.knob));
  }
}

Knob duration(Nanoseconds& member, Nanoseconds base) {
  return {Knob::Kind::duration, true, base.count(), [&member] { return member.count(); },
          [&member](std::int64_t value) { member = Nanoseconds{value}; }};
}

/// A stage as if it had no overrides; its own numbers have edits of their own.
void add_stages(Scenario& scenario, const Scenario& base, std::vector<Knob>& knobs) {
  for (model::Stage& stage : scenario.wireless.stages) {
    model::Stage plain = stage;
    const model::WirelessProfile& profile = base.wireless;
    plain.multicast_as = model::MulticastAs::unicast;
    if (plain.overhead_unicast) plain.overhead_unicast = profile.overhead_unicast;
    if (plain.overhead_multicast) plain.overhead_multicast = profile.overhead_multicast;
    if (plain.rate_unicast) plain.rate_unicast = profile.rate_unicast;
    if (plain.rate_multicast) plain.rate_multicast = profile.rate_multicast;
    add_table(stage, plain, knobs);
  }
}

/// Start and, apart from it, the time that creating the endpoints takes.
void add_participant(model::Participant& p, Nanoseconds start, Nanoseconds creation,
                     std::vector<Knob>& knobs) {
  knobs.push_back({Knob::Kind::duration, true, start.count(), [&p] { return p.start.count(); },
                   [&p](std::int64_t value) {
                     const Nanoseconds shift = Nanoseconds{value} - p.start;
                     p.endpoints_done += shift;
                     if (p.open) p.open = std::min(*p.open, Nanoseconds{value});
                     if (p.ready) p.ready = *p.ready + shift;
                     p.start = Nanoseconds{value};
                   }});
  knobs.push_back({Knob::Kind::duration, true, creation.count(),
                   [&p] { return (p.endpoints_done - p.start).count(); },
                   [&p](std::int64_t value) { p.endpoints_done = p.start + Nanoseconds{value}; }});
}

}  // namespace

std::vector<Knob> knobs_of(Scenario& scenario, const Scenario& base) {
  std::vector<Knob> knobs;
  add_table(scenario.dds, base.dds, knobs);
  add_table(scenario.wireless, base.wireless, knobs);
  if (scenario.wireless.stages != base.wireless.stages) add_stages(scenario, base, knobs);
  for (model::PacketDelay& delay : scenario.wireless.packet_delays) {
    knobs.push_back(duration(delay.leaves_after, Nanoseconds{0}));
    knobs.push_back(duration(delay.one_way, base.wireless.one_way));
  }
  const auto& of_base = base.deployment.participants;
  auto& participants = scenario.deployment.participants;
  const bool is_paired = of_base.size() == participants.size();
  for (std::size_t k = 0; k < participants.size(); ++k) {
    const model::Participant target = is_paired ? of_base[k] : model::Participant{};
    add_participant(participants[k], target.start, target.endpoints_done - target.start, knobs);
  }
  knobs.push_back(duration(scenario.deployment.loopback_delay, base.deployment.loopback_delay));
  if (scenario.deployment.send_time) {
    knobs.push_back(duration(*scenario.deployment.send_time, base.deployment.time_to_send()));
  }
  knobs.push_back(duration(scenario.time_limit, base.time_limit));
  knobs.back().may_be_zero = false;
  knobs.push_back({Knob::Kind::choice, false, static_cast<std::int64_t>(base.run_until),
                   [&scenario] { return static_cast<std::int64_t>(scenario.run_until); },
                   [&scenario](std::int64_t value) {
                     scenario.run_until = static_cast<model::RunUntil>(value);
                   }});
  return knobs;
}

}  // namespace stormproof::props
