// Faults of calls that make no sense: which call, which field, what the world expects. No harm comes of them.
// SPDX-License-Identifier: MIT
#include <limits>
#include <string>
#include <thread>
#include <utility>

#include "isostep/geometry/validate.hpp"
#include "unit/world/refusing_world.hpp"

namespace isostep::test {
namespace faults_test {

template <class S> class WorldFaults : public RefusingWorld<S> {};
TYPED_TEST_SUITE(WorldFaults, AllScalars);

TYPED_TEST(WorldFaults, a_dynamic_body_needs_a_density_or_a_mass_and_others_neither) {
  using S = TypeParam;
  BodyDefinition<S> d = moving<S>(this->ball, {0, 9, 0});
  d.density = S(0);
  EXPECT_FALSE(this->world.create(d));
  this->expect_fault(Fault::bad_mass, "create_body", "density", "above 0 where mass is 0");
  d.mass = S(3);
  const BodyId heavy = this->world.create(d);
  ASSERT_TRUE(heavy);
  EXPECT_EQ(this->world.mass(heavy), S(3));
  d = still<S>(this->ball, {0, 12, 0});
  d.density = S(0);
  EXPECT_TRUE(this->world.create(d));
}

TYPED_TEST(WorldFaults, what_a_body_weighs_is_checked_whatever_its_type) {
  using S = TypeParam;
  World<S>& w = this->world;
  for (const BodyType type : {BodyType::static_, BodyType::kinematic, BodyType::dynamic}) {
    const auto refused = [&](auto&& change, const char* field) {
      BodyDefinition<S> d = moving<S>(this->ball, {0, 9, 0});
      d.type = type;
      change(d);
      EXPECT_FALSE(w.create(d));
      this->expect_fault(Fault::bad_mass, "create_body", field);
    };
    refused([](auto& d) { d.mass = S(-1); }, "mass");
    refused([](auto& d) { d.density = S(-1); }, "density");
    refused([](auto& d) { d.inertia = vec<S>(1, -1, 1); }, "inertia");
    refused([](auto& d) { d.inertia = vec<S>(2, 0, 0); }, "inertia");
  }
  BodyMass<S> mass;
  mass.inertia = vec<S>(0, 2, 2);
  EXPECT_FALSE(w.set_mass(this->a, mass));
  this->expect_fault(Fault::bad_mass, "set_mass", "inertia",
                     "about each axis above 0, or 0 about all for that of the shape");
}

TYPED_TEST(WorldFaults, a_static_body_has_no_velocity) {
  using S = TypeParam;
  BodyDefinition<S> d = still<S>(this->ball, {0, 9, 0});
  d.velocity = vec<S>(0, 1, 0);
  EXPECT_FALSE(this->world.create(d));
  this->expect_fault(Fault::bad_argument, "create_body", "velocity", "0 of a static body");
  d.velocity = vec<S>(0, 0, 0);
  d.angular_velocity = vec<S>(0, 1, 0);
  EXPECT_FALSE(this->world.create(d));
  this->expect_fault(Fault::bad_argument, "create_body", "angular_velocity", "0 of a static body");
}

TYPED_TEST(WorldFaults, a_handler_is_told_of_each_refusal_and_of_nothing_else) {
  using S = TypeParam;
  World<S>& w = this->world;
  std::vector<std::string> told;
  w.set_fault_handler({[](void* user, const FaultReport& report) {
                         static_cast<std::vector<std::string>*>(user)->push_back(describe(report));
                       },
                       &told});
  w.apply_impulse(this->a, vec<S>(1, 0, 0));
  w.step();
  EXPECT_TRUE(told.empty());
  w.apply_impulse(this->ground, vec<S>(1, 0, 0));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0], describe(w.fault()));
  w.cast_ray(vec<S>(0, 5, 0), vec<S>(0, to_double(highest<S>()), 0));
  ASSERT_EQ(told.size(), 2u);
  EXPECT_NE(told[1].find("cast_ray"), std::string::npos) << told[1];
  w.destroy(this->b);
  w.destroy(this->b);
  EXPECT_EQ(told.size(), 3u);
  w.set_fault_handler({});
  w.destroy(this->b);
  EXPECT_EQ(told.size(), 3u);
}

