// What rules emit that are executed beside a run, and the choices of contracts, which the run
// answers. A message that several steps fill (`FillsMessage`) carries what they put into it, of one
// writer to the same readers; whether something had room shows in the run, which sends the message
// at the next step then.
#pragma once

#include <cstddef>
#include <map>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "props/monitors/audited_state.hpp"

namespace stormproof::props {

template <class Self, class Base, class Of>
class AuditedPackets : public AuditedState<Self, Base, Of> {
  using State = AuditedState<Self, Base, Of>;

 public:
  using State::State;
  using typename State::Number;

  template <class P, class W, class... Sayings>
  void emit(P packet, W& w, const std::tuple<Sayings...>& sayings) {
    if constexpr (std::is_same_v<P, comp::SpdpMulticast>) {
      this->announce(w.template number<comp::owner::participant>());
    } else {
      constexpr bool of_control = P::owner == comp::owner::control_relation;
      if constexpr (of_control || P::owner == comp::owner::relation) {
        if (is_filled_) {
          if (put_.to.empty()) put_.message = message_of(packet, w, sayings);
          put_.to.push_back(w.template number < of_control ? P::owner : comp::owner::pair > ());
          return;
        }
      }
      if (!this->audit_.has_parted()) this->audit_.expect(message_of(packet, w, sayings));
    }
  }

  /// What only may happen does if the run did next all that it does.
  template <class Body>
  void decide(const Choice& choice, Body&& body) {
    if (!choice.is_possible()) return;
    if (is_filled_) {
      put_.may_be = true;
      return body();
    }
    if (!this->audit_.would(body)) return;
    choice.take(true);
    body();
  }
  /// As the next messages carry it, the least ones first.
  template <class Body>
  void partition(const model::DescriptorSet& set, Body&& body) {
    Descriptors rest{set};
    while (!rest.empty() && !this->audit_.difference()) {
      const Message* next = this->audit_.next_message();
      const std::size_t size = next == nullptr ? 0 : next->descriptors.size();
      const bool possible = size > 0 && size <= rest.size();
      body(rest.take(possible ? size : rest.size()).set());
    }
  }

  // What is queued, and sent in messages that are filled.
  template <class Visit>
  void for_queue(Number i, Visit&& visit) {
    go_on(i);
    auto& queue = this->queue_of(i);
    while (!queue.empty() && !leaves_queue(i)) {
      const auto first = queue.front();
      queue.pop_front();
      visit(first.writer, first.descriptor);
    }
  }

 protected:
  /// What the contract of a step emits joins the message that is open.
  template <class Contract>
  void fill(Contract&& contract) {
    put_.to.clear();
    put_.may_be = false;
    is_filled_ = true;
    contract();
    is_filled_ = false;
    if (put_.to.empty()) return;
    if (put_.may_be) {
      std::swap(goes_with_open() ? open_.rides : open_.follow, put_);
      return;
    }
    const std::uint32_t d =
        put_.message.samples > 0 ? put_.message.last_sample : put_.message.descriptors.least();
    if (!goes_with_open() || open_.carried.has(d) || was_sent_without(d)) flush();
    if (open_.carried.empty()) {
      std::swap(open_.message, put_.message);
      std::swap(open_.to, put_.to);
    }
    open_.carried.add(d);
  }
  /// What the message carries goes to each of its readers, with or without a HEARTBEAT.
  void flush() {
    std::swap(open_, sent_);
    open_.clear();
    OpenMessage& sent = sent_;
    if (!sent.carried.empty()) {
      const Message* next = this->audit_.next_message();
      sent.message.carries_heartbeat =
          !sent.rides.to.empty() && next != nullptr && next->carries_heartbeat;
      if (sent.message.is_of_control()) {
        sent.message.samples = static_cast<Number>(sent.carried.size());
        sent.message.last_sample += sent.message.samples - 1;
      } else {
        sent.message.descriptors = sent.carried;
        sent.message.detail = sent.message.carries_heartbeat ? sent.rides.message.detail : 0;
      }
      expect_to(sent.message, sent.to);
      if (is_full(sent) && sent.follow.to.empty()) std::swap(sent.rides, sent.follow);
    }
    const Message* next = this->audit_.next_message();
    if (next == nullptr || sent.follow.to.empty()) return;
    if (next->kind == sent.follow.message.kind) expect_to(sent.follow.message, sent.follow.to);
  }
  [[nodiscard]] bool open_is_full() const { return is_full(open_); }
  /// What is left of an asynchronous run goes on.
  void go_on(Number i) {
    if (const auto left = unfinished_.extract(i)) open_ = left.mapped();
  }

  /// Whether the queue is left for now, though there are entries, because its participant stalls.
  /// The message stays open; if its DATA has gone, HEARTBEATs are left.
  bool leaves_queue(Number i) {
    if (!this->may_stall()) return false;
    std::size_t messages = 0;
    while (this->audit_.next_message(messages) != nullptr) ++messages;
    const Move* move = this->audit_.deeds().template next<Move>(messages);
    if (move == nullptr || move->machine.kind != model::MachineRef::Kind::participant) return false;
    if (move->event != fsm::name_of<fsm::single_shot::Requested>()) return false;
    if (messages > 0) {
      OpenMessage rest;
      std::swap(rest.follow, open_.follow);
      flush();
      if (rest.follow.to.empty()) std::swap(rest.follow, sent_.follow);
      rest.message = rest.follow.message;
      rest.to = rest.follow.to;
      rest.rides = rest.follow;
      open_ = std::move(rest);
    }
    typename State::template World<comp::owner::participant> w{this->self(), i};
    State::Composition::leave_queue(w);
    unfinished_[i] = std::exchange(open_, {});
    return true;
  }

