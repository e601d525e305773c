// Bodies of vectors.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/vectors.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {

template <class S> Vec3<S> clamp_length(Vec3<S> v, S most) {
  return pin_floats([&]() -> Vec3<S> {
    const Heading<S> heading = heading_of(v);
    return heading.length > most ? heading.direction * most : v;
  });
}
template <class S> Vec3<S> move_towards(Vec3<S> from, Vec3<S> to, S most) {
  return pin_floats([&]() -> Vec3<S> {
    const Heading<S> way = heading_of(to - from);
    return way.length <= most ? to : from + way.direction * most;
  });
}
template <class S> Vec3<S> project_on_line(Vec3<S> v, Vec3<Unit<S>> n) {
  return pin_floats([&]() -> Vec3<S> { return n * dot(v, n); });
}
template <class S> Vec3<S> project_on_plane(Vec3<S> v, Vec3<Unit<S>> n) {
  return pin_floats([&]() -> Vec3<S> { return v - project_on_line(v, n); });
}
template <class S> Vec3<S> reflect(Vec3<S> v, Vec3<Unit<S>> n) {
  return pin_floats([&]() -> Vec3<S> {
    const Vec3<S> part = project_on_line(v, n);
    return v - part - part;
  });
}
template <class S> S angle_between(Vec3<S> a, Vec3<S> b) {
  return pin_floats([&]() -> S {
    using U = Unit<S>;
    const Vec3<U> u = normalise(a), v = normalise(b);
    return atan2_to<S>(length(cross(u, v)), dot(u, v));
  });
}
template <class S> S signed_angle(Vec3<S> a, Vec3<S> b, Vec3<S> axis) {
  return pin_floats([&]() -> S {
    const S angle = angle_between(a, b);
    return dot(cross(normalise(a), normalise(b)), normalise(axis)) < Unit<S>(0) ? -angle : angle;
  });
}

}  // namespace isostep
