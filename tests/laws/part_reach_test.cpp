// Laws of how far a part's traits reach: a sensor weighs, floats, stops, wakes and limits nothing, and every system
// goes by the part that touches.
// SPDX-License-Identifier: MIT
#include "isostep/fracture/shatter.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "laws/part_worlds.hpp"
#include "random/dice.hpp"

namespace isostep::test {
namespace part_reach_test {

template <class S> class PartReachLaws : public PartWorlds<S> {
 protected:
  static PartTraits<S> senses() { return PartWorlds<S>::flagged(part_flag::kSensor); }
  static PartTraits<S> of_kind(std::uint32_t kind) {
    Material<S> material;
    material.kind = kind;
    return PartTraits<S>{}.with(material);
  }
  BodyId character_body(D3 at, const PartTraits<S>& traits = {}) {
    Child<S> part = part_at(primitive_of(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 0, 0});
    part.traits = traits;
    BodyDefinition<S> d = still<S>(this->shape({part}), at);
    d.type = BodyType::kinematic;
    return this->w.create(d);
  }
};
TYPED_TEST_SUITE(PartReachLaws, AllScalars);

TYPED_TEST(PartReachLaws, a_ghost_of_a_character_and_a_platform_that_reports_lasts_until_they_are_apart) {
  using S = TypeParam;
  for (const bool reports : {false, true}) {
    this->w = World<S>(settings<S>());
    const PartTraits<S> traits = reports ? this->flagged(part_flag::kReportContacts) : PartTraits<S>{};
    const BodyId platform = this->fixed({this->box({4, 0.125, 4}, {0, 0, 0}, traits)});
    CharacterSettings<S> hero;
    hero.body = this->character_body({0, 0.9, 0});
    ASSERT_TRUE(this->w.add(hero));
    run(this->w, 30);
    ASSERT_TRUE(this->w.add(Ghost<S>{hero.body, platform}));
    run(this->w, 60);
    EXPECT_LT(this->at(hero.body).y, -2) << reports;
  }
}

TYPED_TEST(PartReachLaws, a_platform_that_is_passed_from_below_holds_whatever_its_sensors_see) {
  using S = TypeParam;
  Dice dice(1);
  for (int i = 0; i < 6; ++i) {
    this->w = World<S>(settings<S>());
    const double up = dice.in(0.5, 2);
    const BodyId platform =
        this->fixed({this->box({4, 0.125, 4}, {0, 2, 0}), this->box({4, 1, 4}, {0, 2.125 + up, 0}, this->senses())});
    OneWay<S> open;
    open.body = platform;
    ASSERT_TRUE(this->w.add(open));
    const BodyId jumper = this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0})}, {0, 0.5, 0}, {0, 8.5, 0});
    run(this->w, 150);
    EXPECT_NEAR(this->at(jumper).y, 2.375, 0.03) << up;
  }
}

TYPED_TEST(PartReachLaws, a_body_beside_a_pond_falls_though_its_sensor_reaches_in) {
  using S = TypeParam;
  for (const bool has : {false, true}) {
    this->w = World<S>(settings<S>());
    Water<S> pond;
    pond.half = vec<S>(1, 4, 1);
    pond.density = S(16);
    ASSERT_TRUE(this->w.add(pond));
    std::vector<Child<S>> parts = {this->box({0.25, 0.25, 0.25}, {0, 0, 0})};
    if (has) parts.push_back(this->box({1.5, 0.25, 0.25}, {-1.5, 0, 0}, this->senses()));
    const BodyId body = this->loose(parts, {3, 0, 0});
    run(this->w, 60);
    EXPECT_NEAR(this->at(body).y, -5, 0.1) << has;
  }
}

