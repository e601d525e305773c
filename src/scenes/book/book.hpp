// The demonstrations of Millington's Game Physics Engine Development, as scenes with scripts in place of a player.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/world.hpp"
#include "scenes/scene.hpp"

namespace isostep::scenes {

// Aircraft, flight.cpp.
/// Level for a minute, then a turn to the right or, mirrored, to the left.
enum class Turn { right, left };
Scene flight(Turn turn);
inline constexpr int kFlightTurns = 3600;     // [frames] of level flight
inline constexpr double kFlightHeight = 100;  // [m]
inline constexpr double kFlightSpeed = 8;     // [m/s]
inline constexpr double kFlightBank = 0.2;    // [1] sine of the bank that the turn asks for
template <class S> void fly(World<S>& world, Turn turn);

// A boat under sail, sail.cpp.
/// With wind from the side it sails a course; without it floats.
Scene sailing(bool wind);
template <class S> void steer(World<S>& world);

// Guns, ballistics.cpp.
/// Rounds of two guns at two cubes.
Scene ballistics();
template <class S> void shoot(World<S>& world);

// Explosions, blast.cpp.
/// The book's ten bodies.
Scene rubble();
/// A blast amid so many boxes about its centre.
Scene blast(int bodies);
inline constexpr int kBlastBegins = 60;  // [frames]

// Small machines, machines.cpp.
/// 50 links between two hooks at one height: a catenary.
Scene catenary();
inline constexpr int kCatenaryLinks = 50;
/// A spinning top on its point.
Scene top();
inline constexpr double kTopTilt = 0.3, kTopSpin = 60;  // [rad], [rad/s] about its axis
/// [rad/s] The slow root of I1 cos(tilt) p^2 - I3 spin p + m g r = 0: I1 = 1/16 + 1/300 + 1 about the point, I3 = 1/8.
inline constexpr double kTopPrecession = 1.7483;
/// A door that swings about a level axis.
Scene pendulum_door();
/// A crank that a motor turns, a rod, and a block that moves along a line.
Scene piston();

// Friction, frictions.cpp.
/// Balls with and without rolling resistance, let go on a slope.
Scene rolling();
/// Sledges along, askew of and across their runners.
Scene sledges();
inline constexpr double kSledgeRunners = 0.0625;  // [1] of friction that is left along them
/// Crates on slopes that friction at rest holds, or not.
Scene slopes();

// Fracture, fracture.cpp. Pieces are made by break_bodies(), which before_step() calls.
/// The book's: a ball at a cube, in eight, and eight again.
Scene broken_cube();
/// Eight boxes, wood, glass and stone.
Scene materials();
/// A ball at boxes that break.
Scene breakable_tower();
inline constexpr int kTowerBoxes = 100;

// One of every record, elements.cpp: for the self-check.
Scene elements();
inline constexpr int kElementsFrames = 150;  // until the charge is over and the pieces are gone

// Coarse structures, coarse.cpp.
Scene coarse(BroadPhaseName structure);

#define ISO_EXTERN(S)                           \
  extern template void fly<S>(World<S>&, Turn); \
  extern template void steer<S>(World<S>&);     \
  extern template void shoot<S>(World<S>&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
