// GAPs of a relay. Before a change is sent to a client for the first time, a GAP with a HEARTBEAT
// names the numbers before it that are not in the client's list: from behind the last one in the
// list, or behind what it has acknowledged, or from the first of the history on. What an ACKNACK
// asks for and is not in the list is answered by a GAP alone. Lists never get a number back.
#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/arrivals.hpp"
#include "checker/evidence/conform/requests.hpp"
#include "checker/evidence/conform/server_relay.hpp"

namespace stormproof::conform::server {

namespace {

/// What is known of a client when something is sent to it.
struct Reader {
  std::uint32_t existing = 0;      ///< changes when the relation opened, which it may have to get
  std::int64_t first = 0;          ///< of them
  std::set<std::uint32_t> sent{};  ///< so far
  std::set<std::uint32_t> gapped{};
  std::size_t next_answer = 0;  ///< the first that has not been answered by a GAP
  const Passed* gap = nullptr;  ///< the last one before a DATA, if nothing followed it
};

class Gaps {
 public:
  Gaps(const Context& context, const WriterRelations& relay, const std::vector<Passed>& passed,
       Ledger& ledger)
      : context_{context}, relay_{relay}, passed_{passed}, ledger_{ledger} {
    for (const Relation* relation : relay.relations) {
      Reader reader;
      reader.existing = existing_at_opening(*relation);
      if (!relation->sent.empty() && relation->sent.front().heartbeat) {
        reader.first = relation->sent.front().heartbeat->first - 1;
      }
      readers_.push_back(std::move(reader));
    }
  }

  std::optional<Unexplained> explain() {
    for (std::size_t k = 0; k < passed_.size(); ++k) {
      const Passed& one = passed_[k];
      Reader& reader = readers_[one.relation];
      std::optional<Unexplained> found;
      if (one.is_gap && one.gap.empty()) {
        found = fault(one, "GAP of nothing", "a GAP names something");
      } else if (one.is_gap) {
        found = one.heartbeat ? before_data(one, reader) : alone(one, k, reader);
        reader.gapped.insert(one.gap.begin(), one.gap.end());
      } else if (one.change) {
        found = data(one, reader);
        reader.sent.insert(*one.change);
      }
      if (found) return found;
    }
    return std::nullopt;
  }

 private:
  /// A GAP with a HEARTBEAT: up to the change that is sent next.
  std::optional<Unexplained> before_data(const Passed& one, Reader& reader) {
    const bool is_one_range = one.gap.back() - one.gap.front() + 1 == one.gap.size();
    const bool is_second = reader.gap != nullptr;  // without a DATA between them
    if (is_second || !is_one_range || !can_begin(one, one.gap.front(), *one.heartbeat, reader)) {
      return fault(one, fmt::format("GAP of {} before DATA", range(one)),
                   "it begins behind what the client has acknowledged or has to get, or at the "
                   "first change that there is, and ends at the DATA");
    }
    reader.gap = &one;
    ledger_.explained(Rule::relay_gap);
    return std::nullopt;
  }

  std::optional<Unexplained> data(const Passed& one, Reader& reader) {
    const Passed* gap = std::exchange(reader.gap, nullptr);
    const std::uint32_t change = *one.change;
    if (gap != nullptr && (!one.is_first || gap->gap.back() + 1 != change)) {
      return unexplained_in(relay_, one, one.event, Fault::data_cause,
                            fmt::format("DATA {} behind a GAP of {}", change + 1, range(*gap)),
                            "a GAP with a HEARTBEAT ends at the DATA that follows it");
    }
    if (reader.gapped.contains(change)) {
      return unexplained_in(relay_, one, one.event, Fault::data_cause,
                            fmt::format("DATA {}, which a GAP has named before", change + 1),
                            "what the client need not have it need not have later, either");
    }
    if (gap != nullptr || !one.is_first || change == 0 || !one.heartbeat) return std::nullopt;
    if (can_begin(one, change, *one.heartbeat, reader)) return std::nullopt;
    if (is_told_to_all_ && reader.gapped.contains(change - 1)) return std::nullopt;
    return unexplained_in(
        relay_, one, one.event, Fault::data_cause,
        fmt::format("DATA {} without a GAP for {} before it", change + 1, change),
        "what the client has neither acknowledged nor to get is named by a GAP before the DATA",
        {{"a GAP before it", {}, {}}});
  }

