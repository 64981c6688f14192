// Runs the counterexample once more and follows the transitions. Initial states come from the
// reflected tables.
#include "checker/verification/counterexample/machine_states.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "checker/verification/counterexample/acts.hpp"
#include "checker/verification/counterexample/history.hpp"
#include "checker/verification/counterexample/relevance.hpp"
#include "fsm/machines.hpp"
#include "model/engine/packet.hpp"
#include "model/simulator.hpp"

namespace stormproof::counterexample {

namespace {

using Kind = model::MachineRef::Kind;
using Words = std::vector<std::uint64_t>;

std::string_view initial_state(std::string_view machine) {
  static const std::vector<fsm::MachineInfo> all = fsm::machines();
  const auto found = std::ranges::find(all, machine, &fsm::MachineInfo::name);
  return found == all.end() ? std::string_view{} : found->states[found->initial];
}

/// One machine of one subject. A machine of descriptors has one state for each of them.
struct Followed {
  std::string_view state;
  std::map<std::string_view, Words> descriptors;  // state → members
};

class Follower final : public model::Probe {
 public:
  Follower(const History& history, std::set<std::uint32_t> relations,
           std::span<const std::uint64_t> events)
      : history_{history}, relations_{std::move(relations)}, events_{events} {
    for (const std::uint32_t relation : relations_) {
      writers_.insert(2 * history_.topology.pair(relation / 2).source + relation % 2);
      received_[relation].resize(model::words_for(history_.topology.descriptor_count(relation)));
    }
  }

  void event_finished(const model::Depths&) override {
    if (done_ < events_.size() && events_[done_] == event_) {
      shown_.push_back(rows());
      ++done_;
    }
    ++event_;
  }

  void received(const model::Packet& packet, std::uint32_t) override {
    arriving_.clear();
    if (packet.kind != model::PacketKind::data) return;
    arriving_.resize(packet.descriptors.end_word());
    for (std::uint32_t k = 0; k < arriving_.size(); ++k) arriving_[k] = packet.descriptors.word(k);
  }

  void transition(const model::Transition& fired) override {
    if (!concerns(fired.machine)) return;
    if (fired.event == "DataReceived") take_data(fired.machine.subject);
    Followed& followed =
        machines_[{fired.machine.kind, fired.machine.subject, fired.machine.machine}];
    if (fired.descriptors == 0) {
      followed.state = fired.after;
      return;
    }
    move(followed, fired.machine, fired.before, fired.after, fired.first_word, fired.descriptors);
  }

  std::vector<std::vector<StateRow>> run(const model::Scenario& scenario) && {
    if (events_.empty()) return {};
    model::RunOptions options;
    options.probe = this;
    options.max_events = events_.back() + 1;
    static_cast<void>(simulate(scenario, options));
    complete();
    return std::move(shown_);
  }

 private:
  using Key = std::tuple<Kind, std::uint32_t, std::string_view>;

  [[nodiscard]] bool concerns(const model::MachineRef& machine) const {
    return (machine.kind == Kind::relation && relations_.contains(machine.subject)) ||
           (machine.kind == Kind::writer && writers_.contains(machine.subject));
  }

  void take_data(std::uint32_t relation) {
    const auto found = received_.find(relation);
    if (found == received_.end()) return;
    Words& have = found->second;
    for (std::size_t k = 0; k < std::min(have.size(), arriving_.size()); ++k) {
      have[k] |= arriving_[k];
    }
    arriving_.clear();
  }

  void move(Followed& followed, const model::MachineRef& machine, std::string_view before,
            std::string_view after, std::uint32_t word, std::uint64_t descriptors) {
    const std::size_t words = received_.contains(machine.subject)
                                  ? received_[machine.subject].size()
                                  : std::size_t{word} + 1;
    auto& sets = followed.descriptors;
    if (sets.empty()) sets[initial_state(machine.machine)] = everything(machine.subject, words);
    for (const std::string_view state : {before, after}) {
      sets[state].resize(std::max<std::size_t>(sets[state].size(), word + 1));
    }
    sets[before][word] &= ~descriptors;
    sets[after][word] |= descriptors;
  }

  [[nodiscard]] Words everything(std::uint32_t relation, std::size_t words) const {
    Words all(words);
    const std::uint32_t count = history_.topology.descriptor_count(relation);
    for (std::uint32_t d = 0; d < count && d / 64 < words; ++d) {
      all[d / 64] |= std::uint64_t{1} << d % 64;
    }
    return all;
  }

  [[nodiscard]] std::string owner(Kind kind, std::uint32_t subject) const {
    if (kind == Kind::writer) {
      return fmt::format("{} writer of participant {}", stream_name(subject), subject / 2);
    }
    const model::Pair& pair = history_.topology.pair(subject / 2);
    return fmt::format("relation {}→{} {}", pair.source, pair.destination, stream_name(subject));
  }

  [[nodiscard]] std::vector<StateRow> rows() const {
    std::vector<StateRow> rows;
    for (const auto& [key, followed] : machines_) {
      const auto& [kind, subject, machine] = key;
      StateRow row{owner(kind, subject), std::string{machine}, std::string{followed.state}, {}};
      if (followed.descriptors.empty()) row.states.emplace_back(followed.state);
      for (const auto& [state, members] : followed.descriptors) {
        const std::string list = members_text(members);
        if (list.empty()) continue;
        row.text += fmt::format("{}{} {}", row.text.empty() ? "" : "; ", state, list);
        row.states.emplace_back(state);
      }
      rows.push_back(std::move(row));
    }
    for (const auto& [relation, have] : received_) {
      const std::string list = members_text(have);
      rows.push_back(
          {owner(Kind::relation, relation), "received", list.empty() ? "nothing" : list, {}});
    }
    return rows;
  }

  /// Machines that move later are in their initial state before; then what has moved since.
  void complete() {
    if (shown_.empty()) return;
    const std::vector<StateRow> last = shown_.back();
    const std::vector<StateRow>* before = nullptr;
    for (std::vector<StateRow>& rows : shown_) {
      std::vector<StateRow> all;
      for (const StateRow& wanted : last) {
        const auto same = [&](const StateRow& row) {
          return row.owner == wanted.owner && row.machine == wanted.machine;
        };
        const auto known = std::ranges::find_if(rows, same);
        const std::string start{initial_state(wanted.machine)};
        all.push_back(known != rows.end() ? *known
                                          : StateRow{wanted.owner, wanted.machine, start, {start}});
        if (before != nullptr) all.back().moved = (*before)[all.size() - 1].text != all.back().text;
      }
      rows = std::move(all);
      before = &rows;
    }
  }

  const History& history_;
  std::set<std::uint32_t> relations_;
  std::set<std::uint32_t> writers_;
  std::span<const std::uint64_t> events_;
  std::size_t done_ = 0;
  std::uint64_t event_ = 0;
  std::map<Key, Followed> machines_;
  std::map<std::uint32_t, Words> received_;  // relation → descriptors
  Words arriving_;                           // the DATA that is being received
  std::vector<std::vector<StateRow>> shown_;
};

}  // namespace

std::vector<std::vector<StateRow>> states_after(const props::Counterexample& counterexample,
                                                std::span<const std::uint64_t> events,
                                                std::size_t relations) {
  const History history = record(counterexample);
  std::set<std::uint32_t> chosen;
  for (const std::uint32_t relation : relevance_of(history).relations) {
    if (chosen.size() < relations) chosen.insert(relation);
  }
  return Follower{history, std::move(chosen), events}.run(counterexample.scenario);
}

}  // namespace stormproof::counterexample
