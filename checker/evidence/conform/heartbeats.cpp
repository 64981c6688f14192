// Finds a cause for each HEARTBEAT, in order of time.
#include "checker/evidence/conform/heartbeats.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/conform/machines.hpp"
#include "checker/evidence/conform/piggyback_budget.hpp"
#include "checker/evidence/conform/senders.hpp"
#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform {

namespace {

namespace timer = fsm::heartbeat_timer;

/// A rule, and what sends by it.
struct Explanation {
  Rule rule{};
  Sender sender{};
};

/// What a reply to the only reader can have been, too.
struct Exchangeable {
  std::size_t relation = 0;
  Explanation other{};
  std::int64_t time_ns = 0;
};

class Heartbeats {
 public:
  Heartbeats(const Context& context, const WriterRelations& writer, Ledger& ledger)
      : dialogue_{context.dialogue},
        writer_{writer},
        sedp_{context.dds.sedp},
        bounds_{context.bounds},
        machine_{ledger.machines.fastdds.of<fsm::HeartbeatTimer>()},
        ledger_{ledger},
        source_{writer.place().source},
        sent_{sent_heartbeats(writer)},
        budget_{dialogue_, writer, context.dds, bounds_},
        next_initial_(writer.relations.size()),
        is_opened_(writer.relations.size()),
        has_replied_(writer.relations.size()) {
    for (const SentHeartbeat& one : sent_.all) counts_.push_back(one.heartbeat.count);
    std::ranges::sort(counts_);
    for (const Relation* relation : writer.relations) {
      for (const Submessage& one : relation->sent) {
        if (one.descriptor) data_.emplace_back(one.time_ns, *one.descriptor + 1);
      }
    }
    std::ranges::sort(data_);
  }

  std::optional<Unexplained> explain() {
    for (const SentHeartbeat& one : sent_.all) {
      if (sent_.repeated && sent_.repeated->event < one.event) break;
      budget_.charge_until(one.event, [this](std::int64_t time_ns) { arm(time_ns); });
      auto fault = check_count(one);
      if (!fault) fault = check_range(one);
      if (!fault) fault = one.is_directed ? explain_directed(one) : explain_fan_out(one);
      if (fault) return fault;
    }
    if (sent_.repeated) {
      return fault(
          *sent_.repeated, Fault::heartbeat_count,
          fmt::format("HEARTBEAT {} again, to the same reader", sent_.repeated->heartbeat.count),
          "a writer counts its HEARTBEATs up, whomever they are for", {{"another count", {}, {}}});
    }
    for (std::size_t r = 0; r < writer_.relations.size(); ++r) {
      if (auto fault = check_due(*writer_.relations[r])) return fault;
    }
    return std::nullopt;
  }

 private:
  std::optional<Unexplained> check_count(const SentHeartbeat& one) {
    if (highest_ && one.heartbeat.count < highest_->heartbeat.count &&
        one.time_ns > highest_->time_ns + bounds_.most_send_lag_ns) {
      return fault(
          one, Fault::heartbeat_count,
          fmt::format("HEARTBEAT {}, {} after HEARTBEAT {} of the same writer", one.heartbeat.count,
                      duration(one.time_ns - highest_->time_ns), highest_->heartbeat.count),
          "a writer counts its HEARTBEATs up, whomever they are for",
          {{"send lag", one.time_ns - highest_->time_ns, bounds_.most_send_lag_ns}});
    }
    const bool shows_all = !dialogue_.has_neighbour[source_] && !dialogue_.server;
    if (!shows_all || !highest_ || one.heartbeat.count < highest_->heartbeat.count) {
      return std::nullopt;
    }
    const auto next = std::ranges::upper_bound(counts_, highest_->heartbeat.count);
    const auto same = std::ranges::lower_bound(counts_, one.heartbeat.count);
    const auto step = static_cast<std::ptrdiff_t>(one.heartbeat.count - highest_->heartbeat.count);
    if (same - next + 1 >= step) return std::nullopt;
    return fault(one, Fault::heartbeat_count,
                 fmt::format("HEARTBEAT {}, and the one before it is HEARTBEAT {}",
                             one.heartbeat.count, highest_->heartbeat.count),
                 "a writer counts its HEARTBEATs up, and there is nobody on its host whom those in "
                 "between can be for",
                 {{"another count", {}, {}}});
  }

