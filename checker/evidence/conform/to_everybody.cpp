// Looks for the first message for requests after each match. A reader on the own host is matched,
// too: the HEARTBEAT that opens that relation is one that the capture does not show, so that a
// number is missing among the counts.
#include "checker/evidence/conform/to_everybody.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace stormproof::conform {

namespace {

/// One writer of the participant.
class Matches {
 public:
  explicit Matches(std::set<std::uint32_t> counts) : counts_{std::move(counts)} {}

  void follow(const Message& message) {
    for (const std::size_t relation : message.relations) {
      if (open_.insert(relation).second) match_ns_ = message.time_ns;
    }
    for (const MessagePart& part : message.parts) count_ = std::max(count_, part.count);
  }

  /// Whether a reader may have been matched while `message`, which carries DATA for requests, was
  /// under way; the message after it is another.
  [[nodiscard]] bool take_match(const Message& message, bool has_neighbour,
                                std::int64_t most_send_lag_ns) {
    const auto match_ns = std::exchange(match_ns_, std::nullopt);
    const bool is_to_all =
        message.relations.size() == open_.size() && (message.relations.size() > 1 || has_neighbour);
    const bool is_soon = match_ns && message.time_ns - *match_ns <= most_send_lag_ns;
    return is_to_all && (is_soon || (has_neighbour && take_hidden_match()));
  }

 private:
  [[nodiscard]] bool take_hidden_match() {
    const bool is_missing = !counts_.empty() && count_ + 1 < *counts_.rbegin() &&
                            !counts_.contains(count_ + 1) && hidden_ != count_ + 1;
    if (is_missing) hidden_ = count_ + 1;
    return is_missing;
  }

  std::set<std::uint32_t> counts_;         ///< of all its HEARTBEATs
  std::set<std::size_t> open_;             ///< relations
  std::optional<std::int64_t> match_ns_;   ///< the last, if no message followed
  std::uint32_t count_ = 0;                ///< highest so far
  std::optional<std::uint32_t> hidden_{};  ///< the missing one that has been taken for a match
};

}  // namespace

std::set<std::size_t> sent_to_everybody(const Dialogue& dialogue,
                                        const std::vector<Message>& messages,
                                        const Bounds& bounds) {
  std::map<capture::EntityId, std::set<std::uint32_t>> counts;
  for (const Message& message : messages) {
    for (const MessagePart& part : message.parts) {
      if (!part.descriptor) counts[message.writer].insert(part.count);
    }
  }
  std::map<capture::EntityId, Matches> writers;
  std::set<std::size_t> events;
  for (const Message& message : messages) {
    Matches& writer = writers.try_emplace(message.writer, counts[message.writer]).first->second;
    writer.follow(message);
    if (!message.has_data() || message.is_pushed) continue;
    const std::size_t source = dialogue.relations[message.relations.front()].place.source;
    if (!writer.take_match(message, dialogue.has_neighbour[source], bounds.most_send_lag_ns)) {
      continue;
    }
    for (const std::size_t first : message.first_event) {
      for (const MessagePart& part : message.parts) {
        if (part.descriptor) events.insert(first + (part.event - message.parts.front().event));
      }
    }
  }
  return events;
}

}  // namespace stormproof::conform
