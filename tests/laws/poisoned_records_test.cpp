// A force beyond every number: bodies stop, and nothing that the step writes beside them is left without a number.
// SPDX-License-Identifier: MIT

#include <limits>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace {

/// Of a record or an event.
struct NotFinite {
  int* count;
  template <class T> void operator()(const char*, const T& value) const {
    if constexpr (std::is_bounded_array_v<T>) {
      for (const auto& each : value) (*this)("", each);
    } else if constexpr (HasFields<T>) {
      T::fields(*this, value);
    } else if constexpr (Scalar<T>) {
      *count += is_finite(value) ? 0 : 1;
    }
  }
};
template <class Record> int not_finite(const Record& record) {
  int count = 0;
  Record::fields(NotFinite{&count}, record);
  return count;
}
template <class Event> int not_finite(const std::vector<Event>& events) {
  int count = 0;
  for (const Event& event : events) count += not_finite(event);
  return count;
}

/// A raft on the ground, of which an air flow makes what is no number; what touches it, hangs on it, drives and walks.
template <class S> class PoisonedRecords : public ::testing::Test {
 protected:
  /// [1] of the largest number.
  void build(double part, JointType type) {
    const ShapeId box = add_box(world, 0.5, 0.25, 0.5);
    ground = add_ground(world);
    raft = create(box, {0, 0.25, 0}, {1, 0.5, 0.25});
    const BodyId hanging = create(box, {2, 1, 0}), car = create(box, {0, 1.2, 0});
    JointLoad<S> load;
    load.joint = world.create(world.joint_at(type, raft, hanging, {vec<S>(1, 0.6, 0), Quat<Unit<S>>::identity()}));
    loads.push_back(world.add(load));
    for (const double x : {-0.4, 0.4}) {
      Wheel<S> wheel;
      wheel.body = car;
      wheel.hard_point = vec<S>(x, 0, 0);
      wheel.stiffness = S(200), wheel.damping = S(20), wheel.drive_share = S(1);
      wheels.push_back(world.add(wheel));
    }
    Vehicle<S> vehicle;
    vehicle.body = car;
    vehicle.engine_torque = S(10), vehicle.engine_inertia = S(1), vehicle.clutch_torque = S(10),
    vehicle.throttle = S(1);
    engine = world.add(vehicle);
    Breakable<S> breakable;
    breakable.body = raft;
    breakable.depth = 1;
    broken = world.add(breakable);
    BodyDefinition<S> d = moving<S>(world.add_shape(Capsule<S>{num<S>(0.3), num<S>(0.5)}), {0.2, 1.5, 0.3});
    d.type = BodyType::kinematic;
    Character<S> walker;
    walker.body = world.create(d);
    walker.move = vec<S>(1, 0, 0);
    character = world.add(walker);
    world.add(ContactReport<S>{raft});
    AeroSurface<S> flow;
    const S most = highest<S>() * num<S>(part);
    flow.body = raft;
    flow.point = vec<S>(0.1, 0.2, 0.3);
    flow.tensor.rows[0].y = -most;
    flow.tensor.rows[1].z = most;
    flow.is_quadratic = true;
    ASSERT_TRUE(world.add(flow)) << describe(world.fault());
  }
  BodyId create(ShapeId shape, D3 at, D3 velocity = {0, 0, 0}) {
    BodyDefinition<S> d = moving<S>(shape, at, velocity);
    d.angular_velocity = vec<S>(1, 2, 3);
    d.density = S(10);
    return world.create(d);
  }
  int left_without() const {
    const Events<S>& e = world.events();
    int count = not_finite(e.contact_begin) + not_finite(e.contacts) + not_finite(e.broke) + not_finite(e.joint_broke) +
                not_finite(e.hits);
    for (const JointLoadId id : loads) count += world.find(id) == nullptr ? 0 : not_finite(*world.find(id));
    for (const WheelId id : wheels) count += not_finite(*world.find(id));
    return count + not_finite(*world.find(engine)) + not_finite(*world.find(broken)) +
           not_finite(*world.find(character));
  }

  World<S> world{settings<S>()};
  BodyId ground, raft;
  std::vector<JointLoadId> loads;
  std::vector<WheelId> wheels;
  VehicleId engine;
  BreakableId broken;
  CharacterId character;
};
TYPED_TEST_SUITE(PoisonedRecords, IeeeScalars);

/// A JointLoad and a Wheel had NaN, whose sign bit differed from one SIMD width to another, and with it the hash.
TYPED_TEST(PoisonedRecords, have_numbers_whatever_a_step_meets) {
  using S = TypeParam;
  constexpr int kSteps = 6;
  std::uint32_t stopped = 0;
  for (const JointType type : {JointType::ball, JointType::hinge, JointType::fixed, JointType::distance}) {
    for (const double part : {1.0, 0.5, 0x1p-20, 0x1p-60}) {
      SCOPED_TRACE(testing::Message() << "joint " << static_cast<int>(type) << ", part " << part);
      std::uint64_t hashes[kSteps] = {};  // of any width
      for (const Simd simd : {Simd::scalar, Simd::sse2, Simd::avx2, Simd::avx512}) {
        this->world = World<S>(settings<S>());
        if (!this->world.use_simd(simd)) continue;
        this->loads.clear(), this->wheels.clear();
        this->build(part, type);
        for (std::uint64_t& hash : hashes) {
          stopped += this->world.step().stopped;
          ASSERT_EQ(this->left_without(), 0);
          if (hash == 0) hash = this->world.hash();
          ASSERT_EQ(this->world.hash(), hash) << this->world.simd_name();
          const std::vector<std::uint8_t> bytes = bytes_of(this->world);
          World<S> other(settings<S>());
          Reader reader(bytes);
          ASSERT_TRUE(other.read_portable(reader));
          ASSERT_EQ(other.hash(), hash);
        }
      }
    }
  }
  EXPECT_GT(stopped, 10u);
}

}  // namespace
}  // namespace isostep::test
