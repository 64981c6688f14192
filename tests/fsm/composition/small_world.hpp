// A world that executes: one participant with a few streams, readers and descriptors, for tests of
// what is derived from the same rules. Without a clock, what is scheduled may happen at any time,
// and what was sent may arrive at any time, any number of times. Choices and what only a host knows
// are drawn at random.
#pragma once

#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <boost/pfr.hpp>

#include "fsm/composition/first_value.hpp"
#include "fsm/flyweight.hpp"
#include "model/engine/composition_knobs.hpp"

namespace stormproof::fsm::composition {

inline constexpr int small_streams = 2;
inline constexpr int small_peers = 2;
inline constexpr int small_descriptors = 3;

/// Where something is. What is not among the owner's indices is 0.
struct Place {
  int stream = 0;
  int peer = 0;
  int descriptor = 0;
  int participant = 0;  ///< 0, or the other one, of the reverse direction

  auto operator<=>(const Place&) const = default;
  [[nodiscard]] Place of(Owner owner) const {
    const auto kept = [&](std::uint8_t index, int value) {
      return (owner.indices & index) != 0 ? value : 0;
    };
    return {kept(owner::stream_index, stream), kept(owner::peer_index, peer),
            kept(owner::descriptor_index, descriptor), participant};
  }
};
using Key = std::pair<std::string, Place>;

struct SentPacket {
  std::string name;
  Place place;
  std::map<std::string, std::uint32_t> says;  ///< by field: bits of descriptors, or all

  auto operator<=>(const SentPacket&) const = default;
};

struct SmallState {
  std::map<Key, std::int64_t> values;   ///< flags, numbers, states of parts
  std::map<Key, std::int64_t> pending;  ///< timers: how often
  std::set<Key> started;
  std::set<Key> surely_pending;  ///< started, and not been due since
  std::set<SentPacket> sent;
};

/// The time, and who is told of what is started and sent.
struct SmallClock {
  std::int64_t now = 0;
  std::function<void(const Key& timer, bool counted, std::int64_t due)> started;
  std::function<void(const Key& timer)> cancelled;
  std::function<void(const SentPacket& packet)> sent;
};

/// Descriptors, one bit each.
struct Members {
  std::uint32_t bits = 0;

  Members() = default;
  Members(bool all) : bits{all ? (1U << small_descriptors) - 1 : 0} {}
  explicit Members(std::uint32_t members) : bits{members} {}
};
struct MemberDomain {
  using Bool = Members;
  struct Int {
    constexpr Int(std::int64_t = 0) {}
  };
};

template <class Composition>
class SmallWorld {
 public:
  using D = Plain;
  using Bool = bool;
  using Int = std::int64_t;
  using Set = Members;
  using Dice = std::mt19937_64;

  SmallWorld(SmallState& state, const model::DdsProfile& dds, Dice& dice, Place place,
             SmallClock* clock = nullptr)
      : state_{&state},
        dds_{&dds},
        dice_{&dice},
        clock_{clock},
        place_{place},
        subject_{place.descriptor} {}

  template <class T>
  static std::string tag() {
    return std::string{name_of<T>()};
  }

