// Chooses receptions for each ACKNACK of a relation and replays them through the reader's machines.
#include "checker/conform/reader_side.hpp"

#include <fmt/format.h>

#include "checker/conform/reply_search.hpp"
#include "checker/conform/words.hpp"

namespace stormproof::conform {

namespace {

namespace reader = fsm::discovery_reader;
namespace initial = fsm::initial_acknack;
namespace shot = fsm::single_shot;

/// The instants between which something happened.
struct Window {
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
};

class ReaderSide {
 public:
  ReaderSide(const Dialogue& dialogue, const Relation& relation, const model::SedpProfile& sedp,
             const Bounds& bounds, ReaderMachines& machines, Tally<fsm::SingleShot>& timers,
             Ledger& ledger)
      : dialogue_{dialogue},
        relation_{relation},
        sedp_{sedp},
        bounds_{bounds},
        machines_{machines},
        timers_{timers},
        ledger_{ledger},
        sent_{relation.sent} {}

  std::optional<Unexplained> explain() {
    const auto announced =
        dialogue_.first_announced(relation_.place.source, *relation_.place.destination);
    opens_from_ns_ = announced.value_or(INT64_MAX - bounds_.least_delay_ns) +
                     bounds_.least_delay_ns - bounds_.clock_error_ns;
    auto fault = explain_in_time(announced);
    if (auto reply_fault = explain_replies()) return reply_fault;  // it comes earlier
    if (fault) return fault;
    finish();
    return announced && !bounds_.may_lose ? unanswered(*announced) : std::nullopt;
  }

 private:
  /// What can be said of the answers by their times alone: initial ACKNACKs, and the distance of
  /// replies. The replies until the first fault are collected.
  std::optional<Unexplained> explain_in_time(std::optional<std::int64_t> announced) {
    for (const Answer& answer : relation_.answers) {
      if (!announced || answer.time_ns < opens_from_ns_ - capture_resolution_ns) {
        return not_announced(answer, announced);
      }
      const auto fault = answer.is_initial ? explain_initial(answer) : follow(answer);
      if (fault) return fault;
    }
    return std::nullopt;
  }

  // The initial ACKNACK.

  std::optional<Unexplained> explain_initial(const Answer& answer) {
    if (!replies_.empty()) {
      return fault(answer, Fault::initial_after_heartbeat,
                   "initial ACKNACK, although this reader has answered a HEARTBEAT before",
                   "once a HEARTBEAT has arrived, no initial ACKNACK is sent any more", {});
    }
    if (const Submessage* heartbeat = bounds_.may_lose ? nullptr : arrived_heartbeat(answer)) {
      return fault(answer, Fault::initial_after_heartbeat,
                   "initial ACKNACK, although a HEARTBEAT must have arrived before",
                   "a HEARTBEAT stops the initial ACKNACKs, and nothing is lost",
                   {{"delay", answer.time_ns - heartbeat->time_ns, bounds_.most_delay_ns}},
                   heartbeat->event);
    }
    Window sent{answer.time_ns - bounds_.most_send_lag_ns, answer.time_ns + capture_resolution_ns};
    if (!is_open_) {
      open(answer.time_ns - sedp_.initial_acknack_delay.count());
      if (next_delay_ns_ == 0) {
        return fault(answer, Fault::no_such_rule, "initial ACKNACK",
                     "the profile has no initial ACKNACKs", {});
      }
      attempt_ = {opens_from_ns_, answer.time_ns - next_delay_ns_ + capture_resolution_ns};
    }
    const Window due{attempt_.from_ns + next_delay_ns_, attempt_.to_ns + next_delay_ns_};
    if (due.from_ns > sent.to_ns) return initial_early(answer, due.from_ns - answer.time_ns);
    const std::int64_t overdue = sent.from_ns - due.to_ns - bounds_.most_lateness_ns;
    if (attempts_ > 0 && overdue > 0) return initial_late(answer, overdue);
    if (attempts_ > 0) {
      const std::int64_t waited = answer.time_ns - last_answer_ns_;
      ledger_.used_lateness(answer.time_ns - due.to_ns);
      ledger_.used_lag(next_delay_ns_ - waited - capture_resolution_ns);
    }
    attempt_ = {
        std::max(sent.from_ns, due.from_ns),
        std::min(sent.to_ns, attempts_ == 0 ? sent.to_ns : due.to_ns + bounds_.most_lateness_ns)};
    send_initial(answer);
    return std::nullopt;
  }

