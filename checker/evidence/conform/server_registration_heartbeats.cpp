// HEARTBEAT(p) of a client: it goes with the first DATA(p), or when the server's own DATA(p)
// arrives at one that knows the server by its locator; it answers an initial ACKNACK(p) of the
// server, or comes from a timer until the server has acknowledged. All ways to tell answers from
// what the timer sent are followed at once.
#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/senders.hpp"
#include "checker/evidence/conform/server.hpp"
#include "checker/evidence/conform/timers.hpp"

namespace stormproof::conform::server {

namespace {

/// One way to tell answers from what the timer sent.
struct HeartbeatWay {
  Window due{};  ///< of the timer
  bool goes_on = true;
  std::size_t answered = 0;  ///< initial ACKNACKs
};

class RegistrationHeartbeats {
 public:
  RegistrationHeartbeats(const Context& context, const Relation& own, Ledger& ledger)
      : context_{context}, own_{own}, ledger_{ledger} {}

  std::optional<Unexplained> explain() {
    std::vector<HeartbeatWay> ways;
    const Submessage* before = nullptr;
    for (const Submessage& one : own_.sent) {
      if (!one.heartbeat) continue;
      if (auto fault = check(one, before)) return fault;
      if (before == nullptr) {
        if (auto fault = first(one)) return fault;
        ways.push_back({sent_in(context_.bounds, one.time_ns).after(heartbeat_period()), true, 0});
      } else if (auto fault = later(ways, one)) {
        return fault;
      }
      before = &one;
    }
    if (before == nullptr) {
      if (is_by_locator() && !hears_server()) return std::nullopt;
      return unexplained_in(own_, announcements().front().event, Fault::heartbeat_due,
                            "DATA(p) without a HEARTBEAT(p) before it",
                            "a client sends both when it announces itself for the first time", {});
    }
    const auto is_missing = [&](HeartbeatWay& way) { return !skip(way, context_.dialogue.end_ns); };
    if (std::ranges::all_of(ways, is_missing)) return missing(*before);
    return std::nullopt;
  }

 private:
  std::optional<Unexplained> check(const Submessage& one, const Submessage* before) const {
    const Heartbeat& now = *one.heartbeat;
    if (before != nullptr && now.count <= before->heartbeat->count) {
      return unexplained_in(
          own_, one.event, Fault::heartbeat_count,
          fmt::format("HEARTBEAT {} after HEARTBEAT {}", now.count, before->heartbeat->count),
          "the counts of a writer's HEARTBEATs grow", {});
    }
    if (now.first == 1 && now.announced <= 1) return std::nullopt;
    return unexplained_in(own_, one.event, Fault::heartbeat_range,
                          fmt::format("HEARTBEAT(p) announces {} to {}", now.first, now.announced),
                          "a client has one announcement", {});
  }

  std::optional<Unexplained> first(const Submessage& one) {
    if (is_by_locator()) return meets(one);
    const std::int64_t apart = std::abs(one.time_ns - announcements().front().time_ns);
    if (apart <= context_.bounds.most_send_lag_ns) {
      ledger_.explained(Rule::registration_open);
      return std::nullopt;
    }
    return unexplained_in(
        own_, one.event, Fault::heartbeat_cause,
        fmt::format("the first HEARTBEAT(p) {} from the first DATA(p)", duration(apart)),
        "a client sends both when it announces itself for the first time",
        {{"send lag", apart, context_.bounds.most_send_lag_ns}});
  }

  /// Who knows the server by its locator begins when it hears of it.
  std::optional<Unexplained> meets(const Submessage& one) {
    met_ns_ = one.time_ns;
    const Relation* from_server = of_server();
    const auto introduces = [&](const Submessage& sent) {
      return tells_of_server(context_, sent) && context_.can_precede(sent.time_ns, one.time_ns);
    };
    if (from_server != nullptr && std::ranges::any_of(from_server->sent, introduces)) {
      ledger_.explained(Rule::registration_open, sends::server::heartbeat_to_server_met);
      return std::nullopt;
    }
    return unexplained_in(own_, one.event, Fault::heartbeat_cause,
                          "HEARTBEAT(p) before a DATA(p) of the server can have arrived",
                          "a client that knows the server by its locator answers that first", {});
  }

