// ACKNACKs of a reader of Cyclone DDS. Its machine is asked whether it sends just this ACKNACK now,
// with any HEARTBEAT that can have arrived since the last one, or with none. HEARTBEATs on one way,
// unicast or multicast, arrive in their order, so the earliest ones that do are the best choice.
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "checker/evidence/conform/arrivals.hpp"
#include "checker/evidence/conform/cyclone.hpp"
#include "checker/evidence/conform/machines.hpp"
#include "checker/evidence/conform/senders.hpp"
#include "checker/evidence/conform/ways.hpp"
#include "checker/evidence/conform/words.hpp"
#include "model/engine/composition_knobs.hpp"

namespace stormproof::conform::cyclone {

namespace {

namespace reader = fsm::cautious_reader;
using Machine = fsm::CautiousReader;
using Input = fsm::Stepper<Machine>::Input;

template <class State>
constexpr fsm::StateId state_of = fsm::Reflect<Machine>::id<State>;

/// What has arrived for the last ACKNACK, at least: how many of the writer's submessages, by
/// unicast and by multicast.
struct Heard {
  std::array<std::size_t, 2> until{};

  [[nodiscard]] bool is_as_good_as(const Heard& other) const {
    return until[0] <= other.until[0] && until[1] <= other.until[1];
  }
};

class Reader {
 public:
  Reader(const Context& context, const Relation& relation, Ledger& ledger)
      : context_{context},
        bounds_{context.bounds},
        sedp_{context.dds.sedp},
        relation_{relation},
        machine_{ledger.machines.cyclone.of<Machine>()},
        ledger_{ledger} {
    for (std::size_t k = 0; k < relation.sent.size(); ++k) {
      const auto d = relation.sent[k].descriptor;
      if (!d) continue;
      if (*d >= first_data_.size()) {
        first_data_.resize(*d + 1);
        by_multicast_.resize(*d + 1);
      }
      if (!first_data_[*d]) first_data_[*d] = k;
      if (relation.sent[k].is_multicast) by_multicast_[*d] = true;
    }
  }

  std::optional<Unexplained> explain() {
    if (relation_.answers.empty()) return std::nullopt;
    known_ns_ = known_since(context_.dialogue, *relation_.place.destination, relation_.place.source,
                            bounds_);
    if (!known_ns_) {
      return fault(relation_.answers.front(), Fault::not_announced,
                   "ACKNACK to a participant that the reader cannot know",
                   "no announcement of the writer's participant is in the capture", {});
    }
    for (const Answer& one : relation_.answers) {
      if (auto fault = one.is_initial ? preemptive(one) : counted(one)) return fault;
    }
    return std::nullopt;
  }

 private:
  /// The times of the profile, as the machine asks for them.
  [[nodiscard]] Input timers(std::int64_t now) const {
    Input input;
    input.now = now;
    input.preemptive_delay = sedp_.preemptive_ack_delay.count();
    input.repeat_delay =
        model::knob_value(fsm::composition::cyclone::PreEmptiveRepeatDelay{}, context_.dds);
    input.again_delay = sedp_.auto_resched_nack_delay.count();
    return input;
  }

  /// Before any HEARTBEAT was seen: some time after the reader side opened, and again.
  std::optional<Unexplained> preemptive(const Answer& one) {
    if (last_ns_) {
      return fault(one, Fault::initial_after_heartbeat, "pre-emptive ACKNACK after another one",
                   "the reader has seen a HEARTBEAT, which it answered", {});
    }
    fsm::StateId state = state_of<reader::Unheard>;
    if (!due_ns_) {
      state = state_of<reader::Closed>;
      due_ns_ = machine_.step<reader::Opened>(state, timers(*known_ns_)).next_at;
    }
    const std::int64_t early = *due_ns_ - one.time_ns - capture_resolution_ns;
    if (early > 0) {
      return fault(one, Fault::initial_early,
                   fmt::format("pre-emptive ACKNACK {} before it is due", duration(early)),
                   "it comes the pre-emptive delay after the reader side opens, and every second",
                   {{"send lag", bounds_.most_send_lag_ns + early, bounds_.most_send_lag_ns}});
    }
    const std::int64_t now = std::max(*due_ns_, one.time_ns - bounds_.most_send_lag_ns);
    ledger_.used_lag(now - one.time_ns);
    due_ns_ = machine_.step<reader::TimerFired>(state, timers(now)).next_at;
    ledger_.explained(Rule::acknack_initial, sends::cyclone::preemptive);
    return std::nullopt;
  }

