// All ways to tell scheduled multicasts from resends are followed at once; those whose timer would
// be early or overdue are given up.
#include "checker/evidence/conform/announcements.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/machines.hpp"
#include "checker/evidence/conform/senders.hpp"
#include "checker/evidence/conform/static_peers.hpp"
#include "checker/evidence/conform/timers.hpp"
#include "checker/evidence/conform/ways.hpp"

namespace stormproof::conform {

namespace {

/// One way to explain the multicasts so far.
struct Way {
  std::vector<bool> is_scheduled{};
  Window due{};                 ///< the next scheduled one
  std::int64_t nominal_ns = 0;  ///< of the next one, if nothing is ever late
  std::int64_t worst_ns = 0;    ///< how far one was from its nominal time, at most
  std::size_t resends = 0;
  /// Multicasts taken as scheduled though the first copy to somebody goes with them, as it does
  /// with a resend: of ways that are alike, those with fewer are nearer to what happened.
  std::size_t unlikely = 0;

  [[nodiscard]] std::size_t scheduled() const { return is_scheduled.size() - resends; }
  [[nodiscard]] bool is_as_good_as(const Way& other) const {
    return resends == other.resends && due.contains(other.due) && worst_ns <= other.worst_ns &&
           unlikely <= other.unlikely;
  }
};

class Announcements {
 public:
  Announcements(const Context& context, std::size_t participant, Ledger& ledger)
      : dialogue_{context.dialogue},
        participant_{participant},
        spdp_{context.dds.spdp},
        bounds_{context.bounds},
        announcer_{ledger.machines.fastdds.of<fsm::Announcer>()},
        ledger_{ledger} {
    if (context.dds.discovery == model::Discovery::static_peers) {
      static_peers_.emplace(dialogue_, participant, context.dds.peer_ports, bounds_);
    }
    for (std::size_t j = 0; j < dialogue_.participants(); ++j) {
      known_since_.push_back(j == participant ? std::nullopt : known_since(j));
      if (known_since_.back()) recognitions_.push_back(*known_since_.back());
    }
    std::sort(recognitions_.begin(), recognitions_.end());
  }

  std::optional<Unexplained> explain() {
    auto fault = static_peers_ ? explain_rounds() : explain_multicasts(multicasts_of_capture());
    for (const Announcement& one : dialogue_.announcements[participant_]) {
      if (fault && one.event >= fault->event) break;
      if (!one.destination || is_a_round(one)) continue;
      if (auto copy_fault = explain_copy(one)) return copy_fault;
      if (auto copy_fault = one_too_many(one)) return copy_fault;
      ledger_.explained(Rule::announcement_copy, sender_of_copy(one));
    }
    if (!fault && static_peers_) fault = one_too_few();
    return fault ? fault : not_introduced();
  }

 private:
  /// If nothing is lost, who announces itself while this participant is there is recognised, and
  /// gets a copy at once.
  std::optional<Unexplained> not_introduced() {
    const auto& own = dialogue_.announcements[participant_];
    if (bounds_.may_lose || static_peers_ || spdp_.resend == model::SpdpResend::none || own.empty())
      return std::nullopt;
    const std::int64_t last_sign = dialogue_.last_sign_of(participant_)->time_ns;
    for (std::size_t j = 0; j < dialogue_.participants(); ++j) {
      if (!known_since_[j]) continue;
      const auto heard = std::ranges::find_if(dialogue_.announcements[j], [&](const auto& one) {
        return one.time_ns >= own.front().time_ns &&
               (!one.destination || *one.destination == participant_);
      });
      if (heard == dialogue_.announcements[j].end()) continue;
      const std::int64_t due = heard->time_ns + bounds_.most_delay_ns + bounds_.clock_error_ns +
                               bounds_.most_send_lag_ns + capture_resolution_ns;
      const bool is_introduced = std::ranges::any_of(
          own, [&](const Announcement& one) { return one.destination == j && one.time_ns <= due; });
      if (is_introduced || due >= last_sign) continue;
      return fault(*dialogue_.last_sign_of(participant_), Fault::unanswered,
                   fmt::format("no announcement to a participant within {} of its own",
                               duration(due - heard->time_ns)),
                   "who is recognised gets a copy of the announcement at once, and nothing is lost",
                   {{"a loss, or a longer delay", {}, {}}});
    }
    return std::nullopt;
  }

