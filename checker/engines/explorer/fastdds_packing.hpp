// What Fast DDS's rules (fsm/composition/fastdds.hpp) leave to a host, for a default participant's
// nine publications, of which the last ones may be created after the match, and its eight
// subscriptions. What is sent at once by one writer to the same readers is one message, as long as
// there is room. Piggybacked HEARTBEATs are left out, because they depend on everything that the
// participant sends.
#pragma once

#include <bit>
#include <utility>

#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/relation_world.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::explorer {

class FastDdsPacking {
 public:
  using Composition = comp::fastdds::FastDds;
  using WriterOpens = comp::fastdds::WriterOpens;
  using State = fsm::TypeList<Announced>;
  /// The asynchronous queue, first in, first out: the numbers of its entries, plus 1, in groups of
  /// bits, the first in the lowest ones; what finds no room goes on in a second word. With one
  /// relation everything in it is sent at once.
  struct Queue : comp::Number<comp::owner::participant> {};
  struct QueueGoesOn : comp::Number<comp::owner::participant> {};
  template <unsigned readers, unsigned writers>
  using SharedState =
      std::conditional_t<(writers > 1), fsm::TypeList<Queue, QueueGoesOn>,
                         std::conditional_t<(readers > 1), fsm::TypeList<Queue>, fsm::TypeList<>>>;
  /// Publications of a default participant.
  static constexpr unsigned max_descriptors = model::fastdds::default_publications;
  static constexpr bool receives_separately = true;
  static constexpr bool one_event_opens_both = false;
  static constexpr bool repairs_leave_later = false;
  static constexpr bool lists_what_is_announced = true;

  FastDdsPacking(const model::Scenario& running, const Scope& scope)
      : pushed_{scope.pushed},
        largest_delay_{scope.largest_delay},
        distance_{creation_distance(running)},
        limit_bytes_{running.dds.sedp.grouping_limit_bytes.count()} {}

  [[nodiscard]] static constexpr unsigned descriptors(model::Stream stream) {
    return stream == model::Stream::pub ? max_descriptors : model::fastdds::default_subscriptions;
  }

  template <class Host>
  void start(Host& host) const {
    const unsigned created = max_descriptors - pushed_;
    host.state().template set<comp::fastdds::Exists>(member(created) - 1);
    if constexpr (Host::writer_count > 1) {
      host.state().template set<comp::fastdds::Exists>(member(descriptors(model::Stream::sub)) - 1,
                                                       1);
    }
    if (pushed_ == 0) return;
    // Two creations keep their distance, so their order is certain.
    host.frame().schedule_between({What::creation, 0, member(created)}, 0,
                                  (pushed_ == 1 ? largest_delay_ : distance_).count());
  }
  template <class Host>
  void create(Host& host, const Slot& slot) const {
    const auto d = static_cast<unsigned>(std::countr_zero(slot.set));
    host.template run_rule<comp::Happens<comp::fastdds::Created>>(slot, d);
    if (pushed_ == 2 && d + 2 == max_descriptors) {
      host.frame().schedule({What::creation, 0, member(d + 1)}, distance_.count());
    }
  }

  static bool answer(comp::fastdds::CrossHost) { return true; }
  template <class W>
  static bool fact(comp::fastdds::QueueNotEmpty, W& w) {
    if constexpr (W::Host::relation_count > 1) return w.host().state().template get<Queue>() != 0;
    return w.host().state().template get<comp::fastdds::Enqueued>() != 0;
  }
  template <class W>
  static void perform(comp::fastdds::Enqueue step, W& w, const model::DescriptorSet& set) {
    using Host = typename W::Host;
    if constexpr (Host::relation_count > 1) {
      auto& state = w.host().state();
      const unsigned relation = Host::template relation_at<comp::owner::writer>(w);
      const Members enqueued = state.template get<comp::fastdds::Enqueued>(relation);
      set.for_each([&](std::uint32_t d) {
        if ((enqueued & member(d)) != 0) return;
        append<Entries<Host>>(state, relation % Host::writer_count * max_descriptors + d + 1);
      });
    }
    step.contract(w, set);
  }
  template <class Host, class Visit>
  static void for_queue(Host& host, Visit&& visit) {
    using Each = Entries<Host>;
    auto& state = host.state();
    while (const std::int64_t queue = state.template get<Queue>()) {
      std::int64_t left = queue >> Each::bits;
      if constexpr (Each::several_words) {
        const std::int64_t rest = state.template get<QueueGoesOn>();
        left |= (rest & Each::mask) << (Each::in_a_word - 1) * Each::bits;
        state.template set<QueueGoesOn>(rest >> Each::bits);
      }
      state.template set<Queue>(left);
      const auto entry = static_cast<std::uint32_t>((queue & Each::mask) - 1);
      visit(entry / max_descriptors, entry % max_descriptors);
    }
  }

