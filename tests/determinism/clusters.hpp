// Clusters of particles that stand far apart, each tied and moved in another way, made particle by particle in whatever
// order: for the tests that what never touches does not know of each other.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "isostep/state/hash.hpp"
#include "unit/particles/particle_worlds.hpp"

namespace isostep::test {

/// The common ground of clusters, made before anything else: materials, the ground, what coheres.
struct ClusterGround {
  ParticleMaterialId balls, cloth, feather, goo;
  template <class S> static ClusterGround of(ParticleWorld<S>& w) {
    ClusterGround ground;
    ground.balls = w.add(ball_material<S>(0.25, 0.25, 0.5));
    ParticleMaterial<S> material;
    material.damping = num<S>(0.75);
    ground.cloth = w.add(material);
    material = {};
    material.linear_drag = num<S>(0.0625);
    material.quadratic_drag = num<S>(0.03125);
    ground.feather = w.add(material);
    ground.goo = w.add(ball_material<S>(0.125));
    add_plane(w);
    EXPECT_TRUE(w.add(Cohesion<S>{ground.goo, num<S>(0.25), S(30), num<S>(0.375), S(1), S(20)}));
    return ground;
  }
};

template <class S> class Cluster {
 public:
  enum Kind { heap, net, rope, bridge, blob, pendulum, feathers, kKinds };
  static constexpr double kApart = 14, kReach = 6;  // [m]

  Cluster(int number, const ClusterGround& ground) : kind_(static_cast<Kind>(number % kKinds)), ground_(ground) {
    at_ = {kApart * (number % 3 - 1), 0, kApart * (number / 3 - 1)};
  }

  /// The next particle with what ties it to those before; false when all are there.
  bool make_next(ParticleWorld<S>& w) {
    const int i = static_cast<int>(particles_.size());
    switch (kind_) {
      case heap: return i < 12 && add(w, {0.375 * (i % 2), 0.5 + 0.5625 * i, 0.25 * (i % 3)}, ground_.balls);
      case net:
        if (i == 16 || !add(w, {0.5 * (i % 4), 4, 0.5 * (i / 4)}, ground_.cloth, i == 0 || i == 3)) return false;
        if (i % 4 > 0) tie(w, i - 1, 60);
        if (i >= 4) tie(w, i - 4, 45);
        return true;
      case rope:
        if (i == 7 || !add(w, {0.5 * i, 5, 0}, ground_.balls, i == 0)) return false;
        if (i > 0) link(w, LinkType::cable, i - 1, 0.625);
        return true;
      case bridge:
        if (i == 6 || !add(w, {1.0 * i - 2.5, 3, 0}, ground_.goo, i == 5)) return false;
        if (i > 0) link(w, LinkType::rod, i - 1, 1);
        if (i == 0) link(w, LinkType::cable, -1, 0.5);
        return true;
      case blob: return i < 8 && add(w, {0.25 * (i % 2), 1 + 0.25 * (i / 2 % 2), 0.25 * (i / 4)}, ground_.goo);
      case pendulum:
        if (i == 3 || !add(w, {1.0 * i, 4, 0.5}, ground_.cloth)) return false;
        w.add(spring_to(w, i, i == 2 ? SpringType::spring : SpringType::stiff, i == 2 ? 400 : 20000));
        return true;
      default:
        if (i == 9 || !add(w, {0.5 * i - 2, 5, 0}, ground_.feather)) return false;
        if (i % 3 == 0) {
          ParticleForce<S> drag = force_of<S>(ForceType::drag, particles_.back());
          drag.linear_drag = num<S>(0.5);
          w.add(drag);
        }
        return true;
    }
  }

  /// A kick, a newcomer, one that goes and one in its place.
  void play(ParticleWorld<S>& w, int frame) {
    if (frame == 8 + kind_) w.apply_impulse(particles_[particles_.size() / 2], vec<S>(0.5, 0.75, 0.25));
    const bool loose = kind_ == heap || kind_ == blob || kind_ == feathers;
    const ParticleMaterialId own = kind_ == heap ? ground_.balls : kind_ == blob ? ground_.goo : ground_.feather;
    if (frame == 20 + kind_ % 2 && loose) add(w, {0.125, 5, 0.125}, own);
    if (frame == 32 + kind_ % 3 && loose) {
      const ParticleId gone = particles_.back();
      particles_.pop_back();
      w.destroy(gone);
      add(w, {0.25, 4, 0}, own);
    }
  }

  std::uint64_t hash(const ParticleWorld<S>& w) const {
    HashCombiner all;
    for (const ParticleId id : particles_) {
      const auto place = w.position(id);
      const auto velocity = w.velocity(id);
      for (int axis = 0; axis < 3; ++axis) {
        all.add(to_bits(place[axis]));
        all.add(to_bits(velocity[axis]));
      }
    }
    return all.value();
  }
  /// All of it is where nothing of another can be.
  bool keeps_apart(const ParticleWorld<S>& w) const {
    for (const ParticleId id : particles_) {
      const D3 from = real(w.position(id)) - at_;
      if (!(std::fabs(from.x) < kReach && std::fabs(from.z) < kReach)) return false;
    }
    return true;
  }

 private:
  bool add(ParticleWorld<S>& w, D3 p, ParticleMaterialId material, bool pinned = false) {
    ParticleDefinition<S> d =
        particle_at<S>(at_ + p, {0.25, pinned ? 0 : -0.5, 0.125}, 0.5 + 0.25 * (particles_.size() % 3));
    d.material = material;
    d.pinned = pinned;
    if (pinned) d.velocity = Vec3<S>::zero();
    particles_.push_back(w.create(d));
    EXPECT_TRUE(particles_.back()) << describe(w.fault());
    return true;
  }
  ParticleId former(int i) const { return i < 0 ? ParticleId{} : particles_[static_cast<std::size_t>(i)]; }
  void tie(ParticleWorld<S>& w, int to, double stiffness) {
    Spring<S> s = spring_of<S>(particles_.back(), former(to), stiffness, 0.5);
    s.damping = num<S>(0.5);
    if (to % 3 == 0) s.type = SpringType::bungee;
    EXPECT_TRUE(w.add(s)) << describe(w.fault());
  }
  Spring<S> spring_to(ParticleWorld<S>&, int i, SpringType type, double stiffness) const {
    Spring<S> s = spring_of<S>(particles_.back(), {}, stiffness, 0);
    s.type = type;
    s.damping = S(2);
    s.anchor = vec<S>(at_ + D3{1.0 * i, 5, 0});
    return s;
  }
  void link(ParticleWorld<S>& w, LinkType type, int to, double length) {
    Link<S> l = link_of<S>(type, particles_.back(), former(to), length);
    if (to < 0) l.anchor = vec<S>(at_ + D3{-2.75, 3.25, 0});
    EXPECT_TRUE(w.add(l)) << describe(w.fault());
  }

  Kind kind_;
  ClusterGround ground_;
  D3 at_;
  std::vector<ParticleId> particles_;
};

}  // namespace isostep::test
