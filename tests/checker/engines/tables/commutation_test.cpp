// The order of two events is decided by the rules of a composition: a rule that does less or more
// changes the matrix, in both directions, and a larger deployment does not.
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "checker/engines/tables/event_kinds.hpp"
#include "tests/checker/engines/tables/table_check.hpp"

namespace stormproof::tables {
namespace commutation_test {

namespace comp = fsm::composition;

constexpr model::Of<comp::paper::Paper> paper;
constexpr model::Of<comp::fastdds::FastDds> fastdds;

/// The verdicts of all pairs, by the names of the two kinds.
using Matrix = std::map<std::string, char>;

Matrix matrix_of(const std::vector<EventGroup>& groups, Extent extent,
                 const checker::Mutant* mutant = nullptr) {
  smt::Claims claims{{.second_solver = false}};
  const model::Scenario scenario;
  const checker::CheckRequest request{
      .scenario = scenario, .claims = claims, .mutant = mutant, .on_progress = {}};
  Proof proof{"order.commutation", request};
  Matrix matrix;
  for (const EventGroup& group : groups) {
    for (const PairResult& result : commutation_matrix(proof, group, extent)) {
      matrix[group.kinds[result.first].name + ", " + group.kinds[result.second].name] =
          static_cast<char>(result.verdict);
    }
  }
  return matrix;
}

/// What the second matrix says otherwise.
Matrix changed(const Matrix& from, const Matrix& to) {
  Matrix changes;
  for (const auto& [pair, verdict] : to) {
    if (!from.contains(pair) || from.at(pair) != verdict) changes[pair] = verdict;
  }
  return changes;
}

/// The paper's composition with another rule in the place of `Old`.
template <class Old, class New, class List>
struct Exchanged;
template <class Old, class New, class... Rs>
struct Exchanged<Old, New, fsm::TypeList<Rs...>> {
  using type = fsm::TypeList<std::conditional_t<std::is_same_v<Rs, Old>, New, Rs>...>;
};
template <class Old, class New>
struct PaperWith : comp::paper::Paper {
  using Exchange = typename Exchanged<Old, New, comp::paper::Paper::Exchange>::type;
};
template <class Old, class New>
struct KnownWith : KnownOfPaper {
  using Composition = PaperWith<Old, New>;
};

using PaperAckNackDue = comp::ReaderRules<comp::paper::Implementation>::AckNackDue;

/// Forgets to return what was suppressed.
struct SuppressionEnds : comp::Rule<comp::Due<comp::paper::SuppressionEnd>> {
  template <class W>
  static void run(W&) {}
};
/// Forgets that a HEARTBEAT was seen.
struct AckNackDue : comp::Rule<comp::Due<comp::AckNackGeneration>> {
  template <class W>
  static void run(W& w) {
    PaperAckNackDue::run(w);
    w.set(comp::HeartbeatSeen{}, typename W::Bool(false));
  }
};
/// Does what it should and sends a HEARTBEAT if the writer's clock is idle.
struct RepairHasLeft : comp::Rule<comp::LeftSource<comp::paper::Data>> {
  template <class W>
  static void run(W& w) {
    comp::paper::RepairHasLeft::run(w);
    w.when(w.in(comp::HeartbeatClock{}, comp::is<fsm::heartbeat_timer::Idle>),
           [&] { w.emit(comp::paper::Heartbeat{}, comp::says()); });
  }
};

TEST(Commutation, ARuleThatDoesLessCommutesMoreOften) {
  const Matrix correct = matrix_of(events_of(paper), {});
  const Matrix changes = changed(
      correct,
      matrix_of(event_groups<KnownWith<comp::paper::SuppressionEnds, SuppressionEnds>>(), {}));
  EXPECT_EQ(changes, (Matrix{{"ACKNACK received, suppression end", '.'},
                             {"opening of the writer side, suppression end", '.'},
                             {"source completion, suppression end", '.'},
                             {"suppression end, HEARTBEAT expiry", '.'}}));
}

TEST(Commutation, ARuleThatDoesMoreCommutesLessOften) {
  const Matrix correct = matrix_of(events_of(paper), {});
  const Matrix state =
      changed(correct, matrix_of(event_groups<KnownWith<PaperAckNackDue, AckNackDue>>(), {}));
  EXPECT_EQ(state, (Matrix{{"initial ACKNACK, ACKNACK generation", 'X'},
                           {"HEARTBEAT received, ACKNACK generation", 'X'}}));
  const Matrix emitted = changed(
      correct, matrix_of(event_groups<KnownWith<comp::paper::RepairHasLeft, RepairHasLeft>>(), {}));
  EXPECT_TRUE(emitted.contains("source completion, HEARTBEAT expiry"));
  EXPECT_TRUE(emitted.contains("opening of the writer side, source completion"));
}

TEST(Commutation, MoreDescriptorsReadersAndWritersChangeNoAnswer) {
  for (const auto& groups : {events_of(paper), events_of(fastdds)}) {
    const Matrix small = matrix_of(groups, {});
    for (const Extent larger :
         {Extent{.descriptors = 3}, Extent{.readers = 3}, Extent{.streams = 3}}) {
      EXPECT_EQ(changed(small, matrix_of(groups, larger)), Matrix{});
    }
  }
}

/// The same mistake, and in all other tables one that changes nothing, so that all have one.
checker::Mutant with_all_tables(checker::Mutant mutant) {
  const std::string mistaken = mutant.rules.tables.front().machine;
  for (const fsm::MachineInfo& info : fsm::machines()) {
    if (info.name == mistaken) continue;
    mutant.rules.tables.push_back({std::string{info.name}, 0, fsm::TableMutation::Kind::retarget, 0,
                                   info.rows.front().target});
  }
  return mutant;
}

TEST(Commutation, PairsThatAreNotAskedOfAMutantAreAsWithoutIt) {
  std::size_t differences = 0;
  for (const auto& groups : {events_of(paper), events_of(fastdds)}) {
    const Matrix correct = matrix_of(groups, {});
    for (const char* machine : {"DescriptorRepair", "ChangeForReader", "DiscoveryReader",
                                "HeartbeatTimer", "SingleShot", "Channel"}) {
      const auto mutant = with_row(machine, 0, fsm::TableMutation::Kind::drop_row);
      const auto all = with_all_tables(mutant);
      const Matrix full = matrix_of(groups, {}, &all);
      for (const auto& [pair, verdict] : matrix_of(groups, {}, &mutant)) {
        if (full.at(pair) == '?') {  // it steps no machine at all
          EXPECT_EQ(verdict, '?') << machine << ": " << pair;
          continue;
        }
        if (full.at(pair) != correct.at(pair)) ++differences;
        EXPECT_EQ(full.at(pair), verdict == '?' ? correct.at(pair) : verdict)
            << machine << ": " << pair;
      }
    }
  }
  EXPECT_GT(differences, 0U);  // of the pairs that are asked
}

TEST(Commutation, OneReaderIsNotEnough) {
  const Matrix small = matrix_of(events_of(fastdds), {.readers = 1});
  const Matrix larger = matrix_of(events_of(fastdds), {});
  EXPECT_EQ(small.at("opening of the writer side, async run"), 'u');
  EXPECT_EQ(larger.at("opening of the writer side, async run"), 'X');
}

}  // namespace commutation_test
}  // namespace stormproof::tables
