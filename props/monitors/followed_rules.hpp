// The state of a run as the rules of a composition have it, and what all implementations leave to
// their hosts: how timers are cancelled, and how the silent readers of a cycle form batches. Their
// own steps are in followed_paper.cpp, followed_fastdds.hpp and followed_cyclone.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "fsm/adaptive_period.hpp"
#include "fsm/stepper.hpp"
#include "model/engine/composition_knobs.hpp"
#include "model/engine/timer_kinds.hpp"
#include "model/engine/writer_layout.hpp"
#include "model/life.hpp"
#include "props/monitors/followed_world.hpp"
#include "props/monitors/follower.hpp"
#include "props/monitors/received_descriptors.hpp"

namespace stormproof::props {

/// `Self` is the implementation's follower, the host of a FollowedWorld.
template <class Self, class Composition_>
class FollowedRules : public Follower {
 public:
  using Composition = Composition_;
  using World = FollowedWorld<Self>;

  FollowedRules(const model::Scenario& scenario, const model::Topology& topology,
                model::WriterLayout writers = {})
      : Follower{scenario, topology}, writers_{writers} {
    const std::uint32_t relations = writers_.stride * topology.pair_count();
    for (std::uint32_t relation = 0; relation < relations; ++relation) {
      const std::uint32_t pair = relation / writers_.stride;
      const std::uint32_t source = topology.pair(pair).source;
      places_.push_back({.participant = source,
                         .pair = pair,
                         .writer = writers_.stride * source + relation % writers_.stride,
                         .relation = relation});
    }
  }

  void due(const model::Event& event) override {
    comp::for_each_type(typename Composition::Timers{}, [&]<class T>() {
      if (event.kind != model::event_kind_of<T>) return;
      const std::uint32_t owner = self().owner_of(event);
      if (is_followed<T> && std::erase(pending_of(event.kind, owner), event.insertion()) == 0) {
        return;
      }
      run<comp::Due<T>>(place_of(T::owner, owner));
    });
  }

  void rescheduled(const model::Event& event, std::uint64_t insertion) override {
    std::ranges::replace(pending_of(event.kind, self().owner_of(event)), event.insertion(),
                         insertion);
  }

  // Places.
  [[nodiscard]] model::WriterLayout writers() const { return writers_; }
  [[nodiscard]] Place writer_place(std::uint32_t writer) const {
    return {.participant = writer / writers_.stride, .writer = writer};
  }
  [[nodiscard]] const Place& relation_place(std::uint32_t relation) const {
    return places_[relation];
  }
  /// The first relation of a pair stands for it.
  [[nodiscard]] Place pair_place(std::uint32_t pair) const {
    return relation_place(writers_.stride * pair);
  }
  [[nodiscard]] std::uint32_t descriptor_count(std::uint32_t writer) const {
    return topology_.descriptor_count(writer / 2, model::streams[writer % 2]);
  }
  /// The relations of a pair.
  [[nodiscard]] std::vector<std::uint32_t> streams_of(std::uint32_t pair) const {
    std::vector<std::uint32_t> relations(writers_.streams);
    std::iota(relations.begin(), relations.end(), writers_.stride * pair);
    return relations;
  }
  // How observers hear of owners.
  static constexpr model::MachineRef::Kind machine_kind(comp::Owner owner) {
    using enum model::MachineRef::Kind;
    if (owner == comp::owner::participant) return participant;
    if (owner == comp::owner::writer) return writer;
    return owner == comp::owner::control_relation ? control_relation : relation;
  }
  template <class P>
  [[nodiscard]] model::MachineRef machine_at(const Place& place) const {
    static constexpr std::string_view machine = fsm::name_of<typename P::Machine>();
    return {machine, Self::machine_kind(P::owner), place.number(P::owner)};
  }
  /// What an observer hears of it.
  template <class P>
  [[nodiscard]] Move move_at(const Place& place, std::string_view event,
                             const MovedTogether& moved) const {
    const auto& names = fsm::Reflect<typename P::Machine>::state_names;
    return {self().template machine_at<P>(place),
            event,
            names[moved.before],
            names[moved.after],
            moved.first_word,
            moved.descriptors};
  }
  [[nodiscard]] static std::uint32_t owner_of(const model::Event& event) { return event.subject; }
  template <class T>
  [[nodiscard]] static std::uint32_t subject_of(std::uint32_t owner) {
    return owner;
  }

