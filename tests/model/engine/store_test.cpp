// The store of a composition's things: each way to keep one, alone; and two hosts of the same
// things, one with the ways that follow by themselves and one with chosen ways, which cannot be
// told apart by what they answer, whatever is done to them.
#include <array>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "fsm/discovery_reader.hpp"
#include "model/engine/stored.hpp"
#include "tests/model/run_log.hpp"

namespace stormproof::model {
namespace store_test {

namespace own = comp::owner;

// A small composition: a reader, what it knows and asks, and a writer that ticks.
struct Side : comp::Part<fsm::DiscoveryReader, own::relation> {};
struct Open : comp::Flag<own::relation> {};
struct Rounds : comp::Number<own::participant> {};
struct Delay : comp::Number<own::relation> {};
struct Exists : comp::Flag<own::entry> {};
struct Known : comp::Flag<own::descriptor> {};
struct Asked : comp::Flag<own::descriptor> {};
struct Tick : comp::Timer<own::writer, true> {};
struct Retry : comp::Timer<own::relation> {};
}  // namespace store_test

template <>
inline constexpr EventKind event_kind_of<store_test::Tick> = EventKind::heartbeat_expiry;
template <>
inline constexpr EventKind event_kind_of<store_test::Retry> = EventKind::acknack_generation;

namespace store_test {

using Things = fsm::TypeList<Side, Open, Rounds, Delay, Exists, Known, Asked, Tick, Retry>;

/// `Retry` can be cancelled, so something must be kept of it.
struct Slow : PlainColumns {
  using PlainColumns::column;
  static way::Tokens column(Retry);
};
struct Fast : PlainColumns {
  using PlainColumns::column;
  static way::Narrow column(Rounds);
  static way::Capped column(Delay);
  static way::Prefix column(Exists);
  static way::Prefix column(Known);
  static way::Insertions column(Retry);
};

template <class Columns>
class Host final
    : public Stored<Host<Columns>, HostBase, Things, Columns, fsm::TypeList<Open, Exists>> {
 public:
  explicit Host(RunState& run) : Host::Stored{run} {}

  void changed(Open, std::uint32_t r, bool open) { heard.push_back({0, r, open ? 1U : 0U}); }
  void changed(Exists, std::uint32_t w, std::uint32_t d, bool) { heard.push_back({1, w, d}); }
  std::vector<std::array<std::uint32_t, 3>> heard;

  // An implementation, if somebody ran it.
  void start() override {}
  void handle(const Event&) override {}
  void source_completed(const Packet&) override {}
  [[nodiscard]] bool receives_separately() const override { return false; }
  [[nodiscard]] std::vector<std::uint32_t> receivers(const Packet&) const override { return {}; }
  void received(const Packet&, std::uint32_t) override {}
  void renew_bitmap(Packet&) override {}
  [[nodiscard]] std::uint32_t next_recipient(const Packet&, std::uint32_t n) const override {
    return n;
  }
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t) override { return {}; }
};

constexpr std::uint32_t samples = 150;
constexpr std::uint32_t words = (samples + 63) / 64;
Scenario two_participants() { return by_hand({{0, samples}, {1, samples}}); }

/// A flag becomes what a rule says, which reads it word by word while it is written.
template <class Host, class T, class Term>
void set_each(Host& host, T flag, std::uint32_t n, Term&& term) {
  for (std::uint32_t k = 0; k < words; ++k) {
    host.assign_word(flag, n, k, term(host.word(flag, n, k), k) & bits_below(samples, k));
  }
}
template <class Columns, class T>
std::string read(const Host<Columns>& host, T flag, std::uint32_t n) {
  std::string text;
  for (std::uint32_t d = 0; d < 64 * words; ++d) text += host.has(flag, n, d) ? '1' : '0';
  return text + ' ' + std::to_string(host.template first<T>(n));
}

/// The same walk on both.
template <class Columns>
struct Walker {
  Scenario scenario = two_participants();
  RunState run{scenario, nullptr};
  Host<Columns> host{run};
  std::string log;

