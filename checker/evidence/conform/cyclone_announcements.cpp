// Announcements of Cyclone DDS: when its timer fired is narrowed down from one to the next. A
// message is queued then, so it may be captured much later.
#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/cyclone.hpp"
#include "checker/evidence/conform/senders.hpp"
#include "checker/evidence/conform/timers.hpp"

namespace stormproof::conform::cyclone {

namespace {

/// A timer: when it has fired for the last time.
struct Fired {
  Window at{};
  std::size_t times = 0;
};

class Announcements {
 public:
  Announcements(const Context& context, std::size_t participant, Ledger& ledger)
      : context_{context},
        bounds_{context.bounds},
        spdp_{context.dds.spdp},
        all_{context.dialogue.announcements[participant]},
        participant_{participant},
        ledger_{ledger} {}

  std::optional<Unexplained> explain() {
    for (const Announcement& one : all_) {
      auto fault = !one.destination ? scheduled(one) : is_named(one) ? reply(one) : copy(one);
      if (fault) return fault;
    }
    return silent();
  }

 private:
  [[nodiscard]] bool is_named(const Announcement& one) const {
    return context_.dialogue.conversation.events[one.event].has_info_dst;
  }

  /// One at the start, the next after the startup period, and then one a period.
  std::optional<Unexplained> scheduled(const Announcement& one) {
    const bool is_first = timer_.times == 0;
    if (is_first) {
      timer_ = {
          sent_within(knows_somebody(one) ? longest_wait() : bounds_.most_send_lag_ns, one.time_ns),
          1};
    } else if (auto fault = fire(timer_, one, period())) {
      return fault;
    }
    ledger_.explained(Rule::announcement_scheduled,
                      is_first ? sends::cyclone::start : sends::cyclone::announcement_due);
    return std::nullopt;
  }
  /// Whether there can be messages that the announcement waits for.
  [[nodiscard]] bool knows_somebody(const Announcement& one) const {
    for (std::size_t j = 0; j < context_.dialogue.participants(); ++j) {
      if (j == participant_) continue;
      const auto known = known_since(context_.dialogue, participant_, j, bounds_);
      if (known && *known <= one.time_ns) return true;
    }
    return false;
  }
  [[nodiscard]] std::int64_t period() const {
    return (timer_.times == 1 ? spdp_.startup_period : spdp_.period).count();
  }

  /// Replies by name: when a participant is recognised, and then at intervals.
  std::optional<Unexplained> reply(const Announcement& one) {
    if (auto fault = unknown(one)) return fault;
    Fired& timer = replies_[*one.destination];
    if (timer.times >= spdp_.directed_replies) {
      return fault(one, Fault::announcement_extra,
                   fmt::format("reply {} to one participant", timer.times + 1),
                   fmt::format("a participant that is recognised gets {}", spdp_.directed_replies),
                   {});
    }
    if (timer.times == 0) {
      const std::int64_t known =
          *known_since(context_.dialogue, participant_, *one.destination, bounds_);
      timer = {sent_within(longest_wait(), one.time_ns), 1};
      timer.at.from_ns = std::max(known, timer.at.from_ns);
    } else if (auto fault = fire(timer, one, spdp_.directed_reply_interval.count())) {
      return fault;
    }
    ledger_.explained(Rule::announcement_reply, sends::cyclone::reply_due);
    return std::nullopt;
  }

  /// Without multicast a scheduled announcement goes to everybody who is known, too.
  std::optional<Unexplained> copy(const Announcement& one) {
    if (auto fault = unknown(one)) return fault;
    const auto is_near = [&](const Announcement& other) {
      return !other.destination &&
             std::abs(other.time_ns - one.time_ns) <= bounds_.most_send_lag_ns + most_apart_ns;
    };
    const bool goes_with_one = std::ranges::any_of(all_, is_near);
    const auto rounds =
        static_cast<std::size_t>(std::ranges::count_if(all_, [&](const Announcement& other) {
          return !other.destination && (other.time_ns <= one.time_ns || is_near(other));
        }));
    const bool is_one_too_many = ++copies_[*one.destination] > rounds;
    if (context_.dds.allow_multicast == model::AllowMulticast::always || !goes_with_one ||
        is_one_too_many) {
      return fault(one, Fault::announcement_extra,
                   "announcement to one participant, which does not name it",
                   "without multicast each scheduled announcement goes to everybody who is known; "
                   "replies name their receiver",
                   {});
    }
    ledger_.explained(Rule::announcement_copy, sends::cyclone::announcement_due);
    return std::nullopt;
  }

