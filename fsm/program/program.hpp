// A composition as a program: every rule a list of steps, every condition and value a term, every
// machine rows with guards and actions as terms. It is recorded once from the rules as they are
// written (fsm/program/recorder.hpp); whoever reads a program needs no template and nothing of
// Boost.MSM: words, proofs, SPIN and the explorer are readers, and know no vendor. Only the
// simulator runs the rules compiled.
//
// How it is to be read:
//   * A term has no time: it is evaluated where it stands. What a rule reads is therefore a step of
//     its own, `let`, and terms refer to its register; `const auto open = w(WriterOpen{})` is what
//     it was then, whatever the rule changes after it. A term about a descriptor or a reader (the
//     rule has a function of it there: `inner` below) and the definition of a fact contain no
//     registers of their own: they read at the place for which they are evaluated.
//   * Within one evaluation of such a term a Ref has one value, however often it is used: a
//   `choice`
//     that is named once is one unknown.
//   * Registers are global to a program, because no rule runs within itself. Those of procedures
//     are set by their callers, by position.
//   * What an outbox does not ask for is false or 0, by the sort of its field.
//   * Knobs and facts are things like others: reading a fact is evaluating its definition, here.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fsm/composition/effect_mutation.hpp"
#include "fsm/composition/owner.hpp"
#include "fsm/machine_info.hpp"
#include "fsm/table_mutation.hpp"

namespace stormproof::fsm::program {

using composition::EffectKey;
using composition::Owner;

using Ref = std::uint32_t;       ///< of a term
using Tag = std::uint16_t;       ///< of a thing
using Register = std::uint32_t;  ///< what was read, an outbox, a part of a set, a parameter
inline constexpr Ref no_term = UINT32_MAX;
inline constexpr Tag no_thing = UINT16_MAX;

enum class Sort : std::uint8_t { truth, number };

/// What a rule speaks of, by its name.
struct Thing {
  enum class Kind : std::uint8_t {
    part,  ///< a machine in its place
    timer,
    flag,              ///< state, a truth value
    number,            ///< state, a number
    fact,              ///< what follows from the state
    toggle,            ///< a knob, a truth value
    delay,             ///< a knob, a number
    answer,            ///< what only a host knows, a truth value
    amount,            ///< the same, a number
    descriptor_field,  ///< of a packet: a truth value of each descriptor
    packet_field,      ///< a truth value
    packet_number,
    packet,
    occasion,
    procedure,  ///< effects that several rules have
    opaque      ///< a step that a host may do in its own way
  };
  Kind kind{};
  std::string_view name{};
  std::string_view full_name{};  ///< with its namespaces: unique over all compositions
  Owner owner{};
  std::size_t machine = 0;    ///< of a part: place among the machines
  bool counted = false;       ///< of a timer
  std::int64_t first = 0;     ///< of state: what it is before anything has happened
  Ref definition = no_term;   ///< of a fact
  std::vector<Tag> fields{};  ///< of a packet: what it says, in its order
};

enum class Op : std::uint8_t {
  truth,     ///< `value`
  integer,   ///< `value`
  read,      ///< thing `tag`, here
  pending,   ///< how often timer `tag` is scheduled
  in_state,  ///< part `tag` is in state `value`
  let,       ///< register `reg`; `a` is what it was
  outbox,    ///< field `value` of the outbox of part `tag` in register `reg`
  argument,  ///< only in words: argument `value`, from 1, of a procedure or step
  input,     ///< of guards and actions: field `value` of the input
  named,     ///< a guard of a machine: `words` is its name, `a` what it tests
  choice,    ///< an unknown: `words`
  subject,   ///< the place is about this descriptor
  is_in,     ///< the descriptor is in the set `a`
  any,       ///< the set `a` is not empty
  // What they have one or two of: `a`, `b`.
  negation,
  both,
  either,
  plus,
  minus,
  times,
  over,
  equal,
  unequal,
  less,
  at_most,
  greater,
  at_least,
  select,  ///< `b` if `a`, otherwise `c`
  // Over the descriptors of the stream, the open readers of the writer, the entries of the
  // participant: `a` is the inner term, to be evaluated at each of these.
  set_of,
  some,
  all,
  count,
  some_reader,
  count_readers,
  some_entry,
  all_up_to,
  some_from_here
};

struct Term {
  Op op{};
  Tag tag = no_thing;
  Register reg = 0;
  std::int64_t value = 0;
  Ref a = no_term;
  Ref b = no_term;
  Ref c = no_term;
  std::string_view words{};
};

enum class Do : std::uint8_t {
  let,   ///< register `reg` becomes `value`
  when,  ///< the body, if `value`
  // The body at other places, see the words of rules (fsm/composition/vocabulary.hpp).
  for_readers,
  for_readers_by_number,
  for_descriptors,  ///< for which `value`, an inner term
  for_queue,
  for_streams,
  for_known_peers,
  reverse,
  partition,  ///< for each part, in register `reg`, of the set `value`
  // Effects.
  feed,       ///< `event` to part `target`, with the input `with`: its outbox in `reg`
  feed_each,  ///< the same to each descriptor for which `value`, an inner term as `with` are; an
              ///< outbox of sets
  renew,
  set,       ///< flag or number `target` to `value`
  set_each,  ///< flag `target` to `value`, an inner term
  after,     ///< timer `target` after delay `wait`
  at,        ///< timer `target` at `value`
  cancel,
  emit,  ///< packet `target`, which says `with` of `fields`
  raise,
  call,    ///< `procedure` with the arguments `with`
  perform  ///< the opaque step `target`, whose contract is `procedure`
};

/// What a packet says of one of its fields, or a step is given as an argument.
struct Given {
  Ref value = no_term;
  bool inner = false;  ///< a term of each descriptor
};

struct Step {
  Do what{};
  Tag target = no_thing;
  std::uint8_t event = 0;
  Tag wait = no_thing;
  Ref value = no_term;
  std::vector<Given> with{};
  std::vector<Tag> fields{};
  Register reg = 0;
  std::size_t procedure = 0;
  std::string_view argument{};  ///< a tag that a procedure or step is given: its name
  std::vector<Step> body{};
  unsigned number = 0;  ///< of an effect: within its rule or procedure, from 1
  // What names an effect, condition or loop, and where it is written; not of `let`.
  EffectKey key{};
  std::string_view file{};
  unsigned line = 0;
};
using Steps = std::vector<Step>;

enum class Trigger : std::uint8_t {
  received,
  left,    ///< a packet has been sent by its source completely
  due,     ///< a timer
  happens  ///< an occasion
};

struct Rule {
  enum class Group : std::uint8_t {
    announcing,  ///< it only makes occasions happen
    exchange,    ///< it is about relations and writers
    other
  };
  std::string_view name;
  Trigger trigger{};
  Tag cause = no_thing;
  Owner owner{};
  Group group{};
  Steps body;
};

/// A procedure or a contract, one for each tag that it is given.
struct Procedure {
  struct Parameter {
    Register reg = 0;
    bool is_outbox = false;  ///< the register's values are copied; otherwise it gets one
  };
  std::string name;  ///< with the tag: "Deliver ToAll"
  bool is_contract = false;
  std::vector<Parameter> parameters;
  Steps body;
};

/// A machine, its guards and actions as terms over its input.
struct Machine {
  struct Field {
    std::string_view name;
    Sort sort{};
  };
  struct Row {
    StateId source = 0;
    std::uint8_t event = 0;
    StateId target = 0;
    Ref guard = no_term;   ///< there is none
    bool negated = false;  ///< it fires if its guard is false
    std::vector<Ref> out;  ///< by field; `no_term`: not asked for

