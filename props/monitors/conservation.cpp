// safety.conservation: what a source has admitted is the demand of the packets that were admitted
// and have not left it, never more than W except for one packet alone; a channel never idles while
// a fragment waits for it, once all events of an instant are processed; no packet is admitted twice
// or lost between the backlog and its reception; a channel serves one fragment at a time
// (specs/guide/model.md, "Packets, fragments, queue, channel"). With `constant_delay` there is
// neither queue nor channel, so nothing can break. Who listens but is not ready yet receives later.
//
// Packets are admitted in the order of their emission, so the length of a backlog tells which ones.
#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "model/airtime.hpp"
#include "model/engine/chunk_queue.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/instants.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/number_map.hpp"

namespace stormproof::props {

namespace {

class Conservation : public InstantObserver {
 public:
  explicit Conservation(const model::Scenario& scenario)
      : InstantObserver{"safety.conservation"},
        participants_{scenario.deployment.participants},
        fragmentation_{scenario.wireless},
        capacity_{scenario.wireless.source_queue_bytes.count()},
        stages_{static_cast<std::uint32_t>(scenario.wireless.stages.size())},
        shared_{scenario.wireless.kind == model::ServiceKind::shared_channel},
        by_unit_{scenario.wireless.service == model::ServedBy::unit} {}

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    sources_.resize(topology.participant_count());
  }
  void finish(model::Nanoseconds end) override {
    if (end > instants().now()) over(instants().now(), end);
  }

  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t>) override {
    if (!shared_) return;
    const std::int64_t fragments = fragmentation_.count(packet.payload_bytes);
    Emitted& emitted = sources_[source].backlog.push_back();
    emitted.number = packet.number;
    emitted.copies = packet.copies;
    emitted.demand = fragmentation_.demand(packet.payload_bytes, fragments);
    emitted.fragments = static_cast<std::uint32_t>(fragments);
    sources_[source].waiting += packet.copies;
  }
  void backlog_changed(std::uint32_t participant, std::uint64_t packets,
                       std::int64_t admitted_bytes) override {
    Source& source = sources_[participant];
    if (packets > source.waiting) {
      object_now(
          fmt::format("At {} the backlog of participant {} holds {} packets, of {} that "
                      "were emitted and not admitted.",
                      time_text(now()), participant, packets, source.waiting));
      return;
    }
    while (source.waiting > packets) admit(participant, source);
    if (admitted_bytes != source.admitted_bytes) {
      object_now(
          fmt::format("At {} the queue of participant {} holds {} bytes, but the packets "
                      "that are admitted and have not left it make {}.",
                      time_text(now()), participant, admitted_bytes, source.admitted_bytes));
    }
    peak_ = std::max(peak_, admitted_bytes);
    if (admitted_bytes > capacity_ && source.admitted_packets > 1) {
      object_now(fmt::format(
          "At {} the queue of participant {} holds {} bytes in {} packets; it "
          "has room for {} bytes.",
          time_text(now()), participant, admitted_bytes, source.admitted_packets, capacity_));
    }
  }
  void service_started(std::uint32_t channel, std::uint32_t stage, const model::Packet& packet,
                       std::uint32_t fragment, model::Nanoseconds until) override {
    ChannelUse& use = channel_at(channel);
    const bool same_unit = by_unit_ && use.busy_since == now() && use.busy_until == until;
    if (now() < use.busy_until && !same_unit) {
      object_now(
          fmt::format("At {} channel {} serves packet {}, though its last service ends at {}.",
                      time_text(now()), channel, packet.number, time_text(use.busy_until)));
    }
    use.busy_since = now();
    use.busy_until = until;
    look_when_needed();
    Admitted* const found = admitted_.find(packet.number);
    if (found == nullptr) {
      object_now(
          fmt::format("At {} fragment {} of packet {} is served in stage {}, though the "
                      "packet is not in the queue.",
                      time_text(now()), fragment, packet.number, stage));
      return;
    }
    Admitted& flight = *found;
    ++flight.served;
    if (stage == 0) ++flight.served_at_source;
    if (flight.served > flight.fragments * stages_ || flight.served_at_source > flight.fragments) {
      object_now(fmt::format("At {} a fragment of packet {} is served a second time in a stage.",
                             time_text(now()), packet.number));
    }
  }
  void waiting_changed(std::uint32_t channel, std::uint64_t fragments) override {
    ChannelUse& use = channel_at(channel);
    if (fragments > 0 && use.waiting == 0) look_beyond(use.busy_until);
    use.waiting = fragments;
  }
  void source_completed(const model::Packet& packet) override {
    if (!shared_) return;
    Admitted* const found = admitted_.find(packet.number);
    if (found == nullptr || found->has_left()) {
      object_now(fmt::format("At {} packet {} leaves its source without being in the queue.",
                             time_text(now()), packet.number));
      return;
    }
    Admitted& flight = *found;
    if (flight.served_at_source < flight.fragments) {
      object_now(fmt::format("At {} packet {} leaves its source with {} of {} fragments served.",
                             time_text(now()), packet.number, flight.served_at_source,
                             flight.fragments));
    }
    Source& source = sources_[std::exchange(flight.source, nobody)];
    source.admitted_bytes -= fragmentation_.demand(packet.payload_bytes, flight.fragments);
    --source.admitted_packets;
  }
  void arrived(const model::Packet& packet, bool lost) override {
    if (!shared_) return;
    if (!lost && !packet.to_nobody && is_received_now(packet)) {
      to_be_received_.push_back(packet.number);
      look_beyond(now());
    }
    const Admitted* const found = admitted_.find(packet.number);
    if (found == nullptr || !found->has_left() || found->served != found->fragments * stages_) {
      object_now(fmt::format("At {} packet {} arrives without having had all its services.",
                             time_text(now()), packet.number));
    }
    admitted_.remove(packet.number);
  }

