// The two sides of a stateful test: something under test, driven as a run drives it, and a model of
// the same rules in plain code. Both are told the same calls (events with random payloads) and say
// in words what they then show: their state and what they ask for. The words must be the same after
// every call.
//
// Everything is behind plain interfaces, so that RapidCheck is compiled once (law.cpp) and no file
// with Boost.MSM or the simulator in it includes RapidCheck.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stormproof::stateful {

/// An event, by its position in `Subject::events`, with its payload.
struct Call {
  std::size_t event = 0;
  std::vector<std::int64_t> payload;
};

/// Name of an event and the largest value of each number in its payload; the least one is 0.
struct EventShape {
  std::string name;
  std::vector<std::int64_t> payload = {};
};

/// Something that reacts to calls.
class Reactor {
 public:
  virtual ~Reactor() = default;
  /// Processes the call; says what can be seen then.
  virtual std::string react(const Call& call) = 0;
};

/// The rules in plain code.
class Model : public Reactor {
 public:
  /// Whether the rules let this event occur now.
  [[nodiscard]] virtual bool possible(const Call& call) const = 0;
  [[nodiscard]] virtual std::unique_ptr<Model> clone() const = 0;
};

/// `clone` for a model that is a plain value.
template <class Self>
class PlainModel : public Model {
 public:
  [[nodiscard]] std::unique_ptr<Model> clone() const override {
    return std::make_unique<Self>(static_cast<const Self&>(*this));
  }
};

struct Subject {
  std::string name;  ///< of the test: letters and digits
  std::vector<EventShape> events;
  std::function<std::unique_ptr<Model>()> model;
};

/// Lists of numbers in words, for what is shown.
template <class Numbers>
std::string in_words(const Numbers& numbers) {
  std::string text;
  for (const auto number : numbers) text += (text.empty() ? "" : " ") + std::to_string(number);
  return "[" + text + "]";
}

}  // namespace stormproof::stateful