  void send_initial(const Answer& answer) {
    ++attempts_;
    at_least_ns_ += next_delay_ns_;
    last_answer_ns_ = answer.time_ns;
    const auto attempt = machines_.initial.step<initial::AttemptDue>(
        initial_state_, {.now = answer.time_ns,
                         .first_delay = sedp_.initial_acknack_delay.count(),
                         .last_delay = next_delay_ns_,
                         .heartbeat_seen = false,
                         .constant = is_constant()});
    next_delay_ns_ = attempt.next_delay;
    const auto output = machines_.reader.step<reader::InitialAckNackDue>(state_, {});
    confirm(attempt.attempt && output.send_initial, Rule::acknack_initial);
    ledger_.hidden(Hidden::Kind::timer, answer.time_ns, answer.event, "InitialAckNack");
  }

  Unexplained initial_early(const Answer& answer, std::int64_t by_ns) {
    const std::int64_t after =
        attempts_ == 0 ? answer.time_ns - opens_from_ns_ : answer.time_ns - last_answer_ns_;
    const std::string since = attempts_ == 0
                                  ? "the first announcement that the reader can have received"
                                  : "the previous initial ACKNACK";
    std::vector<Need> needs;
    // The earlier attempts may have waited longer for their capture, but the first one comes τ_I
    // after the announcement.
    const std::int64_t from_opening = at_least_ns_ + next_delay_ns_ - answer.time_ns;
    if (from_opening <= 0) {
      needs.push_back({"send lag", bounds_.most_send_lag_ns + by_ns, bounds_.most_send_lag_ns});
    } else {
      needs.push_back(
          {"clock error", bounds_.clock_error_ns + from_opening, bounds_.clock_error_ns});
    }
    needs.push_back({"a delay before this attempt of at most", after, next_delay_ns_});
    return fault(answer, Fault::initial_early,
                 fmt::format("initial ACKNACK {} after {}", duration(after), since),
                 fmt::format("the profile waits {}: it is sent at the earliest {} later",
                             duration(next_delay_ns_), duration(by_ns)),
                 std::move(needs));
  }

  Unexplained initial_late(const Answer& answer, std::int64_t by_ns) {
    const std::int64_t after = answer.time_ns - last_answer_ns_;
    return fault(answer, Fault::initial_late,
                 fmt::format("initial ACKNACK {} after the previous one", duration(after)),
                 fmt::format("the profile waits {}: without a HEARTBEAT it is sent at the latest "
                             "{} earlier",
                             duration(next_delay_ns_), duration(by_ns)),
                 {{"lateness", bounds_.most_lateness_ns + by_ns, bounds_.most_lateness_ns},
                  {"a delay before this attempt of at least",
                   after - bounds_.most_lateness_ns - bounds_.most_send_lag_ns, next_delay_ns_}});
  }

  /// A HEARTBEAT that arrives at an open reader before `answer` whatever its delay is.
  [[nodiscard]] const Submessage* arrived_heartbeat(const Answer& answer) const {
    const std::size_t arrived = expired(relation_, answer, bounds_);
    for (std::size_t k = 0; is_open_ && k < arrived; ++k) {
      if (sent_[k].heartbeat && sent_[k].time_ns + bounds_.least_delay_ns > opened_ns_) {
        return &sent_[k];
      }
    }
    return nullptr;
  }

  // ACKNACKs that answer HEARTBEATs.

  /// A reply is generated τ_A after a HEARTBEAT arrived, which is after the reply before it.
  std::optional<Unexplained> follow(const Answer& answer) {
    const std::int64_t delay = sedp_.heartbeat_response_delay.count();
    const std::int64_t latest = answer.time_ns - delay + capture_resolution_ns;
    if (!replies_.empty() && latest < replied_from_ns_) {
      return too_soon(answer, replied_from_ns_ - latest);
    }
    replied_from_ns_ = replies_.empty() ? answer.time_ns - bounds_.most_send_lag_ns
                                        : std::max(answer.time_ns - bounds_.most_send_lag_ns,
                                                   replied_from_ns_ + delay);
    replies_.push_back(&answer);
    return std::nullopt;
  }

