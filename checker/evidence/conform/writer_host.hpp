// The host of a writer's rules in a replay of the DATA of one captured relation: the rules keep the
// writer's view of the descriptors and the timers of their repair. Which ACKNACKs arrive when is
// the replay's choice, and which descriptors are sent when, the capture says: what the rules put
// into a queue waits until then. HEARTBEATs are explained by themselves (heartbeats.hpp). A side
// (relation_host.hpp) says which writer it is:
//   Changes, Data                   the part of its descriptors, and what they are sent in
//   ResponseDue, SuppressionEnd     its timers
//   explained_by, answers_all       as a replay asks for them
//   open(host, existing), create(host, d), serve(host, d)     what happens to it
#pragma once

#include <cstdint>
#include <tuple>
#include <type_traits>

#include "checker/evidence/conform/relation_host.hpp"
#include "checker/evidence/conform/replayed.hpp"
#include "fsm/composition/fastdds.hpp"

namespace stormproof::conform {

/// The writer of a participant's descriptors (fsm/composition/fastdds.hpp). Of its queue and of the
/// timer of HEARTBEATs nothing follows here.
struct FromParticipant {
  using Composition = comp::fastdds::FastDds;
  using Packet = Answer;
  using Unobserved = fsm::TypeList<comp::fastdds::AsyncRun, comp::HeartbeatClock>;
  using Changes = comp::fastdds::C;
  using Data = comp::fastdds::Data;
  using ResponseDue = comp::fastdds::NackResponseDue;
  using SuppressionEnd = comp::fastdds::SuppressionEnd;
  static constexpr DataRules explained_by{Rule::data_push, Rule::data_pull, Rule::data_repair};
  static constexpr bool answers_all = true;

  static void open(auto& host, std::uint32_t existing) {
    host.template set_first<comp::fastdds::Exists>(0, existing);
    host.template run<comp::Happens<comp::fastdds::WriterOpens>>();
  }
  static void create(auto& host, std::uint32_t d) {
    host.template run<comp::Happens<comp::fastdds::Created>>(nullptr, d);
  }
  static void serve(auto& host, std::uint32_t d) {
    using Host = std::remove_cvref_t<decltype(host)>;
    model::RunningWorld<Host, comp::owner::entry> w{host, 0, nullptr, d};
    w.set(comp::fastdds::Enqueued{}, false);
    w.call(comp::fastdds::Deliver{}, comp::fastdds::ToRequesters{});
  }
  static void perform(comp::control::OpenTopics, auto&) {}
};

template <class Side>
class WriterHost final : public RelationHost<WriterHost<Side>, Side>, public ReplayedWriter {
 public:
  using RelationHost<WriterHost, Side>::RelationHost;

  void open(std::uint32_t existing) override { this->side().open(*this, existing); }
  void receive(const Answer& answer, std::int64_t now_ns) override {
    this->now_ns_ = now_ns;
    this->template run<comp::Received<typename Side::Composition::AckNack>>(&answer);
  }
  bool create(std::uint32_t descriptor, std::int64_t now_ns) override {
    this->now_ns_ = now_ns;
    is_sent_ = false;
    this->side().create(*this, descriptor);
    return is_sent_;
  }
  bool serve(std::uint32_t descriptor, std::int64_t now_ns) override {
    this->now_ns_ = now_ns;
    is_sent_ = false;
    this->side().serve(*this, descriptor);
    return is_sent_;
  }
  void respond(std::int64_t now_ns) override {
    this->now_ns_ = now_ns;
    this->template run<comp::Due<typename Side::ResponseDue>>();
  }
  void end_suppression(std::int64_t now_ns) override {
    auto& end = this->template due<typename Side::SuppressionEnd>();
    if (!end || now_ns < *end) return;
    this->now_ns_ = now_ns;
    end.reset();
    this->template run<comp::Due<typename Side::SuppressionEnd>>();
  }
  [[nodiscard]] fsm::StateId state_of(std::uint32_t descriptor) override {
    return this->bits(typename Side::Changes{}).state_of(0, descriptor);
  }

  [[nodiscard]] DataRules explained_by() const override { return Side::explained_by; }
  [[nodiscard]] bool answers_all() const override { return Side::answers_all; }

  // What a RunningWorld asks of its host.
  template <class P, class W, class... Sayings>
  void emit(P, W&, const std::tuple<Sayings...>&) {
    if constexpr (std::is_same_v<P, typename Side::Data>) is_sent_ = true;
  }

 private:
  bool is_sent_ = false;  ///< to the reader
};

}  // namespace stormproof::conform
