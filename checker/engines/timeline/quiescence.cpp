// Times count from the instant t0 from which every reader has everything and nothing is lost.
#include "checker/engines/timeline/quiescence.hpp"

namespace stormproof::timeline {
namespace {

/// An ACKNACK that is generated from t0 on confirms, and requests nothing.
void clean_acknacks_confirm(Theorem& t, const Parameters& p) {
  const std::size_t mark = t.open();
  Descriptor<Sym> d;
  d.received = true;
  d.received_at = t.number("received");
  d.acknowledged = t.choice("acknowledged_before");
  d.asked = t.choice("asked_before");
  d.busy_until = t.number("busy_before");
  t.assume(d.received_at <= 0);
  Report<Sym> report;
  report.generated = t.at_least("generated", 0);
  report.arrives = report.generated + t.within("acknack_delay", p.least, p.delta);
  const Effect<Sym> effect = acknack<Sym>(d, report, p.passage(t, "repair"), p.timers);
  t.holds("an ACKNACK from t0 on confirms and requests nothing",
          d.acknowledged && !effect.requested);
  t.close(mark);
}

/// The one fact about products that is used below.
void multiples_are_not_negative(Theorem& t, const Parameters& p) {
  const std::size_t mark = t.open();
  const Int count = t.at_least("count", 0);
  t.holds("a multiple of the period is not negative", count * p.period >= 0);
  t.close(mark);
}

/// What ACKNACKs from before t0 can still cause.
void old_acknacks_end(Theorem& t, const Parameters& p, const Int& quiet) {
  const std::size_t mark = t.open();
  Descriptor<Sym> d;
  Report<Sym> report;
  report.generated = t.number("generated");
  report.arrives = report.generated + t.within("acknack_delay", p.least, p.delta);
  t.assume(report.generated <= 0);
  const Effect<Sym> effect = acknack<Sym>(d, report, p.passage(t, "repair"), p.timers);
  t.assume(effect.requested);
  const Int answered =
      answer<Sym>(d.repair_at, p.passage(t, "heartbeat"), p.passage(t, "answer"), p.timers)
          .generated;
  t.holds("an old ACKNACK's repair, and the answer to a HEARTBEAT with it, are sent in time",
          d.repair_at <= quiet && answered <= quiet);
  t.close(mark);
}

/// An expiry is pending until the writer falls silent, so one sends a HEARTBEAT at e ≤ τ_H. The
/// expiries after it send until its ACKNACK arrives.
void heartbeats_end(Theorem& t, const Parameters& p, const Int& further, const Int& further_time,
                    const Int& quiet) {
  const std::size_t mark = t.open();
  const Int expiry = t.number("expiry");
  t.assume(expiry <= p.period);
  const Report<Sym> first =
      answer<Sym>(expiry, p.passage(t, "heartbeat"), p.passage(t, "acknack"), p.timers);
  const Int passed = t.at_least("passed", 0);
  const Int last = t.number("last");
  t.assume(last == expiry + passed * p.period && last < first.arrives);
  t.holds("at most m further HEARTBEATs are sent", passed <= further);
  // What is shown about products is assumed for the rest, which is linear without them.
  const Int left_time = (further - passed) * p.period;
  const Bool adds_up = left_time == further_time - (last - expiry);
  t.holds("the periods in between and those that are left make m", adds_up);
  t.assume(adds_up && passed <= further && left_time >= 0);
  t.holds("the answer to the last HEARTBEAT is sent in time",
          last <= quiet &&
              answer<Sym>(last, p.passage(t, "heartbeat_2"), p.passage(t, "acknack_2"), p.timers)
                      .generated <= quiet);
  const Int before = t.number("sent_before");
  t.assume(before <= 0);
  t.holds("the answer to a HEARTBEAT from before t0 is sent in time",
          answer<Sym>(before, p.passage(t, "heartbeat_3"), p.passage(t, "acknack_3"), p.timers)
                  .generated <= quiet);
  // With `initial_acknack: heartbeat` the last attempt comes before a HEARTBEAT is seen.
  const Int attempt = t.number("attempt");
  const Passage<Sym> seen = p.passage(t, "heartbeat_4");
  t.assume(attempt < expiry + seen.delay);
  const Int reply = attempt + p.passage(t, "acknack_4").delay;
  t.holds("the answer to the reply to the last initial ACKNACK is sent by tau_H + 3 delta + tau_A",
          answer<Sym>(reply, p.passage(t, "heartbeat_5"), p.passage(t, "acknack_5"), p.timers)
                  .generated <= p.period + p.delta + p.delta + p.delta + p.timers.response);
  t.close(mark);
}

}  // namespace

void prove_quiescence(Theorem& t, int tighter) {
  const Parameters p{t};
  multiples_are_not_negative(t, p);
  const Int back = p.delta + p.delta + p.timers.response;
  // m is the number of periods that are less than 2Δ + τ_A, or 0.
  const Int further = t.at_least("m", 0);
  const Int further_time = t.number("m_periods");
  t.assume(further_time == further * p.period);
  t.assume(back <= further_time + p.period);
  const Int by_heartbeat = p.period + further_time + p.delta + p.timers.response;
  const Int by_repair = p.delta + p.delta + p.timers.nack + p.timers.response;
  const Int quiet = fsm::max<Sym>(by_heartbeat, by_repair) - tighter;
  clean_acknacks_confirm(t, p);
  old_acknacks_end(t, p, quiet);
  heartbeats_end(t, p, further, further_time, quiet);
}

Director last_packet_late(model::Nanoseconds delta) {
  // The ACKNACK to the HEARTBEAT of the opening and the next HEARTBEAT are lost; all else takes Δ.
  return [delta](const DirectedPacket& packet) -> Passing {
    const bool lost = (packet.kind == model::PacketKind::acknack && packet.ordinal == 0) ||
                      (packet.kind == model::PacketKind::heartbeat && packet.ordinal == 1);
    return {delta, model::Nanoseconds{0}, lost};
  };
}

Director all_heartbeats_lost(model::Nanoseconds data) {
  return [data](const DirectedPacket& packet) -> Passing {
    const model::Nanoseconds tick{1};
    return {packet.kind == model::PacketKind::data ? data : tick, model::Nanoseconds{0},
            packet.kind == model::PacketKind::heartbeat};
  };
}

}  // namespace stormproof::timeline
