// What a run does because of a rule, as an observer sees it: machines move, events are scheduled,
// packets go out. A monitor collects them in order and holds them against what the rules say
// (props/monitors/followed.cpp). What the network does by itself is not among them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/probe.hpp"

namespace stormproof::props {

/// Descriptors of a stream, ascending; a few need no memory of their own.
using DescriptorList = boost::container::small_vector<std::uint32_t, 16>;
/// Of each descriptor of a stream, whether something is true of it.
using TruthList = boost::container::small_vector<bool, 128>;

/// A row fired; `descriptors` are the bits of word `first_word`, 0 if the machine has none.
struct Move {
  model::MachineRef machine;
  std::string_view event;
  std::string_view before;
  std::string_view after;
  std::uint32_t first_word = 0;
  std::uint64_t descriptors = 0;
};

/// An event was scheduled. Two are the same whatever their insertion numbers.
struct Scheduled {
  model::EventKind kind{};
  std::uint32_t subject = 0;
  model::Nanoseconds time;
  std::uint64_t insertion = 0;
};

/// What a Discovery Server relays, or is asked for; two are the same if they say the same.
struct RelayedContents {
  std::shared_ptr<const model::Relayed> of;

  bool operator==(const RelayedContents& other) const;
};

/// What a packet says, without its size. A record that stands for several packets is several. One
/// of Cyclone DDS has contents, which are about a writer of a participant each, and its size.
struct Message {
  model::PacketKind kind{};
  std::uint32_t pair = 0;  ///< of a multicast: the sending participant; control-only relations: 0;
                           ///< of a content: whose writer it is about
  model::Stream stream{};
  std::uint32_t loops_to = UINT32_MAX;  ///< a multicast that goes to a participant of its host
  DescriptorList descriptors;           ///< carried or listed
  std::uint32_t detail = 0;             ///< as in `Packet`, of contents, too
  bool initial = false;                 ///< ACKNACK marked initial
  bool repair = false;
  bool carries_heartbeat = false;
  bool to_nobody = false;
  bool to_group = false;  ///< a multicast with contents
  std::uint32_t bytes = 0;
  std::vector<Message> contents;
  std::uint32_t writer = 0;  ///< of a content: which one (model/cyclone/endpoints.hpp)
  std::int64_t count = 0;    ///< of a content that is a HEARTBEAT or ACKNACK
  bool directed = false;     ///< of a content: meant for its receiver alone
  RelayedContents relayed;

  bool operator==(const Message&) const = default;
  [[nodiscard]] std::uint32_t relation() const {
    return 2 * pair + static_cast<std::uint32_t>(stream);
  }
};
[[nodiscard]] Message message_of(const model::Packet& packet);

using Deed = std::variant<Move, Scheduled, Message>;

/// "acknack_generation of participant 0's pub stream at participant 1 is scheduled for 2 ms".
[[nodiscard]] std::string said(const Deed& deed, const model::Topology& topology);

/// In the order in which they were done.
class Deeds {
 public:
  template <class Kind>
  void add(Kind&& deed) {
    list_.emplace_back(std::forward<Kind>(deed));
  }
  void clear() {
    list_.clear();
    next_ = 0;
  }
  [[nodiscard]] bool empty() const { return next_ == list_.size(); }
  /// The next one but `skip`, or null.
  [[nodiscard]] const Deed* next(std::size_t skip = 0) const {
    return next_ + skip < list_.size() ? &list_[next_ + skip] : nullptr;
  }
  /// The same if it is a `Kind`, or null.
  template <class Kind>
  [[nodiscard]] const Kind* next(std::size_t skip = 0) const {
    return std::get_if<Kind>(next(skip));
  }
  void take() { ++next_; }

 private:
  std::vector<Deed> list_;
  std::size_t next_ = 0;
};

}  // namespace stormproof::props
