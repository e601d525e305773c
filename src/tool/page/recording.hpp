// A recording, which a page plays: a run as plain numbers, rounded to what an eye can see.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "effects.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/geometry/shape.hpp"
#include "surfaces.hpp"

namespace isostep::tool::page {

inline constexpr double kGrid = 1.0 / 16384;  // [m] positions are whole multiples of it

/// A primitive in its body's frame.
struct Part {
  ShapeType type;
  std::array<float, 3> half;                // [m]
  float radius;                             // [m]
  std::array<float, 3> at;                  // [m] its centre; of a half-space: a point of its surface
  std::array<float, 4> turn;                // x y z w
  std::array<float, 3> outward;             // [1] of a half-space
  std::uint32_t surface = Surfaces::kNone;  // its place in Recording::surfaces
};

/// A body, particle or wheel for as long as it has its id.
struct Actor {
  std::uint32_t slot, generation;
  BodyType type;  // pinned particles are kinematic
  bool sensor;
  float radius;  // [m] of a particle
  std::vector<Part> parts;
  bool wheel = false;  // then slot and generation are those of the wheel
};

/// A joint, spring or link: a line between two points.
struct Bond {
  static constexpr std::int32_t kNobody = -1;
  const char* kind;                 // one of kJointNames, "spring", "bungee", "stiff", "cable", "rod"
  std::int32_t a, b;                // actors; kNobody: the world
  std::array<float, 3> at_a, at_b;  // [m] in the actor's frame, or the world's
  std::uint32_t first, last;        // frames of the recording in which it is there
};

/// Scenery: particles meet it and nothing moves it.
struct Scenery {
  bool plane;                    // else a line
  std::array<float, 3> outward;  // [1] of a plane
  std::array<float, 3> from;     // [m] a point of the plane, or where the line begins
  std::array<float, 3> to;       // [m] of a line
  float radius;                  // [m] of a line
};

struct Pose {
  std::array<std::int32_t, 3> at;     // in kGrid
  std::array<std::uint16_t, 3> turn;  // see pack_turn
  friend bool operator==(const Pose&, const Pose&) = default;
};
struct Moved {
  std::uint32_t actor;
  Pose pose;
};
enum class Change : std::uint32_t { gone, awake, asleep };
struct Changed {
  std::uint32_t actor;
  Change to;  // static bodies count as awake
};
struct ContactPoint {
  std::array<float, 3> at;            // [m]
  std::array<std::int8_t, 3> normal;  // [1/127]
  std::uint8_t force;                 // 16 log2(1 + newtons)
};

struct Frame {
  std::uint64_t tick, hash;
  double energy;  // [J]
  double depth;   // [m] deepest overlap of its contacts
  std::vector<Changed> changed;
  std::vector<Moved> moved;  // since the frame before, ascending by actor
  std::vector<ContactPoint> points;
  std::vector<Push> pushes = {};  // of every effect that pushes
};

struct Recording {
  std::string scalar, solver;
  int hz = 60, substeps = 1;
  bool particles = false;  // no actor turns
  std::vector<Actor> actors;
  std::vector<Bond> bonds;
  std::vector<Effect> effects;
  std::vector<Scenery> scenery;
  Surfaces surfaces;
  std::vector<Frame> frames;
};

/// The smallest three of a unit quaternion in 15 bits each; which one is left out in the top bits of the first two.
std::array<std::uint16_t, 3> pack_turn(const float (&quaternion)[4]);

/// A recording in a page [bytes]: little-endian, see player's decode.js for the layout. `room`: for contact points;
/// where they would take more, they are kept of every n-th frame.
struct Packed {
  std::vector<std::uint8_t> bytes;
  std::array<float, 3> points_low, points_size;  // [m] contact points are 16-bit fractions of that box
  std::uint32_t points_every = 1;
  float strongest = 0;  // [N] component of a push: pushes are 16-bit fractions of it
};
Packed pack(const Recording& recording, std::size_t room);
std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace isostep::tool::page