  std::optional<Unexplained> explain_replies() {
    const ReplySearch search = search_replies(relation_, replies_, sedp_, bounds_);
    for (std::size_t k = 0; k < search.choices.size(); ++k) replay(*replies_[k], search.choices[k]);
    if (search.kind == ReplySearch::Kind::explained) return std::nullopt;
    if (search.kind == ReplySearch::Kind::given_up) {
      ledger_.undecided();
      return std::nullopt;
    }
    const Answer& answer = *replies_[search.failed];
    return search.misplaced ? misplaced(answer, *search.misplaced) : unexplained_reply(answer);
  }

  Unexplained misplaced(const Answer& answer, const Misplaced& where) {
    const Submessage& message = sent_[where.heartbeat];
    const std::int64_t after = answer.time_ns - message.time_ns;
    if (where.late_ns > 0) {
      return fault(answer, Fault::acknack_cause,
                   "ACKNACK, and the HEARTBEAT that it can answer was sent too long ago",
                   fmt::format("it answers the HEARTBEAT of {} before", duration(after)),
                   {{"delay", bounds_.most_delay_ns + where.late_ns, bounds_.most_delay_ns}},
                   message.event);
    }
    return fault(
        answer, Fault::acknack_early,
        fmt::format("ACKNACK {} after the only HEARTBEAT that it can answer", duration(after)),
        fmt::format("the reader waits {} after the arrival of a HEARTBEAT: it answers at "
                    "the earliest {} later",
                    duration(sedp_.heartbeat_response_delay.count()), duration(where.early_ns)),
        {{"clock error", bounds_.clock_error_ns + where.early_ns, bounds_.clock_error_ns},
         {"a heartbeat response delay of at most", after, sedp_.heartbeat_response_delay.count()}},
        message.event);
  }

  /// Lets the chosen messages arrive, in order, and the reply be generated.
  void replay(const Answer& answer, const Choice& choice) {
    if (!is_open_) open(std::min(opens_from_ns_, choice.heartbeat_ns.value_or(answer.time_ns)));
    fsm::StateId reply = Tally<fsm::SingleShot>::Fly::initial;
    std::int64_t due = answer.time_ns;
    std::int64_t now = last_reception_ns_;
    const auto arm = [&] {
      const auto timer = timers_.step<shot::Requested>(
          reply, {.now = now, .delay = sedp_.heartbeat_response_delay.count()});
      if (timer.schedule) due = timer.next_at;
    };
    if (!choice.heartbeat_ns) {
      now = std::max(now, last_answer_ns_);
      arm();
    }
    for (std::size_t k = 0; k < choice.arrivals.arrived.size(); ++k) {
      const Submessage& message = sent_[consumed_ + k];
      now = std::max(now, message.time_ns + bounds_.least_delay_ns);
      if (!choice.arrivals.arrived[k]) {
        miss(message);
        continue;
      }
      if (choice.heartbeat_ns && choice.arrivals.heartbeat == k) {
        now = std::max(now, *choice.heartbeat_ns);
      }
      ledger_.hidden(Hidden::Kind::received, now, message.event);
      if (receive(message)) arm();
    }
    last_reception_ns_ = std::min(now, answer.time_ns);
    consumed_ = choice.end;
    const auto fired = timers_.step<shot::Due>(reply, {.now = due});
    const auto output = machines_.reader.step<reader::AckNackDue>(
        state_, {.accepts_unmatched = false, .missing_after = missing()});
    confirm(fired.fire && output.send_acknack && says(answer), Rule::acknack_reply);
    ledger_.used_lateness(answer.time_ns - due - bounds_.most_send_lag_ns);
    has_replied_ = true;
    last_answer_ns_ = answer.time_ns;
  }

  void confirm(bool replayed, Rule rule) {
    replayed ? ledger_.explained(rule) : ledger_.not_replayed();
  }

  /// A datagram is lost, or was there before the reader side opened.
  void miss(const Submessage& message) {
    if (missed_ == message.datagram) return;
    missed_ = message.datagram;
    const bool before = message.time_ns + bounds_.least_delay_ns <= opened_ns_;
    ledger_.hidden(before ? Hidden::Kind::dropped : Hidden::Kind::lost, message.time_ns,
                   message.event);
  }

  /// A submessage arrives at the reader's machine; whether it schedules an ACKNACK.
  bool receive(const Submessage& message) {
    const bool accepted = knowledge_.take(message);
    const fsm::DiscoveryReaderIo::Input<fsm::Plain> input{.accepts_unmatched = false,
                                                          .missing_after = missing()};
    if (message.descriptor) machines_.reader.step<reader::DataReceived>(state_, input);
    if (!message.heartbeat || !accepted) return false;
    return machines_.reader.step<reader::HeartbeatReceived>(state_, input).schedule_acknack;
  }

