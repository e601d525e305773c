// ParticleGrid against brute force: densities, lines, distances from the origin, mixed sizes, too many pairs.
// SPDX-License-Identifier: MIT
#include "isostep/particles/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "isostep/core/random.hpp"
#include "isostep/scalar/lattice.hpp"

namespace isostep {
namespace grid_test {

constexpr std::uint32_t kNoLimit = 0xffffffffu;

/// Particles in slots of which some are holes.
template <class S> struct Cloud {
  Axes<S> position;
  std::vector<std::uint32_t> slots;
  std::vector<S> reach;

  void add(Vec3<S> p, S r, std::uint32_t holes = 0) {
    for (std::uint32_t i = 0; i < holes; ++i) position.push_back({S(0), S(0), S(0)});
    slots.push_back(static_cast<std::uint32_t>(position.size()));
    position.push_back(p);
    reach.push_back(r);
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(slots.size()); }

  /// Far pairs leave early, for their squares do not fit; a difference that wraps is negative.
  bool touch(std::uint32_t i, std::uint32_t j) const {
    const Vec3<S> a = position[slots[i]];
    const Vec3<S> b = position[slots[j]];
    const S r = reach[i] + reach[j];
    for (int axis = 0; axis < 3; ++axis) {
      const S low = min(a[axis], b[axis]);
      const S high = max(a[axis], b[axis]);
      const S apart = high - low;
      if (apart < S(0) || r < apart) return false;
    }
    return dot_sum(a - b, a - b) <= product(r, r);
  }
  std::vector<std::uint64_t> brute_force() const {
    std::vector<std::uint64_t> pairs;
    for (std::uint32_t i = 0; i < count(); ++i) {
      for (std::uint32_t j = i + 1; j < count(); ++j) {
        if (touch(i, j)) pairs.push_back(std::uint64_t{slots[i]} << 32 | slots[j]);
      }
    }
    return pairs;
  }
};

template <class S> struct Finder {
  ParticleGrid<S> grid;
  std::vector<std::uint64_t> pairs;

  std::vector<std::uint64_t>& of(const Cloud<S>& cloud, std::uint32_t most = kNoLimit) {
    pairs.clear();
    all = grid.find_pairs(cloud.position, cloud.slots.data(), cloud.reach.data(), cloud.count(), pairs, most);
    return pairs;
  }
  bool all = false;
};

template <class S> Vec3<S> random_in(Pcg32& random, Vec3<S> centre, Vec3<S> half) {
  const S x = uniform(random, -half.x, half.x);
  const S y = uniform(random, -half.y, half.y);
  const S z = uniform(random, -half.z, half.z);
  return centre + Vec3<S>{x, y, z};
}
template <class S>
Cloud<S> box_of(std::uint64_t seed, std::uint32_t count, Vec3<S> centre, Vec3<S> half, S smallest, S largest) {
  Pcg32 random = Pcg32::seeded(seed);
  Cloud<S> cloud;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3<S> p = random_in(random, centre, half);
    const S r = uniform(random, smallest, largest);
    cloud.add(p, r, random_below(random, 3));
  }
  return cloud;
}

/// [m] The end of worlds of floats.
template <class S> S far_out() { return from_double<S>(std::is_same_v<S, float> ? 65536 : 1e9); }

template <class S> class Grid : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Grid, Scalars);

TYPED_TEST(Grid, FindsWhatBruteForceFindsAtEveryDensity) {
  using S = TypeParam;
  Finder<S> finder;
  std::uint64_t seed = 1;
  for (const S half : {S(0), S(0.05), S(0.3), S(1), S(2.5), S(7), S(30), S(200)}) {
    for (const std::uint32_t count : {0u, 1u, 2u, 3u, 33u, 400u}) {
      const Cloud<S> cloud = box_of<S>(seed++, count, {S(0.3), S(-0.2), S(0)}, {half, half, half}, S(0.25), S(0.5));
      EXPECT_EQ(finder.of(cloud), cloud.brute_force()) << "half " << to_double(half) << ", " << count;
      EXPECT_TRUE(finder.all);
    }
  }
}

TYPED_TEST(Grid, FindsTouchingParticlesAlongEachAxisAndExactlyAtReach) {
  using S = TypeParam;
  Finder<S> finder;
  for (int axis = 0; axis < 3; ++axis) {
    for (const S gap : {S(0.5), S(1), S(1.0625)}) {  // reaches add up to 1
      Cloud<S> cloud;
      Vec3<S> p = {S(-20), S(3), S(-7)};
      for (int i = 0; i < 100; ++i) {
        cloud.add(p, S(0.5));
        p[axis] = p[axis] + gap;
      }
      EXPECT_EQ(finder.of(cloud), cloud.brute_force());
      EXPECT_EQ(finder.pairs.size(), gap == S(0.5) ? 99u + 98u : gap == S(1) ? 99u : 0u);
    }
  }
}

