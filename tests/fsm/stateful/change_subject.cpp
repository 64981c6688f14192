// Fast DDS's states of descriptors towards one reader, for a writer with four descriptors, against
// its rules about creation, ACKNACKs, repairs and suppression.
#include <algorithm>

#include "fsm/change_for_reader.hpp"
#include "tests/fsm/stateful/machine_subject.hpp"

namespace stormproof::fsm::stateful {

namespace {

constexpr std::size_t descriptors = 4;
constexpr std::int64_t any_set = (1 << descriptors) - 1;

bool has(std::int64_t set, std::size_t d) { return (set >> d & 1) != 0; }
// ---- Fast DDS. Descriptors come into being one by one; a descriptor that exists when the reader
// matches is U, a later one is pushed at once; whoever is requested joins the async queue when the
// nack response is due, and suppression begins with the serialization.

enum ChangeCall : std::size_t { matched, created, nack, initial_nack, response, run, ended };

struct Writer {
  std::size_t existing = 0;
  bool is_matched = false;
  bool response_pending = false;
  bool suppression_pending = false;
  std::vector<std::size_t> queue;

  [[nodiscard]] bool possible(const Call& call) const {
    switch (call.event) {
      case matched:
        return !is_matched;
      case created:
        return existing < descriptors;
      case response:
        return response_pending;
      case run:
        return !queue.empty();
      case ended:
        return suppression_pending;
      case nack:  // asks for what is announced only
        return is_matched && call.payload[0] <= static_cast<std::int64_t>(existing) &&
               call.payload[1] >> existing == 0;
      default:
        return is_matched;
    }
  }
  [[nodiscard]] std::string in_words_with(const std::string& states) const {
    return states + (response_pending ? ", response pending" : "") +
           (suppression_pending ? ", suppression pending" : "") + ", queue " + in_words(queue);
  }
};

class FastddsRules final : public PlainModel<FastddsRules> {
 public:
  [[nodiscard]] bool possible(const Call& call) const override { return writer_.possible(call); }
  std::string react(const Call& call) override {
    if (call.event == matched) {
      writer_.is_matched = true;
      for (std::size_t d = 0; d < writer_.existing; ++d) states_[d] = 'U';
    } else if (call.event == created) {
      if (writer_.is_matched) serialize(writer_.existing);
      ++writer_.existing;
    } else if (call.event == nack) {
      take_nack(static_cast<std::size_t>(call.payload[0]), call.payload[1]);
    } else if (call.event == initial_nack) {
      std::replace(states_.begin(), states_.end(), 'A', 'U');
    } else if (call.event == response) {
      writer_.response_pending = false;
      for (std::size_t d = 0; d < writer_.existing; ++d) {
        if (states_[d] != 'R') continue;
        states_[d] = 'Q';
        const auto& queue = writer_.queue;
        if (std::find(queue.begin(), queue.end(), d) == queue.end()) writer_.queue.push_back(d);
      }
    } else if (call.event == run) {
      for (const std::size_t d : writer_.queue) {
        if (states_[d] == 'Q') serialize(d);
      }
      writer_.queue.clear();
    } else {
      writer_.suppression_pending = false;
      std::replace(states_.begin(), states_.end(), 'S', 'U');
    }
    return writer_.in_words_with(states_);
  }

 private:
  void serialize(std::size_t d) {
    states_[d] = 'S';
    writer_.suppression_pending = true;
  }
  void take_nack(std::size_t base, std::int64_t bitmap) {
    for (std::size_t d = 0; d < base; ++d) states_[d] = 'A';
    for (std::size_t d = base; d < writer_.existing; ++d) {
      if (!has(bitmap, d) || states_[d] != 'U') continue;
      states_[d] = 'R';
      writer_.response_pending = true;
    }
  }

  std::string states_ = std::string(descriptors, '-');
  Writer writer_;
};

class FastddsMachines final : public Reactor {
 public:
  explicit FastddsMachines(Mutations mutations) : machine_{mutations} {}
  std::string react(const Call& call) override {
    using namespace change_for_reader;
    if (call.event == matched) {
      writer_.is_matched = true;
      for (std::size_t d = 0; d < writer_.existing; ++d) machine_.step<ReaderMatched>(states_[d]);
    } else if (call.event == created) {
      StateId& state = states_[writer_.existing++];
      if (writer_.is_matched) {
        machine_.step<Created>(state);
        serialize(state);
      }
    } else if (call.event == nack) {
      for (std::size_t d = 0; d < writer_.existing; ++d) {
        const auto output = machine_.step<AckNackReceived>(
            states_[d], {.listed = has(call.payload[1], d),
                         .below_base = static_cast<std::int64_t>(d) < call.payload[0]});
        writer_.response_pending = writer_.response_pending || output.requested;
      }
    } else if (call.event == initial_nack) {
      for (std::size_t d = 0; d < writer_.existing; ++d)
        machine_.step<InitialAckNackReceived>(states_[d]);
    } else if (call.event == response) {
      respond();
    } else if (call.event == run) {
      for (const std::size_t d : writer_.queue) {
        if (machine_.name(states_[d]) == "Q") serialize(states_[d]);
      }
      writer_.queue.clear();
    } else {
      writer_.suppression_pending = false;
      for (std::size_t d = 0; d < writer_.existing; ++d)
        machine_.step<SuppressionEnded>(states_[d]);
    }
    std::string text;
    for (const StateId state : states_) {
      text += machine_.name(state) == "Absent" ? "-" : machine_.name(state);
    }
    return writer_.in_words_with(text);
  }

 private:
  void serialize(StateId& state) {
    machine_.step<change_for_reader::Serialized>(state);
    writer_.suppression_pending = true;
  }
  void respond() {
    writer_.response_pending = false;
    auto& queue = writer_.queue;
    for (std::size_t d = 0; d < writer_.existing; ++d) {
      if (!machine_.step<change_for_reader::NackResponseDue>(states_[d]).enqueue) continue;
      if (std::find(queue.begin(), queue.end(), d) == queue.end()) queue.push_back(d);
    }
  }

  Stepper<ChangeForReader> machine_;
  std::vector<StateId> states_ =
      std::vector<StateId>(descriptors, Stepper<ChangeForReader>::initial);
  Writer writer_;
};

}  // namespace

MachineSubject change_subject() {
  return machine_subject(
      "ChangeForReader", "ChangeForReader",
      {{"match"},
       {"creation"},
       {"ACKNACK (base, bitmap)", {std::int64_t{descriptors}, any_set}},
       {"initial ACKNACK"},
       {"nack response"},
       {"async run"},
       {"suppression end"}},
      [] { return std::make_unique<FastddsRules>(); },
      [](Mutations m) { return std::make_unique<FastddsMachines>(m); });
}

}  // namespace stormproof::fsm::stateful