TYPED_TEST(WorldFaults, what_a_handler_is_refused_itself_calls_no_handler_and_its_report_stays) {
  struct Meddler {
    World<TypeParam>* world;
    int calls = 0;
  } meddler{&this->world};
  this->world.set_fault_handler({[](void* user, const FaultReport& report) {
                                   Meddler& m = *static_cast<Meddler*>(user);
                                   ++m.calls;
                                   EXPECT_FALSE(m.world->destroy(m.world->bodies()[0]));
                                   EXPECT_EQ(m.world->fault(), Fault::called_in_step);
                                   m.world->forget_faults();
                                   EXPECT_EQ(report, Fault::null_id);
                                 },
                                 &meddler});
  for (int call = 1; call <= 2; ++call) {
    EXPECT_FALSE(this->world.destroy(BodyId{}));
    EXPECT_EQ(meddler.calls, call);
  }
  this->world.set_fault_handler({});
}

TYPED_TEST(WorldFaults, a_joint_takes_no_flag_that_its_kind_does_not_know) {
  using S = TypeParam;
  using namespace joint_flag;
  World<S>& w = this->world;
  const std::uint32_t known[4] = {kLimit | kCone, kLimit | kMotor | kSpring, 0, kLimit | kSpring};
  for (std::uint32_t type = 0; type < 4; ++type) {
    for (std::uint32_t bit = 0; bit < 32; ++bit) {
      SCOPED_TRACE(testing::Message() << "type " << type << " bit " << bit);
      JointProperties<S> j = w.joint_at(static_cast<JointType>(type), this->a, this->b, Pose<S>::identity());
      j.flags = 1u << bit;
      j.upper = S(1);
      j.spring_frequency = S(1);
      const JointId id = w.create(j);
      const bool knows = j.flags == kCollideConnected || (known[type] & j.flags) != 0;
      ASSERT_EQ(static_cast<bool>(id), knows);
      if (!knows) this->expect_fault(Fault::bad_argument, "create_joint", "flags");
      if (knows) w.destroy(id);
    }
  }
  JointProperties<S> j = w.joint_at(JointType::ball, this->a, this->b, Pose<S>::identity());
  const JointId id = w.create(j);
  j.flags = kMotor;
  EXPECT_FALSE(w.set_joint(id, j));
  EXPECT_EQ(describe(w.fault()),
            "set_joint: flags: not a valid value; expected of a ball joint kLimit, kCone, "
            "kCollideConnected");
}

TYPED_TEST(WorldFaults, ids_of_a_world_with_another_space_are_known_as_such) {
  using S = TypeParam;
  Settings<S> other_space = settings<S>();
  other_space.id_space = 5;
  World<S> other(other_space);
  const ShapeId shape = add_ball(other, 0.5);
  const BodyId body = other.create(moving<S>(shape, {0, 2, 0}));
  const JointId joint = other.create(other.joint_at(JointType::ball, {}, body, Pose<S>::identity()));
  ASSERT_TRUE(joint);
  World<S>& w = this->world;
  EXPECT_TRUE(other.contains(body));
  EXPECT_FALSE(w.contains(body));
  EXPECT_FALSE(w.contains(shape));
  EXPECT_FALSE(w.set_velocity(body, vec<S>(1, 0, 0), vec<S>(0, 0, 0)));
  this->expect_fault(Fault::foreign_id, "set_velocity", "body");
  EXPECT_FALSE(w.create(moving<S>(shape, {0, 2, 0})));
  this->expect_fault(Fault::foreign_id, "create_body", "shape");
  EXPECT_FALSE(w.destroy(joint));
  this->expect_fault(Fault::foreign_id, "destroy_joint", "joint");
  EXPECT_FALSE(w.create(w.joint_at(JointType::ball, this->a, body, Pose<S>::identity())));
  this->expect_fault(Fault::foreign_id, "create_joint", "body_b");
  EXPECT_FALSE(other.destroy(this->a));
  EXPECT_EQ(other.fault(), Fault::foreign_id);

  // The space stays when slots are used again, and is part of what is written.
  ASSERT_TRUE(other.destroy(body));
  const BodyId next = other.create(moving<S>(shape, {0, 2, 0}));
  EXPECT_EQ(next.slot, body.slot);
  EXPECT_FALSE(other.wake(body));
  EXPECT_EQ(other.fault(), Fault::stale_id);
  const std::vector<std::uint8_t> bytes = bytes_of(other);
  Reader reader(bytes);
  ASSERT_TRUE(w.read_portable(reader));
  EXPECT_TRUE(w.contains(next));
  EXPECT_EQ(w.settings().id_space, 5u);
}

