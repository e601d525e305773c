// The kernels that integrate bodies, as a table: one for each instruction set, chosen at run time, all giving the same
// bits.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "isostep/core/instantiate.hpp"
#include "isostep/core/simd.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/solver_body.hpp"

namespace isostep {

/// Bits that select how a body is integrated.
namespace body_kind {
inline constexpr std::uint8_t kDriven = 1;   // by forces and damping: it is dynamic
inline constexpr std::uint8_t kDamped = 2;   // a factor of its BodyFactors is not one
inline constexpr std::uint8_t kLocked = 4;   // along or about an axis of the world
inline constexpr std::uint8_t kSpins = 8;    // its inertia differs between axes
inline constexpr std::uint8_t kTurns = 16;   // free turning changes its angular velocity
inline constexpr std::uint8_t kSolid = 32;   // its moments are those of a solid: FreeTurn::is_solid
inline constexpr std::uint8_t kTilted = 64;  // its principal axes are not those of its frame
inline constexpr std::uint8_t kMet = 128;    // it has contacts in this step
}  // namespace body_kind

/// The parts of a body's velocities that damping leaves in a sub-step.
template <class S> struct BodyFactors {
  S linear_keep, angular_keep;  // [1]
  S reserved[2];                // 0: rows of four numbers
};

/// A body that only gravity moves in a sub-step follows a parabola: it moves by the mean of its old and its new
/// velocity, half of the gain less than the new one. So its energy stays, with any sub-steps. Other forces may depend
/// on a body's place: treated like that, they would drive it. Rows of four numbers.
template <class S> struct BodyFlight {
  Vec3<Velocity<S>> fallen;  // [m/s] velocity after a sub-step of gravity alone
  Velocity<S> pad0;
  Vec3<Velocity<S>> fall;  // [m/s] what a sub-step of gravity adds to it
  Velocity<S> pad1;
};

/// Free turning: gyroscopic.hpp. Rows of four numbers.
template <class S> struct BodyTurn {
  Vec3<S> euler;  // [1]
  S pad0;
  Vec3<Velocity<S>> known;  // [rad/s] principal frame: angular velocity after the last free turn
  Velocity<S> pad1;
  Vec3<S> inertia;  // [1]
  S pad2;
};

/// Bodies first..end-1 over one sub-step. Each pointer is to the data of body 0.
template <class S> struct BodyRun {
  std::size_t first, end;
  Step<S> h;                             // [s]
  Velocity<S> rapid;                     // [rad/s] what turns faster about an axis is finished one by one
  Velocity<S> fast;                      // [rad/s] what turns faster about an axis moves one by one
  const Acceleration<S>* accelerations;  // or null
  BodyState<S>* states;
  const BodyProperties<S>* properties;
  MotionRow<Velocity<S>>* velocity;
  MotionRow<Velocity<S>>* displacement;
  const Vec3<S>* start;  // [m] centres when the step began
  const std::uint8_t* kinds;
  const BodyFactors<S>* factors;
  BodyFlight<S>* flights;
  BodyTurn<S>* turns;
  std::uint32_t* left;  // place for one number a body
};

/// The kernels of one instruction set. Each call returns the number of bodies left to be finished one by one;
/// run.left[first...] names them in order, as 2 i or 2 i + 1 for body i.
/// Velocities: forces, damping and free turning of slow solids. Left are bodies that must still turn, 2 i + 1, and
///             bodies that are locked or, after they turned, rapid: 2 i.
/// Positions:  left are fast bodies, 2 i + 1, and other locked ones, 2 i: neither has moved.
template <class S> struct BodyKernels {
  const char* name;
  std::int32_t width;
  std::size_t (*integrate_velocities)(const BodyRun<S>&);
  std::size_t (*integrate_positions)(const BodyRun<S>&);
};

/// Returns the kernels for `simd`, or those of one lane if it has none. Every scalar has its own full specialisation, a
/// strong symbol.
template <class S> const BodyKernels<S>* body_kernels(Simd simd);

#define ISO_DECLARE_BODY_KERNELS(S)         \
  ISO_DECLARE_KERNEL_TABLES(BodyKernels<S>) \
  template <> const BodyKernels<S>* body_kernels<S>(Simd simd);
ISO_FOR_EACH_SCALAR(ISO_DECLARE_BODY_KERNELS)

}  // namespace isostep
