// Writes the inputs as text, by the tables of their knobs, and digests that.
#include "checker/experiments/grids/digest.hpp"

#include <boost/uuid/detail/sha1.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/knobs/scenario_knobs.hpp"
#include "model/config/knobs/value_json.hpp"
#include "model/config/knobs/wireless_knobs.hpp"

namespace stormproof::grids {

namespace {

namespace config = model::config;

/// Writes each key of a knob table with its value: numbers as they are, because JSON takes ten
/// times as long and a grid may have thousands of profiles; what is not a number, as JSON.
class KnobText {
 public:
  void knob(std::string_view key, const auto& member, const auto& type, std::string_view,
            config::Presence presence = {}) {
    if (presence != config::Presence::of_others) value(key, member, type);
  }
  template <class Section>
  void section(std::string_view key, const Section& member, std::string_view,
               config::Presence presence = {}, const auto&... context) {
    if (presence == config::Presence::of_others) return;
    if constexpr (requires { member.has_value(); }) {
      if (member) section(key, *member, {}, presence, context...);
    } else {
      begin(key);
      config::visit_knobs(*this, member, context...);
      end();
    }
  }
  template <class Item>
  void list(std::string_view key, const std::vector<Item>& members, config::ListSize,
            std::string_view, config::Presence = {}) {
    begin(key);
    for (const Item& member : members) {
      begin("item");
      config::visit_knobs(*this, member);
      end();
    }
    end();
  }
  void rule(bool, std::string_view, std::string_view) {}

  std::string text;

 private:
  template <class Member>
  void value(std::string_view key, const Member& member, const auto& type) {
    if constexpr (requires { type.usual; }) {
      if (json_of(type, member).is_null()) return;  // files need not say it, and did not always
    }
    if constexpr (requires { member.has_value(); }) {
      if (member) value(key, *member, type);
    } else {
      text.append(key);
      text += '=';
      if constexpr (requires { member.count(); }) {
        append(member.count());
      } else if constexpr (std::is_enum_v<Member>) {
        append(static_cast<std::int64_t>(member));
      } else if constexpr (std::is_integral_v<Member>) {
        append(member);
      } else {
        text += json_of(type, member).dump();
      }
      text += '\n';
    }
  }
  void append(auto number) {
    const fmt::format_int digits{number};
    text.append(digits.data(), digits.size());
  }
  void begin(std::string_view key) {
    text.append(key);
    text += "{\n";
  }
  void end() { text += "}\n"; }
};

void append_fleet(const model::Deployment& deployment, fmt::memory_buffer& text) {
  if (deployment.hosts.empty()) return;
  KnobText knobs;
  config::visit_hosts(knobs, deployment);
  config::visit_fleet_knobs(knobs, deployment);
  text.append(knobs.text);
}

Digest digest_of_knobs(const auto& profile) {
  KnobText knobs;
  config::visit_knobs(knobs, profile);
  return digest_of(knobs.text);
}

}  // namespace

Digest digest_of(std::string_view text) {
  boost::uuids::detail::sha1 hash;
  hash.process_bytes(text.data(), text.size());
  boost::uuids::detail::sha1::digest_type parts;
  hash.get_digest(parts);
  constexpr std::size_t part_bytes = sizeof(parts[0]);  // 4; from Boost 1.86 on 1
  Digest digest{};
  for (std::size_t k = 0; k < digest.size(); ++k) {
    const std::size_t shift = 8 * (part_bytes - 1 - k % part_bytes);
    digest[k] = static_cast<std::uint8_t>(parts[k / part_bytes] >> shift);
  }
  return digest;
}

std::string hex(const Digest& digest) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * digest.size());
  for (const std::uint8_t byte : digest) {
    text += digits[byte >> 4U];
    text += digits[byte & 15U];
  }
  return text;
}

Digest digest_of(const model::Deployment& deployment) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "loopback {}\n", deployment.loopback_delay.count());
  if (deployment.send_time) {
    fmt::format_to(std::back_inserter(text), "send {}\n", deployment.send_time->count());
  }
  if (deployment.send_cost) {
    fmt::format_to(std::back_inserter(text), "server {}\n", deployment.send_cost->count());
  }
  for (const model::DiscoveryServer& server : deployment.servers) {
    fmt::format_to(std::back_inserter(text), "server on {}", server.host.value);
    for (const std::uint64_t k : server.servers) {
      fmt::format_to(std::back_inserter(text), " with {}", k);
    }
    text.push_back('\n');
  }
  append_fleet(deployment, text);
  for (const model::Participant& participant : deployment.participants) {
    // A new member has to be named here; it would not compile otherwise.
    const auto& [host, publications, subscriptions, start, endpoints_done, open, ready, dds,
                 servers] = participant;
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {}", host.value, publications,
                   subscriptions, start.count(), endpoints_done.count());
    if (open) fmt::format_to(std::back_inserter(text), " open {}", open->count());
    if (ready) fmt::format_to(std::back_inserter(text), " ready {}", ready->count());
    if (dds) fmt::format_to(std::back_inserter(text), " dds {}", hex(digest_of(*dds)));
    for (const std::uint64_t k : servers) fmt::format_to(std::back_inserter(text), " of {}", k);
    text.push_back('\n');
  }
  return digest_of(std::string_view{text.data(), text.size()});
}

Digest digest_of(const model::DdsProfile& dds) { return digest_of_knobs(dds); }
Digest digest_of(const model::WirelessProfile& wireless) { return digest_of_knobs(wireless); }

}  // namespace stormproof::grids
