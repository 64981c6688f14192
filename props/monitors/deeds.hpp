// What a run does because of a rule, as an observer sees it: machines move, events are scheduled,
// packets go out. A monitor collects them in order and holds them against what the rules say
// (props/monitors/followed.cpp). What the network does by itself is not among them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/probe.hpp"
#include "props/monitors/descriptors.hpp"

namespace stormproof::props {

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
  model::Stream stream{};
  bool initial = false;  ///< ACKNACK marked initial
  bool repair = false;
  bool carries_heartbeat = false;
  bool to_nobody = false;
  bool to_group = false;   ///< a multicast with contents
  bool directed = false;   ///< of a content: meant for its receiver alone
  std::uint32_t pair = 0;  ///< of a multicast: the sending participant; control-only relations: 0;
                           ///< of a content: whose writer it is about
  std::uint32_t loops_to = UINT32_MAX;  ///< a multicast that goes to a participant of its host
  std::uint32_t detail = 0;             ///< as in `Packet`, of contents, too
  std::uint32_t bytes = 0;
  Descriptors descriptors;   ///< carried or listed
  std::uint32_t writer = 0;  ///< of a content: which one (model/cyclone/endpoints.hpp)
  std::int64_t count = 0;    ///< of a content that is a HEARTBEAT or ACKNACK
  std::vector<Message> contents;
  RelayedContents relayed;

  bool operator==(const Message&) const = default;
  [[nodiscard]] std::uint32_t relation() const {
    return 2 * pair + static_cast<std::uint32_t>(stream);
  }
};
[[nodiscard]] Message message_of(const model::Packet& packet);

/// "acknack_generation of participant 0's pub stream at participant 1 is scheduled for 2 ms".
[[nodiscard]] std::string said(const Move& move, const model::Topology& topology);
[[nodiscard]] std::string said(const Scheduled& event, const model::Topology& topology);
[[nodiscard]] std::string said(const Message& message, const model::Topology& topology);

/// In the order in which they were done; those of a kind are together.
class Deeds {
 public:
  template <class Kind>
  void add(Kind&& deed) {
    auto& list = list_of<std::remove_cvref_t<Kind>>();
    order_.push_back({tag_of<std::remove_cvref_t<Kind>>, static_cast<std::uint32_t>(list.size())});
    list.push_back(std::forward<Kind>(deed));
  }
  void clear() {
    if (order_.empty()) return;
    order_.clear();
    std::apply([](auto&... list) { (list.clear(), ...); }, lists_);
    next_ = 0;
  }
  [[nodiscard]] bool empty() const { return next_ == order_.size(); }
  /// The next one but `skip` if it is a `Kind`, or null.
  template <class Kind>
  [[nodiscard]] const Kind* next(std::size_t skip = 0) const {
    if (next_ + skip >= order_.size()) return nullptr;
    const auto [tag, number] = order_[next_ + skip];
    return tag == tag_of<Kind> ? &std::get<std::vector<Kind>>(lists_)[number] : nullptr;
  }
  void take() { ++next_; }
  /// The next one in words.
  [[nodiscard]] std::string next_in_words(const model::Topology& topology) const;

 private:
  enum class Tag : std::uint8_t { move, scheduled, message };
  template <class Kind>
  static constexpr Tag tag_of = std::is_same_v<Kind, Move>        ? Tag::move
                                : std::is_same_v<Kind, Scheduled> ? Tag::scheduled
                                                                  : Tag::message;
  struct Entry {
    Tag tag{};
    std::uint32_t number = 0;  // among those of its kind
  };
  template <class Kind>
  std::vector<Kind>& list_of() {
    return std::get<std::vector<Kind>>(lists_);
  }

  std::vector<Entry> order_;
  std::tuple<std::vector<Move>, std::vector<Scheduled>, std::vector<Message>> lists_;
  std::size_t next_ = 0;
};

}  // namespace stormproof::props