  // State. What nobody has changed has its first value. The flags of a stream are bits.
  template <class V>
  [[nodiscard]] std::int64_t value(const Place& place) const {
    const auto& values = std::get<Values<V>>(values_).of;
    const std::size_t n = number_of<V>(place);
    if (n >= values.size()) return 0;
    if constexpr (is_bit<V>) return (values[n] >> place.descriptor % 64 & 1) != 0 ? 1 : 0;
    return static_cast<std::int64_t>(values[n]);
  }
  template <class V>
  void assign(const Place& place, std::int64_t to) {
    if (std::cmp_equal(value<V>(place), to)) return;
    const bool was = value<V>(place) != 0;
    if (!was && to != 0) self().becomes(V{}, place);
    auto& changed = at(std::get<Values<V>>(values_).of, number_of<V>(place), 0);
    if constexpr (is_bit<V>) {
      changed ^= std::uint64_t{1} << place.descriptor % 64;
    } else {
      changed = static_cast<ValueOf<V>>(to);
    }
    if (was && to == 0) self().ceases(V{}, place);
  }
  /// The flags of the place's stream are those of these descriptors.
  template <class V>
  void assign_each(Place place, const Descriptors& descriptors) {
    static_assert(is_bit<V>);
    const std::uint32_t count = self().descriptor_count(place.writer);
    for (place.descriptor = 0; place.descriptor < count;) {
      const std::uint32_t first = place.descriptor;
      const std::uint64_t wanted = descriptors.word(first / 64);
      const std::uint64_t now = at(std::get<Values<V>>(values_).of, number_of<V>(place), 0);
      std::uint64_t left = (now ^ wanted) & model::bits_below(count, first / 64);
      for (; left != 0; left &= left - 1) {
        place.descriptor = first + static_cast<std::uint32_t>(std::countr_zero(left));
        assign<V>(place, static_cast<std::int64_t>(wanted >> place.descriptor % 64 & 1));
      }
      place.descriptor = first + 64;
    }
  }
  /// A flag has been set for all descriptors of the place.
  template <class V>
  void all_are_set(V, const Place&) {}
  template <class P>
  fsm::StateId& state(const Place& place) {
    return at(std::get<States<P>>(states_).of, number_of<P>(place),
              fsm::Flyweight<typename P::Machine>::initial);
  }
  template <class P>
  [[nodiscard]] fsm::StateId state_at(const Place& place) const {
    const auto& states = std::get<States<P>>(states_).of;
    const std::size_t n = number_of<P>(place);
    return n < states.size() ? states[n] : fsm::Flyweight<typename P::Machine>::initial;
  }
  template <class P, class E>
  auto step(const Place& place, const typename P::Machine::Io::template Input<fsm::Plain>& input,
            fsm::RowId& row) {
    fsm::StateId& now = state<P>(place);
    return std::get<States<P>>(states_).machine.template step<E>(now, input, row);
  }
  /// Something that was false or 0 is no longer.
  template <class V>
  void becomes(V, const Place& place) {
    if constexpr (std::is_same_v<V, comp::X>) {
      ++received_[place.relation];
      if (self().is_required(place.pair)) --missing_;
    } else if constexpr (std::is_same_v<V, typename Composition::IsOpen>) {
      readers_[place.writer].push_back(place.relation);
      if (!Self::readers_in_order_of_match) std::ranges::sort(readers_[place.writer]);
    }
  }
  /// Something is false or 0 again. A side that closes loses its turn in the cycle of its writer.
  template <class V>
  void ceases(V, const Place& place) {
    if constexpr (std::is_same_v<V, comp::X>) {
      --received_[place.relation];
      if (self().is_required(place.pair)) ++missing_;
    } else if constexpr (std::is_same_v<V, typename Composition::IsOpen>) {
      std::erase(readers_[place.writer], place.relation);
      for (auto& batch : batches_[place.writer]) std::erase(batch, place.relation);
    }
  }
  /// Whether discovery is complete only if the pair's destination has everything of its source.
  [[nodiscard]] bool is_required(std::uint32_t pair) const {
    return topology_.pair(pair).cross_host;
  }
  /// The machines of the place are new ones; an observer is told of those that are in another state
  /// then, and that `Self` tells of.
  template <class P>
  void renew(World& w, comp::Site site) {
    constexpr fsm::StateId initial = fsm::Flyweight<typename P::Machine>::initial;
    constexpr std::string_view event = ReceivedDescriptors::renewed;
    if constexpr (is_of_descriptor(P::owner)) {
      MovedMachines moved;
      w.for_descriptors(comp::everyone, [&](World& one) {
        const fsm::StateId before = std::exchange(state<P>(one.place()), initial);
        if (Self::is_told(P{}, before != initial)) {
          moved.add(one.place().descriptor, before, initial);
        }
      });
      expect_moves<P>(w.place(), event, moved, site);
    } else {
      const fsm::StateId before = std::exchange(state<P>(w.place()), initial);
      if (!Self::is_told(P{}, before != initial)) return;
      expect(move_at<P>(w.place(), event, {before, initial}), site);
    }
  }
  /// The open relations of the writer.
  [[nodiscard]] const std::vector<std::uint32_t>& readers(std::uint32_t writer) {
    return readers_[writer];
  }
  /// The pairs of participant i with those whom it has recognised.
  [[nodiscard]] std::vector<std::uint32_t> known_peers(std::uint32_t i) {
    std::vector<std::uint32_t> pairs;
    for (std::uint32_t pair = topology_.first_pair(i); pair < topology_.first_pair(i + 1); ++pair) {
      const Place back{.pair = topology_.pair(pair).reverse};
      if (value<comp::Recognised>(back) != 0) pairs.push_back(pair);
    }
    return pairs;
  }

