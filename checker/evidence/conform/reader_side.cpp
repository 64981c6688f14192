// Finds out when the ACKNACKs of a relation can have been sent, and says what is wrong with those
// that cannot.
#include "checker/evidence/conform/reader_side.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "checker/evidence/conform/reader_replay.hpp"
#include "checker/evidence/conform/timers.hpp"

namespace stormproof::conform {

namespace {

/// The announcements of the writer's participant open its readers. A client opens its readers of
/// announcements with its first HEARTBEAT(p), and the others when it matches its own writers.
std::vector<Announcement> openings_of(const Dialogue& dialogue, const Relation& relation) {
  const std::size_t destination = *relation.place.destination;
  std::vector<Announcement> found;
  if (kind_of(dialogue, relation.place) != RelationKind::relay) {
    std::ranges::copy_if(dialogue.announcements[relation.place.source], std::back_inserter(found),
                         [&](const Announcement& one) {
                           return !one.destination || one.destination == destination;
                         });
    return found;
  }
  for (const Relation& own : dialogue.relations) {
    if (own.place.source != destination || own.place.writer != relation.place.writer) continue;
    const auto first = std::ranges::find_if(
        own.sent, [](const Submessage& one) { return one.heartbeat.has_value(); });
    if (first == own.sent.end()) continue;
    found.push_back({first->time_ns, first->event, own.place.destination});
  }
  return found;
}

class ReaderSide {
 public:
  ReaderSide(const Context& context, const Relation& relation, Ledger& ledger)
      : dialogue_{context.dialogue},
        relation_{relation},
        sedp_{context.dds.sedp},
        bounds_{context.bounds},
        ledger_{ledger},
        sent_{relation.sent},
        opens_itself_{kind_of(context.dialogue, relation.place) == RelationKind::relay},
        openings_{openings_of(context.dialogue, relation)},
        replay_{context, relation, ledger} {}

  std::optional<Unexplained> explain() {
    std::optional<std::int64_t> announced;
    if (!openings_.empty()) announced = openings_.front().time_ns;
    opens_from_ns_ = announced ? earliest_at(*announced) : INT64_MAX;
    auto fault = explain_in_time(announced);
    if (auto reply_fault = explain_replies()) return reply_fault;  // it comes earlier
    if (fault) return fault;
    if (!replies_.empty() && next_delay_ns_ > 0) replay_.finish();
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
    const Window sent = sent_in(bounds_, answer.time_ns);
    if (!replay_.is_open()) {
      open(std::max(answer.time_ns - sedp_.initial_acknack_delay.count(), opens_from_ns_));
      if (next_delay_ns_ == 0) {
        return fault(answer, Fault::no_such_rule, "initial ACKNACK",
                     "the profile has no initial ACKNACKs", {});
      }
      attempt_ = {opens_from_ns_ - bounds_.most_clock_age_ns,
                  answer.time_ns - next_delay_ns_ + capture_resolution_ns};
    }
    const Window due = attempt_.after(next_delay_ns_);
    if (due.from_ns > sent.to_ns) return initial_early(answer, due.from_ns - answer.time_ns);
    const std::int64_t overdue = sent.from_ns - due.to_ns - bounds_.most_lateness_ns;
    if (attempts_ > 0 && overdue > 0) return initial_late(answer, overdue);
    if (attempts_ == 0) {
      ledger_.used_clock_age(opens_from_ns_ + next_delay_ns_ - answer.time_ns);
    } else {
      const std::int64_t waited = answer.time_ns - last_initial_ns_;
      ledger_.used_lateness(answer.time_ns - due.to_ns);
      ledger_.used_lag(next_delay_ns_ - waited - capture_resolution_ns);
    }
    attempt_ = {
        std::max(sent.from_ns, due.from_ns),
        std::min(sent.to_ns, attempts_ == 0 ? sent.to_ns : due.to_ns + bounds_.most_lateness_ns)};
    ++attempts_;
    at_least_ns_ += next_delay_ns_;
    last_initial_ns_ = answer.time_ns;
    next_delay_ns_ = replay_.attempt(answer);
    return std::nullopt;
  }

