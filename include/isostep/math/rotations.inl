// Bodies of rotations.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/rotations.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace detail {

template <class U> ISO_INLINE Quat<U> negated(Quat<U> q) { return {-q.x, -q.y, -q.z, -q.w}; }
template <class U> ISO_INLINE Vec3<U> vector_of(Quat<U> q) { return {q.x, q.y, q.z}; }
/// Returns the quaternion of the same rotation with w >= 0.
template <class U> ISO_INLINE Quat<U> shorter(Quat<U> q) { return q.w < U(0) ? negated(q) : q; }
template <class U> ISO_INLINE U dot4(Quat<U> a, Quat<U> b) {
  return round_to<U>(product(a.x, b.x) + product(a.y, b.y) + product(a.z, b.z) + product(a.w, b.w));
}
/// The sine of an angle below which a cross product is no direction: sixteen steps of its format.
template <class U> ISO_INLINE U parallel_sine() {
  U sine = resolution<U>();
  for (int i = 0; i < 4; ++i) sine = sine + sine;
  return sine;
}
/// Returns the unit vector along the part of `across` that is perpendicular to the unit vector z.
template <class U> ISO_INLINE Vec3<U> perpendicular(Vec3<U> across, Vec3<U> z) {
  return normalise(across - z * dot(across, z));
}

}  // namespace detail

template <class S> AxisAngle<S> axis_angle_of(Quat<Unit<S>> q) {
  return pin_floats([&]() -> AxisAngle<S> {
    using U = Unit<S>;
    const Quat<U> turn = detail::shorter(q);
    const Heading<U> axis = heading_of(detail::vector_of(turn));
    if (axis.length == U(0)) return {{U(0), U(1), U(0)}, S(0)};
    const S half = atan2_to<S>(axis.length, turn.w);
    return {axis.direction, half + half};
  });
}

template <class S> Vec3<S> rotation_vector_of(Quat<Unit<S>> q) {
  return pin_floats([&]() -> Vec3<S> {
    const AxisAngle<S> turn = axis_angle_of<S>(q);
    return turn.axis * turn.angle;
  });
}
template <class S> Quat<Unit<S>> rotation_by(Vec3<S> v) {
  return pin_floats([&]() -> Quat<Unit<S>> {
    const Heading<S> turn = heading_of(v);
    return rotation(turn.direction, turn.length);
  });
}

template <class U> Quat<U> to_quaternion(const Mat3<U>& m) {
  return pin_floats([&]() -> Quat<U> {
    const auto sum = [](U a, U b) ISO_INLINE_LAMBDA { return round_to<U>(product(a, U(0.25)) + product(b, U(0.25))); };
    const auto difference = [](U a, U b)
                                ISO_INLINE_LAMBDA { return round_to<U>(product(a, U(0.25)) - product(b, U(0.25))); };
    const U xx = m.rows[0].x, yy = m.rows[1].y, zz = m.rows[2].z;
    const auto square = [&](U a, U b, U c) ISO_INLINE_LAMBDA {  // of a component: (1 + a + b + c) / 4
      const auto quarter = U(0.25);
      return round_to<U>(product(a, quarter) + product(b, quarter) + product(c, quarter) + product(U(1), quarter));
    };
    const U x2 = square(xx, -yy, -zz), y2 = square(-xx, yy, -zz), z2 = square(-xx, -yy, zz), w2 = square(xx, yy, zz);
    const U xy = sum(m.rows[0].y, m.rows[1].x), xz = sum(m.rows[0].z, m.rows[2].x), yz = sum(m.rows[1].z, m.rows[2].y);
    const U wx = difference(m.rows[2].y, m.rows[1].z), wy = difference(m.rows[0].z, m.rows[2].x),
            wz = difference(m.rows[1].x, m.rows[0].y);
    const U largest = max(max(x2, y2), max(z2, w2));
    if (w2 == largest) return normalise(Quat<U>{wx, wy, wz, w2});
    if (x2 == largest) return normalise(Quat<U>{x2, xy, xz, wx});
    if (y2 == largest) return normalise(Quat<U>{xy, y2, yz, wy});
    return normalise(Quat<U>{xz, yz, z2, wz});
  });
}

template <class U> Quat<U> rotation_between(Vec3<U> from, Vec3<U> to) {
  return pin_floats([&]() -> Quat<U> {
    const Heading<U> across = heading_of(cross(from, to));
    const U cosine = dot(from, to), half = U(0.5);
    Vec3<U> axis = tangents_of(from).t;
    if (across.length > detail::parallel_sine<U>()) {
      axis = detail::perpendicular(across.direction, from);
    } else if (cosine > U(0)) {
      return Quat<U>::identity();
    }
    // Half the angle: its tangent is sine / (1 + cosine) = (1 - cosine) / sine, of which one keeps its digits.
    const bool acute = cosine >= U(0);
    const U sine_of_half = acute ? across.length * half : half - cosine * half;
    const U cosine_of_half = acute ? half + cosine * half : across.length * half;
    const Vec3<U> v = axis * sine_of_half;
    return normalise(Quat<U>{v.x, v.y, v.z, cosine_of_half});
  });
}
template <class S> Quat<Unit<S>> look_rotation(Vec3<S> forward, Vec3<S> up) {
  return pin_floats([&]() -> Quat<Unit<S>> {
    using U = Unit<S>;
    const Vec3<U> z = normalise(forward);
    const Heading<U> across = heading_of(cross(normalise(up), z));
    const bool parallel = !(across.length > detail::parallel_sine<U>());
    const Vec3<U> x = parallel ? tangents_of(z).t : detail::perpendicular(across.direction, z);
    return to_quaternion(transpose(Mat3<U>{{x, cross(z, x), z}}));
  });
}

template <class S> S angle_between(Quat<Unit<S>> a, Quat<Unit<S>> b) {
  return pin_floats([&]() -> S { return axis_angle_of<S>(conjugate(a) * b).angle; });
}
template <class U> Quat<U> slerp(Quat<U> a, Quat<U> b, U t) {
  return pin_floats([&]() -> Quat<U> {
    const Quat<U> way = detail::shorter(conjugate(a) * b);
    const Heading<U> axis = heading_of(detail::vector_of(way));
    const SinCos<U> part = sin_cos_to<U>(t * atan2_to<U>(axis.length, way.w));
    const Vec3<U> v = axis.direction * part.sin;
    return normalise(a * Quat<U>{v.x, v.y, v.z, part.cos});
  });
}
template <class U> Quat<U> nlerp(Quat<U> a, Quat<U> b, U t) {
  return pin_floats([&]() -> Quat<U> {
    const Quat<U> end = detail::dot4(a, b) < U(0) ? detail::negated(b) : b;
    const U rest = U(1) - t;
    const auto mixed = [&](U from, U to)
                           ISO_INLINE_LAMBDA { return round_to<U>(product(from, rest) + product(to, t)); };
    return normalise(Quat<U>{mixed(a.x, end.x), mixed(a.y, end.y), mixed(a.z, end.z), mixed(a.w, end.w)});
  });
}

template <class U> SwingTwist<U> swing_twist_of(Quat<U> q, Vec3<U> axis) {
  return pin_floats([&]() -> SwingTwist<U> {
    const Vec3<U> v = axis * dot(detail::vector_of(q), axis);
    const Quat<U> twist = normalise(Quat<U>{v.x, v.y, v.z, q.w});
    return {normalise(q * conjugate(twist)), twist};
  });
}

}  // namespace isostep
