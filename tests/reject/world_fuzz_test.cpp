// Random commands at the edges of every range: whatever is accepted, a world reads what it writes, and what is refused
// changes nothing and says why.
// SPDX-License-Identifier: MIT
#include <string>

#include "isostep/core/random.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace world_fuzz_test {

/// Draws numbers that are mostly at, just inside or just outside a limit.
template <class S> class Edges {
 public:
  explicit Edges(std::uint64_t seed) : random_(Pcg32::seeded(seed)) {}

  std::uint32_t below(std::uint32_t bound) { return random_below(random_, bound); }
  S near(S limit) {
    const S parts[] = {S(0), S(1), limit * num<S>(0.5), limit * num<S>(0.99), limit, limit + num<S>(0.25)};
    const S size = parts[below(3) == 0 ? below(6) : below(3)];
    return below(2) == 0 ? size : -size;
  }
  Vec3<S> vector(S limit) { return {near(limit), near(limit), near(limit)}; }
  Quat<Unit<S>> orientation() {
    const D3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double angle = 0.4 * below(16);
    return turn<S>(axes[below(3)], angle);
  }
  template <class Id> Id one_of(const std::vector<Id>& ids) {
    return ids.empty() || below(20) == 0 ? Id{} : ids[below(static_cast<std::uint32_t>(ids.size()))];
  }

 private:
  Pcg32 random_;
};

template <class S> class WorldFuzz : public ::testing::Test {
 protected:
  explicit WorldFuzz() : world(settings<S>()), edges(1) {
    for (int i = 0; i < 6; ++i) add_shape();
  }
  void add_shape() {
    const S extent = Limits<S>::extent();
    const Child<S> child = {primitive_of(Sphere<S>{num<S>(0.5)}),
                            {edges.vector(extent * num<S>(0.5)), edges.orientation()}};
    const ShapeId id = world.add_shape(std::span<const Child<S>>(&child, 1));
    if (id) shapes.push_back(id);
  }
  bool create() {
    BodyDefinition<S> d = moving<S>(edges.one_of(shapes), {0, 0, 0});
    d.type = static_cast<BodyType>(edges.below(3));
    d.position = edges.vector(Limits<S>::position());
    d.orientation = edges.orientation();
    d.velocity = edges.vector(Limits<S>::speed());
    d.angular_velocity = edges.below(2) == 0 ? Vec3<S>::zero() : edges.vector(Limits<S>::angular_speed());
    d.mass = edges.below(3) == 0 ? edges.near(Limits<S>::mass() * num<S>(0.5)) : S(0);
    d.sensor = edges.below(5) == 0;
    const BodyId id = world.create(d);
    if (id) bodies.push_back(id);
    return static_cast<bool>(id);
  }
  bool join() {
    const Pose<S> frame = {edges.vector(S(4)), edges.orientation()};
    const BodyId b = edges.one_of(bodies), a = edges.one_of(bodies);
    JointProperties<S> j = world.joint_at(static_cast<JointType>(edges.below(4)), a, b, frame);
    j.flags = edges.below(32);
    j.lower = -edges.near(S(1));
    j.upper = edges.near(S(6));
    j.max_force = edges.near(Limits<S>::mass());
    j.spring_frequency = edges.near(S(240));
    return static_cast<bool>(world.create(j));
  }
  /// Mounts a body that is kinematic and a sensor, where there is one.
  bool mount() {
    BodyId sensor = edges.one_of(bodies);
    for (const BodyId id : world.bodies()) {
      const BodyView<S> view = world.view(id);
      const bool fits = view.properties->type == kinematic && (view.properties->flags & body_flag::kSensor) != 0;
      if (fits && edges.below(2) == 0) sensor = id;
    }
    const Pose<S> frame = {edges.vector(Limits<S>::extent()), edges.orientation()};
    const SensorMount<S> record = {sensor, edges.one_of(bodies), frame};
    return static_cast<bool>(world.add(record));
  }
  bool command() {
    const BodyId body = edges.one_of(bodies);
    switch (edges.below(13)) {
      case 12: return mount();
      case 0:
      case 10: return create();
      case 11: return world.wake(body);
      case 1: return world.destroy(body);
      case 2: return world.set_pose(body, {edges.vector(Limits<S>::position()), edges.orientation()});
      case 3: {
        const Vec3<S> spin = edges.vector(Limits<S>::angular_speed()), velocity = edges.vector(Limits<S>::speed());
        return world.set_velocity(body, velocity, spin);
      }
      case 4: {
        const Vec3<S> twist = edges.vector(Limits<S>::mass()), push = edges.vector(Limits<S>::mass());
        return world.apply_impulse(body, push, twist);
      }
      case 5: {
        const Vec3<S> torque = edges.vector(Limits<S>::mass()), force = edges.vector(Limits<S>::mass());
        return world.apply_force(body, force, torque);
      }
      case 6: {
        const Vec3<S> at = edges.vector(Limits<S>::position()), force = edges.vector(S(99));
        return world.apply_force_at(body, force, at);
      }
      case 7: return world.set_filter(body, {1, edges.below(2), 0});
      case 8: return world.set_gravity(edges.vector(Limits<S>::speed()));
      default: return join();
    }
  }

  World<S> world;
  Edges<S> edges;
  std::vector<ShapeId> shapes;
  std::vector<BodyId> bodies;
};
TYPED_TEST_SUITE(WorldFuzz, AllScalars);

TYPED_TEST(WorldFuzz, a_world_reads_what_it_writes_whatever_was_commanded) {
  using S = TypeParam;
  World<S>& w = this->world;
  int accepted = 0, refused = 0;
  for (int i = 0; i < 6000; ++i) {
    const std::uint64_t before = w.hash();
    const bool taken = this->command();
    ++(taken ? accepted : refused);
    ASSERT_EQ(taken, w.fault() == Fault::none) << describe(w.fault());
    if (!taken) {
      ASSERT_EQ(w.hash(), before) << describe(w.fault());
      ASSERT_STRNE(w.fault().command, "");
      ASSERT_STRNE(w.fault().field, "");
    }
    if (i % 7 == 0) w.step();
    if (i % 3 != 0) continue;
    const std::vector<std::uint8_t> bytes = bytes_of(w);
    World<S> read;
    Reader reader(bytes);
    const Result<void> result = read.read_portable(reader);
    ASSERT_TRUE(result) << "command " << i << ": " << (result ? "" : result.error().message.view());
    ASSERT_EQ(read.hash(), w.hash());
  }
  EXPECT_GT(accepted, 500);
  EXPECT_GT(refused, 500);
}

}  // namespace world_fuzz_test
}  // namespace isostep::test
