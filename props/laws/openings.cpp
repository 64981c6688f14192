// law.first-words: what a writer says to a reader at once. When its side of the relation opens, a
// HEARTBEAT, and with `initial_data: push` every descriptor once; when an initial ACKNACK calls for
// it, a HEARTBEAT; and Fast DDS's writer pushes what is created to all its readers.
#include <map>
#include <set>

#include <fmt/core.h>

#include "props/laws/families.hpp"
#include "props/laws/sides.hpp"
#include "props/laws/watching.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::props {

namespace {

using model::PacketKind;
using Number = std::uint32_t;

class FirstWordsWatch : public SideWatch {
 public:
  explicit FirstWordsWatch(const model::Scenario& scenario)
      : SideWatch{"law.first-words", scenario},
        creates_{traits_of(scenario).creates_endpoints_over_time},
        pushes_{!creates_ && scenario.dds.sedp.initial_data == model::InitialData::push} {}

  void event_finished(const model::Depths&) override {
    for (const Number relation : to_remind_) {
      if (reminded_.contains(relation)) continue;
      objection(relation, "a HEARTBEAT is due, and none is sent");
    }
    for (const Number relation : to_push_) {
      if (pushed_[relation] == topology().descriptor_count(relation)) continue;
      objection(relation, fmt::format("{} of {} descriptors are pushed", pushed_[relation],
                                      topology().descriptor_count(relation)));
    }
    if (creates_ && kind() == model::EventKind::endpoint_creation) judge_creation();
    to_remind_.clear();
    to_push_.clear();
    reminded_.clear();
    pushed_.clear();
  }
  void emitted(const model::Packet& packet, Number source,
               std::span<const Number> destinations) override {
    for_relations(packet, source, destinations, [&](Number relation) { note(packet, relation); });
  }
  void looped_back(const model::Packet& packet, Number) override {
    note(packet, packet.relation());
  }

 private:
  void writer_opened(Number relation) override {
    to_remind_.insert(relation);
    if (pushes_) to_push_.insert(relation);
  }
  void acknack_taken(const model::Packet& packet) override {
    const bool calls = rules().initial_acknack == model::InitialAckNackReply::heartbeat;
    if (packet.initial_acknack && calls) to_remind_.insert(packet.relation());
  }
  void note(const model::Packet& packet, Number relation) {
    if (packet.kind == PacketKind::heartbeat) reminded_.insert(relation);
    if (packet.kind != PacketKind::data) return;
    if (packet.carries_heartbeat) reminded_.insert(relation);
    pushed_[relation] += packet.descriptors.count();
  }
  void objection(Number relation, std::string_view what) {
    object_now([&] {
      return fmt::format("At {}, {}: {}.", time_text(now()), relation_text(topology(), relation),
                         what);
    });
  }
  /// All readers of one of the streams get it, or nobody is there.
  void judge_creation() {
    const Number i = creator_;
    std::set<Number> open[2];
    for (Number pair = topology().first_pair(i); pair < topology().first_pair(i + 1); ++pair) {
      for (Number stream = 0; stream < 2; ++stream) {
        if (is_writer_open(2 * pair + stream)) open[stream].insert(2 * pair + stream);
      }
    }
    std::set<Number> told;
    for (const auto& [relation, count] : pushed_) {
      if (count != 1) objection(relation, fmt::format("{} descriptors are pushed", count));
      told.insert(relation);
    }
    if (told == open[0] || told == open[1]) return;
    object_now([&] {
      return fmt::format("At {} participant {} has created a descriptor, and tells {} readers.",
                         time_text(now()), i, told.size());
    });
  }

 public:
  void event_started(const model::Event& event) override {
    SideWatch::event_started(event);
    creator_ = event.subject;
  }

 private:
  bool creates_;
  bool pushes_;
  Number creator_ = 0;
  std::set<Number> to_remind_;  // relations, in this event
  std::set<Number> to_push_;
  std::set<Number> reminded_;
  std::map<Number, std::size_t> pushed_;
};

constexpr Law openings_list[] = {watched_law<FirstWordsWatch>(
    "law.first-words",
    "A writer whose side opens sends a HEARTBEAT, and what it pushes, at once; so is an initial "
    "ACKNACK answered, and so does Fast DDS's push what is created to all readers.",
    is_of_two_writers)};

}  // namespace

std::span<const Law> opening_laws() { return openings_list; }

}  // namespace stormproof::props