  std::optional<Unexplained> later(std::vector<HeartbeatWay>& ways, const Submessage& one) {
    const Window sent = sent_in(context_.bounds, one.time_ns);
    const auto is_asked = [&](const Answer& answer) {
      return answer.is_initial && (!met_ns_ || can_follow(answer, *met_ns_));
    };
    const std::size_t asked = context_.arrived(own_, one.time_ns, is_asked);
    std::vector<HeartbeatWay> next;
    bool is_reply = false;
    for (HeartbeatWay way : ways) {
      if (!skip(way, one.time_ns)) continue;
      if (way.answered < asked) {
        next.push_back(way);
        ++next.back().answered;
        is_reply = true;
      }
      if (const auto at = fired(context_.bounds, way.due, sent); at && way.goes_on) {
        next.push_back(way);
        next.back().due = at->after(heartbeat_period());
      }
    }
    if (next.empty()) {
      return unexplained_in(
          own_, one.event, Fault::heartbeat_cause,
          fmt::format("HEARTBEAT(p) {}", one.heartbeat->count),
          fmt::format("it answers an initial ACKNACK(p), or comes every {} from the first one on, "
                      "until the server has acknowledged",
                      duration(heartbeat_period())),
          {{"one more initial ACKNACK of the server before it", {}, {}}});
    }
    ways = std::move(next);
    ledger_.explained(is_reply ? Rule::registration_reply : Rule::registration_periodic);
    return std::nullopt;
  }

  /// Whether it can be that no other HEARTBEAT came before `time_ns`: the timer has not fired, or
  /// the server can have acknowledged by then.
  [[nodiscard]] bool skip(HeartbeatWay& way, std::int64_t time_ns) const {
    if (!way.goes_on || !is_overdue(context_.bounds, way.due, time_ns)) return true;
    way.goes_on = false;
    return std::ranges::any_of(own_.answers, [&](const Answer& answer) {
      return !answer.is_initial &&
             context_.can_precede(answer.time_ns, way.due.to_ns + context_.bounds.most_lateness_ns);
    });
  }
  [[nodiscard]] Unexplained missing(const Submessage& last) const {
    return unexplained_in(
        own_, last.event, Fault::heartbeat_due,
        fmt::format("no HEARTBEAT(p) follows HEARTBEAT(p) {}", last.heartbeat->count),
        fmt::format("the server has acknowledged nothing, and the timer expires every {}",
                    duration(heartbeat_period())),
        {{"lateness", {}, context_.bounds.most_lateness_ns}});
  }
  [[nodiscard]] bool is_by_locator() const {
    return context_.dds.server.known == model::ServerKnown::locator;
  }
  /// Whether it can have arrived after that.
  [[nodiscard]] bool can_follow(const Answer& answer, std::int64_t time_ns) const {
    return answer.time_ns + context_.bounds.most_delay_ns + context_.bounds.clock_error_ns +
               capture_resolution_ns >=
           time_ns - context_.bounds.most_send_lag_ns;
  }
  /// What the server tells this client of participants.
  [[nodiscard]] const Relation* of_server() const {
    const Place place{*context_.dialogue.server, own_.place.source, own_.place.writer};
    const auto found = std::ranges::find(context_.dialogue.relations, place, &Relation::place);
    return found == context_.dialogue.relations.end() ? nullptr : &*found;
  }
  [[nodiscard]] bool hears_server() const {
    const Relation* from_server = of_server();
    return from_server != nullptr && !from_server->answers.empty();
  }
  [[nodiscard]] std::int64_t heartbeat_period() const {
    return context_.dds.server.pdp_heartbeat_period.count();
  }
  /// DATA(p).
  [[nodiscard]] const std::vector<Announcement>& announcements() const {
    return context_.dialogue.announcements[own_.place.source];
  }

  const Context& context_;
  const Relation& own_;
  Ledger& ledger_;
  std::optional<std::int64_t> met_ns_;  ///< the server, if it was known by its locator alone
};

}  // namespace

std::optional<Unexplained> explain_registration_heartbeats(const Context& context,
                                                           const Relation& own, Ledger& ledger) {
  return RegistrationHeartbeats{context, own, ledger}.explain();
}

}  // namespace stormproof::conform::server
