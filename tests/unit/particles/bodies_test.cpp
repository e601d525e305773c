// The builders of mass-aggregate bodies: what they make, that defaults are stable, and that a refusal leaves nothing.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "isostep/particles/bodies/blob.hpp"
#include "isostep/particles/bodies/bridge.hpp"
#include "isostep/particles/bodies/cloth.hpp"
#include "isostep/particles/bodies/platform.hpp"
#include "isostep/particles/bodies/rope.hpp"
#include "isostep/particles/bodies/soft_box.hpp"
#include "isostep/particles/limits.hpp"
#include "isostep/particles/particle_state.hpp"

namespace isostep {
namespace bodies_test {

template <class S> class Bodies : public ::testing::Test {
 protected:
  using World = ParticleWorld<S>;

  static double number(S x) { return to_double(x); }
  static void expect_at(Vec3<S> at, double x, double y, double z) {
    EXPECT_NEAR(number(at.x), x, 1e-4);
    EXPECT_NEAR(number(at.y), y, 1e-4);
    EXPECT_NEAR(number(at.z), z, 1e-4);
  }
  static double distance(const World& world, ParticleId a, ParticleId b) {
    const Vec3<S> d = world.position(b) - world.position(a);
    return std::hypot(number(d.x), number(d.y), number(d.z));
  }
  static void expect_empty(const World& world, std::size_t materials) {
    const ParticleCounts counts = world.counts();
    EXPECT_EQ(counts.particles, 0u);
    EXPECT_EQ(counts.springs, 0u);
    EXPECT_EQ(counts.links, 0u);
    std::size_t kept = 0, cohesions = 0;
    const auto& state = world.state();
    for (std::uint32_t i = 0; i < state.materials.all().size(); ++i) kept += state.materials.is_taken(i);
    for (std::uint32_t i = 0; i < state.cohesions.all().size(); ++i) cohesions += state.cohesions.is_taken(i);
    EXPECT_EQ(kept, materials);
    EXPECT_EQ(cohesions, 0u);
  }
  template <class Definition> static void expect_refused(const Definition& definition, Fault fault) {
    World world;
    const ParticleBody body = build(world, definition);
    EXPECT_FALSE(body);
    EXPECT_EQ(body.fault, fault) << fault_text(body.fault);
    EXPECT_TRUE(body.particles.empty() && body.springs.empty() && body.links.empty());
    EXPECT_FALSE(body.material || body.cohesion);
    expect_empty(world, 1);
  }
  /// Gershgorin: no row of h^2 K/m + 2 h C/m sums to more, so no mode is faster.
  static double fastest(const World& world, const ParticleBody& body) {
    const double rate = static_cast<double>(world.settings().hz) * world.settings().substeps;
    std::vector<double> sums(body.particles.size(), 0);
    for (const SpringId id : body.springs) {
      const Spring<S>& spring = *world.find(id);
      for (const ParticleId end : {spring.a, spring.b}) {
        if (world.mass(end) == S(0)) continue;
        const double h2k = number(spring.stiffness) / rate / rate, hc = number(spring.damping) / rate;
        sums[end.slot] += (2 * h2k + 4 * hc) / number(world.mass(end));
      }
    }
    return *std::max_element(sums.begin(), sums.end());
  }
  static double energy_of_motion(const World& world) {
    double sum = 0;
    for (const ParticleId id : world.particles()) {
      const Vec3<S> v = world.velocity(id);
      sum +=
          number(world.mass(id)) / 2 * (std::pow(number(v.x), 2) + std::pow(number(v.y), 2) + std::pow(number(v.z), 2));
    }
    return sum;
  }
};
using Scalars = ::testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Bodies, Scalars);

template <class S> ParticleSettings<S> weightless(std::int32_t hz = 60, std::int32_t substeps = 4) {
  ParticleSettings<S> settings;
  settings.hz = hz;
  settings.substeps = substeps;
  settings.gravity = {S(0), S(0), S(0)};
  return settings;
}

TYPED_TEST(Bodies, ARopeHasParticlesEvenlyInARowAndALinkBetweenNeighbours) {
  using S = TypeParam;
  ParticleWorld<S> world;
  RopeDefinition<S> d;
  d.start = {S(1), S(2), S(3)};
  d.end = {S(5), S(2), S(0)};
  d.particles = 11;
  d.length = S(8);
  d.mass = S(5.5);
  d.type = LinkType::rod;
  d.pin_end = true;
  const ParticleBody rope = build(world, d);
  ASSERT_TRUE(rope);
  ASSERT_EQ(rope.particles.size(), 11u);
  ASSERT_EQ(rope.links.size(), 10u);
  EXPECT_TRUE(rope.springs.empty());
  this->expect_at(world.position(rope.particles[0]), 1, 2, 3);
  this->expect_at(world.position(rope.particles[5]), 3, 2, 1.5);
  this->expect_at(world.position(rope.particles[10]), 5, 2, 0);
  EXPECT_EQ(world.counts().pinned, 2u);
  EXPECT_EQ(world.mass(rope.particles[0]), S(0));
  EXPECT_EQ(world.mass(rope.particles[10]), S(0));
  EXPECT_NEAR(to_double(world.mass(rope.particles[4])), 0.5, 1e-5);
  for (std::size_t i = 0; i < 10; ++i) {
    const Link<S>& link = *world.find(rope.links[i]);
    EXPECT_EQ(link.type, LinkType::rod);
    EXPECT_EQ(link.a, rope.particles[i]);
    EXPECT_EQ(link.b, rope.particles[i + 1]);
    EXPECT_NEAR(to_double(link.length), 0.8, 1e-4);
  }
}

TYPED_TEST(Bodies, ATautRopeIsAsLongAsItsEndsAreApart) {
  using S = TypeParam;
  ParticleWorld<S> world;
  RopeDefinition<S> d;
  d.end = {S(3), S(0), S(4)};
  d.particles = 6;
  const ParticleBody rope = build(world, d);
  ASSERT_TRUE(rope);
  for (const LinkId link : rope.links) EXPECT_NEAR(to_double(world.find(link)->length), 1, 1e-4);
  EXPECT_EQ(world.counts().pinned, 1u);
}

TYPED_TEST(Bodies, TheBridgeIsTheBooks) {
  using S = TypeParam;
  ParticleWorld<S> world;
  const ParticleBody bridge = build(world, BridgeDefinition<S>{});
  ASSERT_TRUE(bridge);
  ASSERT_EQ(bridge.particles.size(), 12u);
  ASSERT_EQ(bridge.links.size(), 28u);
  for (int i = 0; i < 12; ++i) {
    const auto n = static_cast<std::size_t>(i);
    this->expect_at(world.position(bridge.particles[n]), i / 2 * 2 - 5, 4, i % 2 * 2 - 1);
    const Link<S>& support = *world.find(bridge.links[10 + n]);
    EXPECT_EQ(support.type, LinkType::cable);
    EXPECT_EQ(support.a, bridge.particles[n]);
    EXPECT_FALSE(support.b);
    this->expect_at(support.anchor, i / 2 * 2.2 - 5.5, 6, i % 2 * 1.6 - 0.8);
    EXPECT_NEAR(to_double(support.length), i < 6 ? i / 2 * 0.5 + 3 : 5.5 - i / 2 * 0.5, 1e-4);
  }
  for (std::size_t i = 0; i < 10; ++i) {
    const Link<S>& deck = *world.find(bridge.links[i]);
    EXPECT_EQ(deck.type, LinkType::cable);
    EXPECT_EQ(deck.a, bridge.particles[i]);
    EXPECT_EQ(deck.b, bridge.particles[i + 2]);
    EXPECT_NEAR(to_double(deck.length), 1.9, 1e-4);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const Link<S>& across = *world.find(bridge.links[22 + i]);
    EXPECT_EQ(across.type, LinkType::rod);
    EXPECT_EQ(across.a, bridge.particles[2 * i]);
    EXPECT_EQ(across.b, bridge.particles[2 * i + 1]);
    EXPECT_EQ(across.length, S(2));
  }
}

TYPED_TEST(Bodies, APlatformHasARodBetweenEveryTwoOfItsSixParticles) {
  using S = TypeParam;
  ParticleWorld<S> world;
  PlatformDefinition<S> d;
  d.foot = {S(1), S(1), S(1)};
  const ParticleBody platform = build(world, d);
  ASSERT_TRUE(platform);
  ASSERT_EQ(platform.particles.size(), 6u);
  ASSERT_EQ(platform.links.size(), 15u);
  this->expect_at(world.position(platform.particles[0]), 1, 1, 2);
  this->expect_at(world.position(platform.particles[5]), 5, 3, 0);
  std::vector<double> lengths;
  for (const LinkId id : platform.links) {
    EXPECT_EQ(world.find(id)->type, LinkType::rod);
    lengths.push_back(to_double(world.find(id)->length));
  }
  std::sort(lengths.begin(), lengths.end());
  const double expected[] = {2, 2, 2, 3.606, 3.606, 4.123, 4.123, 4.472, 4.472, 4.899, 4.899, 7, 7, 7.28, 7.28};
  for (std::size_t i = 0; i < 15; ++i) EXPECT_NEAR(lengths[i], expected[i], 6e-4);
}

TYPED_TEST(Bodies, AClothOfHundredByHundredHas59002Springs) {
  using S = TypeParam;
  ParticleWorld<S> world;
  ClothDefinition<S> d;
  d.columns = d.rows = 100;
  d.mass = S(625);
  const ParticleBody cloth = build(world, d);
  ASSERT_TRUE(cloth);
  EXPECT_EQ(cloth.particles.size(), 10000u);
  EXPECT_EQ(cloth.springs.size(), 2u * 100 * 99 + 2u * 99 * 99 + 2u * 100 * 98);
  EXPECT_EQ(world.counts().pinned, 2u);
  this->expect_at(world.position(cloth.particles[9999]), 2, 0, 0);
}

TYPED_TEST(Bodies, AClothSpringsAreAtRestAndLeaveOutTheKindsThatAreNotPresent) {
  using S = TypeParam;
  ParticleWorld<S> world;
  ClothDefinition<S> d;
  d.columns = 5;
  d.rows = 4;
  d.shear.present = false;
  d.pins = ClothPins::edge;
  const ParticleBody cloth = build(world, d);
  ASSERT_TRUE(cloth);
  ASSERT_EQ(cloth.springs.size(), (4u * 4 + 5u * 3) + (4u * 3 + 5u * 2));
  EXPECT_EQ(world.counts().pinned, 5u);
  for (const SpringId id : cloth.springs) {
    const Spring<S>& spring = *world.find(id);
    EXPECT_NEAR(to_double(spring.rest_length), this->distance(world, spring.a, spring.b), 1e-4);
  }
  const Spring<S>& first = *world.find(cloth.springs[0]);  // k = m / (8 h^2), c = m / (32 h)
  EXPECT_NEAR(to_double(first.stiffness), 17.0 / 20 / 8 * 240 * 240, 5);
  EXPECT_NEAR(to_double(first.damping), 17.0 / 20 / 32 * 240, 0.03);
}

TYPED_TEST(Bodies, ASoftBoxHasSpringsAlongEdgesAcrossFacesAndThroughCells) {
  using S = TypeParam;
  ParticleWorld<S> world;
  const ParticleBody box = build(world, SoftBoxDefinition<S>{});
  ASSERT_TRUE(box);
  EXPECT_EQ(box.particles.size(), 64u);
  int count[4] = {0, 0, 0, 0};
  for (const SpringId id : box.springs) {
    const Spring<S>& spring = *world.find(id);
    const double edges = std::pow(to_double(spring.rest_length) * 3, 2);
    ASSERT_NEAR(edges, std::round(edges), 1e-3);
    ++count[static_cast<int>(std::round(edges))];
  }
  EXPECT_EQ(count[1], 3 * 3 * 16);     // edges
  EXPECT_EQ(count[2], 3 * 2 * 4 * 9);  // two on each square
  EXPECT_EQ(count[3], 4 * 27);         // four in each cell
  EXPECT_EQ(box.springs.size(), 468u);
}

TYPED_TEST(Bodies, ABlobHasAMaterialAndACohesionOfItsOwnAndAFlatOneIsFlat) {
  using S = TypeParam;
  ParticleWorld<S> world;
  BlobDefinition<S> d;
  d.centre = {S(1), S(2), S(0.3)};
  d.particles = 7;
  d.flat = true;
  ParticleBody blob = build(world, d);
  ASSERT_TRUE(blob);
  ASSERT_EQ(blob.particles.size(), 7u);
  for (const ParticleId particle : blob.particles) {
    EXPECT_EQ(world.position(particle).z, S(0.3));
    EXPECT_EQ(world.material(particle), blob.material);
  }
  this->expect_at(world.position(blob.particles[4]), 1, 2, 0.3);  // in the middle of 3 x 3
  ASSERT_NE(world.find(blob.cohesion), nullptr);
  EXPECT_EQ(world.find(blob.cohesion)->material, blob.material);
  remove(world, blob);
  EXPECT_TRUE(blob.particles.empty());
  this->expect_empty(world, 1);
}

TYPED_TEST(Bodies, DefaultsAreBelowTheBoundOfStabilityAtAnyRate) {
  using S = TypeParam;
  for (const auto& [hz, substeps] : {std::pair{60, 4}, {60, 1}, {30, 2}, {120, 8}}) {
    ParticleWorld<S> cloths(weightless<S>(hz, substeps)), boxes(weightless<S>(hz, substeps));
    const double cloth = this->fastest(cloths, build(cloths, ClothDefinition<S>{}));
    const double box = this->fastest(boxes, build(boxes, SoftBoxDefinition<S>{}));
    EXPECT_LT(cloth, 3.1);
    EXPECT_GT(cloth, 0.1);
    EXPECT_LT(box, 3.1);
    EXPECT_GT(box, 0.1);
  }
}

TYPED_TEST(Bodies, AKickedBodyNeverHasMoreEnergyThanTheKick) {
  using S = TypeParam;
  const auto expect_calm = [&](const auto& definition) {
    ParticleWorld<S> world(weightless<S>());
    const ParticleBody body = build(world, definition);
    ASSERT_TRUE(body);
    const ParticleId kicked = body.particles[body.particles.size() / 2];
    ASSERT_TRUE(world.place(kicked, world.position(kicked), {S(2), S(5), S(3)}));
    const double given = this->energy_of_motion(world);
    for (int i = 0; i < 300; ++i) {
      world.step();
      ASSERT_LE(this->energy_of_motion(world), given * 1.01) << i;
    }
    EXPECT_LT(this->energy_of_motion(world), given / 2);
  };
  ClothDefinition<S> cloth;
  cloth.columns = cloth.rows = 7;
  expect_calm(cloth);
  expect_calm(SoftBoxDefinition<S>{});
  BridgeDefinition<S> bridge;
  bridge.spacing = bridge.deck_length;
  expect_calm(bridge);
}

TYPED_TEST(Bodies, CountsThatMakeNoBodyAreRefused) {
  using S = TypeParam;
  RopeDefinition<S> rope;
  rope.particles = 1;
  this->expect_refused(rope, Fault::bad_argument);
  rope.particles = 0;
  this->expect_refused(rope, Fault::bad_argument);
  BridgeDefinition<S> bridge;
  bridge.columns = 1;
  this->expect_refused(bridge, Fault::bad_argument);
  ClothDefinition<S> cloth;
  cloth.columns = cloth.rows = 0xffffffffu;
  this->expect_refused(cloth, Fault::bad_argument);
  SoftBoxDefinition<S> box;
  box.columns = box.rows = box.layers = 1u << 11;
  this->expect_refused(box, Fault::bad_argument);
  BlobDefinition<S> blob;
  blob.particles = 0;
  this->expect_refused(blob, Fault::bad_argument);
}

TYPED_TEST(Bodies, WhatTheWorldRefusesIsToldAndTakenBack) {
  using S = TypeParam;
  RopeDefinition<S> rope;
  rope.restitution = S(2);  // the first link
  this->expect_refused(rope, Fault::bad_argument);
  rope = {};
  rope.mass = S(-1);
  this->expect_refused(rope, Fault::bad_mass);
  rope = {};
  rope.end = rope.start;  // links of no length
  this->expect_refused(rope, Fault::bad_argument);
  rope = {};
  rope.material = {7, 1};
  this->expect_refused(rope, Fault::stale_id);
  BridgeDefinition<S> bridge;
  bridge.support_growth = S(-2);  // the third support cable
  this->expect_refused(bridge, Fault::bad_argument);
  ClothDefinition<S> cloth;
  cloth.bend = {true, S(-1), S(0)};  // the last springs
  this->expect_refused(cloth, Fault::bad_argument);
  cloth = {};
  cloth.corner.x = ParticleLimits<S>::position() - S(2);
  this->expect_refused(cloth, Fault::out_of_range);
  SoftBoxDefinition<S> box;
  box.mass = S(0);
  this->expect_refused(box, Fault::bad_mass);
  BlobDefinition<S> blob;
  blob.attract_end = S(0.5);  // before attract_start
  this->expect_refused(blob, Fault::bad_argument);
  blob = {};
  blob.mass = S(0);
  this->expect_refused(blob, Fault::bad_mass);
  PlatformDefinition<S> platform;
  platform.foot.x = ParticleLimits<S>::position() - S(2);
  this->expect_refused(platform, Fault::out_of_range);
}

TYPED_TEST(Bodies, NumbersThatAreNoneAreRefused) {
  using S = TypeParam;
  if constexpr (!kIsFixed<S>) {
    const S nan = std::numeric_limits<S>::quiet_NaN(), infinity = std::numeric_limits<S>::infinity();
    RopeDefinition<S> rope;
    rope.mass = nan;
    this->expect_refused(rope, Fault::not_finite);
    ClothDefinition<S> cloth;
    cloth.down.y = infinity;
    this->expect_refused(cloth, Fault::not_finite);
    cloth = {};
    cloth.shear.stiffness = nan;
    this->expect_refused(cloth, Fault::not_finite);
    BridgeDefinition<S> bridge;
    bridge.spacing = infinity;
    this->expect_refused(bridge, Fault::not_finite);
    SoftBoxDefinition<S> box;
    box.size.z = nan;
    this->expect_refused(box, Fault::not_finite);
    BlobDefinition<S> blob;
    blob.repel_force = nan;
    this->expect_refused(blob, Fault::not_finite);
  } else {
    GTEST_SKIP() << "every pattern of bits is a number";
  }
}

}  // namespace bodies_test
}  // namespace isostep
