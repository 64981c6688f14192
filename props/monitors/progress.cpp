// timer.progress: time goes on. A clock that is set again for the instant in which it is due fires
// without end, and nothing after that instant ever happens. Receptions and the channel are no
// clocks: of them there are as many as packets.
#include <map>
#include <utility>

#include <fmt/core.h>

#include "model/trace/event_subject.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::props {

namespace {

class Progress : public Observer {
 public:
  static constexpr bool reads_clock = true;

  Progress() : Observer{"timer.progress"} {}

  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    if (event.time != instant_) {
      if (count_ > most) fired_.clear();
      count_ = 0;
      instant_ = event.time;
    }
    // Most instants have few events: no clock can have fired so often.
    if (++count_ <= most) return;
    using model::trace::Subject;
    const Subject subject = model::trace::subject_of(event.kind);
    if (subject == Subject::channel || subject == Subject::packet) return;
    if (++fired_[{event.kind, event.subject}] <= most) return;
    object_now(
        fmt::format("A timer fires more than {} times at {}: it is set again for the instant "
                    "in which it is due.",
                    most, time_text(now())));
  }
  [[nodiscard]] std::vector<std::string> assumptions() const override {
    return {fmt::format("a timer that fires more than {} times in one instant is taken to go on so",
                        most)};
  }

 private:
  static constexpr std::uint64_t most = 10'000;
  model::Nanoseconds instant_;
  std::uint64_t count_ = 0;  ///< events of this instant
  std::map<std::pair<model::EventKind, std::uint32_t>, std::uint64_t> fired_;
};

}  // namespace

MonitorPtr watch_progress(const model::Scenario&) { return attentive<Progress>(); }

}  // namespace stormproof::props
