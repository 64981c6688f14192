// Laws of obligations: what the rules say must happen, and when. A HEARTBEAT is answered after τ_A,
// a reader that has seen none asks by itself after τ_I, 3·τ_I, 7·τ_I, …, announcements go on, and
// no channel idles while a fragment waits for it.
#include <algorithm>
#include <deque>

#include <fmt/core.h>

#include "props/laws/families.hpp"
#include "props/laws/sides.hpp"
#include "props/laws/watching.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/observer.hpp"

namespace stormproof::props {

namespace {

using model::EventKind;
using model::Nanoseconds;
using model::Packet;
using model::PacketKind;
using model::Scenario;

/// Answers that are due.
class AnswerWatch : public SideWatch {
 public:
  explicit AnswerWatch(const Scenario& scenario) : SideWatch{"law.answers", scenario} {}

  void run_started(const model::Topology& topology) override {
    SideWatch::run_started(topology);
    due_.assign(topology.relation_count(), {});
  }
  void emitted(const Packet& packet, std::uint32_t, std::span<const std::uint32_t>) override {
    note(packet);
  }
  void looped_back(const Packet& packet, std::uint32_t) override { note(packet); }
  void finish(Nanoseconds end) override {
    for (const auto& due : due_) {
      if (due.empty() || due.front() >= end) continue;
      object(event(), end,
             fmt::format("The answer that was due at {} is never sent.", time_text(due.front())));
    }
  }

 private:
  void heartbeat_taken(std::uint32_t relation) override {
    auto& due = due_[relation];
    if (traits_of(scenario()).answers_heartbeats_together && !due.empty()) return;
    due.push_back(now() + scenario().dds.sedp.heartbeat_response_delay);
  }
  void note(const Packet& packet) {
    if (packet.kind != PacketKind::acknack || packet.initial_acknack) return;
    auto& due = due_[packet.relation()];
    if (due.empty() || due.front() != now()) {
      object_now(fmt::format("At {} an ACKNACK for {} is sent; {} was due.", time_text(now()),
                             relation_text(topology(), packet.relation()),
                             due.empty() ? "none" : "one at " + time_text(due.front())));
      return;
    }
    due.pop_front();
  }

  std::vector<std::deque<Nanoseconds>> due_;  // by relation
};

/// Initial ACKNACKs that are due.
class AttemptWatch : public SideWatch {
 public:
  explicit AttemptWatch(const Scenario& scenario)
      : SideWatch{"law.initial-attempts", scenario},
        first_{scenario.dds.sedp.initial_acknack_delay},
        growth_{scenario.dds.sedp.initial_acknack_interval ==
                        model::InitialAckNackInterval::constant
                    ? 1
                    : 2} {}

  void run_started(const model::Topology& topology) override {
    SideWatch::run_started(topology);
    readers_.assign(topology.relation_count(), {});
  }
  void emitted(const Packet& packet, std::uint32_t, std::span<const std::uint32_t>) override {
    note(packet);
  }
  void looped_back(const Packet& packet, std::uint32_t) override { note(packet); }
  void finish(Nanoseconds end) override {
    for (const Reader& reader : readers_) {
      if (!reader.seen) check(reader, end);
    }
  }

 private:
  struct Reader {
    std::optional<Nanoseconds> due;
    Nanoseconds delay;
    bool seen = false;
  };

  void reader_opened(std::uint32_t relation) override {
    if (first_ > Nanoseconds{0}) {
      readers_[relation].due = now() + first_;
      readers_[relation].delay = first_;
    }
  }
  void heartbeat_taken(std::uint32_t relation) override {
    Reader& reader = readers_[relation];
    if (!reader.seen) check(reader, now());
    reader.seen = true;
  }
  void check(const Reader& reader, Nanoseconds until) {
    if (!reader.due || *reader.due >= until) return;
    object_now(fmt::format("The initial ACKNACK that was due at {} is never sent.",
                           time_text(*reader.due)));
  }
  void note(const Packet& packet) {
    if (packet.kind != PacketKind::acknack || !packet.initial_acknack) return;
    Reader& reader = readers_[packet.relation()];
    if (reader.seen || reader.due != now()) {
      object_now(fmt::format("At {} an initial ACKNACK for {} is sent that is not due.",
                             time_text(now()), relation_text(topology(), packet.relation())));
      return;
    }
    reader.delay = reader.delay * growth_;
    reader.due = now() + reader.delay;
  }

