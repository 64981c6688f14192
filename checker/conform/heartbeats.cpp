// Groups the copies of each HEARTBEAT by its count and finds a cause for each, in order of time.
#include "checker/conform/heartbeats.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "checker/conform/words.hpp"

namespace stormproof::conform {

namespace {

namespace timer = fsm::heartbeat_timer;

/// A HEARTBEAT that follows captured DATA this closely is put down to it, even if the writer has
/// readers on its own host, whose DATA would explain it, too.
constexpr std::int64_t directly_after_ns = 1'000'000;

/// A submessage of one of the participant's SEDP writers.
struct Charge {
  std::size_t event = 0;
  std::int64_t time_ns = 0;
  std::uint32_t datagram = 0;
  std::int64_t bytes = 0;    ///< UDP payload, if it is the first of its datagram
  bool is_own_data = false;  ///< DATA of this writer

  auto operator<=>(const Charge&) const = default;
};

/// One HEARTBEAT of the writer: its copies share a count.
struct Sent {
  std::int64_t time_ns = 0;  ///< of the first copy
  std::size_t event = 0;     ///< of the first copy
  Heartbeat heartbeat{};     ///< of the first copy
  std::size_t relation = 0;  ///< of the first copy
  std::size_t copies = 0;
  bool is_behind_data = false;
  bool is_directed = false;  ///< names its reader, and shares its datagram with nothing
};

class Heartbeats {
 public:
  Heartbeats(const Dialogue& dialogue, const WriterRelations& writer,
             const model::SedpProfile& sedp, const Bounds& bounds,
             Tally<fsm::HeartbeatTimer>& machine, Ledger& ledger)
      : dialogue_{dialogue},
        writer_{writer},
        sedp_{sedp},
        bounds_{bounds},
        machine_{machine},
        ledger_{ledger},
        source_{writer.relations.front()->place.source},
        next_initial_(writer.relations.size()),
        is_opened_(writer.relations.size()) {
    collect();
  }

  std::optional<Unexplained> explain() {
    for (const Sent& one : sent_) {
      if (repeated_ && repeated_->event < one.event) break;
      charge_until(one.event);
      auto fault = check_count(one);
      if (!fault) fault = check_range(one);
      if (!fault) fault = one.is_directed ? explain_directed(one) : explain_fan_out(one);
      if (fault) return fault;
    }
    if (repeated_) {
      return fault(
          *repeated_, Fault::heartbeat_count,
          fmt::format("HEARTBEAT {} again, to the same reader", repeated_->heartbeat.count),
          "a writer counts its HEARTBEATs up, whomever they are for", {{"another count", {}, {}}});
    }
    for (std::size_t r = 0; r < writer_.relations.size(); ++r) {
      if (auto fault = check_due(*writer_.relations[r])) return fault;
    }
    return std::nullopt;
  }

 private:
  void collect() {
    std::map<std::uint32_t, Sent> by_count;
    for (const Relation& relation : dialogue_.relations) {
      if (relation.place.source == source_) collect_charges(relation);
    }
    std::sort(charges_.begin(), charges_.end());
    for (std::size_t r = 0; r < writer_.relations.size(); ++r) {
      std::set<std::uint32_t> with_data;  // datagrams
      for (const Submessage& one : writer_.relations[r]->sent) {
        if (one.descriptor) with_data.insert(one.datagram);
      }
      for (const Submessage& one : writer_.relations[r]->sent) {
        if (one.heartbeat) add(by_count, r, one, with_data.count(one.datagram) > 0);
      }
    }
    for (auto& [count, one] : by_count) sent_.push_back(one);
    std::stable_sort(sent_.begin(), sent_.end(), [](const Sent& a, const Sent& b) {
      return std::pair{a.time_ns, a.event} < std::pair{b.time_ns, b.event};
    });
  }

