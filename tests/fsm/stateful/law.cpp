// Tries the law with RapidCheck's state testing. The only file of these tests that includes it.
#include "tests/fsm/stateful/law.hpp"

#include <sstream>

#include <rapidcheck.h>
#include <rapidcheck/detail/TestListenerAdapter.h>
#include <rapidcheck/state.h>

namespace stormproof::stateful {

namespace {

/// A model with the value semantics that RapidCheck wants.
class State {
 public:
  explicit State(std::unique_ptr<Model> model) : model_{std::move(model)} {}
  State(const State& other) : model_{other.model_->clone()} {}
  State& operator=(const State& other) {
    model_ = other.model_->clone();
    return *this;
  }
  Model* operator->() { return model_.get(); }
  const Model* operator->() const { return model_.get(); }

 private:
  std::unique_ptr<Model> model_;
};

class CallCommand final : public rc::state::Command<State, Reactor> {
 public:
  CallCommand(const Subject& subject, Call call) : subject_{subject}, call_{std::move(call)} {}

  void checkPreconditions(const State& state) const override { RC_PRE(state->possible(call_)); }
  void apply(State& state) const override { state->react(call_); }
  void run(const State& state, Reactor& under_test) const override {
    State after{state};
    const std::string expected = after->react(call_);
    const std::string shown = under_test.react(call_);
    RC_ASSERT(shown == expected);
  }
  void show(std::ostream& out) const override {
    out << subject_.events[call_.event].name;
    if (!call_.payload.empty()) out << ' ' << in_words(call_.payload);
  }

 private:
  const Subject& subject_;
  Call call_;
};

using CommandPointer = std::shared_ptr<const CallCommand::CommandType>;

/// Calls with one number of the payload smaller: 0, half of it, one less.
std::vector<Call> simpler(const Call& call) {
  std::vector<Call> list;
  for (std::size_t k = 0; k < call.payload.size(); ++k) {
    const std::int64_t number = call.payload[k];
    for (const std::int64_t smaller : {std::int64_t{0}, number / 2, number - 1}) {
      if (smaller < 0 || smaller >= number) continue;
      list.push_back(call);
      list.back().payload[k] = smaller;
    }
  }
  return list;
}

/// Any event of the subject with any payload, each as likely as any other, whatever the size.
rc::Gen<CommandPointer> any_call(const Subject& subject) {
  return [&subject](rc::Random random, int) {
    const auto below = [&random](std::uint64_t count) { return random.next() % count; };
    Call call;
    call.event = below(subject.events.size());
    for (const std::int64_t largest : subject.events[call.event].payload) {
      call.payload.push_back(
          static_cast<std::int64_t>(below(static_cast<std::uint64_t>(largest) + 1)));
    }
    const auto shrinkable = rc::shrinkable::shrinkRecur(
        std::move(call), [](const Call& c) { return rc::seq::fromContainer(simpler(c)); });
    return rc::shrinkable::map(shrinkable, [&subject](const Call& c) -> CommandPointer {
      return std::make_shared<const CallCommand>(subject, c);
    });
  };
}

}  // namespace

std::optional<std::string> broken_on(const Subject& subject,
                                     const std::function<std::unique_ptr<Reactor>()>& under_test,
                                     const Effort& effort) {
  const auto property = [&] {
    const std::unique_ptr<Reactor> reactor = under_test();
    rc::state::check([&] { return State{subject.model()}; }, *reactor,
                     [&](const State&) { return any_call(subject); });
  };
  rc::detail::TestMetadata metadata;
  metadata.id = metadata.description = subject.name;
  rc::detail::TestParams params;
  params.seed = 20'240'117;
  params.maxSuccess = effort.sequences;
  params.maxSize = effort.longest;
  params.disableShrinking = !effort.shrink;
  rc::detail::TestListenerAdapter quiet;
  const rc::detail::TestResult result =
      rc::detail::checkTestable(property, metadata, params, quiet);
  if (result.is<rc::detail::SuccessResult>()) return {};
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  return text.str();
}

}  // namespace stormproof::stateful