TYPED_TEST(Grid, FindsPairsFarFromTheOriginOnEverySide) {
  using S = TypeParam;
  Finder<S> finder;
  for (const S x : {S(-500), S(500)}) {
    for (const S y : {S(-3), S(500)}) {
      const Cloud<S> cloud = box_of<S>(7, 300, {x, y, -x}, {S(2), S(2), S(2)}, S(0.1), S(0.3));
      EXPECT_EQ(finder.of(cloud), cloud.brute_force());
      EXPECT_FALSE(finder.pairs.empty());
    }
  }
}

TYPED_TEST(Grid, KeepsAPileFineWhenAFewParticlesHaveGoneToTheEndsOfTheRange) {
  using S = TypeParam;
  const S far = kIsFixed<S> ? highest<S>() : far_out<S>();
  Finder<S> finder;
  Cloud<S> cloud = box_of<S>(11, 800, {S(1), S(2), S(3)}, {S(0.1), S(0.1), S(0.1)}, S(0.004), S(0.0078125));
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3<S> p = {corner & 1 ? far : -far, corner & 2 ? far : -far, corner & 4 ? far : -far};
    cloud.add(p, S(0.0078125));
    cloud.add(p, S(0.0078125));
  }
  EXPECT_EQ(finder.of(cloud), cloud.brute_force());
  EXPECT_LT(finder.grid.distance_tests(), 100u * cloud.count());
}

TYPED_TEST(Grid, FindsPairsAmongParticlesScatteredOverTheWholeRange) {
  using S = TypeParam;
  const S far = kIsFixed<S> ? S(30000) : far_out<S>();
  Pcg32 random = Pcg32::seeded(12);
  Cloud<S> cloud;
  for (int i = 0; i < 300; ++i) {
    Vec3<S> p = {S(0), S(0), S(0)};
    for (int axis = 0; axis < 3; ++axis) {
      const S half = uniform(random, S(0), far);
      p[axis] = random_below(random, 2) == 0 ? half : -half;
    }
    cloud.add(p, S(0.001));
    cloud.add(p, S(0.001));
  }
  Finder<S> finder;
  EXPECT_EQ(finder.of(cloud), cloud.brute_force());
  EXPECT_GE(finder.pairs.size(), 300u);
  EXPECT_LT(finder.grid.distance_tests(), 1000u);
}

TYPED_TEST(Grid, MixesRadiiFromOneToAHundred) {
  using S = TypeParam;
  Finder<S> finder;
  Pcg32 random = Pcg32::seeded(21);
  Cloud<S> cloud;
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t kind = random_below(random, 20);
    const S r = kind == 0 ? uniform(random, S(0.5), S(1)) : kind < 5 ? S(0.1) : uniform(random, S(0.01), S(0.05));
    const Vec3<S> p = random_in<S>(random, {S(0), S(-4), S(9)}, {S(3), S(1), S(2)});
    cloud.add(p, r);
  }
  EXPECT_EQ(finder.of(cloud), cloud.brute_force());
}

TYPED_TEST(Grid, GivesABoulderNoMoreTestsThanThereIsSand) {
  using S = TypeParam;
  Finder<S> finder;
  Cloud<S> cloud;
  for (int i = 0; i < 2000; ++i) {
    cloud.add({S(i % 20) * S(0.0625), S(i / 20 % 10) * S(0.0625), S(i / 200) * S(0.0625)}, S(0.03125));
  }
  const std::uint64_t sand = (finder.of(cloud), finder.grid.distance_tests());
  cloud.add({S(0.5), S(0.5), S(3.5)}, S(2.75));
  EXPECT_EQ(finder.of(cloud), cloud.brute_force());
  EXPECT_LE(finder.grid.distance_tests(), sand + 2000u);
}

TYPED_TEST(Grid, CountsCoincidentPointsAndParticlesWithoutReach) {
  using S = TypeParam;
  Finder<S> finder;
  Cloud<S> cloud;
  for (int i = 0; i < 60; ++i) cloud.add({S(i / 20), S(0.1), S(-0.1)}, S(0), 1);
  EXPECT_EQ(finder.of(cloud), cloud.brute_force());
  EXPECT_EQ(finder.pairs.size(), 3u * 190u);
  cloud.add({S(1), S(0.1), S(0)}, S(0.125));
  EXPECT_EQ(finder.of(cloud), cloud.brute_force());
  EXPECT_EQ(finder.pairs.size(), 3u * 190u + 20u);
}

