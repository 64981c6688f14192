// Of which kinds of events and packets a probe wants to hear. Most events of a run are the
// channel's, and most packets of some are HEARTBEATs: who asks for neither is not called for them.
// A list (probe_list.hpp) asks for it; a probe that is alone hears of all kinds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "model/engine/packet.hpp"
#include "model/probe.hpp"

namespace stormproof::model::trace {

class Selection {
 public:
  /// Of these reports only what is of one of the kinds; of all others, everything.
  constexpr Selection only(std::initializer_list<Report> reports,
                           std::initializer_list<EventKind> kinds) const {
    std::uint64_t wanted = 0;
    for (const EventKind kind : kinds) wanted |= bit(static_cast<std::size_t>(kind));
    return with(reports, wanted);
  }
  constexpr Selection only(std::initializer_list<Report> reports,
                           std::initializer_list<PacketKind> kinds) const {
    std::uint64_t wanted = 0;
    for (const PacketKind kind : kinds) wanted |= bit(static_cast<std::size_t>(kind));
    return with(reports, wanted);
  }
  /// Of this report only events of the kinds for which `wanted(kind)` holds.
  template <class Wanted>
  [[nodiscard]] constexpr Selection only_if(Report report, Wanted wanted) const {
    std::uint64_t kinds = 0;
    for (std::size_t kind = 0; kind < event_kind_count; ++kind) {
      if (wanted(static_cast<EventKind>(kind))) kinds |= bit(kind);
    }
    return with({report}, kinds);
  }
  [[nodiscard]] constexpr bool has(Report report, std::size_t kind) const {
    return (left_out_[static_cast<std::size_t>(report)] & bit(kind)) == 0;
  }

 private:
  static constexpr std::uint64_t bit(std::size_t kind) { return std::uint64_t{1} << kind; }
  [[nodiscard]] constexpr Selection with(std::initializer_list<Report> reports,
                                         std::uint64_t wanted) const {
    Selection next = *this;
    for (const Report report : reports) next.left_out_[static_cast<std::size_t>(report)] = ~wanted;
    return next;
  }

  std::array<std::uint64_t, report_count> left_out_{};  // a bit for each kind
};
static_assert(event_kind_count <= 64 && packet_kind_count <= 64);

/// A probe that selects.
class Selective {
 public:
  virtual ~Selective() = default;
  [[nodiscard]] virtual Selection selection() const = 0;
};

}  // namespace stormproof::model::trace
