// Walks through the instants of a relation in their order. Receptions precede what is decided at
// their instant; apart from that, what was caused first comes first.
#include "checker/engines/timeline/relation_timeline.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "checker/engines/timeline/exchange.hpp"

namespace stormproof::timeline {
namespace {

using fsm::Plain;
using model::Nanoseconds;
using model::PacketKind;

Passage<Plain> passage_of(const Passing& passing) {
  return {passing.one_way.count(), passing.leaves_after.count(), passing.lost};
}

class Walk {
 public:
  Walk(const Setting& setting, const Director& director)
      : sedp_{setting.dds.sedp},
        director_{director},
        timers_{sedp_.heartbeat_response_delay.count(), sedp_.nack_response_delay.count(),
                sedp_.nack_suppression_duration.count()},
        limit_{setting.time_limit.count()} {
    if (sedp_.initial_data == model::InitialData::push) {
      deliver<Plain>(descriptor_, 0, passage_of(decide(PacketKind::data, data_++, 0)), true);
      last_ = 0;
    }
    send_heartbeat(0);
    const std::int64_t first = setting.phase.value_or(sedp_.heartbeat_period).count();
    at(first, decision, Kind::expiry);
    if (sedp_.initial_acknack_delay.count() > 0) {
      at(sedp_.initial_acknack_delay.count(), decision, Kind::attempt, 1);
    }
  }

  Prediction run() {
    while (!due_.empty() && std::get<0>(due_.begin()->first) <= limit_) {
      const auto [key, what] = *due_.begin();
      due_.erase(due_.begin());
      process(std::get<0>(key), what);
    }
    generate_until(limit_);
    Prediction prediction{std::nullopt, data_, heartbeats_, acknacks_, Nanoseconds{last_}};
    if (descriptor_.received && descriptor_.received_at <= limit_) {
      prediction.received = Nanoseconds{descriptor_.received_at};
    }
    return prediction;
  }

 private:
  enum class Kind : unsigned char { expiry, attempt, heartbeat, response, arrival };
  struct What {
    Kind kind{};
    std::int64_t factor = 0;  // of an attempt: its delay in units of τ_I
    Report<Plain> report;     // of an arrival
    bool initial = false;
  };
  static constexpr int reception = 0;
  static constexpr int decision = 1;

  void at(std::int64_t time, int rank, Kind kind, std::int64_t factor = 0) {
    due_[{time, rank, inserted_++}] = What{kind, factor, {}, false};
  }

  Passing decide(PacketKind kind, std::uint64_t ordinal, std::int64_t now,
                 bool initial = false) const {
    DirectedPacket packet;
    packet.kind = kind;
    packet.ordinal = static_cast<std::uint32_t>(ordinal);
    packet.initial_acknack = initial;
    packet.emitted = Nanoseconds{now};
    return director_(packet);
  }

  void process(std::int64_t now, const What& what) {
    switch (what.kind) {
      case Kind::expiry:
        if (descriptor_.acknowledged) return;
        send_heartbeat(now);
        at(now + sedp_.heartbeat_period.count(), decision, Kind::expiry);
        return;
      case Kind::attempt:
        if (seen_) return;
        send_acknack(now, true);
        attempt_again(now, what.factor);
        return;
      case Kind::heartbeat:
        seen_ = true;
        at(now + timers_.response, decision, Kind::response);
        return;
      case Kind::response:
        send_acknack(now, false);
        return;
      case Kind::arrival:
        arrive(now, what);
    }
  }

  void attempt_again(std::int64_t now, std::int64_t factor) {
    if (sedp_.initial_acknack_interval == model::InitialAckNackInterval::doubling) factor *= 2;
    at(now + factor * sedp_.initial_acknack_delay.count(), decision, Kind::attempt, factor);
  }

  void send_heartbeat(std::int64_t now) {
    const Passing passing = decide(PacketKind::heartbeat, heartbeats_++, now);
    if (!passing.lost) at(now + passing.one_way.count(), reception, Kind::heartbeat);
    last_ = std::max(last_, now);
  }

  void send_acknack(std::int64_t now, bool initial) {
    const Passing passing = decide(PacketKind::acknack, acknacks_++, now, initial);
    const std::int64_t arrives = now + passing.one_way.count();
    due_[{arrives, reception, inserted_++}] =
        What{Kind::arrival, 0, {now, arrives, passing.lost}, initial};
    last_ = std::max(last_, now);
  }

  void arrive(std::int64_t now, const What& what) {
    if (what.initial && sedp_.initial_acknack != model::InitialAckNackReply::bitmap) {
      if (!what.report.lost && sedp_.initial_acknack == model::InitialAckNackReply::heartbeat) {
        send_heartbeat(now);
      }
      return;
    }
    generate_until(now - 1);
    // The DATA that follows if this ACKNACK requests it.
    const Passing repair = decide(PacketKind::data, data_, now + timers_.nack);
    acknack<Plain>(descriptor_, what.report, passage_of(repair), timers_);
  }

  void generate_until(std::int64_t now) {
    if (!descriptor_.queued || descriptor_.repair_at > now) return;
    last_ = std::max(last_, descriptor_.repair_at);
    generate<Plain>(descriptor_, true);
    ++data_;
  }

  const model::SedpProfile& sedp_;
  const Director& director_;
  Timers<Plain> timers_;
  std::int64_t limit_;
  std::map<std::tuple<std::int64_t, int, std::uint64_t>, What> due_;
  std::uint64_t inserted_ = 0;
  Descriptor<Plain> descriptor_;
  bool seen_ = false;  // a HEARTBEAT, by the reader
  std::uint64_t data_ = 0;
  std::uint64_t heartbeats_ = 0;
  std::uint64_t acknacks_ = 0;
  std::int64_t last_ = 0;
};

}  // namespace

Prediction predict(const Setting& setting, const Director& director) {
  return Walk{setting, director}.run();
}

Prediction observe(const DirectedRun& run) {
  Prediction seen;
  seen.received = run.completion;
  seen.data = run.count(PacketKind::data);
  seen.heartbeats = run.count(PacketKind::heartbeat);
  seen.acknacks = run.count(PacketKind::acknack);
  for (const DirectedPacket& packet : run.packets) {
    seen.last_packet = std::max(seen.last_packet.value_or(packet.emitted), packet.emitted);
  }
  return seen;
}

}  // namespace stormproof::timeline