  std::optional<Unexplained> check_range(const SentHeartbeat& one) {
    const bool shrinks = highest_ && one.heartbeat.count > highest_->heartbeat.count &&
                         one.heartbeat.announced < highest_->heartbeat.announced;
    if (!highest_ || one.heartbeat.count > highest_->heartbeat.count) highest_ = one;
    for (; known_ < data_.size() && data_[known_].first < one.time_ns - bounds_.most_send_lag_ns;
         ++known_) {
      exist_ = std::max(exist_, data_[known_].second);
    }
    const bool hides = one.heartbeat.announced < exist_;
    if (!one.says_one_thing) {
      return fault(
          one, Fault::heartbeat_range,
          fmt::format("copies of HEARTBEAT {} announce different samples", one.heartbeat.count),
          "what goes to several readers is one message", {{"copies that agree", {}, {}}});
    }
    if (one.heartbeat.first == 1 && !shrinks && !hides) return std::nullopt;
    return fault(one, Fault::heartbeat_range,
                 fmt::format("HEARTBEAT {} announces samples {} to {}", one.heartbeat.count,
                             one.heartbeat.first, one.heartbeat.announced),
                 shrinks ? "the one before announced more, and endpoints are only created"
                 : hides ? "DATA with more was sent before, and endpoints are only created"
                         : "descriptors are numbered from 1 on, and none goes",
                 {{"a writer whose endpoints are only created", {}, {}}});
  }

  /// A relation that opens with descriptors arms the timer; while its reader has acknowledged
  /// nothing, the expiry sends to all readers, this one too.
  std::optional<Unexplained> check_due(const Relation& relation) {
    if (relation.sent.empty() || !relation.sent.front().heartbeat ||
        relation.sent.front().heartbeat->announced == 0) {
      return std::nullopt;
    }
    const std::int64_t due = relation.sent.front().time_ns + sedp_.heartbeat_period.count() +
                             bounds_.most_lateness_ns + bounds_.most_send_lag_ns;
    for (const Answer& answer : relation.answers) {
      // From here on the reader may have acknowledged something.
      if (answer.base > 0 && answer.time_ns < due + bounds_.clock_error_ns) return std::nullopt;
    }
    if (due >= dialogue_.end_ns) return std::nullopt;
    std::size_t after = 0;  // the first event at which it is overdue
    for (const Submessage& one : relation.sent) {
      if (one.heartbeat && one.event != relation.sent.front().event && one.time_ns <= due) {
        return std::nullopt;
      }
      if (after == 0 && one.time_ns > due) after = one.event;
    }
    const std::size_t event = after != 0 ? after : relation.sent.back().event;
    return unexplained_in(
        relation, event, Fault::heartbeat_due,
        fmt::format("no HEARTBEAT within {} after the relation opened, though its reader has "
                    "acknowledged nothing",
                    duration(due - relation.sent.front().time_ns)),
        fmt::format("the writer's timer expires every {}",
                    duration(sedp_.heartbeat_period.count())),
        {{"a HEARTBEAT to this reader in time", {}, {}}});
  }

