// The events of one relation, of its writer and of its participants as order.commutation compares
// them: each rule of the composition is a kind. Only the cycles of the adaptive policy are left
// out.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "checker/engines/tables/commutation_matrix.hpp"
#include "checker/engines/tables/known_of_runs.hpp"
#include "checker/engines/tables/symbolic_world.hpp"

namespace stormproof::tables {

/// What specs/expected/commutation.yaml calls the event of a rule; the rule's name if nothing else.
inline std::string words_of_rule(std::string_view rule) {
  using Words = std::pair<std::string_view, const char*>;
  constexpr std::array all{Words{"ReaderOpened", "opening of the reader side"},
                           Words{"WriterSideOpens", "opening of the writer side"},
                           Words{"ReaderIsMatched", "opening of the writer side"},
                           Words{"DataArrives", "DATA received"},
                           Words{"HeartbeatArrives", "HEARTBEAT received"},
                           Words{"AckNackArrives", "ACKNACK received"},
                           Words{"AckNackDue", "ACKNACK generation"},
                           Words{"InitialAckNackDue", "initial ACKNACK"},
                           Words{"RepairIsDue", "repair generation"},
                           Words{"RepairHasLeft", "source completion"},
                           Words{"DescriptorIsCreated", "creation"},
                           Words{"NackResponds", "nack response"},
                           Words{"QueueIsSent", "async run"},
                           Words{"SuppressionEnds", "suppression end"},
                           Words{"HeartbeatExpires", "HEARTBEAT expiry"},
                           Words{"AnnouncementIsDue", "announcement"},
                           Words{"MulticastArrives", "announcement received"},
                           Words{"UnicastArrives", "copy of an announcement received"}};
  for (const auto& [name, words] : all) {
    if (name == rule) return words;
  }
  return std::string{rule};
}

/// The events of `R`: ours, or of several places whichever is drawn.
template <class Known, class R, bool is_of_relation>
class KindOfRule {
 public:
  using World = SymbolicWorld<typename Known::Composition>;
  using Bool = typename World::Bool;
  using Trigger = typename R::Trigger;

  static void happen(SymbolicRun& run, const std::string& event) {
    at_each(run, event, [](World& w) {
      (void)w.template trigger<Trigger>();
      R::run(w);
    });
  }
  static EventConditions conditions(SymbolicRun& before, const std::string& event) {
    Exprs possible;
    Exprs consistent;
    Exprs places;
    at_each(before, event, [&](World& w) {
      const Expr here = w.path();
      places.push_back(here);
      possible.push_back(z3::implies(
          here, (w.template trigger<Trigger>() && Known::possible(Trigger{}, w)).expr()));
      consistent.push_back(z3::implies(here, Known::consistent(Trigger{}, w).expr()));
    });
    possible.push_back(exactly_one(places));
    return {all_of(possible), all_of(consistent)};
  }

 private:
  /// Ours; of several descriptors and of the pairs of participants, whichever is drawn.
  template <class Body>
  static void at_each(SymbolicRun& run, const std::string& event, Body&& body) {
    const std::vector<Place> places = places_in(run.extent());
    for (const Place& place : places) {
      World w{run, event, place};
      const Bool here = places.size() > 1
                            ? w.drawn("at" + (place.text().empty() ? " ours" : place.text()))
                            : Bool{true};
      w.when(here, [&] { body(w); });
    }
  }
  /// The rules of announcements are about any participant or pair of them, all others about our
  /// relation, and of its descriptors about any.
  static std::vector<Place> places_in(const Extent& extent) {
    namespace index = fsm::composition::owner;
    constexpr auto has = [](auto one) { return (R::owner.indices & one) != 0; };
    std::vector<Place> places;
    if constexpr (!is_of_relation) {
      for (int p = 0; p <= extent.readers; ++p) {
        if (!has(index::peer_index)) places.push_back({.participant = p});
        for (int q = 0; has(index::peer_index) && q <= extent.readers; ++q) {
          if (p != q) places.push_back({.participant = p, .peer = q});
        }
      }
    } else {
      for (int d = 0; d < (has(index::descriptor_index) ? extent.descriptors : 1); ++d) {
        places.push_back({.descriptor = d});
      }
    }
    return places;
  }
};

/// The events of the composition of `Known` in their groups, and what is known of its runs.
template <class Known>
std::vector<EventGroup> event_groups() {
  namespace composition = fsm::composition;
  using Composition = typename Known::Composition;
  EventGroup relation{"one relation", {}, {}, {}};
  relation.consistent = [](SymbolicRun& before) {
    using World = SymbolicWorld<Composition>;
    Exprs all;
    for (int s = 0; s < before.extent().streams; ++s) {
      World writer{before, "", {.stream = s}};
      all.push_back(Known::of_writer(writer).expr());
      for (int peer = 1; peer <= before.extent().readers; ++peer) {
        World reader{before, "", {.stream = s, .peer = peer}};
        all.push_back(Known::of_relation(reader).expr());
      }
    }
    return all_of(all);
  };
  relation.possible = [](SymbolicRun& before) {
    SymbolicWorld<Composition> world{before, ""};
    return Known::of_knobs(world).expr();
  };
  const auto any = [](SymbolicRun&) { return smt::SymbolicBool{true}.expr(); };
  EventGroup announcing{"participants", relation.possible, any, {}};
  const auto add = [&]<bool is_of_relation, class R>(std::vector<EventKind>& kinds) {
    using Kind = KindOfRule<Known, R, is_of_relation>;
    kinds.push_back({words_of_rule(fsm::name_of<R>()), Kind::happen, Kind::conditions});
  };
  composition::for_each_type(typename Composition::Exchange{}, [&]<class R>() {
    using Cause = typename R::Trigger::Cause;
    if constexpr (!std::is_same_v<Cause, composition::CycleStart> &&
                  !std::is_same_v<Cause, composition::CycleEnd> &&
                  !std::is_same_v<Cause, composition::BatchDue>) {
      add.template operator()<true, R>(relation.kinds);
    }
  });
  composition::for_each_type(typename Composition::Announcing{}, [&]<class R>() {
    add.template operator()<false, R>(announcing.kinds);
  });
  return {relation, announcing};
}

}  // namespace stormproof::tables
