// What there is so that participants can ask each other for types that they do not know, besides
// the control-only relations on which they do: two writers of each participant, of questions and of
// answers, send samples to all their readers, reliably as far as nothing is lost. The rules are in
// fsm/composition/control.hpp, as far as they are about HEARTBEATs and ACKNACKs, and in
// fsm/composition/lookups.hpp.
// Source: specs/guide/fastdds.md, "Lookups of types".
#pragma once

#include "fsm/composition/packets.hpp"
#include "fsm/composition/single_shots.hpp"

namespace stormproof::fsm::composition::lookup {

/// Participants have endpoints that ask for types, and answer.
struct LooksUpTypes : SwitchOf<"type_lookup", "true">, OfBothEnds {};
/// The endpoints of the deployment have types.
struct HaveTypes : Answer {};
/// Participants ask for what they do not know.
struct AsksForTypes : Fact {
  template <class W>
  static auto of(W& w) {
    return w(LooksUpTypes{}) && w(HaveTypes{});
  }
};
struct ExpiryPeriod : DelayOf<"typelookup_heartbeat_period"> {};  ///< τ_L

// What no version of Fast DDS has, but might: questions and answers go to whom they are for alone,
// and a participant is asked for all its types at once, or for each once whatever its stream.
struct FiltersAnswers : SwitchOf<"typelookup_filter", "answers", "all"> {};
struct FiltersQuestions : SwitchOf<"typelookup_filter", "all"> {};
struct AsksForStreams : SwitchOf<"typelookup_unit", "type_and_stream"> {};
struct AsksForAll : SwitchOf<"typelookup_unit", "participant"> {};
/// Then the source of the pair has asked the destination, which has not answered yet.
struct HasAsked : Flag<owner::pair> {};

/// The control-only relation is one of questions or answers; of answers.
struct OfLookups : Answer {};
struct OfAnswers : Answer {};
/// Its writer has samples.
struct KeepsSamples : Fact {
  template <class W>
  static auto of(W& w) {
    return w(AsksForTypes{}) && w(OfLookups{});
  }
};

struct LookupExpiry : Part<SingleShot, owner::control_writer> {};
struct LookupExpiryDue : Timer<owner::control_writer> {};

struct SamplesSent : Number<owner::control_writer> {};    ///< H
struct GetsSamples : Flag<owner::control_relation> {};    ///< the reader is among M
struct SamplesTold : Number<owner::control_relation> {};  ///< the last one that went to the reader
struct SamplesAcknowledged : Number<owner::control_relation> {};  ///< low, at the writer
struct SamplesGot : Number<owner::control_relation> {};           ///< at the reader
struct SamplesQueued : Number<owner::participant> {};  ///< before its next asynchronous run

/// What a HEARTBEAT announces, and an ACKNACK acknowledges: the first so many samples.
struct SampleCount : PacketNumber {};
/// Of a sample: its number, from 1; whose lookup it is part of, and of what; how far that has come;
/// and whether it is addressed to the reader, as it goes to others, too.
struct SampleNumber : PacketNumber {};
struct LookedUp : PacketNumber {};
struct Stage : PacketNumber {};
struct IsForReader : PacketField {};
/// Questions and answers take turns: 0 asks for the dependencies of a type, 1 answers, 2 asks for
/// the type, 3 answers.
inline constexpr int last_stage = 3;

struct LookupSample : Packet<owner::control_relation, SampleNumber, LookedUp, Stage, IsForReader> {
};

/// The piggyback budget of the writer is the threshold again.
struct RefillLookupBudget : Opaque {
  template <class W>
  static void contract(W&) {}
};
template <class W>
void arm(W& w) {
  request<LookupExpiry, ExpiryPeriod, LookupExpiryDue>(w);
}

}  // namespace stormproof::fsm::composition::lookup