  std::optional<Unexplained> explain_directed(const SentHeartbeat& one) {
    if (!is_opened_[one.relation]) {
      is_opened_[one.relation] = true;
      settle(one, Rule::heartbeat_open);
      if (one.heartbeat.announced > 0) arm(one.time_ns);
      return std::nullopt;
    }
    if (const auto asked = initial_acknack_for(one)) {
      ledger_.hidden(Hidden::Kind::received, std::max(asked->time_ns, one.time_ns), asked->event);
      if (is_only_reader(one)) {
        if (const auto other = fan_out_rule(one))
          exchangeable_.push_back({one.relation, *other, one.time_ns});
      }
      has_replied_[one.relation] = true;
      settle(one, Rule::heartbeat_reply);
      arm(one.time_ns);
      return std::nullopt;
    }
    const auto exchangeable =
        std::ranges::find(exchangeable_, one.relation, &Exchangeable::relation);
    const bool can_exchange = exchangeable != exchangeable_.end();
    if (is_only_reader(one) && (fan_out_rule(one) || !can_exchange)) return explain_fan_out(one);
    if (can_exchange) {
      // An earlier one was to all readers, when there was only this one; its initial ACKNACK is
      // left for this one. It has been counted as a reply, so this one counts as what that was.
      settle(one, exchangeable->other);
      exchangeable_.erase(exchangeable);
      return std::nullopt;
    }
    return fault(one, Fault::heartbeat_cause,
                 fmt::format("HEARTBEAT {} to one reader, whose relation is open already",
                             one.heartbeat.count),
                 "a HEARTBEAT to one of several readers answers an initial ACKNACK, and every one "
                 "that can have arrived is answered already",
                 {{"one more initial ACKNACK of this reader before it", {}, {}}});
  }

  /// The first initial ACKNACK of the reader that can have arrived and is not answered yet.
  const Answer* initial_acknack_for(const SentHeartbeat& one) {
    const auto& answers = writer_.relations[one.relation]->answers;
    std::size_t& next = next_initial_[one.relation];
    while (next < answers.size() && !answers[next].is_initial) ++next;
    if (next == answers.size() ||
        answers[next].time_ns + bounds_.least_delay_ns >
            one.time_ns + bounds_.clock_error_ns + capture_resolution_ns) {
      return nullptr;
    }
    return &answers[next++];
  }

  std::optional<Unexplained> explain_fan_out(const SentHeartbeat& one) {
    if (auto fault = check_copies(one)) return fault;
    const auto after = after_data(one);
    if (const auto rule = fan_out_rule(one)) {
      if (rule->rule == Rule::heartbeat_piggyback) {
        ledger_.used_lag(*after);
      } else {
        expire(one);
      }
      settle(one, *rule);
      return std::nullopt;
    }
    if (const auto data = by_own_host(one)) {
      budget_.suppose_on_own_host(*data);
      settle(one, Rule::heartbeat_same_host);
      return std::nullopt;
    }
    std::vector<Need> needs;
    std::string nearest = "the writer's timer is not armed";
    if (due_ns_) {
      nearest =
          fmt::format("the writer's timer expires {} later", duration(*due_ns_ - one.time_ns));
      needs.push_back({"send lag", *due_ns_ - one.time_ns + bounds_.most_send_lag_ns,
                       bounds_.most_send_lag_ns});
    }
    if (after) {
      nearest += fmt::format(", and DATA has used at most {} of {} bytes of the piggyback budget",
                             budget_.spent_before(one), sedp_.piggyback_threshold_bytes.count());
    }
    return fault(one, Fault::heartbeat_cause,
                 fmt::format("HEARTBEAT {} to all readers", one.heartbeat.count), nearest,
                 std::move(needs));
  }

  /// A HEARTBEAT to all readers has a copy for each relation that is open.
  std::optional<Unexplained> check_copies(const SentHeartbeat& one) {
    std::size_t open = 0;
    for (const Relation* relation : writer_.relations) {
      const auto& sent = relation->sent;
      if (!sent.empty() && sent.front().time_ns < one.time_ns - bounds_.most_send_lag_ns) ++open;
    }
    const bool may_be_cut = one.time_ns + bounds_.most_send_lag_ns >= dialogue_.end_ns;
    if (one.copies >= open || may_be_cut) return std::nullopt;
    return fault(one, Fault::heartbeat_copies,
                 fmt::format("HEARTBEAT {} goes to {} of the {} readers whose relations are open",
                             one.heartbeat.count, one.copies, open),
                 "a HEARTBEAT that is not for one reader goes to all of them",
                 {{"a copy to each of the other readers", {}, {}}});
  }

