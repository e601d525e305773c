// A network of springs whose forces are computed in double: what integrators of springs are tried on.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "isostep/particles/axes.hpp"
#include "isostep/particles/spring.hpp"

namespace isostep::test {

inline Vec3<double> real(auto v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
template <class S> Vec3<S> rounded(Vec3<double> v) {
  return {from_double<S>(v.x), from_double<S>(v.y), from_double<S>(v.z)};
}
inline double norm(Vec3<double> v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }
inline double inner(Vec3<double> a, Vec3<double> b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

template <class S> struct SpringNetwork {
  Axes<S> position, acceleration;
  Axes<Velocity<S>> velocity;
  std::vector<InverseMass<S>> inverse_mass;
  std::vector<Spring<S>> springs;
  Vec3<double> gravity = {0, 0, 0};
  std::int32_t rate = 60;

  /// `mass` 0: pinned.
  ParticleId add(Vec3<double> at, double mass, Vec3<double> speed = {0, 0, 0}) {
    position.push_back(rounded<S>(at));
    velocity.push_back(rounded<Velocity<S>>(speed));
    acceleration.push_back({S(0), S(0), S(0)});
    inverse_mass.push_back(mass > 0 ? from_double<InverseMass<S>>(1 / mass) : InverseMass<S>(0));
    return {static_cast<std::uint32_t>(inverse_mass.size() - 1), 1};
  }
  Spring<S>& tie(ParticleId a, ParticleId b, double stiffness, double damping, double rest) {
    Spring<S> spring;
    spring.a = a;
    spring.b = b;
    spring.stiffness = from_double<S>(stiffness);
    spring.damping = from_double<S>(damping);
    spring.rest_length = from_double<S>(rest);
    springs.push_back(spring);
    return springs.back();
  }
  Spring<S>& hang(ParticleId a, Vec3<double> anchor, double stiffness, double damping, double rest) {
    Spring<S>& spring = tie(a, {}, stiffness, damping, rest);
    spring.anchor = rounded<S>(anchor);
    return spring;
  }
  Vec3<double> distance(const Spring<S>& spring) const {
    return real(position[spring.a.slot]) - (spring.b ? real(position[spring.b.slot]) : real(spring.anchor));
  }
  Vec3<double> approach(const Spring<S>& spring) const {
    const Vec3<double> v = real(velocity[spring.a.slot]);
    return spring.b ? v - real(velocity[spring.b.slot]) : v;
  }
  void accelerate() {
    std::vector<Vec3<double>> force(inverse_mass.size(), {0, 0, 0});
    for (const Spring<S>& spring : springs) {
      const Vec3<double> d = distance(spring);
      const double l = norm(d), stretch = l - to_double(spring.rest_length);
      if (l == 0 || (spring.type == SpringType::bungee && stretch <= 0)) continue;
      const Vec3<double> n = d * (1 / l);
      const Vec3<double> f =
          n * -(to_double(spring.stiffness) * stretch + to_double(spring.damping) * inner(n, approach(spring)));
      force[spring.a.slot] += f;
      if (spring.b) force[spring.b.slot] -= f;
    }
    for (std::size_t i = 0; i < force.size(); ++i) {
      const double w = to_double(inverse_mass[i]);
      acceleration.set(i, rounded<S>(w == 0 ? Vec3<double>{0, 0, 0} : force[i] * w + gravity));
    }
  }
  void move() {
    for (std::size_t i = 0; i < inverse_mass.size(); ++i) {
      position.set(i, rounded<S>(real(position[i]) + real(velocity[i]) * (1.0 / rate)));
    }
  }
  template <class Solver> bool solve(Solver& solver) {
    accelerate();
    return solver.solve(springs, position, velocity, acceleration, inverse_mass, rate);
  }
  template <class Solver> bool step(Solver& solver) {
    const bool solved = solve(solver);
    move();
    return solved;
  }
  double mass(std::size_t i) const { return 1 / to_double(inverse_mass[i]); }
  Vec3<double> momentum() const {
    Vec3<double> sum = {0, 0, 0};
    for (std::size_t i = 0; i < inverse_mass.size(); ++i) sum += real(velocity[i]) * mass(i);
    return sum;
  }
};

/// Structural, shear and bend springs in the plane z = 0, its far corners pinned. `mass` of each particle.
template <class S>
void weave(SpringNetwork<S>& net, int side, double spacing, double mass, double stiffness, double damping) {
  const auto at = [&](int x, int y) { return ParticleId{static_cast<std::uint32_t>(y * side + x), 1}; };
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const bool corner = y == side - 1 && (x == 0 || x == side - 1);
      net.add({x * spacing, y * spacing, 0}, corner ? 0 : mass);
    }
  }
  const int reach[][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      for (const auto& [dx, dy] : reach) {
        if (x + dx < 0 || x + dx >= side || y + dy >= side) continue;
        net.tie(at(x, y), at(x + dx, y + dy), stiffness, damping, spacing * std::sqrt(dx * dx + dy * dy));
      }
    }
  }
}

}  // namespace isostep::test
