// The closed forms.
#include "checker/engines/bounds/completion_bound.hpp"

#include "model/implementations.hpp"

namespace stormproof::timeline {
namespace {

using model::InitialData;
using model::Nanoseconds;

constexpr Nanoseconds year{365LL * 24 * 3'600 * 1'000'000'000};

bool is_reasonable(Nanoseconds t) { return t >= Nanoseconds{0} && t <= year; }

void paper_bound(CompletionBound& b, const model::DdsProfile& dds, const Circumstances& c) {
  const model::SedpProfile& sedp = dds.sedp;
  const Nanoseconds period = sedp.heartbeat_period;
  b.window = (c.delta - c.least) * 2 + c.source.value_or(c.delta) + sedp.nack_response_delay +
             sedp.nack_suppression_duration;
  b.spoilt = b.window.count() / period.count();
  const Nanoseconds loss = period * (b.spoilt + 1);
  // What the first loss costs that meets a HEARTBEAT at the opening.
  const Nanoseconds first = c.timer_starts_with_relation ? loss : b.window + period;
  const std::string first_text = c.timer_starts_with_relation ? "(1 + s)·τ_H" : "W + τ_H";
  const std::string where = ", W = 2(Δ − μ) + σ + τ_N + τ_S, s = ⌊W/τ_H⌋";
  b.further_loss = loss;
  b.second_loss = loss;
  if (may_open_late(dds)) {
    b.no_loss = b.exchange + period;
    b.one_loss = b.no_loss + loss;
    b.formula = "B(k) = 3Δ + τ_A + τ_N + τ_H + k·(1 + s)·τ_H" + where;
  } else if (sedp.initial_data == InitialData::pull) {
    b.no_loss = b.exchange;
    b.one_loss = b.exchange + first;
    b.formula =
        "B(0) = 3Δ + τ_A + τ_N, B(k) = B(0) + " + first_text + " + (k−1)·(1 + s)·τ_H" + where;
  } else {
    b.no_loss = c.delta;
    b.one_loss = b.exchange;
    b.second_loss = first;
    b.formula = "B(0) = Δ, B(1) = 3Δ + τ_A + τ_N, B(k) = B(1) + " + first_text +
                " + (k−2)·(1 + s)·τ_H" + where;
  }
}

/// Here a repair that is lost spoils no fixed window: the timer dies and is armed again.
void stateful_bound(CompletionBound& b, const model::DdsProfile& dds, const Circumstances& c) {
  const Losses<fsm::Plain> losses = loss_bound(dds, c);
  const Nanoseconds loss{losses.loss};
  b.window = loss - dds.sedp.heartbeat_period;
  b.no_loss = b.exchange + Nanoseconds{losses.first};
  b.one_loss = b.no_loss + loss;
  b.second_loss = loss;
  b.further_loss = loss;
  b.formula = "B(k) = 3Δ + τ_A + τ_N + τ_S + τ_H + k·L, L = τ_H + 2Δ + τ_A + τ_N + τ_S";
}

}  // namespace

Losses<fsm::Plain> loss_bound(const model::DdsProfile& dds, const Circumstances& c) {
  const model::SedpProfile& sedp = dds.sedp;
  return losses<fsm::Plain>(dds, {.period = sedp.heartbeat_period.count(),
                                  .response = sedp.heartbeat_response_delay.count(),
                                  .nack = sedp.nack_response_delay.count(),
                                  .suppression = sedp.nack_suppression_duration.count(),
                                  .delta = c.delta.count(),
                                  .source = c.source.value_or(c.delta).count()});
}

std::optional<Nanoseconds> CompletionBound::after(unsigned losses) const {
  if (losses == 0) return no_loss;
  if (losses == 1) return one_loss;
  std::int64_t sum = 0;
  if (__builtin_mul_overflow(further_loss.count(), static_cast<std::int64_t>(losses) - 2, &sum) ||
      __builtin_add_overflow(sum, (one_loss + second_loss).count(), &sum)) {
    return std::nullopt;
  }
  return Nanoseconds{sum};
}

std::optional<CompletionBound> completion_bound(const model::DdsProfile& dds,
                                                const Circumstances& circumstances) {
  const model::SedpProfile& sedp = dds.sedp;
  if (sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive) return std::nullopt;
  for (const Nanoseconds t :
       {circumstances.delta, circumstances.source.value_or(circumstances.delta),
        sedp.heartbeat_period, sedp.heartbeat_response_delay, sedp.nack_response_delay,
        sedp.nack_suppression_duration}) {
    if (!is_reasonable(t)) return std::nullopt;
  }
  if (sedp.heartbeat_period.count() == 0 || circumstances.least < Nanoseconds{0} ||
      circumstances.least > circumstances.delta) {
    return std::nullopt;
  }
  CompletionBound bound;
  bound.exchange = Nanoseconds{loss_bound(dds, circumstances).exchange};
  switch (model::traits_of(dds).writer) {
    case model::Writer::of_the_paper:
      paper_bound(bound, dds, circumstances);
      break;
    case model::Writer::stateful:
      stateful_bound(bound, dds, circumstances);
      break;
    case model::Writer::of_server:
    case model::Writer::of_cyclone:
      return std::nullopt;
  }
  return bound;
}

std::optional<Nanoseconds> completion_bound(const model::SedpProfile& sedp, unsigned k,
                                            Nanoseconds delta) {
  model::DdsProfile dds;
  dds.sedp = sedp;
  const auto bound = completion_bound(dds, {delta, std::nullopt, false, Nanoseconds{0}});
  return bound ? bound->after(k) : std::nullopt;
}

}  // namespace stormproof::timeline
