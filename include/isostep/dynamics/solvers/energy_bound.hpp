// EnergyBound<S>: what nothing drives leaves a step with no more energy than it had.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

/// Takes away energy that a step made. Contacts and joints do no work except to dissipate. But contacts are found once
/// a step, and a body that rolls on an edge has left its arms, its normal's lever and its axes of inertia behind when
/// the step ends: it sinks along the old ones and is pushed up along the new ones. At any number of sub-steps a barrel
/// on its rim gained twelve times its energy in forty seconds, a rocking can a tenth in twenty. The bound scales the
/// motion of a group, velocities and turns, by one factor, which neither lifts a point off what it touches nor lets it
/// slip nor opens a joint.
/// The bound takes of bodies on contacts no more than a turn by t in a step can have made, about t^2 of the energy and
/// of g r: a body that is pushed out of an overlap rises, and goes on.
/// A group is what contacts and joints tie, up to kMost bodies: larger groups hide what one body makes. It lies on or
/// hangs from what stands still: otherwise the factor would take momentum. Groups with motors, springs, drives or
/// scaled masses, on moving bodies, on belts or with mechanisms are left alone, as energy comes and goes there. Work of
/// forces counts as theirs.
/// A jointed body keeps T / 2 - g x + h g v / 2 under semi-implicit Euler, not its energy: the bound holds for that
/// quantity there, as by the energy each swing would lose the amplitude of its ripple. A free fall keeps its energy. A
/// solver that closes joints' errors by speeds that stay (pgs) needs what it makes: its groups with joints are left
/// alone.
/// Symbols: v = velocity, u = angular velocity about the principal axes times their radii of gyration [m/s], T = sum of
///          (m / M) (v^2 + u^2) [m^2/s^2] twice the kinetic energy by the group's mass M or more, x = part of T that is
///          too much, g = gravity [m/s^2], h = a sub-step [s], r = largest radius of gyration [m].
template <class S> class EnergyBound {
  using V = Velocity<S>;

 public:
  /// Finds the groups that are bound, and their energies. `h` [s] is a sub-step; `binds_joints`: see above.
  void begin(const StepContext<S>& context, Step<S> h, bool binds_joints);
  ISO_INLINE bool any() const { return !groups_.empty(); }
  /// Adds the work that forces do on bodies first..end-1. Call it before a sub-step's velocities are integrated.
  void add_work(const StepContext<S>& context, const SolverBodies<S>& rows, std::size_t first, std::size_t end);
  /// Bounds the energies by the velocities in context.states. Call it as the step ends.
  void hold(const StepContext<S>& context, const SolverBodies<S>& rows) const;

 private:
  using Energy = SumOf<V, V>;  // [m^2/s^2]
  static constexpr std::uint32_t kMost = 64;
  static constexpr std::uint8_t kNothing = 0, kFree = 1, kStands = 2, kHangs = 4;
  struct Motion {
    Vec3<V> v, u;
  };
  struct Group {
    std::uint32_t first, end;  // in members_
    bool hangs;                // joints hold it
  };

  void tie(const StepContext<S>& context, std::uint32_t a, std::uint32_t b, std::uint8_t kind);
  std::uint32_t leader_of(std::uint32_t row);
  void find_groups(const StepContext<S>& context);
  void weigh(const StepContext<S>& context, Group group);
  void hold_group(const StepContext<S>& context, const SolverBodies<S>& rows, Group group) const;
  Vec3<V> gravity_of(const StepContext<S>& context, std::size_t body) const;
  Energy lag_of(const StepContext<S>& context, std::size_t body) const;
  Motion motion_of(const StepContext<S>& context, std::size_t body, Vec3<V> velocity, Vec3<V> angular_velocity) const;
  static ISO_INLINE Energy energy_of(const Motion& m) { return dot_sum(m.v, m.v) + dot_sum(m.u, m.u); }

  // By row of the bodies:
  std::vector<std::uint8_t> kinds_;
  std::vector<std::uint32_t> leaders_;  // the lowest row of its group, or one on the way to it
  std::vector<std::uint32_t> sizes_;    // of a leader: of its group; then the group's place in groups_ and 1, 0: none
  std::vector<Group> groups_;
  std::vector<std::uint32_t> members_;  // bodies, group by group
  // By body:
  std::vector<Vec3<S>> radii_;   // [m] of gyration, principal axes; 0: it does not turn
  std::vector<V> weights_;       // [1] the root of its share of the group's mass, or less; 0: not bound
  std::vector<Energy> allowed_;  // of its share
  std::vector<Vec3<V>> begin_;   // [m/s] velocities as the step began
  Step<S> h_ = Step<S>(0);       // [s] a sub-step
};

#define ISO_EXTERN_ENERGY_BOUND(S) extern template class EnergyBound<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN_ENERGY_BOUND)
#undef ISO_EXTERN_ENERGY_BOUND

}  // namespace isostep