TYPED_TEST(PartReachLaws, new_heights_lift_only_what_the_field_meets) {
  using S = TypeParam;
  const std::vector<std::int16_t> flat(17 * 17, 0), high(25, 512);
  for (const bool meets : {false, true}) {
    this->w = World<S>(settings<S>(0));
    const BlobRef field = height_field_blob(height_field({10, 0, 17, 17, 512}, flat, {}).value());
    std::vector<Child<S>> parts = {this->field_part(field), this->box({0.125, 0.125, 0.125}, {0, 0, 0})};
    if (!meets) parts[0].traits = this->only(kOther);
    const ShapeId ground = this->shape(parts, {field});
    this->w.create(this->quiet(still<S>(ground, {-4, 0, -4})));
    const BodyId box = this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0})}, {0, 0.27, 0});
    this->w.step();
    ASSERT_TRUE(this->w.set_heights(ground, 0, {6, 6, 5, 5, high})) << describe(this->w.fault());
    EXPECT_EQ(this->at(box).y > 0.5, meets);
  }
}

TYPED_TEST(PartReachLaws, thin_ice_is_the_part_that_is_of_that_kind) {
  using S = TypeParam;
  constexpr std::uint32_t kIce = 7, kHero = 8;
  for (const bool by_part : {false, true}) {
    for (const bool is_ice : {false, true}) {
      this->w = World<S>(settings<S>(0));
      KindResponse<S> ice;
      ice.kind_a = kIce;
      ice.kind_b = kHero;
      ice.max_force = S(4);
      ASSERT_TRUE(this->w.add(ice));
      // By the part, or by the body whose part is as it is; the other one says the contrary.
      const PartTraits<S> own = this->of_kind(is_ice ? kIce : 0);
      BodyDefinition<S> d = this->quiet(
          still<S>(this->shape({this->box({0.0625, 2, 2}, {0, 0, 0}, by_part ? own : PartTraits<S>{})}), {6, 0, 0}));
      d.material.kind = by_part == is_ice ? 0 : kIce;
      this->w.create(d);
      d = this->quiet(moving<S>(add_ball(this->w, 0.125), {0, 0, 0}, {pick<S>(100, 100, 60, 100), 0, 0}));
      d.material.kind = kHero;
      const BodyId ball = this->w.create(d);
      for (int f = 0; f < 30; ++f) this->w.step();
      EXPECT_EQ(this->at(ball).x > 8, is_ice) << "by part " << by_part;
    }
  }
}

TYPED_TEST(PartReachLaws, the_belt_of_a_part_keeps_awake_what_it_carries_and_no_other) {
  using S = TypeParam;
  Material<S> runs, stands;
  runs.surface_velocity = vec<S>(0.03, 0, 0);
  this->fixed(this->floors(PartTraits<S>{}.with(runs), {}));
  BodyDefinition<S> d = this->quiet(
      still<S>(this->shape({this->box({4, 0.5, 4}, {0, -0.5, 0}, PartTraits<S>{}.with(stands))}), {40, 0, 0}));
  d.material = runs;
  this->w.create(d);
  const ShapeId box = add_box(this->w, 0.25, 0.25, 0.25);
  const BodyId carried = this->w.create(moving<S>(box, {-8, 0.25, 0})),
               lies = this->w.create(moving<S>(box, {8, 0.25, 0})),
               rests = this->w.create(moving<S>(box, {40, 0.25, 0}));
  run(this->w, 300);
  EXPECT_TRUE(this->w.is_awake(carried));
  EXPECT_NEAR(this->at(carried).x, -8 + 0.03 * 5, 0.02);
  EXPECT_FALSE(this->w.is_awake(lies));
  EXPECT_FALSE(this->w.is_awake(rests));
}

TYPED_TEST(PartReachLaws, a_belt_carries_a_character_by_the_filter_of_its_own_part_and_its_mask) {
  using S = TypeParam;
  for (const bool by_mask : {false, true}) {
    this->w = World<S>(settings<S>());
    const PartTraits<S> other = PartTraits<S>{}.with(Filter{kOther, 0xffffffffu, 0});
    // Of two parts in one place it meets the second.
    const BodyId ground =
        this->fixed({this->box({8, 0.5, 8}, {0, -0.5, 0}, by_mask ? other : PartTraits<S>{}),
                     this->box({8, 0.5, 8}, {0, -0.5, 0}, by_mask ? PartTraits<S>{} : this->only(kOther))});
    ASSERT_TRUE(this->w.add(SurfaceVelocity<S>{ground, vec<S>(1, 0, 0), Vec3<S>::zero(), 1}));
    CharacterSettings<S> character;
    character.body = this->character_body({0, 0.8125, 0}, by_mask ? PartTraits<S>{} : this->only(kOther));
    if (by_mask) character.mask = 1;
    ASSERT_TRUE(this->w.add(character));
    run(this->w, 30);
    const double from = this->at(character.body).x;
    run(this->w, 60);
    EXPECT_NEAR(this->at(character.body).x - from, 1, 0.02) << "by its mask " << by_mask;
  }
}

