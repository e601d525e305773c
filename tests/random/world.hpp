// A random world of everything at once, and random commands for it: functions of a seed, the state and the frame alone.
// Worlds of every kind of shape, body and joint (random/parts.hpp) hang, lie, fall, drive, ride and are struck.
// SPDX-License-Identifier: MIT
#pragma once

#include "random/changes.hpp"
#include "random/energy_book.hpp"
#include "random/parts.hpp"
#include "random/placing.hpp"
#include "random/terrain.hpp"

namespace isostep::test {

template <class S> Settings<S> random_settings(std::uint64_t seed, SolverName solver) {
  Dice dice(seed * 31 + 5);
  constexpr int kRates[] = {60, 60, 120}, kSubsteps[] = {4, 8, 16};
  const std::int32_t substeps = kSubsteps[dice.below(3)], rate = kRates[dice.below(3)];
  Settings<S> s = settings<S>(-10, rate, substeps);
  s.allow_sleep = !dice.one_in(4);
  s.solver = solver;
  // It is drawn by dice of its own: what else is drawn is as it was before there was this.
  if (solver == SolverName::worst_first)
    s.projection = static_cast<Projection>(Dice(seed * 179424673 + 11).below(kProjections));
  Dice own(seed * 17 + 3);
  if (own.one_in(3)) s.restitution_threshold = num<S>(own.in(0.0625, 1));
  return s;
}

template <class S> class RandomWorld {
 public:
  static constexpr double kMoverSpeed = RandomChanges<S>::kMoverSpeed;
  static constexpr double kThrow = 4;       // [m/s] most that a command adds to a body's speed
  static constexpr double kFastThrow = 40;  // [m/s] in one world of eight: what is thrown moves by more than its size
  static constexpr double kTop = kPlaceTop;

  RandomWorld(std::uint64_t seed, SolverName solver) : world(random_settings<S>(seed, solver)), seed_(seed) {
    Dice dice(seed * 1000003 + 71);
    book.before_commands(world);
    add_ground_and_walls(dice);
    if (drive_of(seed) == Drive::movers) add_movers(dice);
    const int mechanisms = 1 + static_cast<int>(dice.below(4)), loose = 4 + static_cast<int>(dice.below(12));
    for (int i = 0; i < mechanisms; ++i) add_mechanism(dice, static_cast<std::uint32_t>(i + 1));
    for (int i = 0; i < loose; ++i) add_loose(world, dice, most_throw(seed));
    book.after_commands(world);
  }

  static double most_throw(std::uint64_t seed) { return seed % 8 == 5 ? kFastThrow : kThrow; }

  /// Commands of a frame, and its step; the book is kept.
  StepReport play(std::uint64_t frame) {
    std::vector<AppliedForce> forces;
    book.before_commands(world);
    command(world, seed_, frame, &forces);
    book.after_commands(world);
    book.before_step(world, std::move(forces));
    const StepReport report = world.step();
    book.after_step(world);
    return report;
  }

  /// Gives commands to worlds that are saved and loaded, where no book is kept: a function of the state, the seed and
  /// the frame alone.
  static void command(World<S>& w, std::uint64_t seed, std::uint64_t frame,
                      std::vector<AppliedForce>* forces = nullptr) {
    RandomChanges<S>::change(w, seed, frame);
    Dice dice(seed * 7919 + frame * 1000003 + 17);
    turn_movers(w, dice);
    if (!dice.one_in(6)) return;
    const std::vector<BodyId> bodies = w.bodies();
    const BodyId b = dice.one_of(bodies);
    const bool moves = w.type(b) == BodyType::dynamic;
    switch (dice.below(10)) {
      case 0:
      case 1: add_loose(w, dice, most_throw(seed)); break;
      case 2:
        if (moves && bodies.size() > 12) w.destroy(b);
        break;
      case 3: w.apply_impulse(b, vec<S>(dice.arrow_of(dice.in(0, kThrow) * to_double(w.mass(b))))); break;
      case 4: {
        const double weight = 10 * to_double(w.mass(b));
        const AppliedForce f = {b, dice.point(2 * weight), dice.point(0.125 * weight)};
        if (w.apply_force(b, vec<S>(f.force), vec<S>(f.torque)) && forces != nullptr) forces->push_back(f);
        break;
      }
      case 5: {
        Material<S> material;
        material.friction = num<S>(dice.in(0, 1));
        draw_surface(frame * 31 + seed, material);
        if (moves) w.set_material(b, material);
        break;
      }
      case 6: {
        if (!moves) break;
        const S angular_damping = num<S>(dice.in(0, 0.25)), gravity_scale = num<S>(dice.in(0.5, 1));
        w.set_motion(b, gravity_scale, S(0), angular_damping, 0);
        break;
      }
      case 7: {
        const std::vector<JointId> joints = w.joints();
        if (joints.size() > 2) w.destroy(dice.one_of(joints));
        break;
      }
      case 8: {
        const std::vector<JointId> joints = w.joints();
        if (joints.empty()) break;
        const JointId id = dice.one_of(joints);
        JointProperties<S> p = *w.joint(id);
        p.motor_speed = num<S>(dice.in(-5, 5));
        p.user_data = frame;
        w.set_joint(id, p);
        break;
      }
      default: w.wake(b);
    }
  }

  World<S> world;
  EnergyBook<S> book;
  std::uint32_t joints_made = 0, refused = 0;

 private:
  void add_ground_and_walls(Dice& dice) {
    const double friction = dice.in(0, 1);
    if (seed_ % 3 == 0) add_terrain(world, seed_, friction);
    else add_ground(world, friction);
    const std::uint32_t walls = dice.below(4);
    for (std::uint32_t i = 0; i < walls; ++i) {
      const DrawnShape shape = draw_shape(world, dice);
      BodyDefinition<S> d = draw_body<S>(dice, dice.one_in(2) ? add_box(world, 1.5, 0.25, 1) : shape.shape);
      d.type = BodyType::static_;
      d.position = vec<S>(dice.point(4) + D3{0, 1, 0});
      d.mass = S(0);
      d.locks = 0;
      d.sensor = dice.one_in(4);
      world.create(d);
    }
  }
  /// A belt, a paddle above the ground, a lift: the paddle's tips and the lift keep to the speed.
  void add_movers(Dice& dice) {
    BodyDefinition<S> d = still<S>(add_box(world, 2, 0.25, 1), {5, 0.25, 0});
    d.material.surface_velocity = vec<S>(dice.arrow(0, kMoverSpeed));
    world.create(d);
    d = still<S>(add_box(world, 1.25, 0.125, 0.25), {-3, 1.5, 0});
    d.type = BodyType::kinematic;
    d.angular_velocity = vec<S>(0, dice.in(-1.5, 1.5), 0);
    world.create(d);
    d = still<S>(add_box(world, 1, 0.125, 1), {0, 3, 4});
    d.type = BodyType::kinematic;
    d.user_data = kLift;
    world.create(d);
  }
  /// The lift goes up and down between 2 and 4 m: what is below it has room.
  static void turn_movers(World<S>& w, Dice& dice) {
    for (const BodyId id : w.bodies()) {
      if (w.type(id) != BodyType::kinematic || w.user_data(id) != kLift) continue;
      const double y = to_double(w.center_of_mass(id).y), v = to_double(w.velocity(id).y);
      if (v != 0 && (y > 2 || v > 0) && (y < 4 || v < 0)) continue;
      const double next = (y < 3 ? 1 : -1) * dice.in(0.25, 1);
      w.set_velocity(id, vec<S>(0, next, 0), Vec3<S>::zero());
    }
  }

  /// A tree of bodies, at times with a loop; hung from the world or from a body, or loose. Its bodies pass each other.
  void add_mechanism(Dice& dice, std::uint32_t group) {
    std::vector<BodyId> bodies;
    std::vector<JointId> joints;
    D3 at = {dice.in(-4, 4), dice.in(2, 6), dice.in(-4, 4)};
    const std::uint32_t hold = dice.below(4), count = 1 + dice.below(5);
    if (hold == 1) bodies.push_back(add_hold(dice, at));
    for (std::uint32_t i = 0; i < count; ++i) {
      const DrawnShape shape = draw_shape(world, dice);
      BodyDefinition<S> d = draw_body<S>(dice, shape.shape);
      if (hold == 1) d.locks = 0;  // a mover pulls whatever holds against it
      BodyId to;
      if (!bodies.empty()) to = dice.one_of(bodies);
      const D3 from = to ? real(world.center_of_mass(to)) : at, step = dice.arrow_of(dice.magnitude(0.25, 2));
      const BodyId b = place_freely(world, dice, d, shape.reach, from + step, from + step, group);
      if (!b) continue;
      bodies.push_back(b);
      if (to || hold != 0) join(dice, to, b, joints);
    }
    if (bodies.size() > 2 && dice.one_in(4)) join(dice, bodies.front(), bodies.back(), joints);
    for (const JointId id : joints) book_spring(*world.joint(id), bodies);
  }
  BodyId add_hold(Dice& dice, D3 at) {
    BodyDefinition<S> d = draw_body<S>(dice, add_ball(world, 0.2));
    d.type = drive_of(seed_) == Drive::movers ? BodyType::kinematic : BodyType::static_;
    d.position = vec<S>(at);
    d.collide = false;
    d.locks = 0;
    if (d.type == BodyType::kinematic) d.angular_velocity = vec<S>(dice.point(0.5));
    return world.create(d);
  }
  void join(Dice& dice, BodyId a, BodyId b, std::vector<JointId>& joints) {
    auto type = static_cast<JointType>(dice.below(static_cast<std::uint32_t>(JointType::six_axis)));
    Dice own = dice;  // what is drawn after it is as it was before there were six axes
    if (type != JointType::distance && own.one_in(4)) type = JointType::six_axis;
    const D3 end = real(world.center_of_mass(b)),
             start = a ? real(world.center_of_mass(a)) : end + dice.arrow_of(dice.magnitude(0.25, 2));
    JointProperties<S> p =
        world.joint_at(type, a, b, {vec<S>(start + (end - start) * dice.in(0, 0.75)), dice.orientation<S>()});
    draw_joint(world, dice, drive_of(seed_), p);
    const JointId id = world.create(p);
    if (!id) {
      ++refused;
      return;
    }
    ++joints_made;
    joints.push_back(id);
    if (type == JointType::six_axis) draw_axis_drives(world, own, drive_of(seed_), id);
  }
  /// Books a spring between whatever parts: all of the mechanism together is never easier to move.
  void book_spring(const JointProperties<S>& p, const std::vector<BodyId>& bodies) {
    if ((p.flags & joint_flag::kSpring) == 0) return;
    const JointAngles now = angles_of(world, p);
    const bool turns = measure_of(p.type) == JointMeasure::angle, slides = !turns && p.type != JointType::distance;
    double inertia = 0;
    for (const BodyId id : bodies) {
      if (world.type(id) != BodyType::dynamic) continue;
      inertia += turns ? inertia_about(world.view(id), now.anchor, now.axis) : to_double(world.mass(id));
    }
    const double at = turns ? now.twist : slides ? now.along : now.apart;
    book.add_spring(p, at - to_double(p.spring_target), inertia);
  }

  static constexpr std::uint64_t kLift = 0x11f7;
  std::uint64_t seed_;
};

}  // namespace isostep::test
