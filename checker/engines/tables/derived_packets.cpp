// What has been sent, by its content.
#include "checker/engines/tables/derived_packets.hpp"

#include <algorithm>

namespace stormproof::tables {

namespace {

/// What the packet says but for numbers.
std::vector<std::string> fields_of(const fsm::program::Program& program, fsm::program::Tag packet) {
  std::vector<std::string> names;
  for (const fsm::program::Tag tag : program.things[packet].fields) {
    const fsm::program::Thing& field = program.things[tag];
    if (field.kind != fsm::program::Thing::Kind::packet_number) names.emplace_back(field.name);
  }
  return names;
}

}  // namespace

std::vector<std::pair<std::string, PacketContent>> all_contents(
    const fsm::program::Program& program, fsm::program::Tag packet) {
  std::vector<std::pair<std::string, PacketContent>> all{
      {"sent " + std::string{program.things[packet].name}, {}}};
  for (const std::string& field : fields_of(program, packet)) {
    const std::size_t count = all.size();
    for (std::size_t k = 0; k < count; ++k) {
      all.push_back(all[k]);
      all.back().first += " " + field;
      all.back().second.emplace_back(field, true);
      all[k].second.emplace_back(field, false);
    }
  }
  return all;
}

void DerivedPacket::emitted(const Expr& when, const Says& says) const {
  if (derived_.emitted) derived_.emitted(name(), when, says);
  if (derived_.time != nullptr) derived_.time->emitted(name(), when, says);
  for (const auto& [sent, content] : all_contents(program_, packet_)) {
    Expr is = when;
    for (const auto& [field, value] : content) {
      const Expr said = says.contains(field) ? says.at(field) : smt::SymbolicBool{}.expr();
      is = is && (value ? said : !said);
    }
    system().assign(sent, is.simplify(), smt::SymbolicBool{true}.expr());
  }
}

DerivedPacket::Says DerivedPacket::inputs() const {
  Says says;
  for (const std::string& field : fields_of(program_, packet_))
    says.emplace(field, system().input(field));
  return says;
}

void DerivedPacket::arrives(const Says& says) const {
  Exprs cases;
  for (const auto& [sent, content] : all_contents(program_, packet_)) {
    Expr is = system().now(sent);
    for (const auto& [field, value] : content) {
      is = is && (value ? says.at(field) : !says.at(field));
    }
    cases.push_back(is);
  }
  system().require(any_of(cases));
  forget_if_unsound();
}

void DerivedPacket::arrives_as(const Says& says, const Says& now) const {
  const std::string initial = "IsInitial";
  Exprs cases;
  for (const auto& [sent, content] : all_contents(program_, packet_)) {
    const bool is_initial = std::ranges::find(content, std::pair{initial, true}) != content.end();
    cases.push_back(system().now(sent) && (is_initial ? says.at(initial) : !says.at(initial)));
  }
  system().require(any_of(cases));
  for (const auto& [field, value] : now) {
    if (field != initial) system().require(says.at(field) == value);
  }
  forget_if_unsound();
}

void DerivedPacket::forget_if_unsound() const {
  if (!system().is(Unsound::packets_arrive_once)) return;
  for (const auto& content : all_contents(program_, packet_)) {
    system().now(content.first) = smt::SymbolicBool{false}.expr();
  }
}

}  // namespace stormproof::tables