  /// How long before `one` the writer sent DATA; nothing if that was too long ago.
  [[nodiscard]] std::optional<std::int64_t> after_data(const SentHeartbeat& one) const {
    if (one.is_behind_data) return 0;
    const auto data = budget_.last_data_ns();
    if (!data) return std::nullopt;
    const std::int64_t after = std::max<std::int64_t>(one.time_ns - *data, 0);
    if (after > bounds_.most_send_lag_ns) return std::nullopt;
    return after;
  }

  [[nodiscard]] bool may_piggyback(const SentHeartbeat& one) const {
    return sedp_.piggyback != model::Piggyback::off && budget_.can_be_used_up(one);
  }

  /// How many DATA to readers on the own host would have used up the budget; nothing: there cannot
  /// have been so many.
  [[nodiscard]] std::optional<std::int64_t> by_own_host(const SentHeartbeat& one) const {
    if (sedp_.piggyback == model::Piggyback::off) return std::nullopt;
    return budget_.needed_on_own_host(one);
  }

  /// The timer: armed by the opening, by answers, and by itself. Where readers on the same host can
  /// have armed it, only its period is known.
  void arm(std::int64_t now) {
    const auto output = machine_.step<timer::ArmRequested>(
        state_, {.now = now, .heartbeat_period = sedp_.heartbeat_period.count()});
    if (output.schedule_expiry) due_ns_ = output.next_at;
  }
  /// What sends `one` if it is one to all readers; nothing: no rule that the capture shows.
  [[nodiscard]] std::optional<Explanation> fan_out_rule(const SentHeartbeat& one) const {
    if (after_data(one) && may_piggyback(one)) {
      // It rides on the DATA or follows it.
      return Explanation{Rule::heartbeat_piggyback, budget_.last_data_is_pushed()
                                                        ? sends::budget_of_pushed
                                                        : sends::budget_of_requested};
    }
    if (is_due(one.time_ns)) return Explanation{Rule::heartbeat_periodic, sends::expiry};
    return std::nullopt;
  }
  [[nodiscard]] bool is_due(std::int64_t time_ns) const {
    std::int64_t due = due_ns_.value_or(INT64_MAX);
    if (dialogue_.has_neighbour[source_] && !has_expired_) {
      due = dialogue_.announcements[source_].empty()
                ? INT64_MIN
                : dialogue_.announcements[source_].front().time_ns +
                      sedp_.heartbeat_period.count() - bounds_.most_send_lag_ns;
    }
    return due <= time_ns + bounds_.most_send_lag_ns + capture_resolution_ns;
  }
  /// When the timer expires of which `one` is the HEARTBEAT: it, or an earlier one to the only
  /// reader, which has been counted as the reply that `one` may be.
  [[nodiscard]] std::int64_t earliest_expiry(const SentHeartbeat& one) const {
    std::int64_t earliest = one.time_ns;
    for (const Exchangeable& other : exchangeable_) {
      if (is_due(other.time_ns) && other.other.rule == Rule::heartbeat_periodic) {
        earliest = std::min(earliest, other.time_ns);
      }
    }
    return earliest;
  }
  /// Whether one to the only reader can be the reply to an initial ACKNACK that another one has
  /// been counted as.
  [[nodiscard]] bool can_be_reply(const SentHeartbeat& one) const {
    return one.is_directed && has_replied_[one.relation];
  }
  void expire(const SentHeartbeat& one) {
    const std::int64_t expired_ns = earliest_expiry(one);
    if (!due_ns_) arm(one.time_ns - sedp_.heartbeat_period.count());
    const auto output =
        machine_.step<timer::Expired>(state_, {.now = expired_ns,
                                               .heartbeat_period = sedp_.heartbeat_period.count(),
                                               .unacknowledged = true});
    // It may have been sent that much before its capture. If something else explains it, too,
    // the timer need not have expired yet.
    const bool is_certain = !by_own_host(one) && !can_be_reply(one);
    has_expired_ = has_expired_ || is_certain;
    if (output.schedule_expiry && is_certain) due_ns_ = output.next_at - bounds_.most_send_lag_ns;
    ledger_.hidden(Hidden::Kind::timer, one.time_ns, one.event, "HeartbeatTimer");
  }

