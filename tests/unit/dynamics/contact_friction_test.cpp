// The choice of a contact's coefficient, the table of pairs, and the presets.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/contact_friction.hpp"

#include "isostep/dynamics/friction_presets.hpp"
#include "isostep/dynamics/kind_table.hpp"
#include "random/dice.hpp"

namespace isostep::test {
namespace contact_friction_test {

template <class S> class ContactFriction : public ::testing::Test {};
TYPED_TEST_SUITE(ContactFriction, AllScalars);

template <class S> Vec3<Unit<S>> unit(D3 v) {
  v = v * (1 / length(v));
  return {num<Unit<S>>(v.x), num<Unit<S>>(v.y), num<Unit<S>>(v.z)};
}
template <class S> Vec3<Velocity<S>> velocity(D3 v) {
  return {num<Velocity<S>>(v.x), num<Velocity<S>>(v.y), num<Velocity<S>>(v.z)};
}
template <class S> Grain<S> grain_of(D3 factors, D3 axis = {0, 1, 0}, double angle = 0) {
  return {vec<S>(factors), to_matrix(turn<S>(axis, angle))};
}

TYPED_TEST(ContactFriction, what_a_grain_leaves_is_the_radius_of_an_ellipsoid_in_the_bodys_frame) {
  using S = TypeParam;
  const Grain<S> grain = grain_of<S>({0.25, 0.5, 1}, {0, 1, 0}, 0.5);
  const double near = pick<S>(1e-6, 1e-12, 1e-3, 1e-8);
  for (int i = 0; i < 16; ++i) {
    const double along = kPi / 8 * i;
    const D3 own = {std::cos(along), 0, -std::sin(along)};
    const D3 world = rotated<S>(turn<S>({0, 1, 0}, 0.5), own);
    const double radius = 1 / std::sqrt(own.x * own.x * 16 + own.z * own.z);
    EXPECT_NEAR(to_double(grain.factor_along(unit<S>(world))), radius, near) << along;
  }
  EXPECT_NEAR(to_double(grain.factor_along(unit<S>({0, 1, 0}))), 0.5, near);
  EXPECT_EQ(grain.factor_along(Vec3<Unit<S>>::zero()), S(1));
  EXPECT_EQ(grain_of<S>({1, 1, 1}).factor_along(unit<S>({1, 2, 3})), S(1));
}

TYPED_TEST(ContactFriction, friction_takes_the_most_power_that_its_ellipse_allows) {
  using S = TypeParam;
  Dice dice(17);
  for (int i = 0; i < 50; ++i) {
    const double fx = dice.in(0.05, 1), fy = dice.in(0.05, 1), fz = dice.in(0.05, 1), angle = dice.in(-3, 3);
    const D3 n = dice.direction(), any = dice.direction();
    const D3 slip = any - n * dot(any, n);
    if (length(slip) < 0.2) continue;
    const Grain<S> grain = grain_of<S>({fx, fy, fz}, {0, 0, 1}, angle);
    const Vec3<Unit<S>> normal = unit<S>(n), along = unit<S>(slip);
    const D3 line = real(grain.line_of(normal, along)), s = slip * (1 / length(slip));
    EXPECT_NEAR(length(line), 1, 1e-4);
    EXPECT_NEAR(dot(line, n), 0, pick<S>(1e-5, 1e-12, 2e-2, 1e-6));
    const double power = dot(line, s) * to_double(grain.factor_along(unit<S>(line)));
    const D3 u = s, v = cross(n, s);
    for (int k = 0; k < 64; ++k) {
      const D3 d = u * std::cos(kPi / 32 * k) + v * std::sin(kPi / 32 * k);
      EXPECT_LE(dot(d, s) * to_double(grain.factor_along(unit<S>(d))), power + pick<S>(1e-4, 1e-6, 2e-2, 1e-5));
    }
  }
}

TYPED_TEST(ContactFriction, what_spins_is_left_the_root_mean_square_of_its_ellipses_axes) {
  using S = TypeParam;
  Dice dice(23);
  for (int i = 0; i < 50; ++i) {
    const double fx = dice.in(0.1, 1), fy = dice.in(0.1, 1), fz = dice.in(0.1, 1), angle = dice.in(-3, 3);
    const D3 n = dice.direction();
    const Grain<S> grain = grain_of<S>({fx, fy, fz}, {0, 0, 1}, angle);
    const Tangents<double> across = tangents_of(n);
    double least = 1, most = 0;  // the ellipse's half axes
    for (int k = 0; k < 1024; ++k) {
      const D3 d = across.t * std::cos(kPi / 1024 * k) + across.u * std::sin(kPi / 1024 * k);
      const double radius = to_double(grain.factor_along(unit<S>(d)));
      least = std::min(least, radius);
      most = std::max(most, radius);
    }
    const double seen = to_double(grain.factor_around(unit<S>(n)));
    EXPECT_NEAR(seen, std::sqrt((least * least + most * most) / 2), pick<S>(1e-4, 1e-4, 1e-2, 1e-4));
  }
  EXPECT_EQ(grain_of<S>({1, 1, 1}).factor_around(unit<S>({1, 2, 3})), S(1));
  const double tiny = 1.0 / 64;  // the least that a material may have
  EXPECT_NEAR(to_double(grain_of<S>({tiny, tiny, tiny}).factor_around(unit<S>({1, 2, 3}))), tiny, tiny / 16);
  EXPECT_NEAR(to_double(grain_of<S>({1, tiny, tiny}).factor_around(unit<S>({1, 0, 0}))), tiny, tiny / 16);
}

TYPED_TEST(ContactFriction, of_two_grains_that_of_which_less_is_left_counts) {
  using S = TypeParam;
  const Grain<S> a = grain_of<S>({0.25, 1, 1}), b = grain_of<S>({1, 1, 0.5}), none = grain_of<S>({1, 1, 1});
  EXPECT_EQ(factor_along(a, b, unit<S>({1, 0, 0})), S(0.25));
  EXPECT_EQ(factor_along(a, b, unit<S>({0, 0, 1})), S(0.5));
  EXPECT_EQ(factor_along(a, none, unit<S>({0, 0, 1})), S(1));
  const Vec3<Unit<S>> n = unit<S>({0, 1, 0}), slip = unit<S>({0.6, 0, 0.8});
  EXPECT_EQ(friction_line(none, none, n, slip), slip);
  EXPECT_EQ(friction_line(a, none, n, slip), a.line_of(n, slip));
  EXPECT_EQ(friction_line(none, b, n, slip), b.line_of(n, slip));
}

TYPED_TEST(ContactFriction, bodies_that_trade_places_get_mirrored_friction) {
  using S = TypeParam;
  Dice dice(5);
  for (int i = 0; i < 100; ++i) {
    SurfaceContact<S> one;
    one.friction = num<S>(0.4);
    one.static_friction = num<S>(0.7);
    const auto draw = [&] {
      const double x = dice.in(0.05, 1), y = dice.in(0.05, 1), z = dice.in(0.05, 1);
      const D3 axis = dice.direction();
      return dice.one_in(3) ? grain_of<S>({1, 1, 1}) : grain_of<S>({x, y, z}, axis, dice.in(-3, 3));
    };
    one.a = draw();
    one.b = dice.one_in(4) ? one.a : draw();
    one.slip = velocity<S>(dice.arrow(0, 1));
    one.first_slip = velocity<S>(dice.arrow(0, 0.1));
    one.load = num<Velocity<S>>(dice.in(0, 2));
    const Vec3<Velocity<S>> borne = velocity<S>(dice.arrow(0, 0.1));
    ContactGeometry<S> g = {}, mirrored = {};
    g.normal = unit<S>(dice.direction());
    mirrored.normal = -g.normal;
    SurfaceContact<S> other = one;
    std::swap(other.a, other.b);
    other.slip = -one.slip;
    other.first_slip = -one.first_slip;
    choose_friction(one, borne, g);
    choose_friction(other, -borne, mirrored);
    const double half = kIsFixed<S> ? 1.5 * grain<S>() : 0;  // fixed point rounds halves up, not away from zero
    EXPECT_NEAR(to_double(g.material.friction), to_double(mirrored.material.friction), half);
    expect_near(real(g.material.surface_velocity), -real(mirrored.material.surface_velocity), half);
  }
}

TYPED_TEST(ContactFriction, what_slips_has_the_dynamic_coefficient_and_what_trembles_the_static_one) {
  using S = TypeParam;
  SurfaceContact<S> c = {num<S>(0.4), num<S>(0.7), grain_of<S>({1, 1, 1}), grain_of<S>({1, 1, 1}), {}, {}, {}};
  const auto chosen = [&](D3 slip, D3 first) {
    ContactGeometry<S> g = {};
    g.normal = unit<S>({0, 1, 0});
    c.slip = velocity<S>(slip);
    c.first_slip = velocity<S>(first);
    choose_friction(c, {}, g);
    EXPECT_EQ(g.material.surface_velocity, Vec3<S>::zero());
    return g.material.friction;
  };
  EXPECT_EQ(chosen({0, 0, 0}, {0, 0, 0}), num<S>(0.7));
  EXPECT_EQ(chosen({0.04, 5, 0}, {0, 5, 0.04}), num<S>(0.7)) << "what parts does not slide";
  EXPECT_EQ(chosen({0.06, 0, 0}, {0, 0, 0}), num<S>(0.4));
  EXPECT_EQ(chosen({0, 0, 0}, {0, 0, 0.06}), num<S>(0.4)) << "what spins slides";
}

TYPED_TEST(ContactFriction, the_table_finds_a_pair_in_either_order_and_no_other) {
  using S = TypeParam;
  Registry<MaterialPair<S>, MaterialPairId> pairs;
  MaterialTable<S> table;
  table.update(pairs);
  EXPECT_EQ(table.find(1, 2), nullptr);
  std::vector<MaterialPairId> ids;
  for (std::uint32_t a = 40; a >= 1; --a) {
    MaterialPair<S> pair;
    pair.kind_a = a;
    pair.kind_b = 41 - a % 7;
    pair.friction = num<S>(a / 64.0);
    ids.push_back(pairs.add(pair));
  }
  pairs.remove(ids[5]);
  table.update(pairs);
  for (std::uint32_t a = 40; a >= 1; --a) {
    const std::uint32_t b = 41 - a % 7;
    const MaterialPair<S>*one = table.find(a, b), *other = table.find(b, a);
    EXPECT_EQ(one, other);
    if (a == 35) continue;
    ASSERT_NE(one, nullptr) << a;
    EXPECT_TRUE((one->kind_a == a && one->kind_b == b) || (one->kind_a == b && one->kind_b == a));
  }
  EXPECT_EQ(table.find(1, 1), nullptr);
  EXPECT_EQ(table.find(0, 0), nullptr);
  EXPECT_EQ(table.find(0, 40), nullptr);
}

TYPED_TEST(ContactFriction, presets_are_the_books_table) {
  using S = TypeParam;
  const auto expect = [](FrictionPreset<S> preset, double rest, double slide) {
    EXPECT_NEAR(to_double(preset.static_friction), rest, 1e-4);
    EXPECT_NEAR(to_double(preset.friction), slide, 1e-4);
    const MaterialPair<S> pair = preset.between(3, 9);
    EXPECT_EQ(pair.kind_a, 3u);
    EXPECT_EQ(pair.kind_b, 9u);
    EXPECT_EQ(pair.friction, preset.friction);
    EXPECT_EQ(pair.static_friction, preset.static_friction);
    EXPECT_EQ(preset.material().static_friction, preset.static_friction);
    EXPECT_EQ(preset.material().friction, preset.friction);
  };
  expect(presets::crate_on_concrete<S>(), 0.5, 0.4);
  expect(presets::crate_on_ice<S>(), 0.2, 0.1);
  expect(presets::glass_on_ice<S>(), 0.1, 0.03);
  expect(presets::glass_on_glass<S>(), 0.95, 0.4);
  expect(presets::metal_on_metal<S>(), 0.6, 0.4);
  expect(presets::lubricated_metal<S>(), 0.1, 0.05);
  expect(presets::rubber_on_concrete<S>(), 1.0, 0.8);
  expect(presets::wet_rubber_on_concrete<S>(), 0.7, 0.5);
  expect(presets::racing_tyre_on_concrete<S>(), 1.5, 1.0);
  expect(presets::velcro_on_velcro<S>(), 6, 4);
}

}  // namespace contact_friction_test
}  // namespace isostep::test
