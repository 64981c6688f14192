// Each lost repair is asked for as late as possible by the first HEARTBEAT that its predecessor
// does not spoil, leaves its source as late as possible, and every further HEARTBEAT within W of
// that first one is answered while the repair is requested, queued or suppressed.
#include "checker/engines/timeline/completion_witness.hpp"

#include <algorithm>

namespace stormproof::timeline {
namespace {

using model::Nanoseconds;
using model::PacketKind;

class WorstCase {
 public:
  WorstCase(const model::SedpProfile& sedp, const Circumstances& c, unsigned losses)
      : sedp_{sedp},
        delta_{c.delta},
        source_{c.source.value_or(c.delta)},
        least_{c.least},
        losses_{losses} {
    model::DdsProfile dds;
    dds.sedp = sedp;
    const auto bound = completion_bound(dds, c);
    const bool pull = sedp.initial_data == model::InitialData::pull;
    const unsigned lost_repairs = pull ? losses : std::max(losses, 1U) - 1;
    Nanoseconds start;
    for (unsigned k = 0; k < lost_repairs && bound; ++k) {
      starts_.push_back(start);
      const Nanoseconds first = c.timer_starts_with_relation
                                    ? bound->further_loss
                                    : bound->window + sedp.heartbeat_period;
      start += k == 0 ? first : bound->further_loss;
    }
    if (bound) window_ = bound->window;
  }

  Passing operator()(const DirectedPacket& packet) const {
    switch (packet.kind) {
      case PacketKind::data:
        return {delta_, source_, packet.ordinal < losses_};
      case PacketKind::heartbeat:
        return {least_ + std::min(spread(packet.emitted), slack()), Nanoseconds{0}, false};
      default:
        // Emitted when a HEARTBEAT sent then, and not delayed, would have been answered.
        return {least_ + std::min(spread(packet.emitted - sedp_.heartbeat_response_delay - least_),
                                  slack()),
                Nanoseconds{0}, false};
    }
  }

 private:
  /// Start of the window that holds the instant t (an instant of HEARTBEATs), if one does.
  [[nodiscard]] const Nanoseconds* window_of(Nanoseconds t) const {
    const auto found =
        std::ranges::find_if(starts_, [&](Nanoseconds start) { return t <= start + window_; });
    return found == starts_.end() ? nullptr : &*found;
  }
  [[nodiscard]] Nanoseconds slack() const { return delta_ - least_; }
  /// How much longer than necessary the exchange of a HEARTBEAT emitted at t is under way: its
  /// ACKNACK arrives with that of the first one in the window, or as soon as it can.
  [[nodiscard]] Nanoseconds spread(Nanoseconds t) const {
    const Nanoseconds* const start = window_of(t);
    if (start == nullptr) return slack() * 2;
    return std::max(Nanoseconds{0}, *start + slack() * 2 - t);
  }

  model::SedpProfile sedp_;
  Nanoseconds delta_;
  Nanoseconds source_;
  Nanoseconds least_;
  unsigned losses_;
  Nanoseconds window_;
  std::vector<Nanoseconds> starts_;  // of the windows: their first HEARTBEATs
};

}  // namespace

Director worst_completion(const model::SedpProfile& sedp, const Circumstances& circumstances,
                          unsigned losses) {
  return WorstCase{sedp, circumstances, losses};
}

Nanoseconds worst_phase(const model::SedpProfile& sedp, const Circumstances& circumstances) {
  model::DdsProfile dds;
  dds.sedp = sedp;
  const auto bound = completion_bound(dds, circumstances);
  if (!bound) return sedp.heartbeat_period;
  return bound->window - sedp.heartbeat_period * bound->spoilt;
}

bool is_attained(const model::SedpProfile& sedp, Nanoseconds delta) {
  const bool asks_first = sedp.initial_acknack != model::InitialAckNackReply::none &&
                          sedp.initial_acknack_delay > Nanoseconds{0} &&
                          sedp.initial_acknack_delay < delta;
  const bool at_once = sedp.relation_opening == model::RelationOpening::receiver ||
                       sedp.unmatched == model::Unmatched::accept;
  return !asks_first && at_once;
}

}  // namespace stormproof::timeline