  [[nodiscard]] std::vector<Announcement> multicasts_of_capture() const {
    std::vector<Announcement> found;
    for (const Announcement& one : dialogue_.announcements[participant_]) {
      if (!one.destination) found.push_back(one);
    }
    return found;
  }

  /// With static peers rounds of copies take the place of multicasts. Of ways to find them the
  /// first that is explained is taken, otherwise the one that is explained farthest.
  std::optional<Unexplained> explain_rounds() {
    for (const Announcement& one : dialogue_.announcements[participant_]) {
      if (one.destination) continue;
      return fault(one, Fault::announcement_extra, "announcement by multicast",
                   "with static peers announcements go to the ports of known hosts", {});
    }
    std::optional<Unexplained> farthest;
    for (std::vector<Announcement>& way : static_peers_->ways(known_since_)) {
      auto unexplained = explain_multicasts(std::move(way));
      if (!unexplained) return std::nullopt;
      if (!farthest || unexplained->event > farthest->event) farthest = std::move(unexplained);
    }
    return farthest;
  }
  /// Whether it is the copy that a round is known by.
  [[nodiscard]] bool is_a_round(const Announcement& one) const {
    return std::any_of(multicasts_.begin(), multicasts_.end(),
                       [&](const Announcement& round) { return round.event == one.event; });
  }

  void note_first_copies() {
    has_first_copy_.assign(multicasts_.size(), false);
    for (const Announcement& one : dialogue_.announcements[participant_]) {
      if (!one.destination || !is_first_copy(one)) continue;
      const auto distance = nearest_multicast(one);
      if (!distance || *distance > bounds_.most_send_lag_ns + capture_resolution_ns) continue;
      has_first_copy_[multicast_with(one)] = true;
    }
  }

  /// When this participant can know participant `j`. A round of copies to static peers reaches
  /// those on the same host, too.
  [[nodiscard]] std::optional<std::int64_t> known_since(std::size_t j) const {
    const auto& participants = dialogue_.conversation.topology.participants;
    const bool same_host = participants[j].host == participants[participant_].host;
    if (static_peers_ && same_host && !dialogue_.announcements[j].empty()) {
      return dialogue_.announcements[j].front().time_ns - bounds_.most_send_lag_ns;
    }
    return conform::known_since(dialogue_, participant_, j, bounds_);
  }

  [[nodiscard]] std::int64_t period_after(std::size_t number) const {
    return number < spdp_.startup_announcements ? spdp_.startup_period.count()
                                                : spdp_.period.count();
  }
  [[nodiscard]] bool resends_multicast() const {
    return spdp_.resend == model::SpdpResend::all_known ||
           spdp_.resend == model::SpdpResend::new_and_multicast;
  }

  std::optional<Unexplained> explain_multicasts(std::vector<Announcement> multicasts) {
    multicasts_ = std::move(multicasts);
    note_first_copies();
    std::vector<Way> ways(1);
    for (std::size_t k = 0; k < multicasts_.size(); ++k) {
      std::vector<Way> next;
      for (const Way& way : ways) {
        if (auto on = on_schedule(way, multicasts_[k].time_ns)) {
          if (has_first_copy_[k]) ++on->unlikely;
          next.push_back(*on);
        }
        if (const auto resent = as_resend(way, multicasts_[k].time_ns)) next.push_back(*resent);
      }
      if (next.empty()) return unexplained(ways, multicasts_[k]);
      ways = best(std::move(next));
    }
    if (multicasts_.empty()) return std::nullopt;
    if (auto fault = silent(ways)) return fault;
    for (const Way& way : ways) most_scheduled_ = std::max(most_scheduled_, way.scheduled());
    replay(*std::min_element(ways.begin(), ways.end(), [](const Way& a, const Way& b) {
      return std::pair{a.worst_ns, a.unlikely} < std::pair{b.worst_ns, b.unlikely};
    }));
    return std::nullopt;
  }

