// From events to rules.
#include "checker/engines/explorer/relation_world.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>
#include <string_view>

#include <fmt/core.h>

#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/specialise.hpp"
#include "model/composition_of.hpp"
#include "model/implementations.hpp"

namespace stormproof::explorer {

using fsm::program::no_thing;
using fsm::program::Program;
using fsm::program::Tag;
namespace owner = fsm::composition::owner;

namespace {

constexpr std::size_t most_relations = std::max(most_readers, most_writers);

/// The writer's view of a descriptor; nothing: it has none.
Tag descriptor_part(const Program& program) {
  const auto found = std::ranges::find_if(
      program.parts, [&](Tag part) { return program.things[part].owner == owner::descriptor; });
  return found == program.parts.end() ? no_thing : *found;
}
/// Whether one announcement opens both sides, where it arrives.
bool opens_both(const fsm::program::Steps& steps, Tag writer_opens) {
  return std::ranges::any_of(steps, [&](const fsm::program::Step& step) {
    if (step.what == fsm::program::Do::reverse) return false;
    return step.target == writer_opens || opens_both(step.body, writer_opens);
  });
}

}  // namespace

RelationWorld::RelationWorld(const model::Scenario& running, const model::Scenario& specification,
                             const Scope& scope, const model::Mutation& mutation)
    : RelationWorld{model::program_of(running.dds), running, specification, scope, mutation} {}

RelationWorld::RelationWorld(const Program& program, const model::Scenario& running,
                             const model::Scenario& specification, const Scope& scope,
                             const model::Mutation& mutation)
    : program_{program},
      running_{running},
      suppression_ns_{specification.dds.sedp.nack_suppression_duration.count()},
      scope_{scope},
      rules_{mutation.events, model::traits_of(running.dds).receives_separately},
      live_bitmaps_{mutation.live_bitmaps},
      opens_at_once_{!scope.side_by_side &&
                     opens_both(program.opening, program.find("WriterOpens"))},
      leaves_later_{program.rule_for(fsm::program::Trigger::left, program.find("Data")) != nullptr},
      view_{descriptor_part(program)},
      packing_{packing_of(program, running, scope, rules_)},
      layout_{laid_out()},
      rules_of_events_{specialised(mutation)},
      runner_{
          rules_of_events_,
          remembered_,
          scope_,
          {packing_->descriptors(model::Stream::pub), packing_->descriptors(model::Stream::sub)},
          *packing_} {
  place(rules_of_events_, layout_);
  if (view_ == no_thing) return;
  const std::vector<std::string_view>& states = program_.machine_of(view_).states;
  for (const std::string_view state : states) {
    const std::size_t letter = std::string_view{"USA"}.find(state);
    letters_.push_back(static_cast<std::uint8_t>(letter + 1));  // of none of them: 0
  }
}

Specialised RelationWorld::specialised(const model::Mutation& mutation) {
  Specialiser specialiser{program_, running_.dds, mutation, *packing_};
  Specialised made = specialiser.specialise();
  drop_unused(made);
  return made;
}

/// What correct rules never change is not kept.
Layout RelationWorld::laid_out() {
  Layout layout{program_, scope_,
                std::max(packing_->descriptors(model::Stream::pub),
                         packing_->descriptors(model::Stream::sub)),
                packing_->has_two_ends()};
  Specialised correct = specialised({});
  for (const Tag thing : changed_things(correct)) layout.keep(thing);
  packing_->keep(layout);
  remembered_.asked = layout.keep(sizeof(Members), owner::relation);
  remembered_.generated = layout.keep(sizeof(Members), owner::relation);
  if (announces(program_)) remembered_.announced = layout.keep(sizeof(Members), owner::relation);
  remembered_.received = layout.of(program_.find("X"));
  remembered_.open = layout.of(program_.is_open);
  if (program_.is_queued == no_thing) return layout;
  remembered_.queued = layout.of(program_.is_queued);
  if (relations() > 1) {
    remembered_.queue =
        layout.keep(packing_->descriptors(model::Stream::pub) * std::size_t{scope_.writers},
                    owner::participant);
  }
  return layout;
}

WorldState RelationWorld::start(Frame& frame) {
  State state;
  if (packing_->has_two_ends()) schedule_openings(frame);
  if (program_.find("Created") != no_thing) start_creations(state, frame);
  if (!packing_->has_two_ends()) schedule_openings(frame);
  packing_->start(state);
  return state;
}
/// The last descriptors of the first writer are created after the match. Two creations keep their
/// distance, so their order is certain.
void RelationWorld::start_creations(State& state, Frame& frame) const {
  const Kept exists = layout_.of(program_.find("Exists"));
  for (unsigned s = 0; s < scope_.writers; ++s) {
    const unsigned created = descriptors(s) - (s == 0 ? scope_.pushed : 0);
    state.set(exists, static_cast<Members>(member(created) - 1), s);
  }
  if (scope_.pushed == 0) return;
  const model::Nanoseconds within =
      scope_.pushed == 1 ? scope_.largest_delay : creation_distance(running_);
  frame.schedule_between({What::creation, 0, member(descriptors() - scope_.pushed)}, 0,
                         within.count());
}
void RelationWorld::create(const Slot& slot) {
  const auto d = static_cast<unsigned>(std::countr_zero(slot.set));
  runner_.run(slot, d);
  if (scope_.pushed == 2 && d + 2 == descriptors()) {
    runner_.frame().schedule({What::creation, 0, member(d + 1)},
                             creation_distance(running_).count());
  }
}

/// One announcement of the participant opens the reader sides of all its writers, so they open
/// together; the writer sides open in ascending order of the readers, which is what tells these
/// apart. The participant hears first of a reader that joins later, and answers at once.
void RelationWorld::schedule_openings(Frame& frame) const {
  const std::int64_t apart = scope_.side_by_side ? scope_.largest_delay.count() : 0;
  const std::int64_t late = scope_.joins_within.count();
  const unsigned readers = scope_.readers;
  const unsigned early = readers > 1 && late > 0 ? readers - 1 : readers;
  const auto relation = [&](unsigned r) { return static_cast<std::uint8_t>(r * scope_.writers); };
  const auto schedule = [&](What what, unsigned r, std::int64_t within) {
    frame.schedule_between({what, 0, 0, 0, relation(r)}, 0, within);
  };
  const auto in_order = [&](What what, unsigned r, What other, unsigned s) {
    const unsigned first = frame.find(what, 0, relation(r));
    const unsigned second = frame.find(other, 0, relation(s));
    if (std::max(first, second) < frame.count()) frame.precede(first, second);  // no mistake made
  };
  for (unsigned r = 0; r < early; ++r) {
    schedule(What::reader_opens, r, apart);
    if (r == 0) continue;
    in_order(What::reader_opens, r - 1, What::reader_opens, r);
    in_order(What::reader_opens, r, What::reader_opens, r - 1);
  }
  for (unsigned r = 0; r < early && !opens_at_once_; ++r) {
    schedule(What::writer_opens, r, apart);
    if (r > 0) in_order(What::writer_opens, r - 1, What::writer_opens, r);
  }
  if (early == readers) return;
  if (!opens_at_once_) schedule(What::writer_opens, early, late);
  schedule(What::reader_opens, early, late);
  in_order(What::writer_opens, early, What::reader_opens, early);
  in_order(What::reader_opens, early, What::writer_opens, early);
}

void RelationWorld::fire(State& state, Frame& frame, const Slot& slot) {
  runner_.go_on_with(state, frame);
  if (packing_->happens(slot, runner_)) return;
  std::array<View, most_relations> before{};
  for (unsigned k = 0; k < relations(); ++k) before.at(k) = view_of(state, k);
  happen(slot);
  for (unsigned k = 0; k < relations(); ++k) {
    check_descriptors(before.at(k), view_of(state, k), state.get<Members>(remembered_.received, k),
                      frame, k, suppression_ns_);
  }
  for (unsigned s = 0; s < scope_.writers; ++s) {
    if (frame.pending(What::heartbeat_expiry, s) > 1) frame.object(Claim::single_heartbeat);
  }
  if (scope_.readers == 1) return;
  // Completion counts from the last opening.
  const bool opens = slot.what == What::reader_opens || slot.what == What::writer_opens;
  if (!opens || frame.find(What::opened) == frame.count()) return;
  frame.erase_marks(What::opened, 0);
  frame.mark({What::opened});
}

void RelationWorld::happen(const Slot& slot) {
  switch (slot.what) {
    case What::reader_opens:
      open(slot, What::reader_opens);
      if (opens_at_once_) open(slot, What::writer_opens);
      break;
    case What::writer_opens:
      open(slot, What::writer_opens);
      break;
    case What::creation:
      create(slot);
      break;
    case What::data:
      object_to_copies(runner_.frame(), slot.set,
                       runner_.state().get<Members>(remembered_.received, slot.relation));
      runner_.run(slot, slot);
      break;
    case What::acknack:
      runner_.run(live_bitmaps_ ? runner_.said_now(slot) : slot, slot);
      break;
    case What::source_completion:
      if (!leaves_later_) break;
      for (unsigned left = slot.set; left != 0; left &= left - 1) {
        mark_left(runner_.frame(), slot.relation, static_cast<Members>(left & -left));
      }
      runner_.run(slot, slot);
      break;
    default:
      runner_.run(slot, slot);
  }
}
void RelationWorld::open(Slot slot, What side) {
  slot.what = side;
  for (unsigned s = 0; s < scope_.writers; ++s, ++slot.relation) runner_.run(slot, slot);
}

View RelationWorld::view_of(const State& state, unsigned relation) const {
  std::array<unsigned, 4> in{};
  const std::uint8_t* const states = state.at(layout_.of(view_), relation);
  for (unsigned d = 0; d < descriptors(relation); ++d) in[letters_[states[d]]] |= member(d);
  return {static_cast<Members>(in[1]), static_cast<Members>(in[2]), static_cast<Members>(in[3])};
}

std::uint32_t RelationWorld::received(const State& state) const {
  std::uint32_t bits = 0;
  unsigned end = 0;
  for (unsigned k = 0; k < relations(); ++k) {
    bits |= std::uint32_t{state.get<Members>(remembered_.received, k)} << end;
    end += descriptors(k);
  }
  return bits;
}
unsigned RelationWorld::deliveries() const {
  unsigned count = 0;
  for (unsigned k = 0; k < relations(); ++k) count += descriptors(k);
  return count;
}

std::string RelationWorld::describe(const State& state) const {
  std::string text = packing_->describe(state);
  if (!text.empty()) return text;
  if (relations() == 1) return describe(state, 0);
  for (unsigned k = 0; k < relations(); ++k) {
    text +=
        fmt::format("{}{}: {}", k == 0 ? "" : "; ", relation_text(scope_, k), describe(state, k));
  }
  return text;
}
std::string RelationWorld::describe(const State& state, unsigned relation) const {
  std::string letters;
  std::string bits;
  std::string each;
  const std::uint8_t* const states = state.at(layout_.of(view_), relation);
  for (unsigned d = 0; d < descriptors(relation); ++d) {
    const std::string_view name = program_.machine_of(view_).states[states[d]];
    const auto received = state.get<Members>(remembered_.received, relation);
    const char bit = (received & member(d)) != 0 ? '1' : '0';
    each += fmt::format("{}d{}: C = {}, X = {}", d == 0 ? "" : "; ", d, name, bit);
    letters += name == "Absent" ? "-" : name;
    bits += bit;
  }
  constexpr unsigned few = 3;
  return descriptors(relation) <= few ? each : "C = " + letters + ", X = " + bits;
}

}  // namespace stormproof::explorer