  void act(std::uint32_t what, std::uint32_t n, std::uint32_t to) {
    const std::uint64_t many = to;
    if (what == 0) host.assign(Open{}, n, to % 2 == 0);
    if (what == 1) host.assign(Rounds{}, n % 2, to);
    if (what == 2) host.assign(Delay{}, n, std::int64_t{1} << to % 61);
    if (what == 3 && to % 2 == 0) host.assign(Exists{}, n, host.template first<Exists>(n), true);
    if (what == 3 && to % 2 != 0) host.template set_first<Exists>(n, to);
    if (what == 4) set_each(host, Known{}, n, [&](auto was, auto k) { return was | upto(to, k); });
    if (what == 5) set_each(host, Known{}, n, [&](auto was, auto k) { return was & upto(to, k); });
    if (what == 6) set_each(host, Asked{}, n, [&](auto was, auto) { return was ^ (many * many); });
    if (what == 7) host.assign(Asked{}, n, to, !host.has(Asked{}, n, to));
    if (what == 8) host.state(Side{}, n) = static_cast<fsm::StateId>(to % 2);
    if (what == 9) host.schedule(Tick{}, n, run.now.count() + to);
    if (what == 10) host.schedule(Retry{}, n, run.now.count() + to);
    if (what == 11) host.cancel(Tick{}, n);
    if (what == 12) host.cancel(Retry{}, n);
    if (what > 12 && !run.queue.empty()) happen(run.queue.pop());
  }
  static std::uint64_t upto(std::uint32_t count, std::uint32_t k) { return bits_below(count, k); }
  void happen(const Event& event) {
    run.now = event.time;
    const bool ticks = event.kind == event_kind_of<Tick>;
    const bool due = ticks ? host.is_due(Tick{}, event) : host.is_due(Retry{}, event);
    log += std::to_string(event.subject) + (ticks ? 't' : 'r') + (due ? "! " : ". ");
  }
  std::string all() {
    std::string text = log;
    for (std::uint32_t n = 0; n < 4; ++n) {
      text += '\n' + read(host, Exists{}, n) + ' ' + read(host, Known{}, n) + ' ' +
              read(host, Asked{}, n) + ' ' + std::to_string(host.value(Open{}, n)) +
              std::to_string(host.value(Rounds{}, n % 2)) + ' ' +
              std::to_string(host.value(Delay{}, n)) + ' ' +
              std::to_string(host.pending(Tick{}, n)) + ' ' + std::to_string(host.state(Side{}, n));
    }
    for (const auto& [what, n, to] : host.heard) {
      text += '\n' + std::to_string(what) + ' ' + std::to_string(n) + ' ' + std::to_string(to);
    }
    return text;
  }
};

RC_GTEST_PROP(Store, HowThingsAreKeptChangesNothing, ()) {
  Walker<Slow> slow;
  Walker<Fast> fast;
  for (int k = *rc::gen::inRange(0, 60); k > 0; --k) {
    const auto what = *rc::gen::inRange<std::uint32_t>(0, 16);
    const auto n = *rc::gen::inRange<std::uint32_t>(0, 4);
    const auto to = *rc::gen::element<std::uint32_t>(0, 1, 2, 30, 63, 64, 65, 100, 128, 149);
    slow.act(what, n, to);
    fast.act(what, n, to);
    RC_ASSERT(slow.all() == fast.all());
  }
}

template <class Way>
using Place = detail::Place<Known, Way>;

/// The first 100 are known, and stay so: to keep the first word must not cut off the second, which
/// is read after that.
TEST(Store, APrefixIsReadWhileItIsWritten) {
  Place<way::Prefix> known;
  known.set_first(100);
  for (std::uint32_t k = 0; k < words; ++k) known.set_word(k, known.word(k));
  EXPECT_EQ(known.first(), 100U);
  for (std::uint32_t k = 0; k < words; ++k) known.set_word(k, known.word(k) | bits_below(130, k));
  EXPECT_EQ(known.first(), 130U);
}

TEST(Store, APrefixBecomesShorterAndEmpty) {
  Place<way::Prefix> known;
  known.set_first(140);
  for (std::uint32_t k = 0; k < words; ++k) known.set_word(k, bits_below(70, k));
  EXPECT_EQ(known.first(), 70U);
  for (std::uint32_t k = 0; k < words; ++k) known.set_word(k, 0);
  EXPECT_EQ(known.first(), 0U);
}

TEST(Store, ADelayStopsToGrowBeyondAnyRun) {
  Walker<Fast> fast;
  Walker<Slow> slow;
  for (unsigned k = 0; k < 62; ++k) {
    fast.host.assign(Delay{}, 1, std::int64_t{1} << k);
    slow.host.assign(Delay{}, 1, std::int64_t{1} << k);
  }
  EXPECT_EQ(fast.host.value(Delay{}, 1), std::int64_t{1} << 60);
  EXPECT_EQ(slow.host.value(Delay{}, 1), std::int64_t{1} << 61);
}

/// What is due is not pending any more, and what is due a second time does not count.
TEST(Store, TokensCountAndCancel) {
  Walker<Fast> one;
  one.act(9, 1, 1);
  one.act(9, 1, 2);
  EXPECT_EQ(one.host.pending(Tick{}, 1), 2);
  const Event first = one.run.queue.pop();
  EXPECT_TRUE(one.host.is_due(Tick{}, first));
  EXPECT_EQ(one.host.pending(Tick{}, 1), 1);
  one.act(11, 1, 0);
  EXPECT_EQ(one.host.pending(Tick{}, 1), 0);
  EXPECT_FALSE(one.host.is_due(Tick{}, one.run.queue.pop()));
  one.act(9, 1, 1);
  const Event last = one.run.queue.pop();
  EXPECT_NE(last.detail, first.detail);
  EXPECT_TRUE(one.host.is_due(Tick{}, last));
  EXPECT_TRUE(one.host.is_due(Tick{}, last));
  EXPECT_EQ(one.host.pending(Tick{}, 1), 0);
}

/// Rows of relations are there for one only, whatever its number.
struct One {
  std::uint32_t relation;
};
struct OfOne : PlainColumns {
  template <comp::Owner owner>
  static std::uint32_t rows(const One&) {
    return 1;
  }
  static std::uint32_t row(comp::Owner, std::uint32_t n, const One& one) {
    return n - one.relation;
  }
};
TEST(Store, RowsAreThoseThatTheHostSays) {
  Store<fsm::TypeList<Open, Rounds, Side>, OfOne> store{One{7}};
  store.at<Open>(OfOne::row(Open::owner, 7, {7})).value = true;
  EXPECT_TRUE(store.at<Open>(0).value);
  EXPECT_EQ(store.at<Side>(0).value, fsm::Stepper<fsm::DiscoveryReader>::initial);
}

// A host hears of what it lists, by a function of the right name.
struct Hears {
  void changed(Open, std::uint32_t, bool) {}
  void changed(Exists, std::uint32_t, std::uint32_t, bool) {}
  void take_descriptors(std::uint32_t, const DescriptorSet&) {}
};
struct Misspelt {
  void chnaged(Open, std::uint32_t, bool) {}
};
struct OfAnotherShape {
  void changed(Open, std::uint32_t) {}
};
using All = fsm::TypeList<Open, Exists, comp::X>;
static_assert(detail::hears_what_it_says<Hears, All>(All{}));
static_assert(!detail::hears_what_it_says<Hears, fsm::TypeList<Open, Exists>>(All{}));
static_assert(!detail::hears_what_it_says<Hears, fsm::TypeList<Exists, comp::X>>(All{}));
static_assert(!detail::hears_what_it_says<Misspelt, fsm::TypeList<Open>>(All{}));
static_assert(!detail::hears_what_it_says<OfAnotherShape, fsm::TypeList<Open>>(All{}));

}  // namespace store_test
}  // namespace stormproof::model
