// What the printed assumptions of a proof admit: they are read sentence by sentence, and a sentence
// that nobody knows how to keep is a mistake of whoever printed it or of this table.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/scenario.hpp"
#include "props/verdict.hpp"

namespace stormproof::oracle {

/// The runs in which all that is assumed is true.
struct Admitted {
  bool may_lose = true;
  bool may_differ = true;          ///< delays of the packets between two hosts
  bool may_wait_in_source = true;  ///< σ > 0
  bool has_pairs_only = false;     ///< a writer has one reader
  bool is_of_deployment = false;   ///< participants, endpoints and channel are those that there are
  model::Nanoseconds shortest{0};  ///< delay
  std::optional<model::Nanoseconds> longest = {};
  std::vector<std::string> unknown = {};  ///< sentences
};

/// What a sentence, which begins so, means for a run.
struct Sentence {
  std::string_view words;
  void (*limit)(Admitted&, const model::Scenario&);
};

inline void take_longest(Admitted& admitted, model::Nanoseconds delay) {
  admitted.longest = std::min(admitted.longest.value_or(delay), delay);
}

/// They are true of every run of the simulator, about the solver's free choices, or of what a
/// monitor measures: Δ, k, the completion from which nothing is lost.
inline void true_of_all(Admitted&, const model::Scenario&) {}

inline constexpr std::array sentences{
    Sentence{"no packet is lost", [](Admitted& a, auto&) { a.may_lose = false; }},
    Sentence{"Nothing is lost.", [](Admitted& a, auto&) { a.may_lose = false; }},
    Sentence{"every packet between two hosts takes the same time",
             [](Admitted& a, auto&) { a.may_differ = false; }},
    Sentence{"Every packet takes the same time.", [](Admitted& a, auto&) { a.may_differ = false; }},
    Sentence{"no packet takes longer than Δ* = ",
             true_of_all},  // its number is that of the finding
    Sentence{"No packet takes longer than τ_A.",
             [](Admitted& a, const model::Scenario& s) {
               take_longest(a, s.dds.sedp.heartbeat_response_delay);
             }},
    Sentence{"0 < τ_I, both sides of a relation open at one instant, and no packet takes longer",
             [](Admitted& a, const model::Scenario& s) {
               take_longest(a, s.dds.sedp.initial_acknack_delay);
             }},
    Sentence{"Every service takes at least 1 ns",
             [](Admitted& a, auto&) { a.shortest = model::Nanoseconds{1}; }},
    Sentence{"a packet leaves its source at once",
             [](Admitted& a, auto&) { a.may_wait_in_source = false; }},
    Sentence{"a writer has one reader, so its timer starts with it",
             [](Admitted& a, auto&) { a.has_pairs_only = true; }},
    Sentence{"start times may be any", [](Admitted& a, auto&) { a.is_of_deployment = true; }},
    Sentence{"τ_I = 0: no reader asks by itself.", true_of_all},
    Sentence{"no packet takes longer than Δ (", true_of_all},
    Sentence{"no packet takes longer than Δ from emission to reception (", true_of_all},
    Sentence{"at most k packets of the relation are lost", true_of_all},
    Sentence{"nothing is lost from completion on", true_of_all},
    Sentence{"a packet may need all of Δ to leave its source", true_of_all},
    Sentence{"time counts from the creation of the descriptor", true_of_all},
    Sentence{"the writer's timer may be at any phase", true_of_all},
    Sentence{"an exchange takes the times that specs/guide/bounds.md gives it", true_of_all},
    Sentence{"DATA that is pushed when its descriptor is created is no repair.", true_of_all},
    Sentence{"the bound of the rules, at Δ = D*", true_of_all},
    Sentence{"the channel never pauses while something waits for it", true_of_all},
    Sentence{"What the rules leave to a host (draw composition", true_of_all},
    Sentence{"The numbers of descriptors and readers are arbitrary", true_of_all},
    Sentence{"ACKNACKs, HEARTBEATs and DATA may be delayed, lost, duplicated", true_of_all},
    Sentence{"A packet that matters arrives within Δ, unless it is lost", true_of_all},
    Sentence{"What is scheduled happens at its time", true_of_all},
    Sentence{"What is sent without being asked for is sent once", true_of_all},
    Sentence{"A packet is a value", true_of_all},
    Sentence{"while something is not acknowledged, an expiry is pending within τ_H", true_of_all},
    Sentence{"Relations open, suppressions end and responses come at any time", true_of_all},
    Sentence{"A scheduled event fires once", true_of_all},
    Sentence{"Participants that have started go on", true_of_all},
    Sentence{"Δ and σ are any numbers", true_of_all},
    Sentence{"In no instant do infinitely many events happen", true_of_all},
    Sentence{"What opens the writer's side here when the other one is recognised", true_of_all},
    Sentence{"A reader acknowledges all samples up to a number.", true_of_all},
    Sentence{"It is about what clients tell the server", true_of_all},
    Sentence{"Of the announcements to one participant, which go on, some arrives", true_of_all},
};

/// What the finding, about that scenario, promises something of.
inline Admitted admitted_by(const props::Finding& finding, const model::Scenario& scenario) {
  Admitted admitted;
  for (const std::string& assumption : finding.assumptions) {
    const auto known = std::ranges::find_if(sentences, [&](const Sentence& sentence) {
      return assumption.starts_with(sentence.words);
    });
    if (known == sentences.end()) {
      admitted.unknown.push_back(assumption);
    } else {
      known->limit(admitted, scenario);
    }
    if (assumption.starts_with("no packet takes longer than Δ* = ") && finding.longest_delay) {
      take_longest(admitted, *finding.longest_delay);
    }
  }
  return admitted;
}

}  // namespace stormproof::oracle