TYPED_TEST(WorldFaults, queries_say_why_they_found_nothing) {
  using S = TypeParam;
  World<S>& w = this->world;
  const Vec3<S> far_off = {Limits<S>::position() + S(1), S(0), S(0)}, zero = Vec3<S>::zero();
  EXPECT_FALSE(w.cast_ray(far_off, zero));
  this->expect_fault(Fault::out_of_range, "cast_ray", "origin");
  EXPECT_FALSE(w.cast_ray(zero, far_off));
  this->expect_fault(Fault::out_of_range, "cast_ray", "translation");
  EXPECT_FALSE(w.closest_point(zero, S(-1)));
  this->expect_fault(Fault::bad_argument, "closest_point", "max_distance", "0 or more");
  std::vector<BodyId> found;
  w.overlap_shape(primitive_of(Sphere<S>{S(0)}), Pose<S>::identity(), found);
  EXPECT_EQ(w.fault(), Fault::bad_shape);
  w.forget_faults();
  EXPECT_TRUE(w.cast_ray(vec<S>(0, 8, 0), vec<S>(0, -16, 0)));
  EXPECT_EQ(w.fault(), Fault::none);
  w.overlap_aabb({vec<S>(1, 0, 0), vec<S>(0, 1, 1)}, found);
  this->expect_fault(Fault::bad_argument, "overlap_aabb", "box.low");
  if constexpr (!kIsFixed<S>) {
    const S nan = std::numeric_limits<S>::quiet_NaN();
    EXPECT_FALSE(w.cast_ray({S(0), nan, S(0)}, vec<S>(0, -1, 0)));
    this->expect_fault(Fault::not_finite, "cast_ray", "origin");
    EXPECT_FALSE(w.cast_ray(zero, {S(0), nan, S(0)}));
    this->expect_fault(Fault::not_finite, "cast_ray", "translation");
    EXPECT_FALSE(w.closest_point({nan, S(0), S(0)}, S(1)));
    this->expect_fault(Fault::not_finite, "closest_point", "point");
    EXPECT_FALSE(w.closest_point(zero, nan));
    this->expect_fault(Fault::not_finite, "closest_point", "max_distance");
    w.overlap_aabb({zero, {nan, S(0), S(0)}}, found);
    this->expect_fault(Fault::not_finite, "overlap_aabb", "box.high");
    w.overlap_shape(primitive_of(Sphere<S>{nan}), Pose<S>::identity(), found);
    EXPECT_EQ(w.fault(), Fault::not_finite);
  }
  EXPECT_TRUE(found.empty());
}