  /// Whether the ACKNACK that the machines send now is the captured one.
  [[nodiscard]] bool says(const Answer& answer) const {
    if (knowledge_.base() != answer.base) return false;
    const std::uint32_t end = std::min(knowledge_.announced, answer.base + 256);
    for (std::uint32_t d = answer.base; d < end; ++d) {
      if (knowledge_.knows(d) == answer.asks_for(d)) return false;
    }
    return true;
  }

  /// The first HEARTBEAT that must have arrived at an open reader side and is not answered at the
  /// end, if nothing is lost.
  std::optional<Unexplained> unanswered(std::int64_t announced) {
    const std::int64_t open =
        is_open_ ? opened_ns_ : announced + bounds_.most_delay_ns + bounds_.clock_error_ns;
    const std::int64_t answered_within = bounds_.most_delay_ns + bounds_.clock_error_ns +
                                         sedp_.heartbeat_response_delay.count() +
                                         bounds_.most_lateness_ns + bounds_.most_send_lag_ns;
    for (std::size_t k = consumed_; k < sent_.size(); ++k) {
      const Submessage& one = sent_[k];
      if (!one.heartbeat || one.time_ns + bounds_.least_delay_ns <= open ||
          (knowledge_.has_heartbeat && one.heartbeat->count <= knowledge_.count)) {
        continue;
      }
      if (one.time_ns + answered_within >= dialogue_.end_ns) break;
      Unexplained result{
          one.event,
          Fault::unanswered,
          relation_.place,
          fmt::format("no ACKNACK answers this HEARTBEAT within {}", duration(answered_within)),
          "every HEARTBEAT that arrives at an open reader is answered, and nothing "
          "is lost",
          {{"a loss, or a longer delay", {}, {}}},
          {}};
      result.context = context_of(relation_, one.event);
      return result;
    }
    return std::nullopt;
  }

  // Shared.

  void open(std::int64_t now) {
    is_open_ = true;
    opened_ns_ = now;
    at_least_ns_ = opens_from_ns_;
    machines_.reader.step<reader::AnnouncementReceived>(state_, {.missing_after = missing()});
    const auto output = machines_.initial.step<initial::ReaderOpened>(
        initial_state_, {.now = now,
                         .first_delay = sedp_.initial_acknack_delay.count(),
                         .constant = is_constant()});
    next_delay_ns_ = output.next_delay;
    ledger_.hidden(Hidden::Kind::recognised, now, std::nullopt);
  }

  /// What of the rest has arrived does not matter; an attempt finds that a HEARTBEAT was seen.
  void finish() {
    if (has_replied_ && next_delay_ns_ > 0) {
      machines_.initial.step<initial::AttemptDue>(initial_state_, {.heartbeat_seen = true});
    }
  }

  [[nodiscard]] bool is_constant() const {
    return sedp_.initial_acknack_interval == model::InitialAckNackInterval::constant;
  }
  [[nodiscard]] std::int64_t missing() const {
    const std::size_t index = 2 * relation_.place.source + stream_index(relation_.place.writer);
    const auto known = std::count(knowledge_.has.begin(), knowledge_.has.end(), true);
    return static_cast<std::int64_t>(dialogue_.descriptors[index]) - known;
  }
  [[nodiscard]] std::span<const Submessage> window(std::size_t end) const {
    return std::span{sent_}.subspan(consumed_, end - consumed_);
  }

  // Findings.

  Unexplained not_announced(const Answer& answer, std::optional<std::int64_t> announced) {
    std::vector<Need> needs;
    if (announced) {
      const std::int64_t by = opens_from_ns_ - answer.time_ns;
      needs.push_back({"clock error", bounds_.clock_error_ns + by, bounds_.clock_error_ns});
    }
    return fault(answer, Fault::not_announced,
                 "ACKNACK to a participant that the reader cannot know yet",
                 announced ? "the first announcement of the writer's participant comes later"
                           : "no announcement of the writer's participant is in the capture",
                 std::move(needs));
  }

