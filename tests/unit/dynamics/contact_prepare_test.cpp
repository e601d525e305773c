// Blocks of contacts: every width prepares and stores the bits of one lane, and one lane agrees with closed forms.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "isostep/dynamics/solvers/contact_kernels.hpp"
#include "random/splitmix64.hpp"

namespace isostep {
namespace contact_prepare_test {

struct Random {  // splitmix64
  std::uint64_t state;
  std::uint64_t next() { return test::splitmix64(state); }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(next() % n); }
  double within(double size) { return (static_cast<double>(next() >> 11) * 0x1p-52 - 1) * size; }
};

template <class T> Vec3<T> vector(double x, double y, double z) {
  return {from_double<T>(x), from_double<T>(y), from_double<T>(z)};
}
template <class T> Vec3<T> random_vector(Random& random, double size) {
  const double x = random.within(size), y = random.within(size), z = random.within(size);
  return vector<T>(x, y, z);
}

/// Memory for blocks, and what is in them word by word.
template <class S> struct Blocks {
  struct alignas(64) Chunk {
    unsigned char bytes[64];
  };
  std::vector<Chunk> memory;
  std::vector<BlockBodies> bodies;
  std::size_t words;  // of a contact
  std::size_t width;

  Blocks(const ContactKernels<S>& kernels, std::size_t count, std::int32_t points, bool rolling)
      : words(block_bytes<S, 1>(points, rolling) / sizeof(S)), width(static_cast<std::size_t>(kernels.width)) {
    const std::size_t blocks = (count + width - 1) / width;
    memory.assign(blocks * width * words * sizeof(S) / 64 + 1, {});
    for (Chunk& chunk : memory) std::memset(chunk.bytes, kernels.width, 64);  // what nobody fills differs by width
    bodies.resize(blocks);
  }
  RawBits<S> word(std::size_t contact, std::size_t at) const {
    const std::size_t byte = (contact / width * width * words + at * width + contact % width) * sizeof(S);
    RawBits<S> value;
    std::memcpy(&value, memory[byte / sizeof(Chunk)].bytes + byte % sizeof(Chunk), sizeof(S));
    return value;
  }
};

constexpr double kPenetrationBias = 0.25, kMostPenetrationBias = 1.0 / 64;  // [1], [m]

/// Bodies, contacts and the geometry between them.
template <class S> struct Scene {
  using V = Velocity<S>;
  SolverBodies<S> bodies;
  std::vector<Contact<S>> contacts;
  std::vector<ContactGeometry<S>> geometry;
  std::vector<std::uint32_t> order;

  std::uint32_t add_body(double mass, Vec3<S> kappa, Vec3<V> velocity, Vec3<V> angular_velocity) {
    bodies.velocity.push_back({velocity, V(0), angular_velocity, V(0)});
    bodies.mass.push_back({from_double<S>(mass), Mat3<S>::diagonal(kappa)});
    return static_cast<std::uint32_t>(bodies.mass.size()) - 1;
  }
  Blocks<S> prepare(const ContactKernels<S>& kernels, std::int32_t points, bool rolling) const {
    Blocks<S> blocks(kernels, contacts.size(), points, rolling);
    kernels.prepare({blocks.memory.data(), blocks.bodies.data(), static_cast<std::int32_t>(contacts.size()), points,
                     rolling, order.data(), contacts.data(), geometry.data(), bodies.velocity.data(),
                     bodies.mass.data(), S(kPenetrationBias), S(kMostPenetrationBias)});
    return blocks;
  }
};

/// Some bodies stand still, some are kinematic; contacts rest, slide, bear friction, or nothing at all.
template <class S> Scene<S> random_scene(Random& random, std::uint32_t count, std::uint32_t points) {
  using V = Velocity<S>;
  Scene<S> scene;
  scene.add_body(0, Vec3<S>::zero(), Vec3<V>::zero(), Vec3<V>::zero());
  for (int i = 1; i < 12; ++i) {
    const bool kinematic = random.below(4) == 0;
    const double of_y = kinematic ? 0 : 2 + random.within(1), of_x = kinematic ? 0 : 1 + random.within(0.9);
    const Vec3<S> kappa = kinematic ? Vec3<S>::zero() : vector<S>(of_x, of_y, 3);
    const double size = random.below(3) == 0 ? 0 : random.below(2) == 0 ? 0.001 : 4;
    const Vec3<V> spin = random_vector<V>(random, size), velocity = random_vector<V>(random, size);
    scene.add_body(kinematic ? 0 : 1 + random.below(1000), kappa, velocity, spin);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    Contact<S> c = {};
    ContactGeometry<S> g = {};
    c.count = points;
    c.flags = random.below(2);
    g.row_a = random.below(12);
    g.row_b = random.below(12);
    const double angle = random.within(3.15), height = random.below(4) == 0 ? 0 : random.within(1);
    const double flat = std::sqrt(1 - height * height);
    g.normal = random.below(6) == 0 ? vector<Unit<S>>(0, 0, random.below(2) == 0 ? -1 : 1)
                                    : vector<Unit<S>>(flat * std::cos(angle), height, flat * std::sin(angle));
    g.ratio = Unit<S>(1);
    if (random.below(3) == 0) {
      g.axis = tangents_of(g.normal).t;
      g.ratio = from_double<Unit<S>>(0.5 + random.within(0.4));
    }
    for (std::uint32_t p = 0; p < points; ++p) {
      if (random.below(4) != 0) c.normal_impulse[p] = from_double<V>(random.within(0.5) + 0.5);
      g.points[p] = {random_vector<S>(random, 1), random_vector<S>(random, 1), from_double<S>(random.within(0.01))};
    }
    constexpr double kBorne[] = {0, 0.001, 0.1, 0.2, 0.3, 1};  // [m/s] about and far from an eighth of the limit
    c.friction_impulse = random_vector<V>(random, kBorne[random.below(6)]);
    c.twist_impulse = from_double<V>(random.within(0.1));
    g.material = {from_double<S>(0.5 + random.within(0.5)), from_double<S>(0.5 + random.within(0.5)),
                  from_double<S>(random.within(0.1) + 0.1), from_double<S>(random.within(0.05) + 0.05),
                  random.below(3) == 0 ? random_vector<S>(random, 2) : Vec3<S>::zero()};
    scene.contacts.push_back(c);
    scene.geometry.push_back(g);
    scene.order.push_back(i);
  }
  for (std::uint32_t i = 1; i < count; ++i) std::swap(scene.order[i], scene.order[random.below(i + 1)]);
  return scene;
}

constexpr Simd kWide[] = {Simd::best, Simd::sse2, Simd::avx2, Simd::neon, Simd::wasm};

template <class S> void compare_bodies(const Blocks<S>& one, const Blocks<S>& many, std::size_t i) {
  const BlockBodies& x = one.bodies[i];
  const BlockBodies& y = many.bodies[i / many.width];
  const std::size_t lane = i % many.width;
  ASSERT_EQ(x.a[0], y.a[lane]);
  ASSERT_EQ(x.b[0], y.b[lane]);
  ASSERT_EQ(x.write_a, (y.write_a >> lane) & 1u);
  ASSERT_EQ(x.write_b, (y.write_b >> lane) & 1u);
}

template <class S> class ContactPrepare : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(ContactPrepare, Scalars);

TYPED_TEST(ContactPrepare, EveryWidthFillsTheBlocksOfOneLaneBitForBit) {
  using S = TypeParam;
  Random random{1};
  for (int round = 0; round < 40; ++round) {
    for (std::int32_t points = 1; points <= kMaxContactPoints; ++points) {
      const std::uint32_t count = 1 + random.below(40);
      const Scene<S> scene = random_scene<S>(random, count, static_cast<std::uint32_t>(points));
      for (const bool rolling : {false, true}) {
        const Blocks<S> one = scene.prepare(*contact_kernels<S>(Simd::scalar), points, rolling);
        for (const Simd simd : kWide) {
          const ContactKernels<S>* kernels = contact_kernels<S>(simd);
          if (kernels == nullptr) continue;
          const Blocks<S> many = scene.prepare(*kernels, points, rolling);
          for (std::size_t i = 0; i < count; ++i) {
            ASSERT_NO_FATAL_FAILURE(compare_bodies(one, many, i));
            for (std::size_t w = 0; w < one.words; ++w) {
              ASSERT_EQ(one.word(i, w), many.word(i, w)) << kernels->name << " points " << points << " rolling "
                                                         << rolling << " contact " << i << " word " << w;
            }
          }
        }
      }
    }
  }
}

TYPED_TEST(ContactPrepare, LanesThatAreLeftOverWriteNoBodyAndStayWithoutImpulse) {
  using S = TypeParam;
  using V = Velocity<S>;
  Random random{2};
  for (const Simd simd : kWide) {
    const ContactKernels<S>* kernels = contact_kernels<S>(simd);
    if (kernels == nullptr || kernels->width == 1) continue;
    Scene<S> scene = random_scene<S>(random, 1, 4);
    Blocks<S> blocks = scene.prepare(*kernels, 4, true);
    const ContactPass<S> pass = {{S(10), S(0.5), S(0.5)}, S(480), V(3), V(0.1), V(30)};
    const std::vector<MotionRow<V>> still(scene.bodies.velocity.size(), MotionRow<V>::zero());
    constexpr int kRollingOfFour = 2 * kMaxContactPoints - 1;
    const BlockRun<S> run = {blocks.memory.data(), blocks.bodies.data(), 1, scene.bodies.velocity.data(), still.data()};
    kernels->warm_start[kRollingOfFour](run);
    kernels->solve[kRollingOfFour](run, pass);
    kernels->relax[kRollingOfFour](run, pass);
    std::vector<Contact<S>> contacts(static_cast<std::size_t>(kernels->width));
    std::vector<std::uint32_t> order;
    std::vector<V> pushed(contacts.size(), V(1));
    for (Contact<S>& c : contacts) c = {};
    for (std::uint32_t i = 0; i < contacts.size(); ++i) order.push_back(i);
    kernels->store({blocks.memory.data(), kernels->width, 4, true, order.data(), contacts.data(), pushed.data()});
    EXPECT_LE(blocks.bodies[0].write_a | blocks.bodies[0].write_b, 1u);
    for (std::size_t i = 1; i < contacts.size(); ++i) {
      EXPECT_EQ(blocks.bodies[0].a[i] | blocks.bodies[0].b[i], 0u);
      EXPECT_EQ(pushed[i], V(0));
      EXPECT_EQ(contacts[i].twist_impulse, V(0));
      EXPECT_EQ(contacts[i].friction_impulse, Vec3<V>::zero());
      for (const V impulse : contacts[i].normal_impulse) EXPECT_EQ(impulse, V(0));
    }
  }
}

TYPED_TEST(ContactPrepare, EveryWidthStoresTheImpulsesOfOneLaneBitForBit) {
  using S = TypeParam;
  using V = Velocity<S>;
  Random random{3};
  for (int round = 0; round < 40; ++round) {
    const auto points = static_cast<std::int32_t>(1 + random.below(kMaxContactPoints));
    const std::uint32_t count = 1 + random.below(40);
    const bool rolling = random.below(2) == 0;
    const Scene<S> scene = random_scene<S>(random, count, static_cast<std::uint32_t>(points));
    const auto stored = [&](const ContactKernels<S>& kernels, std::vector<V>& pushed) {
      const Blocks<S> blocks = scene.prepare(kernels, points, rolling);
      std::vector<Contact<S>> contacts = scene.contacts;
      pushed.assign(count, V(7));
      kernels.store({blocks.memory.data(), static_cast<std::int32_t>(count), points, rolling, scene.order.data(),
                     contacts.data(), pushed.data()});
      return contacts;
    };
    std::vector<V> pushed_one, pushed_many;
    const std::vector<Contact<S>> one = stored(*contact_kernels<S>(Simd::scalar), pushed_one);
    for (const Simd simd : kWide) {
      const ContactKernels<S>* kernels = contact_kernels<S>(simd);
      if (kernels == nullptr) continue;
      const std::vector<Contact<S>> many = stored(*kernels, pushed_many);
      ASSERT_EQ(std::memcmp(one.data(), many.data(), count * sizeof(Contact<S>)), 0) << kernels->name;
      ASSERT_EQ(std::memcmp(pushed_one.data(), pushed_many.data(), count * sizeof(V)), 0) << kernels->name;
    }
  }
}

TYPED_TEST(ContactPrepare, ImpulsesComeBackAsTheyWent) {
  using S = TypeParam;
  using V = Velocity<S>;
  Random random{4};
  Scene<S> scene = random_scene<S>(random, 30, 3);
  const ContactKernels<S>& kernels = *contact_kernels<S>(Simd::best);
  const Blocks<S> blocks = scene.prepare(kernels, 3, false);
  std::vector<Contact<S>> contacts = scene.contacts;
  std::vector<V> pushed(30, V(7));
  kernels.store({blocks.memory.data(), 30, 3, false, scene.order.data(), contacts.data(), pushed.data()});
  for (std::size_t i = 0; i < 30; ++i) {
    const Contact<S>& before = scene.contacts[i];
    const Contact<S>& after = contacts[i];
    EXPECT_TRUE(before.key == after.key);
    EXPECT_EQ(before.count, after.count);
    EXPECT_EQ(before.twist_impulse, after.twist_impulse);
    EXPECT_EQ(pushed[i], V(0)) << "no warm start was counted";
    EXPECT_EQ(after.flags & contact_flag::kTouching, 0u);
    for (int p = 0; p < kMaxContactPoints; ++p) EXPECT_EQ(before.normal_impulse[p], after.normal_impulse[p]);
    // Friction keeps its part in the plane of the contact.
    const Vec3<Unit<S>> n = scene.geometry[i].normal;
    const double f[3] = {to_double(before.friction_impulse.x), to_double(before.friction_impulse.y),
                         to_double(before.friction_impulse.z)};
    const double m[3] = {to_double(n.x), to_double(n.y), to_double(n.z)};
    const double along = f[0] * m[0] + f[1] * m[1] + f[2] * m[2];
    EXPECT_NEAR(to_double(after.friction_impulse.x), f[0] - along * m[0], 1e-5);
    EXPECT_NEAR(to_double(after.friction_impulse.y), f[1] - along * m[1], 1e-5);
    EXPECT_NEAR(to_double(after.friction_impulse.z), f[2] - along * m[2], 1e-5);
  }
}

/// A ball of radius 1 m, m / I = 2.5, that rolls at 2 m/s over the ground or beside a ball like it.
template <class S> Scene<S> ball_scene(bool beside) {
  using V = Velocity<S>;
  Scene<S> scene;
  const Vec3<S> kappa = vector<S>(2.5, 2.5, 2.5);
  scene.add_body(0, Vec3<S>::zero(), Vec3<V>::zero(), Vec3<V>::zero());
  scene.add_body(8, kappa, Vec3<V>::zero(), Vec3<V>::zero());
  scene.add_body(8, kappa, vector<V>(2, -3, 0), vector<V>(0, 0, -2));
  Contact<S> c = {};
  c.count = 1;
  ContactGeometry<S> g = {};
  g.row_a = beside ? 1 : 0;
  g.row_b = 2;
  g.normal = vector<Unit<S>>(0, 1, 0);
  g.ratio = Unit<S>(1);
  g.points[0] = {vector<S>(0, 1, 0), vector<S>(0, -1, 0), from_double<S>(0.25)};
  g.material = {from_double<S>(0.5), S(0), from_double<S>(0.125), from_double<S>(0.0625), Vec3<S>::zero()};
  scene.contacts = {c};
  scene.geometry = {g};
  scene.order = {0};
  return scene;
}

TYPED_TEST(ContactPrepare, ABallsMassesAgreeWithClosedForms) {
  using S = TypeParam;
  const double near = sizeof(S) == 4 ? 2e-4 : 1e-8;
  for (const bool beside : {false, true}) {
    const Scene<S> scene = ball_scene<S>(beside);
    const Blocks<S> blocks = scene.prepare(*contact_kernels<S>(Simd::scalar), 1, true);
    const auto& block = *reinterpret_cast<const RollingBlock<S, 1, 1>*>(blocks.memory.data());
    const ContactBlock<S, 1, 1>& c = block.contact;
    const auto expect = [near](auto value, double expected) { EXPECT_NEAR(to_double(value), expected, near); };
    expect(c.share_a[0], beside ? 0.5 : 0);
    expect(c.share_b[0], beside ? 0.5 : 1);
    expect(c.normals[0].row.effective_mass[0], 1);  // arms along the normal turn nothing
    expect(c.normals[0].separation[0], 0.25);
    expect(c.twist.effective_mass[0], 1);  // at the radius of gyration
    expect(c.twist_friction[0], 0.5 * 0.0625 * std::sqrt(2.5));
    for (const auto& t : c.tangents) expect(t.row.effective_mass[0], 1 / 3.5);  // 1 + r^2 m / I
    for (const auto& r : block.rolling.rows) expect(r.effective_mass[0], 1 / 2.5);
    expect(block.rolling.lever[0], 0.125);
    // The point of contact moves at 2 m/s less the rotation's 2 m/s: it does not slide, but the ball rolls about -z.
    expect(block.rolling.rows[0].jacobian_b[0][0], 0);
    expect(block.rolling.rows[0].jacobian_b[1][0], 0);
    expect(block.rolling.rows[0].jacobian_b[2][0], -1);
  }
}

TYPED_TEST(ContactPrepare, AnOverlapCountsAsDeeperByItsLiftWithinTheBoundAndAGapAsItIs) {
  using S = TypeParam;
  const double near = sizeof(S) == 4 ? 2e-5 : 1e-8;
  Scene<S> scene = ball_scene<S>(false);
  for (const double separation : {0.25, 0.0, -1.0 / 32, -1.0 / 16, -0.5}) {
    scene.geometry[0].points[0].separation = from_double<S>(separation);
    const Blocks<S> blocks = scene.prepare(*contact_kernels<S>(Simd::scalar), 1, true);
    const auto& block = *reinterpret_cast<const RollingBlock<S, 1, 1>*>(blocks.memory.data());
    const double lift = separation < 0 ? std::min(-kPenetrationBias * separation, kMostPenetrationBias) : 0;
    EXPECT_NEAR(to_double(block.contact.normals[0].separation[0]), separation - lift, near);
  }
}

}  // namespace contact_prepare_test
}  // namespace isostep
