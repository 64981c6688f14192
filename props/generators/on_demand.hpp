// What random scenarios have only if somebody asks: channels, ways to discover, amended rules and
// lives of participants of which the engines and laws know too little for every test.
#pragma once

#include <cstdint>

#include "model/scenario.hpp"
#include "props/generators/dice.hpp"

namespace stormproof::props {

/// A channel of units with limits that matter.
void draw_units(Dice& dice, model::WirelessProfile& wireless);
/// Mostly such a channel, and hosts that may stall or count what is admitted, with a small buffer.
void draw_radio(Dice& dice, model::WirelessProfile& wireless);

/// The hosts of the deployment, listed: stations of one to three access points on one or two
/// channels, with rates, wired ones, and some that sleep.
void draw_fleet(Dice& dice, model::Deployment& deployment);
/// Transmissions that fail, often or in bursts, with few retries.
void draw_frame_loss(Dice& dice, model::WirelessProfile& wireless);
/// Queues of a channel of units that drop frames, with limits that matter in short runs.
void draw_queue(Dice& dice, model::WirelessProfile& wireless);
/// Threads that take a time that matters.
void draw_processor(Dice& dice, model::Scenario& scenario);

/// A network with a constant delay that loses many of the first packets and delivers others later
/// than timers that wait for them; and endpoints that come late.
void draw_disturbances(Dice& dice, model::Scenario& scenario);

/// Another way to discover, with odd knobs of it, as a function of the seed.
void draw_discovery(std::uint64_t seed, model::Discovery discovery, model::Scenario& scenario);

/// Two or three Discovery Servers, which the scenario must have; participants are clients of all or
/// of some, and servers may look for each other. Lives have to be drawn after them.
void draw_servers(Dice& dice, model::Scenario& scenario);

/// What later versions of Fast DDS have.
void draw_version(Dice& dice, model::DdsProfile& dds);
/// Types of endpoints that participants mostly ask for; nothing is lost then. The profile must be
/// one of Fast DDS without a server.
void draw_types(Dice& dice, model::Scenario& scenario);

/// Amended rules of the paper's model, whose profile the scenario must have: most are left as they
/// are. And a life.
void draw_amendments(Dice& dice, model::Scenario& scenario);
/// What happened before the run, and happens to participants in it.
void draw_life(Dice& dice, model::Scenario& scenario);
/// The same of Cyclone DDS, which must be the scenario's; and peers. Some announcement periods
/// long.
void draw_goodbyes(Dice& dice, model::Scenario& scenario);

}  // namespace stormproof::props
