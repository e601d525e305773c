// Bodies of draws.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/draws.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/scalar/math.inl"

namespace isostep {
namespace detail {

/// Sine and cosine of a random part of a whole turn.
template <class S, class R> ISO_INLINE SinCos<Unit<S>> random_turn(R& random) {
  return sin_cos_to<Unit<S>>(S(6.28318530717958647693) * unit_interval<S>(random.next_u24()));
}
/// A number in [0, 1).
template <class S, class R> ISO_INLINE Unit<S> random_part(R& random) {
  return convert<Unit<S>>(unit_interval<S>(random.next_u24()));
}

}  // namespace detail

template <class S, class R> S random_normal(R& random) {
  return pin_floats([&]() -> S {
    std::uint32_t u24 = random.next_u24();
    while (u24 == 0) u24 = random.next_u24();
    const S minus_log = -log_to<S>(unit_interval<S>(u24));
    const S radius = sqrt(minus_log + minus_log);
    return radius * detail::random_turn<S>(random).cos;
  });
}
template <class S, class R> Vec3<Unit<S>> random_direction(R& random) {
  return pin_floats([&]() -> Vec3<Unit<S>> {
    using U = Unit<S>;
    const U part = detail::random_part<S>(random), height = part + part - U(1);
    const SinCos<U> turn = detail::random_turn<S>(random);
    const U reach = sqrt(U(1) - height * height);
    return normalise(Vec3<U>{reach * turn.cos, height, reach * turn.sin});
  });
}
template <class S, class R> Vec3<S> random_in_ball(R& random, S radius) {
  return pin_floats([&]() -> Vec3<S> {
    const Vec3<Unit<S>> direction = random_direction<S>(random);
    Unit<S> part = detail::random_part<S>(random);
    for (int i = 0; i < 2; ++i) part = max(part, detail::random_part<S>(random));
    return direction * part * radius;
  });
}
template <class S, class R> Vec3<S> random_in_disc(R& random, S radius) {
  return pin_floats([&]() -> Vec3<S> {
    const SinCos<Unit<S>> turn = detail::random_turn<S>(random);
    const Unit<S> first = detail::random_part<S>(random), second = detail::random_part<S>(random);
    const S way = radius * max(first, second);
    return {way * turn.cos, S(0), way * turn.sin};
  });
}
template <class S, class R> Vec3<S> random_in_box(R& random, Vec3<S> low, Vec3<S> high) {
  return pin_floats([&]() -> Vec3<S> {
    const S x = uniform(random, low.x, high.x), y = uniform(random, low.y, high.y);
    return {x, y, uniform(random, low.z, high.z)};
  });
}
template <class S, class R> Quat<Unit<S>> random_rotation(R& random) {
  return pin_floats([&]() -> Quat<Unit<S>> {
    using U = Unit<S>;
    const U part = detail::random_part<S>(random), low = sqrt(U(1) - part), high = sqrt(part);
    const SinCos<U> first = detail::random_turn<S>(random), second = detail::random_turn<S>(random);
    return normalise(Quat<U>{low * first.sin, low * first.cos, high * second.sin, high * second.cos});
  });
}

}  // namespace isostep
