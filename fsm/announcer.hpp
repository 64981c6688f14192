// The SPDP announcement schedule of one participant: announcement 0 when it starts, a number of
// startup announcements at a short period, then one every τ_P for ever.
#pragma once

#include "fsm/front_end.hpp"

namespace stormproof::fsm {

struct AnnouncerIo {
  template <class D>
  struct Input {
    typename D::Int now{};             ///< ns
    typename D::Int number{};          ///< number k of this announcement, from 0
    typename D::Int startup{};         ///< how many startup announcements follow announcement 0
    typename D::Int startup_period{};  ///< ns
    typename D::Int period{};          ///< τ_P, ns
  };
  template <class D>
  struct Output {
    typename D::Bool
        announce{};  ///< send the announcement to the multicast group and all known participants
    typename D::Int next_at{};  ///< when announcement k+1 is due, ns
  };
};

namespace announcer {

struct Starting : State {};
struct Periodic : State {};

struct AnnouncementDue : Event<AnnouncerIo> {};

struct InStartup : Guard<InStartup> {
  template <class D>
  static constexpr typename D::Bool test(const AnnouncerIo::Input<D>& in) {
    return in.number < in.startup;
  }
};

struct AnnounceSoonAgain : Action<AnnounceSoonAgain> {
  template <class D>
  static constexpr void act(const AnnouncerIo::Input<D>& in, AnnouncerIo::Output<D>& out) {
    out.announce = true;
    out.next_at = in.now + in.startup_period;
  }
};
struct AnnouncePeriodically : Action<AnnouncePeriodically> {
  template <class D>
  static constexpr void act(const AnnouncerIo::Input<D>& in, AnnouncerIo::Output<D>& out) {
    out.announce = true;
    out.next_at = in.now + in.period;
  }
};

using Transitions =
    Table<Row<Starting, AnnouncementDue, Starting, AnnounceSoonAgain, InStartup>,
          Row<Starting, AnnouncementDue, Periodic, AnnouncePeriodically, Not<InStartup>>,
          Row<Periodic, AnnouncementDue, Periodic, AnnouncePeriodically>>;

}  // namespace announcer

struct Announcer : FrontEnd<Announcer> {
  using Io = AnnouncerIo;
  using initial_state = announcer::Starting;
  using transition_table = announcer::Transitions;
};

}  // namespace stormproof::fsm
