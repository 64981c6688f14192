// A host of rules with a life (fsm/composition/life.hpp), on top of the host of those without:
// what these rules remember, timers that a new side or participant does not have any more, and who
// hears whom.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "fsm/composition/life.hpp"
#include "model/engine/discovery_base.hpp"
#include "model/implementations.hpp"
#include "model/life.hpp"

namespace stormproof::model {

/// What rules with a life have besides, whatever they are the rules of.
using LivingThings =
    fsm::TypeList<comp::ForgottenAt, comp::LeaseRuns, comp::LeaseCheck, comp::Return>;
/// What is due for a participant or a side that may be a new one can be cancelled.
template <class Columns>
struct LivingColumns : Columns {
  using Columns::column;
  template <class T>
  static constexpr auto column(T tag) {
    if constexpr (IsTimer<T>) {
      return way::Insertions{};
    } else {
      return decltype(Columns::column(tag)){};
    }
  }
};

/// `OfLives` are such timers, and what else the rules remember.
template <class Base, class Composition_, class OfLives>
class LivingHost
    : public Stored<LivingHost<Base, Composition_, OfLives>, Base,
                    comp::Joined<LivingThings, OfLives>, LivingColumns<typename Base::OwnColumns>> {
  using Below = typename LivingHost::Stored;

 public:
  using Composition = Composition_;

  LivingHost(RunState& run, Network& network)
      : Below{run, network},
        life_{run.scenario.deployment.life.value_or(Life{})},
        dying_{those_who_die(run.scenario)} {
    for (std::uint32_t i = 0; i < run.topology.participant_count(); ++i) {
      leases_.push_back(lease_of(life_, i).value_or(Nanoseconds{}).count());
    }
    for (std::uint32_t relation = 0; !has_server_ && relation < run.topology.relation_count();
         ++relation) {
      if (this->ends(relation).cross_host && !is_required(relation)) {
        run.missing -= run.topology.descriptor_count(relation);
      }
    }
  }

  void renew(comp::AnnouncementTimer part, std::uint32_t i) {
    this->renew_silently(part, i);
    this->assign(comp::AnnouncementsSent{}, i, 0);
  }
  void renew(comp::HeartbeatClock part, std::uint32_t w) {
    this->renew_silently(part, w);
    this->assign(comp::CycleBegan{}, w, 0);
    this->assign(comp::CyclePeriod{}, w, 0);
    this->template set_first<comp::AnnouncedAtStart>(w, 0);
    this->cycles_[w] = {};
  }
  void renew(comp::Reader part, std::uint32_t relation) {
    using States = fsm::Reflect<fsm::DiscoveryReader>;
    const fsm::StateId before = this->state(part, relation);
    const fsm::StateId after = this->topology().descriptor_count(relation) > 0
                                   ? States::template id<fsm::discovery_reader::Unknown>
                                   : States::template id<fsm::discovery_reader::EarlyComplete>;
    this->state(part, relation) = after;
    note_renewed<fsm::DiscoveryReader>(MachineRef::Kind::relation, relation, before, after);
  }
  void renew(comp::InitialTimer part, std::uint32_t relation) {
    this->renew_silently(part, relation);
  }

  /// Nobody is to know who dies: of other hosts, or with a server, of any.
  using Below::assign;
  void assign(comp::Recognised known, std::uint32_t pair, bool is_known) {
    const Pair& ends = this->topology().pair(pair);
    if ((ends.cross_host || has_server_) && dying_[ends.source] && !dying_[ends.destination]) {
      this->run_.missing += is_known ? 1U : 0U;
      this->run_.missing -= this->value(known, pair) ? 1U : 0U;
    }
    if (!is_known && this->value(known, pair) && counts(ends)) ++this->run_.forgotten;
    Below::assign(known, pair, is_known);
  }

  using Base::answer;
  template <class World>
  [[nodiscard]] std::int64_t answer(comp::LeaseDuration, const World& w) const {
    const Pair& ends = this->topology().pair(w.template number<comp::owner::pair>());
    const bool is_checked = checks_lease(this->run_.scenario, ends.source, ends.destination);
    return is_checked ? leases_[ends.source] : 0;
  }

  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override {
    std::vector<MissingDescriptor> list = Base::missing(SIZE_MAX);
    std::erase_if(list, [&](const MissingDescriptor& missing) {
      return !waits_for(missing.source.value) || !waits_for(missing.destination.value);
    });
    list.resize(std::min(list.size(), limit));
    return list;
  }

 protected:
  /// What observers are told of a machine that is a new one.
  static constexpr std::string_view renewed = "Renewed";

  template <class Machine>
  void note_renewed(MachineRef::Kind kind, std::uint32_t n, fsm::StateId before,
                    fsm::StateId after) {
    if (this->run_.probe == nullptr) return;
    using States = fsm::Reflect<Machine>;
    this->run_.probe->transition({.machine = {fsm::name_of<Machine>(), kind, n},
                                  .event = renewed,
                                  .before = States::state_names[before],
                                  .after = States::state_names[after]});
  }
  /// `Life::LoseAll` of participant i, with what the host has besides: `of_participant()`, and
  /// `of_writer(w)` for each.
  template <class Life, class Host, class OfParticipant, class OfWriter>
  void lose_all(Host& host, std::uint32_t i, OfParticipant&& of_participant, OfWriter&& of_writer) {
    renew(comp::AnnouncementTimer{}, i);
    this->cancel(comp::Announcement{}, i);
    of_participant();
    const Topology& topology = this->topology();
    for (std::uint32_t there = topology.first_pair(i); there < topology.first_pair(i + 1);
         ++there) {
      RunningWorld<Host, comp::owner::pair>{host, topology.pair(there).reverse}.call(
          typename Life::Forget{});
    }
    for (const std::uint32_t w : {2 * i, 2 * i + 1}) {
      renew(comp::HeartbeatClock{}, w);
      this->cancel(comp::HeartbeatExpiry{}, w);
      this->cancel(comp::CycleStart{}, w);
      this->cancel(comp::CycleEnd{}, w);
      this->cancel(comp::BatchDue{}, w);
      this->refill(w);
      of_writer(w);
    }
  }
  /// Returns that are part of the run.
  void schedule_returns() {
    for (const Restart& restart : life_.restarts) {
      if (restart.identity == Identity::fresh) continue;
      this->run_.schedule(restart.start, EventKind::participant_start, restart.participant);
    }
  }
  /// Whether discovery is complete only if the reader has everything.
  [[nodiscard]] bool is_required(std::uint32_t relation) const {
    const Pair& pair = this->ends(relation);
    return pair.cross_host && waits_for(pair.source) && waits_for(pair.destination);
  }
  template <class P>
  void renew_silently(P part, std::uint32_t n) {
    this->state(part, n) = fsm::Stepper<typename P::Machine>::initial;
  }

  /// Whether it counts that the pair's destination forgets its source: who comes back now has lost
  /// all that it had, and a Discovery Server is none of the participants.
  [[nodiscard]] bool counts(const Pair& ends) const {
    const std::uint32_t server = this->run_.scenario.deployment.size();
    if (ends.source >= server || ends.destination >= server) return false;
    return std::ranges::none_of(life_.restarts, [&](const Restart& restart) {
      return restart.participant == ends.destination && restart.start == this->run_.now;
    });
  }
  /// Whether discovery waits for it.
  [[nodiscard]] bool waits_for(std::uint32_t participant) const {
    return !is_replaced(life_, participant) && !dying_[participant];
  }

  const Life life_;

 private:
  const bool has_server_ = traits_of(this->run_.scenario.dds).has_server;
  const std::vector<bool> dying_;     // by participant
  std::vector<std::int64_t> leases_;  // by participant; 0: never forgotten
};

}  // namespace stormproof::model