  /// While the participant sends anything, its announcement timer goes on.
  std::optional<Unexplained> silent(const std::vector<Way>& ways) {
    const Announcement latest = *dialogue_.last_sign_of(participant_);
    const bool overdue = std::all_of(
        ways.begin(), ways.end(), [&](const Way& way) { return is_overdue(way, latest.time_ns); });
    if (!overdue) return std::nullopt;
    std::int64_t due = INT64_MIN;
    for (const Way& way : ways) due = std::max(due, way.due.to_ns);
    return fault(
        latest, Fault::announcement_due,
        fmt::format("the participant still sends, {} after an announcement was due",
                    duration(latest.time_ns - due)),
        "the announcement timer goes on as long as the participant lives",
        {{"lateness", latest.time_ns - due - bounds_.most_send_lag_ns, bounds_.most_lateness_ns}});
  }

  [[nodiscard]] std::optional<Way> on_schedule(Way way, std::int64_t time_ns) const {
    Window at = sent_in(bounds_, time_ns);
    if (!way.is_scheduled.empty()) {
      const auto again = fired(bounds_, way.due, at);
      if (!again) return std::nullopt;
      at = *again;
      way.worst_ns = std::max(way.worst_ns, std::abs(time_ns - way.nominal_ns));
    }
    const std::int64_t period = period_after(way.scheduled());
    way.nominal_ns = time_ns + period;
    way.due = at.after(period);
    way.is_scheduled.push_back(true);
    return way;
  }

  [[nodiscard]] std::optional<Way> as_resend(Way way, std::int64_t time_ns) const {
    if (way.is_scheduled.empty() || !resends_multicast()) return std::nullopt;
    if (is_overdue(way, time_ns) || way.resends >= recognitions_.size() ||
        recognitions_[way.resends] > time_ns + capture_resolution_ns) {
      return std::nullopt;
    }
    ++way.resends;
    way.is_scheduled.push_back(false);
    return way;
  }

  [[nodiscard]] bool is_overdue(const Way& way, std::int64_t time_ns) const {
    return conform::is_overdue(bounds_, way.due, time_ns);
  }

  void replay(const Way& way) {
    is_scheduled_ = way.is_scheduled;
    fsm::StateId state = Tally<fsm::Announcer>::Fly::initial;
    std::int64_t number = 0;
    std::int64_t due = multicasts_.front().time_ns;
    for (std::size_t k = 0; k < multicasts_.size(); ++k) {
      const std::int64_t now = multicasts_[k].time_ns;
      if (!way.is_scheduled[k]) {
        ledger_.explained(Rule::announcement_resent);
        continue;
      }
      ledger_.used_lateness(now - due);
      ledger_.used_lag(due - now - capture_resolution_ns);
      const auto output = announcer_.step<fsm::announcer::AnnouncementDue>(
          state, {.now = now,
                  .number = number++,
                  .startup = spdp_.startup_announcements,
                  .startup_period = spdp_.startup_period.count(),
                  .period = spdp_.period.count()});
      if (output.announce) ledger_.explained(Rule::announcement_scheduled);
      due = output.next_at;
      ledger_.hidden(Hidden::Kind::timer, now, multicasts_[k].event, "Announcer");
    }
  }

