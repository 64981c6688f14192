// What happened in the run of a counterexample up to the event that breaks the property: every
// event with its cause and its effects, and the way of every packet. Stories and charts are told
// from it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/engine/descriptor_set.hpp"
#include "model/engine/topology.hpp"
#include "model/probe.hpp"
#include "model/scenario.hpp"
#include "model/trace/transition_list.hpp"
#include "props/verdict.hpp"

namespace stormproof::counterexample {

/// One processed event; its position in `History::steps` is its number.
struct Step {
  struct Timer {
    model::EventKind kind{};
    model::Nanoseconds due;
    std::uint32_t subject = 0;
    std::string effect{};  ///< of the composition, that starts it; empty: not known
  };
  struct Reception {
    std::uint64_t packet = 0;
    std::uint32_t receiver = 0;
    std::string news;  ///< DATA: which descriptors arrive for the first time
  };

  model::Event event;
  std::optional<std::uint64_t> cause;  ///< number of the event that scheduled this one
  std::vector<model::trace::TransitionList::Entry> transitions;  ///< those that change the state
  std::vector<std::uint64_t> emitted;                            ///< packet numbers
  std::optional<std::uint64_t> left_source;
  std::optional<std::uint64_t> arrived;
  std::vector<Reception> receptions;
  std::optional<std::uint64_t> served;  ///< the packet whose fragment starts or ends to be served
  std::vector<Timer> timers;            ///< of the protocol, that it starts
};

/// Packets to participants on the same host have no number in the model; here they are numbered
/// from this one on.
inline constexpr std::uint64_t first_local = std::uint64_t{1} << 62U;
inline constexpr std::uint32_t no_relation = UINT32_MAX;
inline constexpr std::uint32_t to_everybody = UINT32_MAX;

/// The service of a packet in one stage of its route, over all of its fragments.
struct Service {
  std::uint32_t channel = 0;
  std::uint32_t stage = 0;
  std::size_t first = 0;            ///< step that starts the first fragment
  std::optional<std::size_t> last;  ///< step that ends the last fragment, so far
};

/// One packet on its way.
struct PacketLog {
  std::string label;    ///< "ACKNACK"
  std::string content;  ///< "lacks 0–9"; may be empty
  std::uint32_t from = 0;
  std::uint32_t to = to_everybody;
  std::uint32_t relation = no_relation;  ///< SPDP has none
  std::size_t emitted = 0;               ///< step
  std::optional<std::size_t> left_source;
  std::optional<std::size_t> arrived;
  bool lost = false;
  std::string effect{};           ///< of the composition, that sent it; empty: not known
  std::vector<Service> services;  ///< by stage that it has reached
};

struct History {
  model::Scenario scenario;
  model::Topology topology;
  std::vector<std::string> channels;  ///< names; none with constant delay
  std::vector<Step> steps;            ///< up to the violating event
  std::map<std::uint64_t, PacketLog> packets;

  [[nodiscard]] const Step& violating() const { return steps.back(); }
};

/// Runs the scenario of the counterexample up to its event. The history has fewer steps if the run
/// ends before, and none if nothing ever happens.
[[nodiscard]] History record(const props::Counterexample& counterexample);

/// "0–9, 12": members of a set in short form, as runs.
[[nodiscard]] std::string members_text(model::Words words);

}  // namespace stormproof::counterexample