  /// What every HEARTBEAT and ACKNACK asks for is counted as descriptors come and go.
  [[nodiscard]] std::int64_t fact(comp::Missing, const World& w) const {
    return self().descriptor_count(w.place().writer) - received_[w.place().relation];
  }

  // Timers.
  [[nodiscard]] std::int64_t pending(model::EventKind kind, std::uint32_t owner) {
    return static_cast<std::int64_t>(pending_of(kind, owner).size());
  }
  void cancel(model::EventKind kind, std::uint32_t owner) { pending_of(kind, owner).clear(); }

  // What packets say, and what only a host knows. What one says of the first descriptors of a
  // stream is how many these are.
  static bool says(comp::Carries, const Message& message, std::uint32_t d) {
    return message.descriptors.has(d);
  }
  static bool says(comp::Listed, const Message& message, std::uint32_t d) {
    return message.descriptors.has(d);
  }
  static bool says(comp::BelowBase, const Message& message, std::uint32_t d) {
    return d < message.detail;
  }
  static bool says(comp::Announces, const Message& message, std::uint32_t d) {
    return d < message.detail;
  }
  static bool says(comp::CarriesHeartbeat, const Message& message) {
    return message.carries_heartbeat;
  }
  static bool says(comp::IsRepair, const Message& message) { return message.repair; }
  static bool says(comp::IsInitial, const Message& message) { return message.initial; }
  template <class Term>
  static void say(Message& message, World& w, const comp::Says<comp::Announces, Term>& announced) {
    message.detail = static_cast<std::uint32_t>(w.count(announced.value));
  }
  template <class Term>
  static void say(Message& message, World& w, const comp::Says<comp::BelowBase, Term>& confirmed) {
    message.detail = w.count_of_first(confirmed.value);
  }
  template <class Term>
  static void say(Message& message, World& w, const comp::Says<comp::Listed, Term>& listed) {
    message.descriptors = w.set_of(listed.value);
  }
  static void say(Message& message, World&, const comp::Says<comp::IsInitial, bool>& initial) {
    message.initial = initial.value;
  }
  template <class Knob>
  [[nodiscard]] auto knob(Knob knob) const {
    return model::knob_value(knob, dds());
  }
  std::int64_t answer(comp::Now, World&) const { return now_.count(); }
  bool answer(comp::RunEnds, World&) const { return run_ends(); }
  std::int64_t answer(comp::ContactedCount, World& w) {
    return std::ranges::count_if(readers(w.place().writer), [&](std::uint32_t relation) {
      return value<comp::Contacted>(relation_place(relation)) != 0;
    });
  }
  std::int64_t answer(comp::RespondedCount, World& w) {
    return std::ranges::count_if(readers(w.place().writer), [&](std::uint32_t relation) {
      return value<comp::Responded>(relation_place(relation)) != 0;
    });
  }

