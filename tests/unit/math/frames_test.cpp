// Frames, matrices with inverses and vectors' tools against Eigen over long double, for every scalar.
// SPDX-License-Identifier: MIT
#include "isostep/math/frames.hpp"

#include <Eigen/LU>

#include "isostep/math/affine.hpp"
#include "isostep/math/vectors.hpp"
#include "oracle.hpp"

namespace isostep {
namespace frames_test {

using namespace test;

template <class S> class FramesTest : public testing::Test {};
TYPED_TEST_SUITE(FramesTest, Scalars);

TYPED_TEST(FramesTest, a_basis_keeps_the_first_vector_and_fails_on_parallels) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(41);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> a = draw.vector<S>(3), b = draw.vector<S>(3);
    const Real sine = real(a).normalized().cross(real(b).normalized()).norm();
    const Basis<U> basis = basis_of(a, b);
    if (max_abs(a) < S(1) || max_abs(b) < S(1) || sine < 0.001L) continue;
    ASSERT_TRUE(basis.is_valid);
    const RealMat m = real(basis.to_world);
    const Real tolerance = bound<U>(64, 64, 1);
    expect_near(RealMat(m * m.transpose()), RealMat::Identity(), tolerance);
    EXPECT_GT(m.determinant(), 0.5L);
    expect_near(RealVec(m.col(0)), real(a).normalized(), tolerance);
    EXPECT_GT(m.col(1).dot(real(b)), 0);
    EXPECT_NEAR(double(m.col(2).dot(real(b).normalized())), 0, double(tolerance / sine));
    EXPECT_FALSE(basis_of(a, a).is_valid);
    EXPECT_FALSE(basis_of(a, -a).is_valid);
  }
  EXPECT_FALSE(basis_of(Vec3<S>::zero(), Vec3<S>{S(1), S(0), S(0)}).is_valid);
  EXPECT_EQ(basis_of(Vec3<S>{S(2), S(0), S(0)}, Vec3<S>{S(1), S(3), S(0)}).to_world.rows[1],
            (Vec3<U>{U(0), U(1), U(0)}));
}

TYPED_TEST(FramesTest, skew_matrices_are_cross_products) {
  using S = TypeParam;
  Draw draw(42);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> a = draw.vector<S>(3), b = draw.vector<S>(3);
    EXPECT_EQ(skew_of(a) * b, cross(a, b));
  }
}

TYPED_TEST(FramesTest, tensors_change_their_basis) {
  using S = TypeParam;
  Draw draw(43);
  for (int i = 0; i < kDraws; ++i) {
    const Mat3<Unit<S>> r = to_matrix(draw.rotation<S>());
    const Vec3<S> x = draw.vector<S>(2), y = draw.vector<S>(2), z = draw.vector<S>(2);
    const Mat3<S> m = {{x, y, z}};
    const RealMat expected = real(r) * real(m) * real(r).transpose();
    expect_near(real(change_of_basis(r, m)), expected, bound<S>(8, 24, 8) + bound<Unit<S>>(64, 0, 8));
  }
}

TYPED_TEST(FramesTest, other_hands_mirror_what_is_done) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(44);
  for (int i = 0; i < kDraws; ++i) {
    const Quat<U> q = draw.rotation<S>();
    const Vec3<S> v = draw.vector<S>(3), w = draw.vector<S>(1);
    EXPECT_EQ(other_hand(other_hand(v)), v);
    EXPECT_EQ(other_hand(other_hand(q)), q);
    EXPECT_EQ(rotate(other_hand(q), other_hand(v)), other_hand(rotate(q, v)));
    EXPECT_EQ(cross(other_hand_axial(w), other_hand(v)), other_hand(cross(w, v)));
    const Transform<S> t = Transform<S>::of({v, q});
    EXPECT_EQ(to_world(other_hand(t), other_hand(w)), other_hand(to_world(t, w)));
    const Transform<S> again = Transform<S>::of(other_hand(Pose<S>{v, q}));
    for (int row = 0; row < 3; ++row) EXPECT_EQ(again.rotation.rows[row], other_hand(t).rotation.rows[row]);
  }
}

