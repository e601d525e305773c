// ArticulatedTree<S>: a definition that was found sound, as the algorithm uses it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "isostep/articulation/articulation_definition.hpp"
#include "isostep/core/result.hpp"
#include "isostep/geometry/validate.hpp"
#include "isostep/state/archive.hpp"

namespace isostep::detail {

/// A link in the tree's own units: its mass is 1, its reach 32 to 64 long, whatever it is made of. Fixed point so keeps
/// its bits: of a tree that reaches a metre, a twist of 1e-6 of its inertia still has 22.
/// Symbols: coordinates of hinges are [rad], of sliders in units of length; forces are over the tree's mass.
template <class S> struct PreparedLink {
  std::uint32_t parent;  // place of its parent's work, 0: the base
  ArticulationJoint type;
  std::uint32_t coordinate, rotation, speed;  // first of its own in the state's arrays
  bool limited;
  Vec3<S> offset;        // of frame a, from the parent's frame b, along the parent's axes
  Quat<Unit<S>> before;  // frame a in the parent
  Quat<Unit<S>> after;   // the link in frame b
  Vec3<Unit<S>> axis;    // [1]
  S mass;                // [1]
  Vec3<S> centre;        // from frame b, along the link's axes
  Vec3<S> inertia;       // principal
  Quat<Unit<S>> principal;
  S armature;
  S damping, stiffness;  // h d and h^2 k, which are inertias too
  S rest, lower, upper;
};

/// Immutable, shared by an articulation and its snapshots.
template <class S> struct ArticulatedTree {
  ArticulationDefinition<S> definition;
  std::uint64_t hash = 0;          // of the definition
  S scale = S(1), unscale = S(1);  // [1/m] [m] a power of two and its inverse
  S mass = S(1);                   // [kg] of all links
  S rate = S(1);                   // [1/s] sub-steps
  Step<S> h = Step<S>(0);          // [s] of a sub-step
  S spin = S(1);                   // [rad/s] the most that a link spins
  bool free = false;               // the first link is
  std::uint32_t coordinates = 0, rotations = 0, speeds = 0;
  std::vector<PreparedLink<S>> links;

  /// x h^`times` over the tree's mass, in units: of a hinge's [kg m^2] or a torque, `lengths` is 2, of a force 1, of a
  /// mass 0. Held within half of the format.
  S over_mass(S x, int lengths, int times = 0) const;
  /// The coefficient of a spring, damper or rotor in a joint, `over_mass` so: beyond kMostCoefficient it counts as
  /// that, which is as good as rigid.
  S coefficient(S x, ArticulationJoint type, int times) const;
};

/// Returns the power of the unit of length in the inertia of a joint's coordinates.
ISO_INLINE constexpr int lengths_of(ArticulationJoint type) { return type == ArticulationJoint::slider ? 0 : 2; }
ISO_INLINE constexpr bool is_scalar(ArticulationJoint type) {
  return type == ArticulationJoint::hinge || type == ArticulationJoint::slider;
}
ISO_INLINE constexpr bool has_rotation(ArticulationJoint type) {
  return type == ArticulationJoint::ball || type == ArticulationJoint::free;
}

/// Returns true if the quaternion has length 1, as poses of shapes have.
template <class S> ISO_INLINE bool is_rotation(const Quat<Unit<S>>& q) {
  const Pose<S> pose = {Vec3<S>::zero(), q};
  return validate(pose) == ShapeFault::none;
}

/// Makes the tree, or returns the wrong field of the definition: "links[3].mass.mass".
template <class S>
Result<std::shared_ptr<const ArticulatedTree<S>>> make_tree(const ArticulationDefinition<S>& definition);
/// Checks one drive of a link of that type; `place` is empty.
template <class S>
Result<void> check_drive(const ArticulatedTree<S>& tree, std::uint32_t link, const ArticulationDrive<S>& drive);

template <class S> void write_definition(Writer& writer, const ArticulationDefinition<S>& definition);
template <class S> ArticulationDefinition<S> read_definition(Reader& reader);

}  // namespace isostep::detail