  // What the run must do next, by the effect at `site`.
  void looks_at(comp::Site site) { site_ = site; }
  void expect(const Move& wanted, comp::Site site) {
    site_ = site;
    next(wanted, [&](const Move& actual) { return same(actual, wanted); });
  }
  /// The moves of one event of the place's machines, in any order and in any parts; `moved` has
  /// none of them afterwards.
  template <class P>
  void expect_moves(const Place& place, std::string_view event, MovedMachines& moved,
                    comp::Site site) {
    site_ = site;
    while (!moved.list.empty() && !difference()) {
      const Move* actual = deeds_.next<Move>();
      const auto one = std::ranges::find_if(moved.list, [&](const MovedTogether& each) {
        return actual != nullptr && each.first_word == actual->first_word &&
               same_kind(*actual, move_at<P>(place, event, each));
      });
      const std::uint64_t both =
          one == moved.list.end() ? 0 : one->descriptors & actual->descriptors;
      const MovedTogether first = moved.least();
      if (both != 0) moved.remove(*one, both);
      if (both == 0 || both != actual->descriptors) {
        const MovedTogether left = moved.list.empty() ? first : moved.least();
        return differ(said(move_at<P>(place, event, left), topology_));
      }
      deeds_.take();
    }
  }
  /// What is scheduled, or null if the run did something else.
  const Scheduled* expect(const Scheduled& wanted, comp::Site site) {
    site_ = site;
    return next(wanted, [&](const Scheduled& it) {
      return it.kind == wanted.kind && it.subject == wanted.subject && it.time == wanted.time;
    });
  }
  template <class T>
  void expect_timer(T, std::uint32_t owner, model::Nanoseconds time, comp::Site site) {
    const Scheduled wanted{model::event_kind_of<T>, self().template subject_of<T>(owner), time};
    const Scheduled* actual = expect(wanted, site);
    if (is_followed<T> && actual != nullptr) {
      pending_of(wanted.kind, owner).push_back(actual->insertion);
    }
  }
  void expect(const Message& wanted, comp::Site site) {
    site_ = site;
    next(wanted, [&](const Message& actual) { return actual == wanted; });
  }
  template <class P, class... Sayings>
  void emit(P packet, World& w, const std::tuple<Sayings...>& sayings, comp::Site site) {
    Message message;
    message.kind = Self::kind_of(packet);
    if constexpr (P::owner == comp::owner::control_relation) {
      message.detail = w.place().control;
    } else {
      message.pair = w.place().pair;
      if (P::owner == comp::owner::relation) {
        message.stream = model::streams[w.place().relation % 2];
      }
    }
    std::apply([&](const auto&... each) { (Self::say(message, w, each), ...); }, sayings);
    expect(message, site);
  }

