// Random articulations: trees of every kind of joint, on a base or free, with springs, limits and drives.
// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include "unit/effects/articulations.hpp"

namespace isostep::test {

/// The things that a tree may have beside its links.
struct TreeOptions {
  bool free = false, springs = false, limits = false, damping = false, drives = false, gravity = true;
  int most_links = 12;
};

/// Numbers from raw generator words: the standard's distributions differ between libraries.
class TreeDice {
 public:
  explicit TreeDice(unsigned seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0); }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  D3 point(double reach) {
    const double x = in(-reach, reach);
    const double y = in(-reach, reach);
    return {x, y, in(-reach, reach)};
  }
  D3 direction() {
    for (;;) {
      const D3 v = point(1);
      if (size(v) > 0.1 && size(v) < 1) return v * (1 / size(v));
    }
  }
  template <class S> Quat<Unit<S>> orientation() {
    const D3 axis = direction();
    return turn_about<S>(axis, in(-3, 3));
  }

  template <class S> ArticulationLink<S> link(std::uint32_t index, const TreeOptions& options) {
    ArticulationLink<S> l;
    const int parent = below(static_cast<int>(index) + 1) - (options.free ? 0 : 1);
    l.parent = index == 0 || parent < 0 ? kArticulationBase : std::min(static_cast<std::uint32_t>(parent), index - 1);
    const int type = below(6);
    l.type = type == 0   ? ArticulationJoint::fixed
             : type == 1 ? ArticulationJoint::slider
             : type < 4  ? ArticulationJoint::hinge
                         : ArticulationJoint::ball;
    if (index == 0 && options.free) l.type = ArticulationJoint::free;
    l.frame_a = {vector<S>(point(0.5)), orientation<S>()};
    l.frame_b = {vector<S>(point(0.3)), orientation<S>()};
    l.axis = vector<Unit<S>>(direction());
    const double mass = std::exp(in(-1.5, 1.5));
    const double a = in(0.1, 0.5);
    const double b = in(0.1, 0.5);
    const double c = in(0.1, 0.5);
    l.mass = {number<S>(mass), vector<S>(point(0.3)),
              vector<S>(D3{b * b + c * c, c * c + a * a, a * a + b * b} * (mass / 12)), orientation<S>()};
    const bool scalar = l.type == ArticulationJoint::hinge || l.type == ArticulationJoint::slider;
    const bool moves = scalar || l.type == ArticulationJoint::ball;
    if (moves && options.springs && below(2) == 0) l.stiffness = number<S>(std::exp(in(0, 6)));
    if (moves && options.damping && below(2) == 0) l.damping = number<S>(std::exp(in(-3, 2)));
    if (moves && below(4) == 0) l.armature = number<S>(in(0.01, 0.2));
    if (l.type == ArticulationJoint::slider || (moves && options.limits && below(2) == 0)) {
      l.limited = true;
      const double reach = l.type == ArticulationJoint::slider && !options.limits ? 5.0 : in(0.3, 1.2);
      l.upper = number<S>(reach);
      l.lower = l.type == ArticulationJoint::ball ? S(0) : number<S>(-in(0.3, 1.2));
    }
    if (moves && options.drives && below(2) == 0) l.drive = drive<S>();
    return l;
  }
  template <class S> ArticulationDrive<S> drive() {
    ArticulationDrive<S> d;
    d.target = number<S>(in(-1, 1));
    d.pose = orientation<S>();
    d.speed = vector<S>(point(5));
    d.stiffness = number<S>(below(2) == 0 ? 0 : std::exp(in(0, 8)));
    d.damping = number<S>(std::exp(in(-2, 8)));
    d.max_force = number<S>(std::exp(in(0, 5)));
    return d;
  }
  template <class S> ArticulationDefinition<S> tree(const TreeOptions& options) {
    ArticulationDefinition<S> d;
    const int links = 1 + below(options.most_links);
    for (int i = 0; i < links; ++i) d.links.push_back(link<S>(static_cast<std::uint32_t>(i), options));
    d.settings.base = {vector<S>(point(10)), orientation<S>()};
    if (!options.gravity) d.settings.gravity = Vec3<S>::zero();
    return d;
  }
  /// Sets joints going within limits, at speeds up to `fast`.
  template <class S> void set_going(Articulation<S>& a, double fast) {
    for (std::uint32_t i = 0; i < a.links(); ++i) {
      const ArticulationLink<S>& l = a.definition().links[i];
      JointCoordinates<S> c;
      c.position = vector<S>(point(0.2));
      const D3 axis = direction();
      c.rotation = turn_about<S>(axis, in(-0.2, 0.2));
      c.velocity = vector<S>(point(fast));
      c.angular_velocity = vector<S>(point(fast));
      if (l.type == ArticulationJoint::slider) c.velocity = vector<S>(point(0.3 * fast));
      EXPECT_TRUE(a.set_coordinates(i, c)) << describe(a.fault());
    }
  }

 private:
  std::mt19937 engine_;
};

}  // namespace isostep::test
