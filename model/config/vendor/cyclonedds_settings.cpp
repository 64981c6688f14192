// From settings to changes of a profile. The announcement period follows from two settings, the
// HEARTBEAT interval from two, multicast from several; all others stand alone.
#include "model/config/vendor/cyclonedds_settings.hpp"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "model/config/knobs/value_types.hpp"
#include "model/config/vendor/addresses.hpp"

namespace stormproof::model::config::vendor {
namespace {

const CycloneOption& option_of(std::string_view path, CycloneVersion version) {
  return *std::ranges::find(cyclone_options(version), path, &CycloneOption::path);
}

CycloneValue usual_value(const CycloneOption& option) {
  if (option.usual.empty()) return {};
  return *parse_cyclone(option.type, option.usual);
}

/// The announcement period that a lease of this length asks for (q_xevent.c): some time before it
/// ends, so that a lost announcement does not end it.
std::int64_t lease_bound(std::int64_t lease) {
  constexpr std::int64_t least = 10'000'000;
  if (lease < 5 * least / 4) return least;
  return lease < 10 * second_ns ? 4 * lease / 5 : lease - 2 * second_ns;
}

class Effects {
 public:
  Effects(const CycloneSettings& settings, VendorProfile& profile)
      : settings_{settings}, profile_{profile} {}

  std::optional<InputError> apply() {
    for (const auto& [path, reading] : settings_.all()) apply_alone(reading);
    apply_announcements();
    apply_heartbeats();
    apply_durations();
    apply_prune_delays();
    apply_message_size();
    return failure_;
  }

 private:
  Setting& setting(const CycloneReading& reading) { return profile_.settings[reading.setting]; }

  void remark(Severity severity, std::string rule, const Place& place, std::string message,
              std::string hint = {}) {
    profile_.remarks.push_back(
        {severity, "cyclonedds." + rule, place, std::move(message), std::move(hint)});
  }

  void fail(const Place& place, std::string message) {
    if (!failure_) failure_ = error_at(place, std::move(message));
  }

  /// `value` of a knob in the syntax of profiles.
  void change(const std::string& key, const Place& place, std::string value) {
    (void)set_path(profile_.changes, key, Node::scalar(place, std::move(value)));
  }

  void change_duration(const std::string& key, const CycloneReading& reading, std::int64_t ns,
                       std::int64_t least) {
    if (ns < least || ns > max_duration_ns || reading.value.word == "inf") {
      fail(
          reading.place,
          fmt::format("{}: {} gives {} {}; expected {} to {}, which is what the "
                      "model takes",
                      reading.option->path, reading.shown, key,
                      reading.value.word == "inf" ? "no end" : print_cyclone_duration(ns),
                      print_cyclone_duration(least), print_duration(Nanoseconds{max_duration_ns})));
      return;
    }
    change(key, reading.place, print_duration(Nanoseconds{ns}));
  }

  /// The same of a delay that may have no end, which is the longest one here.
  void change_delay(const std::string& key, const CycloneReading& reading, std::int64_t least) {
    if (reading.value.word != "inf") {
      return change_duration(key, reading, reading.value.number, least);
    }
    const std::string longest = print_duration(Nanoseconds{max_duration_ns});
    setting(reading).note += fmt::format("; no end is {} here", longest);
    change(key, reading.place, longest);
  }

  /// Leaves a setting that the model has not as an assumption, or says that it is the default.
  void apply_alone(const CycloneReading& reading) {
    const CycloneOption& option = *reading.option;
    if (option.effect == Effect::unmodelled &&
        (option.always || !is_usual(option, reading.value))) {
      assume(profile_, option.path, reading.place,
             fmt::format("{}; {}", reading.shown, option.note));
      return;
    }
    if (option.effect != Effect::unmodelled && option.effect != Effect::outside) return;
    if (!is_usual(option, reading.value)) return;
    setting(reading).effect = Effect::none;
    setting(reading).note = "the default, as in the model";
  }

  /// From 11 on an interval that is set is the period, whatever the lease (spdp_intv in
  /// ddsi_spdp_schedule.c).
  void apply_interval_alone(const CycloneReading& interval) {
    change_duration("spdp.period", interval, interval.value.number, 1);
    const CycloneReading* lease = settings_.find("Discovery/LeaseDuration");
    if (lease == nullptr) return;
    setting(*lease).effect = Effect::none;
    setting(*lease).note = fmt::format(
        "no effect on announcements: SPDPInterval asks for one every {}", interval.shown);
  }