    // What mistakes do (fsm/row_mutation.hpp).
    void ignore_guard() { guard = no_term; }
    void drop_action() { out.assign(out.size(), no_term); }
  };
  std::string_view name;
  StateId initial = 0;
  std::vector<std::string_view> states;
  std::vector<std::string_view> events;
  std::vector<Sort> inputs;
  std::vector<Field> outputs;
  std::vector<Row> rows;
};

/// A register: one value, or those of the outbox of a part.
struct RegisterInfo {
  Tag part = no_thing;
};

/// Something that needs no use or no cause, and why: fsm/composition/vocabulary.hpp.
struct Reason {
  std::string_view part;  ///< empty: of an occasion or timer that comes from outside
  std::string_view name;
  std::string_view text;
};

struct Program {
  std::string_view name;
  std::vector<Thing> things;
  std::vector<Machine> machines;
  std::vector<Term> terms;
  std::vector<RegisterInfo> registers;
  std::vector<Rule> rules;
  std::vector<Procedure> procedures;  ///< and contracts, in the order in which they are met
  // What the composition has, in its order.
  std::vector<Tag> parts;
  std::vector<Tag> timers;
  std::vector<Tag> state;
  std::vector<Tag> packets;
  std::vector<Tag> occasions;
  std::vector<Reason> unused;
  std::vector<Reason> from_outside;
  // What it calls what every composition has.
  Tag is_open = no_thing;    ///< the relation is open
  Tag is_queued = no_thing;  ///< the entry is in the queue
  Tag acknack = no_thing;
  std::vector<std::pair<Tag, Ref>> bitmap;  ///< what an ACKNACK would say now: inner terms
  std::vector<Tag> first_samples;           ///< numbers that count the first samples of a stream
  Steps opening;  ///< what a pair's destination opens when it has recognised its source; or nothing
  // What mistakes at effects need besides: EffectMutation::Change.
  Tag now = no_thing;
  Tag response_delay = no_thing;
  Tag heartbeat_period = no_thing;

  [[nodiscard]] const Machine& machine_of(Tag part) const { return machines[things[part].machine]; }
  /// The thing of this name; if there is none, `no_thing`.
  [[nodiscard]] Tag find(std::string_view name) const;
  /// The rule for a trigger; null if there is none.
  [[nodiscard]] const Rule* rule_for(Trigger trigger, Tag cause) const;
  /// Whether something else than the rules causes it, at least for the first time.
  [[nodiscard]] bool comes_from_outside(Tag thing) const;
};

[[nodiscard]] std::string_view word_of(Do what);
/// "AckNackArrives.3", the id of an effect of the rule, procedure or contract `scope`.
[[nodiscard]] std::string effect_id(std::string_view scope, const Step& effect);
[[nodiscard]] std::string_view word_of(Trigger trigger);

/// The rows of a machine with the mistakes that concern it.
[[nodiscard]] std::vector<Machine::Row> rows_of(const Machine& machine,
                                                const std::vector<TableMutation>& mistakes);

/// Throws std::logic_error if two things have one name, or a rule can run within itself.
void check(const Program& program);

}  // namespace stormproof::fsm::program
