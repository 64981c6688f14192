// Messages of Cyclone DDS beside a run: what a rule emits becomes a message for the event thread,
// with its destination and its size; what a timer gives goes into the packet that is open, all else
// waits in the queue. And what rules ask of both.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "props/monitors/audited_cyclone_threads.hpp"

namespace stormproof::props {

template <class Self>
class AuditedMessages : public AuditedThreads<Self> {
  using Threads = AuditedThreads<Self>;
  using Destination = model::cyclone::Destination;
  using Queued = model::cyclone::Message;

 public:
  using typename Threads::Number;

  AuditedMessages(model::RunState& run, Audit& audit)
      : Threads{run, audit},
        multicast_{run.scenario.dds.allow_multicast == model::AllowMulticast::always},
        versions_(CycloneColumns::rows<comp::owner::writer>(run)) {}

  void changed(cyclone::WriterOpen open, Number relation, bool matched) {
    Threads::changed(open, relation, matched);
    ++versions_[writer_of(relation)];
  }
  // What submessages say.
  using Threads::said;
  using Threads::word;
  static bool said(comp::IsInitial, const model::Submessage& m) { return m.initial; }
  static bool said(cyclone::IsDirected, const model::Submessage& m) { return m.directed; }
  static std::int64_t said(cyclone::Count, const model::Submessage& m) { return m.count; }
  static std::uint64_t word(comp::Carries, const model::Submessage& m, Number k) {
    return model::bits_below(m.sample + 1, k) & ~model::bits_below(m.sample, k);
  }
  static std::uint64_t word(comp::Listed, const model::Submessage& m, Number k) {
    return m.bitmap.word(k);
  }
  static std::uint64_t word(comp::Announces, const model::Submessage& m, Number k) {
    return model::bits_below(m.sample, k);
  }
  static std::uint64_t word(comp::BelowBase, const model::Submessage& m, Number k) {
    return model::bits_below(m.sample, k);
  }

  // What is queued.
  using Threads::answer;
  template <class W>
  [[nodiscard]] bool answer(cyclone::IsQueued, const W& w) {
    return is_queued(w, false);
  }
  template <class W>
  [[nodiscard]] bool answer(cyclone::IsQueuedForIt, const W& w) {
    return is_queued(w, true);
  }
  template <class W>
  [[nodiscard]] bool answer(cyclone::QueueIsFull, const W& w) {
    return std::ranges::count_if(thread(w).queue, &Queued::retransmission) >=
           this->run_.scenario.dds.sedp.max_queued_rexmit_messages;
  }
  template <class W>
  [[nodiscard]] bool answer(cyclone::AnswerIsKept, const W& w) {
    return thread(w).kept && thread(w).kept->first == w.template number<comp::owner::relation>();
  }
  template <class W>
  [[nodiscard]] bool answer(cyclone::SomeAnswerIsKept, const W& w) {
    return thread(w).kept.has_value();
  }

  // Messages. What a timer gives goes into the packet that is open; all else waits in the queue.
  template <class W, class Sayings>
  void emit(cyclone::Spdp, W& w, const Sayings& sayings) {
    thread(w).queue.push_back(
        message(model::Submessage::Kind::spdp, w, sayings, Destination::only(reader(w))));
  }
  template <class W, class Sayings>
  void emit(cyclone::Data, W& w, const Sayings& sayings) {
    Queued data = message(model::Submessage::Kind::data, w, sayings, Destination::only(reader(w)));
    data.retransmission = true;
    thread(w).queue.push_back(std::move(data));
  }
  template <class W, class Sayings>
  void emit(cyclone::Heartbeat, W& w, const Sayings& sayings) {
    if constexpr ((W::place.indices & comp::owner::peer_index) == 0) {
      thread(w).given = message(model::Submessage::Kind::heartbeat, w, sayings, to_readers(w));
    } else {
      Queued heartbeat =
          message(model::Submessage::Kind::heartbeat, w, sayings, Destination::only(reader(w)));
      if (heartbeat.content.directed) {
        thread(w).kept.emplace(w.template number<comp::owner::relation>(), std::move(heartbeat));
      } else {
        thread(w).given = std::move(heartbeat);
      }
    }
  }
  template <class W, class Sayings>
  void emit(cyclone::AckNack, W& w, const Sayings& sayings) {
    this->threads_[reader(w)].given =
        message(model::Submessage::Kind::acknack, w, sayings,
                Destination::only(w.template number<comp::owner::participant>()));
  }

  using Threads::perform;
  template <class W>
  void perform(cyclone::HeartbeatToAll, W& w) {
    cyclone::emit_heartbeat(w, false);
  }
  template <class W>
  void perform(cyclone::DataToAll, W& w) {
    const auto sample = comp::says(comp::Says{comp::Carries{}, comp::everyone});
    thread(w).queue.push_back(message(model::Submessage::Kind::data, w, sample, to_readers(w)));
  }
  template <class W>
  void perform(cyclone::Announce, W& w) {
    Destination to{.is_set = true, .addresses = {model::cyclone::group}};
    w.for_known_peers([&](auto& peer) {
      if (!multicast_) to.addresses.push_back(reader(peer));
    });
    thread(w).queue.push_back(
        message(model::Submessage::Kind::spdp, w, comp::says(), std::move(to)));
  }
  template <class W>
  void perform(cyclone::SendToAllInstead, W& w) {
    for (Queued& queued : thread(w).queue) {
      const bool is_of_another = !queued.to.is_set && !queued.to.is_only(reader(w));
      if (is_of_another && repeats(queued, w)) queued.to = to_readers(w);
    }
  }
  template <class W>
  void perform(cyclone::LetAnswerGo, W& w) {
    if (auto kept = std::exchange(thread(w).kept, {})) {
      thread(w).queue.push_back(std::move(kept->second));
    }
  }
  template <class W, class Part>
  void perform(cyclone::JoinList, W& w, const Part& part) {
    using Fires = decltype(occasion_of(part));
    const auto n = w.template number<Part::owner>();
    EventThread* whose = &thread(w);
    if constexpr (std::is_same_v<Part, cyclone::AckTimer>) whose = &this->threads_[reader(w)];
    whose->list.push_back([this, n] { this->template run<comp::Happens<Fires>>(n); });
  }
  template <class W>
  void perform(cyclone::Work, W& w) {
    this->work(w.template number<comp::owner::participant>());
  }