  void apply_announcements() {
    const CycloneReading* interval = settings_.find("Discovery/SPDPInterval");
    const CycloneReading* lease = settings_.find("Discovery/LeaseDuration");
    if (lease != nullptr && !is_usual(*lease->option, lease->value)) {
      change_duration("spdp.lease", *lease, lease->value.number, 1);
    }
    if (interval != nullptr && settings_.version == CycloneVersion::of_11 &&
        interval->value.word != "default") {
      return apply_interval_alone(*interval);
    }
    if (interval == nullptr && lease == nullptr) return;
    constexpr std::int64_t longest = 30 * second_ns;  // `default` of 11, and that of 0.10
    const bool is_default = interval == nullptr || interval->value.word == "default";
    const std::int64_t wanted = is_default ? longest : interval->value.number;
    const std::int64_t bound = lease_bound(settings_.value("Discovery/LeaseDuration").number);
    const CycloneReading* decides = bound < wanted ? lease : interval;
    if (decides == nullptr) decides = interval != nullptr ? interval : lease;  // against a default
    change_duration("spdp.period", *decides, std::min(wanted, bound), 1);
    const std::string shown = print_cyclone_duration(std::min(wanted, bound));
    if (bound < wanted && interval != nullptr && interval->value.word != "default") {
      setting(*interval).effect = Effect::none;
      setting(*interval).note =
          fmt::format("no effect: LeaseDuration asks for announcements every {}", shown);
      const bool is_usual_one = is_usual(*interval->option, interval->value);
      remark(is_usual_one ? Severity::note : Severity::warning, "spdp-interval", interval->place,
             fmt::format("SPDPInterval {} has no effect: with LeaseDuration {} announcements go "
                         "out every {}",
                         interval->shown, settings_.shown("Discovery/LeaseDuration"), shown),
             "set Discovery/LeaseDuration to at least 2 s more than SPDPInterval");
    }
    if (wanted <= bound && lease != nullptr) {
      setting(*lease).effect = Effect::none;
      setting(*lease).note =
          fmt::format("no effect on announcements: SPDPInterval asks for one every {}", shown);
    }
  }

  void apply_heartbeats() {
    constexpr std::string_view base_path = "Internal/HeartbeatInterval";
    constexpr std::string_view least_path = "Internal/HeartbeatInterval[@minsched]";
    const CycloneReading* base = settings_.find(base_path);
    const CycloneReading* least = settings_.find(least_path);
    if (base == nullptr && least == nullptr) return;
    const auto count = [&](std::string_view path) {
      const CycloneValue value = settings_.value(path);
      return value.word == "inf" ? cyclone_longest_ns : value.number;
    };
    const bool is_held = count(least_path) > count(base_path);
    const CycloneReading* cause = is_held ? least : base;
    if (is_held && base != nullptr) {
      remark(Severity::warning, "heartbeat-interval", base->place,
             fmt::format("HeartbeatInterval {} has no effect: minsched holds it at {}", base->shown,
                         settings_.shown(least_path)),
             "set the attribute minsched, too");
    }
    if (is_held && cause == nullptr) cause = base;
    if (cause != nullptr) {
      change_duration("sedp.heartbeat_interval", *cause,
                      std::max(count(least_path), count(base_path)), 1);
    }
  }

  void apply_durations() {
    for (const auto& [path, least] : {std::pair{"Internal/AckDelay", 0},
                                      {"Internal/NackDelay", 0},
                                      {"Internal/PreEmptiveAckDelay", 0},
                                      {"Internal/AutoReschedNackDelay", 1},
                                      {"Internal/HeartbeatInterval[@max]", 1}}) {
      const CycloneReading* delay = settings_.find(path);
      if (delay == nullptr) continue;
      change_delay(std::string{delay->option->knob}, *delay, least);
    }
    if (const CycloneReading* most = settings_.find("Internal/MaxQueuedRexmitMessages")) {
      constexpr std::int64_t enough = 1'000'000;
      change("sedp.max_queued_rexmit_messages", most->place,
             fmt::format("{}", std::min(most->value.number, enough)));
    }
  }

