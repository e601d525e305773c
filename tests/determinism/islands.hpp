// Things that stand far apart, each of another kind, made body by body in whatever order: for the tests that what never
// touches does not know of each other.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "isostep/state/hash.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Shapes are shared, and made before anything else.
struct IslandShapes {
  ShapeId box, ball, capsule, hammer, plank, pen;
  template <class S> static IslandShapes of(World<S>& w) {
    IslandShapes shapes;
    shapes.box = add_box(w, 0.5, 0.25, 0.375);
    shapes.ball = add_ball(w, 0.375);
    shapes.capsule = w.add_shape(Capsule<S>{num<S>(0.125), num<S>(0.25)});
    const Child<S> parts[] = {
        {primitive_of(Box<S>{vec<S>(0.125, 0.5, 0.125)}), Pose<S>::identity()},
        {primitive_of(Box<S>{vec<S>(0.375, 0.25, 0.25)}), {vec<S>(0, 0.75, 0), Quat<Unit<S>>::identity()}}};
    shapes.hammer = w.add_shape(std::span<const Child<S>>(parts));
    shapes.plank = add_box(w, 1, 0.125, 0.5);
    std::vector<Child<S>> walls;
    for (const double side : {-1.0, 1.0}) {
      const Quat<Unit<S>> straight = Quat<Unit<S>>::identity();
      walls.push_back({primitive_of(Box<S>{vec<S>(3.5, 4, 0.25)}), {vec<S>(0, 4, 3.25 * side), straight}});
      walls.push_back({primitive_of(Box<S>{vec<S>(0.25, 4, 3.5)}), {vec<S>(3.25 * side, 4, 0), straight}});
    }
    shapes.pen = w.add_shape(std::span<const Child<S>>(walls));
    return shapes;
  }
};

