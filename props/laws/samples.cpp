// law.samples: what participants ask and answer about types goes to everybody whom they know, or to
// one where it is filtered, in the order of its numbers, and each number once; receivers
// acknowledge what has come, and as long as somebody has not acknowledged everything that went to
// it all are told every τ_L.
#include <algorithm>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "props/laws/asking.hpp"
#include "props/laws/families.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::props {

namespace {

using model::EventKind;
using model::Nanoseconds;
using model::PacketKind;
using Number = std::uint32_t;

class SampleWatch : public AskingWatch {
 public:
  explicit SampleWatch(const model::Scenario& scenario)
      : AskingWatch{"law.samples", scenario},
        period_{scenario.dds.version.typelookup_heartbeat_period},
        filter_{scenario.dds.version.typelookup_filter} {}

  void run_started(const model::Topology& topology) override {
    AskingWatch::run_started(topology);
    writers_.assign(fastdds::control_writers * std::size_t{topology.participant_count()}, {});
    readers_.assign(control().count(), {});
  }
  void event_started(const model::Event& event) override {
    if (event.time > now()) judge_reminders(event.time);
    AskingWatch::event_started(event);
  }
  void event_finished(const model::Depths&) override {
    for (const Number writer : busy_) judge(writer);
    busy_.clear();
  }
  void finish(Nanoseconds end) override { judge_reminders(end); }
  void received(const model::Packet& packet, Number receiver) override {
    AskingWatch::received(packet, receiver);
    if (!is_of_lookups(packet)) return;
    Reader& reader = readers_[packet.detail];
    if (packet.kind != PacketKind::user_acknack) {
      if (has_recognised(packet.pair)) reader.got = std::max(reader.got, packet.last_sample());
    } else if (!packet.initial_acknack && reader.is_matched) {
      reader.acknowledged = std::max(reader.acknowledged, packet.last_sample());
    }
  }

 private:
  struct Writer {
    Number sent = 0;
    std::optional<Nanoseconds> due;  ///< somebody lacks something: the next HEARTBEAT, at latest
    std::optional<Nanoseconds> reminded;
  };
  struct Reader {
    bool is_matched = false;
    Number told = 0;           ///< the last sample that went to it
    Number got = 0;            ///< as samples and HEARTBEATs that it has taken say
    Number acknowledged = 0;   ///< as its writer knows
    bool is_reminded = false;  ///< in this event
  };

  /// Its writers have a reader more; what they have sent before is not for it.
  void recognised(Number pair) override {
    if (!asks()) return;
    const Number back = topology().pair(pair).reverse;
    for (const Number topic : fastdds::topic::lookups) {
      const Number relation = control().find(back, topic);
      const Number sent = writers_[control().writer_of(relation)].sent;
      readers_[relation] = {true, sent, readers_[relation].got, sent};
    }
  }
  void said(const model::Packet& packet) override {
    const Number number = control().writer_of(packet.detail);
    Writer& writer = writers_[number];
    Reader& reader = readers_[packet.detail];
    const Number last = packet.last_sample();
    if (packet.kind == PacketKind::user_acknack) {
      if (!packet.initial_acknack && last != reader.got) wrong(number, "are acknowledged", last);
      return;
    }
    busy_.insert(number);
    if (packet.kind == PacketKind::user_heartbeat) {
      reader.is_reminded = true;
      const bool is_packing = kind() == EventKind::async_run;  // others may follow
      if (last != writer.sent && !is_packing) wrong(number, "are announced", last);
      return;
    }
    const bool is_filtered = filters(number);
    const Number before = is_filtered ? writer.sent : reader.told;
    if (last - packet.samples() != before) wrong(number, "are sent in their order", last);
    if (last > writer.sent && !lacks(number)) writer.due = now() + period_;
    writer.sent = std::max(writer.sent, last);
    reader.told = last;
  }
  void wrong(Number writer, std::string_view what, Number last) {
    object_now(fmt::format("At {} of {} {} of participant {} not all {}.", time_text(now()), last,
                           fastdds::control_writer_names[writer % fastdds::control_writers],
                           writer / fastdds::control_writers, what));
  }

  /// Its samples go to one reader each.
  [[nodiscard]] bool filters(Number writer) const {
    using enum model::LookupFilter;
    return filter_ == all || (filter_ == answers && writer % fastdds::control_writers == 1);
  }
  template <class Visit>
  void for_readers(Number writer, Visit&& visit) {
    const Number i = writer / fastdds::control_writers;
    const Number topic = fastdds::topic::lookups[writer % fastdds::control_writers];
    for (Number pair = topology().first_pair(i); pair < topology().first_pair(i + 1); ++pair) {
      Reader& reader = readers_[control().find(pair, topic)];
      if (reader.is_matched) visit(reader);
    }
  }
  /// Whether somebody has not acknowledged everything.
  [[nodiscard]] bool lacks(Number writer) {
    bool does = false;
    for_readers(writer,
                [&](const Reader& reader) { does = does || reader.acknowledged < reader.told; });
    return does;
  }
  /// Of a writer that has said something in this event.
  void judge(Number number) {
    Writer& writer = writers_[number];
    bool all_reminded = true;
    for_readers(number, [&](Reader& reader) {
      const bool is_for_all = !filters(number);
      if (is_for_all && reader.told != writer.sent) wrong(number, "go to everybody", writer.sent);
      all_reminded = std::exchange(reader.is_reminded, false) && all_reminded;
    });
    if (kind() != EventKind::lookup_expiry) return;
    const bool too_soon = writer.reminded && now() < *writer.reminded + period_;
    if (!all_reminded || too_soon || !lacks(number)) {
      wrong(number, "are announced when and to whom it is due", writer.sent);
    }
    writer.reminded = now();
    writer.due = now() + period_;
  }
  /// Before it is `time`.
  void judge_reminders(Nanoseconds time) {
    for (Number number = 0; number < writers_.size(); ++number) {
      Writer& writer = writers_[number];
      if (!writer.due || *writer.due >= time) continue;
      if (lacks(number)) wrong(number, "are announced in time", writer.sent);
      writer.due.reset();
    }
  }

  const Nanoseconds period_;
  const model::LookupFilter filter_;
  std::vector<Writer> writers_;  // of questions, of answers and others of each participant
  std::vector<Reader> readers_;  // by control-only relation
  std::set<Number> busy_;        // writers, in this event
};

constexpr Law samples_list[] = {asking_law<SampleWatch>(
    "law.samples",
    "Questions and answers about types go to everybody, or where they are filtered to one, each "
    "once and in order, and are announced every τ_L until all have acknowledged what went to "
    "them.")};

}  // namespace

std::span<const Law> sample_laws() { return samples_list; }

}  // namespace stormproof::props
