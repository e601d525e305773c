// Lanes, the caller's float environment, addresses and other worlds: none of them may show in a hash.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <memory>

#include "built.hpp"
#include "determinism/hostile_environment.hpp"
#include "determinism/mess.hpp"

namespace isostep::test {
namespace lanes_test {

constexpr std::uint64_t kFrames = 330;

template <class S> std::vector<std::uint64_t> reference(Activity* activity = nullptr) {
  World<S> w(settings<S>(-10, 60, 4));
  w.use_simd(Simd::scalar);
  build_mess(w);
  std::vector<std::uint64_t> hashes;
  for (std::uint64_t f = 0; f < kFrames; ++f) hashes.push_back(play(w, f, activity));
  return hashes;
}
void expect_busy(const Activity& activity) {
  EXPECT_GT(activity.contacts, 40u);
  EXPECT_GT(activity.sleepers, 4u);
  EXPECT_GT(activity.woke, 10u);
  EXPECT_GT(activity.begins, 80u);
  EXPECT_GT(activity.sensed, 3u);
  EXPECT_GT(activity.accepted, 150u);
  EXPECT_GT(activity.spread, 3);
}

template <class S> class SameHashes : public ::testing::Test {
 protected:
  static const std::vector<std::uint64_t>& expected() {
    static const std::vector<std::uint64_t> hashes = reference<S>();
    return hashes;
  }
};
TYPED_TEST_SUITE(SameHashes, AllScalars);

TYPED_TEST(SameHashes, the_scene_is_busy_and_the_same_commands_give_the_same_hashes) {
  Activity activity;
  EXPECT_EQ(reference<TypeParam>(&activity), this->expected());
  expect_busy(activity);
  std::vector<std::uint64_t> sorted = this->expected();
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::unique(sorted.begin(), sorted.end()), sorted.end()) << "two frames alike";
}

TYPED_TEST(SameHashes, with_every_width_of_lanes_and_with_widths_changed_on_the_way) {
  using S = TypeParam;
  int widths = 0;
  for (const Simd simd : {Simd::scalar, Simd::sse2, Simd::avx2, Simd::avx512, Simd::neon, Simd::wasm, Simd::best}) {
    World<S> w(settings<S>(-10, 60, 4));
    if (!w.use_simd(simd)) continue;
    ++widths;
    build_mess(w);
    for (std::uint64_t f = 0; f < kFrames; ++f)
      ASSERT_EQ(play(w, f), this->expected()[f]) << w.simd_name() << " frame " << f;
  }
  EXPECT_GE(widths, 2);
  World<S> w(settings<S>(-10, 60, 4));
  build_mess(w);
  for (std::uint64_t f = 0; f < kFrames; ++f) {
    w.use_simd(static_cast<Simd>(f % 7));
    ASSERT_EQ(play(w, f), this->expected()[f]) << w.simd_name() << " frame " << f;
  }
}

TYPED_TEST(SameHashes, with_every_broad_phase_and_with_those_changed_on_the_way) {
  using S = TypeParam;
  constexpr std::size_t kBuilt = std::size(kBuiltBroadPhases);
  for (std::size_t name = 0; name <= kBuilt; ++name) {
    World<S> w(settings<S>(-10, 60, 4));
    build_mess(w);
    for (std::uint64_t f = 0; f < kFrames / 2; ++f) {
      const BroadPhaseName of_now = kBuiltBroadPhases[name < kBuilt ? name : f / 4 % kBuilt];
      ASSERT_TRUE(w.use_broad_phase(of_now));
      ASSERT_EQ(play(w, f), this->expected()[f]) << kBroadPhaseNames[static_cast<int>(of_now)] << " frame " << f;
    }
  }
  World<S> w;
  EXPECT_FALSE(w.use_broad_phase(static_cast<BroadPhaseName>(kBroadPhases)));
  EXPECT_EQ(w.broad_phase(), BroadPhaseName::box_tree);
}

/// Ragdolls of one shape and a few of others, some on a wall, one on a turntable; joints go, and come between others.
template <class S> std::vector<std::uint64_t> hashes_of_trees(Simd simd, bool changing) {
  World<S> w(settings<S>(-10, 60, 4));
  w.use_simd(simd);
  add_ground(w);
  const ShapeId part = w.add_shape(Capsule<S>{num<S>(0.125), num<S>(0.25)});
  BodyDefinition<S> table = still<S>(add_box(w, 1, 0.25, 1), {0, 1, -6});
  table.type = BodyType::kinematic;
  table.angular_velocity = vec<S>(0, 1, 0);
  const BodyId turntable = w.create(table);
  Dice dice(31);
  const auto ball = [&](BodyId a, BodyId b, D3 at) {
    w.create(w.joint_at(JointType::ball, a, b, {vec<S>(at), Quat<Unit<S>>::identity()}));
  };
  for (int i = 0; i < 23; ++i) {
    const D3 at = {1.5 * (i % 5) - 3, 3 + dice.in(0, 1), 1.5 * (i / 5) - 3};
    const BodyId trunk = w.create(moving<S>(part, at, dice.point(1)));
    for (int k = 0; k < (i < 19 ? 3 : 2); ++k) {
      const D3 side = k == 0 ? D3{0.5, 0.25, 0} : k == 1 ? D3{-0.5, 0.25, 0} : D3{0, 0.75, 0};
      const BodyId limb = w.create(moving<S>(part, at + side, dice.point(1)));
      ball(k == 1 ? limb : trunk, k == 1 ? trunk : limb, at + side * 0.5);
    }
    if (i % 8 == 7) ball(i == 7 ? BodyId{} : turntable, trunk, at + D3{0, -0.375, 0});
  }
  std::vector<std::uint64_t> hashes;
  for (std::uint64_t f = 0; f < 90; ++f) {
    if (changing) w.use_simd(static_cast<Simd>(f % 7));
    const std::vector<JointId> joints = w.joints();
    if (f % 12 == 11) w.destroy(joints[f % joints.size()]);
    if (f % 24 == 23) {
      const std::vector<BodyId> bodies = w.bodies();
      const BodyId a = bodies[f % bodies.size()], b = bodies[(f + 3) % bodies.size()];
      w.create(w.joint_at(JointType::ball, a, b, w.pose(b)));
    }
    w.step();
    hashes.push_back(w.hash());
  }
  return hashes;
}
TYPED_TEST(SameHashes, of_joint_trees_with_every_width_of_lanes) {
  using S = TypeParam;
  const std::vector<std::uint64_t> one = hashes_of_trees<S>(Simd::scalar, false);
  for (const Simd simd : {Simd::sse2, Simd::avx2, Simd::avx512, Simd::neon, Simd::wasm, Simd::best}) {
    if (!World<S>().use_simd(simd)) continue;
    EXPECT_EQ(hashes_of_trees<S>(simd, false), one) << static_cast<unsigned>(simd);
  }
  EXPECT_EQ(hashes_of_trees<S>(Simd::best, true), one);
}

TYPED_TEST(SameHashes, with_heap_blocks_come_and_gone_and_many_worlds_in_turn) {
  using S = TypeParam;
  Dice dice(99);
  std::vector<std::vector<std::uint8_t>> litter(64);
  const auto scatter = [&] {
    for (int i = 0; i < 8; ++i) litter[dice.below(64)] = std::vector<std::uint8_t>(dice.below(30000), 0xa5);
  };
  std::vector<std::unique_ptr<World<S>>> worlds;
  for (int i = 0; i < 5; ++i) {
    scatter();
    worlds.push_back(std::make_unique<World<S>>(settings<S>(-10, 60, 4)));
    scatter();
    build_mess(*worlds.back());
  }
  // One of them is a stranger: it must not show in its neighbours.
  for (std::uint64_t f = 0; f < 50; ++f) play(*worlds[2], 4000 + f);
  for (std::uint64_t f = 0; f < kFrames; ++f) {
    for (std::size_t i = 0; i < worlds.size(); ++i) {
      if (i == 2) {
        play(*worlds[i], 9000 + f);
        continue;
      }
      scatter();
      if (dice.below(20) == 0) {
        World<S> moved(std::move(*worlds[i]));
        scatter();
        *worlds[i] = std::move(moved);
      }
      ASSERT_EQ(play(*worlds[i], f), this->expected()[f]) << "world " << i << " frame " << f;
    }
  }
}

TYPED_TEST(SameHashes, whatever_is_asked_of_the_world_on_the_way) {
  using S = TypeParam;
  World<S> w(settings<S>(-10, 60, 4));
  build_mess(w);
  Dice dice(5);
  std::vector<BodyId> found;
  std::size_t answers = 0;
  for (std::uint64_t f = 0; f < kFrames; ++f) {
    answers += w.cast_ray(vec<S>(dice.point(5) + D3{0, 6, 0}), vec<S>(0, -12, 0)).has_value() ? 1u : 0u;
    answers += w.closest_point(vec<S>(dice.point(5)), S(2)).has_value() ? 1u : 0u;
    w.overlap_shape(primitive_of(Sphere<S>{S(1)}), {vec<S>(dice.point(2)), Quat<Unit<S>>::identity()}, found);
    answers += w.poses_float(0.25f).size();
    const std::vector<std::uint8_t> bytes = bytes_of(w);
    answers += bytes.size();
    ASSERT_EQ(play(w, f), this->expected()[f]) << "frame " << f;
  }
  EXPECT_GT(answers, kFrames);
  EXPECT_GT(found.size(), kFrames / 2);
}

#if defined(ISOSTEP_HOSTILE_ENVIRONMENTS)
/// Numbers enter before the environment turns hostile: what a caller computes in it is the caller's.
template <class S> struct Script {
  Vec3<S> impulse, point, force, speed;
  Pose<S> pose;
};
template <class S> Script<S> script_of(std::uint64_t frame) {
  Dice dice(frame);
  return {vec<S>(dice.point(2)),
          vec<S>(dice.point(1)),
          vec<S>(dice.point(9)),
          vec<S>(dice.point(2)),
          {vec<S>(dice.point(3) + D3{0, 5, 0}), dice.orientation<S>()}};
}

template <class S> std::vector<std::uint64_t> run_scripted(std::uint32_t control, bool hostile) {
  World<S> w(settings<S>(-10, 60, 4));
  const Mess<S> m = build_mess(w);
  const BodyDefinition<S> d = [&] {
    BodyDefinition<S> x = moving<S>(m.hammer, {0.3, 9.1, 0.7}, {0.1, 0.2, 0.3});
    x.orientation = turn<S>({0.6, 0, 0.8}, 0.7);
    x.mass = num<S>(1.7);
    return x;
  }();
  const Child<S> parts[] = {
      {primitive_of(Box<S>{vec<S>(0.31, 0.17, 0.23)}), {vec<S>(0.1, 0.2, 0.3), turn<S>({0, 0.6, 0.8}, 0.3)}},
      {primitive_of(Sphere<S>{num<S>(0.37)}), {vec<S>(0.3, -0.2, 0.1), Quat<Unit<S>>::identity()}}};
  std::vector<std::uint64_t> hashes;
  for (std::uint64_t f = 0; f < 90; ++f) {
    const Script<S> s = script_of<S>(f);
    if (hostile) Hostile::set(control);
    if (f == 5) {
      BodyDefinition<S> made = d;
      made.shape = w.add_shape(std::span<const Child<S>>(parts));
      w.create(made);
    }
    if (f % 7 == 3) w.create(d);
    const BodyId a = m.moving[f % m.moving.size()], b = m.moving[(f * 5 + 1) % m.moving.size()];
    w.apply_impulse_at(a, s.impulse, s.point);
    w.apply_force_at(b, s.force, s.point);
    w.apply_impulse(b, s.impulse, s.point);
    if (f % 5 == 0) w.set_pose(b, s.pose);
    if (f % 11 == 0) w.set_velocity(a, s.speed, s.impulse);
    if (f % 13 == 4) {
      const JointId j = w.create(w.joint_at(JointType::hinge, a, {}, s.pose));
      w.step();
      w.destroy(j);
    }
    w.step();
    hashes.push_back(w.hash());
    if (hostile) {
      EXPECT_EQ(Hostile::control(), control) << "the caller's environment came back changed";
      Hostile::set(kMasks);
    }
  }
  return hashes;
}

TYPED_TEST(SameHashes, in_whatever_float_environment_the_caller_left) {
  using S = TypeParam;
  const std::vector<std::uint64_t> plain = run_scripted<S>(kMasks, false);
  for (const std::uint32_t control :
       {0u, kMasks | kDown, kMasks | kUp, kMasks | kTowardsZero, kMasks | kFlush, kMasks | kDenormalsAreZero,
        kMasks | kDown | kFlush | kDenormalsAreZero, kMasks | kUp | kFlush | kDenormalsAreZero}) {
    const Hostile scope(kMasks);
    const std::vector<std::uint64_t> hostile = run_scripted<S>(control, true);
    for (std::size_t f = 0; f < plain.size(); ++f)
      ASSERT_EQ(hostile[f], plain[f]) << "control " << control << " frame " << f;
  }
}

TYPED_TEST(SameHashes, and_the_same_answers_to_questions_in_whatever_environment) {
  using S = TypeParam;
  World<S> w(settings<S>(-10, 60, 4));
  const Mess<S> m = build_mess(w);
  for (std::uint64_t f = 0; f < 60; ++f) w.step();
  const auto ask = [&](std::uint32_t control) {
    std::vector<std::uint8_t> bytes;
    Writer writer(bytes);
    const Vec3<S> from = vec<S>(0.3, 9, 0.2), down = vec<S>(0.1, -12, 0.3);
    Hostile::set(control);
    if (const auto hit = w.cast_ray(from, down)) {
      writer.write(hit->point);
      writer.write(hit->normal);
      writer.write(hit->fraction);
    }
    if (const auto near = w.closest_point(from, S(20))) {
      writer.write(near->point);
      writer.write(near->distance);
    }
    for (const BodyId id : m.moving) writer.write(w.pose(id));
    for (const JointId id : w.joints()) writer.write(w.joint_error(id));
    writer.write(w.joint_at(JointType::ball, m.moving[3], m.moving[7], w.pose(m.moving[3])));
    Hostile::set(kMasks);
    return bytes;
  };
  const Hostile scope(kMasks);
  const std::vector<std::uint8_t> plain = ask(kMasks);
  EXPECT_GT(plain.size(), 500u);
  for (const std::uint32_t control : {kDown, kUp, kTowardsZero, kFlush | kDenormalsAreZero}) {
    EXPECT_EQ(ask(kMasks | control), plain) << control;
  }
}
#endif

}  // namespace lanes_test
}  // namespace isostep::test