TYPED_TEST(WorldFaults, a_snapshot_of_other_settings_or_of_nothing_is_refused_and_gravity_is_no_other_setting) {
  using S = TypeParam;
  World<S>& w = this->world;
  typename World<S>::Snapshot saved, empty;
  const std::uint64_t before = w.hash();
  Settings<S> given[6] = {settings<S>(), settings<S>(), settings<S>(), settings<S>(), settings<S>(), settings<S>()};
  given[0].hz = 30;
  given[1].substeps = 4;
  given[2].allow_sleep = false;
  given[3].solver = SolverName::pgs;
  given[4].id_space = 1;
  given[5].projection = Projection::relaxed;
  for (const Settings<S>& its : given) {
    World<S>(its).save(saved);
    EXPECT_FALSE(w.load(saved));
    this->expect_fault(Fault::bad_snapshot, "load", "from", "one of a world with the same settings");
  }
  EXPECT_FALSE(w.load(empty));
  this->expect_fault(Fault::bad_snapshot, "load", "from", "one that was saved to");
  EXPECT_EQ(w.hash(), before);
  EXPECT_EQ(w.loads(), 0u);
  w.save(saved);
  ASSERT_TRUE(w.set_gravity(vec<S>(0, -3, 0)));
  EXPECT_TRUE(w.load(saved));
  EXPECT_EQ(w.hash(), before);
}

TYPED_TEST(WorldFaults, an_observer_of_stages_that_changes_the_world_is_refused) {
  using S = TypeParam;
  World<S>& w = this->world;
  World<S> twin(settings<S>());
  const std::vector<std::uint8_t> bytes = bytes_of(w);
  Reader reader(bytes);
  ASSERT_TRUE(twin.read_portable(reader));
  struct Meddler {
    World<S>* world;
    BodyId body;
    ShapeId shape;
    typename World<S>::Snapshot saved;
    int refused = 0, calls = 0;
    void count(bool done) {
      ++calls;
      refused += !done && world->fault() == Fault::called_in_step ? 1 : 0;
      world->forget_faults();
    }
  };
  Meddler meddler{&w, this->a, this->ball, {}};
  w.save(meddler.saved);
  w.destroy(this->b);
  twin.destroy(this->b);
  const StageObserver observer = {[](void* user, Stage, const StageView&) {
                                    Meddler& m = *static_cast<Meddler*>(user);
                                    World<S>& within = *m.world;
                                    m.count(within.apply_impulse(m.body, vec<S>(1, 0, 0)));
                                    m.count(within.destroy(m.body));
                                    m.count(within.destroy(std::span<const BodyId>(&m.body, 1)) > 0);
                                    m.count(static_cast<bool>(within.create(moving<S>(m.shape, {9, 9, 9}))));
                                    m.count(within.load(m.saved));
                                    m.count(within.use_simd(Simd::scalar));
                                    const std::uint64_t tick = within.tick();
                                    within.step();
                                    m.count(within.tick() != tick);
                                  },
                                  &meddler};
  for (int i = 0; i < 30; ++i) {
    w.step(observer);
    twin.step();
    ASSERT_EQ(w.hash(), twin.hash());
  }
  EXPECT_EQ(meddler.calls, 30 * 7 * static_cast<int>(kStages));
  EXPECT_EQ(meddler.refused, meddler.calls);
  EXPECT_TRUE(w.apply_impulse(this->a, vec<S>(1, 0, 0))) << "after the step it may";
}

