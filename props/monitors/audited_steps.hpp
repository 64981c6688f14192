// Opaque steps of rules that are executed beside a run: by their contracts, but for those that are
// about the cycle of HEARTBEATs or about all peers of a participant.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "fsm/adaptive_period.hpp"
#include "props/monitors/audited_packets.hpp"

namespace stormproof::props {

template <class Self, class Base, class Of>
class AuditedSteps : public AuditedPackets<Self, Base, Of> {
  using Packets = AuditedPackets<Self, Base, Of>;

 public:
  template <comp::Owner owner>
  using World = typename Packets::template World<owner>;
  using Packets::Packets;
  using typename Packets::Number;

  template <class Step, class W, class... Args>
  void perform(Step, W& w, const Args&... args) {
    if constexpr (requires { typename Step::SendsBatch; }) {
      send_batch<typename Step::SendsBatch>(w);
    } else if constexpr (requires { typename Step::ForgetsTopics; }) {
      this->self().template forget_topics<typename Step::ForgetsTopics>(w);
    } else if constexpr (requires { typename Step::LosesAll; }) {
      lose_all<typename Step::LosesAll>(w);
    } else if constexpr (requires { typename Step::FillsMessage; }) {
      this->fill([&] { Step::contract(w, args...); });
    } else if constexpr (requires { typename Step::SendsMessage; }) {
      this->flush();
    } else {
      Step::contract(w, args...);
    }
  }

  // Batches: the silent readers of a cycle.
  template <class W>
  void perform(comp::PlanBatches, W& w, const std::int64_t& period) {
    auto& batches = batches_[w.template number<comp::owner::writer>()];
    batches.clear();
    const auto size = fsm::batch_size<fsm::Plain>({.contacted = w(comp::ContactedCount{}),
                                                   .responded = w(comp::RespondedCount{}),
                                                   .epsilon_num = w(comp::EpsilonNumerator{}),
                                                   .epsilon_den = w(comp::EpsilonDenominator{})});
    w.for_readers_by_number([&](auto& r) {
      if (!r(comp::Contacted{}) || r(comp::Responded{})) return;
      if (batches.empty() || std::ssize(batches.back()) == size) batches.emplace_back();
      batches.back().push_back(r.template number<comp::owner::relation>());
    });
    const std::int64_t rest = period - w(comp::CyclePeriod{});
    const std::int64_t count = std::ssize(batches);
    for (std::int64_t k = 0; k < count; ++k) {
      w.at(this->now() + rest * k / count, comp::BatchDue{});
    }
    std::ranges::reverse(batches);
  }
  /// A side that closes loses its turn in the cycle of its writer.
  void loses_turn(Number writer, Number relation) {
    for (auto& batch : batches_[writer]) std::erase(batch, relation);
  }

 private:
  /// A HEARTBEAT to each reader of the next batch that still waits.
  template <class Writer, class W>
  void send_batch(W& w) {
    auto& batches = batches_[w.template number<comp::owner::writer>()];
    if (batches.empty()) return;
    const std::vector<Number> batch = std::move(batches.back());
    batches.pop_back();
    for (const Number relation : batch) {
      World<comp::owner::relation> r{this->self(), relation};
      if (r(typename Writer::Waits{})) Writer::heartbeat(r);
    }
  }
  /// All peers are forgotten, known or not, then come the writers.
  template <class Life, class W>
  void lose_all(W& w) {
    const Number i = w.template number<comp::owner::participant>();
    this->forget_creations(i);
    Life::lose_participant(w);
    const model::Topology& topology = this->topology();
    for (Number n = topology.first_pair(i); n < topology.first_pair(i + 1); ++n) {
      World<comp::owner::pair> back{this->self(), topology.pair(n).reverse};
      back.call(typename Life::Forget{});
    }
    for (const Number writer : {2 * i, 2 * i + 1}) {
      World<comp::owner::writer> of_writer{this->self(), writer};
      Life::lose_writer(of_writer);
    }
  }

  std::map<Number, std::vector<std::vector<Number>>> batches_;  // by writer; the last is next
};

}  // namespace stormproof::props
