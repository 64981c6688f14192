// What a client sends to announce itself to its Discovery Server: DATA(p) by the schedule of its
// announcements, of which it keeps the first to itself if it knows the server by its locator, and
// at each tick at which it does not know the server; once it does, a tick opens its writers
// instead. HEARTBEAT(p) goes with the first DATA(p), answers an initial ACKNACK(p), or
// comes from a timer until the server has acknowledged.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/machines.hpp"
#include "checker/evidence/conform/senders.hpp"
#include "checker/evidence/conform/server.hpp"
#include "checker/evidence/conform/timers.hpp"
#include "checker/evidence/conform/ways.hpp"

namespace stormproof::conform::server {

namespace {

/// One way to tell scheduled announcements from ticks.
struct Timers {
  Window scheduled{};  ///< the next one is due
  Window tick{};
  bool ticks = true;  ///< until the writers have opened
  std::vector<bool> is_tick{};
  std::int64_t number = 0;  ///< of the next scheduled one

  [[nodiscard]] bool is_as_good_as(const Timers& other) const {
    return number == other.number && scheduled.contains(other.scheduled) &&
           tick.contains(other.tick);
  }
};

class Registration {
 public:
  Registration(const Context& context, std::size_t client, Ledger& ledger)
      : context_{context},
        bounds_{context.bounds},
        spdp_{context.dds.spdp},
        server_{context.dds.server},
        client_{client},
        ledger_{ledger},
        announcements_{context.dialogue.announcements[client]} {
    for (const Relation& relation : context.dialogue.relations) {
      if (relation.place.source != client || relation.sent.empty()) continue;
      if (kind_of(context.dialogue, relation.place) == RelationKind::registration) {
        own_ = &relation;
      } else {
        opened_.push_back(&relation);
      }
    }
    std::ranges::sort(opened_, {}, [](const Relation* one) { return one->sent.front().event; });
  }

  std::optional<Unexplained> explain() {
    if (own_ == nullptr && opened_.empty()) return std::nullopt;
    if (announcements_.empty()) {
      const Relation& first = own_ != nullptr ? *own_ : *opened_.front();
      return unexplained_in(first, first.sent.front().event, Fault::not_announced,
                            "a client that has not announced itself",
                            "the first that it sends is its announcement", {});
    }
    auto fault = explain_announcements();
    auto other =
        own_ != nullptr ? explain_registration_heartbeats(context_, *own_, ledger_) : std::nullopt;
    return other && (!fault || other->event < fault->event) ? other : fault;
  }

 private:
  // DATA(p) and ticks.

  std::optional<Unexplained> explain_announcements() {
    std::vector<Timers> ways;
    const Relation* opening = opened_.empty() ? nullptr : opened_.front();
    for (const Announcement& one : announcements_) {
      if (opening != nullptr && opening->sent.front().event < one.event) {
        if (auto fault = open(ways, *std::exchange(opening, nullptr))) return fault;
      }
      if (auto fault = announce(ways, one)) return fault;
    }
    if (opening != nullptr) {
      if (auto fault = open(ways, *opening)) return fault;
    }
    if (auto fault = opens_together()) return fault;
    if (auto fault = silent(ways)) return fault;
    replay(ways.front());
    return std::nullopt;
  }

  std::optional<Unexplained> announce(std::vector<Timers>& ways, const Announcement& one) {
    const Window sent = sent_in(bounds_, one.time_ns);
    if (ways.empty()) {
      ways = begin(sent);
      return std::nullopt;
    }
    std::vector<Timers> next;
    for (const Timers& way : ways) {
      if (is_overdue(way, one.time_ns)) continue;
      if (const auto at = fired(bounds_, way.scheduled, sent)) {
        Timers& by_schedule = next.emplace_back(way);
        by_schedule.scheduled = at->after(period_after(by_schedule.number++));
        by_schedule.is_tick.push_back(false);
      }
      if (const auto at = fired(bounds_, way.tick, sent); at && way.ticks) {
        Timers& by_tick = next.emplace_back(way);
        by_tick.tick = at->after(tick_period());
        by_tick.is_tick.push_back(true);
      }
    }
    if (next.empty()) return not_in_time(ways, one, "DATA(p)");
    ways = best(std::move(next));
    return std::nullopt;
  }

  /// The first DATA(p) goes at the start; or, if that is silent, with the next announcement or with
  /// a tick.
  [[nodiscard]] std::vector<Timers> begin(const Window& sent) const {
    const std::int64_t first = period_after(0);
    if (!starts_silently()) {
      return {{sent.after(first), sent.after(tick_period()), true, {false}, 1}};
    }
    const auto started = [&](std::int64_t before_ns) {
      return Window{sent.from_ns - bounds_.most_lateness_ns, sent.to_ns}.after(-before_ns);
    };
    return {{sent.after(period_after(1)), started(first).after(tick_period()), true, {false}, 2},
            {started(tick_period()).after(first), sent.after(tick_period()), true, {true}, 1}};
  }
  [[nodiscard]] bool starts_silently() const {
    return server_.known == model::ServerKnown::locator;
  }