  // Values.
  template <class Tag>
  auto operator()(Tag knob) {
    if constexpr (std::derived_from<Tag, Switch> || std::derived_from<Tag, Delay>) {
      if constexpr (model::is_knob<Tag>) {
        return model::knob_value(knob, *dds_);
      } else {
        return std::int64_t{draw(4)};  // of a deployment
      }
    } else if constexpr (std::derived_from<Tag, Fact>) {
      return Tag::of(*this);
    } else if constexpr (requires { typename Tag::IsFlag; }) {
      return value<Tag>() != 0;
    } else if constexpr (requires { typename Tag::IsNumber; }) {
      return std::int64_t{value<Tag>()};
    } else if constexpr (std::derived_from<Tag, DescriptorField>) {
      return (said<Tag>() >> place_.descriptor & 1) != 0;
    } else if constexpr (std::derived_from<Tag, PacketField>) {
      return said<Tag>() != 0;
    } else if constexpr (std::derived_from<Tag, PacketNumber>) {
      return std::int64_t{said<Tag>()};
    } else if constexpr (std::derived_from<Tag, Amount>) {
      if (std::is_same_v<Tag, Now> && clock_ != nullptr) return clock_->now;
      return std::int64_t{draw(4)};
    } else {
      return draw(2) == 1;
    }
  }
  template <class T>
  std::int64_t operator()(Pending<T>) {
    return state_->pending[{tag<T>(), place_.of(T::owner)}];
  }
  template <class P, class S>
  bool in(P, Is<S>) {
    return value<P>() == Reflect<typename P::Machine>::template id<S>;
  }
  [[nodiscard]] bool is_in(const Set& set) const {
    return (set.bits >> place_.descriptor & 1) != 0;
  }
  [[nodiscard]] bool is_subject() const { return place_.descriptor == subject_; }
  bool choice(const char*) { return draw(2) == 1; }
  static bool any(const Set& set) { return set.bits != 0; }
  template <class Term>
  Set set_of(Term&& term) {
    Set set;
    each([&](SmallWorld& d) {
      if (term(d)) set.bits |= 1U << d.place_.descriptor;
    });
    return set;
  }
  template <class Term>
  bool some(Term&& term) {
    return set_of(term).bits != 0;
  }
  template <class Term>
  bool all(Term&& term) {
    return set_of(term).bits == Set{true}.bits;
  }
  template <class Term>
  std::int64_t count(Term&& term) {
    return std::popcount(set_of(term).bits);
  }
  template <class Term>
  bool some_reader(Term&& term) {
    bool found = false;
    for_readers([&](SmallWorld& r) { found = found || term(r); });
    return found;
  }
  template <class Term>
  std::int64_t count_readers(Term&& term) {
    std::int64_t total = 0;
    for_readers([&](SmallWorld& r) { total += term(r) ? 1 : 0; });
    return total;
  }
  template <class Term>
  bool some_entry(Term&& term) {
    bool found = false;
    for (int s = 0; s < small_streams; ++s) {
      for (int d = 0; d < small_descriptors; ++d) {
        SmallWorld entry = at_place({s, place_.peer, d, place_.participant});
        found = found || term(entry);
      }
    }
    return found;
  }
  template <class Term>
  bool all_up_to(Term&& term) {
    return (set_of(term).bits | ~((2U << place_.descriptor) - 1)) == ~0U;
  }
  template <class Term>
  bool some_from_here(Term&& term) {
    return set_of(term).bits >> place_.descriptor != 0;
  }

  // Conditions and loops.
  template <class Body>
  void when(bool condition, Body&& body) {
    if (condition) body();
  }
  template <class Body>
  void for_readers_by_number(Body&& body) {
    for_readers(body);
  }
  template <class Body>
  void for_readers(Body&& body) {
    for (int peer = 0; peer < small_peers; ++peer) {
      SmallWorld r = *this;
      r.place_.peer = peer;
      if (r(typename Composition::IsOpen{})) body(r);
    }
  }
  template <class Body>
  void for_queue(Body&& body) {
    for (int s = 0; s < small_streams; ++s) {
      for (int d = 0; d < small_descriptors; ++d) {
        SmallWorld entry = at_place({s, place_.peer, d, place_.participant});
        if (entry(typename Composition::IsQueued{})) body(entry);
      }
    }
  }
  template <class Term, class Body>
  void for_descriptors(Term&& term, Body&& body) {
    each([&](SmallWorld& d) {
      d.subject_ = d.place_.descriptor;
      if (term(d)) body(d);
    });
  }
  /// Parts of one or more consecutive members.
  template <class Body>
  void partition(const Set& set, Body&& body) {
    Set part;
    each([&](SmallWorld& d) {
      if (d.is_in(set)) part.bits |= 1U << d.place_.descriptor;
      if (part.bits == 0 || draw(2) == 0) return;
      body(part);
      part = {};
    });
    if (part.bits != 0) body(part);
  }
  /// The other direction has places of its own.
  template <class Body>
  void reverse(Body&& body) {
    SmallWorld back = *this;
    back.place_.participant = 1 + place_.peer;
    body(back);
  }

