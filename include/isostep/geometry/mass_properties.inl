// Bodies of mass_properties.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/geometry/mass_properties.hpp"

namespace isostep {
namespace detail {

// ---- mass

/// f[0] ... f[4], all positive, saturated at Limits<S>::mass(). Starts with the largest factor, then takes the smallest
/// while the product is large and the largest while it is small: no intermediate overflows before the result does, and
/// none is so small that its rounding shows.
template <class S> ISO_INLINE S saturating_product(const S (&factors)[5]) {
  S f[5];
  for (int i = 0; i < 5; ++i) {
    int at = i;
    for (; at > 0 && factors[i] < f[at - 1]; --at) f[at] = f[at - 1];
    f[at] = factors[i];
  }
  const S most = Limits<S>::mass();
  S result = min(f[4], most);
  int low = 0;
  int high = 3;
  while (low <= high) {
    const S next = result > S(16) ? f[low++] : f[high--];
    const Sum<S> exact = product(result, next);
    result = exact > widen<Sum<S>>(most) ? most : round_to<S>(exact);
  }
  return result;
}

template <class S> ISO_INLINE S mass_of(const Primitive<S>& p, S density) {
  const S r = p.radius;
  switch (p.type) {
    case ShapeType::sphere: return saturating_product<S>({density, S(4.188790204786391), r, r, r});
    case ShapeType::box: return saturating_product<S>({density, S(8), p.half.x, p.half.y, p.half.z});
    case ShapeType::capsule: {
      const S length = p.half.y + p.half.y + S(4.0 / 3) * r;
      return saturating_product<S>({density, S(3.141592653589793), r, r, length});
    }
    case ShapeType::half_space: break;
  }
  return S(0);
}

// ---- one primitive, closed forms

/// n / (d x^2), division by division: every quotient lies between n / d, which is near one, and the result.
template <class S> ISO_INLINE S quotient(Unit<S> n, Unit<S> d, S x) { return divide_to<S>(n, d) / x / x; }

/// A capsule as fractions of its height h + r: a = h / (h + r), b = r / (h + r); the cylinder holds 1.5 a / d of the
/// volume and the two hemispheres b / d.
template <class U> struct CapsuleParts { U a, b, d; };
template <class S> ISO_INLINE CapsuleParts<Unit<S>> parts_of_capsule(const Primitive<S>& p) {
  using U = Unit<S>;
  const U b = divide_to<U>(p.radius, p.half.y + p.radius);
  const U a = U(1) - b;
  return {a, b, U(1) + U(0.5) * a};
}
/// Specific inertia across the axis, with height h and radius r in any one unit: cylinder r^2/4 + h^2/3, hemispheres
/// 2/5 r^2 + h^2 + 3/4 h r, weighted by volume, times d.
template <class U> ISO_INLINE U capsule_across(CapsuleParts<U> parts, U h, U r) {
  const U cylinder = U(0.25) * (r * r) + U(1.0 / 3) * (h * h);
  const U ends = U(0.4) * (r * r) + h * h + U(0.75) * (h * r);
  return U(1.5) * (parts.a * cylinder) + parts.b * ends;
}
/// Specific inertia about the axis, over r^2, times d: cylinder r^2/2, sphere 2/5 r^2.
template <class U> ISO_INLINE U capsule_along(CapsuleParts<U> parts) { return U(0.75) * parts.a + U(0.4) * parts.b; }

/// 3 / (x^2 + y^2), with both sides in units of the longer.
template <class S> ISO_INLINE S kappa_of_rectangle(S x, S y) {
  using U = Unit<S>;
  const S longer = max(x, y);
  const U ratio = divide_to<U>(min(x, y), longer);
  return quotient<S>(U(1.5), U(0.5) + U(0.5) * (ratio * ratio), longer);
}
template <class S> ISO_INLINE Vec3<S> kappa_of(const Primitive<S>& p) {
  using U = Unit<S>;
  const S r = p.radius;
  switch (p.type) {
    case ShapeType::sphere: {
      const S kappa = S(2.5) / r / r;
      return {kappa, kappa, kappa};
    }
    case ShapeType::box:
      return {kappa_of_rectangle(p.half.y, p.half.z), kappa_of_rectangle(p.half.z, p.half.x),
              kappa_of_rectangle(p.half.x, p.half.y)};
    case ShapeType::capsule: {
      const CapsuleParts<U> parts = parts_of_capsule(p);
      const S height = p.half.y + r;
      const S across = quotient<S>(parts.d, capsule_across(parts, parts.a, parts.b), height);
      return {across, quotient<S>(parts.d, capsule_along(parts), r), across};
    }
    case ShapeType::half_space: break;
  }
  return Vec3<S>::zero();
}

// ---- several children, everything relative to a scale so that it fits Unit<S>

/// Volume over (2 scale)^3; scale is at least the primitive's largest half size.
template <class S> ISO_INLINE Unit<S> relative_volume(const Primitive<S>& p, S scale) {
  using U = Unit<S>;
  const U r = divide_to<U>(p.radius, scale);
  const U x = divide_to<U>(p.half.x, scale), y = divide_to<U>(p.half.y, scale), z = divide_to<U>(p.half.z, scale);
  constexpr double kPi = 3.141592653589793;
  if (p.type == ShapeType::box) return x * y * z;
  return (U(kPi / 4) * y + U(kPi / 6) * r) * r * r;  // y = 0 for a sphere
}

/// Principal specific inertia over scale^2.
template <class S> ISO_INLINE Vec3<Unit<S>> relative_inertia(const Primitive<S>& p, S scale) {
  using U = Unit<S>;
  const U r = divide_to<U>(p.radius, scale);
  const U x = divide_to<U>(p.half.x, scale), y = divide_to<U>(p.half.y, scale), z = divide_to<U>(p.half.z, scale);
  if (p.type == ShapeType::box) {
    const U third = U(1.0 / 3);
    return {third * (y * y + z * z), third * (z * z + x * x), third * (x * x + y * y)};
  }
  if (p.type == ShapeType::sphere) return {U(0.4) * (r * r), U(0.4) * (r * r), U(0.4) * (r * r)};
  const CapsuleParts<U> parts = parts_of_capsule(p);
  const U across = divide_to<U>(capsule_across(parts, y, r), parts.d);
  return {across, divide_to<U>(capsule_along(parts) * (r * r), parts.d), across};
}

/// Volume fractions of a list; they add up to one within half a step of S.
template <class S> class Weights {
  using U = Unit<S>;
  static constexpr int kMostDoublings = 62;  // of the smallest volume that Unit<S> holds

 public:
  ISO_INLINE explicit Weights(std::span<const Child<S>> children) : children_(children), scale_(0), doublings_(0) {
    for (const Child<S>& child : children) scale_ = max(scale_, max_abs(child.primitive.half) + child.primitive.radius);
    U most = U(0);
    for (const Child<S>& child : children) most = max(most, relative_volume(child.primitive, scale_));
    for (; doublings_ < kMostDoublings && most < U(0.5); ++doublings_) most = most + most;
    SumOf<S, U> total = product(S(0), U(0));  // exact
    for (std::size_t i = 0; i < children.size(); ++i) total += product(S(1), scaled_volume(i));
    total_ = round_to<S>(total);
  }
  ISO_INLINE U operator[](std::size_t i) const { return divide_to<U>(scaled_volume(i), total_); }

 private:
  ISO_INLINE U scaled_volume(std::size_t i) const {
    U volume = relative_volume(children_[i].primitive, scale_);
    for (int n = 0; n < doublings_; ++n) volume = volume + volume;
    return volume;
  }

  std::span<const Child<S>> children_;
  S scale_;
  int doublings_;  // powers of two that bring the largest volume to one half or more: thin rods keep their digits
  S total_;
};

template <class S> ISO_INLINE Vec3<S> centre_of(std::span<const Child<S>> children, const Weights<S>& weights) {
  const Vec3<S> origin = children[0].pose.position;
  const SumOf<S, Unit<S>> zero = product(S(0), Unit<S>(0));
  SumOf<S, Unit<S>> x = zero, y = zero, z = zero;
  for (std::size_t i = 0; i < children.size(); ++i) {
    const Vec3<S> arm = children[i].pose.position - origin;
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
ISO_INLINE Mat3<Unit<S>> tensor_of(std::span<const Child<S>> children, const Weights<S>& weights, Vec3<S> centre,
                                   S scale) {
  using U = Unit<S>;
  const Sum<U> zero = product(U(0), U(0));
  Sum<U> xx = zero, yy = zero, zz = zero, xy = zero, xz = zero, yz = zero;
  for (std::size_t i = 0; i < children.size(); ++i) {
    const Mat3<U> own =
        rotate_diagonal(to_matrix(children[i].pose.orientation), relative_inertia(children[i].primitive, scale));
    const Vec3<S> arm = children[i].pose.position - centre;
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

/// The rotation to the eigenvectors of a symmetric tensor by cyclic Jacobi, each rotation at most 45 degrees.
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
    axis.set(k, -divide_to<U>(half * sine, half_cosine));
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

template <class S> ISO_INLINE MassProperties<S> combined(std::span<const Child<S>> children, S mass) {
  const Weights<S> weights(children);
  const Vec3<S> centre = centre_of(children, weights);
  S reach = S(0);
  for (const Child<S>& child : children) {
    const Aabb<S> box = bounds(child.primitive, Transform<S>::of(child.pose));
    reach = max(reach, max(max_abs(box.low - centre), max_abs(box.high - centre)));
  }
  const S scale = reach + reach;
  const Mat3<Unit<S>> tensor = tensor_of(children, weights, centre, scale);
  const Quat<Unit<S>> axes = principal_axes(tensor);
  const Mat3<Unit<S>> principal = seen_from(tensor, axes);
  return {mass,
          centre,
          {kappa_from(principal.rows[0].x, scale), kappa_from(principal.rows[1].y, scale),
           kappa_from(principal.rows[2].z, scale)},
          axes};
}

}  // namespace detail

template <class S> MassProperties<S> mass_properties(std::span<const Child<S>> children, S density) {
  S mass = S(0);
  bool immovable = children.empty();
  for (const Child<S>& child : children) {
    immovable = immovable || child.primitive.type == ShapeType::half_space;
    mass = min(mass + detail::mass_of(child.primitive, density), Limits<S>::mass());
  }
  if (immovable) return {S(0), Vec3<S>::zero(), Vec3<S>::zero(), Quat<Unit<S>>::identity()};
  mass = max(mass, resolution<S>());
  if (children.size() > 1) return detail::combined(children, mass);
  const Pose<S>& pose = children[0].pose;
  return {mass, pose.position, detail::kappa_of(children[0].primitive), pose.orientation};
}

}  // namespace isostep
