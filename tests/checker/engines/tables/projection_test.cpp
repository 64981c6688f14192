// One descriptor, reader and writer stand for all: a composition of two descriptors, two readers
// and two writers projects onto the derived system of one. For each rule, wherever it happens, the
// solver looks for a state of the small deployment and inputs from which it leads to something that
// no step of the derived system leads to, whatever that draws for the unknown others; there is
// none. Knobs have any values, states are all that machines can be in, not those of runs. With
// mistakes in the derivation there is one.
//
// What is compared is what the derived system knows: states of machines, flags, how often timers
// are pending, what was started and what was sent. The small deployment packs each descriptor
// alone; what packets announce is left open (checker/engines/tables/symbolic_world.hpp).
#include <algorithm>

#include <gtest/gtest.h>

#include "checker/engines/tables/derived_packets.hpp"
#include "checker/engines/tables/symbolic_world.hpp"
#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/paper.hpp"
#include "fsm/program/programs.hpp"

namespace stormproof::tables {
namespace projection_test {

namespace comp = fsm::composition;
using smt::SymbolicBool;
using smt::SymbolicInt;

Expr yes() { return SymbolicBool{true}.expr(); }

template <class T>
std::string tag_name() {
  return std::string{fsm::name_of<T>()};
}

template <class Composition>
const fsm::program::Program& program_of() {
  return *std::ranges::find(fsm::program::programs(), Composition::name,
                            &fsm::program::Program::name);
}
/// What a packet can say.
template <class Composition, class P>
auto contents_of() {
  const auto& program = program_of<Composition>();
  return all_contents(program, program.find(fsm::name_of<P>()));
}

/// The derived system with an unknown for each knob, but the periodic policy.
template <class Composition>
TransitionSystem derived_system(const model::DdsProfile& dds, Unsound mistake) {
  Derivation derivation{mistake};
  const model::Mutation none;
  Derived derived{dds, none, derivation};
  derived.knob = [&dds](const Knob& knob) {
    if (knob.name == fsm::name_of<comp::Adaptive>()) return SymbolicBool{false}.expr();
    if (knob.value(dds).is_bool()) return SymbolicBool::named(knob.name).expr();
    return SymbolicInt::named(knob.name).expr();
  };
  derive(program_of<Composition>(), derived);
  return derivation.system();
}

/// The rule happens at a place of the small deployment: what our descriptor sees before and after.
template <class Composition, class R>
class Happening {
 public:
  explicit Happening(Place at) {
    SymbolicWorld<Composition> world{run_, "a.", at};
    conditions_.push_back(world.template trigger<typename R::Trigger>().expr());
    if constexpr (std::is_same_v<typename R::Trigger, comp::Received<Cause>> ||
                  std::is_same_v<typename R::Trigger, comp::LeftSource<Cause>>) {
      if (at.of(Cause::owner.indices).text().empty()) was_sent(world);
    } else if constexpr (std::is_same_v<typename R::Trigger, comp::Due<Cause>>) {
      is_due_ = at.of(Cause::owner.indices).text().empty();
      if constexpr (!Cause::counted) {
        const Expr started = SymbolicBool::named("started " + tag_name<Cause>()).expr();
        if (is_due_) conditions_.push_back(started);
      }
    }
    R::run(world);
  }

  /// It can happen so.
  [[nodiscard]] Exprs conditions() const {
    Exprs all = conditions_;
    all.push_back(run_.possible());
    for (const Expr& knob : run_.knobs()) {
      if (knob.is_int()) all.push_back(knob >= 0);
    }
    return all;
  }
  /// What `variable` of the derived system is after it.
  [[nodiscard]] Expr after(const Expr& variable) const {
    const std::string name = variable.decl().name().str();
    const auto found = run_.variables().find(name);
    Expr now = found != run_.variables().end() ? found->second.now : variable;
    comp::for_each_type(typename Composition::Timers{}, [&]<class T>() {
      const std::string timer{fsm::name_of<T>()};
      if constexpr (!T::counted) {
        if (name == "started " + timer) now = variable || happened(timer, {});
        if (name != "pending " + timer) return;
        const bool fires = is_due_ && timer == fsm::name_of<Cause>();
        now = (fires ? !yes() : variable) || happened(timer, {});
      }
    });
    comp::for_each_type(typename Composition::Packets{}, [&]<class P>() {
      for (const auto& [sent, content] : contents_of<Composition, P>()) {
        if (sent == name) now = variable || happened(tag_name<P>(), content);
      }
    });
    return now.simplify();
  }

 private:
  using Cause = typename R::Trigger::Cause;
  using Content = PacketContent;

  /// The packet that arrives here has been sent, with some announcement if it has any.
  void was_sent(SymbolicWorld<Composition>& world) {
    Exprs cases;
    for (const auto& packet : contents_of<Composition, Cause>()) {
      Exprs said{SymbolicBool::named(packet.first).expr()};
      comp::for_each_type(typename Cause::Fields{}, [&]<class F>() {
        for (const auto& [field, value] : packet.second) {
          if (field == fsm::name_of<F>())
            said.push_back(world(F{}).expr() == (value ? yes() : !yes()));
        }
      });
      cases.push_back(all_of(said));
    }
    conditions_.push_back(any_of(cases));
  }
  /// One of this name has happened to us, with this content; what it announces matters to none.
  [[nodiscard]] Expr happened(const std::string& what, const Content& content) const {
    Exprs cases;
    for (const SymbolicEffect& effect : run_.effects()) {
      if (effect.what != what) continue;
      Exprs same{effect.when};
      std::size_t at = 0;
      for (const auto& [field, value] : content) {
        if (field == fsm::name_of<comp::Announces>()) continue;
        same.push_back(effect.content.at(at) == (value ? yes() : !yes()));
        const bool of_descriptor = field == fsm::name_of<comp::Carries>() ||
                                   field == fsm::name_of<comp::Listed>() ||
                                   field == fsm::name_of<comp::BelowBase>();
        at += of_descriptor ? static_cast<std::size_t>(run_.extent().descriptors) : 1;
      }
      cases.push_back(all_of(same));
    }
    return any_of(cases);
  }

