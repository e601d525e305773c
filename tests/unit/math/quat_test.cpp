// Quat against Eigen over long double, for the unit format of every scalar.
// SPDX-License-Identifier: MIT
#include "isostep/math/quat.hpp"

#include "oracle.hpp"

namespace isostep {
namespace quat_test {

using namespace test;

template <class S> class QuatTest : public testing::Test {};
TYPED_TEST_SUITE(QuatTest, Scalars);

TYPED_TEST(QuatTest, ProductsAreHamiltons) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(11);
  for (int i = 0; i < kDraws; ++i) {
    const Quat<U> a = draw.rotation<S>(), b = draw.rotation<S>();
    expect_near(real(a * b), real(a) * real(b), bound<U>(1, 4, 4));
    EXPECT_EQ(a * Quat<U>::identity(), a);
    EXPECT_EQ(Quat<U>::identity() * a, a);
  }
}

TYPED_TEST(QuatTest, ConjugatesUndoRotations) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(12);
  for (int i = 0; i < kDraws; ++i) {
    const Quat<U> q = draw.rotation<S>();
    expect_near(real(conjugate(q)), real(q).conjugate(), 0);
    expect_near(real(q * conjugate(q)), RealQuat::Identity(), bound<U>(20, 20, 1));  // q is 3 ulp from unit length
  }
}

TYPED_TEST(QuatTest, NormalisingGivesUnitLengthAndKeepsTheAxis) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(13);
  for (int i = 0; i < kDraws; ++i) {
    Quat<U> q;
    do {
      q = {draw.number<U>(-1), draw.number<U>(-1), draw.number<U>(-1), draw.number<U>(-1)};
    } while (real(q).norm() < 0.25L);
    expect_near(real(normalise(q)), real(q).normalized(), bound<U>(4, 6, 1));  // 2 ulp fixed, 3 ulp floating
  }
  EXPECT_EQ(normalise(Quat<U>{U(0), U(0), U(0), U(0)}), Quat<U>::identity());
}

TYPED_TEST(QuatTest, RotationHasTheAngleAndTheAxisAsked) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(14);
  // Half the angle is rounded to S, sine and cosine to 2 ulp of U, then axis times sine, then normalised.
  const Real tolerance = bound<U>(16, 16, 1) + half_ulp<S>(8);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<U> axis = draw.direction<S>();
    const S angle = draw.number<S>(3);
    const RealQuat expected(Eigen::AngleAxis<Real>(real(angle), real(axis)));
    expect_near(real(rotation(axis, angle)), expected, tolerance);
  }
  // Four whole raw units: nothing is rounded before the sine, whose answer is as fine as U.
  const S small = kIsFixed<S> ? from_bits<S>(4) : S(0.001);
  const Quat<U> q = rotation(Vec3<U>{U(0), U(1), U(0)}, small);
  EXPECT_NEAR(double(real(q.y) - std::sin(real(small) / 2)), 0, double(bound<U>(6, 6, real(small))));
}

TYPED_TEST(QuatTest, IntegratingTurnsByTwiceTheArcTangentOfHalf) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(15);
  for (int i = 0; i < kDraws; ++i) {
    const Quat<U> q = draw.rotation<S>();
    const Vec3<U> turn = draw.vector<U>(i % 20 == 0 ? 0 : -(i % 20));
    const RealVec t = real(turn);
    if (t.norm() >= 2) continue;
    // The documented angle, about the world's axis: left factor.
    RealQuat expected = real(q);
    if (t.norm() > 0) {
      expected = RealQuat(Eigen::AngleAxis<Real>(2 * std::atan(t.norm() / 2), t.normalized())) * real(q).normalized();
    }
    expect_near(real(integrate(q, turn)), expected, bound<U>(12, 16, 1));
  }
}

TYPED_TEST(QuatTest, AThousandSmallTurnsStayNormalAndAddUp) {
  using S = TypeParam;
  using U = Unit<S>;
  Quat<U> q = Quat<U>::identity();
  const Vec3<U> turn = {U(0), U(0), U(0.0009765625)};  // 2^-10
  for (int i = 0; i < 1000; ++i) q = integrate(q, turn);
  const Real angle = 1000 * 2 * std::atan(real(turn.z) / 2);
  const RealQuat expected(Eigen::AngleAxis<Real>(angle, RealVec(0, 0, 1)));
  expect_near(real(q), expected, 1000 * bound<U>(12, 16, 1));
  EXPECT_NEAR(double(real(q).norm() - 1), 0, double(bound<U>(12, 12, 1)));
}

}  // namespace quat_test
}  // namespace isostep