  /// What the participant sends in both streams: the bytes are counted for all of its writers.
  void collect_charges(const Relation& relation) {
    const bool is_own = relation.place.writer == writer_.relations.front()->place.writer;
    std::optional<std::uint32_t> datagram;
    for (const Submessage& one : relation.sent) {
      Charge charge{one.event, one.time_ns, one.datagram, 0, is_own && one.descriptor};
      if (datagram != one.datagram) {
        charge.bytes = dialogue_.conversation.datagrams[one.datagram].payload_bytes;
      }
      datagram = one.datagram;
      charges_.push_back(charge);
    }
  }

  void add(std::map<std::uint32_t, Sent>& by_count, std::size_t relation, const Submessage& copy,
           bool is_behind_data) {
    Sent& one = by_count[copy.heartbeat->count];
    if (!copied_.insert({copy.heartbeat->count, relation}).second && !repeated_) {
      repeated_ = Sent{copy.time_ns, copy.event, *copy.heartbeat, relation, 1, false, false};
    }
    if (one.copies++ == 0 || copy.time_ns < one.time_ns) {
      one.time_ns = copy.time_ns;
      one.event = copy.event;
      one.heartbeat = *copy.heartbeat;
      one.relation = relation;
    }
    one.is_behind_data = one.is_behind_data || is_behind_data;
    one.is_directed = copy.heartbeat->is_directed && !one.is_behind_data && one.copies == 1;
  }

  /// Takes what was sent before `event` into account: for the piggyback budget, and DATA arms the
  /// timer.
  void charge_until(std::size_t event) {
    for (; charged_ < charges_.size() && charges_[charged_].event < event; ++charged_) {
      const Charge& charge = charges_[charged_];
      sent_bytes_ += charge.bytes;
      if (charge.datagram != datagram_) datagram_spent_ = 0;
      datagram_ = charge.datagram;
      if (charge.bytes > 0) datagram_bytes_ = charge.bytes;
      if (!charge.is_own_data) continue;
      // Never less than the writer charges: the cumulative rule charges each DATA with all bytes
      // that the participant has ever sent.
      const bool is_cumulative = sedp_.piggyback == model::Piggyback::cumulative;
      const std::int64_t bytes = is_cumulative ? sent_bytes_ : datagram_bytes_;
      spent_ += bytes;
      datagram_spent_ += bytes;
      last_data_ns_ = charge.time_ns;
      arm(charge.time_ns);
    }
  }

  std::optional<Unexplained> check_count(const Sent& one) {
    if (highest_ && one.heartbeat.count < highest_->heartbeat.count &&
        one.time_ns > highest_->time_ns + bounds_.most_send_lag_ns) {
      return fault(
          one, Fault::heartbeat_count,
          fmt::format("HEARTBEAT {}, {} after HEARTBEAT {} of the same writer", one.heartbeat.count,
                      duration(one.time_ns - highest_->time_ns), highest_->heartbeat.count),
          "a writer counts its HEARTBEATs up, whomever they are for",
          {{"send lag", one.time_ns - highest_->time_ns, bounds_.most_send_lag_ns}});
    }
    return std::nullopt;
  }