#if defined(ISOSTEP_ASSERTS)
TYPED_TEST(WorldFaults, stepping_one_world_from_two_threads_ends_the_program) {
  using S = TypeParam;
  const auto step_in_another = [](void* user, Stage, const StageView&) {
    std::thread([user] { static_cast<World<S>*>(user)->step(); }).join();
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(this->world.step({step_in_another, &this->world}), "");
}
#endif

TYPED_TEST(WorldFaults, a_world_that_was_moved_from_is_empty_and_of_use) {
  using S = TypeParam;
  World<S>& w = this->world;
  const std::uint64_t before = w.hash();
  World<S> taken = std::move(w);
  EXPECT_EQ(taken.hash(), before);
  const auto expect_empty = [&] {
    EXPECT_EQ(w.counts().bodies, 0u);
    EXPECT_EQ(w.tick(), 0u);
    EXPECT_FALSE(w.contains(this->a));
    EXPECT_FALSE(w.wake(this->a));
    EXPECT_FALSE(w.cast_ray(vec<S>(0, 8, 0), vec<S>(0, -16, 0)));
    EXPECT_EQ(w.settings().hz, taken.settings().hz);
    EXPECT_EQ(w.hash(), World<S>(w.settings()).hash());
  };
  expect_empty();
  EXPECT_TRUE(w.create(moving<S>(add_ball(w, 1), {0, 1, 0})));
  EXPECT_TRUE(w.step().clean());
  w = std::move(taken);
  EXPECT_EQ(w.hash(), before);
  taken = std::move(w);
  expect_empty();
  World<S>& same = taken;
  taken = std::move(same);
  EXPECT_EQ(taken.hash(), before);
}

TYPED_TEST(WorldFaults, the_first_of_a_chain_of_refusals_is_kept) {
  using S = TypeParam;
  World<S>& w = this->world;
  const ShapeId none = w.add_shape(Sphere<S>{S(-1)});
  const BodyId nobody = w.create(moving<S>(none, {0, 1, 0}));
  EXPECT_FALSE(w.apply_impulse(nobody, vec<S>(0, 1, 0)));
  this->expect_fault(Fault::null_id, "apply_impulse", "body");
  EXPECT_EQ(w.first_fault(), Fault::bad_shape);
  EXPECT_STREQ(w.first_fault().command, "add_shape");
  EXPECT_STREQ(w.first_fault().field, "primitive.radius");
  EXPECT_TRUE(w.wake(this->a));
  EXPECT_EQ(w.fault(), Fault::none);
  EXPECT_EQ(w.first_fault(), Fault::bad_shape);
  w.forget_faults();
  EXPECT_EQ(w.first_fault(), Fault::none);
}

TYPED_TEST(WorldFaults, the_fault_of_a_constructor_outlives_the_commands_after_it) {
  using S = TypeParam;
  Settings<S> wild = settings<S>();
  wild.substeps = 65;
  wild.id_space = 300;
  World<S> w(wild);
  EXPECT_EQ(w.fault(), Fault::out_of_range);
  ASSERT_TRUE(add_ball(w, 1));
  EXPECT_EQ(w.fault(), Fault::none);
  EXPECT_EQ(describe(w.first_fault()),
            "World: substeps: a number is beyond the scalar's limits; expected 1 to 64, hz * substeps up to kMaxRate");
  EXPECT_EQ(w.settings().id_space, 255u);
}

TYPED_TEST(WorldFaults, each_field_has_a_text_of_its_own) {
  using S = TypeParam;
  World<S>& w = this->world;
  std::vector<std::string> texts;
  const auto refused = [&](auto&& change) {
    BodyDefinition<S> d = moving<S>(this->ball, {0, 9, 0});
    change(d);
    EXPECT_FALSE(w.create(d));
    const std::string text = describe(w.fault());
    for (const std::string& known : texts) EXPECT_NE(known, text);
    texts.push_back(text);
  };
  refused([](auto& d) { d.material.friction = S(-1); });
  refused([](auto& d) { d.material.restitution = S(2); });
  refused([](auto& d) { d.material.rolling_resistance = S(-1); });
  refused([](auto& d) { d.linear_damping = S(-1); });
  refused([](auto& d) { d.angular_damping = S(-1); });
  refused([](auto& d) { d.locks = 1; });
  refused([](auto& d) { d.type = static_cast<BodyType>(7); });
  refused([](auto& d) { d.orientation.w = Unit<S>(0.5); });
  refused([](auto& d) { d.position.x = Limits<S>::position() + S(1); });
  refused([](auto& d) { d.velocity.x = Limits<S>::speed() + S(1); });
  refused([](auto& d) { d.angular_velocity.x = Limits<S>::angular_speed() + S(1); });
  refused([](auto& d) { d.mass = S(-1); });
  refused([](auto& d) { d.density = S(-1); });
  refused([](auto& d) { d.inertia.x = S(-1); });
  refused([](auto& d) { d.shape = {}; });
  EXPECT_EQ(texts[0], "create_body: material.friction: not a valid value; expected 0 to 16");
}

}  // namespace faults_test
}  // namespace isostep::test
