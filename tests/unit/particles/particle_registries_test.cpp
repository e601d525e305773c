// Records of a particle world: added, set, removed, their rules, and what goes with a particle when it goes.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "unit/particles/particle_worlds.hpp"

namespace isostep::test {
namespace particle_registries_test {

template <class S> class ParticleRegistries : public ::testing::Test {
 protected:
  ParticleRegistries() : world(particle_settings<S>(0)) {
    a = world.create(particle_at<S>({0, 0, 0}));
    b = world.create(particle_at<S>({2, 0, 0}));
    c = world.create(particle_at<S>({4, 0, 0}));
  }
  /// A record with one thing changed is refused and changes nothing.
  template <class Record, class Change>
  void expect_bad(Fault fault, Record record, Change&& change, int line = __builtin_LINE()) {
    SCOPED_TRACE(line);
    const auto good = world.add(record);
    ASSERT_TRUE(good) << describe(world.fault());
    change(record);
    const std::uint64_t before = world.hash();
    EXPECT_FALSE(world.add(record));
    EXPECT_EQ(world.fault(), fault) << describe(world.fault());
    EXPECT_FALSE(world.set(good, record));
    EXPECT_EQ(world.fault(), fault) << describe(world.fault());
    EXPECT_EQ(world.hash(), before);
    EXPECT_TRUE(world.remove(good));
  }
  /// Expects a refusal of the numbers that only floating point has.
  template <class Record, class Member> void expect_no_number(Record record, S Member::*which) {
    if constexpr (!kIsFixed<S>) {
      for (const S x : {not_a_number<S>(), endless<S>(), -endless<S>()})
        expect_bad(Fault::not_finite, record, [&](auto& r) { r.*which = x; });
    }
  }

  ParticleWorld<S> world;
  ParticleId a, b, c;
};
TYPED_TEST_SUITE(ParticleRegistries, AllScalars);

TYPED_TEST(ParticleRegistries, a_record_is_found_as_it_was_added_and_set_until_it_is_removed) {
  using S = TypeParam;
  ParticleWorld<S>& w = this->world;
  const SpringId first = w.add(spring_of<S>(this->a, this->b, 3)), second = w.add(spring_of<S>(this->b, this->c, 4));
  EXPECT_EQ(w.counts().springs, 2u);
  EXPECT_EQ(w.find(first)->stiffness, S(3));
  EXPECT_TRUE(w.set(first, spring_of<S>(this->c, {}, 5)));
  EXPECT_EQ(w.find(first)->stiffness, S(5));
  EXPECT_EQ(w.find(first)->a, this->c);
  EXPECT_EQ(w.find(second)->stiffness, S(4)) << "setting one changed another";
  EXPECT_TRUE(w.remove(first));
  EXPECT_EQ(w.find(first), nullptr);
  EXPECT_EQ(w.find(second)->stiffness, S(4));
  const SpringId third = w.add(spring_of<S>(this->a, this->c, 6));
  EXPECT_EQ(third.slot, first.slot) << "slots are used again";
  EXPECT_NE(third.generation, first.generation);
  EXPECT_FALSE(w.remove(first));
  EXPECT_EQ(w.find(third)->stiffness, S(6));
  EXPECT_EQ(broken_rule(w), "");
}

TYPED_TEST(ParticleRegistries, bad_springs_are_refused) {
  using S = TypeParam;
  const Spring<S> good = spring_of<S>(this->a, this->b, 3);
  this->expect_bad(Fault::bad_argument, good, [](auto& s) { s.stiffness = S(-1); });
  this->expect_bad(Fault::bad_argument, good, [](auto& s) { s.damping = S(-1); });
  this->expect_bad(Fault::bad_argument, good, [](auto& s) { s.rest_length = S(-1); });
  this->expect_bad(Fault::bad_argument, good, [](auto& s) { s.elastic_limit = S(-1); });
  this->expect_bad(Fault::bad_argument, good, [](auto& s) { s.type = static_cast<SpringType>(3); });
  this->expect_bad(Fault::bad_argument, good, [](auto& s) { s.type = SpringType::stiff; });
  this->expect_bad(Fault::bad_argument, good, [](auto& s) { s.a = {}; });
  this->expect_bad(Fault::bad_argument, good, [](auto& s) { s.b = s.a; });
  this->expect_bad(Fault::out_of_range, good, [](auto& s) { s.rest_length = ParticleLimits<S>::position() + S(1); });
  this->expect_bad(Fault::out_of_range, good, [](auto& s) { s.anchor.y = -ParticleLimits<S>::position() - S(1); });
  if constexpr (!kIsFixed<S>) this->expect_bad(Fault::not_finite, good, [](auto& s) { s.anchor.z = endless<S>(); });
  this->expect_no_number(good, &Spring<S>::stiffness);
  this->expect_no_number(good, &Spring<S>::damping);
  this->expect_no_number(good, &Spring<S>::rest_length);
  this->expect_no_number(good, &Spring<S>::elastic_limit);
}

TYPED_TEST(ParticleRegistries, bad_forces_and_cohesions_are_refused) {
  using S = TypeParam;
  const ParticleForce<S> good = force_of<S>(ForceType::buoyancy, this->a);
  this->expect_bad(Fault::bad_argument, good, [](auto& f) { f.type = static_cast<ForceType>(3); });
  this->expect_bad(Fault::bad_argument, good, [](auto& f) { f.particle = {}; });
  this->expect_bad(Fault::bad_argument, good, [](auto& f) { f.linear_drag = S(-1); });
  this->expect_bad(Fault::bad_argument, good, [](auto& f) { f.quadratic_drag = S(-1); });
  this->expect_bad(Fault::bad_argument, good, [](auto& f) { f.volume = S(-1); });
  this->expect_bad(Fault::bad_argument, good, [](auto& f) { f.density = S(-1); });
  this->expect_bad(Fault::bad_argument, good, [](auto& f) { f.max_depth = S(0); });
  this->expect_bad(Fault::out_of_range, good, [](auto& f) { f.acceleration.x = -highest<S>(); });
  this->expect_bad(Fault::out_of_range, good, [](auto& f) { f.surface_height = highest<S>(); });
  this->expect_bad(Fault::out_of_range, good, [](auto& f) { f.max_depth = highest<S>(); });
  this->expect_no_number(good, &ParticleForce<S>::linear_drag);
  this->expect_no_number(good, &ParticleForce<S>::quadratic_drag);
  this->expect_no_number(good, &ParticleForce<S>::max_depth);
  this->expect_no_number(good, &ParticleForce<S>::volume);
  this->expect_no_number(good, &ParticleForce<S>::surface_height);
  this->expect_no_number(good, &ParticleForce<S>::density);
  const Cohesion<S> blob = {this->world.default_material(), num<S>(0.5), S(1), S(1), S(2), S(1)};
  this->expect_bad(Fault::bad_argument, blob, [](auto& x) { x.material = {}; });
  this->expect_bad(Fault::bad_argument, blob, [](auto& x) { x.repel_force = S(-1); });
  this->expect_bad(Fault::bad_argument, blob, [](auto& x) { x.attract_start = num<S>(0.25); });
  this->expect_bad(Fault::bad_argument, blob, [](auto& x) { x.attract_end = num<S>(0.75); });
  this->expect_bad(Fault::out_of_range, blob, [](auto& x) { x.attract_end = highest<S>(); });
  this->expect_no_number(blob, &Cohesion<S>::repel_force);
  this->expect_no_number(blob, &Cohesion<S>::attract_force);
  this->expect_no_number(blob, &Cohesion<S>::repel_distance);
}

TYPED_TEST(ParticleRegistries, bad_links_colliders_and_materials_are_refused) {
  using S = TypeParam;
  const Link<S> good = link_of<S>(LinkType::cable, this->a, this->b, 3);
  this->expect_bad(Fault::bad_argument, good, [](auto& l) { l.length = S(0); });
  this->expect_bad(Fault::bad_argument, good, [](auto& l) { l.length = S(-1); });
  this->expect_bad(Fault::bad_argument, good, [](auto& l) { l.restitution = S(2); });
  this->expect_bad(Fault::bad_argument, good, [](auto& l) { l.type = static_cast<LinkType>(2); });
  this->expect_bad(Fault::bad_argument, good, [](auto& l) { l.a = l.b; });
  this->expect_bad(Fault::out_of_range, good, [](auto& l) { l.length = highest<S>(); });
  this->expect_bad(Fault::out_of_range, good, [](auto& l) { l.anchor.x = highest<S>(); });
  this->expect_no_number(good, &Link<S>::length);
  this->expect_no_number(good, &Link<S>::restitution);
  const Collider<S> plane;
  this->expect_bad(Fault::bad_shape, plane, [](auto& x) { x.normal.y = Unit<S>(0.5); });
  this->expect_bad(Fault::bad_shape, plane, [](auto& x) { x.normal = {Unit<S>(0), Unit<S>(0), Unit<S>(0)}; });
  this->expect_bad(Fault::bad_shape, plane, [](auto& x) { x.type = static_cast<ColliderType>(2); });
  this->expect_bad(Fault::out_of_range, plane, [](auto& x) { x.offset = highest<S>(); });
  this->expect_bad(Fault::out_of_range, plane, [](auto& x) { x.end.z = -highest<S>(); });
  this->expect_no_number(plane, &Collider<S>::offset);
  this->expect_no_number(plane, &Collider<S>::radius);
  Collider<S> line;
  line.type = ColliderType::line;
  this->expect_bad(Fault::bad_shape, line, [](auto& x) { x.radius = S(-1); });
  const ParticleMaterial<S> stuff;
  this->expect_bad(Fault::bad_argument, stuff, [](auto& m) { m.damping = num<S>(1.5); });
  this->expect_bad(Fault::bad_argument, stuff, [](auto& m) { m.damping = S(-1); });
  this->expect_bad(Fault::bad_argument, stuff, [](auto& m) { m.restitution = S(2); });
  this->expect_bad(Fault::bad_argument, stuff, [](auto& m) { m.linear_drag = S(-1); });
  this->expect_bad(Fault::bad_argument, stuff, [](auto& m) { m.quadratic_drag = S(-1); });
  this->expect_bad(Fault::bad_argument, stuff, [](auto& m) { m.radius = S(-1); });
  this->expect_bad(Fault::bad_argument, stuff, [](auto& m) { m.friction = S(-1); });
  this->expect_bad(Fault::out_of_range, stuff, [](auto& m) { m.friction = S(17); });
  this->expect_bad(Fault::out_of_range, stuff, [](auto& m) { m.gravity_scale = -highest<S>(); });
  this->expect_bad(Fault::out_of_range, stuff, [](auto& m) { m.radius = highest<S>(); });
  this->expect_no_number(stuff, &ParticleMaterial<S>::gravity_scale);
  this->expect_no_number(stuff, &ParticleMaterial<S>::quadratic_drag);
  this->expect_no_number(stuff, &ParticleMaterial<S>::radius);
}

TYPED_TEST(ParticleRegistries, the_default_material_may_be_set_but_not_removed_and_none_that_is_in_use) {
  using S = TypeParam;
  ParticleWorld<S>& w = this->world;
  ParticleMaterial<S> heavy;
  heavy.gravity_scale = S(2);
  EXPECT_TRUE(w.set(w.default_material(), heavy));
  EXPECT_EQ(w.find(w.default_material())->gravity_scale, S(2));
  EXPECT_FALSE(w.remove(w.default_material()));
  EXPECT_EQ(w.fault(), Fault::shape_in_use);
  const ParticleMaterialId m = w.add(heavy);
  EXPECT_TRUE(w.set_material(this->b, m));
  EXPECT_FALSE(w.remove(m));
  EXPECT_EQ(w.fault(), Fault::shape_in_use);
  EXPECT_TRUE(w.destroy(this->b));
  const CohesionId cohesion = w.add(Cohesion<S>{m, S(0), S(0), S(0), S(0), S(0)});
  EXPECT_FALSE(w.remove(m)) << "a cohesion names it";
  EXPECT_TRUE(w.remove(cohesion));
  EXPECT_TRUE(w.remove(m));
  EXPECT_EQ(broken_rule(w), "");
}

TYPED_TEST(ParticleRegistries, a_destroyed_particle_takes_with_it_all_that_names_it_and_nothing_else) {
  using S = TypeParam;
  ParticleWorld<S>& w = this->world;
  ParticleMaterial<S> ball = ball_material<S>(0.75, 0);
  ASSERT_TRUE(w.set(w.default_material(), ball));
  ASSERT_TRUE(w.place(this->b, vec<S>(1, 0, 0), vec<S>(0, 0, 0)));
  ASSERT_TRUE(w.place(this->c, vec<S>(2, 0, 0), vec<S>(0, 0, 0)));
  const ColliderId ground = add_plane(w, -0.5);
  ParticleDefinition<S> mortal = particle_at<S>({9, 9, 9});
  mortal.lifetime = 500;
  const ParticleId d = w.create(mortal);
  const SpringId ab = w.add(spring_of<S>(this->a, this->b, 1)), ba = w.add(spring_of<S>(this->b, this->a, 1)),
                 bd = w.add(spring_of<S>(this->b, d, 1, 8));
  const ForceId on_a = w.add(force_of<S>(ForceType::gravity, this->a)),
                on_b = w.add(force_of<S>(ForceType::drag, this->b));
  const LinkId link_ac = w.add(link_of<S>(LinkType::cable, this->a, this->c, 5)),
               link_bc = w.add(link_of<S>(LinkType::rod, this->b, this->c, 1)),
               link_a = w.add(link_of<S>(LinkType::rod, this->a, {}, 1));
  w.step();
  const auto contacts_of = [&](ParticleId id) {
    const auto names = [&](const ParticleContact<S>& met) { return met.a == id.slot || met.b == id.slot; };
    return std::count_if(w.state().contacts.begin(), w.state().contacts.end(), names);
  };
  ASSERT_GE(contacts_of(this->a), 1);
  const std::size_t others = w.counts().contacts - static_cast<std::size_t>(contacts_of(this->a));
  ASSERT_GE(others, 1u);
  ParticleTouch<S> touch = {};
  touch.normal.y = Unit<S>(-1);
  for (const ParticleId id : {this->a, this->b}) {
    touch.particle = id;
    ASSERT_TRUE(w.touch(touch));
    ASSERT_TRUE(w.apply_force(id, vec<S>(1, 0, 0)));
  }
  ASSERT_TRUE(w.destroy(this->a));
  EXPECT_EQ(broken_rule(w), "");
  EXPECT_EQ(w.find(ab), nullptr);
  EXPECT_EQ(w.find(ba), nullptr);
  EXPECT_EQ(w.find(on_a), nullptr);
  EXPECT_EQ(w.find(link_ac), nullptr);
  EXPECT_EQ(w.find(link_a), nullptr);
  EXPECT_NE(w.find(bd), nullptr);
  EXPECT_NE(w.find(on_b), nullptr);
  EXPECT_NE(w.find(link_bc), nullptr);
  EXPECT_NE(w.find(ground), nullptr);
  EXPECT_EQ(contacts_of(this->a), 0);
  EXPECT_EQ(w.counts().contacts, others);
  ASSERT_EQ(w.state().touches.size(), 1u);
  EXPECT_EQ(w.state().touches[0].particle, this->b);
  ASSERT_EQ(w.state().pushes.size(), 1u);
  EXPECT_EQ(w.state().pushes[0].slot, this->b.slot);
  EXPECT_EQ(w.state().lifetimes.size(), 1u);
  ASSERT_TRUE(w.destroy(d));
  EXPECT_TRUE(w.state().lifetimes.empty());
  EXPECT_EQ(w.find(bd), nullptr);
  EXPECT_EQ(broken_rule(w), "");
}

TYPED_TEST(ParticleRegistries, a_slot_used_again_has_a_new_generation_and_none_of_the_past) {
  using S = TypeParam;
  ParticleWorld<S>& w = this->world;
  ASSERT_TRUE(w.apply_force(this->b, vec<S>(0, 100, 0)));
  ASSERT_TRUE(w.destroy(this->b));
  const ParticleId next = w.create(particle_at<S>({7, 0, 0}));
  EXPECT_EQ(next.slot, this->b.slot);
  EXPECT_NE(next.generation, this->b.generation);
  EXPECT_FALSE(w.contains(this->b));
  EXPECT_FALSE(w.destroy(this->b));
  w.step();
  EXPECT_EQ(w.position(next), vec<S>(7, 0, 0)) << "it felt a force on the one before";
  ParticleWorld<S> other(particle_settings<S>(0));
  EXPECT_FALSE(other.contains(next));
}

TYPED_TEST(ParticleRegistries, a_removed_collider_takes_its_contacts) {
  using S = TypeParam;
  ParticleWorld<S> w(particle_settings<S>());
  ASSERT_TRUE(w.set(w.default_material(), ball_material<S>(0.5)));
  // A groove whose sides both bear the ball.
  Collider<S> side;
  side.normal = {num<Unit<S>>(0.6), num<Unit<S>>(0.8), Unit<S>(0)};
  const ColliderId first = w.add(side);
  side.normal.x = -side.normal.x;
  const ColliderId second = w.add(side);
  const ParticleId ball = w.create(particle_at<S>({0, 0.625, 0}));  // 0.5 from both
  for (int i = 0; i < 10; ++i) w.step();
  ASSERT_EQ(w.counts().contacts, 2u);
  ASSERT_TRUE(w.remove(first));
  EXPECT_EQ(w.counts().contacts, 1u);
  EXPECT_EQ(broken_rule(w), "");
  ASSERT_TRUE(w.remove(second));
  EXPECT_EQ(w.counts().contacts, 0u);
  for (int i = 0; i < 30; ++i) w.step();
  EXPECT_LT(to_double(w.position(ball).y), 0);
}

}  // namespace particle_registries_test
}  // namespace isostep::test
