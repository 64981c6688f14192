// The host of a reader's rules in a replay of one captured relation: it says what the rules would
// have sent. Which submessages arrive, and when timers are served, is the replay's choice. A side
// (relation_host.hpp) says which reader it is:
//   ReplyDue, AttemptDue, LastDelay   its timers, and the delay of the latter
//   explained_by                      the rules of its ACKNACKs
//   open(host), receive(host, message), ask(host)     what happens to it
//   complete(acknack)                 if its rules leave open what an ACKNACK says
#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "checker/evidence/conform/relation_host.hpp"
#include "checker/evidence/conform/replayed.hpp"
#include "fsm/composition/fastdds.hpp"

namespace stormproof::conform {

/// The reader of a participant's descriptors (fsm/composition/reader.hpp, as Fast DDS completes
/// it).
struct OfDescriptors {
  using Composition = comp::fastdds::FastDds;
  using Packet = Submessage;
  using Unobserved = fsm::TypeList<>;
  using ReplyDue = comp::AckNackGeneration;
  using AttemptDue = comp::InitialAttempt;
  using LastDelay = comp::LastDelay;
  static constexpr AckNackRules explained_by{Rule::acknack_initial, Rule::acknack_reply};

  static void open(auto& host) { host.template run<comp::Happens<comp::ReaderOpens>>(); }
  static void receive(auto& host, const Submessage& message) {
    if (message.descriptor) host.template run<comp::Received<comp::fastdds::Data>>(&message);
    if (message.heartbeat) host.template run<comp::Received<comp::fastdds::Heartbeat>>(&message);
  }
  static void ask(auto& host) {
    model::RunningWorld<std::remove_cvref_t<decltype(host)>, comp::owner::relation> w{host, 0};
    Composition::answer_later(w);
  }
  /// What the application is told, no ACKNACK says.
  static void perform(comp::control::OpenTopics, auto&) {}
};

template <class Side>
class ReaderHost final : public RelationHost<ReaderHost<Side>, Side>, public ReplayedReader {
 public:
  using RelationHost<ReaderHost, Side>::RelationHost;

  void open(std::int64_t now_ns) override {
    this->now_ns_ = now_ns;
    this->side().open(*this);
  }
  void receive(const Submessage& message, std::int64_t now_ns) override {
    this->now_ns_ = now_ns;
    this->side().receive(*this, message);
  }
  void ask_again(std::int64_t now_ns) override {
    this->now_ns_ = now_ns;
    this->side().ask(*this);
  }
  std::optional<MadeAckNack> attempt(std::int64_t now_ns) override {
    return said_by<typename Side::AttemptDue>(now_ns);
  }
  std::optional<MadeAckNack> reply(std::int64_t now_ns) override {
    return said_by<typename Side::ReplyDue>(now_ns);
  }
  std::optional<std::int64_t> take_reply_due() override {
    return std::exchange(this->template due<typename Side::ReplyDue>(), {});
  }
  std::optional<std::int64_t> take_initial_delay() override {
    if (!std::exchange(this->template due<typename Side::AttemptDue>(), {})) return std::nullopt;
    return this->value(typename Side::LastDelay{}, 0);
  }
  [[nodiscard]] AckNackRules explained_by() const override { return Side::explained_by; }

  // What a RunningWorld asks of its host.
  template <class P, class W, class... Sayings>
  void emit(P, W& w, const std::tuple<Sayings...>& sayings) {
    said_.emplace();
    std::apply([&](const auto&... each) { (say(w, each), ...); }, sayings);
    if constexpr (requires { this->side().complete(*said_); }) this->side().complete(*said_);
  }

 private:
  template <class Timer>
  std::optional<MadeAckNack> said_by(std::int64_t now_ns) {
    this->now_ns_ = now_ns;
    said_.reset();
    this->template run<comp::Due<Timer>>();
    return std::move(said_);
  }
  template <class W, class Saying>
  void say(W& w, const Saying& saying) {
    using Field = typename Saying::Field;
    if constexpr (std::is_same_v<Field, comp::IsInitial>) {
      said_->is_initial = saying.value;
    } else if constexpr (std::is_same_v<Field, comp::BelowBase>) {
      said_->base = static_cast<std::uint32_t>(w.count(saying.value));
    } else {
      static_assert(std::is_same_v<Field, comp::Listed>);
      said_->listed = w.set_of(saying.value);
    }
  }

  std::optional<MadeAckNack> said_;
};

}  // namespace stormproof::conform
