// A random mechanism thrown at 20 to 100 m/s, at the walls of a closed room or at another one: a function of its seed.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/world/joint_presets.hpp"
#include "random/dice.hpp"
#include "random/parts.hpp"

namespace isostep::test {

enum class ThrownKind { chain, ragdoll, tree, slider, geared, vehicle, flail, doors };
inline constexpr std::uint32_t kThrownKinds = 8;
enum class RoomKind { thin, thick, sheet, posts, none };
inline constexpr std::uint32_t kRoomKinds = 4;  // that have walls

/// Nothing in it drives: all that moves it is what it is thrown with, and gravity.
template <class S> class ThrownMechanism {
 public:
  static constexpr double kHalf = 3;  // [m] of the room

  /// Throws a mechanism into a room.
  ThrownMechanism(std::uint64_t seed, SolverName solver)
      : dice(seed * 2654435761u + 11), world(settings_of(solver, -10)) {
    room = static_cast<RoomKind>(dice.below(kRoomKinds));
    kind = static_cast<ThrownKind>(seed % kThrownKinds);
    add_room();
    add(kind, {0, 0, 0}, 1);
    if (dice.one_in(3)) add(ThrownKind::chain, {0, 2, 0}, 2);
    draw_throws();
  }
  /// Two at each other, in nothing, one of them of bullets.
  explicit ThrownMechanism(std::uint64_t seed)
      : dice(seed * 2654435761u + 13), world(settings_of(SolverName::soft_step, 0)) {
    room = RoomKind::none;
    kind = static_cast<ThrownKind>(seed % kFloating);
    bullets_ = true;
    add(kind, {-2, 0, 0}, 1);
    const std::size_t first = bodies.size();
    bullets_ = false;
    add(static_cast<ThrownKind>(dice.below(kFloating)), {2, 0, 0}, 2);
    speed = dice.in(20, 100);
    for (std::size_t i = 0; i < bodies.size(); ++i)
      world.set_velocity(bodies[i], vec<S>(i < first ? speed / 2 : -speed / 2, 0, 0), vec<S>(0, 0, 0));
  }

  Dice dice;
  World<S> world;
  std::vector<BodyId> bodies;  // that move
  std::vector<JointId> joints;
  RoomKind room;
  ThrownKind kind;
  double wall = 0;   // [m] half of the walls' thickness; 0: a surface
  double speed = 0;  // [m/s]

 private:
  static constexpr std::uint32_t kFloating = 7;  // kinds, from the first: that hang on nothing

  static Settings<S> settings_of(SolverName solver, double gravity) {
    Settings<S> s = settings<S>(gravity);
    s.solver = solver;
    return s;
  }

  // ---- the room

  void add_room() {
    wall = room == RoomKind::thick ? 0.5 : room == RoomKind::sheet ? 0.0 : dice.magnitude(0.01, 0.1);
    friction_ = dice.in(0, 1);
    if (room == RoomKind::sheet) return add_sheet();
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        D3 half = D3{1, 1, 1} * (kHalf + 2 * wall), at = {0, 0, 0};
        half[axis] = wall;
        at[axis] = side * (kHalf + wall);
        fix(add_box(world, half.x, half.y, half.z), at);
      }
    }
    if (room != RoomKind::posts) return;
    const ShapeId post = add_box(world, 0.05, kHalf, 0.05);
    for (const int side : {-1, 1}) fix(post, {1.75 * side, 0, 1.5});
  }
  void fix(ShapeId shape, D3 at) {
    BodyDefinition<S> d = still<S>(shape, at);
    d.material.friction = num<S>(friction_);
    world.create(d);
  }
  /// Each side of four squares of two triangles, whose outward side is within the room.
  void add_sheet() {
    constexpr int kSquares = 2;
    std::vector<D3> points;
    std::vector<MeshTriangle> triangles;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        const auto first = static_cast<std::uint32_t>(points.size());
        for (int i = 0; i <= kSquares; ++i) {
          for (int k = 0; k <= kSquares; ++k) {
            D3 p = {0, 0, 0};
            p[axis] = side * kHalf;
            p[(axis + 1) % 3] = (2.0 * i / kSquares - 1) * kHalf;
            p[(axis + 2) % 3] = (2.0 * k / kSquares - 1) * kHalf;
            points.push_back(p);
          }
        }
        for (std::uint32_t i = 0; i < kSquares; ++i) {
          for (std::uint32_t k = 0; k < kSquares; ++k) {
            const std::uint32_t a = first + i * (kSquares + 1) + k, b = a + kSquares + 1;
            if (side < 0) triangles.insert(triangles.end(), {{{a, b, a + 1}}, {{b, b + 1, a + 1}}});
            else triangles.insert(triangles.end(), {{{a, a + 1, b}}, {{b, a + 1, b + 1}}});
          }
        }
      }
    }
    const BlobRef blob = mesh_blob(points, triangles).value();
    const Child<S> part = {primitive_of(Mesh<S>{1}), Pose<S>::identity()};
    fix(world.add_shape(std::span<const Child<S>>(&part, 1), std::span<const BlobRef>(&blob, 1)), {0, 0, 0});
  }

  // ---- mechanisms; parts of one have no contacts with each other

  std::size_t add_part(ShapeId shape, D3 at, double mass, std::uint32_t group,
                       const Quat<Unit<S>>& orientation = Quat<Unit<S>>::identity()) {
    BodyDefinition<S> d = moving<S>(shape, at);
    d.orientation = orientation;
    d.mass = num<S>(mass);
    d.material.friction = num<S>(friction_);
    d.filter.group = group;
    d.bullet = bullets_;
    bodies.push_back(world.create(d));
    return bodies.size() - 1;
  }
  /// z of the joint lies along `axis`.
  JointProperties<S> at(JointType type, std::size_t a, std::size_t b, D3 place, D3 axis = {0, 0, 1}) {
    const double angle = axis.z > 0.5 ? 0 : kPi / 2;
    const D3 about = axis.x > 0.5 ? D3{0, 1, 0} : D3{-1, 0, 0};
    return world.joint_at(type, bodies[a], bodies[b], {vec<S>(place), turn<S>(about, angle)});
  }
  void join(const JointProperties<S>& p) { joints.push_back(world.create(p)); }
  static void limit(JointProperties<S>& p, double lower, double upper, double cone = 0) {
    p.flags |= joint_flag::kLimit | (cone > 0 ? joint_flag::kCone : 0u);
    p.lower = num<S>(lower);
    p.upper = num<S>(upper);
    p.cone = num<S>(cone);
  }

  void add(ThrownKind what, D3 from, std::uint32_t group) {
    switch (what) {
      case ThrownKind::chain: return add_chain(from, group, 1);
      case ThrownKind::flail: return add_chain(from, group, dice.magnitude(2, 20));
      case ThrownKind::ragdoll: return add_ragdoll(from, group);
      case ThrownKind::tree: return add_tree(from, group);
      case ThrownKind::slider: return add_slider(from, group);
      case ThrownKind::geared: return add_geared(from, group);
      case ThrownKind::vehicle: return add_vehicle(from, group);
      case ThrownKind::doors: return add_doors(from, group);
    }
  }
  /// Adds a chain of capsules along x, on balls or hinges; the last may be heavier.
  void add_chain(D3 from, std::uint32_t group, double heavier) {
    const std::uint32_t count = 3 + dice.below(6);
    const double radius = dice.magnitude(0.04, 0.1), half = dice.in(0.05, 0.15), pitch = 2 * (half + radius);
    const bool hinges = dice.one_in(2);
    const ShapeId link = world.add_shape(Capsule<S>{num<S>(radius), num<S>(half)});
    for (std::uint32_t i = 0; i < count; ++i) {
      const double x = from.x + pitch * (i - 0.5 * (count - 1));
      add_part(link, {x, from.y, from.z}, i + 1 == count ? heavier : 1, group, turn<S>({0, 0, 1}, kPi / 2));
      if (i == 0) continue;
      const JointType type = hinges && i % 2 == 0 ? JointType::hinge : JointType::ball;
      join(at(type, bodies.size() - 2, bodies.size() - 1, {x - pitch / 2, from.y, from.z}));
    }
  }
  /// A trunk, a head, arms and legs of two parts, with limits.
  void add_ragdoll(D3 o, std::uint32_t group) {
    const std::size_t hips = add_part(add_box(world, 0.15, 0.1, 0.1), o, 1, group);
    const std::size_t chest = add_part(add_box(world, 0.18, 0.22, 0.11), o + D3{0, 0.34, 0}, 2, group);
    const std::size_t head = add_part(add_ball(world, 0.12), o + D3{0, 0.7, 0}, 0.5, group);
    const ShapeId limb = world.add_shape(Capsule<S>{num<S>(0.06), num<S>(0.13)});
    const auto bound = [&](std::size_t a, std::size_t b, D3 place, D3 axis, double cone, double lower, double upper) {
      JointProperties<S> p = at(cone > 0 ? JointType::ball : JointType::hinge, a, b, place, axis);
      limit(p, lower, upper, cone);
      join(p);
    };
    bound(hips, chest, o + D3{0, 0.11, 0}, {0, 1, 0}, 0.5, -0.4, 0.4);
    bound(chest, head, o + D3{0, 0.57, 0}, {0, 1, 0}, 0.6, -0.7, 0.7);
    for (const double side : {-1.0, 1.0}) {
      for (const bool leg : {false, true}) {
        const double x = side * (leg ? 0.09 : 0.28), top = leg ? -0.11 : 0.5;
        const std::size_t upper = add_part(limb, o + D3{x, top - 0.21, 0}, leg ? 0.7 : 0.3, group);
        const std::size_t lower = add_part(limb, o + D3{x, top - 0.63, 0}, leg ? 0.4 : 0.2, group);
        bound(leg ? hips : chest, upper, o + D3{x, top, 0}, {0, 1, 0}, leg ? 0.9 : 1.3, -0.6, 0.6);
        bound(upper, lower, o + D3{x, top - 0.42, 0}, {1, 0, 0}, 0, leg ? 0 : -2.4, leg ? 2.4 : 0);
      }
    }
  }
  /// Each part off one before it, on a joint of any kind that holds a place.
  void add_tree(D3 from, std::uint32_t group) {
    constexpr JointType kTypes[] = {
        JointType::ball,    JointType::hinge, JointType::fixed, JointType::universal, JointType::constant_velocity,
        JointType::distance};
    const std::uint32_t count = 3 + dice.below(8);
    std::vector<D3> places;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t parent = i == 0 ? 0 : dice.below(i);
      const double x = dice.in(0.06, 0.2), y = dice.in(0.06, 0.2), z = dice.in(0.06, 0.2);
      const D3 way = dice.arrow(0.2, 0.5);
      places.push_back(i == 0 ? from : places[parent] + way);
      const ShapeId shape = dice.one_in(2) ? add_box(world, x, y, z) : add_ball(world, x);
      add_part(shape, places[i], dice.magnitude(0.5, 4), group);
      if (i == 0) continue;
      const std::size_t first = bodies.size() - 1 - i;
      JointProperties<S> p = at(kTypes[dice.below(6)], first + parent, first + i, (places[parent] + places[i]) * 0.5);
      draw_joint(world, dice, Drive::commands, p);
      p.flags &= ~joint_flag::kCollideConnected;
      join(p);
    }
  }
  /// Two boxes on a slider with limits, one of them with an arm.
  void add_slider(D3 from, std::uint32_t group) {
    const std::size_t a = add_part(add_box(world, 0.25, 0.1, 0.1), from, dice.magnitude(0.5, 4), group);
    const std::size_t b = add_part(add_box(world, 0.1, 0.08, 0.15), from + D3{0, 0.25, 0}, 1, group);
    const std::size_t c = add_part(add_ball(world, 0.1), from + D3{0, 0.6, 0}, 0.5, group);
    JointProperties<S> p = at(JointType::slider, a, b, from + D3{0, 0.2, 0}, {1, 0, 0});
    limit(p, -0.3, 0.3);
    join(p);
    join(at(JointType::hinge, b, c, from + D3{0, 0.35, 0}));
  }
  /// Two wheels on a plate, geared.
  void add_geared(D3 from, std::uint32_t group) {
    const std::size_t plate = add_part(add_box(world, 0.4, 0.15, 0.03), from, 2, group);
    const ShapeId wheel = world.add_shape(Cylinder<S>{num<S>(0.18), num<S>(0.04)});
    for (const double side : {-0.2, 0.2}) {
      const D3 place = from + D3{side, 0, 0.1};
      join(at(JointType::hinge, plate, add_part(wheel, place, 1, group, turn<S>({1, 0, 0}, kPi / 2)), place));
    }
    const JointId second = joints.back(), first = joints[joints.size() - 2];
    world.add(gears<S>(first, 20, second, 20));
  }
  /// A chassis on four sprung wheels.
  void add_vehicle(D3 from, std::uint32_t group) {
    const std::size_t chassis = add_part(add_box(world, 0.6, 0.15, 0.35), from, dice.magnitude(4, 40), group);
    const ShapeId ball = add_ball(world, 0.15);
    for (const double x : {-0.45, 0.45}) {
      for (const double z : {-0.4, 0.4}) {
        const D3 place = from + D3{x, -0.15, z};
        const std::size_t wheel_body = add_part(ball, place, 1, group);
        joints.push_back(world.create(wheel<S>({.a = bodies[chassis],
                                                .b = bodies[wheel_body],
                                                .frame = {vec<S>(place), Quat<Unit<S>>::identity()},
                                                .suspension = {.frequency = S(4), .damping = S(1), .target = S(0)},
                                                .travel = {num<S>(-0.1), num<S>(0.1)}})));
      }
    }
  }
  /// Two doors that hang on the world, and what flies into them.
  void add_doors(D3 from, std::uint32_t group) {
    for (const double x : {-0.8, 0.8}) {
      const std::size_t door =
          add_part(add_box(world, 0.4, 0.8, 0.03), from + D3{x, 0, 2}, dice.magnitude(1, 20), group);
      const D3 pin = from + D3{x * 1.5, 0, 2};
      JointProperties<S> p =
          world.joint_at(JointType::hinge, BodyId{}, bodies[door], {vec<S>(pin), turn<S>({-1, 0, 0}, kPi / 2)});
      limit(p, -2, 2);
      join(p);
    }
    hung_ = bodies.size();
    add_chain(from, group + 2, dice.magnitude(1, 10));
  }

  /// All of it alike, and turning about the origin; what hangs is left where it is.
  void draw_throws() {
    speed = dice.in(20, 100);
    const D3 way = dice.one_in(2) ? dice.direction() : dice.one_in(2) ? D3{0.7, 0, 0.7} : D3{0, 0, 1};
    const D3 spin = dice.one_in(2) ? dice.arrow(0, 10) : D3{0, 0, 0};
    for (std::size_t i = hung_; i < bodies.size(); ++i) {
      const D3 velocity = way * speed + cross(spin, real(world.center_of_mass(bodies[i])));
      world.set_velocity(bodies[i], vec<S>(velocity), vec<S>(spin));
    }
  }

  double friction_ = 0;
  bool bullets_ = false;
  std::size_t hung_ = 0;  // bodies, from the first
};

}  // namespace isostep::test
