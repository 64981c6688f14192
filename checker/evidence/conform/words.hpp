// Words for what is explained or not: durations, ACKNACKs, and the captured events around one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/conform/dialogue.hpp"
#include "checker/presentation/text/numbers.hpp"

namespace stormproof::conform {

/// Captures in microseconds cut the rest off: two of their times may be that much closer than they
/// were.
inline constexpr std::int64_t capture_resolution_ns = 1'000;

[[nodiscard]] inline std::string duration(std::int64_t ns) {
  return report::duration(model::Nanoseconds{ns});
}
/// "base 5, asks for 5–9 and 12".
[[nodiscard]] std::string words(const Answer& answer);
/// Events of the relation around `event`, in time order; `cause` is among them.
[[nodiscard]] std::vector<std::size_t> context_of(const Relation& relation, std::size_t event,
                                                  std::optional<std::size_t> cause = {});

/// How many are shown before and after one.
struct Around {
  std::size_t before = 0;
  std::size_t after = 0;
};
/// What is wrong with one of a participant's announcements `all`, or with something else at its
/// time.
[[nodiscard]] Unexplained unexplained_among(const std::vector<Announcement>& all,
                                            const Place& place, const Announcement& one,
                                            Fault fault, std::string what, std::string nearest,
                                            std::vector<Need> needs, Around shown);
/// What is wrong with `event`, with the events around it and `cause`.
[[nodiscard]] Unexplained unexplained_in(const Relation& relation, std::size_t event, Fault fault,
                                         std::string what, std::string nearest,
                                         std::vector<Need> needs,
                                         std::optional<std::size_t> cause = {});

}  // namespace stormproof::conform
