// Random particle worlds whose energy can be told: springs, links, cohesion, contacts and scenery, by every method.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <sstream>

#include "laws/random_particle_laws.hpp"

namespace isostep::test {

/// A function of the seed. Four families in turn:
///   joined   particles apart from each other over a floor, with springs, bungees, stiff springs, cables and rods
///   pressed  few particles that springs press into planes, at steps from fine to coarse
///   crowded  particles in one place or nearly, without weight: there is no energy to gain
///   blob     particles that cohesion pushes and pulls, without weight or over a floor
/// Nothing in them is beyond what the particles' page calls stable: of springs that are no stiff ones, all at one
/// particle have together k h^2 (1/m_a + 1/m_b) below 0.3, a thirteenth of the least bound of an integrator. Cohesion
/// is not smooth where two meet and where it ends: with all neighbours together it has k h^2 (1/m_a + 1/m_b) below 0.1.
///
/// Left out: blobs that an attraction presses into contacts under `worst_first`. It pushes out what was pulled in,
/// against the attraction: eight particles of 304 J have 741 J after five seconds, whatever their restitution.
template <class S> class RandomParticleWorld {
 public:
  explicit RandomParticleWorld(std::uint64_t seed) : chance_(seed), world_(settings(seed)) {
    const ParticleMaterial<S> ball = material(seed % kFamilies != kBlob || chance_.one_in(2));
    material_ = world_.add(ball);
    radius_ = to_double(ball.radius);
    switch (seed % kFamilies) {
      case 0: join(); break;
      case 1: press(); break;
      case kCrowd: crowd(); break;
      default: cohere(); break;
    }
    start_ = energy();
    text_ << ", " << system_.ids.size() << " particles, " << system_.springs.size() << " springs, e "
          << to_double(ball.restitution) << ", radius " << radius_ << ", " << start_ << " J";
  }

  /// Steps. Returns false where a limit was met.
  bool step() { return keeps_limits(world_.step()); }
  int steps(double seconds) const { return static_cast<int>(seconds * world_.settings().hz); }
  double energy() const { return system_.energy(world_) + energy_of_cohesion(); }
  /// [J] The most energy that it may have: what it had at first, counted from the floor and from springs at rest, and
  /// half of that: a method of first order with springs of k h^2 / m = 0.3 swings within 1 / (1 - sqrt(0.3) / 2) =
  /// 1.38. And what a grain of a crowd has at 0.1 m/s.
  double most() const { return 1.5 * start_ + 0.005 * static_cast<double>(system_.ids.size()); }
  double start() const { return start_; }
  std::string telling() const { return text_.str(); }
  const ParticleWorld<S>& world() const { return world_; }

 private:
  static constexpr std::uint64_t kFamilies = 4, kCrowd = 2, kBlob = 3;
  static constexpr double kCohesionShare = 0.1;  // [1] of k h^2 (1/m_a + 1/m_b), all neighbours together

  /// [J] The energy counted from where two of a blob are at peace, between repulsion and attraction: 0 at least.
  double energy_of_cohesion() const {
    const double repel = to_double(cohesion_.repel_distance), start = to_double(cohesion_.attract_start);
    const double reach = to_double(cohesion_.attract_end) - start;
    double sum = 0;
    for (std::size_t i = 0; cohesion_.material && i < system_.ids.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const double apart = length(real(world_.position(system_.ids[i])) - real(world_.position(system_.ids[k])));
        const double into = repel - apart, beyond = std::min(apart - start, reach);
        if (into > 0) sum += to_double(cohesion_.repel_force) * into * into / (2 * repel);
        if (beyond > 0) sum += to_double(cohesion_.attract_force) * beyond * beyond / (2 * reach);
      }
    }
    return sum;
  }
  ParticleSettings<S> settings(std::uint64_t seed) {
    constexpr int kRates[] = {20, 30, 60, 120}, kSubsteps[] = {1, 2, 4, 8, 16};
    const int substeps = kSubsteps[chance_.below(5)];
    ParticleSettings<S> s = at_rate<S>(0, kRates[chance_.below(4)], substeps);
    draw_methods(chance_, s);
    if (seed % kFamilies != kCrowd && !chance_.one_in(4)) gravity_ = -10;
    s.gravity = vec<S>(0, gravity_, 0);
    h_ = 1.0 / (s.hz * s.substeps);
    text_ << "world " << seed << ": ";
    tell_methods(text_, s);
    text_ << " " << s.hz << " x " << s.substeps;
    return s;
  }
  ParticleMaterial<S> material(bool collides) {
    const double e = chance_.one_in(3) ? 1 : chance_.one_in(3) ? 0 : chance_.in(0, 1);
    const double friction = chance_.one_in(2) ? 0 : chance_.in(0, 1);
    return grain_of<S>(chance_.in(0.05, 0.2), e, friction, collides);
  }
  void add(D3 at, D3 v, bool pinned = false) {
    ParticleDefinition<S> d = point<S>(at, v, chance_.one_in(2) ? 1 : chance_.in(0.5, 4), material_);
    d.pinned = pinned;
    system_.add(world_, d);
    strain_.push_back(0);
  }
  /// Adds a spring between two, or from one to an anchor; with what a particle still bears.
  void add_spring(SpringType type, std::size_t a, std::size_t b, D3 anchor, double rest) {
    Spring<S> s;
    s.type = type;
    s.a = system_.ids[a];
    const bool joins = b != a;
    if (joins) s.b = system_.ids[b];
    else s.anchor = vec<S>(anchor);
    const double mass = system_.inverse_mass(a) + (joins ? system_.inverse_mass(b) : 0);
    if (mass == 0) return;
    // A bungee that goes slack is no smooth force: what a method of first order errs there it does not give back.
    double part = type == SpringType::bungee ? chance_.in(0.005, 0.03) : chance_.in(0.01, 0.15);
    if (type == SpringType::stiff) {
      s.stiffness = num<S>(chance_.one_in(2) ? chance_.in(10, 1000) : chance_.in(1000, 20000));
    } else {
      part = std::min({part, 0.3 - strain_[a], joins ? 0.3 - strain_[b] : 1});
      const double stiffness = std::min(part / (h_ * h_ * mass), 20000.0);
      if (stiffness < 1) return;
      strain_[a] += stiffness * h_ * h_ * mass;
      if (joins) strain_[b] += stiffness * h_ * h_ * mass;
      s.stiffness = num<S>(stiffness);
      s.rest_length = num<S>(rest);
    }
    if (chance_.one_in(4)) s.damping = num<S>(std::min(chance_.in(0, 5), 0.05 / (h_ * mass)));
    EXPECT_TRUE(world_.add(s));
    system_.springs.push_back(s);
  }
  SpringType kind() { return static_cast<SpringType>(chance_.below(3)); }

