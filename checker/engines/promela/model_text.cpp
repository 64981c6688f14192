// What stands around the rules, as text. In a bitmap, bit d is descriptor d.
#include "checker/engines/promela/model_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/engines/promela/promela.hpp"

namespace stormproof::promela {
namespace {

std::string indented(const std::vector<std::string>& lines, std::string_view indent) {
  std::string text;
  for (const std::string& line : lines) text += fmt::format("{}{}\n", indent, line);
  return text;
}

}  // namespace

void ModelText::add_field(const std::string& packet, const std::string& field, bool bitmap,
                          const Script& script) {
  const std::string variable = variable_of(packet, field);
  if (!script.is_kept(variable)) return;
  fields_[packet].push_back(
      {variable, bitmap, script.is_carried(variable), script.values_of(variable, bitmap)});
}

void ModelText::add(Process process) {
  for (Step& step : process.steps) {
    for (const auto& [store, count] : step.sends) most_[store] = std::max(most_[store], count);
  }
  processes_.push_back(std::move(process));
}
void ModelText::add_occasion(const std::string& rule, const std::vector<Step>& steps) {
  if (steps.front().lines.empty()) return;
  add({rule, "", steps, {}, false});
}
void ModelText::add_timer(const std::string& rule, const std::string& timer, bool counted,
                          const Step& step) {
  Step all = step;
  all.lines.insert(all.lines.begin(), timer + " = " + (counted ? timer + " - 1;" : "false;"));
  add({rule, counted ? timer + " > 0" : timer, {all}, {}, true});
}
void ModelText::add_packet(const std::string& rule, const std::string& packet, bool at_source,
                           const Step& step) {
  const Store store{packet, at_source};
  Step all = step;
  std::vector<std::string> first{"take_" + store.name() + "();"};
  if (at_source) {
    first.push_back("send_" + packet + "();");
    ++all.sends[packet];
  }
  all.lines.insert(all.lines.begin(), first.begin(), first.end());
  stores_.push_back(store);
  add({rule, "nempty(" + store.name() + ")", {all}, store, true});
}

std::vector<ModelText::Field> ModelText::fields_of(const Store& store) const {
  std::vector<Field> fields;
  const auto all = fields_.find(store.packet);
  if (all == fields_.end()) return fields;
  std::ranges::copy_if(all->second, std::back_inserter(fields),
                       [&](const Field& field) { return store.at_source || field.carried; });
  return fields;
}

unsigned ModelText::contents(const Store& store) const {
  unsigned contents = 1;
  for (const Field& field : fields_of(store)) contents *= field.values;
  return contents;
}
unsigned ModelText::capacity(const Store& store) const {
  if (has_room_for_all(store)) return contents(store);
  return (descriptors_ <= max_descriptors_of_progress ? 2 : 1) * most_.at(store.name());
}

/// A step waits until what it may send has room.
std::string ModelText::room_for(const Step& step) const {
  std::string text;
  for (const Store& store : stores_) {
    const auto sends = step.sends.find(store.name());
    if (sends == step.sends.end() || has_room_for_all(store)) continue;
    text += fmt::format(" && len({}) <= {}", store.name(), capacity(store) - sends->second);
  }
  return text;
}

std::string ModelText::operations(const Store& store) const {
  const std::vector<Field> fields = fields_of(store);
  std::vector<std::string> types, said, same, others;
  for (const Field& field : fields) {
    types.emplace_back(field.bitmap ? "byte" : "bool");
    said.push_back(field.variable);
    same.push_back("eval(" + said.back() + ")");
    others.push_back(fmt::format("other{}", others.size()));
  }
  if (fields.empty()) {  // it says nothing
    types = {"bool"};
    said = same = {"true"};
    others = {"_"};
  }
  const unsigned capacity = this->capacity(store);
  std::string text = fmt::format("\nchan {} = [{}] of {{ {} }};\n", store.name(), capacity,
                                 fmt::join(types, ", "));
  text += fmt::format(R"(inline send_{0}() {{
  if
  :: {0} ?? [{1}]  /* one like it is there */
  :: else -> {0} !! {2}
  fi
}}
)",
                      store.name(), fmt::join(same, ", "), fmt::join(said, ", "));
  if (capacity == 1) {
    return text + fmt::format("inline choose_{0}() {{ skip }}\ninline take_{0}() {{ {0} ? {1} }}\n",
                              store.name(), fmt::join(said, ", "));
  }
  text += fmt::format("inline choose_{}() {{\n  if\n  :: true\n", store.name());
  for (unsigned k = 1; k < capacity; ++k) {
    text += fmt::format("  :: len({}) > {} -> which = {}\n", store.name(), k, k);
  }
  return text + fmt::format(R"(  fi
}}
inline take_{0}() {{
  place = 0; count = len({0});
  do
  :: place == which -> {0} ? {1}; place++
  :: place != which && place < count -> {0} ? {2}; {0} ! {2}; place++
  :: place == count -> break
  od;
  which = 0
}}
)",
                            store.name(), fmt::join(said, ", "), fmt::join(others, ", "));
}

