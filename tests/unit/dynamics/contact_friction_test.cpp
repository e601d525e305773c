// The choice of a contact's coefficient, the table of pairs, and the presets.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/contact_friction.hpp"

#include "isostep/dynamics/friction_presets.hpp"
#include "isostep/dynamics/kind_table.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace contact_friction_test {

template <class S> class ContactFriction : public ::testing::Test {};
TYPED_TEST_SUITE(ContactFriction, AllScalars);

template <class S> Vec3<Velocity<S>> velocity(D3 v) {
  return {num<Velocity<S>>(v.x), num<Velocity<S>>(v.y), num<Velocity<S>>(v.z)};
}

TYPED_TEST(ContactFriction, what_slips_has_the_dynamic_coefficient_and_what_trembles_the_static_one) {
  using S = TypeParam;
  const Grain<S> plain = {vec<S>(1, 1, 1), to_matrix(Quat<Unit<S>>::identity())};
  SurfaceContact<S> c = {num<S>(0.4), num<S>(0.7), plain, plain, {}, {}};
  const auto chosen = [&](D3 slip, D3 first) {
    ContactGeometry<S> g = {};
    g.normal = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};
    c.slip = velocity<S>(slip);
    c.first_slip = velocity<S>(first);
    choose_friction(c, g);
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
