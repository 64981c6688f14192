// law.introductions: who announces itself to whom. An announcement that is due goes to everybody,
// and to each participant that is known; whoever is recognised gets at once what `spdp.resend`
// says; and nobody announces itself otherwise.
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

class IntroductionWatch : public SideWatch {
 public:
  explicit IntroductionWatch(const model::Scenario& scenario)
      : SideWatch{"law.introductions", scenario} {}

  void event_started(const model::Event& event) override {
    SideWatch::event_started(event);
    if (event.kind == model::EventKind::announcement_due) announce(event.subject, true);
  }
  void event_finished(const model::Depths&) override {
    for (const auto& [participant, words] : due_) {
      if (words == sent_[participant]) continue;
      object_now([&] {
        return fmt::format("At {} participant {} sends {}; {} are due.", time_text(now()),
                           participant, in_words(sent_[participant]), in_words(words));
      });
    }
    for (const auto& [participant, words] : sent_) {
      if (due_.contains(participant)) continue;
      object_now([&] {
        return fmt::format("At {} participant {} sends {}, which are not due.", time_text(now()),
                           participant, in_words(words));
      });
    }
    due_.clear();
    sent_.clear();
  }
  void emitted(const model::Packet& packet, Number source,
               std::span<const Number> destinations) override {
    if (packet.kind == PacketKind::spdp_multicast) ++sent_[source].to_all;
    if (packet.kind != PacketKind::spdp_unicast) return;
    sent_[source].copies_to.insert(destinations.begin(), destinations.end());
  }
  void looped_back(const model::Packet& packet, Number receiver) override {
    if (packet.kind == PacketKind::spdp_multicast) sent_[packet.pair].looped_to.insert(receiver);
    if (packet.kind != PacketKind::spdp_unicast) return;
    sent_[topology().pair(packet.pair).source].copies_to.insert(receiver);
  }

 private:
  /// What one participant sends in an event.
  struct Words {
    Number to_all = 0;
    std::multiset<Number> looped_to;  ///< the same, to those of its host
    std::multiset<Number> copies_to;
    bool operator==(const Words&) const = default;
  };
  static std::string in_words(const Words& words) {
    return fmt::format("{} announcements to all and {} copies", words.to_all,
                       words.copies_to.size());
  }

  /// j has recognised i.
  void recognised(Number pair) override {
    const Number i = topology().pair(pair).source;
    const Number j = topology().pair(pair).destination;
    using enum model::SpdpResend;
    const model::SpdpResend resend = scenario().dds.spdp.resend;
    if (resend == all_known || resend == new_and_multicast) announce(j, resend == all_known);
    if (resend == new_and_multicast || resend == new_only) due_[j].copies_to.insert(i);
  }
  void announce(Number i, bool with_copies) {
    Words& words = due_[i];
    ++words.to_all;
    for (Number pair = topology().first_pair(i); pair < topology().first_pair(i + 1); ++pair) {
      const Number peer = topology().pair(pair).destination;
      if (!topology().pair(pair).cross_host) words.looped_to.insert(peer);
      const bool known = has_recognised(topology().pair(pair).reverse);
      if (with_copies && known) words.copies_to.insert(peer);
    }
  }

  std::map<Number, Words> due_;  // in this event, by participant
  std::map<Number, Words> sent_;
};

bool announces_to_the_group(const model::Scenario& scenario) {
  return is_of_two_writers(scenario) && scenario.dds.discovery != model::Discovery::static_peers;
}

constexpr Law introductions_list[] = {watched_law<IntroductionWatch>(
    "law.introductions",
    "An announcement goes to all and to each participant that is known; whoever is recognised gets "
    "what spdp.resend says, at once; nobody announces itself otherwise.",
    announces_to_the_group)};

}  // namespace

std::span<const Law> introduction_laws() { return introductions_list; }

}  // namespace stormproof::props