/// One of them: what it is made of, in order, what happens to it, and what it came to.
template <class S> class Island {
 public:
  enum Kind { stack, balls, chain, ragdoll, heap, loop, paddle, bridge, belt, flat, kKinds };
  static constexpr double kApart = 12, kReach = 5;  // [m]

  Island(int number, const IslandShapes& shapes) : kind_(static_cast<Kind>(number % kKinds)), shapes_(shapes) {
    at_ = {kApart * (number % 4 - 1.5), 0, kApart * (number / 4 - 1.0)};
    add(shapes.pen, {0, 0, 0}).type = BodyType::static_;  // what rolls stays
    switch (kind_) {
      case stack:
        for (int i = 0; i < 6; ++i) add(shapes.box, {0.0625 * (i % 2), 0.25 + 0.5 * i, 0});
        break;
      case balls:
        for (int i = 0; i < 6; ++i) bouncy(shapes.ball, {0.5 * (i % 3), 1 + 0.875 * i, 0.25 * (i % 2)});
        break;
      case chain: make_chain(); break;
      case ragdoll: make_ragdoll(); break;
      case heap:
        for (int i = 0; i < 8; ++i)
          add(any_shape(i), {0.375 * (i % 3) - 0.375, 0.75 + 0.625 * i, 0.25 * (i % 4) - 0.5});
        break;
      case loop: make_loop(); break;
      case paddle: make_paddle(); break;
      case bridge: make_bridge(); break;
      case belt: make_belt(); break;
      default:
        for (int i = 0; i < 4; ++i) add(shapes.box, {1.5 * (i % 2) - 0.75, 0.25, 1.5 * (i / 2) - 0.75});
    }
  }

  /// The next body with what ties it to those before; false when all are there.
  bool make_next(World<S>& w) {
    if (bodies_.size() == parts_.size()) return false;
    const Part& part = parts_[bodies_.size()];
    bodies_.push_back(w.create(part.body));
    EXPECT_TRUE(bodies_.back()) << describe(w.fault());
    for (const Tie& tie : part.ties) {
      const BodyId other = tie.to < 0 ? BodyId{} : bodies_[static_cast<std::size_t>(tie.to + 1)];
      JointProperties<S> j = w.joint_at(tie.type, other, bodies_.back(), {place(tie.at), Quat<Unit<S>>::identity()});
      if (tie.type == JointType::distance) j.upper = num<S>(0.25);
      if (tie.driven) {
        j.flags = joint_flag::kMotor;
        j.motor_speed = S(1);
        j.max_force = num<S>(4);
      }
      EXPECT_TRUE(w.create(j)) << describe(w.fault());
    }
    return true;
  }

  /// Shoves, a newcomer, one that goes and one in its place; a shove wakes what slept.
  void play(World<S>& w, int frame) {
    const BodyId shoved = bodies_[bodies_.size() / 2];
    const auto shove = [&](D3 by) { w.apply_impulse(shoved, vec<S>(by) * w.mass(shoved)); };
    if (frame == 10 + kind_) shove({0.5, 0.25, 0.125});
    if (frame == 25 + kind_ % 3) bodies_.push_back(w.create(newcomer(2.5)));
    if (frame == 45 + kind_ % 2) {
      w.destroy(bodies_.back());
      bodies_.back() = w.create(newcomer(3));
    }
    if (frame == 85 + kind_) shove({-0.5, 1, 0.25});
    if (frame == 200 + kind_) shove({0.25, 1.5, -0.25});
  }

  /// Everything of its bodies but their slots.
  std::uint64_t hash(const World<S>& w) const {
    HashCombiner all;
    for (const BodyId id : bodies_) {
      BodyState<S> state = *w.view(id).state;
      state.slot = 0;
      all.add(hash_records(&state, 1));
      all.add(w.is_awake(id) ? 1 : 0);
    }
    return all.value();
  }
  /// All of it is where nothing of another can be.
  bool keeps_apart(const World<S>& w) const {
    return std::all_of(bodies_.begin(), bodies_.end(), [&](BodyId id) {
      const D3 from = real(w.center_of_mass(id)) - at_;
      return std::fabs(from.x) < kReach && std::fabs(from.z) < kReach;
    });
  }

 private:
  struct Tie {
    JointType type;
    int to;  // of the bodies after the pen, below 0: the world
    D3 at;
    bool driven = false;
  };
  struct Part {
    BodyDefinition<S> body;
    std::vector<Tie> ties;
  };

  Vec3<S> place(D3 p) const { return vec<S>(at_ + p); }
  ShapeId any_shape(int i) const {
    const ShapeId all[] = {shapes_.box, shapes_.ball, shapes_.capsule, shapes_.hammer};
    return all[i % 4];
  }
  BodyDefinition<S>& add(ShapeId shape, D3 p, std::vector<Tie> ties = {}) {
    parts_.push_back({moving<S>(shape, at_ + p), std::move(ties)});
    return parts_.back().body;
  }
  void bouncy(ShapeId shape, D3 p) {
    BodyDefinition<S>& d = add(shape, p);
    d.material.restitution = num<S>(0.5);
    d.material.rolling_resistance = num<S>(0.0625);
  }
  BodyDefinition<S> newcomer(double height) const {
    const bool hangs = kind_ == chain || kind_ == loop;
    return moving<S>(shapes_.box, at_ + D3{hangs ? 2 : 0.25, hangs ? 0.5 : height, hangs ? 2 : 0.125});
  }

  void make_chain() {
    const JointType kinds[] = {JointType::ball,     JointType::hinge, JointType::fixed,
                               JointType::distance, JointType::ball,  JointType::hinge};
    for (int i = 0; i < 6; ++i) {
      const double y = 5 - 0.75 * i;
      add(i % 2 == 0 ? shapes_.ball : shapes_.box, {0.25 * i, y, 0}, {{kinds[i], i - 1, {0.25 * i, y + 0.375, 0}}});
    }
  }
  void make_ragdoll() {
    add(shapes_.capsule, {0, 2, 0});
    const D3 sides[] = {{0.5, 0.25, 0}, {-0.5, 0.25, 0}, {0, 0.75, 0}, {0.25, -0.625, 0}, {-0.25, -0.625, 0}};
    for (const D3 side : sides)
      add(shapes_.capsule, D3{0, 2, 0} + side, {{JointType::ball, 0, D3{0, 2, 0} + side * 0.5}});
    add(shapes_.capsule, {0.5, 2.75, 0}, {{JointType::hinge, 1, {0.5, 2.5, 0}}});
  }
  void make_loop() {
    add(shapes_.plank, {0, 4, 0}, {{JointType::hinge, -1, {-1, 4, 0}, true}});
    add(shapes_.plank, {2, 4, 0}, {{JointType::hinge, 0, {1, 4, 0}}});
    add(shapes_.plank, {2, 3.5, 1}, {{JointType::ball, 1, {3, 3.75, 0.5}}});
    add(shapes_.plank, {0, 3.5, 1}, {{JointType::ball, 2, {1, 3.5, 1}}, {JointType::ball, 0, {-0.5, 3.75, 0.5}}});
  }
  void make_paddle() {
    BodyDefinition<S>& d = add(shapes_.plank, {0, 1, 0});
    d.type = BodyType::kinematic;
    d.angular_velocity = vec<S>(0, 1, 0.25);
    for (int i = 0; i < 3; ++i) bouncy(shapes_.ball, {0.25 * i - 0.25, 2 + 0.875 * i, 0});
  }
  void make_bridge() {
    for (int i = 0; i < 5; ++i) {
      std::vector<Tie> ties = {{JointType::ball, i - 1, {i - 2.5, 2, -0.25}},
                               {JointType::ball, i - 1, {i - 2.5, 2, 0.25}}};
      if (i == 4) ties.push_back({JointType::ball, -1, {2.5, 2, 0}});
      add(shapes_.box, {i - 2.0, 2, 0}, std::move(ties));
    }
    add(shapes_.box, {0.125, 3, 0});
  }
  void make_belt() {
    BodyDefinition<S>& d = add(shapes_.plank, {0, 0.125, 0});
    d.type = BodyType::static_;
    d.material.surface_velocity = vec<S>(0.25, 0, 0);
    for (int i = 0; i < 5; ++i) add(any_shape(i), {0.25 * (i % 2), 0.75 + 0.875 * i, 0});
  }

  Kind kind_;
  IslandShapes shapes_;
  D3 at_;
  std::vector<Part> parts_;
  std::vector<BodyId> bodies_;
};

}  // namespace isostep::test
