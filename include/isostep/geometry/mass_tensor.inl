// Bodies of mass_tensor.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/mass_properties.inl"
#include "isostep/geometry/mass_tensor.hpp"

namespace isostep {

namespace detail {
template <class S> Vec3<Finer<S>> finer_vector(Vec3<S> v) {
  using F = Finer<S>;
  return {finer<F>(v.x), finer<F>(v.y), finer<F>(v.z)};
}
template <class S> Mat3<Finer<S>> finer_matrix(const Mat3<S>& m) {
  return {{finer_vector(m.rows[0]), finer_vector(m.rows[1]), finer_vector(m.rows[2])}};
}
/// The upper half of `m` on both sides, so that the result is symmetric bit for bit.
template <class S> Mat3<S> coarser_symmetric(const Mat3<Finer<S>>& m) {
  const auto at = [&](int i, int j) { return coarser<S>(m.rows[i][j]); };
  const S xy = at(0, 1), xz = at(0, 2), yz = at(1, 2);
  return {{{at(0, 0), xy, xz}, {xy, at(1, 1), yz}, {xz, yz, at(2, 2)}}};
}
/// The moment d^2 1 - d d^T of a unit mass at d.
template <class F> Mat3<F> moment_of_arm(Vec3<F> d) {
  const F xx = d.x * d.x, yy = d.y * d.y, zz = d.z * d.z;
  const F xy = -(d.x * d.y), xz = -(d.x * d.z), yz = -(d.y * d.z);
  return {{{yy + zz, xy, xz}, {xy, zz + xx, yz}, {xz, yz, xx + yy}}};
}
template <class F> Mat3<F> times(const Mat3<F>& m, F s) { return {{m.rows[0] * s, m.rows[1] * s, m.rows[2] * s}}; }
}  // namespace detail

/// The vertices add up to nothing about the centroid; moments are a fifth of those of a quarter of the mass at each.
template <class S> MassTensor<S> MassTensor<S>::tetrahedron(S mass, Vec3<S> a, Vec3<S> b, Vec3<S> c, Vec3<S> d) {
  return pin_floats([&]() -> MassTensor<S> {
    using F = Finer<S>;
    const Vec3<F> corners[4] = {detail::finer_vector(a), detail::finer_vector(b), detail::finer_vector(c),
                                detail::finer_vector(d)};
    const Vec3<F> middle = (corners[0] + corners[1] + corners[2] + corners[3]) * F(0.25);
    Mat3<F> sum = Mat3<F>::diagonal(Vec3<F>::zero());
    for (const Vec3<F>& corner : corners) sum = sum + detail::moment_of_arm(corner - middle);
    const F share = finer<F>(mass) * F(0.05);
    return {mass,
            {coarser<S>(middle.x), coarser<S>(middle.y), coarser<S>(middle.z)},
            detail::coarser_symmetric<S>(detail::times(sum, share))};
  });
}

template <class S> MassTensor<S> MassTensor<S>::placed(const Pose<S>& pose) const {
  return pin_floats([&]() -> MassTensor<S> {
    using F = Finer<S>;
    const Mat3<Unit<S>> r = to_matrix(pose.orientation);
    const auto fine = [](Vec3<Unit<S>> v) {
      return Vec3<Unit<F>>{finer<Unit<F>>(v.x), finer<Unit<F>>(v.y), finer<Unit<F>>(v.z)};
    };
    const Mat3<Unit<F>> turn = {{fine(r.rows[0]), fine(r.rows[1]), fine(r.rows[2])}};
    return {mass, pose.position + r * centre,
            detail::coarser_symmetric<S>(turn * (detail::finer_matrix(tensor) * transpose(turn)))};
  });
}

template <class S> Mat3<S> MassTensor<S>::about(Vec3<S> point) const {
  return pin_floats([&]() -> Mat3<S> {
    using F = Finer<S>;
    const Mat3<F> arm = detail::moment_of_arm(detail::finer_vector(centre) - detail::finer_vector(point));
    return detail::coarser_symmetric<S>(detail::finer_matrix(tensor) + detail::times(arm, finer<F>(mass)));
  });
}

/// Joins by both tensors and the moment of the reduced mass at d between the centres: nothing is subtracted.
template <class S> MassTensor<S> MassTensor<S>::joined(const MassTensor& other) const {
  return pin_floats([&]() -> MassTensor<S> {
    using F = Finer<S>;
    const F a = finer<F>(mass), b = finer<F>(other.mass);
    const Unit<F> share = divide_to<Unit<F>>(b, a + b);
    const Vec3<F> from = detail::finer_vector(centre), arm = detail::finer_vector(other.centre) - from;
    const Vec3<F> middle = from + arm * share;
    const Mat3<F> sum = detail::finer_matrix(tensor) + detail::finer_matrix(other.tensor);
    return {mass + other.mass,
            {coarser<S>(middle.x), coarser<S>(middle.y), coarser<S>(middle.z)},
            detail::coarser_symmetric<S>(sum + detail::times(detail::moment_of_arm(arm), a * share))};
  });
}

template <class S> MassProperties<S> MassTensor<S>::properties() const {
  return pin_floats([&]() -> MassProperties<S> {
    using F = Finer<S>;
    const MassProperties<S> immovable = {mass, centre, Vec3<S>::zero(), Quat<Unit<S>>::identity()};
    Mat3<F> specific = detail::finer_matrix(tensor);
    F largest = F(0);
    for (Vec3<F>& row : specific.rows) {
      row = row / finer<F>(mass);
      largest = max(largest, max_abs(row));
    }
    if (!(F(0) < largest)) return immovable;
    // Entries are less than a half, as principal_axes() wants them.
    const F scale = sqrt(largest + largest + largest);
    Mat3<Unit<F>> relative;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) relative.rows[i][j] = divide_to<Unit<F>>(specific.rows[i][j] / scale, scale);
    }
    const Quat<Unit<F>> axes = detail::principal_axes(relative);
    const Mat3<Unit<F>> principal = detail::seen_from(relative, axes);
    // The rotation leaves a rounding where there is no moment.
    const Unit<F> least = Unit<F>(0x1p-20);
    const auto kappa = [&](int i) {
      const Unit<F> value = principal.rows[i][i];
      return least < value ? coarser<S>(detail::kappa_from<F>(value, scale)) : S(0);
    };
    const auto unit = [](Unit<F> x) { return coarser<Unit<S>>(x); };
    return {mass,
            centre,
            {kappa(0), kappa(1), kappa(2)},
            normalise(Quat<Unit<S>>{unit(axes.x), unit(axes.y), unit(axes.z), unit(axes.w)})};
  });
}

}  // namespace isostep
