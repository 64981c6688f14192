// The paper's states of descriptors towards one reader (U R Q S A), for a relation of four
// descriptors, against the rules about ACKNACKs, repairs and suppression; and the same of a reader
// that may forget.
#include <algorithm>
#include <deque>
#include <type_traits>

#include "fsm/descriptor_repair.hpp"
#include "fsm/reopening_repair.hpp"
#include "tests/fsm/stateful/machine_subject.hpp"

namespace stormproof::fsm::stateful {

namespace {

constexpr std::size_t descriptors = 4;
constexpr std::int64_t any_set = (1 << descriptors) - 1;

bool has(std::int64_t set, std::size_t d) { return (set >> d & 1) != 0; }
std::size_t lowest(std::int64_t set) {
  std::size_t d = 0;
  while (d < descriptors && !has(set, d)) ++d;
  return d;
}

// ---- The paper. What the relation does besides changing states: how many repair generations and
// suppression ends are pending, and which repair packets are at the source.

enum RepairCall : std::size_t {
  acknack,
  generation,
  left_source,
  suppression_ended,
  reader_forgot,
  requested_again
};

struct Relation {
  int generations = 0;
  int suppressions = 0;
  std::deque<std::int64_t> packets;
  int arms = 0;

  [[nodiscard]] std::string in_words_with(const std::string& states) const {
    return states + ", generations " + std::to_string(generations) + ", suppressions " +
           std::to_string(suppressions) + ", packets " + in_words(packets) + ", arms " +
           std::to_string(arms);
  }
};

class PaperRules final : public PlainModel<PaperRules> {
 public:
  [[nodiscard]] bool possible(const Call& call) const override {
    if (call.event == generation) return relation_.generations > 0;
    if (call.event == left_source) return !relation_.packets.empty();
    if (call.event == suppression_ended) return relation_.suppressions > 0;
    return true;
  }
  std::string react(const Call& call) override {
    switch (call.event) {
      case acknack:
        take_acknack(call.payload[0], call.payload[1] == 1);
        break;
      case generation:
        generate(call.payload[0] == 1);
        break;
      case left_source:
        for (std::size_t d = 0; d < descriptors; ++d) {
          if (has(relation_.packets.front(), d) && states_[d] == 'Q') states_[d] = 'S';
        }
        relation_.packets.pop_front();
        ++relation_.suppressions;
        break;
      case reader_forgot:
        std::replace(states_.begin(), states_.end(), 'A', 'U');
        break;
      case requested_again:
        request_again(call.payload[0]);
        break;
      default:
        --relation_.suppressions;
        if (states_.find('S') != std::string::npos) ++relation_.arms;
        std::replace(states_.begin(), states_.end(), 'S', 'U');
    }
    return relation_.in_words_with(states_);
  }

 private:
  void take_acknack(std::int64_t bitmap, bool prefix) {
    bool asked = false;
    for (std::size_t d = 0; d < descriptors; ++d) {
      char& state = states_[d];
      if (has(bitmap, d)) {
        asked = asked || state == 'U';
        if (state == 'U') state = 'R';
      } else if (!prefix || d < lowest(bitmap)) {
        state = 'A';
      }
    }
    if (asked) ++relation_.generations;
  }
  void request_again(std::int64_t bitmap) {
    bool asked = false;
    for (std::size_t d = 0; d < descriptors; ++d) {
      if (!has(bitmap, d) || states_[d] != 'A') continue;
      states_[d] = 'R';
      asked = true;
    }
    if (asked) ++relation_.generations;
  }
  void generate(bool one_each) {
    --relation_.generations;
    std::int64_t together = 0;
    for (std::size_t d = 0; d < descriptors; ++d) {
      if (states_[d] != 'R') continue;
      states_[d] = 'Q';
      if (one_each) relation_.packets.push_back(std::int64_t{1} << d);
      together |= std::int64_t{1} << d;
    }
    if (!one_each && together != 0) relation_.packets.push_back(together);
  }

