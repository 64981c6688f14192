// law.requests: what an ACKNACK asks for is sent again τ_N later, unless the writer repairs it
// already or has done so less than τ_S ago; and no repair leaves at another time. τ_S begins when
// the repair has left its source, with Fast DDS when it is put into a message.
#include <deque>
#include <set>

#include <fmt/core.h>

#include "props/laws/families.hpp"
#include "props/laws/sides.hpp"
#include "props/laws/watching.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/relation_words.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;
using model::PacketKind;
using Number = std::uint32_t;

class RequestWatch : public SideWatch {
 public:
  explicit RequestWatch(const model::Scenario& scenario)
      : SideWatch{"law.requests", scenario},
        sedp_{scenario.dds.sedp},
        has_bases_{traits_of(scenario).acknacks_have_bases} {}

  void run_started(const model::Topology& topology) override {
    SideWatch::run_started(topology);
    silent_until_.reset(topology, before);
    due_.reset(topology, never);
    confirmed_.reset(topology, false);
    requests_.assign(2 * topology.participant_count(), {});
  }
  void event_started(const model::Event& event) override {
    SideWatch::event_started(event);
    judge(event.time);
  }
  void finish(Nanoseconds end) override { judge(end); }
  void emitted(const model::Packet& packet, Number, std::span<const Number>) override {
    note(packet);
  }
  void looped_back(const model::Packet& packet, Number) override { note(packet); }
  void source_completed(const model::Packet& packet) override {
    if (packet.kind != PacketKind::data || !packet.from_repair || has_bases_) return;
    packet.descriptors.for_each([&](Number d) {
      silent_until_.at(packet.relation(), d) = now() + sedp_.nack_suppression_duration;
    });
  }

 private:
  static constexpr Nanoseconds before{-1};
  static constexpr Nanoseconds never{INT64_MAX};

  struct Due {
    Nanoseconds time;
    Number relation;
    Number descriptor;
    auto operator<=>(const Due&) const = default;
  };

  [[nodiscard]] Number writer_of(Number relation) const {
    return 2 * topology().pair(relation / 2).source + relation % 2;
  }
  void acknack_taken(const model::Packet& acknack) override {
    const Number relation = acknack.relation();
    const Number all = topology().descriptor_count(relation);
    if (acknack.initial_acknack && has_bases_) {  // the writer forgets what it knew
      for (Number d = 0; d < all; ++d) confirmed_.at(relation, d) = false;
      return;
    }
    if (acknack.initial_acknack && rules().initial_acknack != model::InitialAckNackReply::bitmap) {
      return;
    }
    bool asks = false;
    bool confirms = true;  // what is below the first that is listed
    for (Number d = 0; d < all; ++d) {
      const bool listed = is_in(acknack.descriptors, d);
      confirms = confirms && !listed;
      const bool by_prefix = has_bases_ ? d < acknack.detail : confirms;
      const bool by_bitmap = !has_bases_ && !listed && !is_prefix_only();
      if (by_prefix || by_bitmap) {
        confirm(relation, d);
      } else if (listed) {
        asks = true;
        request(relation, d);
      }
    }
    if (asks) requests_[writer_of(relation)].push_back(now() + sedp_.nack_response_delay);
  }
  static bool is_in(const model::DescriptorSet& set, Number d) {
    return (set.word(d / 64) >> d % 64 & 1) != 0;
  }
  [[nodiscard]] bool is_prefix_only() const {
    return sedp_.acknowledge == model::Acknowledge::prefix;
  }
  void confirm(Number relation, Number d) {
    confirmed_.at(relation, d) = true;
    forget(relation, d);
  }
  void request(Number relation, Number d) {
    if (confirmed_.at(relation, d) || due_.at(relation, d) != never) return;
    if (now() <= silent_until_.at(relation, d)) return;
    due_.at(relation, d) = now() + sedp_.nack_response_delay;
    pending_.insert({due_.at(relation, d), relation, d});
  }
  void forget(Number relation, Number d) {
    if (due_.at(relation, d) == never) return;
    pending_.erase({due_.at(relation, d), relation, d});
    due_.at(relation, d) = never;
  }
  void note(const model::Packet& packet) {
    if (packet.kind != PacketKind::data) return;
    const Number relation = packet.relation();
    const bool repairs =
        has_bases_ ? kind() != model::EventKind::endpoint_creation : packet.from_repair;
    if (repairs && !is_time(writer_of(relation))) {
      object_now([&] {
        return fmt::format("At {} a repair leaves for {}; no request is τ_N old.", time_text(now()),
                           relation_text(topology(), relation));
      });
    }
    packet.descriptors.for_each([&](Number d) {
      forget(relation, d);
      if (has_bases_) silent_until_.at(relation, d) = now() + sedp_.nack_suppression_duration;
      if (!has_bases_ && repairs) silent_until_.at(relation, d) = never;
    });
  }
  [[nodiscard]] bool is_time(Number writer) {
    std::deque<Nanoseconds>& times = requests_[writer];
    while (!times.empty() && times.front() < now()) times.pop_front();
    return !times.empty() && times.front() == now();
  }
  void judge(Nanoseconds next) {
    if (pending_.empty() || pending_.begin()->time >= next) return;
    const Due& first = *pending_.begin();
    object(event(), next,
           fmt::format("{} was asked for, and not sent again at {}.",
                       descriptor_text(topology(), first.relation, first.descriptor),
                       time_text(first.time)));
  }

  const model::SedpProfile sedp_;
  const bool has_bases_;
  RelationValues<Nanoseconds> silent_until_;  // requests for it count after that
  RelationValues<Nanoseconds> due_;           // its next repair
  RelationValues<char> confirmed_;
  std::set<Due> pending_;
  std::vector<std::deque<Nanoseconds>> requests_;  // of each writer: when their repairs are due
};

constexpr Law requests_list[] = {watched_law<RequestWatch>(
    "law.requests",
    "What an ACKNACK asks for is sent again τ_N later, unless it has been within τ_S; no repair "
    "leaves at another time.",
    is_of_two_writers)};

}  // namespace

std::span<const Law> request_laws() { return requests_list; }

}  // namespace stormproof::props
