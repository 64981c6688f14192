// Lives of participants that can say goodbye (`ImplementationTraits::says_goodbye`): everybody ends
// once at most, after changes of its endpoints; times are measured in announcement periods, since
// leases are.
#include <algorithm>

#include "props/generators/on_demand.hpp"

namespace stormproof::props {

using namespace model;

namespace {

/// The scenario's moments of life.
class Times {
 public:
  Times(Dice& dice, const Scenario& scenario)
      : dice_{dice},
        quarter_{std::clamp<std::int64_t>(scenario.dds.spdp.period.count() / 4, 1, longest)} {
    for (const Participant& one : scenario.deployment.participants) {
      done_ = std::max(done_, one.endpoints_done);
    }
  }
  /// So many quarters of a period after all endpoints have been created, or a little later.
  [[nodiscard]] Nanoseconds after(std::int64_t from, std::int64_t to) const {
    return done_ + span(from, to) + Nanoseconds{dice_.between(0, 3)};
  }
  [[nodiscard]] Nanoseconds span(std::int64_t from, std::int64_t to) const {
    return Nanoseconds{dice_.between(from, to) * quarter_};
  }

 private:
  static constexpr std::int64_t longest = 1'000'000'000'000;

  Dice& dice_;
  std::int64_t quarter_;
  Nanoseconds done_{};
};

void draw_addresses(Dice& dice, const Times& times, DdsProfile& dds) {
  dds.peers = dice.count(1, 9);
  if (dice.chance(50)) dds.allow_multicast = AllowMulticast::never;
  if (dice.chance(60)) dds.spdp.initial_prune_delay = times.span(1, 30);
  if (dice.chance(60)) dds.spdp.discovered_prune_delay = times.span(1, 30);
}

void draw_outages(Dice& dice, const Times& times, const std::vector<Participant>& all, Life& life) {
  const auto last = static_cast<std::uint32_t>(all.size()) - 1;
  for (std::uint32_t k = dice.count(0, 2); k > 0; --k) {
    Outage outage{dice.count(0, last), dice.count(0, last), times.after(0, 16), {}};
    outage.end = outage.start + times.span(1, 16);
    outage.from_reach = dice.choice<Reach>(3);
    outage.to_reach = dice.choice<Reach>(3);
    const bool is_within = outage.from_reach == Reach::participant &&
                           outage.to_reach == Reach::participant &&
                           all[outage.from].host == all[outage.to].host;
    if (!is_within) life.outages.push_back(outage);
  }
}

void draw_changes(Dice& dice, const Times& times, std::uint32_t i, const Participant& one,
                  Life& life) {
  if (dice.chance(30)) {
    LateEndpoints late{i, dice.count(0, 2), dice.count(0, 2), times.after(0, 8), {}};
    if (dice.chance(40)) late.until = late.at + times.span(1, 4);
    life.endpoints.push_back(late);
  }
  if (one.publications > 0 && dice.chance(30)) {
    life.deletions.push_back({.participant = i,
                              .publication = dice.count(0, one.publications - 1),
                              .at = times.after(0, 8)});
  }
  if (one.subscriptions > 0 && dice.chance(30)) {
    life.deletions.push_back({.participant = i,
                              .subscription = dice.count(0, one.subscriptions - 1),
                              .at = times.after(0, 8)});
  }
}

void draw_end(Dice& dice, const Times& times, std::uint32_t i, Life& life) {
  const Nanoseconds end = times.after(16, 24);
  if (dice.chance(15)) {
    life.mute.push_back({i, end});
  } else if (dice.chance(15)) {
    life.leaves.push_back({i, end});
  } else if (dice.chance(30)) {
    life.restarts.push_back(
        {i, end, end + times.span(1, 8), Identity::fresh, dice.choice<Goodbye>(2)});
  }
}

}  // namespace

void draw_goodbyes(Dice& dice, Scenario& scenario) {
  const std::vector<Participant>& all = scenario.deployment.participants;
  const Times times{dice, scenario};
  scenario.wireless.sender = Sender::backlog;
  scenario.hosts.reset();
  if (dice.chance(40)) draw_addresses(dice, times, scenario.dds);
  Life life;
  if (dice.chance(50)) life.lease = times.span(5, 12);
  draw_outages(dice, times, all, life);
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (dice.chance(20)) life.leases.push_back({i, times.span(5, 30)});
    draw_changes(dice, times, i, all[i], life);
    draw_end(dice, times, i, life);
  }
  scenario.deployment.life = std::move(life);
  scenario.time_limit = times.after(60, 60);
  scenario.run_until = RunUntil::time_limit;
}

}  // namespace stormproof::props
