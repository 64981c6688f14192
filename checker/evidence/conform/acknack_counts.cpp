// Looks at the ACKNACKs of each reader in the order of their capture.
#include "checker/evidence/conform/acknack_counts.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace stormproof::conform {

namespace {

struct Said {
  const Relation* relation = nullptr;
  const Answer* answer = nullptr;
};

/// Before a reader of Cyclone DDS has seen a HEARTBEAT.
std::optional<Unexplained> judge_preemptive(const Said& said) {
  if (said.answer->count == 0) return std::nullopt;
  return unexplained_in(*said.relation, said.answer->event, Fault::acknack_count,
                        fmt::format("pre-emptive ACKNACK {}", said.answer->count),
                        "a pre-emptive ACKNACK is not counted: its count is 0",
                        {{"another count", {}, {}}});
}

std::optional<Unexplained> judge(const std::vector<Said>& said, bool shows_all) {
  for (std::size_t k = 1; k < said.size(); ++k) {
    const Answer& one = *said[k].answer;
    const std::uint32_t before = said[k - 1].answer->count;
    if (one.count > before && (!shows_all || one.count == before + 1)) continue;
    return unexplained_in(
        *said[k].relation, one.event, Fault::acknack_count,
        fmt::format("ACKNACK {}, {} after ACKNACK {} of the same reader", one.count,
                    duration(one.time_ns - said[k - 1].answer->time_ns), before),
        shows_all
            ? "a reader counts its ACKNACKs up, and there is nobody on its host whom those in "
              "between can be for"
            : "a reader counts its ACKNACKs up",
        {{"another count", {}, {}}});
  }
  return std::nullopt;
}

}  // namespace

AckNackCounts::AckNackCounts(const Dialogue& dialogue, bool of_each_writer) {
  // By reader: its participant and, as built-in readers are named by their writers, that; and whom
  // it answers, if that has counts of its own.
  std::map<Place, std::vector<Said>> readers;
  for (const Relation& relation : dialogue.relations) {
    Place reader = relation.place;
    if (!of_each_writer) reader.source = 0;
    for (const Answer& answer : relation.answers) {
      const Said said{&relation, &answer};
      if (!of_each_writer || !answer.is_initial) {
        readers[reader].push_back(said);
      } else if (auto fault = judge_preemptive(said)) {
        faults_.emplace(fault->place, *std::move(fault));
      }
    }
  }
  for (auto& [reader, said] : readers) {
    std::ranges::sort(said, {}, [](const Said& one) { return one.answer->event; });
    const bool shows_all = !of_each_writer && !dialogue.has_neighbour[*reader.destination] &&
                           !dialogue.server && dialogue.ends_early == nullptr;
    if (auto fault = judge(said, shows_all)) faults_.emplace(fault->place, *std::move(fault));
  }
}

std::optional<Unexplained> AckNackCounts::fault_in(const Relation& relation) const {
  const auto found = faults_.find(relation.place);
  return found == faults_.end() ? std::nullopt : std::optional{found->second};
}

}  // namespace stormproof::conform