  void received(const model::Packet& packet, std::uint32_t) override {
    if (to_be_received_.empty()) return;
    std::erase(to_be_received_, packet.number);
    if (to_be_received_.empty()) look_when_needed();
  }

  [[nodiscard]] std::vector<std::string> remarks() const override {
    if (!shared_) return {"With constant_delay there is no queue and no channel."};
    return {fmt::format("A source queue held at most {} bytes.", peak_)};
  }

 private:
  /// Packets of consecutive numbers in a backlog.
  struct Emitted {
    std::uint64_t number;
    std::int64_t demand;
    std::uint32_t copies;
    std::uint32_t fragments;
  };
  struct Source {
    model::ChunkQueue<Emitted> backlog;
    std::uint64_t waiting = 0;  // copies in the backlog
    std::int64_t admitted_bytes = 0;
    std::uint64_t admitted_packets = 0;
  };
  static constexpr std::uint32_t nobody = UINT32_MAX;
  /// As many wait as the queues hold: it is small.
  struct Admitted {
    std::uint32_t source = nobody;  // in whose queue it is
    std::uint32_t fragments = 0;
    std::uint32_t served = 0;  // over all stages
    std::uint32_t served_at_source = 0;

    [[nodiscard]] bool has_left() const { return source == nobody; }
  };
  struct ChannelUse {
    model::Nanoseconds busy_since;
    model::Nanoseconds busy_until;
    std::uint64_t waiting = 0;
  };

  /// Whether it reaches somebody who is not busy starting.
  [[nodiscard]] bool is_received_now(const model::Packet& packet) const {
    const auto is_free = [&](std::uint32_t pair) {
      const std::uint32_t receiver =
          packet.to_writer() ? topology().pair(pair).source : topology().pair(pair).destination;
      if (receiver >= participants_.size()) return true;  // a server, which is always ready
      const model::Participant& p = participants_[receiver];
      return now() < p.open.value_or(p.start) || now() >= p.ready.value_or(p.start);
    };
    if (!packet.multicast()) return is_free(packet.pair);
    for (std::uint32_t pair = topology().first_pair(packet.pair);
         pair < topology().first_pair(packet.pair + 1); ++pair) {
      if (topology().pair(pair).cross_host && is_free(pair)) return true;
    }
    return topology().peer_count(packet.pair) == 0;
  }

  void admit(std::uint32_t participant, Source& source) {
    Emitted& head = source.backlog.front();
    if (Admitted* const flight = admitted_.add(head.number)) {
      flight->source = participant;
      flight->fragments = head.fragments;
      flight->served = 0;
      flight->served_at_source = 0;
    } else {
      object_now(
          fmt::format("At {} packet {} is admitted a second time.", time_text(now()), head.number));
    }
    source.admitted_bytes += head.demand;
    ++source.admitted_packets;
    --source.waiting;
    ++head.number;
    if (--head.copies == 0) source.backlog.pop_front();
  }

  ChannelUse& channel_at(std::uint32_t channel) {
    if (channel >= channels_.size()) channels_.resize(channel + 1);
    return channels_[channel];
  }

  /// The end of the first instant after that is looked at.
  void look_beyond(model::Nanoseconds time) {
    horizon_ = std::min(horizon_, time);
    wait_beyond(horizon_);
  }
  /// The end of this one if somebody has to receive; of others if a channel does not serve then.
  void look_when_needed() {
    horizon_ = to_be_received_.empty() ? Instants::never : now();
    for (const ChannelUse& channel : channels_) {
      if (channel.waiting > 0) horizon_ = std::min(horizon_, channel.busy_until);
    }
    wait_beyond(horizon_);
  }
  /// Nothing happens between `from`, whose events are all processed, and `to`.
  void over(model::Nanoseconds from, model::Nanoseconds to) override {
    if (!to_be_received_.empty()) {
      object_now(fmt::format("Packet {} had its last service at {}, but nobody receives it then.",
                             to_be_received_.front(), time_text(from)));
    }
    for (std::uint32_t c = 0; c < channels_.size(); ++c) {
      const ChannelUse& channel = channels_[c];
      if (channel.waiting == 0 || channel.busy_until >= to) continue;
      object_now(fmt::format("From {} to {} channel {} idles while {} fragments wait for it.",
                             time_text(std::max(from, channel.busy_until)), time_text(to), c,
                             channel.waiting));
    }
    look_when_needed();
  }

  const std::vector<model::Participant> participants_;
  model::Fragmentation fragmentation_;
  std::int64_t capacity_;
  std::uint32_t stages_;
  bool shared_;
  bool by_unit_;  // the frames of a unit are served together
  std::vector<Source> sources_;
  std::vector<ChannelUse> channels_;
  NumberMap<Admitted> admitted_;               // by packet number
  std::vector<std::uint64_t> to_be_received_;  // arrived in this instant
  std::int64_t peak_ = 0;
  model::Nanoseconds horizon_ = Instants::never;
};

}  // namespace

MonitorPtr watch_conservation(const model::Scenario& scenario) {
  return attentive<Conservation>(scenario);
}

}  // namespace stormproof::props
