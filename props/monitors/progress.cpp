// timer.progress: time goes on. A clock that is set again for the instant in which it is due fires
// without end, and nothing after that instant ever happens. Receptions and the channel are no
// clocks: of them there are as many as packets.
#include <map>
#include <utility>

#include <fmt/core.h>

#include "model/trace/event_subject.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/instants.hpp"
#include "props/monitors/monitors.hpp"

namespace stormproof::props {

namespace {

class Progress : public InstantObserver {
 public:
  Progress() : InstantObserver{"timer.progress"} {}

  [[nodiscard]] std::vector<std::string> assumptions() const override {
    return {fmt::format("a timer that fires more than {} times in one instant is taken to go on so",
                        most)};
  }

 private:
  static constexpr std::uint64_t most = Instants::most;

  /// Most instants have few events: in none that has not so many can a clock have fired so often.
  void crowded(const model::Event& event) override {
    using model::trace::Subject;
    const Subject subject = model::trace::subject_of(event.kind);
    if (subject == Subject::channel || subject == Subject::packet) return;
    if (std::exchange(instant_, event.time) != event.time) fired_.clear();
    if (++fired_[{event.kind, event.subject}] <= most) return;
    object_now(
        fmt::format("A timer fires more than {} times at {}: it is set again for the instant "
                    "in which it is due.",
                    most, time_text(now())));
  }

  model::Nanoseconds instant_;  ///< in which these have fired
  std::map<std::pair<model::EventKind, std::uint32_t>, std::uint64_t> fired_;
};

}  // namespace

MonitorPtr watch_progress(const model::Scenario&) { return attentive<Progress>(); }

}  // namespace stormproof::props
