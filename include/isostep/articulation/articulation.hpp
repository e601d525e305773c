// Articulation<S>: a tree of links in joint coordinates, beside the world: joints that never part, at any stiffness.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>

#include "isostep/articulation/articulation_definition.hpp"
#include "isostep/articulation/articulation_state.hpp"
#include "isostep/core/fault.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/scalar/finer.hpp"
#include "isostep/state/archive.hpp"

namespace isostep {

/// The velocity of a link.
template <class S> struct LinkVelocity {
  Vec3<S> linear;   // [m/s] world, of the origin of its frame
  Vec3<S> angular;  // [rad/s] world
};

/// The counts of the last step.
struct ArticulationReport {
  std::uint32_t stopped = 0;  // joints that a limit held in the last sub-step
  std::uint32_t clamped = 0;  // sub-steps at whose end links would have been faster than they may
  std::uint32_t lost = 0;     // sub-steps that ended in no number: the tree stays where it was, and rests
};

/// Links on hinges, sliders and balls, without loops, on a fixed base or free. A World holds joints together by
/// impulses; here they are the coordinates, so nothing parts, energy is kept to second order, and armature, springs and
/// drives may be as stiff as wanted. It has no contacts: kinematic bodies that follow link_pose() and link_velocity()
/// push other bodies, and what pushes back is up to the game, by apply_force().
///
/// A sub-step of h: coordinates go half their way by the speeds; accelerations a are found there, for speeds half a
/// change later; speeds change by h a; coordinates go the other half. This midpoint rule is its own inverse, but for
/// damping, limits and the error of the two passes that find a. Springs, dampers, drives and limits:
/// detail::JointWork. A free tree's momentum: detail::FreeMotion.
///
/// Source:  Featherstone 2008, Rigid Body Dynamics Algorithms, table 7.1 (articulated-body algorithm, O(n)); Hairer,
///          Lubich, Wanner 2006, Geometric Numerical Integration, I.1.4 (Stoermer-Verlet) and V.1 (symmetric methods).
/// Error:   double pendulum, 1 kg and 1 m twice, from 90 degrees, 60 s at 480 sub-steps a second: energy within 0.01 J
///          of 30 J. Free trees keep momentum to rounding. Measured in tests/laws/articulation_test.cpp.
/// Limits:  `build` checks what a definition may hold. A link spins by 256 rad/s or half a radian a sub-step at most, a
///          slider moves by 4096 units a second (the reach of a tree is 32 to 64 units); faster trees are slowed as a
///          whole and reported. 32 bits of fixed point are too few for products of inertias: S is float, double or
///          fixed point of 64 bits.
/// Cost:    a sub-step takes some 0.3 us a link in float and double, 0.7 us a hinge in Q32_32. Only `build` allocates.
/// Order:   all sums go by links.
template <class S> class Articulation {
  static_assert(std::same_as<Finer<S>, S>, "isostep: an articulation needs float, double or 64 bits of fixed point");
  ISO_REQUIRE_ENGINE(S);
  struct Engine;

 public:
  class Snapshot;

  /// An articulation has no links until one is built.
  Articulation();
  ~Articulation();
  /// The other is as good as new.
  Articulation(Articulation&& other) noexcept;
  Articulation& operator=(Articulation&& other) noexcept;

  /// All coordinates and speeds begin at 0. A refused definition changes nothing; the error's place is the field.
  Result<void> build(const ArticulationDefinition<S>& definition);
  const ArticulationDefinition<S>& definition() const;
  std::uint32_t links() const;
  std::uint64_t tick() const;

  // Setters for the time between steps. False: refused, and fault() tells why.
  /// Sets position and speed of a joint; a hinge without limits is taken by whole turns between -pi and pi.
  bool set_coordinates(std::uint32_t link, const JointCoordinates<S>& coordinates);
  bool set_drive(std::uint32_t link, const ArticulationDrive<S>& drive);
  /// Applies a force [N] for the next step at a point of the world [m]; it acts at that place of the link while it
  /// moves.
  bool apply_force(std::uint32_t link, Vec3<S> force, Vec3<S> point);
  /// Applies a torque [N m], world, for the next step.
  bool apply_torque(std::uint32_t link, Vec3<S> torque);
  /// These are World's.
  const FaultReport& fault() const;
  const FaultReport& first_fault() const;
  void forget_faults();
  void set_fault_handler(const FaultHandler& handler);

  ArticulationReport step();

  // Getters give the identity and zeros for a link that is not there.
  JointCoordinates<S> coordinates(std::uint32_t link) const;
  ArticulationDrive<S> drive(std::uint32_t link) const;
  /// [m] world.
  Pose<S> link_pose(std::uint32_t link) const;
  LinkVelocity<S> link_velocity(std::uint32_t link) const;
  /// [m] world, of mass.
  Vec3<S> link_centre(std::uint32_t link) const;
  /// [N] [N m] world: what its parent gave the link through the joint in the last sub-step, about frame b's origin, the
  /// joint's own drives and springs among it. Not state: zero after `load`.
  LinkLoad<S> joint_load(std::uint32_t link) const;

  /// The definition is shared, not copied.
  void save(Snapshot& to) const;
  /// Loads a saved state. Returns false, with no change and a fault, where `from` was never saved to or was moved from.
  bool load(const Snapshot& from);
  std::uint64_t hash() const;
  /// Writes the definition as well: whoever reads it needs nothing else.
  void write_portable(Writer& writer) const;
  Result<void> read_portable(Reader& reader);
  const ArticulationState<S>& state() const;

 private:
  std::unique_ptr<Engine> engine_;
};

/// May be saved into again and again.
template <class S> class Articulation<S>::Snapshot {
 public:
  Snapshot();
  ~Snapshot();
  Snapshot(Snapshot&& other) noexcept;
  Snapshot& operator=(Snapshot&& other) noexcept;

 private:
  friend class Articulation;
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

#define ISO_ARTICULATION_OF(extern, S) extern template class Articulation<S>;
ISO_EXTERN_FLOAT(ISO_ARTICULATION_OF) ISO_EXTERN_DOUBLE(ISO_ARTICULATION_OF) ISO_EXTERN_Q32_32(ISO_ARTICULATION_OF)

}  // namespace isostep