  // Effects.
  template <class P, class E>
  auto feed(P, On<E>, const typename P::Machine::Io::template Input<Plain>& input = {}) {
    static Flyweight<typename P::Machine> machine;
    typename P::Machine::Io::template Output<Plain> out{};
    value<P>() = machine.template step<E>(static_cast<StateId>(value<P>()), input, out);
    return out;
  }
  template <class P, class E, class Input = decltype(no_input), class Who = decltype(everyone)>
  auto feed_each(P part, On<E> event, Input input = {}, Who who = {}) {
    typename P::Machine::Io::template Output<MemberDomain> total;
    each([&](SmallWorld& d) {
      if (!who(d)) return;
      const typename P::Machine::Io::template Input<Plain> in = input(d);
      const auto out = d.feed(part, event, in);
      [&]<std::size_t... I>(std::index_sequence<I...>) {
        (merge(boost::pfr::get<I>(total), boost::pfr::get<I>(out), d.place_.descriptor), ...);
      }
      (std::make_index_sequence<boost::pfr::tuple_size_v<decltype(total)>>{});
    });
    return total;
  }
  template <class V, class Value>
  void set(V, Value to) {
    value<V>() = static_cast<std::int64_t>(to);
  }
  template <class V, class Term>
  void set_each(V flag, Term&& term) {
    const Set set = set_of(term);
    each([&](SmallWorld& d) { d.set(flag, d.is_in(set)); });
  }
  template <class Wait, class T>
  void after(Wait wait, T) {
    start<T>((*this)(Now{}) + (*this)(wait));
  }
  template <class T>
  void at(std::int64_t due, T) {
    start<T>(due);
  }
  template <class T>
  void cancel(T) {
    const Key key{tag<T>(), place_.of(T::owner)};
    state_->pending[key] = 0;
    state_->surely_pending.erase(key);
    if (clock_ != nullptr) clock_->cancelled(key);
  }
  template <class P, class... Sayings>
  void emit(P, const std::tuple<Sayings...>& sayings) {
    SentPacket packet{tag<P>(), place_.of(P::owner), {}};
    for_each_type(typename P::Fields{}, [&]<class F>() { packet.says[tag<F>()] = 0; });
    std::apply([&](const auto&... each) { (say(packet, each), ...); }, sayings);
    state_->sent.insert(packet);
    if (clock_ != nullptr) clock_->sent(packet);
  }
  template <class O>
  void raise(O) {}
  template <class P, class... Args>
  void call(P, const Args&... args) {
    P::body(*this, args...);
  }
  template <class Step, class... Args>
  void perform(Step, const Args&... args) {
    Step::contract(*this, args...);
  }

  void receive(const SentPacket& packet) { packet_ = &packet; }
  /// The timer is due.
  template <class T>
  void due() {
    const Key key{tag<T>(), place_.of(T::owner)};
    --state_->pending[key];
    state_->surely_pending.erase(key);
  }
  template <class T>
  std::int64_t& value() {
    const Key key{tag<T>(), place_.of(T::owner)};
    return state_->values.try_emplace(key, first_value<T>()).first->second;
  }

