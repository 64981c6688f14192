// What Fast DDS's rules (fsm/composition/fastdds.hpp) leave to a host, for a default participant's
// nine publications, of which the last ones may be created after the match. What is sent at once
// to the same readers is one message, as long as there is room. Piggybacked HEARTBEATs are left
// out, because they depend on everything that the participant sends.
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
  using State = fsm::TypeList<>;
  /// The asynchronous queue, first in, first out: the numbers of its entries, plus 1, in groups of
  /// bits, the first in the lowest ones. With one reader everything in it is sent at once.
  struct Queue : comp::Number<comp::owner::participant> {};
  using SharedState = fsm::TypeList<Queue>;
  /// Publications of a default participant.
  static constexpr unsigned max_descriptors = model::fastdds::default_publications;
  static constexpr bool receives_separately = true;
  static constexpr bool one_event_opens_both = false;
  static constexpr bool repairs_leave_later = false;

  FastDdsPacking(const model::Scenario& running, const Scope& scope)
      : pushed_{scope.pushed},
        largest_delay_{scope.largest_delay},
        distance_{creation_distance(running)},
        limit_bytes_{running.dds.sedp.grouping_limit_bytes.count()} {}

  [[nodiscard]] static constexpr unsigned descriptors() { return max_descriptors; }

  template <class Host>
  void start(Host& host) const {
    const unsigned created = max_descriptors - pushed_;
    host.state().template set<comp::fastdds::Exists>(member(created) - 1);
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
    if constexpr (W::Host::reader_count > 1) return w.host().state().template get<Queue>() != 0;
    return w.host().state().template get<comp::fastdds::Enqueued>() != 0;
  }
  template <class W>
  static void perform(comp::fastdds::Enqueue step, W& w, const model::DescriptorSet& set) {
    if constexpr (W::Host::reader_count > 1) {
      auto& state = w.host().state();
      const Members enqueued = state.template get<comp::fastdds::Enqueued>();
      set.for_each([&](std::uint32_t d) {
        if ((enqueued & member(d)) != 0) return;
        const std::int64_t queue = state.template get<Queue>();
        const auto used = static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(queue)));
        const unsigned end = (used + entry_bits - 1) / entry_bits * entry_bits;
        state.template set<Queue>(queue | std::int64_t{d + 1} << end);
      });
    }
    step.contract(w, set);
  }
  template <class Host, class Visit>
  static void for_queue(Host& host, Visit&& visit) {
    auto& state = host.state();
    while (const std::int64_t queue = state.template get<Queue>()) {
      state.template set<Queue>(queue >> entry_bits);
      visit(0, static_cast<std::uint32_t>((queue & entry_mask) - 1));
    }
  }

  template <class W, class To>
  void perform(comp::fastdds::Pack, W& w, To) {
    auto& host = w.host();
    const Members it = member(w.descriptor());
    unsigned served = 0;
    w.for_readers([&](auto& r) {
      if (To::serves(r)) served |= 1U << host.reader_at(r);
    });
    const std::int64_t added = model::fastdds::timestamp_bytes +
                               model::fastdds::submessage_bytes(model::Stream::pub, w.descriptor());
    const bool fits = served == served_ && (message_ & it) == 0 && bytes_ + added <= limit_bytes_;
    if (message_ != 0 && !fits) flush(host);
    if (message_ == 0) {
      bytes_ = model::fastdds::message_header_bytes +
               (std::has_single_bit(served) ? model::fastdds::destination_bytes : 0);
    }
    served_ = served;
    message_ |= it;
    bytes_ += added;
    for_each_served([&](unsigned reader) {
      note_generated(host.state(), host.frame(), reader, it, To::repairs);
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
  static constexpr unsigned entry_bits = 4;
  static constexpr std::int64_t entry_mask = (1U << entry_bits) - 1;
  static_assert(max_descriptors <= entry_mask);

  template <class Visit>
  void for_each_served(Visit&& visit) const {
    for (unsigned left = served_; left != 0; left &= left - 1) {
      visit(static_cast<unsigned>(std::countr_zero(left)));
    }
  }
  template <class Host>
  void flush(Host& host) {
    const Members members = std::exchange(message_, Members{0});
    for_each_served([&](unsigned reader) {
      note_left(host.frame(), reader, members);
      host.send({What::data, 0, members, 0, static_cast<std::uint8_t>(reader)});
    });
  }

  const unsigned pushed_;
  const model::Nanoseconds largest_delay_;
  const model::Nanoseconds distance_;  ///< between two creations
  const std::int64_t limit_bytes_;     ///< of a message
  // The message that is open; between events none is.
  Members message_ = 0;     ///< what it carries
  unsigned served_ = 0;     ///< to which readers it goes, one bit each
  std::int64_t bytes_ = 0;  ///< UDP payload so far
};

using FastDdsWorld = RelationWorld<FastDdsPacking>;
using SharedFastDdsWorld = RelationWorld<FastDdsPacking, 2>;
extern template class RelationWorld<FastDdsPacking>;
extern template class RelationWorld<FastDdsPacking, 2>;
extern template class RelationWorld<FastDdsPacking, most_readers>;

}  // namespace stormproof::explorer