TYPED_TEST(PartReachLaws, a_character_passes_bodies_of_a_kind_as_others_do) {
  using S = TypeParam;
  for (const bool gate_is : {false, true}) {
    this->w = World<S>(settings<S>());
    this->fixed({this->box({8, 0.5, 8}, {0, -0.5, 0})});
    BodyDefinition<S> d =
        still<S>(this->shape({this->box({0.25, 2, 4}, {0, 2, 0}, this->of_kind(gate_is ? 0 : 1))}), {2, 0, 0});
    d.material.kind = gate_is ? 1 : 0;
    this->w.create(d);
    ASSERT_TRUE(this->w.add(KindGhost<S>{1, 2}));
    Child<S> part = part_at(primitive_of(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 0, 0});
    d = still<S>(this->shape({part}), {0, 0.8125, 0});
    d.type = BodyType::kinematic;
    d.material.kind = 2;
    CharacterSettings<S> hero;
    hero.body = this->w.create(d);
    const CharacterId id = this->w.add(hero);
    ASSERT_TRUE(id);
    ASSERT_TRUE(this->w.set_input(id, {.move = vec<S>(3, 0, 0)}));
    run(this->w, 90);
    EXPECT_EQ(this->at(hero.body).x > 3, gate_is);
  }
}

TYPED_TEST(PartReachLaws, a_lift_wakes_what_it_touches_and_not_what_its_sensor_sees) {
  using S = TypeParam;
  add_ground(this->w);
  const BodyId crate = this->w.create(moving<S>(add_box(this->w, 0.25, 0.25, 0.25), {4, 0.25, 0}));
  BodyDefinition<S> d =
      still<S>(this->shape({this->box({0.5, 0.25, 0.5}, {0, 0, 0}), this->box({6, 1, 6}, {0, 0, 0}, this->senses())}),
               {0, 1, 0});
  d.type = BodyType::kinematic;
  const BodyId lift = this->w.create(d);
  for (int f = 0; f < 180; ++f) {
    ASSERT_TRUE(this->w.move_to(lift, {vec<S>(0, 1 + 0.25 * (f % 2), 0), Quat<Unit<S>>::identity()}));
    this->w.step();
  }
  EXPECT_FALSE(this->w.is_awake(crate));
}

TYPED_TEST(PartReachLaws, a_fast_kinematic_body_runs_over_what_its_solid_parts_meet) {
  using S = TypeParam;
  Dice dice(2);
  for (int i = 0; i < 8; ++i) {
    const double reach = dice.in(4, 8), over = dice.in(1, 3), speed = dice.in(12, 24);
    for (const bool hits : {false, true}) {
      this->w = World<S>(settings<S>());
      add_ground(this->w);
      const BodyId crate = this->w.create(moving<S>(add_box(this->w, 0.25, 0.25, 0.25), {0, 0.25, 0}));
      ASSERT_TRUE(settle(this->w));
      const PartTraits<S> nothing = PartTraits<S>{}.with(Filter{0, 0, 0});
      BodyDefinition<S> d =
          moving<S>(this->shape({this->box({0.0625, 0.0625, 0.0625}, {0, 0, 0}),
                                 this->box({0.0625, reach, 0.0625}, {0, 0, 0}, i % 2 == 0 ? this->senses() : nothing)}),
                    {-8, hits ? 0.25 : 0.5 + over, 0}, {speed, 0, 0});
      d.type = BodyType::kinematic;
      this->w.create(d);
      bool woke = false;
      for (int f = 0; f < 60; ++f) {
        this->w.step();
        woke = woke || this->w.is_awake(crate);
      }
      EXPECT_EQ(woke, hits) << i;
    }
  }
}