  /// Whether the number before `change` is the last one of the client's list, or none is there that
  /// it has not acknowledged.
  [[nodiscard]] bool can_begin(const Passed& one, std::uint32_t change, const Heartbeat& now,
                               const Reader& reader) const {
    if (change + std::int64_t{1} == now.first || change == reader.first) return true;
    if (change == 0) return false;
    if (change - 1 < reader.existing || reader.sent.contains(change - 1)) return true;
    return std::ranges::any_of(relay_.relations[one.relation]->answers, [&](const Answer& answer) {
      return !answer.is_initial && answer.base == change &&
             context_.can_precede(answer.time_ns, one.time_ns);
    });
  }

  /// A GAP alone: because of an ACKNACK, which causes one.
  std::optional<Unexplained> alone(const Passed& one, std::size_t index, Reader& reader) {
    const auto& answers = relay_.relations[one.relation]->answers;
    for (std::size_t k = reader.next_answer; k < answers.size(); ++k) {
      if (!context_.can_precede(answers[k].time_ns, one.time_ns)) break;
      if (!is_answer(one, answers[k], reader)) continue;
      reader.next_answer = k + 1;
      ledger_.explained(Rule::relay_gap_reply);
      return std::nullopt;
    }
    if (is_for_everybody(index)) {
      is_told_to_all_ = true;
      ledger_.explained(Rule::relay_gap_to_everybody);
      return std::nullopt;
    }
    return fault(one, fmt::format("GAP of {}", range(one)),
                 "no ACKNACK asks for just what the client need not have, that can have arrived "
                 "and has not been answered");
  }

  /// Of what the client asks for it names all that it need not have: also what was named before.
  [[nodiscard]] static bool is_answer(const Passed& one, const Answer& answer,
                                      const Reader& reader) {
    // What does not fit into the bitmap a simulated reader asks for all the same.
    const auto is_asked = [&](std::uint32_t d) {
      return answer.asks_for(d) || d >= answer.base + bitmap_limit;
    };
    if (!std::ranges::all_of(one.gap, is_asked)) return false;
    return std::ranges::all_of(answer.missing, [&](std::uint32_t d) {
      return d < one.gap.front() || !reader.gapped.contains(d) ||
             std::ranges::binary_search(one.gap, d);
    });
  }

  /// Real servers tell all readers together what none of them need have, without a HEARTBEAT, just
  /// before a DATA behind it.
  [[nodiscard]] bool is_for_everybody(std::size_t index) const {
    const Passed& one = passed_[index];
    const std::int64_t lag = context_.bounds.most_send_lag_ns;
    const bool is_one_range = one.gap.back() - one.gap.front() + 1 == one.gap.size();
    if (lag == 0 || !is_one_range) return false;
    for (std::size_t k = index + 1; k < passed_.size(); ++k) {
      if (passed_[k].time_ns > one.time_ns + lag) break;
      if (passed_[k].change == one.gap.back() + 1 && passed_[k].is_first) return true;
    }
    // The client that it is sent to may be on the server's host.
    return context_.dialogue.has_neighbour[relay_.place().source];
  }

  static std::string range(const Passed& gap) {
    return fmt::format("{} to {}", gap.gap.front() + 1, gap.gap.back() + 1);
  }
  Unexplained fault(const Passed& one, std::string what, std::string nearest) const {
    return unexplained_in(relay_, one, one.event, Fault::gap_cause, std::move(what),
                          std::move(nearest));
  }

  const Context& context_;
  const WriterRelations& relay_;
  const std::vector<Passed>& passed_;
  Ledger& ledger_;
  std::vector<Reader> readers_;
  bool is_told_to_all_ = false;
};

}  // namespace

std::optional<Unexplained> explain_gaps(const Context& context, const WriterRelations& relay,
                                        const std::vector<Passed>& passed, Ledger& ledger) {
  return Gaps{context, relay, passed, ledger}.explain();
}

}  // namespace stormproof::conform::server
