// Writes the Promela model of one relation of any composition: each rule about relations and
// writers once, as a process, by the reader of checker/engines/promela/promela_world.hpp. Of the
// rules that announce there is what they come to: each participant hears of the other once, at some
// time. What comes from outside happens once, at any time. Control-only relations share nothing
// with this one.
#include <algorithm>

#include <fmt/core.h>

#include "checker/engines/promela/model_text.hpp"
#include "checker/engines/promela/promela.hpp"
#include "checker/engines/promela/promela_world.hpp"
#include "model/composition_of.hpp"

namespace stormproof::promela {
namespace {

using fsm::program::Program;
using fsm::program::Rule;
using fsm::program::Steps;
using fsm::program::Tag;
using fsm::program::Thing;
using fsm::program::Trigger;

class Model {
 public:
  Model(const Program& program, unsigned descriptors, const model::DdsProfile& dds,
        const model::Mutation& mistakes)
      : program_{program}, dds_{dds}, mistakes_{mistakes}, script_{descriptors} {}

  std::string text() {
    const std::string received = name(program_.find("X"));
    script_.declare("byte " + received + ";\n");
    declare_writers_view();
    for (;;) {
      const std::size_t found = script_.found();
      ModelText model{std::string{program_.name}, script_.descriptors()};
      add_fields(model);
      add_announcements(model);
      for (const Rule& rule : program_.rules) {
        if (rule.group == Rule::Group::exchange) add_rule(model, rule);
      }
      if (script_.found() == found) return model.text(script_, acknowledged_, received);
    }
  }

 private:
  [[nodiscard]] std::string name(Tag tag) const { return variable_name(program_.things[tag]); }

  void declare_writers_view() {
    for (const Tag part : program_.parts) {
      if (!is_of_descriptors(program_.things[part])) continue;
      PromelaWorld::Execution execution{program_, mistakes_.effects};
      PromelaWorld{execution, script_, dds_, mistakes_}.declare(part);
      for (unsigned d = 0; d < script_.descriptors(); ++d) {
        acknowledged_.push_back(
            fmt::format("({}[{}] == {}_A)", name(part), d, program_.machine_of(part).name));
      }
    }
  }
  void add_fields(ModelText& model) {
    for (const Tag packet : program_.packets) {
      if (!script_.is_found("sent " + name(packet))) continue;
      for (const Tag field : program_.things[packet].fields) {
        const bool bitmap = program_.things[field].kind == Thing::Kind::descriptor_field;
        model.add_field(name(packet), name(field), bitmap, script_);
      }
    }
  }
  /// What `act` does to the relation, as statements.
  template <class Act>
  Step written(bool at_source, int descriptor, Act&& act) {
    PromelaWorld::Execution execution{program_, mistakes_.effects};
    PromelaWorld world{execution, script_, dds_, mistakes_, descriptor};
    script_.begin(at_source);
    act(world);
    return {script_.take_lines(), script_.take_sends()};
  }
  /// What an announcement does to the relation: that of its writer's participant when it reaches
  /// the reader's for the first time, and the other way round.
  void add_announcements(ModelText& model) {
    Rule heard{.name = "WriterIsHeard", .body = program_.opening};
    const auto add = [&] {
      model.add_occasion(std::string{heard.name},
                         {written(false, 0, [&](PromelaWorld& w) { w.run_rule(heard); })});
    };
    add();
    heard.name = "ReaderIsHeard";
    heard.body = {{.what = fsm::program::Do::reverse, .body = program_.opening}};
    add();
  }
  /// A rule's process, or nothing if its trigger has not been found to happen.
  void add_rule(ModelText& model, const Rule& rule) {
    const std::string rule_name{rule.name};
    const std::string cause = name(rule.cause);
    const bool at_source = rule.trigger == Trigger::left;
    const auto step = [&](int descriptor = 0) {
      return written(at_source, descriptor, [&](PromelaWorld& w) {
        w.look_at(rule.cause);
        w.run_rule(rule);
      });
    };
    if (rule.trigger == Trigger::happens) {
      if (!program_.comes_from_outside(rule.cause)) return;
      std::vector<Step> steps;
      const bool of_each = is_of_descriptors(program_.things[rule.cause]);
      for (unsigned d = 0; d < (of_each ? script_.descriptors() : 1); ++d) {
        steps.push_back(step(static_cast<int>(d)));
      }
      model.add_occasion(rule_name, steps);
    } else if (rule.trigger == Trigger::due) {
      if (!script_.is_found("due " + cause)) return;
      model.add_timer(rule_name, cause, program_.things[rule.cause].counted, step());
    } else {
      if (!script_.is_found("sent " + cause)) return;
      model.add_packet(rule_name, cause, at_source, step());
    }
  }

  const Program& program_;
  const model::DdsProfile& dds_;
  const model::Mutation& mistakes_;
  Script script_;
  std::vector<std::string> acknowledged_;
};

}  // namespace

std::string promela_of(const Program& program, unsigned descriptors, const model::DdsProfile& dds,
                       const model::Mutation& mistakes) {
  return Model{program, descriptors, dds, mistakes}.text();
}
std::string promela_of(unsigned descriptors, const model::DdsProfile& dds,
                       const model::Mutation& mistakes) {
  return promela_of(model::program_of(dds), descriptors, dds, mistakes);
}

}  // namespace stormproof::promela
