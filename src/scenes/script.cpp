// The scripts: S9's exchange of bodies, the many commands of `mixed` and the few of `medley`, and one hit.
// SPDX-License-Identifier: MIT
#include "script.hpp"

#include "book/book.hpp"
#include "build.hpp"
#include "cars.hpp"
#include "isostep/fracture/breaking.hpp"
#include "isostep/store/state.hpp"
#include "medley.hpp"
#include "mixed.hpp"
#include "named.hpp"
#include "peers/peers.hpp"
#include "shapes.hpp"
#include "street.hpp"
#include "walkers.hpp"

namespace isostep::scenes {
namespace {

constexpr char kPlace[] = "script";
constexpr std::uint32_t kMostBroken = 4;  // a frame: 60 frames a second with room to spare

template <class S> S scalar(double value) { return value_of<S>(value, kPlace); }
template <class S> Vec3<S> vector(double x, double y, double z) {
  const S sx = scalar<S>(x), sy = scalar<S>(y);
  return {sx, sy, scalar<S>(z)};
}

/// Destroys the body, and its shape unless another body has it too.
template <class S> void destroy_with_shape(World<S>& world, BodyId body) {
  const auto find = [&](const BodySet<S>& set, std::uint32_t& shape) {
    for (std::size_t i = 0; i < set.states.size(); ++i) {
      if (set.states[i].slot == body.slot) shape = set.properties[i].shape;
    }
  };
  std::uint32_t shape = 0;
  world.state().static_bodies.each([&](const BodyState<S>& state, const BodyProperties<S>& properties) {
    if (state.slot == body.slot) shape = properties.shape;
  });
  find(world.state().awake, shape);
  for (const auto& island : world.state().sleeping) find(island->bodies, shape);
  const ShapeId id = world.state().shape_slots.template id_of<ShapeId>(shape);
  world.destroy(body);
  world.remove_shape(id);
}

template <class S> std::vector<BodyId> dynamic_bodies(const World<S>& world) {
  std::vector<BodyId> bodies;
  for (const BodyId body : world.bodies()) {
    if (world.type(body) == BodyType::dynamic) bodies.push_back(body);
  }
  return bodies;
}
template <class S> BodyId oldest(const World<S>& world, const std::vector<BodyId>& bodies) {
  BodyId first = bodies.front();
  for (const BodyId body : bodies) {
    if (world.user_data(body) < world.user_data(first)) first = body;
  }
  return first;
}

/// Replaces from frame 4 on, every 4th frame, the oldest body by a new one in the drum's middle; the last second of the
/// run is without births, so that its end shows how bodies lie and not how the newest one began.
template <class S> void stir(World<S>& world) {
  constexpr int kFirstNew = 600;
  if (world.tick() < 4 || world.tick() >= kMixerBirthsEnd || world.tick() % 4 != 0) return;
  const int n = kFirstNew + static_cast<int>(world.tick() / 4) - 1;
  const std::vector<BodyId> bodies = dynamic_bodies(world);
  if (!bodies.empty()) destroy_with_shape(world, oldest(world, bodies));
  add_body(world, mixer_body(n), static_cast<std::uint64_t>(n) + 2, kPlace);  // the drum is the first body
}

/// The commands of one frame of `mixed`.
template <class S> class Mixing {
 public:
  explicit Mixing(World<S>& world)
      : world_(world), frame_(world.tick()), draws_(static_cast<std::uint32_t>(frame_) * 2654435761u + 99u) {
    for (int i = 0; i < 3; ++i) draws_.next();
  }

  void run() {
    if (!is_lively(frame_)) return;
    if (frame_ % 6 == 3) add_body(world_, mixed_body(draws_), 100000 + frame_, kPlace);
    if (frame_ % 9 == 7) destroy_with_shape(world_, any_body());
    if (frame_ % 7 == 1) push();
    if (frame_ % 12 == 5) tie();
    if (frame_ % 17 == 11) untie();
    if (frame_ % 21 == 13) change();
    if (frame_ % 40 == 20) world_.set_gravity(vector<S>(1, -9.5, 0.5));
    if (frame_ % 40 == 35) world_.set_gravity(vector<S>(0, -10, 0));
  }

 private:
  std::size_t any(std::size_t count) { return draws_.next() % 4096 * count / 4096; }
  BodyId any_body() {
    const std::vector<BodyId> bodies = dynamic_bodies(world_);
    return bodies.empty() ? BodyId{} : bodies[any(bodies.size())];
  }

  void push() {
    const BodyId body = any_body();
    const double x = draws_.between(-1, 1), z = draws_.between(-1, 1);
    const S mass = world_.mass(body);
    world_.apply_impulse(body, vector<S>(x, 3, z) * mass, vector<S>(0, 0, 0));
    world_.apply_force_at(any_body(), vector<S>(2 * x, 4, 2 * z), vector<S>(x, 1, z));
  }
  /// A ball joint where two bodies touch.
  void tie() {
    const auto& contacts = world_.state().contacts;
    if (contacts.empty()) return;
    const ContactKey key = contacts[any(contacts.size())].key;
    const SlotMap& slots = world_.state().body_slots;
    const BodyId a = slots.id_of<BodyId>(key.body_a), b = slots.id_of<BodyId>(key.body_b);
    if (world_.type(a) != BodyType::dynamic || world_.type(b) != BodyType::dynamic) return;
    const Vec3<S> middle = (world_.center_of_mass(a) + world_.center_of_mass(b)) * scalar<S>(0.5);
    world_.create(world_.joint_at(JointType::ball, a, b, {middle, Quat<Unit<S>>::identity()}));
  }
  void untie() {
    const std::vector<JointId> joints = world_.joints();
    if (!joints.empty()) world_.destroy(joints[any(joints.size())]);
  }
  void change() {
    const BodyId body = any_body();
    Material<S> material;
    material.friction = scalar<S>(draws_.between(0, 1));
    material.restitution = scalar<S>(draws_.between(0, 0.5));
    world_.set_material(body, material);
    world_.set_filter(any_body(), Filter{1, 0xffffffffu, 7});
    world_.set_motion(any_body(), scalar<S>(0.5), scalar<S>(0.1), scalar<S>(0.2), body_flag::kLockAngularX);
    world_.set_pose(any_body(), {vector<S>(0.5, 5, -0.5), Quat<Unit<S>>::identity()});
    world_.set_velocity(any_body(), vector<S>(1, 2, -1), vector<S>(0, 3, 1));
    world_.wake(any_body());
    const std::vector<JointId> joints = world_.joints();
    if (joints.empty()) return;
    const JointId id = joints[any(joints.size())];
    JointProperties<S> joint = *world_.joint(id);
    joint.motor_speed = -joint.motor_speed;
    world_.set_joint(id, joint);
  }

  World<S>& world_;
  std::uint64_t frame_;
  Draws draws_;
};

/// Throws down the last body made, at tick 120, with 20 m/s.
template <class S> void hit(World<S>& world) {
  if (world.tick() != 120) return;
  BodyId last;
  for (const BodyId body : dynamic_bodies(world)) {
    if (!last || world.user_data(body) > world.user_data(last)) last = body;
  }
  world.set_velocity(last, vector<S>(0, -20, 0), vector<S>(0, 0, 0));
}

template <class S> BodyId numbered(const World<S>& world, std::uint64_t user_data) {
  for (const BodyId body : world.bodies()) {
    if (world.user_data(body) == user_data) return body;
  }
  return {};
}

/// One kind of command a tick, each on a body of its own.
template <class S> void play_medley(World<S>& world) {
  const auto heap = [&](int n) { return numbered(world, medley_body::kHeap + static_cast<std::uint64_t>(n)); };
  switch (world.tick()) {
    case 12: world.apply_impulse(heap(0), vector<S>(0.25, 1, 0), vector<S>(0, 0.125, 0)); break;
    case 20: world.apply_force_at(heap(1), vector<S>(2, 4, -2), vector<S>(0.5, 1, 0.25)); break;
    case 28: add_body(world, dumbbell({0.25, 3, -0.25}), medley_body::kGuest, kPlace); break;
    case 36: {
      const Vec3<S> middle = (world.center_of_mass(heap(2)) + world.center_of_mass(heap(3))) * scalar<S>(0.5);
      world.create(world.joint_at(JointType::ball, heap(2), heap(3), {middle, Quat<Unit<S>>::identity()}));
      break;
    }
    case 44: world.set_motion(heap(4), scalar<S>(0.5), scalar<S>(0.1), scalar<S>(0.2), body_flag::kLockAngularX); break;
    case 52: world.set_velocity(heap(5), vector<S>(1, 2, -1), vector<S>(0, 3, 1)); break;
    case 60: {
      JointProperties<S> motor = *world.joint(world.joints().front());
      motor.motor_speed = -motor.motor_speed;
      world.set_joint(world.joints().front(), motor);
      break;
    }
    case 68: destroy_with_shape(world, heap(6)); break;
    case 76: world.set_gravity(vector<S>(1, -9.5, 0.5)); break;
    case 84: world.set_gravity(vector<S>(0, -10, 0)); break;
    case 92: world.set_pose(heap(7), {vector<S>(0.5, 3, -0.5), Quat<Unit<S>>::identity()}); break;
    case 100: world.destroy(world.joints().back()); break;
    case 108: world.set_filter(heap(0), Filter{1, 0xffffffffu, 7}); break;
    case 116:
      world.set_material(heap(1), Material<S>{.friction = scalar<S>(0.125), .restitution = scalar<S>(0.5)});
      break;
    case 124: world.apply_impulse(numbered(world, medley_body::kStackTop), vector<S>(1, 0.5, 0)); break;  // asleep
    default: break;
  }
}

}  // namespace

template <class S> void before_step(Script script, World<S>& world) {
  if (!world.state().records->breakables.all().empty()) break_bodies(world, kMostBroken);
  if (script == Script::mixer) stir(world);
  if (script == Script::mixed) Mixing<S>(world).run();
  if (script == Script::hit) hit(world);
  if (script == Script::medley) play_medley(world);
  if (script == Script::flight) fly(world, Turn::right);
  if (script == Script::flight_left) fly(world, Turn::left);
  if (script == Script::sail) steer(world);
  if (script == Script::guns) shoot(world);
  if (script == Script::cars) drive_cars(world);
  if (script == Script::street) play_street(world);
  if (script == Script::walkers) lead_walkers(world);
  if (script == Script::pusher) push_junk(world);
  if (script == Script::crossers) lead_crossers(world);
}

#define ISO_INSTANTIATE(S) template void before_step<S>(Script, World<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
