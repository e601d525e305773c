// Vectors held within a length, the lowest number of a fixed format among them: it has no magnitude.
// SPDX-License-Identifier: MIT
#include "isostep/math/shortened.hpp"

#include <limits>

#include "oracle.hpp"

namespace isostep {
namespace shortened_test {

using namespace test;

template <class S> class Shortened : public testing::Test {};
TYPED_TEST_SUITE(Shortened, Scalars);

TYPED_TEST(Shortened, what_is_no_longer_stays_as_it_is) {
  using V = Velocity<TypeParam>;
  const Vec3<V> v = {V(3), V(0), V(-4)};
  EXPECT_FALSE(detail::is_longer(v, V(5)));
  EXPECT_EQ(detail::shortened(v, V(5)), v);
}

TYPED_TEST(Shortened, what_is_longer_keeps_its_direction) {
  using V = Velocity<TypeParam>;
  const Vec3<V> cut = detail::shortened(Vec3<V>{V(6), V(0), V(-8)}, V(5));
  EXPECT_FALSE(detail::is_longer(cut, V(5)));
  EXPECT_NEAR(to_double(cut.x), 3, 0.01);
  EXPECT_NEAR(to_double(cut.z), -4, 0.01);
}

TYPED_TEST(Shortened, the_lowest_number_is_as_long_as_any) {
  using V = Velocity<TypeParam>;
  if constexpr (kIsFixed<V>) {
    const V low = V::from_raw(std::numeric_limits<decltype(V(0).raw())>::min()), none = V(0), limit = V(64);
    for (const Vec3<V> v :
         {Vec3<V>{low, none, none}, Vec3<V>{low, V(5), V(-5)}, Vec3<V>{none, low, low}, Vec3<V>{low, low, low}}) {
      EXPECT_TRUE(detail::is_longer(v, limit));
      const Vec3<V> cut = detail::shortened(v, limit);
      EXPECT_FALSE(detail::is_longer(cut, limit));
      EXPECT_GT(to_double(length(cut)), 63);
      EXPECT_LT(to_double(v.x < none ? cut.x : v.y < none ? cut.y : cut.z), 0);
    }
  } else {
    GTEST_SKIP() << "floating point has no such number";
  }
}

}  // namespace shortened_test
}  // namespace isostep