TYPED_TEST(FramesTest, inverses_undo_maps_of_any_size_or_say_that_there_is_none) {
  using S = TypeParam;
  Draw draw(45);
  int found = 0;
  for (int i = 0; i < kDraws; ++i) {
    const int size = i % 5 - 2;
    const Vec3<S> x = draw.vector<S>(size), y = draw.vector<S>(size), z = draw.vector<S>(size);
    const Mat3<S> m = {{x, y, z}};
    const RealMat exact = real(m);
    const Real volume =
        std::abs(exact.determinant()) / (exact.row(0).norm() * exact.row(1).norm() * exact.row(2).norm());
    if (!(volume > 0.05L)) continue;
    const Inverse<Mat3<S>> inverse = inverse_of(m);
    ASSERT_TRUE(inverse.exists) << i;
    ++found;
    const Real largest = exact.inverse().cwiseAbs().maxCoeff();
    const Real shortest = exact.rowwise().norm().minCoeff();  // a row's length is rounded to S
    const Real tolerance = bound<S>(8, 16, largest / volume) / std::min(shortest, Real(1)) +
                           (half_ulp<S>(shortest) / shortest + bound<Unit<S>>(32, 32, 1) / volume) * largest * 2;
    expect_near(real(inverse.inverse), exact.inverse(), tolerance);
    EXPECT_NEAR(double(real(determinant(m)) - exact.determinant()), 0, double(bound<S>(24, 24, 200)));
    const Affine<S> map = {m, draw.vector<S>(2)};
    const Inverse<Affine<S>> back = inverse_of(map);
    ASSERT_TRUE(back.exists);
    const Vec3<S> p = draw.vector<S>(1);
    const Real there = largest * 40;
    expect_near(real(back.inverse.point(map.point(p))), real(p), tolerance * 64 + half_ulp<S>(there) * 64);
    EXPECT_FALSE(inverse_of(Mat3<S>{{x, y, x + y}}).exists && kIsFixed<S>);
    EXPECT_FALSE(inverse_of(Mat3<S>{{x, y, x}}).exists);
  }
  EXPECT_GT(found, kDraws / 2);
  EXPECT_FALSE(inverse_of(Mat3<S>::diagonal({S(1), S(0), S(1)})).exists);
  const Inverse<Mat3<S>> halves = inverse_of(Mat3<S>::diagonal({S(2), S(2), S(2)}));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(halves.inverse.rows[i][i], S(0.5));
  if constexpr (kIsFixed<S>) {
    EXPECT_FALSE(inverse_of(Mat3<S>::diagonal({resolution<S>(), S(1), S(1)})).exists);
  }
}

TYPED_TEST(FramesTest, rigid_motions_are_affine) {
  using S = TypeParam;
  Draw draw(46);
  for (int i = 0; i < kDraws; ++i) {
    const Transform<S> t = Transform<S>::of({draw.vector<S>(3), draw.rotation<S>()});
    const Vec3<S> p = draw.vector<S>(2);
    expect_near(real(affine_of(t).point(p)), real(to_world(t, p)), bound<S>(16, 16, 32));
    const Affine<S> both = compose(affine_of(t), affine_of(t));
    expect_near(real(both.point(p)), real(to_world(t, to_world(t, p))), bound<S>(64, 64, 64));
    expect_near(real(both.direction(p)), real(both.point(p) - both.point(Vec3<S>::zero())), bound<S>(16, 32, 64));
  }
}

TYPED_TEST(FramesTest, vectors_are_cut_split_and_mirrored) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(47);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> a = draw.vector<S>(3), b = draw.vector<S>(3);
    const Vec3<U> n = draw.direction<S>();
    const S most = abs(draw.number<S>(3));
    const Real tolerance = bound<S>(8, 16, 16) + bound<U>(16, 16, 1) * 16;
    const Vec3<S> cut = clamp_length(a, most);
    EXPECT_NEAR(double(real(cut).norm() - std::min(real(a).norm(), real(most))), 0, double(tolerance));
    if (length(a) <= most) {
      EXPECT_EQ(cut, a);
    }
    const Vec3<S> moved = move_towards(a, b, most);
    const Real way = (real(b) - real(a)).norm();
    EXPECT_NEAR(double((real(b) - real(moved)).norm() - std::max(Real(0), way - real(most))), 0, double(tolerance * 2));
    EXPECT_EQ(move_towards(a, b, S(64)), b);
    expect_near(real(project_on_line(a, n)), RealVec(real(n) * real(n).dot(real(a))), tolerance);
    expect_near(real(project_on_line(a, n) + project_on_plane(a, n)), real(a), bound<S>(0, 4, 16));
    expect_near(real(reflect(a, n)), RealVec(real(a) - 2 * real(n) * real(n).dot(real(a))), tolerance * 2);
    const Vec3<S> low = min(a, b), high = max(a, b);
    EXPECT_EQ(clamp(low, a, a), a);
    EXPECT_EQ(clamp(high + high, low, high), max(low, min(high + high, high)));
  }
}

TYPED_TEST(FramesTest, angles_between_vectors_keep_their_digits) {
  using S = TypeParam;
  Draw draw(48);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> a = draw.vector<S>(2), axis = draw.vector<S>(2);
    Vec3<S> b = draw.vector<S>(2);
    if (i % 3 == 1) b = a + draw.vector<S>(-6);
    if (max_abs(a) < S(0.5) || max_abs(b) < S(0.5)) continue;
    const Real angle = std::atan2(real(a).cross(real(b)).norm(), real(a).dot(real(b)));
    const Real tolerance = half_ulp<S>(4) * 2 + bound<Unit<S>>(32, 32, 1);
    EXPECT_NEAR(double(real(angle_between(a, b)) - angle), 0, double(tolerance));
    const Real side = real(a).cross(real(b)).dot(real(axis));
    if (std::abs(side) < 0.01L) continue;
    EXPECT_NEAR(double(real(signed_angle(a, b, axis)) - (side < 0 ? -angle : angle)), 0, double(tolerance));
  }
  EXPECT_EQ(angle_between(Vec3<S>::zero(), Vec3<S>{S(1), S(0), S(0)}), S(0));
}

}  // namespace frames_test
}  // namespace isostep
