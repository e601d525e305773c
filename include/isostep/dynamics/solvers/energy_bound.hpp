// EnergyBound<S>: a body that touches only what stands still leaves a step with no more energy than it had.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

/// Ground that stands still does no work. Contacts are found once a step, and what rolls on an edge has left its arms,
/// its normal's lever and its axes of inertia behind when the step ends: it sinks along the old ones and is pushed up
/// along the new, for nothing. A barrel on its rim made twelve times its energy of that in forty seconds, a can that
/// rocked a tenth more in twenty, whatever the sub-steps. So what a step made is taken from the motion as a whole:
/// velocity and turning by one factor, which neither lifts a point off what it touches nor lets it slip.
/// Bodies with joints, with forces but gravity, on what moves, on belts and with restitution are left alone: there
/// energy comes and goes.
/// Symbols: v = velocity, u = angular velocity about the principal axes, each times the axis' radius of gyration
///          [m/s], T = v^2 + u^2 [m^2/s^2] twice the kinetic energy by mass, x = part of T that is too much.
template <class S> class EnergyBound {
  using V = Velocity<S>;

 public:
  using Energy = SumOf<V, V>;  // [m^2/s^2]

  /// Finds the bodies that are bound; `bodies` of them are awake.
  void find(const StepContext<S>& context, std::size_t bodies);
  ISO_INLINE void release(std::size_t body) { kinds_[body + 1] = kFree; }
  ISO_INLINE bool binds(std::size_t body) const { return kinds_[body + 1] == kTouches; }

  /// Call it as the step begins. `axes`: principal axes in the world, of bodies that are kSpins.
  void begin(std::size_t body, const BodyState<S>& state, const BodyProperties<S>& properties,
             const Mat3<Unit<S>>& axes);
  /// Call it as the step ends. `displacement` [m] of the centre since.
  void hold(const StepContext<S>& context, std::size_t body, Vec3<V> displacement, const Mat3<Unit<S>>& axes,
            MotionRow<V>& row) const;

 private:
  static constexpr std::uint8_t kTouches = 1, kFree = 2;
  struct Motion {
    Vec3<V> v, u;
  };

  static Motion motion_of(Vec3<V> velocity, Vec3<V> angular_velocity, const BodyProperties<S>& body,
                          const Mat3<Unit<S>>& axes);
  static ISO_INLINE Energy energy_of(const Motion& m) { return dot_sum(m.v, m.v) + dot_sum(m.u, m.u); }

  std::vector<std::uint8_t> kinds_;  // by row of the bodies
  std::vector<Energy> begin_;        // of each body that is bound
};

#define ISO_EXTERN_ENERGY_BOUND(S) extern template class EnergyBound<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN_ENERGY_BOUND)
#undef ISO_EXTERN_ENERGY_BOUND

}  // namespace isostep
