// What Fast DDS's rules (fsm/composition/fastdds.hpp) leave to a host, for a default participant's
// nine publications, of which the last ones may be created after the match, towards one reader.
// What is sent at once is one message. Piggybacked HEARTBEATs are left out, because they depend on
// everything that the participant sends.
#pragma once

#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/relation_world.hpp"

namespace stormproof::explorer {

class FastDdsPacking {
 public:
  using Composition = comp::fastdds::FastDds;
  using WriterOpens = comp::fastdds::WriterOpens;
  using State = fsm::TypeList<>;
  /// Publications of a default participant.
  static constexpr unsigned max_descriptors = 9;
  static constexpr bool receives_separately = true;
  static constexpr bool one_event_opens_both = false;
  static constexpr bool repairs_leave_later = false;

  FastDdsPacking(const model::Scenario& running, const Scope& scope)
      : pushed_{scope.pushed},
        largest_delay_{scope.largest_delay},
        distance_{creation_distance(running)} {}

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
    host.template run_rule<comp::Happens<comp::fastdds::Created>>(nullptr, d);
    if (pushed_ == 2 && d + 2 == max_descriptors) {
      host.frame().schedule({What::creation, 0, member(d + 1)}, distance_.count());
    }
  }

  static bool answer(comp::fastdds::CrossHost) { return true; }
  template <class W>
  static bool fact(comp::fastdds::QueueNotEmpty, W& w) {
    return w.host().state().template get<comp::fastdds::Enqueued>() != 0;
  }

  template <class W, class To>
  void perform(comp::fastdds::Pack, W& w, To) {
    auto& host = w.host();
    note_generated(host.state(), host.frame(), member(w.descriptor()), To::repairs);
    message_ |= member(w.descriptor());
  }
  template <class W, class To>
  static void perform(comp::fastdds::Charge, W&, To) {}
  template <class W, class To>
  void perform(comp::fastdds::Flush, W& w, To) {
    if (message_ == 0) return;
    note_left(w.host().frame(), message_);
    w.host().send({What::data, 0, std::exchange(message_, Members{0})});
  }
  template <class W>
  static void perform(comp::fastdds::Clock::SendBatch, W&) {}
  template <class W>
  static void perform(comp::control::OpenTopics, W&) {}

 private:
  const unsigned pushed_;
  const model::Nanoseconds largest_delay_;
  const model::Nanoseconds distance_;  ///< between two creations
  Members message_ = 0;                ///< that is open; between events none is
};

using FastDdsWorld = RelationWorld<FastDdsPacking>;
extern template class RelationWorld<FastDdsPacking>;

}  // namespace stormproof::explorer