  /// That of all peers, unless they have one of their own, which the model takes if it is the same
  /// one for each of them.
  void apply_prune_delays() {
    constexpr std::string_view initial = "spdp.initial_prune_delay";
    for (const char* path :
         {"Discovery/InitialLocatorPruneDelay", "Discovery/DiscoveredLocatorPruneDelay"}) {
      if (const CycloneReading* delay = settings_.find(path)) prune_after(*delay, path);
    }
    std::vector<const CycloneReading*> own;
    for (const CycloneReading& delay : settings_.prune_delays) {
      if (delay.value.word != "default") own.push_back(&delay);
    }
    if (own.empty()) return;
    const auto is_like_first = [&](const CycloneReading* delay) {
      return delay->value.word == own.front()->value.word &&
             delay->value.number == own.front()->value.number;
    };
    const bool has_each = own.size() == settings_.peers.size();
    if (!has_each || !std::ranges::all_of(own, is_like_first)) {
      return assume(profile_, own.front()->option->path, own.front()->place,
                    fmt::format("{}; {}", own.front()->shown,
                                "peers with different ones; the model has one for all"));
    }
    for (const CycloneReading* delay : own) {
      setting(*delay).effect = Effect::knob;
      setting(*delay).knob = initial;
    }
    prune_after(*own.front(), own.front()->option->path);
  }
  /// An address that is dropped at once is one that is dropped after its first announcement.
  void prune_after(const CycloneReading& delay, std::string_view path) {
    const bool is_discovered = path == "Discovery/DiscoveredLocatorPruneDelay";
    const std::string key =
        is_discovered ? "spdp.discovered_prune_delay" : "spdp.initial_prune_delay";
    if (delay.value.word.empty() && delay.value.number == 0) {
      return change(key, delay.place, print_duration(Nanoseconds{1}));
    }
    change_delay(key, delay, 1);
  }

