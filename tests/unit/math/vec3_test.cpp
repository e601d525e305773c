// Vec3 against Eigen over long double, for every scalar and for directions mixed with lengths.
// SPDX-License-Identifier: MIT
#include "isostep/math/vec3.hpp"

#include "oracle.hpp"

namespace isostep {
namespace vec3_test {

using namespace test;

template <class S> class Vec3Test : public testing::Test {};
TYPED_TEST_SUITE(Vec3Test, Scalars);

TYPED_TEST(Vec3Test, SumsAndDifferencesAreThoseOfTheComponents) {
  using S = TypeParam;
  Draw draw(1);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> a = draw.vector<S>(6), b = draw.vector<S>(6);
    const Real tolerance = bound<S>(0, 1, 128);
    expect_near(real(a + b), real(a) + real(b), tolerance);
    expect_near(real(a - b), real(a) - real(b), tolerance);
    expect_near(real(-a), -real(a), 0);
    Vec3<S> c = a;
    c += b;
    EXPECT_EQ(c, a + b);
    c = a;
    c -= b;
    EXPECT_EQ(c, a - b);
  }
}

TYPED_TEST(Vec3Test, ProductsWithANumberRoundOnce) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(2);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> v = draw.vector<S>(6);
    const Vec3<U> d = draw.direction<S>();
    const S s = draw.number<S>(6);
    expect_near(real(v * s), real(v) * real(s), bound<S>(1, 1, 4096));
    expect_near(real(d * s), real(d) * real(s), bound<S>(1, 1, 64));
    expect_near(real(v * d.x), real(v) * real(d.x), bound<S>(1, 1, 64));
    EXPECT_EQ(s * v, v * s);
    EXPECT_EQ(d.x * v, v * d.x);
    const S divisor = s < S(0) ? s - S(1) : s + S(1);
    EXPECT_EQ(v / divisor, (Vec3<S>{v.x / divisor, v.y / divisor, v.z / divisor}));
  }
}

template <class V>
concept Multiplies = requires(V v) {
  v* v;
};
template <class V>
concept Divides = requires(V v) {
  v / v;
};

TYPED_TEST(Vec3Test, VectorsHaveNoProductWithoutAName) {
  EXPECT_FALSE(Multiplies<Vec3<TypeParam>>);
  EXPECT_FALSE(Divides<Vec3<TypeParam>>);
  EXPECT_TRUE(Multiplies<TypeParam>);
}

TYPED_TEST(Vec3Test, AComponentIsWrittenByItsIndex) {
  using S = TypeParam;
  Vec3<S> v = {S(1), S(2), S(3)};
  v[0] = S(4);
  v[1] += S(3);
  v[2] = v[0];
  EXPECT_EQ(v, (Vec3<S>{S(4), S(5), S(4)}));
}

TYPED_TEST(Vec3Test, LengthsAndDirections) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(9);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> a = draw.vector<S>(6), b = draw.vector<S>(6);
    EXPECT_NEAR(double(real(length(a))), double(real(a).norm()), double(bound<S>(2, 3, 128)));
    EXPECT_EQ(distance(a, b), length(b - a));
    if (length(a) < S(1)) continue;
    expect_near(real(normalise(a)), real(a).normalized(), bound<U>(4, 5, 1));
    EXPECT_EQ(heading_of(a).direction, normalise(a));
    EXPECT_EQ(heading_of(a).length, length(a));
  }
  EXPECT_EQ(normalise(Vec3<S>::zero()), Vec3<U>::zero());
  EXPECT_EQ(length(Vec3<S>{S(3), S(0), S(-4)}), S(5));
}

TYPED_TEST(Vec3Test, ScaleMultipliesComponents) {
  using S = TypeParam;
  Draw draw(3);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> a = draw.vector<S>(6), b = draw.vector<S>(6);
    const Vec3<Unit<S>> d = draw.direction<S>();
    expect_near(real(scale(a, b)), real(a).cwiseProduct(real(b)), bound<S>(1, 1, 4096));
    expect_near(real(scale(a, d)), real(a).cwiseProduct(real(d)), bound<S>(1, 1, 64));
  }
}

TYPED_TEST(Vec3Test, DotRoundsOnceAndItsSumIsExact) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(4);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> a = draw.vector<S>(6), b = draw.vector<S>(6);
    const Vec3<U> d = draw.direction<S>(), e = draw.direction<S>();
    EXPECT_NEAR(double(real(dot(a, b)) - real(a).dot(real(b))), 0, double(bound<S>(1, 3, 3 * 4096)));
    EXPECT_NEAR(double(real(dot(a, d)) - real(a).dot(real(d))), 0, double(bound<S>(1, 3, 128)));
    EXPECT_NEAR(double(real(dot(d, e)) - real(d).dot(real(e))), 0, double(bound<U>(1, 3, 3)));
    EXPECT_EQ(dot(a, b), round_to<S>(dot_sum(a, b)));
    // Exact sums cancel to nothing, where rounded ones leave a rest; (x, y, 0) and (-y, x, 0) are perpendicular.
    const Vec3<S> flat = {a.x, a.y, S(0)}, turned = {-a.y, a.x, S(0)};
    EXPECT_TRUE(dot_sum(flat, turned) == widen<Sum<S>>(S(0)));
  }
}

