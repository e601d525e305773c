// Records of forces: what is refused, what commands and sleep do with them, and that they are state.
// SPDX-License-Identifier: MIT

#include "unit/world/forces.hpp"

namespace isostep::test {
namespace force_records_test {

template <class S> class ForceRecordsOf : public Forces<S> {};
TYPED_TEST_SUITE(ForceRecordsOf, AllScalars);

TYPED_TEST(ForceRecordsOf, bad_records_are_refused_by_name_and_change_nothing) {
  using S = TypeParam;
  const BodyId id = this->ball({0, 0, 0});
  const BodyId fixed = this->world_.create(still<S>(add_ball(this->world_, 0.5), {4, 0, 0}));
  const BodyId light = this->ball({12, 0, 0}, 0.0625), gone = this->ball({8, 0, 0});
  this->world_.destroy(gone);
  const std::uint64_t before = this->world_.hash();
  const auto refused = [&](auto record, const char* field) {
    EXPECT_FALSE(this->world_.add(record)) << field;
    EXPECT_STREQ(this->world_.fault().field, field);
    EXPECT_NE(std::string(this->world_.fault().expected) + std::string(this->world_.fault().field), "");
    EXPECT_EQ(this->world_.hash(), before) << field;
  };
  const auto spring = [&](auto edit) {
    BodySpring<S> s;
    s.a = id, s.stiffness = S(1);
    edit(s);
    return s;
  };
  refused(spring([&](auto& s) { s.a = gone; }), "a");
  refused(spring([&](auto& s) { s.b = id; }), "b");
  refused(spring([&](auto& s) { s.a = fixed; }), "a, b");
  refused(spring([&](auto& s) { s.a = light, s.stiffness = highest<S>(); }), "stiffness");
  refused(spring([&](auto& s) { s.a = light, s.damping = highest<S>(); }), "damping");
  refused(spring([&](auto& s) { s.damping = S(-1); }), "damping");
  refused(spring([&](auto& s) { s.rest_length = S(-1); }), "rest_length");
  refused(spring([&](auto& s) { s.anchor_a.x = Limits<S>::position() * S(1.5); }), "anchor_a");
  refused(BodyDrag<S>{fixed, S(1), S(1), S(1)}, "body");
  refused(BodyDrag<S>{id, S(-1), S(1), S(1)}, "linear");
  refused(BodyDrag<S>{id, S(1), S(-1), S(1)}, "quadratic");
  refused(BodyDrag<S>{id, S(1), S(1), S(-1)}, "angular");
  refused(Thruster<S>{{}, Vec3<S>::zero(), Vec3<S>::zero()}, "body");
  BuoyancyPoint<S> buoyancy;
  buoyancy.body = id;
  buoyancy.max_depth = S(0);
  refused(buoyancy, "max_depth");
  AeroSurface<S> surface;
  surface.body = id;
  surface.control = S(1.5);
  refused(surface, "control");
  surface.control = S(0);
  surface.orientation.w = Unit<S>(0.5);
  refused(surface, "orientation");
  Attractor<S> attractor;
  attractor.body = gone;
  refused(attractor, "body");
  attractor.body = {};
  attractor.least_distance = S(0);
  refused(attractor, "least_distance");
  ForceZone<S> zone;
  zone.shape = static_cast<ZoneShape>(3);
  refused(zone, "shape");
  zone.shape = ZoneShape::box;
  zone.half.z = S(-1);
  refused(zone, "half");
  EXPECT_FALSE(this->world_.remove(DragId{0, 1}));
  EXPECT_FALSE(this->world_.set(ThrusterId{0, 1}, {id, Vec3<S>::zero(), Vec3<S>::zero()}));
  EXPECT_EQ(this->world_.find(AeroSurfaceId{3, 1}), nullptr);
  EXPECT_EQ(this->world_.hash(), before);
}

TYPED_TEST(ForceRecordsOf, go_with_the_bodies_that_they_name) {
  using S = TypeParam;
  const BodyId a = this->ball({0, 0, 0}), b = this->ball({2, 0, 0});
  const DragId drag = this->added(this->world_.add(BodyDrag<S>{a, S(1), S(0), S(0)}));
  const DragId kept = this->added(this->world_.add(BodyDrag<S>{b, S(1), S(0), S(0)}));
  BodySpring<S> spring;
  spring.a = b, spring.b = a;
  const BodySpringId tie = this->added(this->world_.add(spring));
  ASSERT_NE(this->world_.find(tie), nullptr);
  this->world_.destroy(a);
  EXPECT_EQ(this->world_.find(drag), nullptr);
  EXPECT_EQ(this->world_.find(tie), nullptr);
  EXPECT_NE(this->world_.find(kept), nullptr);
  run(this->world_, 3);
}

TYPED_TEST(ForceRecordsOf, springs_sleep_and_wake_with_both_of_their_bodies) {
  using S = TypeParam;
  this->sleeps_ = true;
  add_ground(this->world_);
  const BodyId a = this->ball({0, 0.5, 0}), b = this->ball({3, 0.5, 0}), alone = this->ball({-6, 0.5, 0});
  BodySpring<S> spring;
  spring.a = a, spring.b = b, spring.rest_length = S(3), spring.stiffness = S(50), spring.damping = S(4);
  this->added(this->world_.add(spring));
  ASSERT_TRUE(settle(this->world_));
  this->world_.wake(a);
  EXPECT_TRUE(this->world_.is_awake(b));
  EXPECT_FALSE(this->world_.is_awake(alone));
  ASSERT_TRUE(settle(this->world_));
  const ThrusterId push = this->added(this->world_.add(Thruster<S>{alone, Vec3<S>::zero(), vec<S>(0, 1, 0)}));
  EXPECT_TRUE(this->world_.is_awake(alone));
  EXPECT_FALSE(this->world_.is_awake(a));
  ASSERT_TRUE(settle(this->world_)) << "a steady force lets rest what it does not move";
  this->world_.remove(push);
  EXPECT_TRUE(this->world_.is_awake(alone));
  this->added(this->world_.add(ForceZone<S>{}));
  EXPECT_TRUE(this->world_.is_awake(a));
}

TYPED_TEST(ForceRecordsOf, driven_ends_keep_springs_awake) {
  using S = TypeParam;
  this->sleeps_ = true;
  add_ground(this->world_);
  BodyDefinition<S> d = moving<S>(add_ball(this->world_, 0.25), {0, 4, 0});
  d.type = BodyType::kinematic;
  const BodyId driven = this->world_.create(d), body = this->ball({0, 0.5, 0});
  BodySpring<S> spring;
  spring.a = driven, spring.b = body, spring.rest_length = S(1), spring.stiffness = S(2), spring.damping = S(1);
  this->added(this->world_.add(spring));
  for (int i = 0; i < 300 && this->world_.is_awake(body); ++i) this->world_.step();
  ASSERT_FALSE(this->world_.is_awake(body));
  this->world_.set_velocity(driven, vec<S>(0, 4, 0), Vec3<S>::zero());
  EXPECT_TRUE(this->world_.is_awake(body));
  run(this->world_, 300);
  EXPECT_GT(this->centre(body).y, 1);
}

TYPED_TEST(ForceRecordsOf, are_state) {
  using S = TypeParam;
  const BodyId id = this->ball({0, 4, 0}), other = this->ball({2, 4, 0});
  const std::vector<std::uint8_t> plain = bytes_of(this->world_);
  const DragId drag = this->added(this->world_.add(BodyDrag<S>{id, S(1), S(1), S(1)}));
  BodySpring<S> spring;
  spring.a = id, spring.b = other, spring.stiffness = S(20);
  this->added(this->world_.add(spring));
  EXPECT_GT(bytes_of(this->world_).size(), plain.size());
  typename World<S>::Snapshot snapshot;
  this->world_.save(snapshot);
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 30; ++i) {
    if (i == 10) this->world_.remove(drag);
    this->world_.step();
    hashes.push_back(this->world_.hash());
  }
  ASSERT_TRUE(this->world_.load(snapshot));
  EXPECT_NE(this->world_.find(drag), nullptr);
  World<S> read(settings<S>(5, 10, 1));
  const std::vector<std::uint8_t> bytes = bytes_of(this->world_);
  Reader reader(bytes);
  ASSERT_TRUE(read.read_portable(reader).ok());
  EXPECT_EQ(read.hash(), this->world_.hash());
  for (int i = 0; i < 30; ++i) {
    for (World<S>* w : {&this->world_, &read}) {
      if (i == 10) {
        EXPECT_TRUE(w->remove(drag));
      }
      w->step();
      EXPECT_EQ(w->hash(), hashes[static_cast<std::size_t>(i)]) << i;
    }
  }
}

}  // namespace force_records_test
}  // namespace isostep::test