  // Opaque steps.
  void perform(comp::PlanBatches, World& w, std::int64_t period) {
    const std::uint32_t writer = w.place().writer;
    auto& batches = batches_[writer];
    batches.clear();
    const auto size = fsm::batch_size<fsm::Plain>({.contacted = w(comp::ContactedCount{}),
                                                   .responded = w(comp::RespondedCount{}),
                                                   .epsilon_num = w(comp::EpsilonNumerator{}),
                                                   .epsilon_den = w(comp::EpsilonDenominator{})});
    w.for_readers_by_number([&](World& r) {
      if (!r(comp::Contacted{}) || r(comp::Responded{})) return;
      if (batches.empty() || std::ssize(batches.back()) == size) batches.emplace_back();
      batches.back().push_back(r.place().relation);
    });
    const std::int64_t rest = period - w(comp::CyclePeriod{});
    const std::int64_t count = std::ssize(batches);
    for (std::int64_t k = 0; k < count; ++k)
      w.at(now_.count() + rest * k / count, comp::BatchDue{});
    std::ranges::reverse(batches);
  }

 protected:
  [[nodiscard]] bool run_ends() const {
    return missing_ == 0 && scenario_.run_until == model::RunUntil::completion && now_ >= settled_;
  }
  /// The endpoints of participant i are created when the deployment says; `note` is told of each.
  template <class Note>
  void take_creations(std::uint32_t i, Note&& note) {
    while (const auto* creation = deeds_.template next<Scheduled>()) {
      if (creation->kind != model::EventKind::endpoint_creation || creation->subject != i) break;
      note(*creation);
      deeds_.take();
    }
  }
  template <class Trigger>
  void run(const Place& place, const Message* heard = nullptr) {
    using Rule = comp::RuleFor<Composition, Trigger>;
    static constexpr std::string_view name = fsm::name_of<Rule>();
    begin(name);
    World w = world_at(place, heard);
    Rule::run(w);
  }
  [[nodiscard]] World world_at(const Place& place, const Message* heard = nullptr) {
    return {self(), place, heard};
  }
  [[nodiscard]] Place place_of(comp::Owner owner, std::uint32_t number) const {
    if (owner == comp::owner::participant) return {.participant = number};
    if (owner == comp::owner::pair) return pair_place(number);
    if (owner == comp::owner::writer) return self().writer_place(number);
    if (owner == comp::owner::control_relation) return {.control = number};
    return self().relation_place(number);
  }
  /// A HEARTBEAT to each reader of the next batch that still waits.
  template <class Rules>
  void send_batch(World& w) {
    auto& batches = batches_[w.place().writer];
    if (batches.empty()) return;
    const std::vector<std::uint32_t> batch = std::move(batches.back());
    batches.pop_back();
    for (const std::uint32_t relation : batch) {
      World r = w.at_relation(relation);
      if (r(typename Rules::Waits{})) Rules::heartbeat(r);
    }
  }
  /// Whether it matters which event of a timer is due: it is counted, or may be cancelled.
  template <class T>
  static constexpr bool is_followed = T::counted || Self::cancels_any_timer;
  [[nodiscard]] bool has_started(std::uint32_t participant) const {
    return now_ >= topology_.start(participant);
  }

  Self& self() { return static_cast<Self&>(*this); }
  const Self& self() const { return static_cast<const Self&>(*this); }

