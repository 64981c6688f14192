// What Cyclone DDS's writer sends because a reader asked, and no more of it than was asked for:
// safety.repair-only-if-asked: a sample goes out once when it is created, if somebody is matched
//   then, and otherwise at most once for each ACKNACK that listed it, whoever sent that: what two
//   ask for may go to all.
// storm.feedback-gain: a HEARTBEAT for one reader alone answers an ACKNACK of its own, which was
//   pre-emptive or asked for something.
#include <vector>

#include <fmt/core.h>

#include "props/monitors/describe.hpp"
#include "props/monitors/monitors.hpp"
#include "props/monitors/submessage_observer.hpp"

namespace stormproof::props {

namespace {

class RepeatedSamples : public SubmessageObserver<> {
 public:
  RepeatedSamples() : SubmessageObserver{"safety.repair-only-if-asked"} {}

  void run_started(const model::Topology& topology) override {
    SubmessageObserver::run_started(topology);
    writers_.assign(numbers().writer_count(), {});
  }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("{} samples were sent.", sent_)};
  }

 private:
  struct Writer {
    std::uint32_t readers = 0;  ///< that are matched
    /// How often it may still send the sample.
    std::uint64_t& left(std::uint32_t sample) {
      if (sample >= sendings.size()) sendings.resize(sample + 1);
      return sendings[sample];
    }
    std::vector<std::uint64_t> sendings;  ///< the same, by sample
  };

  void created(std::uint32_t writer, std::uint32_t sample) override {
    if (writers_[writer].readers > 0) ++writers_[writer].left(sample);
  }
  void matched(std::uint32_t relation) override {
    ++writers_[numbers().writer_of(relation)].readers;
  }
  void heard(std::uint32_t relation, const model::Submessage& acknack, const States&) override {
    if (acknack.kind != model::Submessage::Kind::acknack) return;
    Writer& writer = writers_[numbers().writer_of(relation)];
    acknack.bitmap.for_each([&](std::uint32_t sample) { ++writer.left(sample); });
  }
  void sent(const model::Packet&, const model::Submessage& data) override {
    if (data.kind != model::Submessage::Kind::data) return;
    std::uint64_t& left =
        writers_[numbers().stride() * data.participant + data.writer].left(data.sample);
    ++sent_;
    if (left > 0) {
      --left;
      return;
    }
    object_now(fmt::format(
        "At {} the writer of {} of participant {} sends sample {} more often than it was created "
        "and asked for.",
        time_text(now()), model::cyclone::name_of_writer(data.writer), data.participant,
        data.sample + 1));
  }

  std::vector<Writer> writers_;
  std::uint64_t sent_ = 0;
};

class DirectedHeartbeats : public SubmessageObserver<> {
 public:
  DirectedHeartbeats() : SubmessageObserver{"storm.feedback-gain"} {}

  void run_started(const model::Topology& topology) override {
    SubmessageObserver::run_started(topology);
    left_.assign(numbers().relation_count(), 0);
  }
  [[nodiscard]] std::vector<std::string> remarks() const override {
    return {fmt::format("{} HEARTBEATs answered an ACKNACK.", answered_)};
  }

 private:
  void heard(std::uint32_t relation, const model::Submessage& acknack, const States&) override {
    if (acknack.kind != model::Submessage::Kind::acknack) return;
    if (acknack.initial || !acknack.bitmap.empty()) ++left_[relation];
  }
  void sent(const model::Packet& packet, const model::Submessage& heartbeat) override {
    if (heartbeat.kind != model::Submessage::Kind::heartbeat || !heartbeat.directed) return;
    std::uint64_t& left = left_[relation_of(packet, heartbeat)];
    if (left > 0) {
      --left;
      ++answered_;
      return;
    }
    const model::Pair& ends = topology().pair(packet.pair);
    object_now(
        fmt::format("At {} the writer of {} of participant {} sends participant {} alone a "
                    "HEARTBEAT that answers no ACKNACK.",
                    time_text(now()), model::cyclone::name_of_writer(heartbeat.writer), ends.source,
                    ends.destination));
  }

  std::vector<std::uint64_t> left_;  // by relation: ACKNACKs that may be answered
  std::uint64_t answered_ = 0;
};

}  // namespace

MonitorPtr watch_repeated_samples() { return attentive<RepeatedSamples>(); }
MonitorPtr watch_directed_heartbeats() { return attentive<DirectedHeartbeats>(); }

}  // namespace stormproof::props
