// Finds the request of every transmission of a relation.
#include "checker/evidence/conform/writer_side.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/evidence/conform/data_replay.hpp"
#include "checker/evidence/conform/requests_exact.hpp"
#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform {

namespace {

class WriterSide {
 public:
  WriterSide(const WriterContext& context, const Relation& relation, Ledger& ledger)
      : context_{context}, relation_{relation}, ledger_{ledger} {}

  std::optional<Unexplained> explain() {
    if (relation_.sent.empty()) return std::nullopt;
    const Submessage& opening = relation_.sent.front();
    if (auto fault = not_announced(opening)) return fault;
    const bool is_alone =
        relation_.sent.size() == 1 || relation_.sent[1].datagram != opening.datagram;
    if (!opening.heartbeat || !opening.heartbeat->is_directed || !is_alone) {
      return not_opened(opening);
    }
    opened_ns_ = opening.time_ns;
    existing_ = existing_at_opening(relation_);
    transmissions_ = transmissions_of(relation_);
    if (kind_of(context_.dialogue, relation_.place) == RelationKind::descriptors) {
      if (auto fault = pushed_late()) return fault;
      if (auto fault = pushed_in_order()) return fault;
    }
    if (auto fault = sent_after_acknowledgment()) return fault;
    if (auto fault = sent_while_suppressed()) return fault;
    std::optional<Demand> failure;
    for (const std::int64_t lag : lags()) {
      Plan plan;
      failure = search(lag, plan);
      if (failure) continue;
      ledger_.used_lag(lag);
      return replay(plan, lag);
    }
    return decide_exactly(*failure);
  }

 private:
  /// Send lags to try, the least first: what it takes is reported.
  [[nodiscard]] std::vector<std::int64_t> lags() const {
    std::vector<std::int64_t> all{0};
    for (std::int64_t lag = 10'000; lag < context_.bounds.most_send_lag_ns; lag *= 10) {
      all.push_back(lag);
    }
    if (context_.bounds.most_send_lag_ns > 0) all.push_back(context_.bounds.most_send_lag_ns);
    return all;
  }

  /// What each transmission that is not pushed needs. `exact`: as the rules have it if everything
  /// was serialized `lag` before its capture; otherwise no later than they can have it at all.
  [[nodiscard]] std::vector<Demand> demands(std::int64_t lag, bool exact) const {
    std::vector<Demand> all;
    std::vector<std::int64_t> unacknowledged;  // since when, by descriptor
    const std::int64_t suppression = context_.dds.sedp.nack_suppression_duration.count();
    std::int64_t suppressed_until = INT64_MIN;
    for (std::size_t k = 0; k < transmissions_.size(); ++k) {
      const Transmission& one = transmissions_[k];
      if (!exact && needs_no_request(one)) continue;
      const std::int64_t serialized = one.time_ns - lag;
      if (one.descriptor >= unacknowledged.size()) {
        unacknowledged.resize(one.descriptor + 1, opened_ns_ - lag);
      }
      if (!one.is_pushed) {
        const std::int64_t response = response_ns(one);
        all.push_back({k, one.descriptor, unacknowledged[one.descriptor],
                       one.time_ns - response + (response > 0 ? capture_resolution_ns : 0)});
      }
      // A suppression that is pending already ends for this descriptor, too.
      const bool may_be_pending =
          !exact && k > 0 && transmissions_[k - 1].time_ns + suppression >= serialized - lag;
      if (serialized >= suppressed_until) suppressed_until = serialized + suppression;
      unacknowledged[one.descriptor] =
          may_be_pending ? serialized + 1 : std::max(suppressed_until, serialized + 1);
    }
    return all;
  }

  /// From the arrival of a request for it to the transmission, at least: less than τ_N if an
  /// earlier ACKNACK can have armed the response, for something else that it asks for.
  [[nodiscard]] std::int64_t response_ns(const Transmission& one) const {
    const std::int64_t response = context_.response_ns();
    const auto arms = [&](const Answer& answer) {
      return !answer.missing.empty() &&
             answer.time_ns + context_.bounds.least_delay_ns + response <=
                 one.time_ns + context_.bounds.clock_error_ns + capture_resolution_ns;
    };
    const bool is_armed = std::ranges::any_of(relation_.answers, arms) ||
                          std::ranges::any_of(context_.others, [&](const Relation* other) {
                            return std::ranges::any_of(other->answers, arms);
                          });
    return is_armed ? 0 : response;
  }
  [[nodiscard]] bool needs_no_request(const Transmission& one) const {
    return !one.is_pushed && context_.to_everybody.contains(one.event);
  }