  std::string states_ = std::string(descriptors, 'U');
  Relation relation_;
};

template <class Machine>
class PaperMachines final : public Reactor {
 public:
  explicit PaperMachines(Mutations mutations) : machine_{mutations} {}
  std::string react(const Call& call) override {
    using namespace descriptor_repair;
    switch (call.event) {
      case acknack: {
        bool asked = false;
        for (std::size_t d = 0; d < descriptors; ++d) {
          const auto output = machine_.template step<AckNackReceived>(
              states_[d], {.listed = has(call.payload[0], d),
                           .below_first_missing = d < lowest(call.payload[0]),
                           .prefix_only = call.payload[1] == 1});
          asked = asked || output.requested;
        }
        relation_.generations += asked ? 1 : 0;
        break;
      }
      case generation: {
        --relation_.generations;
        std::int64_t together = 0;
        for (std::size_t d = 0; d < descriptors; ++d) {
          if (!machine_.template step<RepairDue>(states_[d]).generate) continue;
          if (call.payload[0] == 1) relation_.packets.push_back(std::int64_t{1} << d);
          together |= std::int64_t{1} << d;
        }
        if (call.payload[0] == 0 && together != 0) relation_.packets.push_back(together);
        break;
      }
      case left_source:
        for (std::size_t d = 0; d < descriptors; ++d) {
          if (has(relation_.packets.front(), d)) machine_.template step<RepairSent>(states_[d]);
        }
        relation_.packets.pop_front();
        ++relation_.suppressions;
        break;
      case reader_forgot:
      case requested_again:
        if constexpr (std::is_same_v<Machine, ReopeningRepair>) take_back(call);
        break;
      default: {
        --relation_.suppressions;
        bool returned = false;
        for (StateId& state : states_) {
          returned = machine_.template step<SuppressionEnded>(state).returned || returned;
        }
        relation_.arms += returned ? 1 : 0;
      }
    }
    std::string text;
    for (const StateId state : states_) text += machine_.name(state);
    return relation_.in_words_with(text);
  }

 private:
  void take_back(const Call& call) {
    bool asked = false;
    for (std::size_t d = 0; d < descriptors; ++d) {
      if (call.event == reader_forgot) {
        machine_.template step<reopening_repair::ReaderForgot>(states_[d]);
      } else if (has(call.payload[0], d)) {
        const auto output = machine_.template step<reopening_repair::RequestedAgain>(states_[d]);
        asked = asked || output.requested;
      }
    }
    relation_.generations += asked ? 1 : 0;
  }

  Stepper<Machine> machine_;
  std::vector<StateId> states_ = std::vector<StateId>(descriptors, Stepper<Machine>::initial);
  Relation relation_;
};

}  // namespace

std::vector<MachineSubject> repair_subjects() {
  const std::vector<EventShape> events{{"ACKNACK (bitmap, prefix)", {any_set, 1}},
                                       {"repair generation (one packet each)", {1}},
                                       {"repair packet leaves its source"},
                                       {"suppression end"}};
  std::vector<EventShape> with_forgetting = events;
  with_forgetting.push_back({"the reader forgot"});
  with_forgetting.push_back({"request for what is acknowledged (bitmap)", {any_set}});
  return {machine_subject(
              "DescriptorRepair", "DescriptorRepair", events,
              [] { return std::make_unique<PaperRules>(); },
              [](Mutations m) { return std::make_unique<PaperMachines<DescriptorRepair>>(m); }),
          machine_subject(
              "ReopeningRepair", "ReopeningRepair", with_forgetting,
              [] { return std::make_unique<PaperRules>(); },
              [](Mutations m) { return std::make_unique<PaperMachines<ReopeningRepair>>(m); }),
          change_subject()};
}

}  // namespace stormproof::fsm::stateful
