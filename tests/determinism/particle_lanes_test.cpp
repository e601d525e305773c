// Lanes, the caller's float environment, addresses and other worlds: none of them may show in a particle world's hash.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>

#include "determinism/hostile_environment.hpp"
#include "determinism/particle_mess.hpp"
#include "isostep/state/hash.hpp"

namespace isostep::test {
namespace particle_lanes_test {

constexpr std::uint64_t kFrames = 100;

template <class S>
std::vector<std::uint64_t> hashes_with(Simd simd, std::uint32_t way, ParticleActivity* activity = nullptr) {
  ParticleWorld<S> w(settings_of_way<S>(way));
  w.use_simd(simd);
  build_particle_mess(w);
  return play_on(w, 0, kFrames, activity);
}

template <class S> class SameParticleHashes : public ::testing::Test {};
TYPED_TEST_SUITE(SameParticleHashes, AllScalars);

TYPED_TEST(SameParticleHashes, the_scene_is_busy_whichever_way_it_is_stepped_and_every_way_is_another) {
  using S = TypeParam;
  std::vector<std::uint64_t> all;
  for (std::uint32_t way = 0; way < kParticleWays; ++way) {
    SCOPED_TRACE(way);
    ParticleActivity activity;
    const std::vector<std::uint64_t> hashes = hashes_with<S>(Simd::scalar, way, &activity);
    activity.expect_busy();
    all.insert(all.end(), hashes.begin(), hashes.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::unique(all.begin(), all.end()), all.end()) << "two frames alike";
}

TYPED_TEST(SameParticleHashes, with_every_width_of_lanes_and_every_way_to_step) {
  using S = TypeParam;
  int widths = 0;
  for (std::uint32_t way = 0; way < kParticleWays; ++way) {
    const std::vector<std::uint64_t> expected = hashes_with<S>(Simd::scalar, way);
    for (const Simd simd : {Simd::sse2, Simd::avx2, Simd::avx512, Simd::neon, Simd::wasm}) {
      if (!ParticleWorld<S>().use_simd(simd)) continue;
      ++widths;
      ASSERT_EQ(hashes_with<S>(simd, way), expected) << static_cast<unsigned>(simd) << " way " << way;
    }
  }
  if (widths == 0 && kIsFixed<S>) GTEST_SKIP() << "lanes of fixed point are AVX's, which this build leaves out";
  EXPECT_GT(widths, 0) << "no lanes to compare with";
}

/// Signed zeros everywhere: what has no drag lies beside what has some, in lanes of every width and in none.
TYPED_TEST(SameParticleHashes, though_a_neighbour_has_drag_and_zeros_have_signs) {
  using S = TypeParam;
  const auto hash_with = [](Simd simd) {
    ParticleWorld<S> w({.gravity = Vec3<S>{S(0), S(1), S(0)} * S(-10)});  // -0 across
    w.use_simd(simd);
    ParticleMaterial<S> dust;
    dust.linear_drag = S(0.125);
    const ParticleMaterialId dusty = w.add(dust);
    for (int i = 0; i < 21; ++i) {
      const ParticleId p = w.create({.position = {S(i), S(0), S(0)}, .velocity = -Vec3<S>{S(0), S(2), S(0)}});
      if (i % 2 == 1) w.set_material(p, dusty);
    }
    w.step();
    return w.hash();
  };
  for (const Simd simd : {Simd::sse2, Simd::avx2, Simd::avx512, Simd::neon, Simd::wasm}) {
    if (!ParticleWorld<S>().use_simd(simd)) continue;
    EXPECT_EQ(hash_with(simd), hash_with(Simd::scalar)) << static_cast<unsigned>(simd);
  }
}

TYPED_TEST(SameParticleHashes, with_widths_changed_on_the_way) {
  using S = TypeParam;
  for (const std::uint32_t way : {0u, 1u, 7u}) {
    const std::vector<std::uint64_t> expected = hashes_with<S>(Simd::scalar, way);
    ParticleWorld<S> w(settings_of_way<S>(way));
    build_particle_mess(w);
    for (std::uint64_t f = 0; f < kFrames; ++f) {
      w.use_simd(static_cast<Simd>(f % 7));
      ASSERT_EQ(play(w, f), expected[f]) << w.simd_name() << " frame " << f;
    }
  }
}

/// Nothing joins them, so blocks go through all sub-steps at once; counts that fill no lane and no block.
TYPED_TEST(SameParticleHashes, of_a_cloud_that_flies_freely) {
  using S = TypeParam;
  const auto fly = [](Simd simd, int count, bool joined) {
    ParticleWorld<S> w(particle_settings<S>(-10, 4));
    w.use_simd(simd);
    std::vector<ParticleMaterialId> materials;
    for (int i = 0; i < 5; ++i) {
      ParticleMaterial<S> m;
      m.gravity_scale = num<S>(0.25 * i - 0.25);
      m.damping = num<S>(1 - 0.1875 * i);
      m.linear_drag = num<S>(i % 2 == 0 ? 0 : 0.125);
      m.quadratic_drag = num<S>(i < 3 ? 0 : 0.0625);
      materials.push_back(w.add(m));
    }
    Chance chance(3);
    ParticleId first;
    for (int i = 0; i < count; ++i) {
      const double mass = chance.in(0.0625, 8);
      const D3 velocity = chance.point(20), at = chance.point(20);
      ParticleDefinition<S> d = particle_at<S>(at, velocity, mass);
      d.material = materials[static_cast<std::size_t>(i < count / 2 ? i / 40 % 5 : i % 5)];
      d.pinned = i % 17 == 3;
      const ParticleId id = w.create(d);
      if (i == 0) first = id;
      if (i % 13 == 5) w.destroy(id);
    }
    // A force that does nothing sends all of them the other way through the step.
    if (joined) w.add(force_of<S>(ForceType::gravity, first));
    std::vector<std::uint64_t> hashes;
    for (int f = 0; f < 20; ++f) {
      EXPECT_TRUE(w.step().clean());
      HashCombiner motion;
      for (const ParticleId id : w.particles()) {
        for (int axis = 0; axis < 3; ++axis) {
          motion.add(to_bits(w.position(id)[axis]));
          motion.add(to_bits(w.velocity(id)[axis]));
        }
      }
      hashes.push_back(motion.value());
    }
    return hashes;
  };
  for (const int count : {1, 3, 31, 1100}) {
    const std::vector<std::uint64_t> one = fly(Simd::scalar, count, false);
    EXPECT_NE(one.front(), one.back());
    EXPECT_EQ(fly(Simd::scalar, count, true), one) << count;
    for (const Simd simd : {Simd::sse2, Simd::avx2, Simd::avx512, Simd::neon, Simd::wasm}) {
      if (!ParticleWorld<S>().use_simd(simd)) continue;
      EXPECT_EQ(fly(simd, count, false), one) << static_cast<unsigned>(simd) << " count " << count;
    }
  }
}

TYPED_TEST(SameParticleHashes, with_heap_blocks_come_and_gone_and_many_worlds_in_turn) {
  using S = TypeParam;
  const std::vector<std::uint64_t> expected = hashes_with<S>(Simd::best, 4);
  Chance chance(99);
  std::vector<std::vector<std::uint8_t>> litter(64);
  const auto scatter = [&] {
    for (int i = 0; i < 8; ++i) litter[chance.below(64)] = std::vector<std::uint8_t>(chance.below(30000), 0xa5);
  };
  std::vector<std::unique_ptr<ParticleWorld<S>>> worlds;
  for (int i = 0; i < 4; ++i) {
    scatter();
    worlds.push_back(std::make_unique<ParticleWorld<S>>(settings_of_way<S>(4)));
    scatter();
    build_particle_mess(*worlds.back());
  }
  for (std::uint64_t f = 0; f < kFrames; ++f) {
    for (std::size_t i = 0; i < worlds.size(); ++i) {
      if (i == 2) {  // a stranger: it must not show in its neighbours
        play(*worlds[i], 9000 + f);
        continue;
      }
      scatter();
      if (chance.one_in(20)) {
        ParticleWorld<S> moved(std::move(*worlds[i]));
        scatter();
        *worlds[i] = std::move(moved);
      }
      ASSERT_EQ(play(*worlds[i], f), expected[f]) << "world " << i << " frame " << f;
    }
  }
}

#if defined(ISOSTEP_HOSTILE_ENVIRONMENTS)
/// Numbers enter before the environment turns hostile: what a caller computes in it is the caller's.
template <class S> struct ParticleScript {
  Vec3<S> impulse, force, speed, place;
  ParticleDefinition<S> birth;
  ParticleMaterial<S> material;
  Spring<S> spring;
};
template <class S> ParticleScript<S> particle_script_of(std::uint64_t frame, const ParticleMess& m) {
  Chance chance(frame);
  ParticleScript<S> s;
  s.impulse = vec<S>(chance.point(2));
  s.force = vec<S>(chance.point(9));
  s.speed = vec<S>(chance.point(2));
  s.place = vec<S>(chance.point(3) + D3{0, 5, 0});
  const D3 velocity = chance.point(1), at = chance.point(3) + D3{0, 4, 0};
  s.birth = particle_at<S>(at, velocity, 1.7);
  s.birth.lifetime = 20;
  s.material = ball_material<S>(0.3, 0.3, 0.3);
  s.material.linear_drag = num<S>(1e-3);
  s.spring = spring_of<S>(m.balls[frame % m.balls.size()], {}, chance.in(1, 30), 0.7);
  return s;
}
/// Runs with denormals in the state where the scalar has them, saved and loaded on the way.
template <class S> std::vector<std::uint64_t> run_scripted(std::uint32_t way, std::uint32_t control, bool hostile) {
  ParticleWorld<S> w(settings_of_way<S>(way));
  const ParticleMess m = build_particle_mess(w);
  typename ParticleWorld<S>::Snapshot saved;
  std::vector<std::uint64_t> hashes;
  S masses = S(0);
  for (std::uint64_t f = 0; f < 36; ++f) {
    const ParticleScript<S> s = particle_script_of<S>(f, m);
    Vec3<S> tiny = Vec3<S>::zero();
    if constexpr (!kIsFixed<S>) tiny.x = std::numeric_limits<S>::denorm_min() * S(3);
    if (hostile) Hostile::set(control);
    const ParticleId a = m.balls[f % m.balls.size()], b = m.tossed[f * 5 % m.tossed.size()];
    w.apply_impulse(a, s.impulse);
    w.apply_force(b, s.force);
    if (f % 4 == 1) w.place(b, s.place, s.speed);
    if (f % 4 == 3) w.place(a, tiny, tiny);
    if (f % 9 == 0) w.add(s.spring);
    if (f % 7 == 3) w.create(s.birth);
    if (f == 11) w.set(w.add(s.material), s.material);
    w.save(saved);
    w.step();
    if (f % 3 == 0) {
      w.load(saved);
      w.step();
    }
    const S mass = w.mass(b);
    hashes.push_back(w.hash());
    if (hostile) {
      EXPECT_EQ(Hostile::control(), control) << "the caller's environment came back changed";
      Hostile::set(kMasks);
    }
    masses = masses + mass;
    hashes.push_back(to_bits(masses));
  }
  return hashes;
}

TYPED_TEST(SameParticleHashes, in_whatever_float_environment_the_caller_left) {
  using S = TypeParam;
  for (std::uint32_t way = 0; way < kParticleWays; ++way) {
    const std::vector<std::uint64_t> plain = run_scripted<S>(way, kMasks, false);
    for (const std::uint32_t control :
         {0u, kMasks | kDown, kMasks | kTowardsZero, kMasks | kUp | kFlush | kDenormalsAreZero}) {
      const Hostile scope(kMasks);
      const std::vector<std::uint64_t> hostile = run_scripted<S>(way, control, true);
      for (std::size_t f = 0; f < plain.size(); ++f)
        ASSERT_EQ(hostile[f], plain[f]) << "way " << way << " control " << control << " frame " << f / 2;
    }
  }
}

TYPED_TEST(SameParticleHashes, and_the_same_portable_form_in_whatever_environment) {
  using S = TypeParam;
  ParticleWorld<S> w(settings_of_way<S>(0));
  const ParticleMess m = build_particle_mess(w);
  play_on(w, 0, 60);
  if constexpr (!kIsFixed<S>) {
    const Vec3<S> tiny = {std::numeric_limits<S>::denorm_min(), S(0), -std::numeric_limits<S>::denorm_min()};
    ASSERT_TRUE(w.place(m.tossed[1], tiny, tiny));
  }
  const std::vector<std::uint8_t> plain = bytes_of(w);
  const Hostile scope(kMasks);
  for (const std::uint32_t control : {kDown, kUp, kTowardsZero, kFlush | kDenormalsAreZero}) {
    Hostile::set(kMasks | control);
    const std::vector<std::uint8_t> bytes = bytes_of(w);
    ParticleWorld<S> rebuilt;
    Reader reader(bytes);
    const bool read = rebuilt.read_portable(reader).ok();
    const std::uint64_t hash = rebuilt.hash();
    Hostile::set(kMasks);
    EXPECT_TRUE(bytes == plain) << control;
    EXPECT_TRUE(read) << control;
    EXPECT_EQ(hash, w.hash()) << control;
  }
}
#endif

}  // namespace particle_lanes_test
}  // namespace isostep::test