 private:
  /// A truth value or a number.
  template <class V>
  using ValueOf = std::conditional_t < requires {
    typename V::IsFlag;
  }
  , std::uint8_t, std::int64_t > ;
  static constexpr bool is_of_descriptor(comp::Owner owner) {
    return (owner.indices & comp::owner::descriptor_index) != 0;
  }
  /// A truth value of each descriptor of a stream: 64 of them are a word.
  template <class V>
  static constexpr bool is_bit =
      is_of_descriptor(V::owner) && std::is_same_v<ValueOf<V>, std::uint8_t>;
  template <class V>
  struct Values {
    std::vector<std::conditional_t<is_bit<V>, std::uint64_t, ValueOf<V>>> of;
  };
  template <class P>
  struct States {
    std::vector<fsm::StateId> of;
    fsm::Stepper<typename P::Machine> machine;
  };
  template <template <class> class Each, class... Ts>
  static std::tuple<Each<Ts>...> each_of(fsm::TypeList<Ts...>);

  /// Where the value or the machine of a place is; of descriptors, `place` says which.
  template <class T>
  [[nodiscard]] std::size_t number_of(const Place& place) const {
    const std::size_t n = place.number(T::owner);
    if constexpr (!is_of_descriptor(T::owner)) {
      return n;
    } else if constexpr (is_bit<T>) {
      return n * words_ + place.descriptor / 64;
    } else {
      return n * stride_ + place.descriptor;
    }
  }
  template <class T>
  static T& at(std::vector<T>& values, std::size_t n, std::type_identity_t<T> first) {
    if (n >= values.size()) [[unlikely]] {
      grow(values, n, first);
    }
    return values[n];
  }
  template <class T>
  [[gnu::noinline]] static void grow(std::vector<T>& values, std::size_t n, T first) {
    values.resize(n + 1, first);
  }
  std::vector<std::uint64_t>& pending_of(model::EventKind kind, std::uint32_t owner) {
    auto& owners = pending_[static_cast<std::size_t>(kind)];
    if (owner >= owners.size()) owners.resize(owner + 1);
    return owners[owner];
  }
  static bool same_kind(const Move& one, const Move& other) {
    return one.machine.subject == other.machine.subject && one.machine.kind == other.machine.kind &&
           same_text(one.before, other.before) && same_text(one.after, other.after) &&
           same_text(one.event, other.event) &&
           same_text(one.machine.machine, other.machine.machine);
  }
  /// Names are mostly the very same characters.
  static bool same_text(std::string_view one, std::string_view other) {
    return one.size() == other.size() && (one.data() == other.data() || one == other);
  }
  static bool same(const Move& one, const Move& other) {
    return one.descriptors == other.descriptors && one.first_word == other.first_word &&
           same_kind(one, other);
  }
  [[nodiscard]] std::size_t largest_stream() const {
    std::size_t largest = 1;
    for (std::uint32_t i = 0; i < topology_.participant_count(); ++i) {
      for (const model::Stream stream : model::streams) {
        largest = std::max<std::size_t>(largest, topology_.descriptor_count(i, stream));
      }
    }
    return largest;
  }

  using AllValues = decltype(each_of<Values>(typename Composition::State{}));
  using AllStates = decltype(each_of<States>(typename Composition::Parts{}));
  const model::WriterLayout writers_;
  std::vector<Place> places_;  // by relation
  AllValues values_;
  AllStates states_;
  const std::size_t stride_ = largest_stream();
  const std::size_t words_ = (stride_ + 63) / 64;
  std::vector<std::int64_t> received_ =  // how many descriptors, by relation
      std::vector<std::int64_t>(std::size_t{writers_.stride} * topology_.pair_count());
  const model::Nanoseconds settled_ = model::settled_at(scenario_.deployment);
  std::vector<std::vector<std::uint32_t>> readers_ =  // by writer
      std::vector<std::vector<std::uint32_t>>(std::size_t{writers_.stride} *
                                              topology_.participant_count());
  std::map<std::uint32_t, std::vector<std::vector<std::uint32_t>>> batches_;  // the last is next
  /// Insertion numbers, by kind and owner.
  std::array<std::vector<std::vector<std::uint64_t>>, model::event_kind_count> pending_;
};

}  // namespace stormproof::props