  void join() {
    add_scenery();
    const auto count = 2 + chance_.below(9);
    for (std::uint32_t i = 0; i < count; ++i) {
      const D3 at = D3{0.8 * (i % 2) - 0.4, 0.4 + 0.8 * (i / 4), 0.8 * (i / 2 % 2) - 0.4} + chance_.point(0.15);
      const bool pinned = i > 0 && chance_.one_in(12);
      add(at, chance_.point(3), pinned);
      if (system_.masses.back() == 0)
        world_.place(system_.ids.back(), world_.position(system_.ids.back()), vec<S>(0, 0, 0));
    }
    const auto joints = chance_.below(2 * count);
    for (std::uint32_t i = 0; i < joints; ++i) {
      const std::size_t a = chance_.below(count), b = chance_.below(count);
      const D3 from = real(world_.position(system_.ids[a])), anchor = from + chance_.point(1);
      const double apart = length(from - (b == a ? anchor : real(world_.position(system_.ids[b]))));
      if (!chance_.one_in(3)) {
        const double rest = chance_.one_in(2) ? apart : chance_.in(0, 1.5);
        add_spring(kind(), a, b, anchor, rest);
        continue;
      }
      if (apart < 0.1) continue;
      Link<S> link;
      link.type = chance_.one_in(2) ? LinkType::rod : LinkType::cable;
      link.a = system_.ids[a];
      if (b != a) link.b = system_.ids[b];
      else link.anchor = vec<S>(anchor);
      link.length = num<S>(link.type == LinkType::rod ? apart : apart * chance_.in(1, 1.5));
      link.restitution = num<S>(chance_.one_in(2) ? 0 : chance_.in(0, 1));
      EXPECT_TRUE(world_.add(link));
      ++links_;
    }
    text_ << ", " << links_ << " links";
  }
  void add_scenery() {
    world_.add(plane<S>({0, 1, 0}, 0));
    if (chance_.one_in(2)) {
      for (const double side : {-1.0, 1.0}) {
        world_.add(plane<S>({side, 0, 0}, -1.2));
        world_.add(plane<S>({0, 0, side}, -1.2));
      }
    }
    if (chance_.one_in(4)) {
      Collider<S> line;
      line.type = ColliderType::line;
      line.start = vec<S>(-1, 3.5, 0);
      line.end = vec<S>(1, 3.5, 0.5);
      line.radius = num<S>(0.1);
      world_.add(line);
    }
  }
  void press() {
    world_.add(plane<S>({0, 1, 0}, 0));
    const auto count = 1 + chance_.below(3);
    for (std::uint32_t i = 0; i < count; ++i) {
      const D3 v = chance_.one_in(2) ? D3{0, 0, 0} : chance_.point(3);
      add({1.0 * i, radius_ + (chance_.one_in(2) ? 0 : chance_.in(0, 0.5)), 0}, v);
      const D3 under = {1.0 * i, -chance_.in(0.05, 1), 0};
      const double rest = chance_.one_in(2) ? 0 : chance_.in(0, 0.5);
      add_spring(kind(), i, i, under, rest);
    }
  }
  void crowd() {
    if (chance_.one_in(2)) world_.add(plane<S>({0, 1, 0}, 0));
    const auto count = 2 + chance_.below(chance_.one_in(4) ? 40 : 12);
    const double apart = chance_.one_in(3) ? 0 : chance_.in(0, 0.1);
    for (std::uint32_t i = 0; i < count; ++i) add(D3{0, 0.2, 0} + chance_.point(apart), {0, 0, 0});
  }
  void cohere() {
    const bool floor = gravity_ != 0 || chance_.one_in(2);
    if (floor) world_.add(plane<S>({0, 1, 0}, 0));
    const auto count = 2 + chance_.below(11);
    // Blobs begin on a lattice, apart from each other where they collide: to push overlaps apart against attraction
    // takes energy.
    const bool collides = world_.find(material_)->collides;
    const double least = collides ? 2.4 * radius_ : 0, pitch = std::max(chance_.in(0, 0.6), least);
    const double astray = collides ? 0.08 * pitch : chance_.in(0, 0.3);
    const double speed = chance_.one_in(3) ? 0 : chance_.in(0, 2);
    for (std::uint32_t i = 0; i < count; ++i) {
      const D3 corner = D3{1.0 * (i % 2), 1.0 * (i / 4), 1.0 * (i / 2 % 2)} * pitch;
      const D3 v = chance_.point(speed);
      add(corner + D3{0, floor ? radius_ + astray : 0, 0} + chance_.point(astray), v);
    }
    add_cohesion(collides && world_.settings().solver == ParticleSolver::worst_first ? 2 * radius_ : 0);
  }
  /// Attraction begins at `least` or farther. Stiffness is as if all were near each other, and each the lightest.
  void add_cohesion(double least) {
    const double lightest = *std::min_element(system_.masses.begin(), system_.masses.end());
    const double most = lightest / (2 * h_ * h_ * static_cast<double>(system_.masses.size() - 1));  // [N/m]
    const double repel = chance_.in(0.1, 0.5), start = repel + (chance_.one_in(2) ? 0 : chance_.in(0, 0.3));
    const double reach = chance_.one_in(6) ? 0 : chance_.in(0.1, 0.6);
    cohesion_.material = material_;
    cohesion_.repel_distance = num<S>(repel);
    cohesion_.repel_force = num<S>(repel * std::min(chance_.in(0, kCohesionShare) * most, 2000.0));
    cohesion_.attract_start = num<S>(std::max(start, least));
    cohesion_.attract_end = num<S>(std::max(start, least) + reach);
    cohesion_.attract_force = num<S>(reach * std::min(chance_.in(0, kCohesionShare) * most, 2000.0));
    EXPECT_TRUE(world_.add(cohesion_));
    text_ << ", blob of " << repel << " m " << to_double(cohesion_.repel_force) << " N, " << std::max(start, least)
          << " + " << reach << " m " << to_double(cohesion_.attract_force) << " N";
  }

  Chance chance_;
  std::ostringstream text_;
  double h_ = 0, gravity_ = 0, radius_ = 0, start_ = 0;
  ParticleWorld<S> world_;
  ParticleMaterialId material_;
  ParticleSystem<S> system_;
  std::vector<double> strain_;  // [1] of each particle: k h^2 (1/m_a + 1/m_b) of its springs
  Cohesion<S> cohesion_;        // without a material: none
  int links_ = 0;
};

}  // namespace isostep::test
