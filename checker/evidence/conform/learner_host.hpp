// The readers that a Discovery Server adds (fsm/composition/server.hpp), as sides of a replay
// (reader_host.hpp): a client's reader of one of the server's relays, and the server's reader of a
// client's announcements. What they know the rules leave to the host.
#pragma once

#include <cstdint>

#include "checker/evidence/conform/arrivals.hpp"
#include "checker/evidence/conform/reader_host.hpp"
#include "fsm/composition/server.hpp"

namespace stormproof::conform {

struct Learner {
  using Composition = comp::server::FastDdsServer;
  using Packet = Submessage;
  using Unobserved = fsm::TypeList<>;

  Knowledge knowledge{};

  /// It asks for all that is missing of what is announced; an initial one claims nothing.
  void complete(MadeAckNack& said) const {
    if (said.is_initial) return;
    said.base = knowledge.base();
    for (std::uint32_t d = said.base; d < knowledge.announced; ++d) {
      if (!knowledge.knows(d)) said.listed.add(d / 64, std::uint64_t{1} << d % 64);
    }
  }
};

/// A client's reader of a relay.
struct OfRelay : Learner {
  using ReplyDue = comp::server::LearnerReplyDue;
  using AttemptDue = comp::server::LearnerAttempt;
  using LastDelay = comp::server::LearnerLastDelay;
  static constexpr AckNackRules explained_by{Rule::relay_initial, Rule::relay_acknack};

  static void open(auto& host) { host.template run<comp::Happens<comp::server::LearnerOpens>>(); }
  static void receive(auto& host, const Submessage& message) {
    if (message.heartbeat) {
      host.template run<comp::Received<comp::server::RelayHeartbeat>>(&message);
    } else if (message.descriptor) {
      host.template run<comp::Received<comp::server::RelayedData>>(&message);
    } else {
      host.template run<comp::Received<comp::server::Gap>>(&message);
    }
  }
  static void ask(auto& host) {
    model::RunningWorld<std::remove_cvref_t<decltype(host)>, comp::owner::relation> w{host, 0};
    comp::request<comp::server::LearnerReply, comp::server::LearnerResponseDelay, ReplyDue>(w);
  }
  static std::int64_t answer(comp::server::LearnerResponseDelay, const auto& host, const auto&) {
    return host.knob(comp::ResponseDelay{});
  }
  void perform(comp::server::TakeRelayed, auto& w) { knowledge.take(w.packet()); }
  static void perform(comp::server::MeetServer, auto&) {}  // the reader is a client's
};

/// The server's reader of a client's announcements.
struct OfRegistration : Learner {
  using ReplyDue = comp::server::RegistrationReplyDue;
  using AttemptDue = comp::server::RegistrationAttempt;
  using LastDelay = comp::server::RegistrationLastDelay;
  static constexpr AckNackRules explained_by{Rule::registration_initial,
                                             Rule::registration_acknack};

  /// RegistrationArrives does much else.
  static void open(auto& host) {
    model::RunningWorld<std::remove_cvref_t<decltype(host)>, comp::owner::pair> w{host, 0};
    w.set(comp::Recognised{}, true);
    comp::server::RegistrationAttempts::open(w);
  }
  void receive(auto& host, const Submessage& message) {
    knowledge.take(message);
    if (!message.heartbeat) return;
    host.template run<comp::Received<comp::server::RegistrationHeartbeat>>(&message);
  }
  static void ask(auto& host) {
    model::RunningWorld<std::remove_cvref_t<decltype(host)>, comp::owner::pair> w{host, 0};
    comp::request<comp::server::RegistrationReply, comp::server::RegistrationResponseDelay,
                  ReplyDue>(w);
  }
};

}  // namespace stormproof::conform
