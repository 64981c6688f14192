// Depth first, the least end first. What a reader knows after a reply is given by the reply, by how
// far it has got, and by what was announced; a combination that led nowhere is not tried again.
#include "checker/evidence/conform/reply_search.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform {

namespace {

/// Submessages that may be looked at before the search is given up.
constexpr std::size_t effort_limit = 200'000'000;

/// What is supposed to be lost beyond what the ACKNACK says, in the two ways that matter later.
struct Supposed {
  bool cut = false;             ///< the part before `end` of the datagram that `end` cuts
  std::size_t unmentioned = 0;  ///< so many of the last descriptors that nothing has announced

  [[nodiscard]] bool nothing() const { return !cut && unmentioned == 0; }
  /// What to suppose after this; `may_cut`: there is a datagram that `end` cuts.
  [[nodiscard]] Supposed following(bool may_cut) const {
    return may_cut && !cut ? Supposed{true, unmentioned} : Supposed{false, unmentioned + 1};
  }
};

/// The state before one reply, and the choice for it that is being tried.
struct Level {
  std::size_t consumed = 0;
  Knowledge knowledge{};
  bool has_spare = false;  ///< a HEARTBEAT arrived while the last reply was being generated
  std::size_t next_end = 0;
  Supposed next_supposed{};  ///< with `next_end`
};

class Search {
 public:
  Search(const Relation& relation, std::span<const Answer* const> replies,
         const model::SedpProfile& sedp, const Bounds& bounds, std::size_t may_be_dropped)
      : relation_{relation},
        replies_{replies},
        sedp_{sedp},
        bounds_{bounds},
        may_be_dropped_{may_be_dropped} {}

  ReplySearch run() {
    std::vector<Level> levels(1);
    while (levels.size() <= replies_.size()) {
      const std::size_t reply = levels.size() - 1;
      if (auto choice = next(levels.back(), reply)) {
        levels.push_back(after(*choice));
        choices_.push_back(std::move(*choice));
        continue;
      }
      if (effort_ > effort_limit) return {ReplySearch::Kind::given_up, {}, farthest_, {}};
      if (reply >= farthest_) remember(reply);
      dead_.insert(key(reply, levels.back()));
      levels.pop_back();
      if (levels.empty()) {
        return {ReplySearch::Kind::not_explained, std::move(best_), farthest_, misplaced_};
      }
      choices_.pop_back();
    }
    return {ReplySearch::Kind::explained, std::move(choices_), 0, {}};
  }

 private:
  using Key = std::tuple<std::size_t, std::size_t, std::uint32_t, std::uint32_t, bool,
                         std::optional<std::uint32_t>>;
  static Key key(std::size_t reply, const Level& level) {
    return {
        reply,           level.consumed,        level.knowledge.announced, level.knowledge.count,
        level.has_spare, level.knowledge.missed};
  }

  /// The state after a reply. Generating it takes time, if threads are ever delayed at all.
  [[nodiscard]] Level after(const Choice& choice) const {
    const std::size_t used = choice.heartbeat_ns ? 1 : 0;
    return {choice.end,
            choice.arrivals.after,
            bounds_.most_send_lag_ns > 0 && choice.arrivals.heartbeats > used,
            0,
            {}};
  }

  void remember(std::size_t reply) {
    farthest_ = reply;
    best_ = choices_;
    misplaced_ = tried_misplaced_;
  }

  /// The next way to explain `reply` from here.
  std::optional<Choice> next(Level& level, std::size_t reply) {
    const Answer& answer = *replies_[reply];
    const std::size_t sent =
        std::max(sent_until(relation_, answer.time_ns, bounds_), level.consumed);
    if (level.next_end == 0) tried_misplaced_.reset();
    level.next_end = std::max({level.next_end, level.consumed + (level.has_spare ? 0 : 1),
                               expired(relation_, answer, bounds_)});
    while (level.next_end <= sent && effort_ <= effort_limit) {
      Choice choice;
      choice.end = level.next_end;
      const Supposed supposed = level.next_supposed;
      level.next_supposed = supposed.following(cuts_datagram(level, choice.end));
      const auto lost = lost_if(supposed, level, answer, choice.end);
      const bool explains = lost && explain(level, reply, *lost, choice);
      // What cannot be explained with as much as possible cannot with less.
      if (!lost || (supposed.nothing() && !explains)) {
        ++level.next_end;
        level.next_supposed = {};
      }
      if (!explains || dead_.count(key(reply + 1, after(choice))) > 0) continue;
      return choice;
    }
    return std::nullopt;
  }

  /// Whether `end` cuts a datagram, so that one may be lost of which nothing else has come.
  [[nodiscard]] bool cuts_datagram(const Level& level, std::size_t end) const {
    const auto& sent = relation_.sent;
    return end > level.consumed && end < sent.size() &&
           sent[end].datagram == sent[end - 1].datagram;
  }

  /// Descriptors in the window until `end` that the ACKNACK need not mention, because nothing has
  /// announced them.
  [[nodiscard]] std::set<std::uint32_t> unmentioned(const Level& level, const Answer& answer,
                                                    std::size_t end) const {
    std::set<std::uint32_t> found;
    for (std::size_t k = level.consumed; k < end; ++k) {
      const auto d = relation_.sent[k].descriptor;
      if (d && *d >= answer.base && !answer.asks_for(*d) && !level.knowledge.knows(*d)) {
        found.insert(*d);
      }
    }
    return found;
  }