  Unexplained too_soon(const Answer& answer, std::int64_t by_ns) {
    const std::int64_t after = answer.time_ns - last_answer_ns_;
    return fault(
        answer, Fault::acknack_early,
        fmt::format("ACKNACK {} after the previous one", duration(after)),
        fmt::format("a HEARTBEAT that arrives after the previous ACKNACK is answered {} later",
                    duration(sedp_.heartbeat_response_delay.count())),
        {{"send lag", bounds_.most_send_lag_ns + by_ns, bounds_.most_send_lag_ns},
         {"a heartbeat response delay of at most", after, sedp_.heartbeat_response_delay.count()}});
  }

  Unexplained unexplained_reply(const Answer& answer) {
    const std::size_t sent = std::max(consumed_, sent_until(relation_, answer.time_ns, bounds_));
    const Arrivals all = arrivals_for(answer, knowledge_, window(sent));
    const bool is_content = !all.mismatch.empty();
    const std::string why = is_content ? all.mismatch
                            : all.heartbeats == 0
                                ? "no HEARTBEAT can have arrived that it answers"
                                : "it can be explained only by losing datagrams, which is not "
                                  "admitted";
    std::vector<Need> needs;
    std::string nearest = "nothing that the writer sends later would explain it either";
    // What else would have to be under way already.
    for (std::size_t end = sent + 1; end <= sent_.size(); ++end) {
      const Arrivals later = arrivals_for(answer, knowledge_, window(end));
      if (!later.mismatch.empty() || later.heartbeats == 0) continue;
      const Submessage& message = sent_[end - 1];
      const std::int64_t by = message.time_ns + bounds_.least_delay_ns - answer.time_ns;
      nearest = fmt::format("a message that the writer sends {} later would explain it",
                            duration(message.time_ns - answer.time_ns));
      needs.push_back({"clock error", by, bounds_.clock_error_ns});
      break;
    }
    if (needs.empty() && !is_content) {
      nearest = "every HEARTBEAT until then is answered by an earlier ACKNACK, or is lost";
      needs.push_back({"one more HEARTBEAT to this reader before it", {}, {}});
    }
    return fault(answer, is_content ? Fault::acknack_content : Fault::acknack_cause,
                 fmt::format("ACKNACK of {}: {}", words(answer), why), nearest, std::move(needs));
  }

  Unexplained fault(const Answer& answer, Fault kind, std::string what, std::string nearest,
                    std::vector<Need> needs, std::optional<std::size_t> cause = {}) {
    Unexplained one{answer.event,     kind, relation_.place, std::move(what), std::move(nearest),
                    std::move(needs), {}};
    one.context = context_of(relation_, answer.event, cause);
    return one;
  }

  const Dialogue& dialogue_;
  const Relation& relation_;
  const model::SedpProfile& sedp_;
  const Bounds& bounds_;
  ReaderMachines& machines_;
  Tally<fsm::SingleShot>& timers_;
  Ledger& ledger_;
  const std::vector<Submessage>& sent_;  ///< by the writer

  std::int64_t opens_from_ns_ = 0;  ///< the earliest instant at which the reader side can open
  bool is_open_ = false;
  std::int64_t opened_ns_ = 0;
  std::optional<std::uint32_t> missed_;  ///< the last datagram that did not arrive
  fsm::StateId state_ = Tally<fsm::DiscoveryReader>::Fly::initial;
  fsm::StateId initial_state_ = Tally<fsm::InitialAckNack>::Fly::initial;
  Window attempt_{};  ///< of the last initial ACKNACK, or of the opening
  std::int64_t next_delay_ns_ = 0;
  std::int64_t at_least_ns_ = 0;  ///< the earliest instant of `attempt_`, whatever the send lag
  std::uint32_t attempts_ = 0;
  std::size_t consumed_ = 0;  ///< of `sent_`: have arrived or are lost
  Knowledge knowledge_{};
  std::int64_t last_reception_ns_ = INT64_MIN / 2;
  std::vector<const Answer*> replies_;  ///< ACKNACKs that answer HEARTBEATs
  bool has_replied_ = false;
  std::int64_t replied_from_ns_ = 0;  ///< the earliest instant of the last reply
  std::int64_t last_answer_ns_ = 0;
};

}  // namespace

std::optional<Unexplained> explain_reader(const Dialogue& dialogue, const Relation& relation,
                                          const model::SedpProfile& sedp, const Bounds& bounds,
                                          ReaderMachines& machines, Tally<fsm::SingleShot>& timers,
                                          Ledger& ledger) {
  return ReaderSide{dialogue, relation, sedp, bounds, machines, timers, ledger}.explain();
}

}  // namespace stormproof::conform