  std::optional<Unexplained> explain_copy(const Announcement& one) {
    const auto known = known_since_[*one.destination];
    if (static_peers_ && static_peers_->reaches(*one.destination)) {
      // It gets one in each round, whether it is known or not.
    } else if (!known || one.time_ns + capture_resolution_ns < *known) {
      std::vector<Need> needs;
      if (known) {
        needs.push_back(
            {"clock error", bounds_.clock_error_ns + *known - one.time_ns, bounds_.clock_error_ns});
      }
      return fault(one, Fault::not_announced,
                   "announcement to a participant that the sender cannot know yet",
                   known ? "the other's first announcement comes later"
                         : "no announcement of the other participant is in the capture",
                   std::move(needs));
    }
    if (static_peers_ && multicasts_.empty()) return std::nullopt;  // no copy tells a round
    const auto distance = nearest_multicast(one);
    if (distance && *distance <= bounds_.most_send_lag_ns + capture_resolution_ns) {
      ledger_.used_lag(*distance - capture_resolution_ns);
      return std::nullopt;
    }
    if (spdp_.resend == model::SpdpResend::new_only && is_first_copy(one)) return std::nullopt;
    return fault(one, Fault::announcement_extra,
                 "announcement to one participant, without a multicast near it",
                 "copies accompany a multicast; a participant that is recognised gets one of its "
                 "own only with resend: new_only",
                 {{"send lag, so that a multicast is near", distance, bounds_.most_send_lag_ns}});
  }

  /// Unless resends go to all, a participant gets a copy with each scheduled multicast, and one
  /// more when it is recognised.
  std::optional<Unexplained> one_too_many(const Announcement& one) {
    if (static_peers_) return two_too_many(one);
    if (spdp_.resend == model::SpdpResend::all_known || multicasts_.empty()) return std::nullopt;
    const std::size_t most = most_scheduled_ + (spdp_.resend == model::SpdpResend::none ? 0 : 1);
    if (++copies_[*one.destination] <= most) return std::nullopt;
    return fault(
        one, Fault::announcement_extra, fmt::format("announcement {} to one participant", most + 1),
        fmt::format("it gets a copy with each scheduled multicast, of which there are {} at "
                    "most, and with the profile's resend not with the others",
                    most_scheduled_),
        {{"as many scheduled multicasts", {}, {}}});
  }