  void settle(const SentHeartbeat& one, Rule rule) {
    ledger_.explained(rule, one.copies);
    budget_.refill(one, rule == Rule::heartbeat_same_host && surely_rides(one));
  }
  void settle(const SentHeartbeat& one, const Explanation& by) {
    ledger_.explained(by.rule, by.sender, one.copies);
    budget_.refill(one, by.rule == Rule::heartbeat_piggyback && surely_rides(one));
  }
  /// Whether it can have no other reason than DATA.
  [[nodiscard]] bool surely_rides(const SentHeartbeat& one) const {
    return one.is_behind_data || (!one.is_directed && !is_due(one.time_ns));
  }

  /// Whether the writer can have no other reader yet. A relation on the own host opens with a
  /// HEARTBEAT, too, which the capture does not show, so that a count is missing.
  [[nodiscard]] bool is_only_reader(const SentHeartbeat& one) const {
    const auto shown = std::ranges::lower_bound(counts_, one.heartbeat.count) - counts_.begin();
    const bool some_are_hidden = one.heartbeat.count > static_cast<std::size_t>(shown) + 1;
    return (!dialogue_.has_neighbour[source_] || !some_are_hidden) &&
           std::count(is_opened_.begin(), is_opened_.end(), true) == 1;
  }

  Unexplained fault(const SentHeartbeat& one, Fault kind, std::string what, std::string nearest,
                    std::vector<Need> needs) {
    return unexplained_in(*writer_.relations[one.relation], one.event, kind, std::move(what),
                          std::move(nearest), std::move(needs));
  }

  const Dialogue& dialogue_;
  const WriterRelations& writer_;
  const model::SedpProfile& sedp_;
  const Bounds& bounds_;
  Tally<fsm::HeartbeatTimer>& machine_;
  Ledger& ledger_;
  std::size_t source_;

  SentHeartbeats sent_;
  std::vector<std::uint32_t> counts_;  ///< of those, ascending
  PiggybackBudget budget_;
  std::optional<SentHeartbeat> highest_;  ///< by its count
  /// DATA of the writer: when, and how many descriptors there are then at least; ascending.
  std::vector<std::pair<std::int64_t, std::uint32_t>> data_;
  std::size_t known_ = 0;    ///< of those, how many surely were sent before
  std::uint32_t exist_ = 0;  ///< descriptors, at least
  std::vector<Exchangeable> exchangeable_;
  std::vector<std::size_t> next_initial_;
  std::vector<bool> is_opened_;
  std::vector<bool> has_replied_;  ///< to an initial ACKNACK
  fsm::StateId state_ = Tally<fsm::HeartbeatTimer>::Fly::initial;
  std::optional<std::int64_t> due_ns_;  ///< when the timer expires, earliest
  bool has_expired_ = false;
};

}  // namespace

AnnouncedSince announced_since(const WriterRelations& writer) {
  AnnouncedSince since;
  for (const Relation* relation : writer.relations) {
    for (const Submessage& one : relation->sent) {
      if (!one.heartbeat) continue;
      const auto [at, is_new] = since.emplace(one.heartbeat->announced, one.time_ns);
      at->second = std::min(at->second, one.time_ns);
    }
  }
  std::int64_t earliest = INT64_MAX;
  for (auto at = since.rbegin(); at != since.rend(); ++at) {
    earliest = at->second = std::min(at->second, earliest);
  }
  return since;
}

std::optional<Unexplained> explain_heartbeats(const Context& context, const WriterRelations& writer,
                                              Ledger& ledger) {
  return Heartbeats{context, writer, ledger}.explain();
}

}  // namespace stormproof::conform
