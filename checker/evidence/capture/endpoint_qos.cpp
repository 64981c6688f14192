// Policies on the wire (RTPS 2.5, section 9.4.2) and the rules between them.
#include "checker/evidence/capture/endpoint_qos.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

namespace stormproof::capture {

namespace {

std::vector<std::string> names(Cursor& cursor) {
  constexpr std::uint32_t most = 64;
  std::vector<std::string> all;
  for (std::uint32_t left = std::min(cursor.u32(), most); left > 0; --left) {
    const Bytes characters = cursor.take(cursor.u32());
    cursor.skip((4 - cursor.position() % 4) % 4);
    if (cursor.failed() && characters.empty()) break;
    std::string name{characters.begin(), characters.end()};
    if (!name.empty() && name.back() == '\0') name.pop_back();
    all.push_back(std::move(name));
  }
  std::erase(all, "");  // the partition without a name is that of nobody who says one
  return all;
}

template <std::size_t Count>
const char* word(const std::array<const char*, Count>& words, std::uint32_t value) {
  return value < Count ? words[value] : "unknown";
}

std::string period_text(std::int64_t ns) {
  return ns == EndpointQos::infinite ? "infinite"
                                     : fmt::format("{:g} s", static_cast<double>(ns) * 1e-9);
}

bool matches(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

/// Some name of one agrees with some of the other; either may be a pattern.
bool share_a_partition(std::vector<std::string> some, std::vector<std::string> others) {
  if (some.empty()) some.emplace_back();
  if (others.empty()) others.emplace_back();
  return std::ranges::any_of(some, [&](const std::string& one) {
    return std::ranges::any_of(others, [&](const std::string& other) {
      return one == other || matches(one, other) || matches(other, one);
    });
  });
}

}  // namespace

std::int64_t duration_ns(Cursor cursor) {
  const auto seconds = static_cast<std::int32_t>(cursor.u32());
  const std::uint64_t fraction = cursor.u32();
  if (cursor.failed() || seconds < 0 || seconds == INT32_MAX) return EndpointQos::infinite;
  return std::int64_t{seconds} * 1'000'000'000 +
         static_cast<std::int64_t>(fraction * 1'000'000'000 >> 32U);
}

void read_qos(const Parameter& parameter, ByteOrder order, EndpointQos& qos) {
  constexpr std::uint32_t reliable = 2;
  Cursor cursor{parameter.value, order};
  switch (parameter.id) {
    case ParameterId::reliability:
      qos.is_reliable = cursor.u32() == reliable;
      break;
    case ParameterId::durability:
      qos.durability = cursor.u32();
      break;
    case ParameterId::deadline:
      qos.deadline_ns = duration_ns(cursor);
      break;
    case ParameterId::liveliness:
      qos.liveliness = cursor.u32();
      qos.liveliness_ns = duration_ns(Cursor{cursor.rest(), order});
      break;
    case ParameterId::ownership:
      qos.is_exclusive = cursor.u32() != 0;
      break;
    case ParameterId::destination_order:
      qos.order = cursor.u32();
      break;
    case ParameterId::partition:
      qos.partitions = names(cursor);
      break;
    default:
      break;
  }
}

std::vector<std::string> disagreements(const EndpointQos& offered, const EndpointQos& requested) {
  constexpr std::array durabilities{"volatile", "transient local", "transient", "persistent"};
  constexpr std::array livelinesses{"automatic", "manual by participant", "manual by topic"};
  constexpr std::array orders{"by reception", "by source"};
  std::vector<std::string> all;
  const auto differ = [&](const char* policy, std::string_view offer, std::string_view request) {
    all.push_back(fmt::format("{}: offered {}, requested {}", policy, offer, request));
  };
  if (!offered.is_reliable.value_or(true) && requested.is_reliable.value_or(false)) {
    differ("reliability", "best effort", "reliable");
  }
  if (offered.durability < requested.durability) {
    differ("durability", word(durabilities, offered.durability),
           word(durabilities, requested.durability));
  }
  if (offered.deadline_ns > requested.deadline_ns) {
    differ("deadline", period_text(offered.deadline_ns), period_text(requested.deadline_ns));
  }
  if (offered.liveliness < requested.liveliness) {
    differ("liveliness", word(livelinesses, offered.liveliness),
           word(livelinesses, requested.liveliness));
  }
  if (offered.liveliness_ns > requested.liveliness_ns) {
    differ("liveliness lease", period_text(offered.liveliness_ns),
           period_text(requested.liveliness_ns));
  }
  if (offered.is_exclusive != requested.is_exclusive) {
    differ("ownership", offered.is_exclusive ? "exclusive" : "shared",
           requested.is_exclusive ? "exclusive" : "shared");
  }
  if (offered.order < requested.order) {
    differ("destination order", word(orders, offered.order), word(orders, requested.order));
  }
  if (!share_a_partition(offered.partitions, requested.partitions)) {
    const auto list = [](const std::vector<std::string>& some) {
      return some.empty() ? std::string{"none"} : fmt::format("'{}'", fmt::join(some, "', '"));
    };
    differ("partition", list(offered.partitions), list(requested.partitions));
  }
  return all;
}

}  // namespace stormproof::capture