  std::optional<Unexplained> counted(const Answer& one) {
    if (auto fault = content(one)) return fault;
    std::vector<Heard> next;
    bool is_reply = false;
    for (const Heard& heard : heard_) {
      if (last_ns_ && sends(one, state_of<reader::Answered>, nullptr)) next.push_back(heard);
      for (const bool by_multicast : {false, true}) {
        if (const auto at = earliest(one, heard, by_multicast)) {
          next.push_back(heard);
          next.back().until[by_multicast ? 1 : 0] = *at + 1;
          is_reply = true;
        }
      }
    }
    if (next.empty()) return without_cause(one);
    note_heard(next, one);
    heard_ = best(std::move(next));
    remember(one);
    ledger_.explained(is_reply ? Rule::acknack_reply : Rule::acknack_again, sends::cyclone::reply);
    return std::nullopt;
  }

  /// The first HEARTBEAT of those that can have arrived since, with which the machine sends it.
  std::optional<std::size_t> earliest(const Answer& one, const Heard& heard, bool by_multicast) {
    for (std::size_t k = heard.until[by_multicast ? 1 : 0]; k < relation_.sent.size(); ++k) {
      const Submessage& cause = relation_.sent[k];
      if (!context_.can_precede(cause.time_ns, one.time_ns)) break;
      if (!cause.heartbeat || cause.is_multicast != by_multicast) continue;
      if (!agrees(one, *cause.heartbeat)) continue;
      const bool may_address = cause.heartbeat->is_directed && !by_multicast;
      if (sends(one, state_of<reader::Heard>, &*cause.heartbeat) ||
          (may_address && sends(one, state_of<reader::Addressed>, &*cause.heartbeat))) {
        return k;
      }
    }
    return std::nullopt;
  }

  /// Whether the reader, if it has seen the HEARTBEAT, can say this: what it neither has nor asks
  /// for it cannot know of.
  [[nodiscard]] bool agrees(const Answer& one, const Heartbeat& heartbeat) const {
    if (one.missing.empty()) return true;
    for (std::uint32_t d = one.missing.back() + 1; d < heartbeat.announced; ++d) {
      if (d >= one.base + bitmap_limit) break;
      if (!can_have(d, one.time_ns)) return false;
    }
    return true;
  }

  /// Whether the machine sends it when its timer fires in this state. When the last ones were sent
  /// is known up to the send lag: each time is the one that suits best.
  bool sends(const Answer& one, fsm::StateId state, const Heartbeat* heard) {
    Input input = timers(one.time_ns + capture_resolution_ns);
    input.first_missing = one.base + 1;
    input.base = base_;
    const std::int64_t lag = bounds_.most_send_lag_ns;
    input.quiet_until = last_ns_ ? *last_ns_ - lag + sedp_.ack_delay.count() : 0;
    const bool asks = !one.missing.empty();
    const std::uint32_t known = std::max(asked_end_, heard == nullptr ? 0 : heard->announced + 1);
    // Whether the last request was a delayed one is not followed.
    for (const bool by_delay : {false, true}) {
      input.by_delay = by_delay;
      for (const bool is_late : {false, true}) {
        const std::int64_t shift = is_late ? lag + 2 * capture_resolution_ns : -lag;
        input.hush_until = asked_ns_ ? *asked_ns_ + shift + sedp_.nack_delay.count() : 0;
        input.again_at = asked_ns_ ? *asked_ns_ - lag + sedp_.auto_resched_nack_delay.count() : 0;
        for (const bool lacks : {false, true}) {
          if (asks && !lacks) continue;
          if (!asks && (lacks ? !asked_ns_ : known > one.base + 1)) continue;
          input.last = asks    ? one.missing.back() + 1
                       : lacks ? std::max(known, one.base + 1)
                               : one.base;
          input.asked_end = asks ? asked_end_ : lacks ? UINT32_MAX : asked_end_;
          fsm::StateId after = state;
          const auto output = trial_.step<reader::TimerFired>(after, input);
          if (!output.reply || output.request != asks) continue;
          machine_.step<reader::TimerFired>(state, input);
          return true;
        }
      }
    }
    return false;
  }