TYPED_TEST(Vec3Test, CrossRoundsEachComponentOnce) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(5);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> a = draw.vector<S>(6), b = draw.vector<S>(6);
    const Vec3<U> d = draw.direction<S>(), e = draw.direction<S>();
    expect_near(real(cross(a, b)), real(a).cross(real(b)), bound<S>(1, 2, 2 * 4096));
    expect_near(real(cross(a, d)), real(a).cross(real(d)), bound<S>(1, 2, 128));
    expect_near(real(cross(d, e)), real(d).cross(real(e)), bound<U>(1, 2, 2));
    EXPECT_EQ(cross(a, a), Vec3<S>::zero());
  }
}

TYPED_TEST(Vec3Test, ComponentsCompareOneByOne) {
  using S = TypeParam;
  Draw draw(6);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> a = draw.vector<S>(6), b = draw.vector<S>(6);
    expect_near(real(min(a, b)), real(a).cwiseMin(real(b)), 0);
    expect_near(real(max(a, b)), real(a).cwiseMax(real(b)), 0);
    expect_near(real(abs(a)), real(a).cwiseAbs(), 0);
    EXPECT_EQ(real(max_abs(a)), real(a).cwiseAbs().maxCoeff());
    EXPECT_EQ(a[0], a.x);
    EXPECT_EQ(a[1], a.y);
    EXPECT_EQ(a[2], a.z);
    Vec3<S> c = Vec3<S>::zero();
    for (int k = 0; k < 3; ++k) c[k] = a[k];
    EXPECT_EQ(c, a);
    EXPECT_NE(c, (Vec3<S>{a.x, a.y, a.z + S(1)}));
  }
}

TYPED_TEST(Vec3Test, ConvertsBetweenFormatsOfOneWidth) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(7);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<U> d = draw.direction<S>();
    expect_near(real(convert<S>(d)), real(d), bound<S>(1, 0, 1));
    const Vec3<S> v = convert<S>(d);
    expect_near(real(convert<U>(v)), real(v), 0);
  }
  EXPECT_TRUE(is_finite(Vec3<S>{S(1), S(2), S(3)}));
}

TEST(Vec3OfFloats, IsNotFiniteWhenAComponentIsNot) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(is_finite(Vec3<float>{infinity, 0, 0}));
  EXPECT_FALSE(is_finite(Vec3<float>{0, -infinity, 0}));
  EXPECT_FALSE(is_finite(Vec3<double>{0, 0, std::numeric_limits<double>::quiet_NaN()}));
}

/// (t, u, n) orthonormal and right-handed. Six roundings of numbers below one lie between n and the basis, and n itself
/// is 2 ulp from unit length; the division by 1 + |n.z| >= 1 does not magnify.
template <class U> void expect_basis(Vec3<U> n) {
  const Tangents<U> basis = tangents_of(n);
  const RealVec t = real(basis.t), u = real(basis.u), m = real(n);
  const auto tolerance = static_cast<double>(bound<U>(16, 16, 1));
  EXPECT_NEAR(double(t.squaredNorm() - 1), 0, tolerance) << m.transpose();
  EXPECT_NEAR(double(u.squaredNorm() - 1), 0, tolerance) << m.transpose();
  EXPECT_NEAR(double(t.dot(u)), 0, tolerance) << m.transpose();
  EXPECT_NEAR(double(t.dot(m)), 0, tolerance) << m.transpose();
  EXPECT_NEAR(double(u.dot(m)), 0, tolerance) << m.transpose();
  EXPECT_NEAR(double(t.cross(u).dot(m) - 1), 0, tolerance) << m.transpose();
}

TYPED_TEST(Vec3Test, TangentsCompleteANormalToABasis) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(8);
  for (int i = 0; i < kDraws; ++i) expect_basis(draw.direction<S>());
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {1, -1}) {
      Vec3<U> n = Vec3<U>::zero();
      n[axis] = U(sign);
      expect_basis(n);
    }
  }
}

TYPED_TEST(Vec3Test, TangentsHoldAtTheSeamAndAtThePoles) {
  using S = TypeParam;
  using U = Unit<S>;
  // From a tilt of one raw unit to a quarter turn, off the plane n.z = 0 and off both poles.
  for (int k = 1; k < 30; ++k) {
    // normalised in U itself, for a double is not fine enough for Q2.62
    const auto tilted = [k](int x, int y, int z) {
      const U tilt = from_double<U>(std::ldexp(0.5, -k));
      const auto part = [tilt](int i) {
        return i == 2 ? U(0.5) : i == -2 ? U(-0.5) : i == 1 ? tilt : i == -1 ? -tilt : U(0);
      };
      const Quat<U> q = normalise(Quat<U>{part(x), part(y), part(z), U(0)});
      return Vec3<U>{q.x, q.y, q.z};
    };
    for (const int small : {1, -1}) {
      for (const int large : {2, -2}) {
        expect_basis(tilted(large, 0, small));
        expect_basis(tilted(0, large, small));
        expect_basis(tilted(small, 0, large));
        expect_basis(tilted(0, small, large));
        expect_basis(tilted(small, small, large));
      }
    }
  }
}

TEST(Tangents, NeverOverflowTheUnitFormat) {
  using U = Fixed<std::int32_t, 30, Overflow::trap>;  // stops the program where the release would wrap
  const U one = U(1), zero = U(0);
  for (const U z : {one, -one, U::from_raw(one.raw() + 1), U::from_raw(-one.raw() - 1)}) {
    const Tangents<U> basis = tangents_of(Vec3<U>{zero, zero, z});
    EXPECT_EQ(basis.t, (Vec3<U>{one, zero, zero}));
    EXPECT_EQ(basis.u.y.raw(), z < zero ? -one.raw() : one.raw());
  }
}

}  // namespace vec3_test
}  // namespace isostep