TYPED_TEST(PartReachLaws, a_sensor_that_is_put_over_a_sleeper_does_not_see_its_ghosts) {
  using S = TypeParam;
  for (const bool ghosts : {false, true}) {
    this->w = World<S>(settings<S>());
    add_ground(this->w);
    BodyDefinition<S> d = moving<S>(add_box(this->w, 0.25, 0.25, 0.25), {0, 0.25, 0});
    d.material.kind = 2;
    const BodyId crate = this->w.create(d);
    d = still<S>(add_box(this->w, 1, 1, 1), {0, 40, 0});
    d.sensor = true;
    d.material.kind = 1;
    const BodyId zone = this->w.create(d);
    if (ghosts) {
      ASSERT_TRUE(this->w.add(KindGhost<S>{1, 2}));
    }
    ASSERT_TRUE(settle(this->w));
    ASSERT_TRUE(this->w.set_pose(zone, {Vec3<S>::zero(), Quat<Unit<S>>::identity()}));
    this->w.step();
    EXPECT_EQ(this->w.events().sensor_begin.size(), ghosts ? 0u : 1u);
    EXPECT_FALSE(this->w.is_awake(crate));
  }
}

TYPED_TEST(PartReachLaws, a_body_spins_as_fast_as_without_the_part_that_senses) {
  using S = TypeParam;
  this->w = World<S>(settings<S>(0));
  const double spin = pick<S>(60, 60, 40, 60);
  BodyDefinition<S> d = this->quiet(moving<S>(
      this->shape({this->box({0.25, 0.25, 0.25}, {0, 0, 0}), this->box({20, 0.25, 0.25}, {0, 0, 0}, this->senses())}),
      {0, 0, 0}));
  d.angular_velocity = vec<S>(0, spin, 0);
  const BodyId body = this->w.create(d);
  ASSERT_TRUE(body) << describe(this->w.fault());
  run(this->w, 30);
  EXPECT_NEAR(to_double(this->w.angular_velocity(body).y), spin, 0.1);
}

TYPED_TEST(PartReachLaws, a_sensor_surface_does_not_move_the_centre) {
  using S = TypeParam;
  const std::vector<std::int16_t> flat(9, 0);
  const BlobRef field = height_field_blob(height_field({10, 0, 3, 3, 512}, flat, {}).value());
  Child<S> zone = this->field_part(field);
  zone.traits = this->senses();
  BodyDefinition<S> d = still<S>(this->shape({this->box({0.5, 0.5, 0.5}, {2, 0, 0}), zone}, {field}), {0, 0, 0});
  d.type = BodyType::kinematic;
  EXPECT_EQ(this->w.center_of_mass(this->w.create(d)), vec<S>(2, 0, 0));
  d.type = BodyType::dynamic;
  EXPECT_FALSE(this->w.create(d)) << "a surface does not turn";
}

TYPED_TEST(PartReachLaws, shards_are_what_the_part_was) {
  using S = TypeParam;
  Material<S> ice;
  ice.friction = num<S>(0.0625);
  const PartTraits<S> own = PartTraits<S>{}.with(ice).with(Filter{kOther, kOther, 0}).with(part_flag::kReportContacts);
  const BodyId crate = this->loose({this->box({0.5, 0.5, 0.5}, {0, 0, 0}, own)}, {0, 4, 0});
  const Result<GridHull> solid = grid_box(Box<S>{vec<S>(0.5, 0.5, 0.5)});
  ASSERT_TRUE(solid.ok());
  const Result<Fracture> broken = fracture(solid.value(), EightBoxes{}, FractureImpact{{1, 2, 3}, {1, -2, 3}}, 7);
  ASSERT_TRUE(broken.ok());
  const std::vector<ShapeId> shapes = add_piece_shapes(this->w, broken.value());
  const auto shards = shatter<S>(broken.value(), this->w.view(crate), shapes);
  ASSERT_TRUE(shards.ok());
  for (const BodyDefinition<S>& shard : shards.value()) {
    EXPECT_EQ(shard.material.friction, ice.friction);
    EXPECT_EQ(shard.filter, (Filter{kOther, kOther, 0}));
    EXPECT_TRUE(shard.report_contacts);
  }
}

}  // namespace part_reach_test
}  // namespace isostep::test
