// Words that the two parts of the table of Cyclone DDS's settings are written with.
#pragma once

#include "model/config/vendor/cyclonedds_options.hpp"

namespace stormproof::model::config::vendor::cyclone {

inline constexpr std::int64_t hour_ns = 3'600'000'000'000;
inline constexpr std::int64_t second = 1'000'000'000;

inline constexpr CycloneType text_type{};
inline constexpr CycloneType boolean{CycloneKind::boolean};
inline constexpr CycloneType boolean_or_default{CycloneKind::choice, 0, 0, "false,true,default"};
inline constexpr CycloneType natural{CycloneKind::integer, 0, 4'294'967'295};
inline constexpr CycloneType integer{CycloneKind::integer, -2'147'483'648, 2'147'483'647};
inline constexpr CycloneType integer_or_default{CycloneKind::integer, -2'147'483'648, 2'147'483'647,
                                                "default"};
inline constexpr CycloneType size{CycloneKind::size, 0, cyclone_largest_bytes};
inline constexpr CycloneType size_or_default{CycloneKind::size, 0, cyclone_largest_bytes,
                                             "default"};
inline constexpr CycloneType upto_hour{CycloneKind::duration, 0, hour_ns};
inline constexpr CycloneType upto_second{CycloneKind::duration, 0, second};
inline constexpr CycloneType upto_hour_or_default{CycloneKind::duration, 0, hour_ns, "default"};
inline constexpr CycloneType inf_or_default{CycloneKind::duration, 0, cyclone_longest_ns,
                                            "default,inf"};
inline constexpr CycloneType or_inf{CycloneKind::duration, 0, cyclone_longest_ns, "inf"};

constexpr CycloneType choice(std::string_view words) { return {CycloneKind::choice, 0, 0, words}; }
constexpr CycloneType choices(std::string_view words) {
  return {CycloneKind::choices, 0, 0, words};
}
constexpr CycloneType between(std::int64_t low, std::int64_t high, std::string_view words = {}) {
  return {CycloneKind::integer, low, high, words};
}

inline constexpr CycloneHas only_0_10 = CycloneHas::only_0_10;
inline constexpr CycloneHas from_11 = CycloneHas::from_11;

inline constexpr Effect none = Effect::none;
inline constexpr Effect assumed = Effect::unmodelled;
inline constexpr Effect knob = Effect::knob;
inline constexpr std::string_view names =
    "which network interface; a second one adds locators and copies";
inline constexpr std::string_view log = "logging";
inline constexpr std::string_view port = "port numbers";
inline constexpr std::string_view user = "acts on user data only";
inline constexpr std::string_view reorder =
    "reception of DATA out of order; the model takes DATA in any order";
inline constexpr std::string_view throttle = "throttling of writers; the model has none";
inline constexpr std::string_view send_buffer =
    "socket's send buffer; in this model it is source_queue_bytes of the wireless profile";
inline constexpr std::string_view receive_buffer =
    "socket's receive buffer; receivers of the model never drop for lack of buffer";
inline constexpr std::string_view tcp = "acts with the TCP transport only";

/// The settings of the group Internal, where all timers are.
[[nodiscard]] std::span<const CycloneOption> internal_options();

}  // namespace stormproof::model::config::vendor::cyclone
