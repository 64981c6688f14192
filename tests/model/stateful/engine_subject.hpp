// The parts of the simulator's engine as subjects of stateful tests: the event queue, the source
// queue, and the network with its channels. Their models can be built with one deliberate mistake
// each; the test wants every one of them to be noticed.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/fsm/stateful/reactor.hpp"

namespace stormproof::model::stateful {

using namespace stormproof::stateful;

/// What a model does wrong.
enum class Wrong : std::uint8_t {
  nothing,
  // Event queue.
  class_ignored,
  latest_first,  ///< of one time and class, the last inserted comes first
  forgets_one,   ///< every tenth event is not inserted
  // Source queue.
  admits_one_more,      ///< while anything of W is left
  never_admits_larger,  ///< a packet larger than W waits for ever
  drops_when_full,      ///< what does not fit is gone
  last_in_first_out,
  copies_count_once,
  // Network.
  rank_ignored,
  forwards_first,  ///< before the source's next fragment is requested
  airtime_rounded_down,
  serves_two_at_once,
  loses_nothing,
  completes_late,        ///< source completion after the reception of a last stage
  receives_by_fragment,  ///< each last-stage fragment counts as a reception
};

struct EngineSubject : Subject {
  std::function<std::unique_ptr<Reactor>()> under_test;
  /// The model with a mistake.
  std::function<std::unique_ptr<Model>(Wrong)> wrong_model;
  std::vector<Wrong> wrongs;  ///< those that concern it
};

[[nodiscard]] std::vector<EngineSubject> queue_subjects();
[[nodiscard]] std::vector<EngineSubject> network_subjects();

template <class SomeModel, class UnderTest, class... Setup>
EngineSubject engine_subject(std::string name, std::vector<EventShape> events,
                             std::vector<Wrong> wrongs, Setup... setup) {
  EngineSubject subject;
  subject.name = std::move(name);
  subject.events = std::move(events);
  subject.wrongs = std::move(wrongs);
  subject.model = [setup...] { return std::make_unique<SomeModel>(Wrong::nothing, setup...); };
  subject.wrong_model = [setup...](Wrong w) { return std::make_unique<SomeModel>(w, setup...); };
  subject.under_test = [setup...] { return std::make_unique<UnderTest>(setup...); };
  return subject;
}

}  // namespace stormproof::model::stateful