  Unexplained initial_early(const Answer& answer, std::int64_t by_ns) {
    const std::int64_t after =
        attempts_ == 0 ? answer.time_ns - opens_from_ns_ : answer.time_ns - last_initial_ns_;
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
      if (attempts_ == 0) {
        needs.push_back(
            {"clock age", bounds_.most_clock_age_ns + from_opening, bounds_.most_clock_age_ns});
      }
    }
    needs.push_back({"a delay before this attempt of at most", after, next_delay_ns_});
    return fault(answer, Fault::initial_early,
                 fmt::format("initial ACKNACK {} after {}", duration(after), since),
                 fmt::format("the profile waits {}: it is sent at the earliest {} later",
                             duration(next_delay_ns_), duration(by_ns)),
                 std::move(needs));
  }

  Unexplained initial_late(const Answer& answer, std::int64_t by_ns) {
    const std::int64_t after = answer.time_ns - last_initial_ns_;
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
    for (std::size_t k = 0; replay_.is_open() && k < arrived; ++k) {
      if (sent_[k].heartbeat && sent_[k].time_ns + bounds_.least_delay_ns > replay_.opened_ns()) {
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
    const Announcement* opening = latest_opening();
    const std::size_t may_be_dropped = opening == nullptr ? 0 : sent_before(*opening);
    const ReplySearch search = search_replies(relation_, replies_, sedp_, bounds_, may_be_dropped);
    for (std::size_t k = 0; k < search.choices.size(); ++k) {
      const Choice& choice = search.choices[k];
      if (!replay_.is_open()) {
        const bool is_dropped = !bounds_.may_lose && choice.arrivals.lost > 0;
        open(is_dropped
                 ? opening->time_ns + (opens_itself_ ? 0 : bounds_.least_delay_ns)
                 : std::min(opens_from_ns_, choice.heartbeat_ns.value_or(replies_[k]->time_ns)));
      }
      replay_.reply(*replies_[k], choice);
    }
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

  /// The first HEARTBEAT that must have arrived at an open reader side and is not answered at the
  /// end, if nothing is lost.
  std::optional<Unexplained> unanswered(std::int64_t announced) {
    const std::int64_t open = replay_.is_open() ? replay_.opened_ns()
                                                : surely_heard(announced) + bounds_.most_delay_ns +
                                                      bounds_.clock_error_ns;
    const std::int64_t answered_within = bounds_.most_delay_ns + bounds_.clock_error_ns +
                                         sedp_.heartbeat_response_delay.count() +
                                         bounds_.most_lateness_ns + bounds_.most_send_lag_ns;
    const Knowledge& known = replay_.knowledge();
    for (std::size_t k = replay_.consumed(); k < sent_.size(); ++k) {
      const Submessage& one = sent_[k];
      if (!one.heartbeat || one.time_ns + bounds_.least_delay_ns <= open ||
          (known.has_heartbeat && one.heartbeat->count <= known.count)) {
        continue;
      }
      if (one.time_ns + answered_within >= dialogue_.end_ns) break;
      return unexplained_in(
          relation_, one.event, Fault::unanswered,
          fmt::format("no ACKNACK answers this HEARTBEAT within {}", duration(answered_within)),
          "every HEARTBEAT that arrives at an open reader is answered, and nothing is lost",
          {{"a loss, or a longer delay", {}, {}}});
    }
    return std::nullopt;
  }

  /// The last announcement of the writer's participant that can have opened the reader side before
  /// its first ACKNACK; what was sent before it can have been dropped. (Between two participants
  /// datagrams arrive in order; a participant need not have been there for the first one.)
  [[nodiscard]] const Announcement* latest_opening() const {
    if (relation_.answers.empty()) return nullptr;
    const Answer& first = relation_.answers.front();
    const std::int64_t waited = first.is_initial ? sedp_.initial_acknack_delay.count() : 0;
    const Announcement* latest = nullptr;
    for (const Announcement& one : openings_) {
      if (one.time_ns + waited > first.time_ns + capture_resolution_ns) break;
      latest = &one;
    }
    return latest;
  }
  [[nodiscard]] std::size_t sent_before(const Announcement& announcement) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        sent_, [&](const Submessage& one) { return one.event < announcement.event; }));
  }
  /// The first announcement of the writer's participant that its reader was there for.
  [[nodiscard]] std::int64_t surely_heard(std::int64_t announced) const {
    const auto& own = dialogue_.announcements[*relation_.place.destination];
    for (const Announcement& one : openings_) {
      if (opens_itself_ || own.empty() || one.event > own.front().event) return one.time_ns;
    }
    return std::max(announced, dialogue_.end_ns);
  }