  /// The greedy schedule; what it cannot serve, if anything.
  std::optional<Demand> search(std::int64_t lag, Plan& plan) const {
    Requests requests{relation_, transmissions_, context_.bounds, lag};
    plan.request.resize(transmissions_.size());
    plan.to_everybody.resize(transmissions_.size());
    for (const Demand& demand : demands(lag, true)) {
      plan.request[demand.transmission] = requests.serve(demand);
      if (plan.request[demand.transmission]) continue;
      if (!needs_no_request(transmissions_[demand.transmission])) return demand;
      plan.to_everybody[demand.transmission] = true;
    }
    plan.arrivals = requests.arrivals();
    return std::nullopt;
  }

  /// The greedy schedule fails at `failure`, but others may not: a solver decides, and finds the
  /// first transmission that none explains.
  std::optional<Unexplained> decide_exactly(const Demand& failure) {
    const std::int64_t lag = context_.bounds.most_send_lag_ns;
    const Requests requests{relation_, transmissions_, context_.bounds, lag};
    const std::vector<Demand> all = demands(lag, false);
    std::size_t failing = 0;
    while (failing < all.size() && all[failing].transmission <= failure.transmission) ++failing;
    const auto with = [&](std::size_t count) {
      const std::vector<Demand> first{all.begin(),
                                      all.begin() + static_cast<std::ptrdiff_t>(count)};
      return decide(relation_, requests, first, {.interrupted = context_.interrupted});
    };
    if (failing < all.size() && with(failing).kind == ExactAnswer::Kind::impossible) {
      return unexplained(all[failing - 1]);
    }
    const ExactAnswer answer = with(all.size());
    if (answer.kind == ExactAnswer::Kind::possible) return replay(plan_of(answer, all), lag);
    if (answer.kind == ExactAnswer::Kind::impossible) {
      return unexplained(all[first_impossible(with, failing, all.size()) - 1]);
    }
    ledger_.undecided();
    return std::nullopt;
  }

  /// The least number of demands that cannot be served; `possible` can, `impossible` cannot.
  static std::size_t first_impossible(const auto& with, std::size_t possible,
                                      std::size_t impossible) {
    while (possible + 1 < impossible) {
      const std::size_t middle = possible + (impossible - possible) / 2;
      const bool is_impossible = with(middle).kind == ExactAnswer::Kind::impossible;
      (is_impossible ? impossible : possible) = middle;
    }
    return impossible;
  }

  [[nodiscard]] Plan plan_of(const ExactAnswer& answer, const std::vector<Demand>& all) const {
    Plan plan{answer.arrivals, {}, {}};
    plan.request.resize(transmissions_.size());
    for (const Transmission& one : transmissions_) {
      plan.to_everybody.push_back(needs_no_request(one));
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
      plan.request[all[k].transmission] = answer.request[k];
    }
    return plan;
  }

  std::optional<Unexplained> replay(const Plan& plan, std::int64_t lag) {
    DataReplay replay{context_, relation_, transmissions_, existing_, ledger_};
    const Answer* unanswered_one = replay.run(plan, lag);
    if (unanswered_one == nullptr) return std::nullopt;
    return unanswered(*unanswered_one);
  }

  // Findings.

  std::optional<Unexplained> not_announced(const Submessage& opening) {
    const auto announced =
        context_.dialogue.first_announced(*relation_.place.destination, relation_.place.source);
    if (announced && opening.time_ns + context_.bounds.clock_error_ns + capture_resolution_ns >=
                         *announced + context_.bounds.least_delay_ns) {
      return std::nullopt;
    }
    std::vector<Need> needs;
    if (announced) {
      needs.push_back({"clock error", *announced + context_.bounds.least_delay_ns - opening.time_ns,
                       context_.bounds.clock_error_ns});
    }
    return fault(opening.event, Fault::not_announced,
                 "the writer sends to a participant that it cannot know yet",
                 announced ? "the first announcement of the reader's participant comes later"
                           : "no announcement of the reader's participant is in the capture",
                 std::move(needs));
  }

  Unexplained not_opened(const Submessage& opening) {
    return fault(opening.event, Fault::not_opened,
                 "the first message to this reader is not the HEARTBEAT that opens the relation",
                 "the writer opens with a HEARTBEAT to this reader alone, before anything else",
                 {{"a HEARTBEAT with INFO_DST before it", {}, {}}});
  }

