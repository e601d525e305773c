// Measures of a world, for reports: overlap by exact geometry, energy, joint error. All in double, never fed back.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include "isostep/world/world.hpp"

namespace isostep::scenes {

template <class T> Vec3<double> in_double(Vec3<T> v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
template <class U> Quat<double> in_double(const Quat<U>& q) {
  return {to_double(q.x), to_double(q.y), to_double(q.z), to_double(q.w)};
}
inline double length_of(Vec3<double> v) { return std::sqrt(dot(v, v)); }

/// The overlap over pairs of parts that may collide and are closer than 1 cm, overlapping ones included.
struct Overlap {
  double worst = 0;        // [m]
  double mean = 0;         // [m] over the pairs, a gap counting as 0
  double p99 = 0;          // [m]
  std::uint32_t deep = 0;  // pairs deeper than 5 cm
  std::uint32_t pairs = 0;
};
template <class S> Overlap measure_overlap(const World<S>& world);

/// The energy of all dynamic bodies, asleep or not. Potential energy is zero at the origin.
struct Energy {
  double kinetic = 0;    // [J] of translation and rotation
  double potential = 0;  // [J]
  double mass = 0;       // [kg]
  double total() const { return kinetic + potential; }
};
template <class S> Energy measure_energy(const World<S>& world);

/// The largest separation of any joint's anchors [m].
template <class S> double largest_joint_error(const World<S>& world);

#define ISO_EXTERN(S)                                          \
  extern template Overlap measure_overlap<S>(const World<S>&); \
  extern template Energy measure_energy<S>(const World<S>&);   \
  extern template double largest_joint_error<S>(const World<S>&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