 private:
  /// What a packet has no field for it does not say: 0.
  template <class Tag>
  [[nodiscard]] std::uint32_t said() const {
    const auto found = packet_->says.find(tag<Tag>());
    return found == packet_->says.end() ? 0 : found->second;
  }
  int draw(int count) { return static_cast<int>((*dice_)() % static_cast<std::uint64_t>(count)); }
  SmallWorld at_place(Place place) const {
    SmallWorld world = *this;
    world.place_ = place;
    world.subject_ = place.descriptor;
    return world;
  }
  template <class Body>
  void each(Body&& body) {
    for (int d = 0; d < small_descriptors; ++d) {
      SmallWorld world = *this;
      world.place_.descriptor = d;
      body(world);
    }
  }
  static void merge(Members& total, bool one, int descriptor) {
    if (one) total.bits |= 1U << descriptor;
  }
  static void merge(MemberDomain::Int&, std::int64_t, int) {}
  template <class T>
  void start(std::int64_t due) {
    const Key key{tag<T>(), place_.of(T::owner)};
    if (clock_ != nullptr) clock_->started(key, T::counted, due);
    ++state_->pending[key];
    state_->started.insert(key);
    state_->surely_pending.insert(key);
  }
  template <class F, class Value>
  void say(SentPacket& packet, const Says<F, Value>& saying) {
    if (!packet.says.contains(tag<F>())) return;
    if constexpr (std::is_same_v<Value, bool>) {
      packet.says[tag<F>()] = saying.value ? 1 : 0;
    } else if constexpr (std::derived_from<F, PacketNumber>) {
      packet.says[tag<F>()] = static_cast<std::uint32_t>(saying.value);
    } else {
      packet.says[tag<F>()] = set_of(saying.value).bits;
    }
  }

  SmallState* state_;
  const model::DdsProfile* dds_;
  Dice* dice_;
  SmallClock* clock_;
  Place place_;
  int subject_;
  const SentPacket* packet_ = nullptr;
};

/// Whether what is counted of a stream are always its first samples.
template <class Composition>
inline constexpr bool counts_first_samples = requires {
  typename Composition::FirstSamples;
};
/// How many samples of the writer exist.
inline int created(const SmallState& state, const Place& at) {
  int count = 0;
  while (count < small_descriptors) {
    const auto found =
        state.values.find({"Exists", Place{at.stream, at.peer, count}.of(owner::entry)});
    if (found == state.values.end() || found->second == 0) break;
    ++count;
  }
  return count;
}

/// Takes one step at random, if one that is drawn is possible: `visit(rule name, owner, place)` is
/// called after it.
template <class Composition, class Visit>
void random_step(SmallState& state, const model::DdsProfile& dds, std::mt19937_64& dice,
                 Visit&& visit) {
  using World = SmallWorld<Composition>;
  std::size_t chosen = dice() % Composition::Exchange::size;
  const auto index = [&](int count) {
    return static_cast<int>(dice() % static_cast<std::uint64_t>(count));
  };
  const Place place{index(small_streams), index(small_peers), index(small_descriptors)};
  for_each_type(typename Composition::Exchange{}, [&]<class R>() {
    if (chosen-- != 0) return;
    using Trigger = typename R::Trigger;
    using Cause = typename Trigger::Cause;
    Place at = place;
    SentPacket packet;
    if constexpr (std::is_same_v<Trigger, Received<Cause>> ||
                  std::is_same_v<Trigger, LeftSource<Cause>>) {
      std::vector<SentPacket> possible;
      for (const SentPacket& sent : state.sent) {
        if (sent.name == World::template tag<Cause>()) possible.push_back(sent);
      }
      if (possible.empty()) return;
      packet = possible[dice() % possible.size()];
      at = packet.place;
    }
    if constexpr (counts_first_samples<Composition> && Cause::owner == owner::entry) {
      at.descriptor = created(state, at);  // one after the other
      if (at.descriptor == small_descriptors) return;
    }
    World world{state, dds, dice, at};
    if constexpr (std::is_same_v<Trigger, Due<Cause>>) {
      if (state.pending[{World::template tag<Cause>(), at.of(Cause::owner)}] == 0) return;
      world.template due<Cause>();
    }
    world.receive(packet);
    R::run(world);
    visit(World::template tag<R>(), R::owner, at);
  });
}

}  // namespace stormproof::fsm::composition
