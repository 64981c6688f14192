// The families of laws, each in a file of its own; `laws()` joins them.
#pragma once

#include <span>

#include "model/implementations.hpp"
#include "props/laws/law.hpp"

namespace stormproof::props {

/// Whether packets wait for one another.
[[nodiscard]] inline bool is_shared(const model::Scenario& scenario) {
  return scenario.wireless.kind == model::ServiceKind::shared_channel;
}

[[nodiscard]] std::span<const Law> repetition_laws();  ///< runs of the same scenario, cut or not
[[nodiscard]] std::span<const Law> naming_laws();      ///< names and numbers
[[nodiscard]] std::span<const Law> time_laws();        ///< other units and another origin of time
[[nodiscard]] std::span<const Law> byte_laws();        ///< another unit of size
[[nodiscard]] std::span<const Law> workload_laws();    ///< what has to be delivered, at least
[[nodiscard]] std::span<const Law>
quiet_laws();  ///< a network without delays or losses to speak of
[[nodiscard]] std::span<const Law> obligation_laws();    ///< what has to happen, and when
[[nodiscard]] std::span<const Law> introduction_laws();  ///< who announces itself to whom
[[nodiscard]] std::span<const Law> opening_laws();       ///< what a writer says at once
[[nodiscard]] std::span<const Law> request_laws();       ///< what is asked for, and when it comes
[[nodiscard]] std::span<const Law> reminder_laws();      ///< whoever lacks something is asked
[[nodiscard]] std::span<const Law> control_laws();       ///< relations without DATA
[[nodiscard]] std::span<const Law> lookup_laws();        ///< types that are not known
[[nodiscard]] std::span<const Law> sample_laws();        ///< what is said of them, to everybody
[[nodiscard]] std::span<const Law> accounting_laws();    ///< totals against what happened
[[nodiscard]] std::span<const Law> causality_laws();     ///< effects and causes
[[nodiscard]] std::span<const Law> service_laws();       ///< queue, order and losses
[[nodiscard]] std::span<const Law> bound_laws();         ///< how fast and how slow discovery can be
[[nodiscard]] std::span<const Law> adaptive_laws();      ///< the response-aware policy

/// Whether writers repair by one response and one queue for all their readers, as Fast DDS's do.
[[nodiscard]] inline bool is_stateful(const model::Scenario& scenario) {
  return model::traits_of(scenario.dds).writer == model::Writer::stateful;
}
/// Of laws that are about packets, events and timers as the paper and Fast DDS have them.
[[nodiscard]] inline bool is_of_two_writers(const model::Scenario& scenario) {
  return is_stateful(scenario) ||
         model::traits_of(scenario.dds).writer == model::Writer::of_the_paper;
}
/// Of those that know Cyclone DDS's messages, too.
[[nodiscard]] inline bool is_of_three_writers(const model::Scenario& scenario) {
  return is_of_two_writers(scenario) ||
         model::traits_of(scenario.dds).writer == model::Writer::of_cyclone;
}
/// Of those that are about what a packet says as a whole; messages of Cyclone DDS share packets.
[[nodiscard]] inline bool says_one_thing(const model::Scenario& scenario) {
  return !model::traits_of(scenario.dds).mixes_messages;
}
/// Of those that count on packets of their own for each reader.
[[nodiscard]] inline bool is_sent_to_each(const model::Scenario& scenario) {
  return says_one_thing(scenario) || scenario.dds.allow_multicast != model::AllowMulticast::always;
}

/// Of laws that say something about every scenario.
[[nodiscard]] inline bool always(const model::Scenario&) { return true; }
[[nodiscard]] inline const model::ImplementationTraits& traits_of(const model::Scenario& scenario) {
  return model::traits_of(scenario.dds);
}

}  // namespace stormproof::props
