// The writers that a Discovery Server adds (fsm/composition/server.hpp), as a side of a replay
// (writer_host.hpp). What enters the list of the reader, and when the sending thread gets to a
// change, the capture says. HEARTBEATs and GAPs are explained by themselves (server_relay.cpp).
#pragma once

#include <cstdint>
#include <type_traits>

#include "checker/evidence/conform/writer_host.hpp"
#include "fsm/composition/server.hpp"

namespace stormproof::conform {

struct FromRelay {
  using Composition = comp::server::FastDdsServer;
  using Packet = Answer;
  using Unobserved = fsm::TypeList<comp::server::SendingThread>;
  using Changes = comp::server::Change;
  using Data = comp::server::RelayedData;
  using ResponseDue = comp::server::RelayResponseDue;
  using SuppressionEnd = comp::server::RelaySuppressionEnd;
  static constexpr DataRules explained_by{Rule::relay_data, Rule::relay_data, Rule::relay_repair};
  /// A change that gets another number is not sent under the old one.
  static constexpr bool answers_all = false;

  std::uint32_t existing = 0;   ///< changes when the relation opened
  bool some_requested = false;  ///< by the last ACKNACK

  void open(auto& host, std::uint32_t existing_changes) {
    existing = existing_changes;
    host.template run<comp::Happens<comp::server::RelayOpens>>();
  }
  static void create(auto& host, std::uint32_t change) {
    change_of(host, change).feed(Changes{}, comp::on<fsm::change_for_reader::Created>);
    serve(host, change);
  }
  static void serve(auto& host, std::uint32_t change) {
    auto w = change_of(host, change);
    if (!w.in(Changes{}, comp::is<fsm::change_for_reader::Q>)) return;
    w.feed(Changes{}, comp::on<fsm::change_for_reader::Serialized>);
    host.template run<comp::Happens<comp::server::Served>>();
    host.template run<comp::Happens<comp::server::Delivered>>();
  }

  /// When the queues are sent, and what a GAP tells, the capture says.
  template <class Tag>
  [[nodiscard]] auto answer(Tag, const auto& host, const auto& w) const
      requires(!std::is_same_v<Tag, comp::Now>) {
    namespace server = comp::server;
    if constexpr (std::is_same_v<Tag, server::RelayHeartbeatPeriod>) {
      return host.knob(comp::HeartbeatPeriod{});
    } else if constexpr (std::is_same_v<Tag, server::RelayResponseDelay>) {
      return host.knob(comp::fastdds::NackResponseDelay{});
    } else if constexpr (std::is_same_v<Tag, server::RelaySuppressionDuration>) {
      return host.knob(comp::fastdds::SuppressionDuration{});
    } else if constexpr (std::is_same_v<Tag, server::HistoryNotEmpty>) {
      return existing > 0;
    } else if constexpr (std::is_same_v<Tag, server::SomeRequested>) {
      return some_requested;
    } else if constexpr (std::is_same_v<Tag, server::SomeListed>) {
      return !w.packet().missing.empty();
    } else {
      static_assert(std::is_same_v<Tag, server::SomethingToSend> ||
                    std::is_same_v<Tag, server::SomeIrrelevant>);
      return false;
    }
  }
  void perform(comp::server::ListRelevant, auto& w) const {
    model::DescriptorSet relevant;
    for (std::uint32_t k = 0; 64 * k < existing; ++k) {
      relevant.add(k, model::bits_below(existing, k));
    }
    w.feed_each(Changes{}, comp::on<fsm::change_for_reader::ReaderMatched>, comp::no_input,
                [&](auto& d) { return d.is_in(relevant); });
  }
  void perform(comp::server::TakeAckNack, auto& w) {
    const auto changes =
        w.feed_each(Changes{}, comp::on<fsm::change_for_reader::AckNackReceived>, [](auto& d) {
          using D = typename std::remove_cvref_t<decltype(d)>::D;
          return fsm::ChangeForReaderIo::Input<D>{
              .listed = d(comp::Listed{}) && !d(comp::BelowBase{}),
              .below_base = d(comp::BelowBase{})};
        });
    some_requested = w.any(changes.requested);
  }

 private:
  template <class Host>
  static auto change_of(Host& host, std::uint32_t change) {
    return model::RunningWorld<Host, comp::owner::descriptor>{host, 0, nullptr, change};
  }
};

}  // namespace stormproof::conform
