// Free flight over lanes: what gravity and drag do to particles, and how velocities and positions follow.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/core/simd.hpp"
#include "isostep/particles/axes.hpp"
#include "isostep/particles/limits.hpp"
#include "isostep/particles/spring_rows.hpp"

namespace isostep {

/// A material as a sub-step needs it.
template <class S> struct FlightRow {
  Vec3<S> gravity;   // [m/s^2]
  S linear_drag;     // [N s/m]
  S quadratic_drag;  // [N s^2/m^2]
  Step<S> keep;      // [1] of the velocity, a sub-step

  ISO_FIELDS(gravity, linear_drag, quadratic_drag, keep)
};

/// Particles first <= slot < end, and what a sub-step reads and writes of them.
template <class S> struct FlightRun {
  const FlightRow<S>* rows;       // by material
  const std::uint32_t* material;  // by slot, as all below
  const InverseMass<S>* inverse_mass;
  AxesView<S> position;                // [m] as the step began
  AxesView<S> now;                     // [m]
  AxesView<Velocity<S>> velocity;      // [m/s]
  AxesView<Velocity<S>> displacement;  // [m] since the step began
  AxesView<S> acceleration;            // [m/s^2]
  std::uint32_t first, end;
  Step<S> h;              // [s]
  S rate;                 // [1/s] 1/h
  std::int32_t substeps;  // of fly
  bool moves_first;       // the book's order: positions by the old velocity
};

template <class S> struct FlightKernels {
  const char* name;
  std::int32_t width;
  /// Computes a = gravity - v (k1 + k2 |v|) / m of particles that are not pinned. Drag stops but never reverses them.
  void (*accelerate)(const FlightRun<S>&);
  /// Computes v = (v + a h) keep, d += v h.
  void (*advance)(const FlightRun<S>&);
  /// Computes all sub-steps of both, from d = 0.
  void (*fly)(const FlightRun<S>&);
  /// Computes now = position + d.
  void (*place)(const FlightRun<S>&);
  /// Computes position += d. Stops before the first block with a particle out of range or NaN; returns its begin.
  std::uint32_t (*finish)(const FlightRun<S>&);
  /// Adds the accelerations of springs to their ends.
  void (*pull)(const SpringRun<S>&);
};

/// The kernels for `simd`. Null when the processor or build lacks it; never for `best`.
template <class S> const FlightKernels<S>* flight_kernels(Simd simd);

#define ISO_DECLARE_FLIGHT_KERNELS(S)         \
  ISO_DECLARE_KERNEL_TABLES(FlightKernels<S>) \
  template <> const FlightKernels<S>* flight_kernels<S>(Simd simd);
ISO_FOR_EACH_SCALAR(ISO_DECLARE_FLIGHT_KERNELS)

}  // namespace isostep
