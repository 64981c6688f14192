// Names and times in the reasons of violations.
#include "props/monitors/describe.hpp"

#include <fmt/core.h>

namespace stormproof::props {

namespace {

const char* stream_name(std::uint32_t relation_or_writer) {
  return model::name_of(model::streams[relation_or_writer % 2]);
}

}  // namespace

std::string time_text(model::Nanoseconds time) {
  struct Unit {
    std::int64_t size;
    int digits;
    const char* name;
  };
  constexpr Unit units[] = {{1'000'000'000, 9, "s"}, {1'000'000, 6, "ms"}, {1'000, 3, "µs"}};
  const std::int64_t ns = time.count();
  if (ns < 0) return fmt::format("-{}", time_text(model::Nanoseconds{-ns}));
  for (const Unit& unit : units) {
    if (ns < unit.size) continue;
    std::string text = fmt::format("{}.{:0{}}", ns / unit.size, ns % unit.size, unit.digits);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text + " " + unit.name;
  }
  return fmt::format("{} ns", ns);
}

std::string writer_text(std::uint32_t writer) {
  return fmt::format("participant {}'s {} writer", writer / 2, stream_name(writer));
}

std::string relation_text(const model::Topology& topology, std::uint32_t relation) {
  const model::Pair& ends = topology.pair(relation / 2);
  return fmt::format("participant {}'s {} stream at participant {}", ends.source,
                     stream_name(relation), ends.destination);
}

std::string descriptor_text(const model::Topology& topology, std::uint32_t relation,
                            std::uint32_t descriptor) {
  return fmt::format("descriptor {} of {}", descriptor, relation_text(topology, relation));
}

}  // namespace stormproof::props
