// The event queue against its definition: the next event is the least (time, class, insertion
// number) of all that are in it. Random schedules with few different times make ties the rule, and
// times that go back send events of one kind past their lane.
#include "model/engine/event_queue.hpp"

#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace stormproof::model {
namespace event_queue_test {

using Key = std::tuple<std::int64_t, int, std::uint64_t>;
using Content = std::tuple<EventKind, std::uint32_t, std::uint32_t>;

constexpr std::uint32_t kind_count = static_cast<std::uint32_t>(event_kind_count);

/// The queue and a sorted reference of it, side by side.
class Twins {
 public:
  void schedule(std::int64_t time, EventKind kind, std::uint32_t subject, std::uint32_t detail) {
    const std::uint64_t insertion = queue_.schedule(Nanoseconds{time}, kind, subject, detail);
    RC_ASSERT(insertion == inserted_);
    reference_[{time, static_cast<int>(class_of(kind)), inserted_++}] = {kind, subject, detail};
    compare();
  }

  std::int64_t pop() {
    const auto [key, content] = *reference_.begin();
    reference_.erase(reference_.begin());
    const Event event = queue_.pop();
    RC_ASSERT(event.time.count() == std::get<0>(key));
    RC_ASSERT(static_cast<int>(class_of(event.kind)) == std::get<1>(key));
    RC_ASSERT(event.insertion() == std::get<2>(key));
    RC_ASSERT((content == Content{event.kind, event.subject, event.detail}));
    compare();
    return event.time.count();
  }

  [[nodiscard]] bool empty() const { return reference_.empty(); }

 private:
  void compare() const {
    RC_ASSERT(queue_.size() == reference_.size());
    RC_ASSERT(queue_.empty() == reference_.empty());
  }

