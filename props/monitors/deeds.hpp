// What a run does because of a rule, as an observer sees it: machines move, events are scheduled,
// packets go out. A monitor collects them in order and holds them against what the rules say
// (props/monitors/followed.cpp). What the network does by itself is not among them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/engine/packet.hpp"
#include "model/engine/submessage.hpp"
#include "model/engine/topology.hpp"
#include "model/probe.hpp"
#include "props/monitors/descriptors.hpp"

namespace stormproof::props {

using Move = model::Transition;

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

/// What a packet of Cyclone DDS carries; the same.
struct SentContents {
  std::shared_ptr<const std::vector<model::Submessage>> of;

  bool operator==(const SentContents& other) const;
};

/// What a packet says, without its size. One of Cyclone DDS has contents and its size.
struct Message {
  model::PacketKind kind{};
  model::Stream stream{};
  bool initial = false;  ///< ACKNACK marked initial
  bool repair = false;
  bool carries_heartbeat = false;
  bool to_nobody = false;
  bool to_group = false;   ///< a multicast with contents
  std::uint32_t pair = 0;  ///< of a multicast: the sending participant; control-only relations: 0
  std::uint32_t loops_to = UINT32_MAX;  ///< a multicast that goes to a participant of its host
  std::uint32_t detail = 0;             ///< as in `Packet`
  std::uint32_t bytes = 0;              ///< if it has contents
  // Of a control-only relation, as in `Packet`.
  std::uint32_t samples = 0;
  std::uint32_t last_sample = 0;
  Descriptors descriptors;  ///< carried or listed
  SentContents contents;
  RelayedContents relayed;

  bool operator==(const Message&) const = default;
  /// The same to whomever.
  [[nodiscard]] bool says_what(const Message& other) const;
  /// Whether the packet is it, to whomever; of those with contents and of multicasts it is not
  /// told.
  [[nodiscard]] bool says_what(const model::Packet& packet) const;
  [[nodiscard]] bool is_of_control() const;
  [[nodiscard]] bool is_multicast() const {
    return to_group || kind == model::PacketKind::spdp_multicast;
  }
  [[nodiscard]] std::uint32_t relation() const {
    return 2 * pair + static_cast<std::uint32_t>(stream);
  }
};
[[nodiscard]] Message message_of(const model::Packet& packet);

/// "acknack_generation of participant 0's pub stream at participant 1 is scheduled for 2 ms".
[[nodiscard]] std::string said(const Move& move, const model::Topology& topology);
[[nodiscard]] std::string said(const Scheduled& event, const model::Topology& topology);
[[nodiscard]] std::string said(const Message& message, const model::Topology& topology);

/// In the order in which they were done; those of a kind are together. The same message to several
/// pairs, one after the other, is one deed. Over the network a record may stand for all of it
/// (Probe::wants_single_packets), so packets on that way are in order, and those within the host.
class Deeds {
 public:
  /// How far somebody has come.
  struct Position {
    std::size_t deed = 0;
    // Of a message: how many of its pairs are behind, of those on other hosts and of the others.
    std::uint32_t crossing = 0;
    std::uint32_t looped = 0;
    std::uint32_t taken = 0;  // of all
  };

  explicit Deeds(const model::Topology& topology) : topology_{topology} {}

  template <class Kind>
  void add(Kind&& deed) {
    auto& list = list_of<std::remove_cvref_t<Kind>>();
    order_.push_back({tag_of<std::remove_cvref_t<Kind>>, static_cast<std::uint32_t>(list.size())});
    list.push_back(std::forward<Kind>(deed));
  }
  /// The packet goes to the pair, or within the host to the participant.
  void add(const model::Packet& packet, std::uint32_t pair, std::uint32_t loops_to = UINT32_MAX);
  /// So does another packet of the record that was added last.
  void add_copy(std::uint32_t pair) {
    pairs_.push_back(pair);
    ++order_.back().pairs;
  }
  void clear() {
    if (order_.empty()) return;
    order_.clear();
    std::apply([](auto&... list) { (list.clear(), ...); }, lists_);
    pairs_.clear();
    next_ = {};
  }
  [[nodiscard]] bool empty() const { return next_.deed == order_.size(); }
  /// The next one.
  [[nodiscard]] const Position& position() const { return next_; }
  /// The next one but `skip` if it is a `Kind`, or null.
  template <class Kind>
  [[nodiscard]] const Kind* next(std::size_t skip = 0) const {
    return at<Kind>(next_.deed + skip);
  }
  template <class Kind>
  [[nodiscard]] const Kind* at(std::size_t deed) const {
    if (deed >= order_.size()) return nullptr;
    const Entry& entry = order_[deed];
    return entry.tag == tag_of<Kind> ? &std::get<std::vector<Kind>>(lists_)[entry.number] : nullptr;
  }
  void take() { next_ = {next_.deed + 1}; }
  /// Goes on from there, behind the message to each of the pairs; stops before the first one to
  /// which it was not sent next, and returns how many those before it are.
  [[nodiscard]] std::size_t pass(Position& from, const Message& message,
                                 std::span<const std::uint32_t> pairs) const;
  [[nodiscard]] std::size_t take(const Message& message, std::span<const std::uint32_t> pairs) {
    return pass(next_, message, pairs);
  }
  /// The next one in words.
  [[nodiscard]] std::string next_in_words() const;

 private:
  enum class Tag : std::uint8_t { move, scheduled, message };
  template <class Kind>
  static constexpr Tag tag_of = std::is_same_v<Kind, Move>        ? Tag::move
                                : std::is_same_v<Kind, Scheduled> ? Tag::scheduled
                                                                  : Tag::message;
  struct Entry {
    Tag tag{};
    std::uint32_t number = 0;  // among those of its kind
    // Of a message.
    std::uint32_t first_pair = 0;
    std::uint32_t pairs = 0;
  };
  [[nodiscard]] std::span<const std::uint32_t> pairs_of(std::size_t deed) const {
    return std::span{pairs_}.subspan(order_[deed].first_pair, order_[deed].pairs);
  }
  [[nodiscard]] bool crosses(const Message& message, std::uint32_t pair) const {
    return message.is_multicast() || topology_.pair(pair).cross_host;
  }
  template <class Kind>
  std::vector<Kind>& list_of() {
    return std::get<std::vector<Kind>>(lists_);
  }

  const model::Topology& topology_;
  std::vector<Entry> order_;
  std::tuple<std::vector<Move>, std::vector<Scheduled>, std::vector<Message>> lists_;
  std::vector<std::uint32_t> pairs_;  // of messages
  Position next_;
};

}  // namespace stormproof::props