 private:
  /// What a step puts into a message, which goes to these pairs.
  struct Put {
    Message message;
    std::vector<Number> to;
    bool may_be = false;  ///< or not
  };
  struct OpenMessage {
    Message message;
    std::vector<Number> to;
    Descriptors carried;
    Put rides;   ///< a HEARTBEAT, in it
    Put follow;  ///< HEARTBEATs to others as well, after it

    /// Its memory is kept.
    void clear() {
      to.clear();
      carried = {};
      rides.to.clear();
      follow.to.clear();
    }
  };

  /// To pairs, or on control-only relations.
  void expect_to(Message& message, const std::vector<Number>& to) {
    if (!message.is_of_control()) return this->audit_.expect(message, to);
    for (const Number relation : to) {
      message.detail = relation;
      this->audit_.expect(message);
    }
  }
  /// It takes no more DATA, and is sent before its last one is charged.
  [[nodiscard]] bool is_full(const OpenMessage& message) const {
    if (message.to.empty()) return false;
    const Number n = message.to.front();
    Number pair = n;
    if constexpr (requires(const Self& self) { self.pair_of_control(n); }) {
      const auto& self = static_cast<const Self&>(*this);
      if (message.message.is_of_control()) pair = self.pair_of_control(n);
    }
    const Number writer = this->topology().pair(pair).source;
    const std::size_t most = this->run_.profiles.of(writer).version.max_data_per_message;
    return most > 0 && message.carried.size() >= most;
  }
  /// Whether the run has sent a message, without the descriptor or sample that is put now.
  [[nodiscard]] bool was_sent_without(Number d) {
    const Message* next = this->audit_.next_message();
    return next != nullptr && (next->samples == 0 || next->last_sample < d);
  }
  template <class P, class W, class... Sayings>
  Message message_of(P, W& w, const std::tuple<Sayings...>& sayings) {
    Message message;
    message.kind = packet_kind_of<P>;
    if constexpr (P::owner == comp::owner::control_relation) {
      message.detail = w.template number<P::owner>();
    } else {
      message.pair = w.template number<comp::owner::pair>();
    }
    if constexpr (P::owner == comp::owner::relation) {
      message.stream = model::streams[w.template number<P::owner>() % 2];
    }
    std::apply([&](const auto&... each) { (say<typename P::Fields>(message, w, each), ...); },
               sayings);
    // Only a HEARTBEAT announces.
    if (message.kind == model::PacketKind::data && !message.carries_heartbeat) message.detail = 0;
    return message;
  }
  template <class Fields, class W, class Field, class Value>
  void say(Message& message, W& w, const comp::Says<Field, Value>& says) {
    if constexpr (std::is_same_v<Field, lookup::SampleCount> ||
                  std::is_same_v<Field, lookup::SampleNumber>) {
      message.last_sample = static_cast<std::uint32_t>(says.value);
      if (std::is_same_v<Field, lookup::SampleNumber>) message.samples = 1;
    } else if constexpr (!model::detail::is_listed<Field>(Fields{}) ||
                         std::derived_from<Field, comp::PacketNumber> ||
                         std::is_same_v<Field, lookup::IsForReader>) {
      // Only observers of descriptors hear it, or it follows from the sample's number.
    } else if constexpr (std::is_same_v<Field, comp::Carries> ||
                         std::is_same_v<Field, comp::Listed>) {
      message.descriptors = Descriptors{w.set_of(says.value)};
    } else if constexpr (std::is_same_v<Field, comp::BelowBase>) {
      if (!this->has_bases()) return;
      const model::DescriptorSet confirmed = w.set_of(says.value);
      message.detail = confirmed.empty() ? 0 : confirmed.highest() + 1;
    } else if constexpr (std::is_same_v<Field, comp::Announces>) {
      message.detail = static_cast<std::uint32_t>(w.count(says.value));
    } else if constexpr (std::is_same_v<Field, comp::IsInitial>) {
      message.initial = says.value;
    } else if constexpr (std::is_same_v<Field, comp::IsRepair>) {
      message.repair = says.value;
    } else {
      static_assert(std::is_same_v<Field, comp::CarriesHeartbeat>);
      message.carries_heartbeat = rides(w, says.value);
    }
  }
  template <class W>
  static bool rides(W&, bool says) {
    return says;
  }
  /// It can if the packet goes to all readers. One that could does not go separately.
  template <class W>
  bool rides(W& w, const Choice& choice) {
    const auto all = this->readers(w.template number<comp::owner::writer>()).size();
    const bool could = choice.is_possible() && all == 1;
    choice.take(could);
    const Message* next = this->audit_.next_message();
    return could && next != nullptr && next->carries_heartbeat;
  }
  /// Whether what was put goes to the same readers.
  [[nodiscard]] bool goes_with_open() const {
    return put_.message.is_of_control() == open_.message.is_of_control() &&
           put_.message.stream == open_.message.stream && put_.to == open_.to;
  }
  bool is_filled_ = false;  // by the step that is executed
  Put put_;                 // by it
  OpenMessage open_;
  OpenMessage sent_;                          // last
  std::map<Number, OpenMessage> unfinished_;  // by participant, while it stalls
};

}  // namespace stormproof::props