  /// The writers open at a tick at which the server is known.
  std::optional<Unexplained> open(std::vector<Timers>& ways, const Relation& relation) {
    const Submessage& first = relation.sent.front();
    if (ways.empty()) {
      return unexplained_in(relation, first.event, Fault::not_announced,
                            "a client that has not announced itself",
                            "the first that it sends is its announcement", {});
    }
    std::vector<Timers> next;
    for (const Timers& way : ways) {
      if (is_overdue(way, first.time_ns) ||
          !fired(bounds_, way.tick, sent_in(bounds_, first.time_ns)))
        continue;
      next.push_back(way);
      next.back().ticks = false;
    }
    if (next.empty()) {
      return not_in_time(ways, {first.time_ns, first.event, {}}, "the writers' opening");
    }
    ways = best(std::move(next));
    return std::nullopt;
  }
  std::optional<Unexplained> opens_together() const {
    for (const Relation* one : opened_) {
      const Submessage& first = one->sent.front();
      const std::int64_t apart = first.time_ns - opened_.front()->sent.front().time_ns;
      if (apart <= bounds_.most_send_lag_ns) continue;
      return unexplained_in(*one, first.event, Fault::not_opened,
                            fmt::format("a writer opens {} after the other", duration(apart)),
                            "a client matches both of its writers with the server at one tick",
                            {{"send lag", apart, bounds_.most_send_lag_ns}});
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_overdue(const Timers& way, std::int64_t time_ns) const {
    return conform::is_overdue(bounds_, way.scheduled, time_ns) ||
           (way.ticks && conform::is_overdue(bounds_, way.tick, time_ns));
  }
  [[nodiscard]] std::int64_t period_after(std::int64_t number) const {
    return (number < spdp_.startup_announcements ? spdp_.startup_period : spdp_.period).count();
  }
  [[nodiscard]] std::int64_t tick_period() const { return server_.client_sync_period.count(); }

  /// While the client sends anything, its timers go on.
  std::optional<Unexplained> silent(const std::vector<Timers>& ways) const {
    const auto last = context_.dialogue.last_sign_of(client_);
    if (!last) return std::nullopt;
    const auto is_late = [&](const Timers& way) { return is_overdue(way, last->time_ns); };
    if (!std::ranges::all_of(ways, is_late)) return std::nullopt;
    return not_in_time(ways, *last, "the client still sends, and DATA(p)");
  }

  [[nodiscard]] Unexplained not_in_time(const std::vector<Timers>& ways, const Announcement& one,
                                        std::string_view what) const {
    std::int64_t due = INT64_MIN;
    for (const Timers& way : ways) {
      due = std::max(
          due, way.ticks ? std::min(way.scheduled.to_ns, way.tick.to_ns) : way.scheduled.to_ns);
    }
    const std::int64_t late = one.time_ns - due - bounds_.most_send_lag_ns;
    const bool is_late = late > bounds_.most_lateness_ns;
    const Relation& relation = own_ != nullptr ? *own_ : *opened_.front();
    std::vector<Need> needs;
    if (is_late) {
      needs.push_back({"lateness", late, bounds_.most_lateness_ns});
    } else {
      needs.push_back(
          {"send lag", due - one.time_ns + bounds_.most_send_lag_ns, bounds_.most_send_lag_ns});
    }
    return unexplained_in(
        relation, one.event, is_late ? Fault::announcement_due : Fault::announcement_extra,
        is_late ? fmt::format("{} {} after it was due", what, duration(one.time_ns - due))
                : fmt::format("{} when neither an announcement nor a tick is due", what),
        fmt::format(
            "an announcement is due every {}, later every {}, and a tick every {} until the "
            "server is known, which opens the writers",
            duration(spdp_.startup_period.count()), duration(spdp_.period.count()),
            duration(tick_period())),
        std::move(needs));
  }

  void replay(const Timers& way) {
    auto& announcer = ledger_.machines.fastdds.of<fsm::Announcer>();
    fsm::StateId state = Tally<fsm::Announcer>::Fly::initial;
    std::int64_t number = 0;
    const auto announces = [&](std::int64_t now_ns) {
      return announcer
          .step<fsm::announcer::AnnouncementDue>(state,
                                                 {.now = now_ns,
                                                  .number = number++,
                                                  .startup = spdp_.startup_announcements,
                                                  .startup_period = spdp_.startup_period.count(),
                                                  .period = spdp_.period.count()})
          .announce;
    };
    if (starts_silently()) announces(announcements_.front().time_ns);
    for (std::size_t k = 0; k < announcements_.size(); ++k) {
      if (way.is_tick[k]) {
        ledger_.explained(Rule::registration_tick);
        continue;
      }
      const bool is_first = number == 0;
      if (announces(announcements_[k].time_ns)) {
        ledger_.explained(Rule::registration_scheduled,
                          is_first ? sends::server::announces_first : sends::server::announces);
      }
      ledger_.hidden(Hidden::Kind::timer, announcements_[k].time_ns, announcements_[k].event,
                     "Announcer");
    }
  }

  const Context& context_;
  const Bounds& bounds_;
  const model::SpdpProfile& spdp_;
  const model::ServerProfile& server_;
  std::size_t client_;
  Ledger& ledger_;
  const std::vector<Announcement>& announcements_;  ///< DATA(p)
  const Relation* own_ = nullptr;                   ///< announcements to the server
  std::vector<const Relation*> opened_;             ///< descriptors to it, the first to open first
};

}  // namespace

std::optional<Unexplained> explain_registration(const Context& context, std::size_t client,
                                                Ledger& ledger) {
  return Registration{context, client, ledger}.explain();
}

}  // namespace stormproof::conform::server