  /// Submessages of the window until `end` that are lost for sure if this is supposed; nothing: it
  /// cannot be.
  [[nodiscard]] std::optional<std::vector<bool>> lost_if(const Supposed& supposed,
                                                         const Level& level, const Answer& answer,
                                                         std::size_t end) const {
    std::vector<bool> lost(end - level.consumed);
    if (supposed.nothing()) return lost;
    if (!bounds_.may_lose || lost.empty()) return std::nullopt;
    const std::set<std::uint32_t> silent = unmentioned(level, answer, end);
    if (supposed.unmentioned > silent.size()) return std::nullopt;
    if (supposed.cut) lost.back() = true;
    if (supposed.unmentioned == 0) return lost;
    const std::uint32_t limit =
        *std::prev(silent.end(), static_cast<std::ptrdiff_t>(supposed.unmentioned));
    for (std::size_t k = 0; k < lost.size(); ++k) {
      const Submessage& one = relation_.sent[level.consumed + k];
      if ((one.descriptor && *one.descriptor >= limit) ||
          (one.heartbeat && one.heartbeat->announced > limit)) {
        lost[k] = true;
      }
    }
    return lost;
  }

  /// Which submessages arrived, and when the HEARTBEAT did that `reply` answers. One that is too
  /// old to be answered now was lost, if anything may be, or dropped.
  bool explain(const Level& level, std::size_t reply, std::vector<bool> lost, Choice& choice) {
    const auto window =
        std::span{relation_.sent}.subspan(level.consumed, choice.end - level.consumed);
    const Answer& answer = *replies_[reply];
    for (;;) {
      effort_ += window.size();
      choice.arrivals = arrivals_for(answer, level.knowledge, window, lost);
      if (!choice.arrivals.mismatch.empty()) return false;
      if (!bounds_.may_lose && loses(level, choice)) return false;
      if (level.has_spare && follows_closely(reply)) return true;
      if (!choice.arrivals.heartbeat) return false;
      const std::size_t heartbeat = *choice.arrivals.heartbeat;
      if (place(answer, level.consumed + heartbeat, choice)) return true;
      const bool can_be_missing = bounds_.may_lose || level.consumed + heartbeat < may_be_dropped_;
      if (!tried_misplaced_ || tried_misplaced_->late_ns == 0 || !can_be_missing) return false;
      if (lost[heartbeat]) return false;  // a part of its datagram has arrived
      lost[heartbeat] = true;
    }
  }

  /// Whether something is missing that an open reader side would have received.
  [[nodiscard]] bool loses(const Level& level, const Choice& choice) const {
    const auto& arrived = choice.arrivals.arrived;
    for (std::size_t k = 0; k < arrived.size(); ++k) {
      if (!arrived[k] && level.consumed + k >= may_be_dropped_) return true;
    }
    return false;
  }

  /// Whether a HEARTBEAT that arrived during the reply before can be what this one answers.
  [[nodiscard]] bool follows_closely(std::size_t reply) const {
    const std::int64_t after = replies_[reply]->time_ns - replies_[reply - 1]->time_ns;
    return after <= sedp_.heartbeat_response_delay.count() + bounds_.most_lateness_ns +
                        bounds_.most_send_lag_ns;
  }

  /// When the HEARTBEAT that the ACKNACK answers arrived: as late as possible.
  bool place(const Answer& answer, std::size_t heartbeat, Choice& choice) {
    const Submessage& cause = relation_.sent[heartbeat];
    const std::int64_t latest =
        answer.time_ns - sedp_.heartbeat_response_delay.count() + capture_resolution_ns;
    const std::int64_t earliest = cause.time_ns + bounds_.least_delay_ns - bounds_.clock_error_ns;
    if (earliest > latest) {
      tried_misplaced_ = Misplaced{heartbeat, earliest - latest, 0};
      return false;
    }
    choice.heartbeat_ns =
        std::min(latest, cause.time_ns + bounds_.most_delay_ns + bounds_.clock_error_ns);
    const std::int64_t late =
        latest - 2 * capture_resolution_ns - *choice.heartbeat_ns - bounds_.most_send_lag_ns;
    if (late <= bounds_.most_lateness_ns) return true;
    tried_misplaced_ = Misplaced{heartbeat, 0, late - bounds_.most_lateness_ns};
    return false;
  }

  const Relation& relation_;
  std::span<const Answer* const> replies_;
  const model::SedpProfile& sedp_;
  const Bounds& bounds_;
  std::size_t may_be_dropped_;
  std::vector<Choice> choices_;
  std::set<Key> dead_;
  std::size_t farthest_ = 0;
  std::vector<Choice> best_;
  std::optional<Misplaced> misplaced_;
  std::optional<Misplaced> tried_misplaced_;
  std::size_t effort_ = 0;
};

}  // namespace

std::size_t sent_until(const Relation& relation, std::int64_t time_ns, const Bounds& bounds) {
  const std::int64_t latest = time_ns - bounds.least_delay_ns + bounds.clock_error_ns;
  const auto later =
      std::partition_point(relation.sent.begin(), relation.sent.end(),
                           [latest](const Submessage& one) { return one.time_ns <= latest; });
  return static_cast<std::size_t>(later - relation.sent.begin());
}

std::size_t expired(const Relation& relation, const Answer& answer, const Bounds& bounds) {
  const std::int64_t before =
      answer.time_ns - bounds.most_send_lag_ns - bounds.most_delay_ns - bounds.clock_error_ns;
  const auto later =
      std::partition_point(relation.sent.begin(), relation.sent.end(),
                           [before](const Submessage& one) { return one.time_ns < before; });
  return static_cast<std::size_t>(later - relation.sent.begin());
}

ReplySearch search_replies(const Relation& relation, std::span<const Answer* const> replies,
                           const model::SedpProfile& sedp, const Bounds& bounds,
                           std::size_t may_be_dropped) {
  return Search{relation, replies, sedp, bounds, may_be_dropped}.run();
}

}  // namespace stormproof::conform
