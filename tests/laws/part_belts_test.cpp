// Laws of SurfaceVelocity records of parts: each child of a shape runs its own way, in place of the whole body's.
// SPDX-License-Identifier: MIT

#include "built.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/store/state_validator.hpp"
#include "laws/exact_rollback.hpp"

namespace isostep::test {
namespace part_belts_test {

const char* name_of(SolverName solver) { return kSolverNames[static_cast<int>(solver)]; }

template <class S> class PartBelts : public ::testing::Test {
 protected:
  void begin(SolverName solver = SolverName::soft_step) {
    Settings<S> s = settings<S>();
    s.solver = solver;
    w = World<S>(s);
  }
  /// Planks along x side by side, 2 m from middle to middle, the first at z = 0; their tops are at y = 0.
  BodyId planks(int count, BodyType type = BodyType::static_) {
    std::vector<Child<S>> parts;
    for (int i = 0; i < count; ++i)
      parts.push_back(part_at(primitive_of(Box<S>{vec<S>(8, 0.25, 0.875)}), {0, -0.25, 2.0 * i}));
    return body_of(parts, {}, type);
  }
  BodyId body_of(const std::vector<Child<S>>& parts, const std::vector<BlobRef>& blobs = {},
                 BodyType type = BodyType::static_) {
    BodyDefinition<S> d = still<S>(w.add_shape(std::span<const Child<S>>(parts), blobs));
    d.type = type;
    d.material.friction = num<S>(0.5);
    return w.create(d);
  }
  BodyId crate(double z, double x = 0) {
    BodyDefinition<S> d = moving<S>(add_box(w, 0.25, 0.25, 0.25), {x, 0.25, z});
    d.material.friction = num<S>(0.5);
    return w.create(d);
  }
  SurfaceVelocity<S> belt(BodyId body, D3 linear, std::uint32_t part = kEveryPart, D3 angular = {0, 0, 0}) {
    return {body, vec<S>(linear), vec<S>(angular), part};
  }
  void drive(BodyId body, D3 linear, std::uint32_t part = kEveryPart) {
    ASSERT_TRUE(w.add(belt(body, linear, part))) << describe(w.fault());
  }
  D3 speed(BodyId body) const { return real(w.velocity(body)); }

  World<S> w{settings<S>()};
};
TYPED_TEST_SUITE(PartBelts, AllScalars);

// Half a percent of 2 m/s, as for a belt that is a body of its own.
TYPED_TEST(PartBelts, two_belts_of_one_body_run_opposite_ways_and_a_third_part_stands) {
  for (const SolverName solver : kBuiltSolvers) {
    for (const BodyType type : {BodyType::static_, BodyType::kinematic}) {
      this->begin(solver);
      const BodyId body = this->planks(3, type);
      this->drive(body, {2, 0, 0}, 0);
      this->drive(body, {-2, 0, 0}, 1);
      const BodyId there = this->crate(0), back = this->crate(2), stays = this->crate(4);
      run(this->w, 60);
      EXPECT_NEAR(this->speed(there).x, 2, 0.01) << name_of(solver);
      EXPECT_NEAR(this->speed(back).x, -2, 0.01) << name_of(solver);
      EXPECT_NEAR(this->speed(stays).x, 0, 1e-3) << name_of(solver);
      EXPECT_NEAR(to_double(this->w.center_of_mass(stays).x), 0, 1e-3) << name_of(solver);
    }
  }
}

TYPED_TEST(PartBelts, a_part_of_its_own_stands_in_place_of_the_whole_body) {
  this->begin();
  const BodyId body = this->planks(3);
  this->drive(body, {1, 0, 0});
  this->drive(body, {-2, 0, 0}, 1);
  this->drive(body, {0, 0, 0}, 2);  // stands still where the body runs
  const BodyId whole = this->crate(0), own = this->crate(2), still = this->crate(4);
  run(this->w, 60);
  EXPECT_NEAR(this->speed(whole).x, 1, 0.005);
  EXPECT_NEAR(this->speed(own).x, -2, 0.01);
  EXPECT_NEAR(this->speed(still).x, 0, 1e-3);
  run(this->w, 60);
  EXPECT_TRUE(this->w.is_awake(whole));
  EXPECT_TRUE(this->w.is_awake(own));
  EXPECT_FALSE(this->w.is_awake(still)) << "nothing carries it";
}

// Twelve parts have a tree.
TYPED_TEST(PartBelts, shapes_of_many_parts_have_them_too) {
  this->begin();
  const BodyId body = this->planks(12);
  for (std::uint32_t i = 0; i < 12; i += 2) this->drive(body, {i % 4 == 0 ? 2.0 : -2.0, 0, 0}, i);
  std::vector<BodyId> crates;
  for (int i = 0; i < 12; ++i) crates.push_back(this->crate(2.0 * i));
  run(this->w, 60);
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_NEAR(this->speed(crates[i]).x, i % 2 != 0 ? 0 : i % 4 == 0 ? 2 : -2, 0.01) << i;
}

// A mesh counts a leaf a triangle: what stands behind it in the list has other numbers in contacts than in the shape.
TYPED_TEST(PartBelts, triangles_of_a_mesh_and_the_parts_behind_it_are_told_apart) {
  using S = TypeParam;
  for (const bool mesh_runs : {true, false}) {
    this->begin();
    std::vector<D3> points;
    std::vector<MeshTriangle> triangles;
    for (std::uint32_t i = 0; i < 9; ++i) {
      for (const double z : {-1.0, 1.0}) points.push_back({2.0 * i - 8, 0, z});
      if (i == 0) continue;
      const std::uint32_t at = 2 * (i - 1);
      triangles.push_back({{at, at + 1, at + 2}});
      triangles.push_back({{at + 3, at + 2, at + 1}});
    }
    const std::vector<Child<S>> parts = {part_at(primitive_of(Box<S>{vec<S>(8, 0.25, 0.875)}), {0, -0.25, -2}),
                                         part_at(primitive_of(Mesh<S>{1}), {0, 0, 0}),
                                         part_at(primitive_of(Box<S>{vec<S>(8, 0.25, 0.875)}), {0, -0.25, 2})};
    const BodyId body = this->body_of(parts, {mesh_blob(points, triangles).value()});
    ASSERT_TRUE(body) << describe(this->w.fault());
    this->drive(body, {2, 0, 0}, mesh_runs ? 1 : 2);
    const BodyId box = this->crate(-2), on_mesh = this->crate(0), behind = this->crate(2);
    run(this->w, 60);
    EXPECT_NEAR(this->speed(box).x, 0, 0.01);
    EXPECT_NEAR(this->speed(on_mesh).x, mesh_runs ? 2 : 0, 0.01);
    EXPECT_NEAR(this->speed(behind).x, mesh_runs ? 0 : 2, 0.01);
  }
}

// About the body's origin, a metre from the part's middle.
TYPED_TEST(PartBelts, a_turning_part_turns_about_the_bodys_origin) {
  using S = TypeParam;
  this->begin();
  const std::vector<Child<S>> parts = {part_at(primitive_of(Box<S>{vec<S>(2, 0.25, 2)}), {0, -0.25, 0}),
                                       part_at(primitive_of(Box<S>{vec<S>(2, 0.25, 2)}), {8, -0.25, 0})};
  const BodyId body = this->body_of(parts);
  ASSERT_TRUE(this->w.add(this->belt(body, {0, 0, 0}, 0, {0, 1, 0})));
  const BodyId rider = this->crate(0, 1), other = this->crate(0, 8);
  run(this->w, 120);
  const D3 at = real(this->w.center_of_mass(rider)), v = this->speed(rider);
  EXPECT_NEAR(v.x, at.z, 0.01);
  EXPECT_NEAR(v.z, -at.x, 0.01);
  EXPECT_NEAR(to_double(this->w.angular_velocity(rider).y), 1, 0.01);
  EXPECT_NEAR(length(this->speed(other)), 0, 1e-3);
}

TYPED_TEST(PartBelts, a_character_rides_on_the_part_that_it_stands_on) {
  using S = TypeParam;
  for (const std::uint32_t part : {0u, 1u}) {
    this->begin();
    const BodyId body = this->planks(2);
    this->drive(body, {2, 0, 0}, part);
    CharacterSettings<S> character;
    BodyDefinition<S> d = still<S>(this->w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 0.765625, 2});
    d.type = BodyType::kinematic;
    character.body = this->w.create(d);
    ASSERT_TRUE(this->w.add(character));
    run(this->w, 3);
    const double before = to_double(this->w.pose(character.body).position.x);
    run(this->w, 60);
    EXPECT_NEAR(to_double(this->w.pose(character.body).position.x) - before, part == 1 ? 2 : 0, 0.01);
  }
}

TYPED_TEST(PartBelts, refuse_what_is_no_part_and_change_nothing) {
  using S = TypeParam;
  this->begin();
  const BodyId body = this->planks(2);
  this->drive(body, {1, 0, 0}, 0);
  this->drive(body, {1, 0, 0});
  const SurfaceVelocityId id = this->w.add(this->belt(body, {3, 0, 0}, 1));
  ASSERT_TRUE(id);
  const std::uint64_t before = this->w.hash();
  const auto expect_refused = [&](bool taken, const char* field, const char* expected) {
    EXPECT_FALSE(taken);
    EXPECT_EQ(this->w.fault(), Fault::bad_argument);
    EXPECT_STREQ(this->w.fault().field, field);
    EXPECT_STREQ(this->w.fault().expected, expected);
    EXPECT_EQ(this->w.hash(), before);
  };
  constexpr const char* kNoPart = "kEveryPart, or a child of the body's shape";
  const auto add = [&](std::uint32_t part) {
    return static_cast<bool>(this->w.add(this->belt(body, {1, 0, 0}, part)));
  };
  expect_refused(add(2), "part", kNoPart);
  expect_refused(add(kEveryPart - 1), "part", kNoPart);
  expect_refused(add(0), "part", "a part that has no record yet");
  expect_refused(add(kEveryPart), "body", "a body that has no record yet");
  expect_refused(this->w.set(id, this->belt(body, {1, 0, 0}, 0)), "part", "a part that has no record yet");
  expect_refused(this->w.set(id, this->belt(body, {1, 0, 0}, 7)), "part", kNoPart);
  WorldState<S> state = this->w.state();
  EXPECT_EQ(broken_rule(state), nullptr);
  SurfaceVelocity<S>& record = state.records.change().surface_velocitys.change_all()[id.slot];
  record.part = 0;
  EXPECT_STREQ(broken_rule(state), "two records of a kind are about the same");
  record.part = 2;
  EXPECT_NE(broken_rule(state), nullptr);
}

TYPED_TEST(PartBelts, are_rolled_back_and_equal_on_all_lanes) {
  for (const SolverName solver : kBuiltSolvers) {
    std::vector<std::uint64_t> first;
    for (const Simd simd : {Simd::scalar, Simd::best}) {
      this->begin(solver);
      ASSERT_TRUE(this->w.use_simd(simd));
      const BodyId body = this->planks(4);
      this->drive(body, {0.5, 0, 0});
      this->drive(body, {-1, 0, 0}, 1);
      ASSERT_TRUE(this->w.add(this->belt(body, {0, 0, 0}, 2, {0, 0.25, 0})));
      for (int i = 0; i < 12; ++i) this->crate(2.0 * (i % 4), 1.0 * (i / 4));
      const auto hashes = expect_exact_rollback(this->w, 60, [](auto&, int) {});
      if (first.empty()) first = hashes;
      EXPECT_EQ(hashes, first) << name_of(solver);
    }
  }
}

}  // namespace part_belts_test
}  // namespace isostep::test
