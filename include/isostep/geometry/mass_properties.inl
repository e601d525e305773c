// Bodies of mass_properties.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>
#include <vector>

#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/geometry/mass_properties.hpp"
#include "isostep/scalar/environment.hpp"

namespace isostep {
namespace detail {

// ---- several children, everything relative to a scale so that it fits Unit<S>

/// The children, each with the values of its shape.
template <class S> class Parts {
 public:
  ISO_INLINE Parts(std::span<const Child<S>> children, Contents<S> contents)
      : children_(children), contents_(contents) {}

  ISO_INLINE std::size_t size() const { return children_.size(); }
  ISO_INLINE const Child<S>& operator[](std::size_t i) const { return children_[i]; }
  template <class Ask> ISO_INLINE auto ask(std::size_t i, const Ask& of_shape) const {
    return visit_shape(contents_.view(children_[i].primitive), of_shape);
  }
  ISO_INLINE Aabb<S> box(std::size_t i, const Transform<S>& at) const {
    return bounds(contents_.view(children_[i].primitive), at);
  }
  /// [m] Returns the centre in the body's frame.
  ISO_INLINE Vec3<S> centre(std::size_t i) const {
    const Pose<S>& pose = children_[i].pose;
    return ask(i, [&](const auto& shape) ISO_INLINE_LAMBDA {
      if constexpr (std::remove_cvref_t<decltype(shape)>::kPrincipal) return pose.position;
      else return pose.position + rotate(pose.orientation, shape.centre_of_mass());
    });
  }
  /// Returns the inertia over mass and scale^2, about its centre, along the body's axes.
  ISO_INLINE Mat3<Unit<S>> inertia(std::size_t i, S scale) const {
    const Mat3<Unit<S>> turn = to_matrix(children_[i].pose.orientation);
    return ask(i, [&](const auto& shape) ISO_INLINE_LAMBDA {
      const auto own = shape.relative_inertia(scale);
      if constexpr (std::remove_cvref_t<decltype(shape)>::kPrincipal) return rotate_diagonal(turn, own);
      else return turn * (own * transpose(turn));
    });
  }

 private:
  std::span<const Child<S>> children_;
  Contents<S> contents_;
};

/// Volume fractions of a list; they add up to one within half a step of S.
template <class S> class Weights {
  using U = Unit<S>;
  static constexpr int kMostDoublings = 62;  // of the smallest volume that Unit<S> holds

 public:
  ISO_INLINE explicit Weights(const Parts<S>& parts) : parts_(parts), scale_(0), doublings_(0) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Aabb<S> box = parts.box(i, Transform<S>::of(Pose<S>::identity()));
      scale_ = max(scale_, max(max_abs(box.low), max_abs(box.high)));
    }
    U most = U(0);
    for (std::size_t i = 0; i < parts.size(); ++i) most = max(most, relative_volume(i));
    for (; doublings_ < kMostDoublings && most < U(0.5); ++doublings_) most = most + most;
    SumOf<S, U> total = product(S(0), U(0));  // exact
    for (std::size_t i = 0; i < parts.size(); ++i) total += product(S(1), scaled_volume(i));
    total_ = round_to<S>(total);
  }
  ISO_INLINE U operator[](std::size_t i) const {
    return parts_.size() == 1 ? U(1) : divide_to<U>(scaled_volume(i), total_);
  }

 private:
  ISO_INLINE U relative_volume(std::size_t i) const {
    return parts_.ask(i, [&](const auto& shape) ISO_INLINE_LAMBDA { return shape.relative_volume(scale_); });
  }
  ISO_INLINE U scaled_volume(std::size_t i) const {
    U volume = relative_volume(i);
    for (int n = 0; n < doublings_; ++n) volume = volume + volume;
    return volume;
  }

  const Parts<S>& parts_;
  S scale_;
  int doublings_;  // powers of two that bring the largest volume to one half or more: thin rods keep their digits
  S total_;
};