std::string ModelText::stores() const {
  std::string text = "\nbyte which;  /* packet of a channel, while a step begins */\n";
  text += "hidden byte place;\nhidden byte count;\n";
  std::size_t most = 0;
  for (const auto& [packet, fields] : fields_) {
    most = std::max(most, fields.size());
    for (const Field& field : fields) {
      text += fmt::format("hidden byte {};\n", field.variable);
    }
  }
  for (std::size_t k = 0; k < most; ++k) text += fmt::format("hidden byte other{};\n", k);
  for (const Store& store : stores_) text += operations(store);
  return text;
}

std::string ModelText::process(const Process& process) const {
  std::string text = fmt::format("\nactive proctype {}() {{\n", process.rule);
  if (!process.repeats) {
    for (const Step& step : process.steps) {
      text += fmt::format("  d_step {{\n    true{};\n{}  }};\n", room_for(step),
                          indented(step.lines, "    "));
    }
    return text + "}\n";
  }
  const Step& step = process.steps.front();
  text += "end:\n  do\n";
  if (process.store.packet.empty()) {
    text += fmt::format("  :: d_step {{\n       {}{} ->\n{}     }}\n", process.trigger,
                        room_for(step), indented(step.lines, "       "));
  } else {
    text += fmt::format(
        "  :: atomic {{\n       {}{} ->\n       choose_{}();\n       d_step {{\n{}       }}\n     "
        "}}\n",
        process.trigger, room_for(step), process.store.name(), indented(step.lines, "         "));
  }
  return text + "  od\n}\n";
}

std::string ModelText::loss() const {
  std::string text = "\nactive proctype Loss() {\nend:\n  do\n";
  for (const Store& store : stores_) {
    if (store.at_source) continue;
    text += fmt::format(
        "  :: atomic {{ lossy && nempty({0}) -> choose_{0}(); d_step {{ take_{0}() }} }}\n",
        store.name());
  }
  if (descriptors_ <= max_descriptors_of_progress) text += "  :: lossy -> lossy = false\n";
  return text + "  od\n}\n";
}

std::string ModelText::text(const Script& script, const std::vector<std::string>& acknowledged,
                            const std::string& received) const {
  std::string text = fmt::format(
      "/* One relation of the composition {}; {} descriptors. Generated by stormproof from its "
      "rules\n   and tables; bit d of a bitmap is descriptor d. */\n"
      "#define ALL_ACKNOWLEDGED ({})\n\n",
      composition_, descriptors_, fmt::join(acknowledged, " && "));
  text += script.preamble() + "bool lossy = true;\n" + stores();
  for (const Process& each : processes_) text += process(each);
  text += loss();
  text +=
      "\n/* Standing still with something unacknowledged is an invalid end state. */\n"
      "active proctype Rest() { timeout && ALL_ACKNOWLEDGED }\n\n";
  for (std::size_t d = 0; d < acknowledged.size(); ++d) {
    text += fmt::format("ltl safe_{0} {{ [] ({1} -> (({2} >> {0} & 1) == 1)) }}\n", d,
                        acknowledged[d], received);
  }
  if (descriptors_ <= max_descriptors_of_progress) {
    text += "ltl progress { (<> !lossy) -> (<> ALL_ACKNOWLEDGED) }\n";
  }
  return text;
}

}  // namespace stormproof::promela
