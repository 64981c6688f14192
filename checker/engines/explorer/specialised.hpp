// A program as it is explored: specialised for a profile, a scope and the mistakes that are made.
// Knobs are constants, the rows of a machine are merged into where it is fed, procedures and
// occasions into where they are called, and what is read and changed has its place in a state. What
// nobody asks for any more is gone. checker/engines/explorer/specialise.hpp makes it, and
// checker/engines/explorer/rule_runner.hpp runs it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "checker/engines/explorer/slot.hpp"
#include "checker/engines/explorer/world_state.hpp"
#include "fsm/program/program.hpp"

namespace stormproof::explorer {

class RuleRunner;

struct Specialised {
  using Op = fsm::program::Op;
  using Ref = fsm::program::Ref;
  using Register = fsm::program::Register;
  using Tag = fsm::program::Tag;
  static constexpr Ref no_term = fsm::program::no_term;

  /// What a term reads. A packet says something as a flag, as the set of some descriptors, or, if
  /// it is about the first ones, as their number.
  enum class From : std::uint8_t { truth, members, number, host, flag, set, limit, count };

  struct Term {
    Op op{};
    From from{};  ///< of `read`
    Tag tag = fsm::program::no_thing;
    Kept kept{};             ///< of `tag`: of `read`, `pending` and `in_state`
    std::int64_t value = 0;  ///< a constant, a state, a flag of a packet
    Register reg = 0;        ///< of `let`: what was read, or a field of an outbox
    Ref a = no_term;
    Ref b = no_term;
    Ref c = no_term;
  };

  /// Of a machine that is fed, if its guard holds. The first one that fires counts.
  struct Row {
    fsm::StateId source = 0;
    fsm::StateId target = 0;
    Ref guard = no_term;
    std::vector<std::pair<Register, Ref>> out;
  };
  /// What a packet says.
  struct Says {
    From as{};
    std::uint8_t flag = 0;
    Ref value = no_term;
  };
  struct Call;
  /// What a composition leaves to its host, as its packing does it.
  using Action = std::function<void(RuleRunner&, const Call&)>;

  enum class Act : std::uint8_t {
    let,      ///< register `reg` becomes `value`
    decide,   ///< the same of what reading can decide: it is not left out
    when,     ///< the body, if `value`
    reverse,  ///< at the other end
    for_readers,
    for_descriptors,  ///< for which `value`
    for_queue,
    feed,       ///< the machine at `kept`
    feed_one,   ///< that of the descriptor
    feed_each,  ///< those of the descriptors for which `value`; `asked`: who is listed
    set_truth,
    set_number,  ///< unless it is more than `most`
    set_member,  ///< of the descriptor
    set_each,
    set_host,  ///< number `reg` of what the host keeps
    ask,       ///< the writer takes the ACKNACK of its reader
    overflow,  ///< what is not explored: only a mistake gets here
    come,      ///< a timer that is counted is scheduled once less
    schedule,  ///< `event` after `value`, which is counted at `kept`
    emit,
    hear,     ///< the reader has heard of the first descriptors: up to the DATA that it takes, or
              ///< as many as a HEARTBEAT announces
    perform,  ///< `action`, whose contract is the body
    defer,    ///< the body comes after the next effect: a mistake
    go_on     ///< an effect has happened
  };
  struct Step {
    Act act{};
    What event{};
    fsm::program::Owner owner{};  ///< of `schedule`: who has the timer
    bool each = false;            ///< of `schedule`: each relation or writer has one
    bool first_only = false;      ///< of a loop: a mistake
    Tag tag = fsm::program::no_thing;
    Kept kept{};
    Ref value = no_term;
    Ref asked = no_term;
    Register reg = 0;
    std::int64_t most = std::numeric_limits<std::int64_t>::max();
    std::vector<Row> rows{};
    std::vector<Register> outbox{};  ///< the fields that somebody asks for
    std::vector<Says> says{};
    std::vector<Ref> with{};
    Action action{};
    std::vector<Step> body{};
  };
  using Steps = std::vector<Step>;
  struct Call {
    std::array<std::int64_t, 2> arguments{};
    const Steps& contract;
  };

  std::vector<Term> terms;
  std::size_t registers = 0;
  std::array<Steps, static_cast<std::size_t>(What::repair_left)> rules{};  ///< by their events
  /// The ACKNACKs that a reader emits, by whether they are initial, as correct rules do.
  std::array<Steps, 2> acknacks{};

  /// Of what the host makes happen.
  std::vector<std::pair<std::string_view, Steps>> occasions{};

  [[nodiscard]] const Steps& rule(What what) const { return rules[static_cast<std::size_t>(what)]; }
};

}  // namespace stormproof::explorer
