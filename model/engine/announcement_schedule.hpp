// The SPDP announcement schedules of all participants: when the next announcement is due. What an
// announcement sends is the implementation's business.
#pragma once

#include <cstdint>
#include <vector>

#include "fsm/announcer.hpp"
#include "model/engine/driver.hpp"

namespace stormproof::model {

class AnnouncementSchedule {
 public:
  explicit AnnouncementSchedule(RunState& run)
      : run_{run}, announcers_(run.topology.participant_count()) {}

  /// Schedules announcement 0 of participant i.
  void start(std::uint32_t i) {
    run_.schedule(run_.topology.start(i), EventKind::announcement_due, i);
  }

  /// An announcement of participant i is due: calls `send`, then schedules the next one.
  template <class Send>
  void due(std::uint32_t i, Send&& send) {
    const SpdpProfile& spdp = run_.scenario.dds.spdp;
    Announcer& announcer = announcers_[i];
    const auto output = driver_.step<fsm::announcer::AnnouncementDue>(
        run_, announcer.state,
        {.now = run_.now.count(),
         .number = announcer.sent,
         .startup = spdp.startup_announcements,
         .startup_period = spdp.startup_period.count(),
         .period = spdp.period.count()},
        i);
    ++announcer.sent;
    if (!output.announce) return;  // only a mutated table stays silent
    send();
    run_.schedule(Nanoseconds{output.next_at}, EventKind::announcement_due, i);
  }

 private:
  struct Announcer {
    fsm::StateId state = fsm::Flyweight<fsm::Announcer>::initial;
    std::uint32_t sent = 0;
  };

  RunState& run_;
  std::vector<Announcer> announcers_;
  Driver<fsm::Announcer> driver_{run_, MachineRef::Kind::participant};
};

}  // namespace stormproof::model
