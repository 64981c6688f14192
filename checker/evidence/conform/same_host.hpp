// What a participant can have sent on its own host, of which a capture between hosts shows nothing.
// Nothing is lost there, and everything comes within a bound: soon after the last endpoint was
// created and the last participant of the host was announced the exchange is over, and from then on
// the own host causes nothing. Until then it is bounded, too: a reader there answers a HEARTBEAT at
// most once and asks for each descriptor at most once in an answer; and what is sent uses up the
// piggyback budget, so that HEARTBEATs to everybody come of it, which the capture does show. The
// counts of a writer's HEARTBEATs say how many there were, whomever they went to.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "checker/evidence/conform/bounds.hpp"
#include "checker/evidence/conform/dialogue.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::conform {

class SameHost {
 public:
  SameHost(const Dialogue& dialogue, std::size_t participant, const model::DdsProfile& dds,
           const Bounds& bounds);

  /// Whether readers on the own host can be the reason of anything at this instant.
  [[nodiscard]] bool is_active(std::int64_t time_ns) const {
    return readers_ > 0 && time_ns <= until_ns_;
  }

  /// The writer of this stream sent a HEARTBEAT; `captured_bytes`: how many bytes the participant
  /// has sent to other hosts for requests, at least.
  void heartbeat(std::size_t stream, std::uint32_t count, std::int64_t captured_bytes);
  /// What the participant can have sent to its own host until now, at most.
  [[nodiscard]] std::int64_t most_sent_bytes() const;

  /// How much DATA of the stream's writer uses up what is left of a budget, if each is charged
  /// `before` (above 0 only if the rule is cumulative) and its own bytes; nothing: so much cannot
  /// have been sent until then, beside what is supposed already. `count`: of the HEARTBEAT that
  /// comes of it.
  [[nodiscard]] std::optional<std::int64_t> needed(std::size_t stream, std::uint32_t count,
                                                   std::int64_t time_ns, std::int64_t left,
                                                   std::int64_t before) const;
  void suppose(std::size_t stream, std::int64_t data) { streams_[stream].supposed += data; }

 private:
  /// Of one writer.
  struct Stream {
    std::int64_t descriptors = 0;
    std::int64_t count = 0;       ///< the highest of its HEARTBEATs
    std::int64_t asked = 0;       ///< DATA that can have been asked for, or pushed
    std::int64_t supposed = 0;    ///< of these, those that explain something
    std::int64_t sent = 0;        ///< DATA that can have been sent before its last HEARTBEAT
    std::int64_t in_between = 0;  ///< and since
  };
  /// How many DATA can come between two HEARTBEATs of a writer.
  [[nodiscard]] std::int64_t most_in_between(std::int64_t captured_bytes) const;

  bool is_cumulative_;
  std::int64_t threshold_;
  std::int64_t largest_message_;  ///< with one descriptor
  std::int64_t most_unflushed_;   ///< of a group: what its open message holds does not count yet
  std::int64_t readers_ = 0;
  std::int64_t until_ns_ = 0;  ///< the exchange is over
  std::array<Stream, 2> streams_{};
};

}  // namespace stormproof::conform
