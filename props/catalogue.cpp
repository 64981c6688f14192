// The property catalogue. Symbols as in specs/guide/model.md: D a descriptor of a relation (i, j,
// s), X its bit at the reader j, C its state at the writer i, W the size of a source queue, Δ a
// bound on the delay of a packet from its emission to its reception.
#include <algorithm>
#include <array>

#include "model/implementations.hpp"
#include "props/applicability.hpp"
#include "props/limits.hpp"
#include "props/property.hpp"

namespace stormproof::props {

namespace {

using enum Engine;

const std::array properties{
    Property{"fsm.determinism",
             "In no state do two rows of a machine fire on one event.",
             "∀ machine, state q, event e, input x: at most one row (q, e, g) has g(x)",
             "",
             "",
             {tables},
             "transition tables in fsm/"},
    Property{"fsm.totality",
             "Every pair of state and event is handled or listed as legally ignored.",
             "∀ machine, q, e: (∃ row (q, e, g): g ≡ true over the rows) ∨ (q, e) listed",
             "",
             "inputs range freely",
             {tables},
             "specs/ignored-pairs.yaml"},
    Property{"fsm.reachability",
             "Every state and every row can be reached; a row that cannot is dead.",
             "∀ q: initial →* q over rows with satisfiable guards; ∀ row: g satisfiable",
             "",
             "inputs range freely",
             {tables},
             "transition tables in fsm/"},
    Property{
        "composition.total",
        "What there is between the machines is used and caused by rules, or a reason is given.",
        "∀ outbox field: read; ∀ event: fed; ∀ timer, packet, occasion: caused and handled; "
        "∀ state: set; or listed with a reason",
        "",
        "",
        {tables},
        "rules in fsm/composition/"},
    Property{"composition.live",
             "Each effect of each rule can happen, or a knob of the profile rules it out.",
             "∀ effect: initial →* a step in which it happens; or its knobs ⊢ it never does",
             "",
             "packets and timers in any order",
             {tables},
             "rules in fsm/composition/"},
    Property{
        "composition.pending",
        "What a descriptor or a reader waits for is under way, and who lacks it is waited for.",
        "□ (X = 0 ⇒ C ≠ A) ∧ □ (C = R ⇒ repair generation pending) ∧ □ (C = S ⇒ end of suppression "
        "pending) ∧ "
        "□ (open ∧ C ≠ A ⇒ HEARTBEAT expiry pending) ∧ □ (no HEARTBEAT seen ⇒ initial ACKNACK "
        "pending)",
        "R waits for the writer's nack response, Q for the participant's async run, and U, not "
        "all but A, for an expiry; a reply that was asked for is pending.",
        "",
        {tables},
        "rules in fsm/composition/"},
    Property{"order.total",
             "(time, class, insertion) is a strict total order on events.",
             "irreflexive, asymmetric, transitive, and total for distinct insertion numbers",
             "",
             "",
             {tables},
             "model.md, events and their order"},
    Property{"order.reception-first",
             "No protocol decision at time t misses a reception that completes at t; the channel "
             "starts last.",
             "∀ events a, b at t: reception(a) ∧ decision(b) ⇒ a before b; dispatch after both",
             "",
             "a service or delay takes at least 1 ns",
             {tables, exact_run},
             "model.md, events and their order"},
    Property{"order.commutation",
             "Same-time events of one relation commute, except for the listed pairs, which the tie "
             "rule decides.",
             "∀ kinds a, b, states σ: a(b(σ)) = b(a(σ)) with equal outputs, or (a, b) listed",
             "The kinds are those of Fast DDS's writer: creation, nack response, serialization.",
             "one relation; announcements",
             {tables},
             "specs/expected/commutation.yaml"},
    Property{"safety.ack-implies-received",
             "A descriptor that the writer takes as acknowledged has been received.",
             "□ (C = A ⇒ X = 1)",
             "",
             "",
             {tables, explorer, exact_run},
             "model.md, reception of an ACKNACK"},
    Property{"safety.ack-stable",
             "What is acknowledged stays so unless its reader forgot it.",
             "□ (C leaves A ⇒ X = 0)",
             "",
             "",
             {exact_run},
             "museum.md, the properties"},
    Property{
        "safety.repair-only-if-asked",
        "Repair DATA carries only descriptors that some ACKNACK listed as missing.",
        "□ (repair DATA carries D ⇒ an ACKNACK with D reached the writer since D was last sent)",
        "Also for what was announced but never pushed: it is sent when an ACKNACK asks for it.",
        "",
        {tables, explorer, exact_run},
        "model.md, repair"},
    Property{"safety.snapshot",
             "The bitmap of an ACKNACK never changes after its generation.",
             "□ (bitmap at reception = bitmap at generation = {D : X = 0 at generation})",
             "The bitmap lists what was announced and is missing; base and bitmap are both fixed.",
             "",
             {tables, explorer, exact_run},
             "model.md, ACKNACK generation"},
    Property{"safety.conservation",
             "Admitted bytes equal the demand in the queue and exceed W only for one oversized "
             "packet; the channel never idles while something waits.",
             "□ (I = Σ demand of admitted packets ∧ (I ≤ W ∨ one packet) ∧ (waiting ⇒ busy))",
             "",
             "",
             {exact_run},
             "model.md, packets, fragments, queue, channel"},
    Property{"timer.single-heartbeat",
             "A writer never has two HEARTBEAT expiries pending.",
             "□ (pending expiries of (i, s) ≤ 1)",
             "",
             "",
             {tables, explorer, exact_run},
             "model.md, periodic HEARTBEAT"},
    Property{"timer.progress",
             "Time goes on: no instant carries infinitely many events.",
             "∀ t: |{e : time(e) = t}| < ∞",
             "",
             "",
             {exact_run},
             "museum.md, the properties"},
    Property{"timer.suppression-honoured",
             "No descriptor leaves S for U earlier than τ_S after its own repair left the source.",
             "□ (S → U of D at t ⇒ t ≥ (source completion of D's last repair) + τ_S)",
             "Suppression runs from serialization: no descriptor leaves S for U earlier than τ_S "
             "after it was put into a message.",
             "",
             {explorer, exact_run},
             "model.md, repair; fastdds.md, writer",
             "",
             "a relation has one suppression timer: what is sent while it is pending is suppressed "
             "only for the rest of it"},
    Property{"live.no-stall",
             "For every started pair that has recognised each other, or could have, while the "
             "receiver lacks a descriptor there is a pending event or a packet in flight whose "
             "processing can bring it there.",
             "□ (i, j started ∧ X = 0 ⇒ ∃ pending event or packet in flight after which X = 1 is "
             "reachable without further loss)",
             "",
             "stated over X, what the receiver has, whatever the writer believes; an event that "
             "changes nothing does not count",
             {tables, explorer, exact_run},
             "model.md, all rules of the writer and the reader"},
    Property{
        "live.completion",
        "With per-packet delay ≤ Δ and at most k lost packets every descriptor is received "
        "within B(k, Δ, τ).",
        "X = 1 at most B after the relation opens; push: B(0) = Δ, B(1) = 3Δ + τ_A + τ_N =: F, "
        "B(2) = F + W + τ_H, B(k) = B(k−1) + (1 + ⌊W/τ_H⌋)·τ_H; W = 2Δ + σ + τ_N + τ_S, σ the "
        "time to leave the source; pull: B(k+1)",
        "Counted from the match or the creation of the descriptor, whichever comes last.",
        "delays ≤ Δ, losses ≤ k",
        {calculus, timelines, explorer, exact_run},
        "specs/guide/bounds.md"},
    Property{"live.quiescence",
             "After completion and without further loss SEDP traffic stops, within a bound.",
             "no DATA, HEARTBEAT or ACKNACK is sent later than T_disc + Q(Δ, τ)",
             "",
             "delays ≤ Δ, no loss after completion",
             {calculus, timelines, explorer, exact_run},
             "specs/guide/bounds.md",
             "if the only HEARTBEAT of a relation is lost and an initial ACKNACK confirms "
             "everything, the reader's initial ACKNACKs go on for ever"},
    Property{
        "live.recovery",
        "Once nothing fails any more, everybody has what it lacks within a bound.",
        "∀ t* such that no packet is lost, no outage lasts and nobody starts after t*: X = 1 at "
        "t* + B for all who live; B = L + I + R + B(1), L the longest lease, I until the next "
        "initial ACKNACK, R until a reader asks by itself, B(1) with τ_P for each attempt",
        "",
        "delays ≤ Δ",
        {tables, exact_run},
        "museum.md, the properties"},
    Property{"live.isolation",
             "A participant that is dead delays nobody else.",
             "∀ i, j that live: X = 1 from T on ⇒ T ≤ T' + τ, T' the same in the run without the "
             "dead in which the same packets are lost, τ one HEARTBEAT period (adaptive: T_min)",
             "",
             "constant delays",
             {exact_run},
             "museum.md, the properties"},
    Property{"storm.single-copy",
             "Without loss no descriptor reaches a receiver twice.",
             "no losses ⇒ □ (each D is received at most once); for constant delay Δ and two "
             "HEARTBEATs g apart a needless repair appears iff τ_N + τ_S < g < 2Δ + τ_N",
             "",
             "no loss",
             {timelines, explorer, exact_run},
             "specs/guide/bounds.md",
             "a HEARTBEAT overtakes DATA that is on its way, and the reader asks for it again",
             "a HEARTBEAT overtakes DATA that is on its way, and the reader asks for it again"},
    Property{"storm.free-threshold",
             "No repair is possible as long as no packet takes longer than a threshold.",
             "∀ delays ≤ Δ: no repair, iff Δ ≤ Δ*(τ_A, τ_N, τ_H, τ_I)",
             "Also for descriptors that are pulled: none is sent twice.",
             "no loss",
             {timelines, explorer, exact_run},
             "specs/guide/bounds.md",
             "packets take longer than the timers wait",
             "packets take longer than the timers wait; what exists at the match is pulled, and "
             "asked for again before it arrives",
             true},
    Property{"storm.cannot-start",
             "This deployment, over this channel, never repairs without a loss, whenever its "
             "participants start.",
             "∀ start times, no losses: □ (each D is generated at most once for each receiver); "
             "from: no packet of the open-loop traffic waits longer than Δ*",
             "Also for descriptors that are pulled: none is sent twice.",
             "no loss",
             {calculus, exact_run},
             "specs/guide/cannot-start.md",
             "the load makes packets take longer than the timers wait",
             "the load makes packets take longer than the timers wait",
             true},
    Property{"storm.join-cost",
             "Who is recognised costs one announcement.",
             "∀ event in which r participants are recognised: announcements sent in it ≤ r",
             "",
             "",
             {exact_run},
             "museum.md, the properties",
             "with resend: all_known whoever recognises a participant announces itself to all that "
             "it knows, so a join costs more the more there are",
             {},
             true},
    Property{"storm.piggyback-rate",
             "DATA causes HEARTBEATs in proportion to its bytes.",
             "∀ t: HEARTBEATs that ride in DATA up to t ≤ bytes of DATA up to t / threshold + "
             "|writers|",
             "",
             "",
             {exact_run},
             "museum.md, the properties",
             "with piggyback: cumulative each DATA is charged with all that was sent before",
             {},
             true},
    Property{"storm.feedback-gain",
             "An ACKNACK that changes nothing causes no HEARTBEAT at once, and none causes two.",
             "∀ reception of an ordinary ACKNACK: HEARTBEATs sent in it ≤ 1, and 0 unless some C "
             "changes",
             "",
             "",
             {exact_run},
             "museum.md, the properties"},
    Property{"composition.followed",
             "What a run does is what the rules say.",
             "∀ event: (transitions, scheduled events, packets) = those of its rules in "
             "fsm/composition, in order",
             "",
             "steps that a rule leaves to its host do what their contracts allow",
             {exact_run},
             "fsm/composition; stormproof draw composition"},
};

/// What properties that are observed of Cyclone DDS's writer say of it.
struct Addition {
  std::string_view id;
  std::string_view text;
};
constexpr std::array for_cyclone{
    Addition{"safety.repair-only-if-asked",
             "A sample goes out once when it is created, and otherwise at most once for each "
             "ACKNACK that listed it, whichever reader sent that."},
    Addition{
        "safety.snapshot",
        "It lists nothing, or all that its reader knew of and lacked when its timer fired; its "
        "base is the first sample that it lacked."},
    Addition{"live.no-stall",
             "It is the writer's HEARTBEAT timer that is under way, or the announcement timer of "
             "whoever is unknown."},
    Addition{"storm.feedback-gain",
             "A HEARTBEAT that is meant for one reader alone answers an ACKNACK of its own, which "
             "was pre-emptive or asked for something."},
};

}  // namespace

const char* name_of(Engine engine) {
  switch (engine) {
    case tables:
      return "tables";
    case explorer:
      return "explorer";
    case timelines:
      return "timelines";
    case exact_run:
      return "exact run";
    case calculus:
      return "network calculus";
  }
  return "";
}

const char* name_of(Reach reach) {
  switch (reach) {
    case Reach::deployment:
      return "deployment";
    case Reach::profile:
      return "profile";
    case Reach::rules:
      return "rules";
  }
  return "";
}

std::string_view Property::weakness_of(model::ImplementationKind implementation) const {
  const bool is_stateful = is_about_clients(id, implementation) ||
                           model::traits_of(implementation).writer == model::Writer::stateful;
  return is_stateful ? stateful_weakness : weakness;
}

std::span<const Property> catalogue() { return properties; }

std::string_view addition_of(const Property& property, model::ImplementationKind implementation) {
  const model::Writer writer = model::traits_of(implementation).writer;
  if (writer == model::Writer::stateful || is_about_clients(property.id, implementation)) {
    return property.stateful;
  }
  if (writer != model::Writer::of_cyclone) return {};
  const auto* const found = std::ranges::find(for_cyclone, property.id, &Addition::id);
  return found == for_cyclone.end() ? std::string_view{} : found->text;
}

std::string statement_of(const Property& property, model::ImplementationKind implementation) {
  std::string text{property.statement};
  const std::string_view more = addition_of(property, implementation);
  if (!more.empty()) text.append(" ").append(more);
  if (is_about_clients(property.id, implementation)) {
    text.append(" It is about what clients tell the server.");
  }
  return text;
}

const Property* find_property(std::string_view id) {
  for (const Property& property : catalogue()) {
    if (property.id == id) return &property;
  }
  for (const Property& property : limit_properties()) {
    if (property.id == id) return &property;
  }
  return nullptr;
}

}  // namespace stormproof::props