  std::vector<fsm::TableMutation> none_;
  SymbolicRun run_{Extent{}, none_};
  Exprs conditions_;
  bool is_due_ = false;
};

std::string step_at(const std::string& rule, const Place& at) {
  const Place ours;
  if (at.stream != ours.stream) return "another stream: " + rule;
  if (at.peer != ours.peer) return "another reader: " + rule;
  if (at.descriptor != ours.descriptor) return "another descriptor: " + rule;
  return rule;
}

bool says_announces(const std::string& name) {
  return name.starts_with("sent ") && name.find("Announces") != std::string::npos;
}

/// The step of the system leads from this state to what `after` says, with some inputs.
template <class After>
Expr exists(const TransitionSystem& system, const std::string& name, const After& after) {
  Exprs stays;
  for (const Expr& variable : system.variables) stays.push_back(after(variable) == variable);
  Exprs ways{all_of(stays)};  // what changes nothing is no step
  for (const SystemStep& step : system.steps) {
    if (step.name != name) continue;
    Exprs same{step.guard};
    for (std::size_t v = 0; v < system.variables.size(); ++v) {
      const Expr& variable = system.variables[v];
      const std::string content = variable.decl().name().str();
      // A packet with and without an announcement counts as one.
      if (says_announces(content)) continue;
      Expr next = step.next[v];
      Expr now = after(variable);
      for (std::size_t w = 0; w < system.variables.size(); ++w) {
        std::string other = system.variables[w].decl().name().str();
        if (!says_announces(other)) continue;
        other.erase(other.find(" Announces"), std::string{" Announces"}.size());
        if (other != content) continue;
        next = next || step.next[w];
        now = now || system.variables[w];
      }
      same.push_back(next == now);
    }
    z3::expr_vector inputs{smt::SymbolicContext::current()};
    for (const Expr& input : step.inputs) inputs.push_back(input);
    const Expr all = all_of(same);
    ways.push_back(inputs.empty() ? all : z3::exists(inputs, all));
  }
  return any_of(ways);
}

struct Projection {
  std::size_t checked = 0;
  std::size_t possible = 0;  ///< of these, can happen
  std::vector<std::string> refused;
};

template <class Composition>
Projection project(const model::DdsProfile& dds, Unsound mistake) {
  z3::context context;
  const smt::SymbolicContext current{context};
  const TransitionSystem system = derived_system<Composition>(dds, mistake);
  Projection projection;
  comp::for_each_type(typename Composition::Exchange{}, [&]<class R>() {
    namespace index = comp::owner;
    const auto many = [](auto one) { return (R::owner.indices & one) != 0 ? 2 : 1; };
    for (int s = 0; s < many(index::stream_index); ++s) {
      for (int r = 1; r <= many(index::peer_index); ++r) {
        for (int d = 0; d < many(index::descriptor_index); ++d) {
          if (mistake != Unsound::none && !projection.refused.empty()) return;
          const Place at{.stream = s, .peer = r, .descriptor = d};
          const Happening<Composition, R> happening{at};
          const std::string name = step_at(tag_name<R>(), at);
          const Expr exists_one =
              exists(system, name, [&](const Expr& variable) { return happening.after(variable); });
          z3::solver solver{context};
          for (const Expr& condition : happening.conditions()) solver.add(condition);
          if (solver.check() == z3::sat) ++projection.possible;
          solver.add(!exists_one);
          const z3::check_result result = solver.check();
          ++projection.checked;
          if (result == z3::unsat) continue;
          projection.refused.push_back(name + (result == z3::unknown ? ": no answer" : ""));
        }
      }
    }
  });
  return projection;
}

std::string listed(const Projection& projection) {
  std::string text;
  for (const std::string& name : projection.refused) text += name + "\n";
  return text;
}
model::DdsProfile fastdds() {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  return dds;
}

TEST(Projection, TwoOfEachProjectOntoOneOfThePapersRules) {
  const Projection projection = project<comp::paper::Paper>({}, Unsound::none);
  EXPECT_EQ(listed(projection), "");
  EXPECT_GT(projection.checked, 30U);
  EXPECT_EQ(projection.possible, projection.checked);
}
TEST(Projection, TwoOfEachProjectOntoOneOfFastDdss) {
  const Projection projection = project<comp::fastdds::FastDds>(fastdds(), Unsound::none);
  EXPECT_EQ(listed(projection), "");
  EXPECT_GT(projection.checked, 30U);
  EXPECT_EQ(projection.possible, projection.checked);
}
void expect_refused(const Projection& projection) {
  ASSERT_FALSE(projection.refused.empty());
  EXPECT_EQ(listed(projection).find("no answer"), std::string::npos);
}
TEST(Projection, RefusesADerivationThatForgetsOthers) {
  for (const Unsound mistake :
       {Unsound::others_never_ask, Unsound::rules_for_us_only, Unsound::loops_for_us_only}) {
    expect_refused(project<comp::fastdds::FastDds>(fastdds(), mistake));
  }
  for (const Unsound mistake : {Unsound::others_never_ask, Unsound::rules_for_us_only}) {
    expect_refused(project<comp::paper::Paper>({}, mistake));
  }
}

}  // namespace projection_test
}  // namespace stormproof::tables
