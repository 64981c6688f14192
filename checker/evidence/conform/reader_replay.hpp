// Replays what was chosen for the ACKNACKs of one relation through the reader's rules and machines
// (reader_host.hpp), which decide whether they send just these.
#pragma once

#include <memory>

#include "checker/evidence/conform/reader_side.hpp"
#include "checker/evidence/conform/replayed.hpp"
#include "checker/evidence/conform/reply_search.hpp"

namespace stormproof::conform {

class ReaderReplay {
 public:
  ReaderReplay(const Context& context, const Relation& relation, Ledger& ledger);

  /// The reader side opens. Returns the delay until the first initial ACKNACK, ns; 0: there is
  /// none.
  std::int64_t open(std::int64_t now);
  /// An initial ACKNACK is sent. Returns the delay until the next one, ns; 0: there is none.
  std::int64_t attempt(const Answer& answer);
  /// The chosen submessages arrive, in order, and the reply is generated.
  void reply(const Answer& answer, const Choice& choice);
  /// The attempt that finds that a HEARTBEAT was seen.
  void finish();

  [[nodiscard]] bool is_open() const { return is_open_; }
  [[nodiscard]] std::int64_t opened_ns() const { return opened_ns_; }
  /// Submessages that have arrived or are lost.
  [[nodiscard]] std::size_t consumed() const { return consumed_; }
  [[nodiscard]] const Knowledge& knowledge() const { return knowledge_; }

 private:
  void confirm(bool replayed, Rule rule);
  void miss(const Submessage& message);
  void receive(const Submessage& message, std::int64_t now);
  [[nodiscard]] bool is_captured(const std::optional<MadeAckNack>& said,
                                 const Answer& answer) const;

  const Relation& relation_;
  const Bounds& bounds_;
  Ledger& ledger_;
  std::unique_ptr<ReplayedReader> host_;

  bool is_open_ = false;
  std::int64_t opened_ns_ = 0;
  std::optional<std::uint32_t> missed_;  ///< the last datagram that did not arrive
  std::size_t consumed_ = 0;
  Knowledge knowledge_{};
  std::int64_t last_reception_ns_ = INT64_MIN / 2;
  std::int64_t last_reply_ns_ = INT64_MIN / 2;
};

}  // namespace stormproof::conform