template <class S> ISO_INLINE Vec3<S> centre_of(const Parts<S>& parts, const Weights<S>& weights) {
  const Vec3<S> origin = parts.centre(0);
  const SumOf<S, Unit<S>> zero = product(S(0), Unit<S>(0));
  SumOf<S, Unit<S>> x = zero, y = zero, z = zero;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Vec3<S> arm = parts.centre(i) - origin;
    const Unit<S> w = weights[i];
    x += product(arm.x, w);
    y += product(arm.y, w);
    z += product(arm.z, w);
  }
  return origin + Vec3<S>{round_to<S>(x), round_to<S>(y), round_to<S>(z)};
}

/// The specific inertia tensor about `centre` over scale^2, where scale is at least twice every coordinate from there:
/// all entries below 1/2.
template <class S>
ISO_INLINE Mat3<Unit<S>> tensor_of(const Parts<S>& parts, const Weights<S>& weights, Vec3<S> centre, S scale) {
  using U = Unit<S>;
  const Sum<U> zero = product(U(0), U(0));
  Sum<U> xx = zero, yy = zero, zz = zero, xy = zero, xz = zero, yz = zero;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Mat3<U> own = parts.inertia(i, scale);
    const Vec3<S> arm = parts.centre(i) - centre;
    const U x = divide_to<U>(arm.x, scale), y = divide_to<U>(arm.y, scale), z = divide_to<U>(arm.z, scale);
    const U w = weights[i];
    xx += product(w, own.rows[0].x + (y * y + z * z));
    yy += product(w, own.rows[1].y + (z * z + x * x));
    zz += product(w, own.rows[2].z + (x * x + y * y));
    xy += product(w, own.rows[0].y - x * y);
    xz += product(w, own.rows[0].z - x * z);
    yz += product(w, own.rows[1].z - y * z);
  }
  const U m01 = round_to<U>(xy), m02 = round_to<U>(xz), m12 = round_to<U>(yz);
  return {{{round_to<U>(xx), m01, m02}, {m01, round_to<U>(yy), m12}, {m02, m12, round_to<U>(zz)}}};
}

template <class U> ISO_INLINE Mat3<U> seen_from(const Mat3<U>& tensor, Quat<U> axes) {
  const Mat3<U> r = to_matrix(axes);
  return transpose(r) * (tensor * r);
}

/// Returns the rotation to the eigenvectors of a symmetric tensor, by cyclic Jacobi with rotations up to 45 degrees.
/// Source:  Golub, Van Loan, Matrix Computations, 4th ed., sec. 8.5.   Differs: the tensor is rotated afresh from the
///          accumulated quaternion, so rounding does not pile up, and the angle is halved twice by square roots.
/// Symbols: e = off-diagonal entry (i, j), d = difference of the diagonal ones; tan(2 angle) = 2 e / d.
/// Limits:  entries below 1/2. Six sweeps: convergence is quadratic; four meet the tests' 1e-13, three do not.
template <class U> ISO_INLINE Quat<U> principal_axes(const Mat3<U>& tensor) {
  constexpr int kSweeps = 6;
  const U negligible = resolution<U>() + resolution<U>();  // what rotating the tensor itself rounds off
  Quat<U> axes = Quat<U>::identity();
  for (int step = 0; step < 3 * kSweeps; ++step) {
    const int i = step % 3;
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const Mat3<U> m = seen_from(tensor, axes);
    const U e = m.rows[i][j];
    if (abs(e) <= negligible) continue;
    const U d = m.rows[j][j] - m.rows[i][i];
    const U twice_e = d < U(0) ? -(e + e) : e + e;
    const Direction<U> doubled = direction_of(abs(d), twice_e, U(0));  // cosine and sine of twice the angle
    const U half = U(0.5);
    const U cosine = sqrt(half + half * doubled.x);
    const U sine = divide_to<U>(half * doubled.y, cosine);
    const U half_cosine = sqrt(half + half * cosine);
    Vec3<U> axis = Vec3<U>::zero();
    axis[k] = -divide_to<U>(half * sine, half_cosine);
    axes = normalise(axes * Quat<U>{axis.x, axis.y, axis.z, half_cosine});
  }
  if (axes.w < U(0)) axes = {-axes.x, -axes.y, -axes.z, -axes.w};
  return axes;
}

