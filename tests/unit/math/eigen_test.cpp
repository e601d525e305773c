// Conversions between our vectors and Eigen's, by copy and in place.
// SPDX-License-Identifier: MIT
#include "isostep/math/eigen.hpp"

#include "oracle.hpp"

namespace isostep {
namespace eigen_test {

using namespace test;

template <class S> class EigenConversion : public testing::Test {};
TYPED_TEST_SUITE(EigenConversion, Scalars);

TYPED_TEST(EigenConversion, CopiesKeepEveryBit) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(51);
  for (int i = 0; i < 200; ++i) {
    const Vec3<S> v = draw.vector<S>(5);
    const Quat<U> q = draw.rotation<S>();
    const Mat3<U> m = to_matrix(q);
    EXPECT_EQ(vec3_from(to_eigen(v)), v);
    EXPECT_EQ(quat_from(to_eigen(q)), q);
    for (int r = 0; r < 3; ++r) EXPECT_EQ(mat3_from(to_eigen(m)).rows[r], m.rows[r]);
    EXPECT_EQ(real(detail::native(to_eigen(q).w())), real(q.w));
    EXPECT_EQ(real(detail::native(to_eigen(m)(0, 2))), real(m.rows[0].z));
  }
}

TYPED_TEST(EigenConversion, MapsReadAndWriteInPlace) {
  using S = TypeParam;
  using U = Unit<S>;
  Vec3<S> v = {S(1), S(2), S(3)};
  map(v) *= EigenScalar<S>(2);
  EXPECT_EQ(v, (Vec3<S>{S(2), S(4), S(6)}));
  Mat3<S> m = Mat3<S>::diagonal({S(1), S(2), S(3)});
  map(m)(0, 2) = EigenScalar<S>(7);
  EXPECT_EQ(m.rows[0], (Vec3<S>{S(1), S(0), S(7)}));
  map(m).transposeInPlace();
  EXPECT_EQ(m.rows[2], (Vec3<S>{S(7), S(0), S(3)}));
  Quat<U> q = {U(0.5), U(-0.5), U(0.25), U(1)};
  EXPECT_EQ(quat_from(map(q)), q);
  map(q).w() = EigenScalar<U>(U(0.125));
  EXPECT_EQ(q.w, U(0.125));
  const Vec3<S>& fixed = v;
  EXPECT_EQ(vec3_from(map(fixed)), v);
  const Mat3<S>& constant = m;
  EXPECT_EQ(mat3_from(map(constant)).rows[1], m.rows[1]);
  const Quat<U>& still = q;
  EXPECT_EQ(quat_from(map(still)), q);
}

TYPED_TEST(EigenConversion, ProductsThroughMapsAreOurs) {
  using S = TypeParam;
  Draw draw(52);
  for (int i = 0; i < 200; ++i) {
    const Vec3<S> a = draw.vector<S>(5), b = draw.vector<S>(5);
    // Eigen rounds every product, we round the sum.
    expect_near(real(vec3_from(map(a).cross(map(b)))), real(a).cross(real(b)), bound<S>(2, 2, 2 * 1024));
    const Real dot = real(detail::native(map(a).dot(map(b))));
    EXPECT_NEAR(double(dot - real(a).dot(real(b))), 0, double(bound<S>(3, 3, 3072)));
  }
}

TEST(EigenTypes, LayoutsDoNotDependOnTheInstructionSet) {
  EXPECT_EQ(alignof(EigenQuat<float>), alignof(float));
  EXPECT_EQ(alignof(EigenQuat<double>), alignof(double));
  EXPECT_EQ(sizeof(EigenQuat<double>), 4 * sizeof(double));
  EXPECT_EQ(sizeof(EigenMat3<float>), 9 * sizeof(float));
}

}  // namespace eigen_test
}  // namespace isostep
