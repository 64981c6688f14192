// The events of the channel in the simulator's order: at one instant the end of a service comes
// first, then requests, then the choice of the next frame.
#include "tests/live/access_point/half_duplex_channel.hpp"

#include <algorithm>
#include <utility>

namespace stormproof::live {

namespace {

std::size_t index_of(Direction direction) { return static_cast<std::size_t>(direction); }
std::size_t index_of(Cast cast) { return static_cast<std::size_t>(cast); }

/// Who goes first among frames that wait since the same instant; the least rank does.
int rank_of(model::ServiceOrder order, Direction direction) {
  if (order == model::ServiceOrder::fifo) return 0;
  const int number = static_cast<int>(direction);
  return order == model::ServiceOrder::fifo_downlink ? -number : number;
}

}  // namespace

HalfDuplexChannel::HalfDuplexChannel(const model::WirelessProfile& wireless,
                                     const QueueLimits& limits, const Losses& losses,
                                     std::uint32_t stations)
    : link_overhead_bytes_{wireless.link_overhead_bytes.count()},
      limits_{limits},
      losses_{losses},
      random_{losses.seed} {
  if (wireless.service == model::ServedBy::unit) {
    units_.emplace(wireless, stations);
    return;
  }
  for (const Direction direction : {Direction::uplink, Direction::downlink}) {
    const model::Stage& stage = wireless.stages[index_of(direction)];
    waiting_.add_stage(rank_of(wireless.order, direction));
    for (const Cast cast : {Cast::unicast, Cast::multicast}) {
      rate_[index_of(direction)][index_of(cast)] =
          model::MemoizedRate{model::service_rate(wireless, stage, cast == Cast::multicast)};
    }
  }
}

std::optional<std::uint32_t> HalfDuplexChannel::request(Nanoseconds now, const Frame& frame) {
  run_until(now, false);
  now_ = now;
  ChannelStatistics::Station& station = statistics_.stations[frame.station];
  ++station.frames;
  station.bytes += frame.bytes;
  std::uint64_t& queued = station_queue_[frame.station];
  if (limits_.station && queued >= *limits_.station) {
    ++station.dropped;
    return std::nullopt;
  }
  station.deepest_queue = std::max(station.deepest_queue, ++queued);
  const std::uint32_t name = frames_.take();
  frames_[name] = frame;
  wait_for(Direction::uplink, name);
  settle_drops();
  return name;
}

void HalfDuplexChannel::advance(Nanoseconds now) {
  run_until(now, true);
  now_ = std::max(now_, now);
}

std::optional<Nanoseconds> HalfDuplexChannel::next_event() const {
  if (serving_) return serving_->end;
  return dispatch_;
}

std::vector<Service> HalfDuplexChannel::take_services() {
  for (const Service& service : ended_) {
    if (service.outcome != ServiceEnd::forwarded) frames_.give_back(service.frame);
  }
  return std::exchange(ended_, {});
}

/// A dispatch at `now` itself is left for later unless `dispatch_now`: others may still request.
void HalfDuplexChannel::run_until(Nanoseconds now, bool dispatch_now) {
  while (true) {
    if (serving_ && serving_->end <= now) {
      finish();
    } else if (dispatch_ && (*dispatch_ < now || (dispatch_now && *dispatch_ == now))) {
      now_ = *dispatch_;
      dispatch_.reset();
      step<fsm::channel::DispatchDue>();
    } else {
      return;
    }
  }
}

template <class Event>
void HalfDuplexChannel::step() {
  fsm::Flyweight<fsm::Channel>::Output output{};
  state_ = machine_.step<Event>(
      state_, {.waiting = waiting() > 0, .dispatch_pending = dispatch_.has_value()}, output);
  if (output.schedule_dispatch) dispatch_ = now_;
  if (output.serve) serve();
}

void HalfDuplexChannel::wait_for(Direction direction, std::uint32_t name) {
  const std::uint64_t request = next_request_++;
  if (!units_) {
    waiting_.push(static_cast<std::uint32_t>(direction), {now_, request, name, 0});
  } else {
    const Frame& frame = frames_[name];
    const model::Frame asked{request, name, 0, bytes_on_air(frame), now_};
    if (direction == Direction::uplink) {
      units_->request_uplink(frame.station, asked, frame.flow);
    } else {
      const bool to_all = frame.cast == Cast::multicast;
      units_->request_downlink(to_all ? model::Flow::everybody : frame.to(), asked, frame.flow);
    }
  }
  statistics_.deepest_queue = std::max<std::uint64_t>(statistics_.deepest_queue, waiting());
  step<fsm::channel::ServiceRequested>();
}

/// What the queues of the profile have dropped is over.
void HalfDuplexChannel::settle_drops() {
  if (!units_) return;
  while (const auto dropped = units_->next_dropped()) {
    const std::uint32_t name = dropped->frame.slot;
    const Frame& frame = frames_[name];
    const bool is_down = dropped->access_point.has_value();
    --(is_down ? downlink_queue_ : station_queue_[frame.station]);
    ++(is_down ? statistics_.dropped_downlink : statistics_.stations[frame.station].dropped);
    ended_.push_back({name, frame.station, is_down ? Direction::downlink : Direction::uplink, now_,
                      now_, ServiceEnd::dropped, frame.receiver});
  }
}

void HalfDuplexChannel::serve() {
  serving_ = units_ ? choose_unit() : choose_frame();
  for (const std::uint32_t name : serving_->frames) {
    --(serving_->direction == Direction::uplink ? station_queue_[frames_[name].station]
                                                : downlink_queue_);
  }
  settle_drops();
}

HalfDuplexChannel::InService HalfDuplexChannel::choose_frame() {
  model::ServiceRequest request;
  const std::uint32_t position = waiting_.pop(request);
  const Frame& frame = frames_[request.slot];
  const std::int64_t airtime_ns =
      rate_[position][index_of(frame.cast)].airtime_ns(bytes_on_air(frame));
  return {{request.slot}, static_cast<Direction>(position), now_, now_ + Nanoseconds{airtime_ns}};
}

HalfDuplexChannel::InService HalfDuplexChannel::choose_unit() {
  const model::Unit unit = units_->take(now_);
  InService chosen{{},
                   unit.downlink ? Direction::downlink : Direction::uplink,
                   now_,
                   now_ + Nanoseconds{unit.duration_ns}};
  for (const model::Frame& frame : unit.frames) chosen.frames.push_back(frame.slot);
  return chosen;
}

void HalfDuplexChannel::finish() {
  const InService served = *std::exchange(serving_, std::nullopt);
  now_ = served.end;
  step<fsm::channel::ServiceFinished>();

  // What they share, a unit's frames are of one kind.
  const Cast cast = frames_[served.frames.front()].cast;
  auto& sum = statistics_.served[index_of(served.direction)][index_of(cast)];
  sum.busy += served.end - served.start;
  for (const std::uint32_t name : served.frames) {
    const Frame frame = frames_[name];
    ++sum.frames;
    sum.bytes += frame.bytes;
    const ServiceEnd outcome =
        served.direction == Direction::uplink ? after_uplink(name) : after_downlink();
    ended_.push_back({name, frame.station, served.direction, served.start, served.end, outcome,
                      frame.cast == Cast::multicast ? std::nullopt : frame.receiver});
  }
  settle_drops();
  step<fsm::channel::EffectsDone>();
}

ServiceEnd HalfDuplexChannel::after_uplink(std::uint32_t frame) {
  if (limits_.downlink && downlink_queue_ >= *limits_.downlink) {
    ++statistics_.dropped_downlink;
    return ServiceEnd::dropped;
  }
  statistics_.deepest_downlink_queue =
      std::max(statistics_.deepest_downlink_queue, ++downlink_queue_);
  wait_for(Direction::downlink, frame);
  return ServiceEnd::forwarded;
}

ServiceEnd HalfDuplexChannel::after_downlink() {
  // 53 random bits make a number from [0, 1) that is the same with every standard library.
  const bool lost = losses_.probability > 0 &&
                    static_cast<double>(random_() >> 11U) * 0x1p-53 < losses_.probability;
  ++(lost ? statistics_.lost : statistics_.delivered);
  return lost ? ServiceEnd::lost : ServiceEnd::delivered;
}

}  // namespace stormproof::live
