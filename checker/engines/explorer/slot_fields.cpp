// By the kinds of events, and by names.
#include "checker/engines/explorer/slot_fields.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "model/engine/program_things.hpp"

namespace stormproof::explorer {

using From = Specialised::From;

std::optional<What> what_of(const fsm::program::Thing& timer) {
  const model::EventKind kind = model::event_kind(timer);
  for (auto k = static_cast<std::uint8_t>(What::heartbeat_expiry);
       k <= static_cast<std::uint8_t>(What::thread_run); ++k) {
    if (kind_of(What{k}, false) == kind) return What{k};
  }
  return std::nullopt;
}

std::optional<What> what_of_packet(const fsm::program::Program& program, fsm::program::Tag packet) {
  if (packet == program.acknack) return What::acknack;
  if (program.things[packet].name == "Data") return What::data;
  if (program.things[packet].name == "Heartbeat") return What::heartbeat;
  return std::nullopt;
}

const fsm::program::Rule* rule_of(const fsm::program::Program& program, What event) {
  using fsm::program::Trigger;
  const auto rule_for = [&](Trigger trigger, std::string_view cause) {
    return program.rule_for(trigger, program.find(cause));
  };
  switch (event) {
    case What::data:
      return rule_for(Trigger::received, "Data");
    case What::heartbeat:
      return rule_for(Trigger::received, "Heartbeat");
    case What::acknack:
      return program.rule_for(Trigger::received, program.acknack);
    case What::source_completion:
      return rule_for(Trigger::left, "Data");
    case What::creation:
      return rule_for(Trigger::happens, "Created");
    case What::reader_opens:
      return rule_for(Trigger::happens, "ReaderOpens");
    case What::writer_opens:
      return rule_for(Trigger::happens, "WriterOpens");
    default:
      break;
  }
  for (const fsm::program::Tag timer : program.timers) {
    if (what_of(program.things[timer]) == event) return program.rule_for(Trigger::due, timer);
  }
  return nullptr;
}

const SlotField& slot_field(const fsm::program::Thing& field) {
  static constexpr std::array all{
      SlotField{"Carries", From::set, 0},
      SlotField{"Listed", From::set, 0},
      SlotField{"Announces", From::limit, 0},
      SlotField{"BelowBase", From::limit, 0},
      SlotField{"IsInitial", From::flag, Slot::initial},
      SlotField{"IsRepair", From::flag, Slot::from_repair},
      SlotField{"CarriesHeartbeat", From::flag, Slot::carries_heartbeat},
      SlotField{"IsDirected", From::flag, Slot::directed},
      SlotField{"Count", From::count, 0}};
  const auto* const found = std::ranges::find(all, field.name, &SlotField::name);
  if (found == all.end()) throw std::logic_error{"no slot says " + std::string{field.name}};
  return *found;
}

}  // namespace stormproof::explorer
