// Particles and rows made by hand, for tests of what solves them; numbers go in and come out as doubles.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "isostep/particles/solvers/worst_first.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {
inline namespace row_scene {

struct D3 {
  double x, y, z;
};
inline D3 operator-(D3 a) { return {-a.x, -a.y, -a.z}; }
inline D3 operator+(D3 a, D3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline D3 operator*(double s, D3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(D3 a, D3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr D3 kRight = {1, 0, 0}, kUp = {0, 1, 0}, kNowhere = {0, 0, 0};
constexpr double kPinned = 0;
constexpr std::uint32_t kMany = 100000;

/// Particles and the rows between them, in the resolver's own terms.
template <class S> struct Scene {
  using V = Velocity<S>;
  Axes<V> velocity, displacement, gained;
  std::vector<double> mass;
  std::vector<ParticleConstraint<S>> rows;
  WorstFirst<S> resolver;
  double gain_rate = 64;  // [1/s] of what made `gained`
  std::uint64_t looks = ~std::uint64_t{0};

  static Vec3<V> vector(D3 a) { return {from_double<V>(a.x), from_double<V>(a.y), from_double<V>(a.z)}; }
  static D3 doubles(Vec3<V> a) { return {to_double(a.x), to_double(a.y), to_double(a.z)}; }
  static Vec3<Unit<S>> direction(D3 a) {
    const Direction<S> way = direction_of(from_double<S>(a.x), from_double<S>(a.y), from_double<S>(a.z));
    return {way.x, way.y, way.z};
  }

  /// `m` kPinned: immovable.
  std::uint32_t add(double m, D3 v = kNowhere) {
    mass.push_back(m);
    velocity.push_back(vector(v));
    displacement.push_back(vector(kNowhere));
    gained.push_back(vector(kNowhere));
    return static_cast<std::uint32_t>(mass.size() - 1);
  }
  ParticleConstraint<S>& join(ConstraintKind kind, std::uint32_t a, std::uint32_t b, D3 n, double c, double e = 0,
                              double mu = 0) {
    const double other = b == kNoParticle ? kPinned : mass[b];
    // m_b / (m_a + m_b), where immovable is infinitely heavy.
    double share = mass[a] == kPinned ? 0 : other == kPinned ? 1 : other / (mass[a] + other);
    ParticleConstraint<S> row{};
    row.kind = kind;
    row.a = a;
    row.b = b;
    row.normal = direction(n);
    row.separation = from_double<S>(c);
    row.share_a = from_double<Unit<S>>(share);
    row.share_b = other == kPinned ? Unit<S>(0) : Unit<S>(1) - row.share_a;
    row.friction = from_double<S>(mu);
    row.restitution = from_double<S>(e);
    row.surface_velocity = row.friction_impulse = vector(kNowhere);
    row.impulse = row.approach = V(0);
    rows.push_back(row);
    return rows.back();
  }
  ParticleConstraint<S>& touch(std::uint32_t a, std::uint32_t b, D3 n, double c = 0, double e = 0, double mu = 0) {
    return join(ConstraintKind::contact, a, b, n, c, e, mu);
  }
  /// A plane below: the particle is its a, so the normal points down, into the plane.
  ParticleConstraint<S>& ground(std::uint32_t a, D3 up = kUp, double c = 0, double e = 0, double mu = 0) {
    return touch(a, kNoParticle, -up, c, e, mu);
  }

  std::uint32_t resolve(std::uint32_t most = kMany) {
    return resolver.resolve(rows.data(), static_cast<std::uint32_t>(rows.size()), velocity, displacement, gained,
                            {from_double<S>(gain_rate), true, most, looks});
  }
  void accelerate(D3 gravity, double rate) {
    gain_rate = rate;
    for (std::uint32_t i = 0; i < mass.size(); ++i) {
      if (mass[i] == kPinned) continue;
      gained.set(i, vector((1 / rate) * gravity));
      velocity.add(i, gained[i]);
    }
  }
  void move(double rate) {
    const Step<S> h = from_double<Step<S>>(1 / rate);
    for (std::uint32_t i = 0; i < mass.size(); ++i) displacement.add(i, velocity[i] * h);
  }
  /// A sub-step of 1/rate in the book's order.
  std::uint32_t substep(D3 gravity, double rate) {
    accelerate(gravity, rate);
    move(rate);
    return resolve();
  }
  D3 v(std::uint32_t i) const { return doubles(velocity[i]); }
  D3 d(std::uint32_t i) const { return doubles(displacement[i]); }
  /// C of a row now, in doubles.
  double gap(std::size_t i) const {
    const ParticleConstraint<S>& row = rows[i];
    const D3 n = {to_double(row.normal.x), to_double(row.normal.y), to_double(row.normal.z)};
    const D3 b = row.b == kNoParticle ? kNowhere : d(row.b);
    return to_double(row.separation) + dot(n, b + -d(row.a));
  }
};

/// One unit in the last place of a speed of this size.
template <class S> double unit_of(double size) {
  if constexpr (kIsFixed<S>) return to_double(resolution<Velocity<S>>());
  return to_double(resolution<S>()) * std::exp2(std::floor(std::log2(std::abs(size))));
}

using Scalars = testing::Types<float, double, Q16_16, Q32_32>;

}  // namespace row_scene
}  // namespace isostep