  /// A descriptor that is created after the opening is pushed at once, so no HEARTBEAT announces it
  /// before.
  std::optional<Unexplained> pushed_late() {
    for (const Transmission& one : transmissions_) {
      if (!one.is_pushed) continue;
      const auto announced = context_.announced.lower_bound(one.descriptor + 1);
      if (announced == context_.announced.end()) continue;
      const std::int64_t late = one.time_ns - announced->second;
      if (late <= context_.bounds.most_send_lag_ns) {
        ledger_.used_lag(late);
        continue;
      }
      return fault(
          one.event, Fault::data_cause,
          fmt::format("first transmission of descriptor {}, {} after a HEARTBEAT announced it",
                      one.descriptor, duration(late)),
          "the descriptor was created after the relation opened, so it is pushed at its creation, "
          "and no HEARTBEAT comes before",
          {{"send lag", late, context_.bounds.most_send_lag_ns}});
    }
    return std::nullopt;
  }

  /// Endpoints are created in the order of their numbers, and each is pushed to all readers then:
  /// to this one the next number each time. So nothing that a HEARTBEAT announces has been left
  /// out.
  std::optional<Unexplained> pushed_in_order() {
    std::uint32_t next = existing_;
    for (const Transmission& one : transmissions_) {
      if (!one.is_pushed) continue;
      if (one.descriptor == next) {
        ++next;
        continue;
      }
      return fault(
          one.event, Fault::data_order,
          fmt::format("descriptor {} is pushed, and descriptor {} has not been", one.descriptor,
                      next),
          "endpoints are created in the order of their numbers, and each is pushed at its creation",
          {{"a push of every smaller number before it", {}, {}}});
    }
    const auto announced = context_.announced.lower_bound(next + 1);
    if (context_.dialogue.ends_early != nullptr || announced == context_.announced.end())
      return std::nullopt;
    const std::int64_t due = announced->second + context_.bounds.most_send_lag_ns;
    if (due >= context_.dialogue.end_ns) return std::nullopt;
    const auto after = std::ranges::find_if(
        relation_.sent, [&](const Submessage& one) { return one.time_ns > due; });
    if (after == relation_.sent.end()) return std::nullopt;
    return fault(
        after->event, Fault::data_order,
        fmt::format("descriptor {} is never pushed, and a HEARTBEAT has announced it", next),
        "what is created after the relation opened is pushed at its creation",
        {{"a push of every smaller number before it", {}, {}}});
  }

  /// If nothing is lost, an ACKNACK arrives at the latest after the longest delay.
  std::optional<Unexplained> sent_after_acknowledgment() {
    if (context_.bounds.may_lose) return std::nullopt;
    const std::int64_t slack = context_.bounds.most_delay_ns + context_.bounds.clock_error_ns +
                               context_.bounds.most_send_lag_ns + capture_resolution_ns;
    for (const Transmission& one : transmissions_) {
      for (const Answer& answer : relation_.answers) {
        if (answer.time_ns + slack >= one.time_ns) break;
        if (answer.is_initial || answer.base <= one.descriptor) continue;
        return fault(one.event, Fault::data_acknowledged,
                     fmt::format("descriptor {} is sent {} after the reader acknowledged it",
                                 one.descriptor, duration(one.time_ns - answer.time_ns)),
                     "what is acknowledged is not sent any more, and nothing is lost",
                     {{"delay", one.time_ns - answer.time_ns, context_.bounds.most_delay_ns}},
                     answer.event);
      }
    }
    return std::nullopt;
  }

  /// Between two transmissions of a descriptor a suppression ends, and from one end to the next it
  /// takes τ_S: so between n + 1 transmissions at least (n − 1)·τ_S, but for the send lag.
  std::optional<Unexplained> sent_while_suppressed() {
    const std::int64_t suppression = context_.dds.sedp.nack_suppression_duration.count();
    const std::int64_t slack = context_.bounds.most_send_lag_ns + capture_resolution_ns;
    struct Chain {
      std::int64_t count = 0;
      std::int64_t latest_ns = 0;  ///< most of time − count·τ_S, over the transmissions
    };
    std::map<std::uint32_t, Chain> chains;
    for (const Transmission& one : transmissions_) {
      if (needs_no_request(one)) continue;
      Chain& chain = chains[one.descriptor];
      const std::int64_t since = one.time_ns - opened_ns_;
      const std::int64_t early = (chain.count - 1) * suppression - since + chain.latest_ns - slack;
      if (chain.count > 1 && early > 0) {
        return fault(one.event, Fault::data_early,
                     fmt::format("{} sent {} times too soon one after the other",
                                 transmission_text(one), chain.count + 1),
                     fmt::format("a suppression lasts {}: it is sent at the earliest {} later",
                                 duration(suppression), duration(early)),
                     {{"send lag", context_.bounds.most_send_lag_ns + early,
                       context_.bounds.most_send_lag_ns}});
      }
      const std::int64_t latest = since - chain.count * suppression;
      chain.latest_ns = chain.count == 0 ? latest : std::max(chain.latest_ns, latest);
      ++chain.count;
    }
    return std::nullopt;
  }