  /// Base and bitmap against what can have arrived: below the base everything; what it asks for was
  /// announced, and it has not said before that it has it.
  std::optional<Unexplained> content(const Answer& one) {
    const auto wrong = [&](std::string nearest) {
      return fault(one, Fault::acknack_content, fmt::format("ACKNACK with {}", words(one)),
                   std::move(nearest), {});
    };
    for (std::uint32_t d = 0; d < one.base; ++d) {
      if (!can_have(d, one.time_ns)) {
        return wrong(fmt::format("no DATA with descriptor {} can have arrived", d));
      }
    }
    if (one.base + 1 < base_) {
      return wrong(fmt::format("it had confirmed everything below descriptor {}", base_ - 1));
    }
    for (const std::uint32_t d : one.missing) {
      if (!can_know(d, one.time_ns)) {
        return wrong(fmt::format("nothing can have announced descriptor {} to it", d));
      }
      if (d < confirmed_.size() && confirmed_[d]) {
        return wrong(fmt::format("it had confirmed descriptor {}", d));
      }
    }
    for (std::uint32_t d = one.base; !one.missing.empty() && d < one.missing.back(); ++d) {
      if (!one.asks_for(d) && !can_have(d, one.time_ns)) {
        return wrong(
            fmt::format("it does not ask for descriptor {}, which cannot have arrived", d));
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] bool can_have(std::uint32_t d, std::int64_t time_ns) const {
    return d < first_data_.size() && first_data_[d] &&
           context_.can_precede(relation_.sent[*first_data_[d]].time_ns, time_ns);
  }
  [[nodiscard]] bool can_know(std::uint32_t d, std::int64_t time_ns) const {
    const auto tells = std::ranges::find_if(relation_.sent, [&](const Submessage& one) {
      return (one.descriptor && *one.descriptor >= d) ||
             (one.heartbeat && one.heartbeat->announced > d);
    });
    return tells != relation_.sent.end() && context_.can_precede(tells->time_ns, time_ns);
  }

  /// What it says that it has it has received, so far it has heard on a way that alone brought it.
  void note_heard(std::vector<Heard>& all, const Answer& one) const {
    std::size_t least = 0;
    for (std::uint32_t d = 0; d < one.base; ++d) {
      if (!by_multicast_[d]) least = std::max(least, *first_data_[d]);
    }
    for (Heard& heard : all) heard.until[0] = std::max(heard.until[0], least);
  }

  void remember(const Answer& one) {
    last_ns_ = one.time_ns;
    base_ = one.base + 1;
    const std::uint32_t end = one.missing.empty() ? one.base : one.missing.back() + 1;
    if (confirmed_.size() < end) confirmed_.resize(end);
    for (std::uint32_t d = 0; d < end; ++d) {
      if (!one.asks_for(d)) confirmed_[d] = true;
    }
    if (one.missing.empty()) return;
    asked_ns_ = one.time_ns;
    asked_end_ = one.missing.back() + 2;
  }

  Unexplained without_cause(const Answer& one) const {
    const bool any = std::ranges::any_of(relation_.sent, [&](const Submessage& other) {
      return other.heartbeat && context_.can_precede(other.time_ns, one.time_ns);
    });
    std::vector<Need> needs;
    if (asked_ns_ && !one.missing.empty()) {
      const std::int64_t since = one.time_ns - *asked_ns_;
      needs.push_back({"send lag", sedp_.nack_delay.count() - since, bounds_.most_send_lag_ns});
    }
    return fault(one, any && asked_ns_ ? Fault::acknack_early : Fault::acknack_cause,
                 fmt::format("ACKNACK with {}", words(one)),
                 "with none of the HEARTBEATs that can have arrived since the last one does the "
                 "reader send this now",
                 std::move(needs));
  }

  Unexplained fault(const Answer& one, Fault kind, std::string what, std::string nearest,
                    std::vector<Need> needs) const {
    return unexplained_in(relation_, one.event, kind, std::move(what), std::move(nearest),
                          std::move(needs));
  }

  const Context& context_;
  const Bounds& bounds_;
  const model::SedpProfile& sedp_;
  const Relation& relation_;
  Tally<Machine>& machine_;
  Ledger& ledger_;
  fsm::Stepper<Machine> trial_;
  std::vector<std::optional<std::size_t>> first_data_;  ///< by descriptor: index in what was sent
  std::vector<bool> by_multicast_;                      ///< by descriptor: sometimes
  std::optional<std::int64_t> known_ns_;
  std::optional<std::int64_t> due_ns_;  ///< of the pre-emptive ACKNACK, earliest
  std::vector<Heard> heard_{Heard{}};
  // Of the ACKNACKs so far. Samples are numbered from 1 on.
  std::optional<std::int64_t> last_ns_;
  std::optional<std::int64_t> asked_ns_;  ///< the last that asked for something
  std::uint32_t base_ = 0;
  std::uint32_t asked_end_ = 0;
  std::vector<bool> confirmed_;  ///< by descriptor
};

}  // namespace

std::optional<Unexplained> explain_reader(const Context& context, const Relation& relation,
                                          Ledger& ledger) {
  return Reader{context, relation, ledger}.explain();
}

}  // namespace stormproof::conform::cyclone