  std::optional<Unexplained> unknown(const Announcement& one) {
    const auto known = known_since(context_.dialogue, participant_, *one.destination, bounds_);
    if (known && *known <= one.time_ns + capture_resolution_ns) return std::nullopt;
    return fault(one, Fault::not_announced,
                 "announcement to a participant that the sender cannot know yet",
                 known ? "the other's first announcement comes later"
                       : "no announcement of the other participant is in the capture",
                 {});
  }

  /// The timer fires again, `wait_ns` after the last time.
  std::optional<Unexplained> fire(Fired& timer, const Announcement& one, std::int64_t wait_ns) {
    const Window due = timer.at.after(wait_ns);
    const Window sent = sent_within(longest_wait(), one.time_ns);
    if (const auto at = fired(bounds_, due, sent)) {
      timer = {*at, timer.times + 1};
      return std::nullopt;
    }
    const std::int64_t early = due.from_ns - sent.to_ns;
    if (early > 0) {
      return fault(one, Fault::announcement_extra,
                   fmt::format("announcement {} before its timer is due", duration(early)),
                   fmt::format("the timer fires again after {}", duration(wait_ns)),
                   {{"send lag", bounds_.most_send_lag_ns + early, bounds_.most_send_lag_ns}});
    }
    const std::int64_t late = sent.from_ns - due.to_ns - bounds_.most_lateness_ns;
    return fault(one, Fault::announcement_due,
                 fmt::format("announcement {} after it was due", duration(late)),
                 fmt::format("the timer fires again after {}", duration(wait_ns)),
                 {{"lateness", bounds_.most_lateness_ns + late, bounds_.most_lateness_ns}});
  }

  /// While the participant sends anything, its timers go on.
  std::optional<Unexplained> silent() {
    const auto latest = context_.dialogue.last_sign_of(participant_);
    if (!latest) return std::nullopt;
    if (timer_.times > 0) {
      if (auto fault = overdue(timer_, *latest, period())) return fault;
    }
    for (const auto& [receiver, timer] : replies_) {
      if (timer.times >= spdp_.directed_replies) continue;
      if (auto fault = overdue(timer, *latest, spdp_.directed_reply_interval.count())) return fault;
    }
    return std::nullopt;
  }
  std::optional<Unexplained> overdue(const Fired& timer, const Announcement& latest,
                                     std::int64_t wait_ns) {
    const std::int64_t late =
        latest.time_ns - timer.at.to_ns - wait_ns - bounds_.most_lateness_ns - longest_wait();
    if (late <= 0) return std::nullopt;
    return fault(latest, Fault::announcement_due,
                 fmt::format("the participant still sends, {} after an announcement was due",
                             duration(late)),
                 fmt::format("the timer fires again after {}", duration(wait_ns)),
                 {{"lateness", bounds_.most_lateness_ns + late, bounds_.most_lateness_ns}});
  }

  /// From the firing of the timer to the capture of what it queues.
  [[nodiscard]] std::int64_t longest_wait() const {
    return bounds_.most_send_lag_ns + bounds_.most_queueing_ns;
  }

  Unexplained fault(const Announcement& one, Fault kind, std::string what, std::string nearest,
                    std::vector<Need> needs) {
    return unexplained_among(all_, ledger_.place.place, one, kind, std::move(what),
                             std::move(nearest), std::move(needs), {6, 5});
  }

  const Context& context_;
  const Bounds& bounds_;
  const model::SpdpProfile& spdp_;
  const std::vector<Announcement>& all_;
  std::size_t participant_;
  Ledger& ledger_;
  Fired timer_;
  std::map<std::size_t, Fired> replies_;       ///< by receiver
  std::map<std::size_t, std::size_t> copies_;  ///< by receiver
};

}  // namespace

std::optional<Unexplained> explain_announcements(const Context& context, std::size_t participant,
                                                 Ledger& ledger) {
  return Announcements{context, participant, ledger}.explain();
}

}  // namespace stormproof::conform::cyclone
