// Every command of a particle world: what an accepted one does, and that a refused one names its fault and changes
// nothing.
// SPDX-License-Identifier: MIT
#include "unit/particles/particle_worlds.hpp"

namespace isostep::test {
namespace particle_commands_test {

/// A world in full swing, with one of everything and one of everything gone.
template <class S> class ParticleCommands : public ::testing::Test {
 protected:
  ParticleCommands() : world(particle_settings<S>()) {
    balls = world.add(ball_material<S>(0.25, 0.5, 0.5));
    spare = world.add(ball_material<S>(0.5));
    ParticleDefinition<S> ball = particle_at<S>({0, 0.25, 0}, {1, 0, 0});
    ball.material = balls;
    a = world.create(ball);
    ball.position = vec<S>(0.375, 0.25, 0);
    b = world.create(ball);
    fixed = world.create(pinned_at<S>({0, 3, 0}));
    gone = world.create(particle_at<S>({5, 5, 5}));
    spring = world.add(spring_of<S>(a, fixed, 10));
    force = world.add(force_of<S>(ForceType::gravity, a));
    link = world.add(link_of<S>(LinkType::rod, a, b, 0.5));
    ground = add_plane(world);
    cohesion = world.add(Cohesion<S>{balls, num<S>(0.5), S(1), num<S>(0.5), S(1), S(1)});
    gone_spring = world.add(spring_of<S>(a, gone, 1));
    gone_force = world.add(force_of<S>(ForceType::drag, gone));
    gone_link = world.add(link_of<S>(LinkType::cable, gone, b, 20));
    gone_material = world.add(ball_material<S>(1));
    gone_collider = add_plane(world, -5);
    gone_cohesion = world.add(Cohesion<S>{balls, S(0), S(0), S(0), S(0), S(0)});
    for (int i = 0; i < 3; ++i) world.step();
    world.destroy(gone);
    world.remove(gone_material);
    world.remove(gone_collider);
    world.remove(gone_cohesion);
    for (int i = 0; i < 3; ++i) world.step();
    EXPECT_GT(world.counts().contacts, 0u);
    EXPECT_EQ(broken_rule(world), "");
  }

  template <class Command> void expect_refused(Fault fault, Command&& command, int line = __builtin_LINE()) {
    SCOPED_TRACE(line);
    const std::uint64_t before = world.hash();
    std::vector<std::uint8_t> log;
    world.record_to(&log);
    EXPECT_FALSE(static_cast<bool>(command()));
    world.record_to(nullptr);
    EXPECT_EQ(world.fault(), fault) << describe(world.fault());
    EXPECT_EQ(world.hash(), before) << "a refused command changed something: " << fault_text(fault);
    EXPECT_TRUE(log.empty());
  }
  template <class Record, class Change>
  void expect_bad(Fault fault, Record record, Change&& change, int line = __builtin_LINE()) {
    change(record);
    expect_refused(
        fault, [&] { return world.add(record); }, line);
  }

  ParticleWorld<S> world;
  ParticleMaterialId balls, spare, gone_material;
  ParticleId a, b, fixed, gone;
  SpringId spring, gone_spring;
  ForceId force, gone_force;
  LinkId link, gone_link;
  ColliderId ground, gone_collider;
  CohesionId cohesion, gone_cohesion;
};
TYPED_TEST_SUITE(ParticleCommands, AllScalars);

TYPED_TEST(ParticleCommands, a_new_world_is_empty_and_without_fault) {
  using S = TypeParam;
  ParticleWorld<S> fresh;
  EXPECT_EQ(fresh.fault(), Fault::none);
  EXPECT_EQ(fresh.tick(), 0u);
  EXPECT_TRUE(fresh.particles().empty());
  EXPECT_TRUE(fresh.step().clean());
  EXPECT_EQ(fresh.tick(), 1u);
}

TYPED_TEST(ParticleCommands, a_world_that_was_moved_from_is_empty_and_of_use) {
  using S = TypeParam;
  const std::uint64_t before = this->world.hash();
  ParticleWorld<S> taken = std::move(this->world);
  EXPECT_EQ(taken.hash(), before);
  EXPECT_TRUE(this->world.particles().empty());
  EXPECT_EQ(this->world.hash(), ParticleWorld<S>(taken.settings()).hash());
  EXPECT_TRUE(this->world.step().clean());
  this->world = std::move(taken);
  EXPECT_EQ(this->world.hash(), before);
  EXPECT_TRUE(taken.particles().empty());
}

TYPED_TEST(ParticleCommands, settings_out_of_range_are_brought_into_range_and_reported) {
  using S = TypeParam;
  ParticleSettings<S> wild;
  wild.hz = 0;
  wild.substeps = 1000;
  wild.gravity = {ParticleLimits<S>::speed() + S(1), S(0), -highest<S>()};
  wild.integrator = static_cast<Integrator>(9);
  wild.solver = static_cast<ParticleSolver>(2);
  wild.stepping = static_cast<Stepping>(0xffffffffu);
  ParticleWorld<S> tamed(wild);
  EXPECT_EQ(tamed.fault(), Fault::out_of_range);
  EXPECT_EQ(tamed.settings().hz, 10);
  EXPECT_EQ(tamed.settings().substeps, 64);
  EXPECT_EQ(tamed.settings().gravity.x, ParticleLimits<S>::speed());
  EXPECT_EQ(tamed.settings().gravity.z, -ParticleLimits<S>::speed());
  EXPECT_EQ(tamed.settings().integrator, Integrator::semi_implicit_euler);
  EXPECT_EQ(tamed.settings().solver, ParticleSolver::soft_step);
  EXPECT_EQ(tamed.settings().stepping, Stepping::fixed);
  EXPECT_EQ(broken_rule(tamed), "");
  wild = {};
  wild.hz = 5000;
  wild.substeps = 64;
  ParticleWorld<S> fast(wild);
  EXPECT_EQ(fast.settings().hz, 1000);
  EXPECT_EQ(fast.settings().substeps, kMaxParticleRate / 1000);
  EXPECT_EQ(broken_rule(fast), "");
  if constexpr (!kIsFixed<S>) {
    wild = {};
    wild.gravity = {not_a_number<S>(), endless<S>(), S(-3)};
    ParticleWorld<S> numbered(wild);
    EXPECT_EQ(numbered.fault(), Fault::out_of_range);
    EXPECT_EQ(numbered.settings().gravity, vec<S>(0, 0, -3));
  }
}

TYPED_TEST(ParticleCommands, a_created_particle_is_as_defined) {
  using S = TypeParam;
  ParticleWorld<S>& w = this->world;
  ParticleDefinition<S> d = particle_at<S>({1, 2, 3}, {4, -5, 6}, 8);
  d.material = this->spare;
  const ParticleId id = w.create(d);
  ASSERT_TRUE(id);
  EXPECT_EQ(w.position(id), d.position);
  EXPECT_EQ(w.velocity(id), d.velocity);
  EXPECT_EQ(w.mass(id), S(8));
  EXPECT_EQ(w.material(id), this->spare);
  d = pinned_at<S>({1, 2, 3});
  d.mass = S(-1);  // of no meaning
  const ParticleId pinned = w.create(d);
  EXPECT_EQ(w.mass(pinned), S(0));
  EXPECT_EQ(w.material(pinned), w.default_material()) << "a null id names the default material";
}

TYPED_TEST(ParticleCommands, bad_definitions_are_refused) {
  using S = TypeParam;
  const auto expect = [&](Fault fault, auto&& change, int line = __builtin_LINE()) {
    ParticleDefinition<S> d = particle_at<S>({0, 9, 0});
    change(d);
    this->expect_refused(
        fault, [&] { return this->world.create(d); }, line);
  };
  expect(Fault::out_of_range, [](auto& d) { d.position.x = ParticleLimits<S>::position() + S(1); });
  expect(Fault::out_of_range, [](auto& d) { d.position.y = -highest<S>(); });
  expect(Fault::out_of_range, [](auto& d) { d.velocity.z = -ParticleLimits<S>::speed() - S(1); });
  expect(Fault::bad_mass, [](auto& d) { d.mass = S(0); });
  expect(Fault::bad_mass, [](auto& d) { d.mass = S(-1); });
  expect(Fault::out_of_range, [](auto& d) { d.mass = ParticleLimits<S>::least_mass() * S(0.5); });
  expect(Fault::out_of_range, [](auto& d) { d.mass = ParticleLimits<S>::mass() * S(1.5); });
  expect(Fault::stale_id, [&](auto& d) { d.material = this->gone_material; });
  expect(Fault::stale_id, [&](auto& d) { d.material = {77, 1}; });
  if constexpr (!kIsFixed<S>) {
    expect(Fault::not_finite, [](auto& d) { d.position.z = not_a_number<S>(); });
    expect(Fault::not_finite, [](auto& d) { d.velocity.x = endless<S>(); });
    expect(Fault::not_finite, [](auto& d) { d.mass = endless<S>(); });
    expect(Fault::not_finite, [](auto& d) { d.mass = not_a_number<S>(); });
  }
}

TYPED_TEST(ParticleCommands, stale_ids_are_refused_by_every_command) {
  using S = TypeParam;
  ParticleWorld<S>& w = this->world;
  const Vec3<S> v = vec<S>(1, 2, 3);
  for (const ParticleId id : {this->gone, ParticleId{}, ParticleId{1000, 1}}) {
    this->expect_refused(Fault::stale_id, [&] { return w.destroy(id); });
    this->expect_refused(Fault::stale_id, [&] { return w.place(id, v, v); });
    this->expect_refused(Fault::stale_id, [&] { return w.set_mass(id, S(1)); });
    this->expect_refused(Fault::stale_id, [&] { return w.set_material(id, this->balls); });
    this->expect_refused(Fault::stale_id, [&] { return w.apply_force(id, v); });
    this->expect_refused(Fault::stale_id, [&] { return w.apply_impulse(id, v); });
  }
  this->expect_refused(Fault::stale_id, [&] { return w.set_material(this->a, this->gone_material); });
  this->expect_refused(Fault::stale_id, [&] { return w.remove(this->gone_material); });
  this->expect_refused(Fault::stale_id, [&] { return w.set(this->gone_material, ball_material<S>(1)); });
  this->expect_refused(Fault::stale_id, [&] { return w.remove(this->gone_spring); });
  this->expect_refused(Fault::stale_id, [&] { return w.set(this->gone_spring, spring_of<S>(this->a, this->b, 1)); });
  this->expect_refused(Fault::stale_id, [&] { return w.remove(this->gone_force); });
  this->expect_refused(Fault::stale_id, [&] { return w.set(this->gone_force, force_of<S>(ForceType::drag, this->a)); });
  this->expect_refused(Fault::stale_id, [&] { return w.remove(this->gone_cohesion); });
  this->expect_refused(Fault::stale_id, [&] { return w.set(this->gone_cohesion, *w.find(this->cohesion)); });
  this->expect_refused(Fault::stale_id, [&] { return w.remove(this->gone_link); });
  this->expect_refused(Fault::stale_id, [&] { return w.set(this->gone_link, *w.find(this->link)); });
  this->expect_refused(Fault::stale_id, [&] { return w.remove(this->gone_collider); });
  this->expect_refused(Fault::stale_id, [&] { return w.set(this->gone_collider, *w.find(this->ground)); });
  // Records that name a particle that is gone.
  this->expect_refused(Fault::stale_id, [&] { return w.add(spring_of<S>(this->gone, this->b, 1)); });
  this->expect_refused(Fault::stale_id, [&] { return w.add(spring_of<S>(this->a, this->gone, 1)); });
  this->expect_refused(Fault::stale_id, [&] { return w.set(this->spring, spring_of<S>(this->a, this->gone, 1)); });
  this->expect_refused(Fault::stale_id, [&] { return w.add(force_of<S>(ForceType::gravity, this->gone)); });
  this->expect_refused(Fault::stale_id, [&] { return w.add(link_of<S>(LinkType::rod, this->b, this->gone, 1)); });
  this->expect_refused(Fault::stale_id, [&] { return w.add(Cohesion<S>{this->gone_material, {}, {}, {}, {}, {}}); });
  this->expect_refused(Fault::stale_id, [&] {
    ParticleTouch<S> touch = {};
    touch.particle = this->gone;
    touch.normal.y = Unit<S>(1);
    return w.touch(touch);
  });
}

TYPED_TEST(ParticleCommands, questions_with_stale_ids_are_answered_with_nothing) {
  using S = TypeParam;
  const ParticleWorld<S>& w = this->world;
  for (const ParticleId id : {this->gone, ParticleId{}, ParticleId{1000, 1}}) {
    EXPECT_FALSE(w.contains(id));
    EXPECT_EQ(w.position(id), Vec3<S>::zero());
    EXPECT_EQ(w.velocity(id), Vec3<S>::zero());
    EXPECT_EQ(w.mass(id), S(0));
    EXPECT_FALSE(w.material(id));
  }
  EXPECT_EQ(w.find(this->gone_spring), nullptr);
  EXPECT_EQ(w.find(this->gone_force), nullptr);
  EXPECT_EQ(w.find(this->gone_link), nullptr);
  EXPECT_EQ(w.find(this->gone_material), nullptr);
  EXPECT_EQ(w.find(this->gone_collider), nullptr);
  EXPECT_EQ(w.find(this->gone_cohesion), nullptr);
  EXPECT_EQ(w.find(SpringId{}), nullptr);
  EXPECT_EQ(w.find(LinkId{500, 3}), nullptr);
}

TYPED_TEST(ParticleCommands, arguments_out_of_range_are_refused) {
  using S = TypeParam;
  ParticleWorld<S>& w = this->world;
  const Vec3<S> zero = Vec3<S>::zero();
  const Vec3<S> far_off = {ParticleLimits<S>::position() + S(1), S(0), S(0)};
  const Vec3<S> fast = {S(0), -ParticleLimits<S>::speed() - S(1), S(0)};
  this->expect_refused(Fault::out_of_range, [&] { return w.place(this->a, far_off, zero); });
  this->expect_refused(Fault::out_of_range, [&] { return w.place(this->a, zero, fast); });
  this->expect_refused(Fault::out_of_range, [&] { return w.set_gravity(fast); });
  this->expect_refused(Fault::bad_mass, [&] { return w.set_mass(this->a, S(0)); });
  this->expect_refused(Fault::out_of_range, [&] { return w.set_mass(this->a, highest<S>()); });
  this->expect_refused(Fault::not_dynamic, [&] { return w.apply_force(this->fixed, fast); });
  this->expect_refused(Fault::not_dynamic, [&] { return w.apply_impulse(this->fixed, fast); });
  if constexpr (!kIsFixed<S>) {
    const Vec3<S> nan = {S(0), S(0), not_a_number<S>()}, inf = {endless<S>(), S(0), S(0)};
    for (const Vec3<S> v : {nan, inf}) {
      this->expect_refused(Fault::not_finite, [&] { return w.place(this->a, v, zero); });
      this->expect_refused(Fault::not_finite, [&] { return w.place(this->a, zero, v); });
      this->expect_refused(Fault::not_finite, [&] { return w.set_gravity(v); });
      this->expect_refused(Fault::not_finite, [&] { return w.apply_force(this->a, v); });
      this->expect_refused(Fault::not_finite, [&] { return w.apply_impulse(this->a, v); });
      this->expect_refused(Fault::not_finite, [&] { return w.set_mass(this->a, v.x + v.z); });
    }
  }
}

TYPED_TEST(ParticleCommands, accepted_mutators_do_what_they_say) {
  using S = TypeParam;
  ParticleWorld<S>& w = this->world;
  EXPECT_TRUE(w.place(this->a, vec<S>(1, 2, 3), vec<S>(4, 5, 6)));
  EXPECT_EQ(w.position(this->a), vec<S>(1, 2, 3));
  EXPECT_EQ(w.velocity(this->a), vec<S>(4, 5, 6));
  EXPECT_TRUE(w.set_mass(this->a, S(4)));
  EXPECT_EQ(w.mass(this->a), S(4));
  EXPECT_TRUE(w.apply_impulse(this->a, vec<S>(4, 0, -8)));
  EXPECT_EQ(w.velocity(this->a), vec<S>(5, 5, 4));
  EXPECT_TRUE(w.set_mass(this->a, S(4), true));
  EXPECT_EQ(w.mass(this->a), S(0));
  EXPECT_EQ(w.counts().pinned, 2u);
  EXPECT_TRUE(w.set_material(this->b, this->spare));
  EXPECT_EQ(w.material(this->b), this->spare);
  EXPECT_TRUE(w.set_gravity(vec<S>(1, 0, 0)));
  EXPECT_EQ(w.settings().gravity, vec<S>(1, 0, 0));
  EXPECT_EQ(w.fault(), Fault::none);
}

TYPED_TEST(ParticleCommands, impulses_beyond_the_speed_limit_end_at_it) {
  using S = TypeParam;
  ParticleWorld<S>& w = this->world;
  const S limit = ParticleLimits<S>::speed();
  EXPECT_TRUE(w.apply_impulse(this->a, {highest<S>(), -highest<S>(), S(0)}));
  EXPECT_EQ(w.velocity(this->a).x, limit);
  EXPECT_EQ(w.velocity(this->a).y, -limit);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(w.apply_force(this->b, {highest<S>(), S(0), -highest<S>()}));
  w.step();
  EXPECT_EQ(broken_rule(w), "");
  EXPECT_LE(w.velocity(this->b).x, limit);
}

/// Doubles the state by commands alone: whatever `apply` is given does what the mutator would.
TYPED_TEST(ParticleCommands, commands_applied_as_records_do_the_same) {
  using S = TypeParam;
  ParticleWorld<S> one, other;
  const ParticleId id = one.create(particle_at<S>({0, 1, 0}));
  EXPECT_EQ(other.apply(CreateParticle<S>{particle_at<S>({0, 1, 0})}), id);
  one.apply_force(id, vec<S>(1, 2, 3));
  EXPECT_TRUE(other.apply(PushParticle<S>{id, vec<S>(1, 2, 3)}));
  one.add(spring_of<S>(id, {}, 3));
  EXPECT_TRUE(other.apply(AddRecord<Spring<S>>{spring_of<S>(id, {}, 3)}));
  EXPECT_EQ(one.hash(), other.hash());
  EXPECT_FALSE(other.apply(DestroyParticle{{5, 5}}));
  EXPECT_EQ(other.fault(), Fault::stale_id);
}

/// By position in the list: files name them by these.
TYPED_TEST(ParticleCommands, have_the_numbers_that_replays_know) {
  using S = TypeParam;
  using Command = EveryParticleCommand<S>;
  static_assert(Command::kCount == 27);
  static_assert(detail::kNumberOf<SetParticleGravity<S>, Command> == 8);
  static_assert(detail::kNumberOf<AddRecord<ParticleMaterial<S>>, Command> == 9);
  static_assert(detail::kNumberOf<SetRecord<Spring<S>, SpringId>, Command> == 13);
  static_assert(detail::kNumberOf<RemoveRecord<ForceId>, Command> == 17);
  static_assert(detail::kNumberOf<AddRecord<Cohesion<S>>, Command> == 18);
  static_assert(detail::kNumberOf<SetRecord<Link<S>, LinkId>, Command> == 22);
  static_assert(detail::kNumberOf<RemoveRecord<ColliderId>, Command> == 26);
}

TYPED_TEST(ParticleCommands, observers_of_stages_give_none) {
  using S = TypeParam;
  ParticleWorld<S>& w = this->world;
  struct Meddler {
    ParticleWorld<S>* world;
    ParticleId particle;
    std::uint32_t calls, refused;
  } meddler = {&w, this->a, 0, 0};
  const std::uint64_t tick = w.tick();
  w.step({[](void* user, ParticleStage, const StageView&) {
            Meddler& m = *static_cast<Meddler*>(user);
            ++m.calls;
            const bool done = m.world->apply_impulse(m.particle, vec<S>(1, 0, 0));
            m.refused += !done && m.world->fault() == Fault::called_in_step ? 1 : 0;
          },
          &meddler});
  EXPECT_EQ(meddler.calls, kParticleStages);
  EXPECT_EQ(meddler.refused, meddler.calls);
  EXPECT_EQ(w.tick(), tick + 1);
}

}  // namespace particle_commands_test
}  // namespace isostep::test