/// 1 / (value scale^2), as the square of 1 / (radius of gyration): a thin rod's value may have no inverse in S.
template <class S> ISO_INLINE S kappa_from(Unit<S> value, S scale) {
  const S inverse_radius = divide_to<S>(Unit<S>(1), sqrt(value)) / scale;
  return inverse_radius * inverse_radius;
}

template <class S> ISO_INLINE MassProperties<S> combined(const Parts<S>& parts, S mass) {
  const Weights<S> weights(parts);
  const Vec3<S> centre = centre_of(parts, weights);
  S reach = S(0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Aabb<S> box = parts.box(i, Transform<S>::of(parts[i].pose));
    reach = max(reach, max(max_abs(box.low - centre), max_abs(box.high - centre)));
  }
  const S scale = reach + reach;
  const Mat3<Unit<S>> tensor = tensor_of(parts, weights, centre, scale);
  const Quat<Unit<S>> axes = principal_axes(tensor);
  const Mat3<Unit<S>> principal = seen_from(tensor, axes);
  return {mass,
          centre,
          {kappa_from(principal.rows[0].x, scale), kappa_from(principal.rows[1].y, scale),
           kappa_from(principal.rows[2].z, scale)},
          axes};
}

/// Returns all children, or only those that are no sensors, which it then stores in `solid`.
template <class S>
std::span<const Child<S>> what_weighs(std::span<const Child<S>> children, std::vector<Child<S>>& solid) {
  bool senses = false;
  for (const Child<S>& child : children) senses = senses || child.traits.has(part_flag::kSensor);
  if (!senses) return children;
  for (const Child<S>& child : children) {
    if (!child.traits.has(part_flag::kSensor)) solid.push_back(child);
  }
  return solid;
}

}  // namespace detail

template <class S> MassProperties<S> mass_properties(std::span<const Child<S>> all, S density, Contents<S> contents) {
  return pin_floats([&]() -> MassProperties<S> {
    std::vector<Child<S>> solid;
    const std::span<const Child<S>> children = detail::what_weighs(all, solid);
    const detail::Parts<S> parts(children, contents);
    S mass = S(0);
    const auto any_endless = [](std::span<const Child<S>> list) {
      bool any = false;
      for (const Child<S>& child : list) any = any || !is_bounded(child.primitive.type);
      return any;
    };
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const S part = parts.ask(i, [&](const auto& shape) { return shape.mass(density); });
      mass = min(mass + part, Limits<S>::mass());
    }
    if (children.empty() || any_endless(children))
      return {S(0), Vec3<S>::zero(), Vec3<S>::zero(), Quat<Unit<S>>::identity()};
    if (any_endless(all)) {  // a sensor: nothing that turns has it, and the others keep their centre
      const MassProperties<S> others = mass_properties<S>(children, density, contents);
      return {S(0), others.centre, Vec3<S>::zero(), others.principal};
    }
    mass = max(mass, resolution<S>());
    const bool principal = visit_shape_type(children[0].primitive.type,
                                            [](auto tag) { return decltype(tag)::template Of<S>::kPrincipal; });
    if (children.size() > 1 || !principal) return detail::combined(parts, mass);
    const Pose<S>& pose = children[0].pose;
    const Vec3<S> kappa = parts.ask(0, [](const auto& shape) {
      if constexpr (std::remove_cvref_t<decltype(shape)>::kPrincipal) return shape.kappa();
      else return Vec3<S>::zero();
    });
    return {mass, pose.position, kappa, pose.orientation};
  });
}

}  // namespace isostep