  Nanoseconds first_;
  std::int64_t growth_;          // of the delay, from one attempt to the next
  std::vector<Reader> readers_;  // by relation
};

/// Announcements that are due.
class AnnouncementWatch : public Observer {
 public:
  explicit AnnouncementWatch(const Scenario& scenario)
      : Observer{"law.announcements"}, spdp_{scenario.dds.spdp} {
    for (const model::Participant& p : scenario.deployment.participants) {
      announcers_.push_back({p.start, 0});
    }
  }

  void event_started(const model::Event& event) override {
    Observer::event_started(event);
    if (event.kind != EventKind::announcement_due) return;
    Announcer& announcer = announcers_[event.subject];
    if (event.time != announcer.due) {
      object_now(fmt::format("Participant {} announces itself at {} instead of {}.", event.subject,
                             time_text(event.time), time_text(announcer.due)));
    }
    const bool startup = announcer.sent < spdp_.startup_announcements;
    announcer.due += startup ? spdp_.startup_period : spdp_.period;
    ++announcer.sent;
  }
  void finish(Nanoseconds end) override {
    for (const Announcer& announcer : announcers_) {
      if (announcer.due >= end) continue;
      object(event(), end,
             fmt::format("The announcement that was due at {} is never sent.",
                         time_text(announcer.due)));
    }
  }

 private:
  struct Announcer {
    Nanoseconds due;
    std::uint32_t sent = 0;
  };
  model::SpdpProfile spdp_;
  std::vector<Announcer> announcers_;
};

/// Fragments that wait for a channel.
class IdleWatch : public Observer {
 public:
  explicit IdleWatch(const Scenario&) : Observer{"law.work-conserving"} {}

  void event_started(const model::Event& event) override {
    if (event.time > now()) check(event.time);
    Observer::event_started(event);
  }
  void service_started(std::uint32_t channel, std::uint32_t, const Packet&, std::uint32_t,
                       Nanoseconds until) override {
    if (at(channel).busy_until > now()) {
      object_now(fmt::format("At {} channel {} serves two fragments.", time_text(now()), channel));
    }
    at(channel).busy_until = until;
  }
  void waiting_changed(std::uint32_t channel, std::uint64_t fragments) override {
    at(channel).waiting = fragments;
    at(channel).changed = now();
  }
  void finish(Nanoseconds end) override { check(end); }

 private:
  struct Channel {
    Nanoseconds busy_until;
    Nanoseconds changed;  ///< who waits: at this instant it may be served yet
    std::uint64_t waiting = 0;
  };
  Channel& at(std::uint32_t channel) {
    if (channel >= channels_.size()) channels_.resize(channel + 1);
    return channels_[channel];
  }
  void check(Nanoseconds next) {
    for (const Channel& channel : channels_) {
      if (channel.waiting == 0 || std::max(channel.busy_until, channel.changed) >= next) continue;
      object_now(fmt::format("Up to {} a channel idles while {} fragments wait for it.",
                             time_text(next), channel.waiting));
    }
  }

  std::vector<Channel> channels_;
};

constexpr Law obligations_list[] = {
    watched_law<AnswerWatch>(
        "law.answers",
        "A HEARTBEAT at an open reader side is answered by one ACKNACK τ_A later, and no other "
        "ACKNACK is sent (Fast DDS: one answer to all that came meanwhile).",
        is_of_two_writers),
    watched_law<AttemptWatch>(
        "law.initial-attempts",
        "A reader asks by itself τ_I, 3·τ_I, 7·τ_I, … (with a constant interval τ_I, 2·τ_I, "
        "3·τ_I, …) after it opened, until it has seen a HEARTBEAT.",
        is_of_two_writers),
    watched_law<AnnouncementWatch>(
        "law.announcements",
        "Every participant announces itself at the times that the profile says.",
        is_of_two_writers),
    watched_law<IdleWatch>(
        "law.work-conserving",
        "No channel idles while a fragment waits for it, and none serves two at a time.",
        is_shared),
};

}  // namespace

std::span<const Law> obligation_laws() { return obligations_list; }

}  // namespace stormproof::props