  void apply_message_size() {
    constexpr std::int64_t largest_datagram = 65'507;
    constexpr std::int64_t unfragmented = 1'472;
    for (const char* path : {"General/MaxMessageSize", "General/MaxRexmitMessageSize"}) {
      const CycloneReading* size = settings_.find(path);
      if (size == nullptr || size->value.number <= largest_datagram) continue;
      remark(Severity::warning, "message-size", size->place,
             fmt::format("{} {}: no UDP packet holds more than {} B", path, size->shown,
                         largest_datagram),
             "set 65500 B or less");
    }
    for (const char* path : {"General/MaxMessageSize", "General/MaxRexmitMessageSize"}) {
      const CycloneReading* size = settings_.find(path);
      if (size == nullptr) continue;
      const auto bytes = std::clamp<std::int64_t>(size->value.number, 1, 1'000'000'000);
      change(std::string{size->option->knob}, size->place, fmt::format("{}", bytes));
    }
    const CycloneReading* limit = settings_.find("General/MaxRexmitMessageSize");
    if (limit == nullptr) return;
    if (limit->value.number > unfragmented && limit->value.number <= largest_datagram) {
      remark(
          Severity::note, "message-size", limit->place,
          fmt::format("MaxRexmitMessageSize {}: packets over {} B are sent in IP fragments where "
                      "the MTU is 1500, and one lost fragment loses the packet",
                      limit->shown, unfragmented));
    }
  }

  const CycloneSettings& settings_;
  VendorProfile& profile_;
  std::optional<InputError> failure_;
};

}  // namespace

void assume(VendorProfile& profile, std::string_view setting, const Place& place,
            std::string text) {
  Node* map = profile.changes.find("unmodelled");
  if (map == nullptr) {
    profile.changes.members.push_back({"unmodelled", place, Node{}});
    map = &profile.changes.members.back().value;
    map->kind = Node::Kind::map;
    map->place = place;
  }
  Node value = Node::scalar(place, std::move(text));
  if (Node* old = map->find(setting)) {
    *old = std::move(value);
  } else {
    map->members.push_back({std::string{setting}, place, std::move(value)});
  }
}

void CycloneSettings::add(CycloneReading reading) {
  const std::string_view path = reading.option->path;
  readings_.insert_or_assign(path, std::move(reading));
}

const CycloneReading* CycloneSettings::find(std::string_view path) const {
  const auto found = readings_.find(path);
  return found == readings_.end() ? nullptr : &found->second;
}

CycloneValue CycloneSettings::value(std::string_view path) const {
  const CycloneReading* reading = find(path);
  return reading != nullptr ? reading->value : usual_value(option_of(path, version));
}

std::string CycloneSettings::shown(std::string_view path) const {
  return print_cyclone(option_of(path, version).type, value(path));
}

namespace {

/// Whether announcements go by multicast with these words of AllowMulticast.
bool announces(std::string_view words) {
  const auto has = [words](std::string_view word) {
    return words.find(word) != std::string_view::npos;
  };
  return has("spdp") || has("true") || has("default");
}

bool is_off(const std::optional<CycloneReading>& multicast) {
  return multicast && multicast->value.word == "false";
}

}  // namespace

Announcing CycloneSettings::announcing() const {
  const bool by_default = announces(value("General/AllowMulticast").word);
  std::size_t silent = 0;
  for (const CycloneInterface& one : interfaces) {
    const bool is_own = one.allow_multicast && one.allow_multicast->value.word != "default";
    const bool sends = is_own ? announces(one.allow_multicast->value.word) : by_default;
    if (is_off(one.multicast) || !sends) ++silent;
  }
  if (interfaces.empty()) return by_default ? Announcing::everywhere : Announcing::nowhere;
  if (silent == 0) return Announcing::everywhere;
  // 0.10 has one AllowMulticast for all, and switches it off for one interface (q_init.c).
  const bool for_all = silent == interfaces.size() || version == CycloneVersion::of_0_10;
  return for_all ? Announcing::nowhere : Announcing::somewhere;
}

const CycloneReading* CycloneSettings::silencer() const {
  if (announcing() == Announcing::everywhere) return nullptr;
  for (const CycloneInterface& one : interfaces) {
    if (is_off(one.multicast)) return &*one.multicast;
    const bool is_own = one.allow_multicast && one.allow_multicast->value.word != "default";
    if (is_own && !announces(one.allow_multicast->value.word)) return &*one.allow_multicast;
  }
  return find("General/AllowMulticast");
}

std::string CycloneSettings::participant_index() const {
  const auto has_no_multicast = [](const CycloneInterface& one) { return is_off(one.multicast); };
  const bool is_allowed = value("General/AllowMulticast").word != "false";
  if (version == CycloneVersion::of_0_10 && is_allowed &&
      std::ranges::any_of(interfaces, has_no_multicast)) {
    return "auto";  // "ensure discovery can work", q_init.c
  }
  const std::string word = value("Discovery/ParticipantIndex").word;
  if (word != "default") return word;
  // decide_participant_index_and_add_localhost_to_peers in ddsi_init.c
  return announcing() == Announcing::everywhere && peers.empty() ? "none" : "auto";
}

std::optional<std::int64_t> CycloneSettings::ports_of_peers() const {
  const auto is_host = [](const CycloneReading& peer) {
    const std::string& list = peer.value.word;
    return list.find_first_of(",:[") == std::string::npos && why_no_address(list).empty();
  };
  if (peers.empty() || !std::ranges::all_of(peers, is_host)) return std::nullopt;
  const std::int64_t most = value("Discovery/MaxAutoParticipantIndex").number;
  // Up to the most in 11 (ddsi_spdp_schedule.c), below it in 0.10 (q_addrset.c), where the first
  // one is always asked.
  return version == CycloneVersion::of_11 ? most + 1 : std::max<std::int64_t>(most, 1);
}

std::optional<std::int64_t> CycloneSettings::participants_of_a_host() const {
  const std::string index = participant_index();
  if (index == "none") return std::nullopt;
  if (index.empty()) return 1;  // the port of the next one is taken
  // The index after the one that was found is compared with the most, so the last is never taken
  // (q_init.c, ddsi_init.c).
  return std::max<std::int64_t>(value("Discovery/MaxAutoParticipantIndex").number, 1);
}

std::string print_cyclone(const CycloneType& type, const CycloneValue& value) {
  if (!value.word.empty()) return value.word;
  if (type.kind == CycloneKind::text) return quote(value.word);
  if (type.kind == CycloneKind::duration) return print_cyclone_duration(value.number);
  return type.kind == CycloneKind::size ? fmt::format("{} B", value.number)
                                        : fmt::format("{}", value.number);
}

bool is_usual(const CycloneOption& option, const CycloneValue& value) {
  const CycloneValue usual = usual_value(option);
  return usual.number == value.number && usual.word == value.word;
}

std::optional<InputError> apply_cyclone_settings(const CycloneSettings& settings,
                                                 VendorProfile& profile) {
  profile.changes.kind = Node::Kind::map;
  std::optional<InputError> failure = Effects{settings, profile}.apply();
  apply_cyclone_network(settings, profile);
  look_for_contradictions(settings, profile);
  return failure;
}

}  // namespace stormproof::model::config::vendor
