// What the event threads of Cyclone DDS's participants have to do (specs/guide/cyclone.md, "The
// event thread"): lists of timers, queues of messages, the packets that are being filled and sent;
// and the messages: what they carry, where they go, how much they weigh. When something is done the
// rules say (model/cyclone/thread_steps.hpp).
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "model/cyclone/endpoints.hpp"
#include "model/cyclone/life_samples.hpp"
#include "model/cyclone/packer.hpp"
#include "model/engine/run_state.hpp"
#include "model/engine/submessage.hpp"
#include "model/engine/writer_layout.hpp"

namespace stormproof::model::cyclone {

class EventThreads {
 public:
  using Number = std::uint32_t;

  explicit EventThreads(const RunState& run);

  [[nodiscard]] WriterLayout writer_layout() const { return {stride_, writer::first_topic}; }
  [[nodiscard]] Number samples_of(Number w) const;
  /// Relations, ascending.
  [[nodiscard]] const std::vector<Number>& readers(Number w) const { return writers_[w].readers; }

 protected:
  enum class TimerKind : std::uint8_t {
    acknack,
    heartbeat,
    announcement,
    reply,
    liveliness,
    address
  };
  struct DueTimer {
    TimerKind kind{};
    Number owner = 0;
  };
  struct KeptAnswer {
    Number relation = 0;
    Message message;
  };
  struct Thread {
    explicit Thread(const SedpProfile& sedp) : packer{sedp} {}

    std::deque<DueTimer> list;
    std::deque<Message> given;  ///< what the timer that fires gives
    std::deque<Message> queue;
    std::uint32_t queued_repairs = 0;
    Packer packer;
    // What is being sent.
    std::shared_ptr<const std::vector<Submessage>> contents;
    std::deque<Number> left;  ///< addresses that it has not been sent to
    std::int64_t bytes = 0;
    std::optional<KeptAnswer> kept;
  };

  void match(Number relation);
  void unmatch(Number relation);
  [[nodiscard]] Destination readers_of(Number writer) const;
  /// Whether participant i sends to the group what goes to several that say they are in it, and
  /// says so itself.
  [[nodiscard]] bool has_group(Number i) const {
    return steps_of_.profiles.of(i).allow_multicast == AllowMulticast::always;
  }

  // Messages, without their destinations.
  [[nodiscard]] Message heartbeat(Number writer, Number announced, std::int64_t count,
                                  bool directed) const;
  [[nodiscard]] Message gap(Number relation, DescriptorSet&& samples) const;
  [[nodiscard]] Message data(Number writer, Number sample) const;
  [[nodiscard]] Message announcement(Number i) const;
  /// `known`: of how many samples its reader knows; the bitmap ends at the last of them.
  [[nodiscard]] Message acknack(Number relation, Submessage&& content, Number known) const;

  // The queue, in which some messages are retransmissions of a sample for a relation.
  void enqueue(Number i, Message&& message);
  /// The first message of the queue is given; false if there is none.
  static bool take_queued(Thread& thread);
  [[nodiscard]] bool is_queued(Number relation, Number sample, bool for_it) const;
  void send_to_all_instead(Number relation, Number sample);
  void let_answer_go(Number i);
  /// The packet that is filled is to be sent.
  void begin_to_send(Thread& thread) const;

  [[nodiscard]] const Pair& ends_of(Number relation) const {
    return steps_of_.topology.pair(relation / stride_);
  }
  [[nodiscard]] Number writer_of(Number relation) const {
    return stride_ * ends_of(relation).source + relation % stride_;
  }
  [[nodiscard]] static Number end_of(const DescriptorSet& set) {
    return set.empty() ? 0 : set.highest() + 1;
  }

  const RunState& steps_of_;
  const LifeSamples samples_;
  const Number stride_;  ///< writers of each participant
  std::vector<Thread> threads_;

 private:
  struct Writer {
    std::vector<Number> readers;
    std::uint64_t version = 0;  ///< how many matches there have been
  };
  [[nodiscard]] static Message message(Submessage&& content, Number owner, Number slot,
                                       std::int64_t bytes);
  [[nodiscard]] bool repeats(const Message& queued, Number relation, Number sample) const {
    return queued.retransmission && queued.content.sample == sample &&
           queued.content.writer == relation % stride_;
  }

  std::vector<Writer> writers_;  // stride · participant + writer
};

/// The builtin writer of the descriptors of a stream, and the other way around.
[[nodiscard]] inline std::uint32_t slot_of(Stream s) {
  return s == Stream::pub ? writer::publications : writer::subscriptions;
}
[[nodiscard]] inline Stream stream_of(std::uint32_t slot) {
  return slot == writer::publications ? Stream::pub : Stream::sub;
}

[[nodiscard]] inline Stream other(Stream s) { return s == Stream::pub ? Stream::sub : Stream::pub; }

}  // namespace stormproof::model::cyclone
