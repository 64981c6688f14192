// law.reminders: as long as a reader has not confirmed everything, its writer says something to it
// at least every τ_H (with the adaptive policy, the longest period), and Fast DDS's at most one
// repair later; and between two expiries of a writer's one HEARTBEAT timer lies τ_H.
#include <algorithm>

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

/// The longest time between two words of a writer to a reader that lacks confirmation.
Nanoseconds patience(const model::Scenario& scenario) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  Nanoseconds longest = sedp.heartbeat_period;
  if (sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive) {
    longest = std::max(longest, sedp.adaptive.max_period) + Nanoseconds{1};
  }
  // An expiry finds nothing to ask for while a repair is under way or suppressed, and the end of
  // the suppression starts the timer anew.
  if (is_stateful(scenario)) {
    longest += std::max(sedp.nack_response_delay, sedp.nack_suppression_duration);
  }
  return longest;
}

constexpr Nanoseconds never{-1};

class ReminderWatch : public SideWatch {
 public:
  explicit ReminderWatch(const model::Scenario& scenario)
      : SideWatch{"law.reminders", scenario},
        has_bases_{traits_of(scenario).acknacks_have_bases},
        patience_{patience(scenario)} {}

  void run_started(const model::Topology& topology) override {
    SideWatch::run_started(topology);
    confirmed_.reset(topology, false);
    readers_.assign(topology.relation_count(), {});
    expired_.assign(2 * topology.participant_count(), never);
    for (Number relation = 0; relation < topology.relation_count(); ++relation) {
      readers_[relation].exist = has_bases_ ? 0 : topology.descriptor_count(relation);
    }
  }
  void event_started(const model::Event& event) override {
    SideWatch::event_started(event);
    if (event.kind == model::EventKind::heartbeat_expiry) expire(event.subject);
  }
  void finish(Nanoseconds end) override {
    for (Number relation = 0; relation < readers_.size(); ++relation) judge(relation, end);
  }
  void emitted(const model::Packet& packet, Number source,
               std::span<const Number> destinations) override {
    for_relations(packet, source, destinations, [&](Number relation) { note(packet, relation); });
  }
  void looped_back(const model::Packet& packet, Number) override {
    note(packet, packet.relation());
  }

 private:
  struct Reader {
    Number exist = 0;  ///< descriptors that the writer has told of
    Number confirmed = 0;
    Nanoseconds last;  ///< when the writer last said something, or began to wait
    bool open = false;
  };

  void writer_opened(Number relation) override {
    readers_[relation].open = true;
    readers_[relation].last = now();
  }
  void acknack_taken(const model::Packet& acknack) override {
    const Number relation = acknack.relation();
    judge(relation, now());
    const bool counts =
        !acknack.initial_acknack || rules().initial_acknack == model::InitialAckNackReply::bitmap;
    bool below = true;
    for (Number d = 0; d < topology().descriptor_count(relation); ++d) {
      const bool listed = (acknack.descriptors.word(d / 64) >> d % 64 & 1) != 0;
      below = below && !listed;
      const bool by_bitmap =
          !listed && scenario().dds.sedp.acknowledge != model::Acknowledge::prefix;
      const bool confirms = has_bases_ ? d < acknack.detail : below || by_bitmap;
      if (acknack.initial_acknack && has_bases_) set(relation, d, false);
      if (counts && confirms) set(relation, d, true);
    }
  }
  void set(Number relation, Number d, bool confirmed) {
    char& is_confirmed = confirmed_.at(relation, d);
    if (static_cast<bool>(is_confirmed) == confirmed) return;
    is_confirmed = confirmed;
    readers_[relation].confirmed += confirmed ? 1U : -1U;
    readers_[relation].last = std::max(readers_[relation].last, now());
  }
  void note(const model::Packet& packet, Number relation) {
    if (packet.kind != PacketKind::heartbeat && packet.kind != PacketKind::data) return;
    judge(relation, now());
    readers_[relation].last = now();
    if (has_bases_) readers_[relation].exist = std::max(readers_[relation].exist, packet.detail);
  }
  void judge(Number relation, Nanoseconds time) {
    const Reader& reader = readers_[relation];
    if (!reader.open || reader.confirmed >= reader.exist) return;
    if (time - reader.last <= patience_) return;
    object(event(), time,
           fmt::format("{} is not reminded between {} and {}.", relation_text(topology(), relation),
                       time_text(reader.last), time_text(time)));
  }
  void expire(Number writer) {
    const Nanoseconds since = expired_[writer];
    expired_[writer] = now();
    const bool single = rules().heartbeat_timer == model::HeartbeatTimerKind::single;
    if (!single || since == never) return;
    if (now() - since >= scenario().dds.sedp.heartbeat_period) return;
    object_now([&] {
      return fmt::format("{} expires at {} and at {}.", writer_text(writer), time_text(since),
                         time_text(now()));
    });
  }

  const bool has_bases_;
  const Nanoseconds patience_;
  RelationValues<char> confirmed_;
  std::vector<Reader> readers_;       // by relation
  std::vector<Nanoseconds> expired_;  // by writer
};

constexpr Law reminders_list[] = {watched_law<ReminderWatch>(
    "law.reminders",
    "A reader that has not confirmed everything hears from its writer at least every τ_H "
    "(adaptive: "
    "the longest period; Fast DDS: or one repair later); expiries of a writer are τ_H apart.",
    is_of_two_writers)};

}  // namespace

std::span<const Law> reminder_laws() { return reminders_list; }

}  // namespace stormproof::props