  // Shared.

  /// When the reader side opens if what opens it was captured then, at the earliest.
  [[nodiscard]] std::int64_t earliest_at(std::int64_t captured_ns) const {
    return opens_itself_ ? captured_ns - bounds_.most_send_lag_ns
                         : captured_ns + bounds_.least_delay_ns - bounds_.clock_error_ns;
  }

  void open(std::int64_t now) {
    at_least_ns_ = opens_from_ns_ - bounds_.most_clock_age_ns;
    next_delay_ns_ = replay_.open(now);
  }
  [[nodiscard]] std::span<const Submessage> window(std::size_t end) const {
    return std::span{sent_}.subspan(replay_.consumed(), end - replay_.consumed());
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
                 opens_itself_ ? "a client opens its readers when it announces itself, or at a tick"
                 : announced   ? "the first announcement of the writer's participant comes later"
                               : "no announcement of the writer's participant is in the capture",
                 std::move(needs));
  }

  Unexplained too_soon(const Answer& answer, std::int64_t by_ns) {
    const std::int64_t after = answer.time_ns - replies_.back()->time_ns;
    return fault(
        answer, Fault::acknack_early,
        fmt::format("ACKNACK {} after the previous one", duration(after)),
        fmt::format("a HEARTBEAT that arrives after the previous ACKNACK is answered {} later",
                    duration(sedp_.heartbeat_response_delay.count())),
        {{"send lag", bounds_.most_send_lag_ns + by_ns, bounds_.most_send_lag_ns},
         {"a heartbeat response delay of at most", after, sedp_.heartbeat_response_delay.count()}});
  }

  Unexplained unexplained_reply(const Answer& answer) {
    const std::size_t sent =
        std::max(replay_.consumed(), sent_until(relation_, answer.time_ns, bounds_));
    const Arrivals all = arrivals_for(answer, replay_.knowledge(), window(sent));
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
      const Arrivals later = arrivals_for(answer, replay_.knowledge(), window(end));
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
    return unexplained_in(relation_, answer.event, kind, std::move(what), std::move(nearest),
                          std::move(needs), cause);
  }

  const Dialogue& dialogue_;
  const Relation& relation_;
  const model::SedpProfile& sedp_;
  const Bounds& bounds_;
  Ledger& ledger_;
  const std::vector<Submessage>& sent_;  ///< by the writer
  const bool opens_itself_;              ///< not because of what the writer's participant sends
  const std::vector<Announcement> openings_;  ///< messages that can open it, in time order
  ReaderReplay replay_;

  std::int64_t opens_from_ns_ = 0;  ///< the earliest instant at which the reader side can open
  Window attempt_{};                ///< of the last initial ACKNACK, or of the opening
  std::int64_t next_delay_ns_ = 0;
  std::int64_t at_least_ns_ = 0;  ///< the earliest instant of `attempt_`, whatever the send lag
  std::uint32_t attempts_ = 0;
  std::int64_t last_initial_ns_ = 0;
  std::vector<const Answer*> replies_;  ///< ACKNACKs that answer HEARTBEATs
  std::int64_t replied_from_ns_ = 0;    ///< the earliest instant of the last reply
};

}  // namespace

std::optional<Unexplained> explain_reader(const Context& context, const Relation& relation,
                                          Ledger& ledger) {
  return ReaderSide{context, relation, ledger}.explain();
}

}  // namespace stormproof::conform