  /// In a round a participant gets a copy because it is known, and one at its port.
  std::optional<Unexplained> two_too_many(const Announcement& one) {
    if (multicasts_.empty()) return std::nullopt;
    const std::size_t of_a_round = static_peers_->most_in_a_round(*one.destination);
    const std::size_t most = of_a_round * multicasts_.size();
    if (++copies_[*one.destination] <= most) return std::nullopt;
    return fault(
        one, Fault::announcement_extra, fmt::format("announcement {} to one participant", most + 1),
        fmt::format("it gets {} in each of {} rounds at most", of_a_round, multicasts_.size()),
        {{"as many rounds", {}, {}}});
  }
  /// Each round has a copy for every port; the last one may be cut off by the end of the capture.
  std::optional<Unexplained> one_too_few() {
    if (multicasts_.empty()) return std::nullopt;
    for (std::size_t j = 0; j < dialogue_.participants(); ++j) {
      if (!static_peers_->reaches(j)) continue;
      const std::size_t copies = static_peers_->copies_to(j);
      if (copies + 1 >= multicasts_.size()) continue;
      return fault(
          multicasts_.back(), Fault::announcement_due,
          fmt::format("{} announcements to one participant", copies),
          fmt::format("the {} rounds until then have one each for its port", multicasts_.size()),
          {});
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_first_copy(const Announcement& one) const {
    const auto& all = dialogue_.announcements[participant_];
    return std::none_of(all.begin(), all.end(), [&](const Announcement& other) {
      return other.event < one.event && other.destination == one.destination;
    });
  }

  /// How far the nearest multicast is.
  [[nodiscard]] std::optional<std::int64_t> nearest_multicast(const Announcement& one) const {
    const std::size_t k = multicast_with(one);
    if (k == multicasts_.size()) return std::nullopt;
    return std::abs(multicasts_[k].time_ns - one.time_ns);
  }
  /// The multicast that a copy accompanies: the nearest, and of several at one instant the next.
  [[nodiscard]] std::size_t multicast_with(const Announcement& one) const {
    std::size_t nearest = multicasts_.size();
    std::tuple<std::int64_t, bool, std::int64_t> least{};
    for (std::size_t k = 0; k < multicasts_.size(); ++k) {
      const Announcement& multicast = multicasts_[k];
      const std::int64_t events =
          static_cast<std::int64_t>(multicast.event) - static_cast<std::int64_t>(one.event);
      const std::tuple distance{std::abs(multicast.time_ns - one.time_ns), events < 0,
                                std::abs(events)};
      if (nearest < multicasts_.size() && least <= distance) continue;
      nearest = k;
      least = distance;
    }
    return nearest;
  }
  /// A copy is sent because its receiver was recognised, which the first one to it always is, or
  /// with a multicast. Of multicasts that are not explained nobody can say why.
  [[nodiscard]] Sender sender_of_copy(const Announcement& one) const {
    if (spdp_.resend != model::SpdpResend::none && is_first_copy(one)) return sends::copies_resent;
    const std::size_t k = multicast_with(one);
    if (k >= is_scheduled_.size()) return {};
    return is_scheduled_[k] ? sends::copies_due : sends::copies_resent;
  }

  Unexplained unexplained(const std::vector<Way>& ways, const Announcement& one) {
    const bool overdue = std::all_of(ways.begin(), ways.end(),
                                     [&](const Way& way) { return is_overdue(way, one.time_ns); });
    std::int64_t due = INT64_MAX;  // of the nearest way
    for (const Way& way : ways) {
      const std::int64_t distance =
          overdue ? one.time_ns - way.due.to_ns : way.due.from_ns - one.time_ns;
      due = std::min(due, distance);
    }
    if (overdue) {
      return fault(one, Fault::announcement_due,
                   fmt::format("this announcement comes {} after it was due", duration(due)),
                   "without a resend the timer announces again after its period",
                   {{"lateness", due - bounds_.most_send_lag_ns, bounds_.most_lateness_ns}});
    }
    return fault(
        one, Fault::announcement_extra,
        fmt::format("multicast {} before the announcement timer is due", duration(due)),
        resends_multicast()
            ? fmt::format("{} recognitions can have caused a resend until then, all used up",
                          std::count_if(recognitions_.begin(), recognitions_.end(),
                                        [&](std::int64_t t) { return t <= one.time_ns; }))
            : "the profile sends no multicast when it recognises a participant",
        {{"send lag", bounds_.most_send_lag_ns + due, bounds_.most_send_lag_ns}});
  }

  Unexplained fault(const Announcement& one, Fault kind, std::string what, std::string nearest,
                    std::vector<Need> needs) {
    return unexplained_among(dialogue_.announcements[participant_], ledger_.place.place, one, kind,
                             std::move(what), std::move(nearest), std::move(needs), {8, 4});
  }

  const Dialogue& dialogue_;
  std::size_t participant_;
  const model::SpdpProfile& spdp_;
  const Bounds& bounds_;
  Tally<fsm::Announcer>& announcer_;
  Ledger& ledger_;
  std::optional<StaticPeers> static_peers_;
  std::vector<Announcement> multicasts_;  ///< or, with static peers, the first copy of each round
  std::vector<std::optional<std::int64_t>> known_since_;  ///< by participant
  std::vector<std::int64_t> recognitions_;     ///< when each other participant can be known
  std::vector<bool> has_first_copy_;           ///< by multicast: the first to somebody goes with it
  std::size_t most_scheduled_ = 0;             ///< multicasts, of all ways to explain them
  std::map<std::size_t, std::size_t> copies_;  ///< by destination
  std::vector<bool> is_scheduled_;             ///< by multicast, of the way that is replayed
};

}  // namespace

std::optional<Unexplained> explain_announcements(const Context& context, std::size_t participant,
                                                 Ledger& ledger) {
  return Announcements{context, participant, ledger}.explain();
}

}  // namespace stormproof::conform