TYPED_TEST(Grid, StopsAtTheMostPairsAsked) {
  using S = TypeParam;
  Finder<S> finder;
  Cloud<S> heap;
  for (int i = 0; i < 100000; ++i) heap.add({S(1), S(1), S(1)}, S(0.5));
  std::vector<std::uint64_t> first = finder.of(heap, 5000);
  EXPECT_FALSE(finder.all);
  ASSERT_EQ(first.size(), 5000u);
  EXPECT_LT(finder.grid.distance_tests(), 200000u);
  EXPECT_TRUE(std::is_sorted(first.begin(), first.end()));
  EXPECT_EQ(std::adjacent_find(first.begin(), first.end()), first.end());
  EXPECT_EQ(finder.of(heap, 5000), first);

  const Cloud<S> cloud = box_of<S>(31, 300, {S(0), S(0), S(0)}, {S(2), S(2), S(2)}, S(0.05), S(0.5));
  const std::vector<std::uint64_t> every = cloud.brute_force();
  const auto count = static_cast<std::uint32_t>(every.size());
  EXPECT_EQ(finder.of(cloud, count), every);
  EXPECT_TRUE(finder.all);
  EXPECT_EQ(finder.of(cloud, count - 1u).size(), every.size() - 1u);
  EXPECT_FALSE(finder.all);
  EXPECT_TRUE(std::includes(every.begin(), every.end(), finder.pairs.begin(), finder.pairs.end()));
  EXPECT_TRUE(finder.of(cloud, 0).empty());
  EXPECT_FALSE(finder.all);
}

TYPED_TEST(Grid, AppendsToWhatIsThere) {
  using S = TypeParam;
  Cloud<S> cloud;
  cloud.add({S(0), S(0), S(0)}, S(1), 4);
  cloud.add({S(1), S(0), S(0)}, S(1), 2);
  ParticleGrid<S> grid;
  std::vector<std::uint64_t> pairs = {42};
  EXPECT_TRUE(grid.find_pairs(cloud.position, cloud.slots.data(), cloud.reach.data(), 2, pairs, 10));
  EXPECT_EQ(pairs, (std::vector<std::uint64_t>{42, std::uint64_t{4} << 32 | 7u}));
}

/// The same particles in other slots: pairs follow the particles, whatever was found before with the same memory.
TYPED_TEST(Grid, DependsOnNoOrderButTheSlots) {
  using S = TypeParam;
  const Cloud<S> cloud = box_of<S>(41, 500, {S(0), S(0), S(0)}, {S(2), S(1), S(2)}, S(0.02), S(0.4));
  Finder<S> finder;
  const std::vector<std::uint64_t> pairs = finder.of(cloud);
  const std::uint32_t count = cloud.count();
  Cloud<S> turned;  // particle i of the cloud is particle 7 i mod 500 ... of this one
  std::vector<std::uint32_t> place(cloud.position.size());
  std::vector<std::uint32_t> from(count);
  for (std::uint32_t i = 0; i < count; ++i) from[i * 7u % count] = i;
  for (std::uint32_t i = 0; i < count; ++i) {
    turned.add(cloud.position[cloud.slots[from[i]]], cloud.reach[from[i]]);
    place[cloud.slots[from[i]]] = i;
  }
  std::vector<std::uint64_t> expected;
  for (const std::uint64_t pair : pairs) {
    const std::uint64_t a = place[pair >> 32];
    const std::uint64_t b = place[static_cast<std::uint32_t>(pair)];
    expected.push_back(std::min(a, b) << 32 | std::max(a, b));
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(finder.of(turned), expected);
  EXPECT_EQ(finder.of(cloud), pairs);
}

/// Cells of two reaches and 27 of them: a uniform cloud of one particle a cell needs 13 tests a particle.
TYPED_TEST(Grid, TestsFewDistancesInAUniformCloud) {
  using S = TypeParam;
  Finder<S> finder;
  for (const std::uint32_t side : {10u, 20u, 30u}) {
    const S half = S(static_cast<int>(side)) * S(0.1);
    const Cloud<S> cloud = box_of<S>(51, side * side * side, {S(0), S(0), S(0)}, {half, half, half}, S(0.1), S(0.1));
    finder.of(cloud);
    EXPECT_LT(finder.grid.distance_tests(), 16u * cloud.count());
    EXPECT_GT(finder.pairs.size(), std::size_t{cloud.count()});
  }
}

}  // namespace grid_test
}  // namespace isostep
