// Mat3 against Eigen over long double, for tensors, rotations and their mixed products.
// SPDX-License-Identifier: MIT
#include "isostep/math/mat3.hpp"

#include "oracle.hpp"

namespace isostep {
namespace mat3_test {

using namespace test;

template <class T> Mat3<T> draw_matrix(Draw& draw, int exponent) {
  const Vec3<T> a = draw.vector<T>(exponent), b = draw.vector<T>(exponent), c = draw.vector<T>(exponent);
  return {{a, b, c}};
}

template <class S> class Mat3Test : public testing::Test {};
TYPED_TEST_SUITE(Mat3Test, Scalars);

TYPED_TEST(Mat3Test, SumsTransposesAndColumnsAreExact) {
  using S = TypeParam;
  Draw draw(21);
  for (int i = 0; i < kDraws; ++i) {
    const Mat3<S> a = draw_matrix<S>(draw, 5), b = draw_matrix<S>(draw, 5);
    expect_near(real(a + b), real(a) + real(b), bound<S>(0, 1, 64));
    expect_near(real(transpose(a)), real(a).transpose(), 0);
    for (int k = 0; k < 3; ++k) expect_near(real(a.column(k)), RealVec(real(a).col(k)), 0);
  }
  expect_near(real(Mat3<S>::identity()), RealMat::Identity(), 0);
  expect_near(real(Mat3<S>::diagonal({S(1), S(2), S(3)})), RealMat(RealVec(1, 2, 3).asDiagonal()), 0);
}

TYPED_TEST(Mat3Test, ProductsWithVectorsRoundEachRowOnce) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(22);
  for (int i = 0; i < kDraws; ++i) {
    const Mat3<S> m = draw_matrix<S>(draw, 5);
    const Mat3<U> r = to_matrix(draw.rotation<S>());
    const Vec3<S> v = draw.vector<S>(5);
    const Vec3<U> d = draw.direction<S>();
    expect_near(real(m * v), real(m) * real(v), bound<S>(1, 3, 3 * 1024));
    expect_near(real(r * v), real(r) * real(v), bound<S>(1, 3, 96));
    expect_near(real(m * d), real(m) * real(d), bound<S>(1, 3, 96));
    expect_near(real(r * d), real(r) * real(d), bound<U>(1, 3, 3));
    expect_near(real(transposed_times(m, v)), real(m).transpose() * real(v), bound<S>(1, 3, 3 * 1024));
    expect_near(real(transposed_times(r, v)), real(r).transpose() * real(v), bound<S>(1, 3, 96));
    expect_near(real(transposed_times(r, d)), real(r).transpose() * real(d), bound<U>(1, 3, 3));
  }
}

TYPED_TEST(Mat3Test, ProductsOfMatricesRoundEachEntryOnce) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(23);
  for (int i = 0; i < kDraws; ++i) {
    const Mat3<S> a = draw_matrix<S>(draw, 5), b = draw_matrix<S>(draw, 5);
    const Mat3<U> r = to_matrix(draw.rotation<S>()), q = to_matrix(draw.rotation<S>());
    expect_near(real(a * b), real(a) * real(b), bound<S>(1, 3, 3 * 1024));
    expect_near(real(r * a), real(r) * real(a), bound<S>(1, 3, 96));
    expect_near(real(r * q), real(r) * real(q), bound<U>(1, 3, 3));
  }
}

TYPED_TEST(Mat3Test, AQuaternionsMatrixIsItsRotation) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(24);
  for (int i = 0; i < kDraws; ++i) {
    const Quat<U> q = draw.rotation<S>();
    const RealQuat exact = real(q);
    // Eigen's formula and ours agree on any quaternion: 1 - 2 (y^2 + z^2), no use made of unit length.
    expect_near(real(to_matrix(q)), exact.toRotationMatrix(), bound<U>(1, 5, 2));
    const RealMat m = real(to_matrix(q));
    expect_near(RealMat(m * m.transpose()), RealMat::Identity(), bound<U>(24, 24, 1));
    EXPECT_NEAR(double(m.determinant() - 1), 0, double(bound<U>(24, 24, 1)));
    // And it rotates as the quaternion does: q v q*.
    const Vec3<S> v = draw.vector<S>(5);
    expect_near(real(to_matrix(q) * v), exact.normalized() * real(v), bound<S>(1, 3, 96) + 32 * bound<U>(24, 24, 1));
  }
}

TYPED_TEST(Mat3Test, HalfTurnsAreExact) {
  using U = Unit<TypeParam>;
  const U one = U(1), zero = U(0);
  expect_near(real(to_matrix(Quat<U>{one, zero, zero, zero})), RealMat(RealVec(1, -1, -1).asDiagonal()), 0);
  expect_near(real(to_matrix(Quat<U>{zero, one, zero, zero})), RealMat(RealVec(-1, 1, -1).asDiagonal()), 0);
  expect_near(real(to_matrix(Quat<U>{zero, zero, -one, zero})), RealMat(RealVec(-1, -1, 1).asDiagonal()), 0);
  expect_near(real(to_matrix(Quat<U>::identity())), RealMat::Identity(), 0);
}

TEST(Mat3OfUnits, HalfTurnsStayWithinTheFormat) {
  using U = Fixed<std::int32_t, 30, Overflow::trap>;  // stops the program where the release would wrap
  using W = Fixed<std::int64_t, 62, Overflow::trap>;
  EXPECT_EQ(to_matrix(Quat<U>{U(0), U(1), U(0), U(0)}).rows[2].z.raw(), U(-1).raw());
  EXPECT_EQ(to_matrix(Quat<W>{W(0), W(0), W(1), W(0)}).rows[0].x.raw(), W(-1).raw());
}

TYPED_TEST(Mat3Test, AVectorTurnedByAQuaternionIsThatOfItsMatrix) {
  using S = TypeParam;
  Draw draw(26);
  for (int i = 0; i < kDraws; ++i) {
    const auto q = draw.rotation<S>();
    const Vec3<S> v = draw.vector<S>(6);
    EXPECT_EQ(rotate(q, v), to_matrix(q) * v);
    EXPECT_NEAR(double((real(rotate(q, v)) - real(q) * real(v)).norm()), 0, double(bound<S>(8, 16, 128)));
  }
}

TYPED_TEST(Mat3Test, RotatedTensorsAreSymmetricBitForBit) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(25);
  for (int i = 0; i < kDraws; ++i) {
    const Mat3<U> r = to_matrix(draw.rotation<S>());
    const Vec3<S> d = abs(draw.vector<S>(5));
    const Mat3<S> tensor = rotate_diagonal(r, d);
    // d r rounded once, at most 1.8 of those halves meet in a row, which rounds once more
    expect_near(real(tensor), real(r) * real(d).asDiagonal() * real(r).transpose(), bound<S>(3, 4, 96));
    expect_near(real(tensor), real(transpose(tensor)), 0);
  }
}

}  // namespace mat3_test
}  // namespace isostep
