// A scene's numbers in double, and the mass and inertia of its bodies: what judges know before the run.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/mat3.hpp"
#include "scenes/build.hpp"

namespace isostep::scenes {

inline constexpr double kGravity = 10;  // [m/s^2] downwards, of a scene that names no other

inline double value(const Number& number) { return value_of<double>(number, ""); }
inline Vec3<double> value(const Vector& v) { return {value(v[0]), value(v[1]), value(v[2])}; }
/// The rotation, at unit length.
inline Quat<double> value(const Rotation& q) {
  return normalise(Quat<double>{value(q[0]), value(q[1]), value(q[2]), value(q[3])});
}

/// [s] The duration of the scene's whole run.
inline double duration_of(const Scene& scene) { return static_cast<double>(scene.frames) / scene.hz; }

/// [kg] The mass of the body, from its mass or its parts' density.
double mass_of(const SceneBody& body);
/// [kg m^2] The inertia about the centre of mass, in the body's frame, of boxes, spheres and capsules that are not
/// turned. Closed form.
Mat3<double> inertia_of(const SceneBody& body);
/// [m] The distance from the centre of a body of one part to the nearest point of its surface.
double least_reach(const SceneBody& body);

}  // namespace isostep::scenes