 protected:
  using Threads::stride_;

  [[nodiscard]] const model::Pair& ends(Number relation) const {
    return this->topology().pair(relation / stride_);
  }
  [[nodiscard]] Number writer_of(Number relation) const {
    return stride_ * ends(relation).source + relation % stride_;
  }
  template <class W>
  [[nodiscard]] Number reader(const W& w) const {
    return this->topology().pair(w.template number<comp::owner::pair>()).destination;
  }

 private:
  static cyclone::AckTimerFires occasion_of(cyclone::AckTimer) { return {}; }
  static cyclone::HeartbeatTimerFires occasion_of(cyclone::HeartbeatTimer) { return {}; }
  static cyclone::SpdpTimerFires occasion_of(cyclone::SpdpTimer) { return {}; }
  static cyclone::ReplyTimerFires occasion_of(cyclone::ReplyTimer) { return {}; }

  template <class W>
  [[nodiscard]] EventThread& thread(const W& w) {
    return this->threads_[w.template number<comp::owner::participant>()];
  }
  template <class W>
  [[nodiscard]] Destination to_readers(const W& w) const {
    const auto writer = w.template number<comp::owner::writer>();
    Destination to{true, {}, writer, versions_[writer]};
    for (const Number relation : this->readers(writer)) {
      to.addresses.push_back(ends(relation).destination);
    }
    if (multicast_ && to.addresses.size() > 1) to.addresses = {model::cyclone::group};
    return to;
  }
  /// A retransmission of the sample of this place.
  template <class W>
  [[nodiscard]] bool repeats(const Queued& queued, const W& w) const {
    return queued.retransmission && queued.content.sample == w.descriptor() &&
           queued.content.writer == w.template number<comp::owner::writer>() % stride_;
  }
  template <class W>
  [[nodiscard]] bool is_queued(const W& w, bool for_it) {
    return std::ranges::any_of(thread(w).queue, [&](const Queued& queued) {
      return repeats(queued, w) && (!for_it || queued.to.is_only(reader(w)));
    });
  }
  /// About the writer of this place.
  template <class W, class... Sayings>
  Queued message(model::Submessage::Kind kind, W& w, const std::tuple<Sayings...>& sayings,
                 Destination to) {
    Queued message;
    message.content.kind = kind;
    message.content.participant = w.template number<comp::owner::participant>();
    message.to = std::move(to);
    std::apply([&](const auto&... each) { (say(message.content, w, each), ...); }, sayings);
    Number bits = 0;
    if constexpr ((W::place.indices & comp::owner::stream_index) != 0) {
      message.content.writer = w.template number<comp::owner::writer>() % stride_;
    }
    if (!message.content.bitmap.empty()) bits = known(w) - message.content.sample;
    message.of_user = message.content.writer >= model::cyclone::writer::first_topic;
    message.bytes = bytes_of(message.content, bits);
    return message;
  }
  /// Of how many samples the reader of an ACKNACK knows.
  template <class W>
  static Number known(W& w) {
    if constexpr (W::place == comp::owner::relation) {
      return static_cast<Number>(w.count([](auto& d) { return d(cyclone::Known{}); }));
    }
    return 0;
  }
  template <class W, class Field, class Value>
  static void say(model::Submessage& content, W& w, const comp::Says<Field, Value>& says) {
    if constexpr (std::is_same_v<Field, comp::Carries>) {
      content.sample = w.descriptor();
    } else if constexpr (std::is_same_v<Field, comp::Announces>) {
      content.sample = static_cast<Number>(w.count(says.value));
    } else if constexpr (std::is_same_v<Field, comp::BelowBase>) {
      const model::DescriptorSet confirmed = w.set_of(says.value);
      content.sample = confirmed.empty() ? 0 : confirmed.highest() + 1;
    } else if constexpr (std::is_same_v<Field, comp::Listed>) {
      content.bitmap = w.set_of(says.value);
    } else if constexpr (std::is_same_v<Field, cyclone::Count>) {
      content.count = says.value;
    } else if constexpr (std::is_same_v<Field, cyclone::IsDirected>) {
      content.directed = says.value;
    } else {
      static_assert(std::is_same_v<Field, comp::IsInitial>);
      content.initial = says.value;
    }
  }
  /// The bitmap of an ACKNACK has this many.
  [[nodiscard]] std::int64_t bytes_of(const model::Submessage& content, std::int64_t bits) const {
    constexpr std::int64_t bits_per_word = 32;
    using namespace model::cyclone;
    switch (content.kind) {
      case model::Submessage::Kind::data:
        return data_bytes(content.writer, content.sample);
      case model::Submessage::Kind::heartbeat:
        return heartbeat_bytes;
      case model::Submessage::Kind::acknack:
        return acknack_bytes + bitmap_word_bytes * ((bits + bits_per_word - 1) / bits_per_word);
      default:
        return multicast_ ? announcement_with_multicast_bytes : announcement_bytes;
    }
  }

  const bool multicast_;
  std::vector<std::uint64_t> versions_;  // by writer: how many readers were matched
};

}  // namespace stormproof::props