  template <class W, class To>
  void perform(comp::fastdds::Pack, W& w, To) {
    auto& host = w.host();
    const Members it = member(w.descriptor());
    unsigned served = 0;
    w.for_readers([&](auto& r) {
      if (To::serves(r)) served |= 1U << host.relation_at(r);
    });
    const model::Stream stream = model::streams[w.template number<comp::owner::writer>()];
    const std::int64_t added =
        model::fastdds::timestamp_bytes + model::fastdds::submessage_bytes(stream, w.descriptor());
    const bool fits = served == served_ && (message_ & it) == 0 && bytes_ + added <= limit_bytes_;
    if (message_ != 0 && !fits) flush(host);
    if (message_ == 0) {
      bytes_ = model::fastdds::message_header_bytes +
               (std::has_single_bit(served) ? model::fastdds::destination_bytes : 0);
    }
    served_ = served;
    message_ |= it;
    bytes_ += added;
    for_each_served([&](unsigned relation) {
      note_generated(host.state(), host.frame(), relation, it, To::repairs);
    });
  }
  template <class W, class To>
  static void perform(comp::fastdds::Charge, W&, To) {}
  template <class W, class To>
  void perform(comp::fastdds::Flush, W& w, To) {
    if (message_ != 0) flush(w.host());
  }
  template <class W>
  static void perform(comp::fastdds::Clock::SendBatch, W&) {}
  template <class W>
  static void perform(comp::control::OpenTopics, W&) {}

 private:
  /// How the queue is kept.
  template <class Host>
  struct Entries {
    static constexpr unsigned most = max_descriptors * Host::writer_count;
    static constexpr unsigned bits = std::bit_width(most);
    static constexpr std::int64_t mask = (1U << bits) - 1;
    static constexpr unsigned in_a_word = 63 / bits;
    static constexpr bool several_words = most > in_a_word;
    static_assert(most <= 2 * in_a_word);
  };
  template <class Each, class State>
  static void append(State& state, std::int64_t entry) {
    const auto count = [](std::int64_t word) {
      const auto used = static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(word)));
      return (used + Each::bits - 1) / Each::bits;
    };
    const std::int64_t queue = state.template get<Queue>();
    const unsigned end = count(queue);
    if constexpr (Each::several_words) {
      if (end == Each::in_a_word) {
        const std::int64_t rest = state.template get<QueueGoesOn>();
        state.template set<QueueGoesOn>(rest | entry << count(rest) * Each::bits);
        return;
      }
    }
    state.template set<Queue>(queue | entry << end * Each::bits);
  }

  template <class Visit>
  void for_each_served(Visit&& visit) const {
    for (unsigned left = served_; left != 0; left &= left - 1) {
      visit(static_cast<unsigned>(std::countr_zero(left)));
    }
  }
  template <class Host>
  void flush(Host& host) {
    const Members members = std::exchange(message_, Members{0});
    for_each_served([&](unsigned relation) {
      note_left(host.frame(), relation, members);
      host.send({What::data, 0, members, 0, static_cast<std::uint8_t>(relation)});
    });
  }

  const unsigned pushed_;
  const model::Nanoseconds largest_delay_;
  const model::Nanoseconds distance_;  ///< between two creations
  const std::int64_t limit_bytes_;     ///< of a message
  // The message that is open; between events none is.
  Members message_ = 0;     ///< what it carries
  unsigned served_ = 0;     ///< in which relations it goes, one bit each
  std::int64_t bytes_ = 0;  ///< UDP payload so far
};

using FastDdsWorld = RelationWorld<FastDdsPacking>;
using SharedFastDdsWorld = RelationWorld<FastDdsPacking, 2>;
extern template class RelationWorld<FastDdsPacking>;
extern template class RelationWorld<FastDdsPacking, 2>;
extern template class RelationWorld<FastDdsPacking, most_readers>;
extern template class RelationWorld<FastDdsPacking, 1, most_writers>;

}  // namespace stormproof::explorer
