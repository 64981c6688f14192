// The property catalogue. Symbols as in specs/guide/model.md: D a descriptor of a relation (i, j,
// s), X its bit at the reader j, C its state at the writer i, W the size of a source queue, Δ a
// bound on the delay of a packet from its emission to its reception.
#include <array>

#include "props/property.hpp"

namespace stormproof::props {

namespace {

using enum Engine;

const std::array properties{
    Property{.id = "fsm.determinism",
             .statement = "In no state do two rows of a machine fire on one event.",
             .formal = "∀ machine, state q, event e, input x: at most one row (q, e, g) has g(x)",
             .engines = {tables},
             .source = "transition tables in fsm/",
             .about = Vocabulary::everything,
             .counts_on = Premise::rules},
    Property{.id = "fsm.totality",
             .statement = "Every pair of state and event is handled or listed as legally ignored.",
             .formal = "∀ machine, q, e: (∃ row (q, e, g): g ≡ true over the rows) ∨ (q, e) listed",
             .assumptions = "inputs range freely",
             .engines = {tables},
             .source = "specs/ignored-pairs.yaml",
             .about = Vocabulary::everything,
             .counts_on = Premise::rules},
    Property{.id = "fsm.reachability",
             .statement = "Every state and every row can be reached; a row that cannot is dead.",
             .formal = "∀ q: initial →* q over rows with satisfiable guards; ∀ row: g satisfiable",
             .assumptions = "inputs range freely",
             .engines = {tables},
             .source = "transition tables in fsm/",
             .about = Vocabulary::everything,
             .counts_on = Premise::rules},
    Property{
        .id = "composition.total",
        .statement =
            "What there is between the machines is used and caused by rules, or a reason is given.",
        .formal = "∀ outbox field: read; ∀ event: fed; ∀ timer, packet, occasion: caused and "
                  "handled; ∀ state: set; or listed with a reason",
        .engines = {tables},
        .source = "rules in fsm/composition/",
        .about = Vocabulary::everything,
        .counts_on = Premise::rules},
    Property{
        .id = "composition.live",
        .statement = "Each effect of each rule can happen, or a knob of the profile rules it out.",
        .formal = "∀ effect: initial →* a step in which it happens; or its knobs ⊢ it never does",
        .assumptions = "packets and timers in any order",
        .engines = {tables},
        .source = "rules in fsm/composition/",
        .about = Vocabulary::rules,
        .counts_on = Premise::rules},
    Property{
        .id = "composition.pending",
        .statement =
            "What a descriptor or a reader waits for is under way, and who lacks it is waited for.",
        .formal = "□ (X = 0 ⇒ C ≠ A) ∧ □ (C = R ⇒ repair generation pending) ∧ □ (C = S ⇒ end of "
                  "suppression pending) ∧ □ (open ∧ C ≠ A ⇒ HEARTBEAT expiry pending) ∧ □ (no "
                  "HEARTBEAT seen ⇒ initial ACKNACK pending)",
        .stateful = "R waits for the writer's nack response, Q for the participant's async run, "
                    "and U, not all but A, for an expiry; a reply that was asked for is pending.",
        .engines = {tables},
        .source = "rules in fsm/composition/",
        .counts_on = Premise::rules},
    Property{
        .id = "order.total",
        .statement = "(time, class, insertion) is a strict total order on events.",
        .formal = "irreflexive, asymmetric, transitive, and total for distinct insertion numbers",
        .engines = {tables},
        .source = "model.md, events and their order",
        .about = Vocabulary::everything,
        .counts_on = Premise::rules},
    Property{.id = "order.reception-first",
             .statement = "No protocol decision at time t misses a reception that completes at t; "
                          "the channel starts last.",
             .formal =
                 "∀ events a, b at t: reception(a) ∧ decision(b) ⇒ a before b; dispatch after both",
             .assumptions = "a service or delay takes at least 1 ns",
             .engines = {tables, exact_run},
             .source = "model.md, events and their order",
             .about = Vocabulary::everything,
             .counts_on = Premise::services},
    Property{
        .id = "order.commutation",
        .statement = "Same-time events of one relation commute, except for the listed pairs, which "
                     "the tie rule decides.",
        .formal = "∀ kinds a, b, states σ: a(b(σ)) = b(a(σ)) with equal outputs, or (a, b) listed",
        .stateful =
            "The kinds are those of Fast DDS's writer: creation, nack response, serialization.",
        .assumptions = "one relation; announcements",
        .engines = {tables},
        .source = "specs/expected/commutation.yaml",
        .counts_on = Premise::rules},
    Property{.id = "safety.ack-implies-received",
             .statement = "A descriptor that the writer takes as acknowledged has been received.",
             .formal = "□ (C = A ⇒ X = 1)",
             .engines = {tables, explorer, exact_run},
             .source = "model.md, reception of an ACKNACK",
             .amended = Wording{},
             .clients = Wording{.engines = {tables}},
             .samples = Wording{.engines = {tables, explorer}}},
    Property{.id = "safety.ack-stable",
             .statement = "What is acknowledged stays so unless its reader forgot it.",
             .formal = "□ (C leaves A ⇒ X = 0)",
             .engines = {exact_run},
             .source = "museum.md, the properties",
             .amended = Wording{},
             .clients = Wording{}},
    Property{
        .id = "safety.repair-only-if-asked",
        .statement = "Repair DATA carries only descriptors that some ACKNACK listed as missing.",
        .formal = "□ (repair DATA carries D ⇒ an ACKNACK with D reached the writer since D was "
                  "last sent)",
        .stateful =
            "Also for what was announced but never pushed: it is sent when an ACKNACK asks for it.",
        .engines = {tables, explorer, exact_run},
        .source = "model.md, repair",
        .clients = Wording{.engines = {tables}},
        .samples =
            Wording{.engines = {explorer},
                    .addition =
                        "A sample goes out once when it is created, and otherwise at most once "
                        "for each ACKNACK that listed it, whichever reader sent that."}},
    Property{
        .id = "safety.snapshot",
        .statement = "The bitmap of an ACKNACK never changes after its generation.",
        .formal = "□ (bitmap at reception = bitmap at generation = {D : X = 0 at generation})",
        .stateful =
            "The bitmap lists what was announced and is missing; base and bitmap are both fixed.",
        .engines = {tables, explorer, exact_run},
        .source = "model.md, ACKNACK generation",
        .clients = Wording{.engines = {tables}},
        .samples =
            Wording{.engines = {tables},
                    .addition = "It lists nothing, or all that its reader knew of and lacked when "
                                "its timer fired; its base is the first sample that it lacked."}},
    Property{
        .id = "safety.conservation",
        .statement = "Admitted bytes equal the demand in the queue and exceed W only for one "
                     "oversized packet; the channel never idles while something waits.",
        .formal = "□ (I = Σ demand of admitted packets ∧ (I ≤ W ∨ one packet) ∧ (waiting ⇒ busy))",
        .engines = {exact_run},
        .source = "model.md, packets, fragments, queue, channel",
        .about = Vocabulary::everything,
        .counts_on = Premise::one_way},
    Property{.id = "timer.single-heartbeat",
             .statement = "A writer never has two HEARTBEAT expiries pending.",
             .formal = "□ (pending expiries of (i, s) ≤ 1)",
             .engines = {tables, explorer, exact_run},
             .source = "model.md, periodic HEARTBEAT",
             .clients = Wording{.engines = {tables}}},
    Property{.id = "timer.progress",
             .statement = "Time goes on: no instant carries infinitely many events.",
             .formal = "∀ t: |{e : time(e) = t}| < ∞",
             .engines = {exact_run},
             .source = "museum.md, the properties",
             .about = Vocabulary::everything},
    Property{
        .id = "timer.suppression-honoured",
        .statement =
            "No descriptor leaves S for U earlier than τ_S after its own repair left the source.",
        .formal = "□ (S → U of D at t ⇒ t ≥ (source completion of D's last repair) + τ_S)",
        .stateful = "Suppression runs from serialization: no descriptor leaves S for U earlier "
                    "than τ_S after it was put into a message.",
        .engines = {explorer, exact_run},
        .source = "model.md, repair; fastdds.md, writer",
        .stateful_weakness = "a relation has one suppression timer: what is sent while it is "
                             "pending is suppressed only for the rest of it",
        .is_of_library = true,
        .clients = Wording{}},
    Property{.id = "live.no-stall",
             .statement = "For every started pair that has recognised each other, or could have, "
                          "while the receiver lacks a descriptor there is a pending event or a "
                          "packet in flight whose processing can bring it there.",
             .formal = "□ (i, j started ∧ X = 0 ⇒ ∃ pending event or packet in flight after which "
                       "X = 1 is reachable without further loss)",
             .assumptions = "stated over X, what the receiver has, whatever the writer believes; "
                            "an event that changes nothing does not count",
             .engines = {tables, explorer, exact_run},
             .source = "model.md, all rules of the writer and the reader",
             .samples = Wording{.engines = {explorer},
                                .addition = "It is the writer's HEARTBEAT timer that is under way, "
                                            "or the announcement timer of whoever is unknown."},
             .counts_on = Premise::one_way},
    Property{.id = "live.completion",
             .statement = "With per-packet delay ≤ Δ and at most k lost packets every descriptor "
                          "is received within B(k, Δ, τ).",
             .formal = "X = 1 at most B after the relation opens; push: B(0) = Δ, B(1) = 3Δ + τ_A "
                       "+ τ_N =: F, B(2) = F + W + τ_H, B(k) = B(k−1) + (1 + ⌊W/τ_H⌋)·τ_H; W = 2Δ "
                       "+ σ + τ_N + τ_S, σ the time to leave the source; pull: B(k+1)",
             .stateful =
                 "Counted from the match or the creation of the descriptor, whichever comes last.",
             .assumptions = "delays ≤ Δ, losses ≤ k",
             .engines = {calculus, timelines, explorer, exact_run},
             .source = "specs/guide/bounds.md",
             .counts_on = Premise::punctual_timers},
    Property{.id = "live.quiescence",
             .statement =
                 "After completion and without further loss SEDP traffic stops, within a bound.",
             .formal = "no DATA, HEARTBEAT or ACKNACK is sent later than T_disc + Q(Δ, τ)",
             .assumptions = "delays ≤ Δ, no loss after completion",
             .engines = {calculus, timelines, explorer, exact_run},
             .source = "specs/guide/bounds.md",
             .weakness = "if the only HEARTBEAT of a relation is lost and an initial ACKNACK "
                         "confirms everything, the reader's initial ACKNACKs go on for ever",
             .counts_on = Premise::punctual_timers},
    Property{
        .id = "live.recovery",
        .statement = "Once nothing fails any more, everybody has what it lacks within a bound.",
        .formal =
            "∀ t* such that no packet is lost, no outage lasts and nobody starts after t*: X = 1 "
            "at t* + B for all who live; B = L + I + R + B(1), L the longest lease, I until the "
            "next initial ACKNACK, R until a reader asks by itself, B(1) with τ_P for each attempt",
        .assumptions = "delays ≤ Δ",
        .engines = {tables, exact_run},
        .source = "museum.md, the properties",
        .about = Vocabulary::closed_loop,
        .amended = Wording{.engines = {tables}},
        .relayed =
            Wording{.addition =
                        "With Discovery Servers: everybody knows what it matches, and nobody who "
                        "is gone; B = 2 L + E + P + 2 T + k (R + H + N + 4 Δ), P until the next "
                        "announcement, T a client's tick, R the server's routine, k rounds of "
                        "repairs."},
        .samples =
            Wording{.addition =
                        "Of Cyclone DDS: who has somebody else knows exactly what that one has; B "
                        "= L + E + A + k (H + N + 4 Δ), A until the next announcement, H the "
                        "longest distance of HEARTBEATs, N until a reader asks again, k rounds of "
                        "repairs."},
        .of_lives = true,
        .counts_on = Premise::punctual_timers,
        .needs = Need::failure},
    Property{
        .id = "live.isolation",
        .statement = "A participant that is dead delays nobody else.",
        .formal =
            "∀ i, j that live: X = 1 from T on ⇒ T ≤ T' + τ, T' the same in the run without the "
            "dead in which the same packets are lost, τ one HEARTBEAT period (adaptive: T_min)",
        .assumptions = "constant delays",
        .engines = {exact_run},
        .source = "museum.md, the properties",
        .about = Vocabulary::closed_loop,
        .amended = Wording{},
        .of_lives = true,
        .counts_on = Premise::punctual_timers,
        .needs = Need::silence},
    Property{.id = "storm.single-copy",
             .statement = "Without loss no descriptor reaches a receiver twice.",
             .formal =
                 "no losses ⇒ □ (each D is received at most once); for constant delay Δ and two "
                 "HEARTBEATs g apart a needless repair appears iff τ_N + τ_S < g < 2Δ + τ_N",
             .assumptions = "no loss",
             .engines = {timelines, explorer, exact_run},
             .source = "specs/guide/bounds.md",
             .weakness =
                 "a HEARTBEAT overtakes DATA that is on its way, and the reader asks for it again",
             .stateful_weakness =
                 "a HEARTBEAT overtakes DATA that is on its way, and the reader asks for it again",
             .counts_on = Premise::punctual_timers},
    Property{
        .id = "storm.free-threshold",
        .statement = "No repair is possible as long as no packet takes longer than a threshold.",
        .formal = "∀ delays ≤ Δ: no repair, iff Δ ≤ Δ*(τ_A, τ_N, τ_H, τ_I)",
        .stateful = "Also for descriptors that are pulled: none is sent twice.",
        .assumptions = "no loss",
        .engines = {timelines, explorer, exact_run},
        .source = "specs/guide/bounds.md",
        .weakness = "packets take longer than the timers wait",
        .stateful_weakness = "packets take longer than the timers wait; what exists at the match "
                             "is pulled, and asked for again before it arrives",
        .is_margin = true,
        .counts_on = Premise::punctual_timers},
    Property{.id = "storm.cannot-start",
             .statement = "This deployment, over this channel, never repairs without a loss, "
                          "whenever its participants start.",
             .formal = "∀ start times, no losses: □ (each D is generated at most once for each "
                       "receiver); from: no packet of the open-loop traffic waits longer than Δ*",
             .stateful = "Also for descriptors that are pulled: none is sent twice.",
             .assumptions = "no loss",
             .engines = {calculus, exact_run},
             .source = "specs/guide/cannot-start.md",
             .weakness = "the load makes packets take longer than the timers wait",
             .stateful_weakness = "the load makes packets take longer than the timers wait",
             .is_margin = true,
             .counts_on = Premise::punctual_timers},
    Property{
        .id = "storm.join-cost",
        .statement = "Who is recognised costs one announcement.",
        .formal = "∀ event in which r participants are recognised: announcements sent in it ≤ r",
        .engines = {exact_run},
        .source = "museum.md, the properties",
        .weakness = "with resend: all_known whoever recognises a participant announces itself to "
                    "all that it knows, so a join costs more the more there are",
        .is_margin = true,
        .about = Vocabulary::closed_loop,
        .amended = Wording{}},
    Property{
        .id = "storm.piggyback-rate",
        .statement = "DATA causes HEARTBEATs in proportion to its bytes.",
        .formal = "∀ t: HEARTBEATs that ride in DATA up to t ≤ bytes of DATA up to t / threshold + "
                  "|writers|",
        .engines = {exact_run},
        .source = "museum.md, the properties",
        .weakness = "with piggyback: cumulative each DATA is charged with all that was sent before",
        .is_margin = true,
        .about = Vocabulary::closed_loop,
        .amended = Wording{}},
    Property{
        .id = "storm.feedback-gain",
        .statement =
            "An ACKNACK that changes nothing causes no HEARTBEAT at once, and none causes two.",
        .formal = "∀ reception of an ordinary ACKNACK: HEARTBEATs sent in it ≤ 1, and 0 unless "
                  "some C changes",
        .engines = {exact_run},
        .source = "museum.md, the properties",
        .amended = Wording{},
        .clients = Wording{},
        .samples =
            Wording{.addition = "A HEARTBEAT that is meant for one reader alone answers an ACKNACK "
                                "of its own, which was pre-emptive or asked for something."}},
    Property{.id = "composition.followed",
             .statement = "What a run does is what the rules say.",
             .formal = "∀ event: (transitions, scheduled events, packets) = those of its rules in "
                       "fsm/composition, in order",
             .assumptions = "steps that a rule leaves to its host do what their contracts allow",
             .engines = {exact_run},
             .source = "fsm/composition; stormproof draw composition",
             .about = Vocabulary::rules,
             .of_lives = true,
             .counts_on = Premise::rules},
};

}  // namespace

std::span<const Property> catalogue() { return properties; }

}  // namespace stormproof::props