  Unexplained unanswered(const Answer& answer) {
    return fault(
        answer.event, Fault::unanswered,
        fmt::format("ACKNACK of {}: not everything that it asks for is sent again", words(answer)),
        "what an ACKNACK asks for while it is unacknowledged is sent, and nothing is lost",
        {{"a loss, or a longer delay", {}, {}}});
  }

  Unexplained unexplained(const Demand& failure) {
    const Transmission& one = transmissions_[failure.transmission];
    const Answer* latest = latest_request(one);
    if (latest == nullptr) return not_asked_for(one);
    const std::int64_t earliest = latest->time_ns + context_.bounds.least_delay_ns;
    if (earliest > failure.to_ns) return too_early(one, *latest, earliest - failure.to_ns);
    return used_up(one, *latest, failure);
  }

  /// The last ACKNACK before the transmission that asks for it.
  [[nodiscard]] const Answer* latest_request(const Transmission& one) const {
    const Answer* latest = nullptr;
    for (const Answer& answer : relation_.answers) {
      if (answer.time_ns > one.time_ns + context_.bounds.clock_error_ns) break;
      if (answer.asks_for(one.descriptor)) latest = &answer;
    }
    return latest;
  }

  static std::string transmission_text(const Transmission& one) {
    return fmt::format("{} transmission of descriptor {}", one.is_first ? "first" : "repeated",
                       one.descriptor);
  }

  Unexplained not_asked_for(const Transmission& one) {
    return fault(one.event, Fault::data_cause,
                 transmission_text(one) + ", and no ACKNACK asks for it before",
                 one.is_first ? "the descriptor existed when the relation opened, so it waits for "
                                "an ACKNACK that asks for it"
                              : "a descriptor is sent again only when an ACKNACK asks for it",
                 {{"an ACKNACK of this reader before it that asks for the descriptor", {}, {}}});
  }

  Unexplained too_early(const Transmission& one, const Answer& request, std::int64_t by_ns) {
    const std::int64_t waited = one.time_ns - request.time_ns;
    const std::int64_t delay = context_.dds.sedp.nack_response_delay.count();
    return fault(
        one.event, Fault::data_early,
        fmt::format("{}, {} after the ACKNACK that asks for it", transmission_text(one),
                    duration(waited)),
        fmt::format("the writer waits {} after a request: it is sent at the earliest {} later",
                    duration(delay), duration(by_ns)),
        {{"clock error", context_.bounds.clock_error_ns + by_ns, context_.bounds.clock_error_ns},
         {"a nack response delay of at most", waited, delay}},
        request.event);
  }

  Unexplained used_up(const Transmission& one, const Answer& request, const Demand& failure) {
    return fault(
        one.event, Fault::data_early,
        transmission_text(one) +
            ", and every ACKNACK that asks for it is used up by an earlier transmission",
        fmt::format("one that asks for it arrives between {} and {} before",
                    duration(one.time_ns - failure.to_ns), duration(one.time_ns - failure.from_ns)),
        {{"one more ACKNACK of this reader that asks for it and arrives then", {}, {}}},
        request.event);
  }

  Unexplained fault(std::size_t event, Fault kind, std::string what, std::string nearest,
                    std::vector<Need> needs, std::optional<std::size_t> cause = {}) {
    return unexplained_in(relation_, event, kind, std::move(what), std::move(nearest),
                          std::move(needs), cause);
  }

  const WriterContext& context_;
  const Relation& relation_;
  Ledger& ledger_;

  std::int64_t opened_ns_ = 0;
  std::uint32_t existing_ = 0;  ///< descriptors when the relation opened
  std::vector<Transmission> transmissions_;
};

}  // namespace

std::optional<Unexplained> explain_data(const WriterContext& context, const Relation& relation,
                                        Ledger& ledger) {
  return WriterSide{context, relation, ledger}.explain();
}

}  // namespace stormproof::conform
