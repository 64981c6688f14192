// The tables of hosts, access points and processors. See knobs.hpp for what visits them.
#pragma once

#include <optional>
#include <string>

#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/knobs/knobs.hpp"
#include "model/config/knobs/value_types.hpp"
#include "model/deployment.hpp"
#include "model/host.hpp"

namespace stormproof::model::config {

template <>
inline constexpr std::array<std::string_view, 2> enum_names<Link>{"wireless", "wired"};

void visit_knobs(auto& visit, Is<PowerSave> auto& power_save) {
  visit.knob("beacon_interval", power_save.beacon_interval, period_range,
             "between two beacons of its access point; what it has for the station waits for one; "
             "102.4ms if absent",
             Presence::optional);
  visit.knob("dtim", power_save.dtim, count_range(1, 255),
             "multicast waits for each so-manieth beacon; 1 if absent", Presence::optional);
}

void visit_knobs(auto& visit, Is<Processor> auto& processor) {
  visit.knob("cores", processor.cores, count_range(1, 1'024),
             "participants of a host that run at the same time");
  visit.knob("reception", processor.reception, delay_range, "for each datagram received");
  visit.knob("emission", processor.emission, delay_range, "for each datagram sent");
  visit.knob("submessage", processor.submessage, delay_range,
             "for each DATA, HEARTBEAT or ACKNACK in a datagram, received or sent");
  visit.knob("timer", processor.timer, delay_range,
             "for whatever else a participant does when it is due");
  visit.knob("deaf", RangeParts{processor.deaf_min, processor.deaf_max},
             DurationRangeType{delay_range},
             "range of how long a participant hears nothing after it has started; it hears at once "
             "if absent",
             Presence::optional);
  visit.knob("deaf_seed", processor.deaf_seed, SeedType{}, "of these draws; 0 if absent",
             Presence::optional);
}

inline constexpr std::string_view hosts_key = "hosts";
inline constexpr std::string_view access_points_key = "access_points";
inline constexpr std::string_view rate_key = "rate";
inline constexpr std::string_view access_point_key = "access_point";
inline constexpr std::string_view power_save_key = "power_save";
inline constexpr std::string_view name_key = "name";
inline constexpr std::string_view own_profile_key = "dds";  ///< of a host or a participant

void visit_knobs(auto& visit, Is<Host> auto& host) {
  visit.knob(name_key, host.name, TextType{}, "name in reports and errors");
  visit.knob("link", host.link, UsualChoiceType<Link>{{}, Link::wireless},
             "a station of an access point, as it is if absent, or a host on the cable behind all "
             "of them",
             Presence::optional);
  visit.knob(rate_key, host.rate, rate_range,
             "of unicast frames to and from the station, in place of the profile's rates",
             Presence::optional);
  visit.knob(access_point_key, host.access_point, TextType{},
             "name of the station's access point; the first one if absent", Presence::optional);
  visit.section(power_save_key, host.power_save, "a station that sleeps between beacons",
                Presence::optional);
  visit.section(own_profile_key, host.dds,
                "DDS profile of its participants that have none of their own; that of the scenario "
                "if absent",
                Presence::optional);
  const bool wired = host.link == Link::wired;  // known only now
  visit.rule(!wired || !host.rate, rate_key, "no such key, or link: wireless");
  visit.rule(!wired || !host.access_point, access_point_key, "no such key, or link: wireless");
  visit.rule(!wired || !host.power_save, power_save_key, "no such key, or link: wireless");
}

void visit_knobs(auto& visit, Is<AccessPoint> auto& access_point) {
  visit.knob(name_key, access_point.name, TextType{}, "name, for hosts and errors");
  visit.knob("channel", access_point.channel, TextType{},
             "access points with the same channel share its airtime");
}

/// What is wrong with the hosts or access points of a deployment beyond their tables.
struct FleetFault {
  std::string_view list;  ///< `hosts_key` or `access_points_key`
  std::size_t item = 0;   ///< in it; the list itself if there is none
  std::string_view key;   ///< of the item
  std::string expected;
};
[[nodiscard]] std::optional<FleetFault> fault_of_fleet(const Deployment& deployment);

/// The hosts of a deployment in the form with a list, and what they hang on.
void visit_fleet_knobs(auto& visit, Is<Deployment> auto& deployment) {
  visit.list(access_points_key, deployment.access_points, ListSize{0, Deployment::max_participants},
             "the access points on one distribution system; one if absent", Presence::optional);
  visit.knob("wired_delay", deployment.wired_delay, period_range,
             "between a wired host and the distribution system; 50us if absent",
             Presence::optional);
}

}  // namespace stormproof::model::config