  std::optional<Unexplained> check_range(const Sent& one) {
    const bool shrinks = highest_ && one.heartbeat.count > highest_->heartbeat.count &&
                         one.heartbeat.announced < highest_->heartbeat.announced;
    if (!highest_ || one.heartbeat.count > highest_->heartbeat.count) highest_ = one;
    if (one.heartbeat.first == 1 && !shrinks) return std::nullopt;
    return fault(one, Fault::heartbeat_range,
                 fmt::format("HEARTBEAT {} announces samples {} to {}", one.heartbeat.count,
                             one.heartbeat.first, one.heartbeat.announced),
                 shrinks ? "the one before announced more, and endpoints are only created"
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
    if (due >= dialogue_.end_ns || sedp_.heartbeat_policy != model::HeartbeatPolicy::periodic) {
      return std::nullopt;
    }
    std::size_t after = 0;  // the first event at which it is overdue
    for (const Submessage& one : relation.sent) {
      if (one.heartbeat && one.event != relation.sent.front().event && one.time_ns <= due) {
        return std::nullopt;
      }
      if (after == 0 && one.time_ns > due) after = one.event;
    }
    const std::size_t event = after != 0 ? after : relation.sent.back().event;
    Unexplained result{event,
                       Fault::heartbeat_due,
                       relation.place,
                       fmt::format("no HEARTBEAT within {} after the relation opened, though its "
                                   "reader has acknowledged nothing",
                                   duration(due - relation.sent.front().time_ns)),
                       fmt::format("the writer's timer expires every {}",
                                   duration(sedp_.heartbeat_period.count())),
                       {{"a HEARTBEAT to this reader in time", {}, {}}},
                       {}};
    result.context = context_of(relation, event);
    return result;
  }

  std::optional<Unexplained> explain_directed(const Sent& one) {
    if (!is_opened_[one.relation]) {
      is_opened_[one.relation] = true;
      settle(one, Rule::heartbeat_open);
      if (one.heartbeat.announced > 0) arm(one.time_ns);
      return std::nullopt;
    }
    if (const auto asked = initial_acknack_for(one)) {
      ledger_.hidden(Hidden::Kind::received, std::max(asked->time_ns, one.time_ns), asked->event);
      if (is_only_reader() && may_fan_out(one)) ++exchangeable_;
      settle(one, Rule::heartbeat_reply);
      arm(one.time_ns);
      return std::nullopt;
    }
    if (is_only_reader() && (may_fan_out(one) || exchangeable_ == 0)) return explain_fan_out(one);
    if (is_only_reader()) {
      // An earlier one was to all readers; its initial ACKNACK is left for this one.
      --exchangeable_;
      settle(one, Rule::heartbeat_reply);
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
  const Answer* initial_acknack_for(const Sent& one) {
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

  std::optional<Unexplained> explain_fan_out(const Sent& one) {
    if (auto fault = check_copies(one)) return fault;
    const auto after = after_data(one);
    if (after && may_piggyback(one)) {
      ledger_.used_lag(*after);
      settle(one, Rule::heartbeat_piggyback);
      return std::nullopt;
    }
    if (is_due(one)) {
      expire(one);
      settle(one, Rule::heartbeat_periodic);
      return std::nullopt;
    }
    if (dialogue_.has_neighbour[source_] && sedp_.piggyback != model::Piggyback::off) {
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
                             spent_, sedp_.piggyback_threshold_bytes.count());
    }
    return fault(one, Fault::heartbeat_cause,
                 fmt::format("HEARTBEAT {} to all readers", one.heartbeat.count), nearest,
                 std::move(needs));
  }

  /// A HEARTBEAT to all readers has a copy for each relation that is open.
  std::optional<Unexplained> check_copies(const Sent& one) {
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
  [[nodiscard]] std::optional<std::int64_t> after_data(const Sent& one) const {
    if (one.is_behind_data) return 0;
    if (!last_data_ns_) return std::nullopt;
    const std::int64_t after = std::max<std::int64_t>(one.time_ns - *last_data_ns_, 0);
    const std::int64_t longest = dialogue_.has_neighbour[source_]
                                     ? std::min(directly_after_ns, bounds_.most_send_lag_ns)
                                     : bounds_.most_send_lag_ns;
    if (after > longest) return std::nullopt;
    return after;
  }

  /// What is sent to readers on the same host is charged, too; without such readers the captured
  /// DATA must have used up the budget.
  [[nodiscard]] bool may_piggyback(const Sent& one) const {
    if (sedp_.piggyback == model::Piggyback::off) return false;
    const std::int64_t threshold = sedp_.piggyback_threshold_bytes.count();
    // A datagram may hold several, between or behind its DATA.
    const bool in_datagram = one.is_behind_data && datagram_spent_ > threshold;
    return dialogue_.has_neighbour[source_] || in_datagram || spent_ > threshold;
  }

  /// The timer: armed by the opening, by answers, and by itself. Where readers on the same host can
  /// have armed it, only its period is known.
  void arm(std::int64_t now) {
    const auto output = machine_.step<timer::ArmRequested>(
        state_, {.now = now, .heartbeat_period = sedp_.heartbeat_period.count()});
    if (output.schedule_expiry) due_ns_ = output.next_at;
  }
  /// Whether `one`, to the only reader, can be one to all readers.
  [[nodiscard]] bool may_fan_out(const Sent& one) const {
    return (after_data(one) && may_piggyback(one)) || is_due(one);
  }
  [[nodiscard]] bool is_due(const Sent& one) const {
    if (sedp_.heartbeat_policy != model::HeartbeatPolicy::periodic) return due_ns_.has_value();
    std::int64_t due = due_ns_.value_or(INT64_MAX);
    if (dialogue_.has_neighbour[source_] && !has_expired_) {
      due = dialogue_.announcements[source_].empty()
                ? INT64_MIN
                : dialogue_.announcements[source_].front().time_ns +
                      sedp_.heartbeat_period.count() - bounds_.most_send_lag_ns;
    }
    return due <= one.time_ns + bounds_.most_send_lag_ns + capture_resolution_ns;
  }
  void expire(const Sent& one) {
    has_expired_ = true;
    if (!due_ns_) arm(one.time_ns - sedp_.heartbeat_period.count());
    const auto output =
        machine_.step<timer::Expired>(state_, {.now = one.time_ns,
                                               .heartbeat_period = sedp_.heartbeat_period.count(),
                                               .unacknowledged = true});
    // It may have been sent that much before its capture.
    if (output.schedule_expiry) due_ns_ = output.next_at - bounds_.most_send_lag_ns;
    ledger_.hidden(Hidden::Kind::timer, one.time_ns, one.event, "HeartbeatTimer");
  }

  void settle(const Sent& one, Rule rule) {
    ledger_.explained(rule, one.copies);
    // DATA behind it in its message is charged anew.
    spent_ = one.is_behind_data ? datagram_spent_ : 0;
  }

  /// Whether the writer has no other reader yet.
  [[nodiscard]] bool is_only_reader() const {
    return !dialogue_.has_neighbour[source_] &&
           std::count(is_opened_.begin(), is_opened_.end(), true) == 1;
  }

  Unexplained fault(const Sent& one, Fault kind, std::string what, std::string nearest,
                    std::vector<Need> needs) {
    const Relation& relation = *writer_.relations[one.relation];
    Unexplained result{one.event,        kind, relation.place, std::move(what), std::move(nearest),
                       std::move(needs), {}};
    result.context = context_of(relation, one.event);
    return result;
  }

  const Dialogue& dialogue_;
  const WriterRelations& writer_;
  const model::SedpProfile& sedp_;
  const Bounds& bounds_;
  Tally<fsm::HeartbeatTimer>& machine_;
  Ledger& ledger_;
  std::size_t source_;

  std::vector<Sent> sent_;
  std::vector<Charge> charges_;  ///< in order
  std::size_t charged_ = 0;
  std::optional<std::int64_t> last_data_ns_;  ///< when this writer last sent DATA
  std::int64_t sent_bytes_ = 0;
  std::optional<std::uint32_t> datagram_;  ///< that was sent last
  std::int64_t datagram_bytes_ = 0;        ///< its payload
  std::int64_t datagram_spent_ = 0;        ///< what its DATA is charged, at most
  std::int64_t spent_ = 0;                 ///< of the piggyback budget, at most
  std::optional<Sent> highest_;
  std::set<std::pair<std::uint32_t, std::size_t>> copied_;  ///< count and relation
  std::optional<Sent> repeated_;  ///< the first copy that went to a reader a second time
  std::size_t exchangeable_ = 0;  ///< replies that can have been something else
  std::vector<std::size_t> next_initial_;
  std::vector<bool> is_opened_;
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

std::optional<Unexplained> explain_heartbeats(const Dialogue& dialogue,
                                              const WriterRelations& writer,
                                              const model::SedpProfile& sedp, const Bounds& bounds,
                                              Tally<fsm::HeartbeatTimer>& timer, Ledger& ledger) {
  return Heartbeats{dialogue, writer, sedp, bounds, timer, ledger}.explain();
}

}  // namespace stormproof::conform