  EventQueue queue_;
  std::map<Key, Content> reference_;
  std::uint64_t inserted_ = 0;
};

struct Step {
  bool pop = false;
  std::int64_t time = 0;
  std::uint32_t kind = 0;
  std::uint32_t subject = 0;
};

void showValue(const Step& step, std::ostream& out) {
  if (step.pop)
    out << "pop";
  else
    out << "schedule kind " << step.kind << " at " << step.time;
}

/// Schedules three times as often as it takes out, so that the queue grows and drains.
std::vector<Step> random_steps(std::int64_t times, std::uint32_t kinds) {
  const auto step = rc::gen::construct<Step>(
      rc::gen::map(rc::gen::inRange(0, 4), [](int k) { return k == 0; }),
      rc::gen::inRange<std::int64_t>(0, times), rc::gen::inRange<std::uint32_t>(0, kinds),
      rc::gen::arbitrary<std::uint32_t>());
  return *rc::gen::scale(3.0, rc::gen::container<std::vector<Step>>(step));
}

RC_GTEST_PROP(EventQueue, ServesAnyScheduleInOrder, ()) {
  Twins twins;
  for (const Step& step : random_steps(6, kind_count)) {
    if (!step.pop)
      twins.schedule(step.time, static_cast<EventKind>(step.kind), step.subject, 7);
    else if (!twins.empty())
      twins.pop();
  }
  while (!twins.empty()) twins.pop();
}

RC_GTEST_PROP(EventQueue, ServesOneKindThatIsScheduledBackAndForth, ()) {
  Twins twins;
  for (const Step& step : random_steps(1'000, 1)) {
    if (!step.pop)
      twins.schedule(step.time, EventKind::batch_due, step.subject, step.subject);
    else if (!twins.empty())
      twins.pop();
  }
  while (!twins.empty()) twins.pop();
}

RC_GTEST_PROP(EventQueue, ServesSchedulesThatLookAhead, ()) {
  Twins twins;  // as in a run: nothing is scheduled before the present
  std::int64_t now = 0;
  for (const Step& step : random_steps(4, kind_count)) {
    if (!step.pop)
      twins.schedule(now + step.time, static_cast<EventKind>(step.kind), step.subject, 0);
    else if (!twins.empty())
      now = twins.pop();
  }
  while (!twins.empty()) twins.pop();
}

/// Delays of these sizes, drawn anew for each event, while the queue grows to `length`, stays so,
/// and drains: ladders are built and taken down at every length.
void serves_random_delays(std::size_t length, const std::vector<std::int64_t>& sizes) {
  EventQueue queue;
  std::set<Key> reference;
  std::mt19937_64 random{length};
  std::int64_t now = 0;
  const auto schedule = [&] {
    const std::int64_t delay = static_cast<std::int64_t>(random() % 1'000);
    const std::int64_t time = now + delay * sizes[random() % sizes.size()];
    const auto kind = static_cast<EventKind>(random() % kind_count);
    const std::uint64_t insertion = queue.schedule(Nanoseconds{time}, kind, 5, 9);
    reference.emplace(time, static_cast<int>(class_of(kind)), insertion);
  };
  const auto pop = [&] {
    const Event event = queue.pop();
    const Key key{event.time.count(), static_cast<int>(event.event_class()), event.insertion()};
    ASSERT_EQ(key, *reference.begin());
    ASSERT_TRUE(event.subject == 5 && event.detail == 9 &&
                event.event_class() == class_of(event.kind));
    reference.erase(reference.begin());
    now = event.time.count();
  };
  for (std::size_t k = 0; k < length; ++k) {
    schedule();
    schedule();
    pop();
  }
  for (std::size_t k = 0; k < 2 * length; ++k) {
    pop();
    schedule();
  }
  while (!reference.empty()) pop();
  EXPECT_TRUE(queue.empty());
}

TEST(EventQueue, ServesRandomDelaysAtEveryLength) {
  for (const std::size_t length : {10U, 1'000U, 1'100U, 5'000U, 40'000U}) {
    serves_random_delays(length, {1'000});                    // alike
    serves_random_delays(length, {1, 1'000, 1'000'000'000});  // ladders upon ladders
    serves_random_delays(length, {0, 1});                     // many at one time
    serves_random_delays(length, {0});                        // all
  }
}

TEST(EventQueue, SameTimeIsOrderedByClassThenInsertion) {
  EventQueue queue;
  const Nanoseconds t{5};
  queue.schedule(t, EventKind::dispatch, 0);
  queue.schedule(t, EventKind::heartbeat_expiry, 1);
  queue.schedule(t, EventKind::announcement_due, 2);
  queue.schedule(t, EventKind::service_finished, 3);
  queue.schedule(t, EventKind::delayed_reception, 4);
  queue.schedule(t, EventKind::source_completion, 5);
  std::vector<std::uint32_t> subjects;
  while (!queue.empty()) subjects.push_back(queue.pop().subject);
  EXPECT_EQ(subjects, (std::vector<std::uint32_t>{3, 4, 1, 2, 5, 0}));
}

TEST(EventQueue, AnEventMayHaveAnotherClassThanItsKind) {
  static_assert(class_of(EventKind::reception) == EventClass::service);
  EventQueue queue;
  queue.schedule(Nanoseconds{5}, EventKind::dispatch, 1);
  queue.schedule_as(EventClass::dispatch, Nanoseconds{5}, EventKind::reception, 2, 7);
  queue.schedule(Nanoseconds{5}, EventKind::reception, 3);  // overtakes the other of its kind
  queue.schedule_as(EventClass::service, Nanoseconds{5}, EventKind::dispatch, 4, 0);
  std::string order;
  while (!queue.empty()) {
    const Event event = queue.pop();
    order += std::to_string(event.subject) + name_of(event.event_class()) + " ";
  }
  EXPECT_EQ(order, "3service 4service 1dispatch 2dispatch ");
}

TEST(EventQueue, EveryKindHasANameAndAClass) {
  std::set<std::string> names;
  for (std::uint32_t k = 0; k < kind_count; ++k) {
    const auto kind = static_cast<EventKind>(k);
    EXPECT_TRUE(names.insert(name_of(kind)).second) << name_of(kind);
    EXPECT_NE(std::string{name_of(class_of(kind))}, "");
  }
  EXPECT_EQ(class_of(EventKind::service_finished), EventClass::service);
  EXPECT_EQ(class_of(EventKind::delayed_reception), EventClass::service);
  EXPECT_EQ(class_of(EventKind::source_completion), EventClass::protocol);
  EXPECT_EQ(class_of(EventKind::dispatch), EventClass::dispatch);
}

}  // namespace event_queue_test
}  // namespace stormproof::model
