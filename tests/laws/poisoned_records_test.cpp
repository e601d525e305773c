// A force beyond every number: bodies stop, and nothing that the step writes beside them is left without a number.
// SPDX-License-Identifier: MIT

#include <limits>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace poisoned_records_test {

/// Counts the numbers that are not finite of a record, its input or state, or an event.
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
template <class Record> int not_finite(const std::vector<Record>& all) {
  int count = 0;
  for (const Record& record : all) count += not_finite(record);
  return count;
}
template <class Record, class IdType> int not_finite(const Registry<Record, IdType>& registry) {
  return not_finite(registry.all());
}

/// A raft on the ground, of which an air flow makes what is no number; what touches it, hangs on it, drives and walks.
template <class S> class PoisonedRecords : public ::testing::Test {
 protected:
  /// Builds with an air flow of so much [1] of the largest number.
  void build(double part, JointType type) {
    const ShapeId box = add_box(world, 0.5, 0.25, 0.5);
    ground = add_ground(world);
    raft = create(box, {0, 0.25, 0}, {1, 0.5, 0.25});
    const BodyId hanging = create(box, {2, 1, 0}), car = create(box, {0, 1.2, 0});
    JointLoad<S> load;
    load.joint = world.create(world.joint_at(type, raft, hanging, {vec<S>(1, 0.6, 0), Quat<Unit<S>>::identity()}));
    world.add(load);
    for (const double x : {-0.4, 0.4}) {
      WheelSettings<S> wheel;
      wheel.body = car;
      wheel.hard_point = vec<S>(x, 0, 0);
      wheel.stiffness = S(200), wheel.damping = S(20), wheel.drive_share = S(1);
      ASSERT_TRUE(world.add(wheel));
    }
    VehicleSettings<S> vehicle;
    vehicle.body = car;
    vehicle.engine_torque = S(10), vehicle.engine_inertia = S(1), vehicle.clutch_torque = S(10);
    ASSERT_TRUE(world.set_input(world.add(vehicle), {.throttle = S(1)}));
    Breakable<S> breakable;
    breakable.body = raft;
    breakable.depth = 1;
    ASSERT_TRUE(world.add(breakable));
    BodyDefinition<S> d = moving<S>(world.add_shape(Capsule<S>{num<S>(0.3), num<S>(0.5)}), {0.2, 1.5, 0.3});
    d.type = BodyType::kinematic;
    CharacterSettings<S> walker;
    walker.body = world.create(d);
    ASSERT_TRUE(world.set_input(world.add(walker), {vec<S>(1, 0, 0)}));
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
    const WorldState<S>& state = world.state();
    RecordStore<S>::members_of(
        state.records->kinds(), [&](const char*, const auto& list) { count += not_finite(list); }, *state.records,
        state.parts);
    return count;
  }

  World<S> world{settings<S>()};
  BodyId ground, raft;
};
TYPED_TEST_SUITE(PoisonedRecords, IeeeScalars);

/// States of joint loads and wheels had NaN, whose sign bit differed from one SIMD width to another, and so did hashes.
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

}  // namespace poisoned_records_test
}  // namespace isostep::test
