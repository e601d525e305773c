// Random frames of a game that has both worlds: rigid bodies among particles, whose energy can be told.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <sstream>

#include "isostep/effects/particle_coupling.hpp"
#include "laws/random_particle_laws.hpp"
#include "random/hull.hpp"
#include "scenes/measure.hpp"

namespace isostep::test {

/// A function of the seed. Four families of particles in turn, each among one to four bodies that move, with or without
/// weight, a floor, a fixed and a kinematic body at rest:
///   grains  loose particles, some joined in pairs or to anchors
///   soft    a box of particles, each joined by springs to all its neighbours
///   net     a net of springs whose edge is pinned
///   pegs    pinned particles, and a few loose ones
/// Springs of a particle have together k h^2 (1/m_a + 1/m_b) below 0.3, as in random_particle_worlds.hpp.
///
/// Left out, because there energy is not bounded by what was put in:
///   - bodies that at first overlap particles which are joined or pinned: `worst_first` pushes these out at once, and
///     springs are stretched by the depth; see clear_place;
///   - bodies that at first overlap each other under `pgs`, which makes a speed of an overlap; see clear_place;
///   - restitution above 0.5 under `worst_first`: particles that bounce between a body and the floor within a step are
///     not foreseen, each bounces off all of the body, and together they make up to seven times its energy; see bounce.
template <class S> class RandomCoupledWorld {
 public:
  explicit RandomCoupledWorld(std::uint64_t seed)
      : chance_(seed),
        family_(static_cast<Family>(seed % 4)),
        hz_(draw_rate(seed)),
        bodies_(draw_bodies()),
        particles_(draw_particles()),
        coupling_(how()) {
    material_ = draw_material();
    switch (family_) {
      case Family::grains: add_grains(); break;
      case Family::soft: add_soft_box(); break;
      case Family::net: add_net(); break;
      case Family::pegs: add_pegs(); break;
    }
    add_scenery();
    const auto count = 1 + chance_.below(4);
    for (std::uint32_t i = 0; i < count; ++i) add_body();
    start_ = energy();
    text_ << ", " << count << " bodies, " << system_.ids.size() << " particles, " << system_.springs.size()
          << " springs, " << start_ << " J";
  }

  /// Steps. Returns false where a limit was met, or a touch refused.
  bool step() {
    EXPECT_TRUE(coupling_.before_step(bodies_, particles_));
    const ParticleReport moved = particles_.step();
    EXPECT_TRUE(coupling_.after_step(bodies_, particles_));
    const StepReport turned = bodies_.step();
    touches_ += coupling_.report().touches;
    return coupling_.report().refused == 0 && keeps_limits(moved) && turned.stopped == 0;
  }
  int steps(double seconds) const { return static_cast<int>(seconds * hz_); }
  double energy() const { return scenes::measure_energy(bodies_).total() + system_.energy(particles_); }
  /// [J] The most energy that it may have: what it had at first, counted from the floor and from springs at rest, and
  /// half of that, for the reason given in random_particle_worlds.hpp; what a grain has at 0.1 m/s; and what a body has
  /// as it leaves an overlap.
  double most() const {
    return 1.5 * start_ + 0.005 * static_cast<double>(system_.ids.size()) + kLeaveSpeed * kLeaveSpeed / 2 * body_mass_;
  }
  double start() const { return start_; }
  std::uint64_t touches() const { return touches_; }
  std::string telling() const { return text_.str(); }

 private:
  enum class Family { grains, soft, net, pegs };
  struct Ball {
    D3 centre;      // [m]
    double radius;  // [m]
  };
  static constexpr double kLeaveSpeed = 0.25;  // [m/s] of a body that leaves what it overlaps: particle_coupling.hpp

  std::int32_t draw_rate(std::uint64_t seed) {
    constexpr int kRates[] = {20, 30, 60, 120};
    text_ << "world " << seed << ": ";
    if (!chance_.one_in(4)) gravity_ = -10;
    return kRates[chance_.below(4)];
  }
  Settings<S> draw_bodies() {
    constexpr int kSubsteps[] = {1, 2, 4, 8};
    Settings<S> s = settings<S>(gravity_, hz_, kSubsteps[chance_.below(4)]);
    s.solver = static_cast<SolverName>(chance_.below(kSolvers));
    if (left_out(s.solver) != nullptr) s.solver = SolverName::soft_step;
    s.allow_sleep = !chance_.one_in(4);
    text_ << "bodies " << kSolverNames[static_cast<int>(s.solver)] << " " << hz_ << " x " << s.substeps;
    return s;
  }
  ParticleSettings<S> draw_particles() {
    constexpr int kSubsteps[] = {1, 2, 4, 8, 16};
    ParticleSettings<S> s = at_rate<S>(gravity_, hz_, kSubsteps[chance_.below(5)]);
    draw_methods(chance_, s);
    h_ = 1.0 / (s.hz * s.substeps);
    text_ << ", particles ";
    tell_methods(text_, s);
    text_ << " x " << s.substeps;
    return s;
  }
  CouplingSettings<S> how() {
    CouplingSettings<S> s;
    if (chance_.one_in(4)) s.unfelt = num<S>(0.25);
    return s;
  }
  double bounce() {
    const double most = particles_.settings().solver == ParticleSolver::worst_first ? 0.5 : 1;
    return most * (chance_.one_in(3) ? 1 : chance_.one_in(3) ? 0 : chance_.in(0, 1));
  }
  double slip() { return chance_.one_in(2) ? 0 : chance_.in(0, 1); }
  ParticleMaterialId draw_material() {
    radius_ = chance_.in(0.03, 0.15);
    const bool collides = chance_.one_in(2), joined = family_ == Family::soft || family_ == Family::net;
    // Particles that springs join begin apart.
    pitch_ = std::max(chance_.in(0.15, 0.5), joined && collides ? 2.2 * radius_ : 0);
    const double restitution = bounce();
    text_ << ", e " << restitution << ", radius " << radius_;
    return particles_.add(grain_of<S>(radius_, restitution, slip(), collides));
  }

  // ---- particles

  double draw_mass() { return chance_.one_in(2) ? 1 : chance_.in(0.0625, 4); }
  /// [m/s] along each axis, at most.
  double draw_speed() { return chance_.one_in(2) ? 0 : chance_.one_in(2) ? 3 : 10; }
  std::size_t add(D3 at, D3 v, double mass, bool pinned = false) {
    ParticleDefinition<S> d = point<S>(at, pinned ? D3{0, 0, 0} : v, mass, material_);
    d.pinned = pinned;
    system_.add(particles_, d);
    return system_.ids.size() - 1;
  }
  /// `share` [1] of k h^2 (1/m_a + 1/m_b). At rest as it is made; b = a: to an anchor.
  void join(std::size_t a, std::size_t b, D3 anchor, double share, double damping) {
    Spring<S> s;
    s.a = system_.ids[a];
    if (b != a) s.b = system_.ids[b];
    else s.anchor = vec<S>(anchor);
    const double mass = system_.inverse_mass(a) + (b != a ? system_.inverse_mass(b) : 0);
    if (mass == 0) return;
    const D3 end = b != a ? real(particles_.position(system_.ids[b])) : real(s.anchor);
    s.stiffness = num<S>(std::min(share / (h_ * h_ * mass), 20000.0));
    s.rest_length = num<S>(length(real(particles_.position(system_.ids[a])) - end));
    s.damping = num<S>(damping / (h_ * mass));
    EXPECT_TRUE(particles_.add(s));
    system_.springs.push_back(s);
  }
  void add_grains() {
    const auto count = 2 + chance_.below(15);
    const double speed = draw_speed();
    for (std::uint32_t i = 0; i < count; ++i) {
      const double mass = draw_mass();
      const D3 v = chance_.point(speed);
      add(D3{0, 1 + radius_, 0} + chance_.point(1), v, mass);
    }
    // Particles that overlap are pushed apart, against springs.
    const bool joined = chance_.one_in(2) && !particles_.find(material_)->collides;
    for (std::uint32_t i = 0; joined && i + 1 < count; i += 2) {
      const double share = chance_.in(0.01, 0.3);
      const D3 anchor = D3{0, 1, 0} + chance_.point(1);
      join(i, chance_.one_in(2) ? i : i + 1, anchor, share, 0);
    }
  }
  /// All of a lattice of so many along each axis, then the springs between neighbours, diagonal ones too.
  void add_lattice(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz, D3 corner, D3 v, bool net) {
    const double mass = draw_mass(), all = chance_.in(0.02, 0.3), damping = chance_.one_in(2) ? 0 : chance_.in(0, 0.01);
    std::vector<D3> places;
    for (std::uint32_t i = 0; i < nx * ny * nz; ++i) {
      const D3 cell = {1.0 * (i % nx), 1.0 * (i / nx % ny), 1.0 * (i / nx / ny)};
      const bool edge = cell.x == 0 || cell.z == 0 || cell.x == nx - 1 || cell.z == nz - 1;
      places.push_back(cell);
      add(corner + cell * pitch_, v, mass, net && edge);
    }
    const double neighbours = (net ? 8 : nx * ny * nz == 8 ? 7 : 26);
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const D3 d = places[i] - places[k];
        if (std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}) < 1.5)
          join(k, i, {0, 0, 0}, all / neighbours, damping);
      }
    }
  }
  void add_soft_box() {
    const auto side = 2 + chance_.below(2);
    const double high = radius_ + chance_.in(0, 1), half = pitch_ * (side - 1) / 2;
    add_lattice(side, side, side, {-half, high, -half}, chance_.point(draw_speed()), false);
  }
  void add_net() {
    const auto side = 3 + chance_.below(4);
    const double half = pitch_ * (side - 1) / 2;
    add_lattice(side, 1, side, {-half, 0.5, -half}, {0, 0, 0}, true);
  }
  void add_pegs() {
    const auto count = 2 + chance_.below(8);
    const double speed = draw_speed();
    for (std::uint32_t i = 0; i < count; ++i) {
      const bool pinned = !chance_.one_in(4);
      const double mass = draw_mass();
      const D3 v = chance_.point(speed);
      add(D3{0, 1, 0} + chance_.point(0.8), v, mass, pinned);
    }
  }

  // ---- bodies

  ShapeId draw_shape(double& reach) {
    const double a = chance_.in(0.1, 0.4), b = chance_.in(0.1, 0.4), c = chance_.in(0.1, 0.4);
    switch (chance_.below(4)) {
      case 0: reach = a; return add_ball(bodies_, a);
      case 1: reach = length({a, b, c}); return add_box(bodies_, a, b, c);
      case 2: {
        const double radius = a > 0.3 ? b / 4 : 0;  // of a third
        reach = length({a, b, c}) + radius;
        return add_hull(bodies_, draw_hull(chance_, {a, b, c}), radius);
      }
      default: reach = a + b; return bodies_.add_shape(Capsule<S>{num<S>(a), num<S>(b)});
    }
  }
  /// A place for a ball about a body: clear of particles where some are joined or pinned, and of other bodies under
  /// `pgs`.
  D3 clear_place(double reach) {
    const bool loose = system_.springs.empty() && std::count(system_.masses.begin(), system_.masses.end(), 0) == 0;
    const bool apart = bodies_.settings().solver == SolverName::pgs;
    for (double wide = 0.8;; wide += 0.02) {
      const D3 place = D3{0, reach + wide, 0} + chance_.point(wide);
      bool clear = true;
      for (const ParticleId id : system_.ids)
        clear = clear && (loose || length(real(particles_.position(id)) - place) > reach + radius_);
      for (const Ball& ball : balls_) clear = clear && (!apart || length(ball.centre - place) > reach + ball.radius);
      if (!clear) continue;
      balls_.push_back({place, reach});
      return place;
    }
  }
  void add_scenery() {
    if (gravity_ != 0 || chance_.one_in(2)) add_ground(bodies_, slip());
    for (const BodyType type : {BodyType::static_, BodyType::kinematic}) {
      if (!chance_.one_in(4)) continue;
      double reach = 0;
      BodyDefinition<S> d = still<S>(draw_shape(reach));
      d.position = vec<S>(clear_place(reach));
      d.type = type;
      d.material.friction = num<S>(slip());
      d.material.restitution = num<S>(bounce());
      bodies_.create(d);
    }
  }
  void add_body() {
    double reach = 0;
    const ShapeId shape = draw_shape(reach);
    const double speed = draw_speed(), angular_speed = chance_.one_in(2) ? 0 : 6;
    const D3 v = chance_.point(speed);
    BodyDefinition<S> d = moving<S>(shape, clear_place(reach), v);
    d.angular_velocity = vec<S>(chance_.point(angular_speed));
    d.orientation = turn<S>({0.6, 0, 0.8}, chance_.in(0, 6));
    d.mass = num<S>(chance_.one_in(2) ? 1 : chance_.in(0.25, 16));
    d.material.friction = num<S>(slip());
    d.material.restitution = num<S>(bounce());
    EXPECT_TRUE(bodies_.create(d));
    body_mass_ += to_double(d.mass);
  }

  Chance chance_;
  Family family_;
  std::ostringstream text_;
  double gravity_ = 0, h_ = 0, radius_ = 0, pitch_ = 0, start_ = 0, body_mass_ = 0;
  std::int32_t hz_ = 0;
  World<S> bodies_;
  ParticleWorld<S> particles_;
  ParticleCoupling<S> coupling_;
  ParticleMaterialId material_;
  ParticleSystem<S> system_;
  std::vector<Ball> balls_;  // about the bodies
  std::uint64_t touches_ = 0;
};

}  // namespace isostep::test
