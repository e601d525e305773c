// Transforms and poses against Eigen's isometries over long double.
// SPDX-License-Identifier: MIT
#include "isostep/math/transform.hpp"

#include "oracle.hpp"

namespace isostep {
namespace transform_test {

using namespace test;
using Motion = Eigen::Transform<Real, 3, Eigen::AffineCompact>;

template <class S> Motion real(const Transform<S>& t) {
  Motion m;
  m.linear() = test::real(t.rotation);
  m.translation() = test::real(t.position);
  return m;
}
template <class S> Transform<S> draw_transform(Draw& draw) {
  const Vec3<S> position = draw.vector<S>(6);
  return Transform<S>::of(Pose<S>{position, draw.rotation<S>()});
}

template <class S> class TransformTest : public testing::Test {};
TYPED_TEST_SUITE(TransformTest, Scalars);

TYPED_TEST(TransformTest, PointsGoToTheWorldAndBack) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(31);
  for (int i = 0; i < kDraws; ++i) {
    const Transform<S> t = draw_transform<S>(draw);
    const Vec3<S> p = draw.vector<S>(6);
    const RealVec world = real(t) * test::real(p);
    expect_near(test::real(to_world(t, p)), world, bound<S>(1, 5, 256));
    const RealVec local = test::real(t.rotation).transpose() * (test::real(p) - test::real(t.position));
    expect_near(test::real(to_local(t, p)), local, bound<S>(1, 6, 384));
    // There and back: each way's rounding, and how far the matrix is from orthogonal over a lever of 111.
    expect_near(test::real(to_local(t, to_world(t, p))), test::real(p),
                bound<S>(4, 16, 384) + 128 * bound<U>(24, 24, 1));
  }
}

TYPED_TEST(TransformTest, CompositionIsOneMotionAfterTheOther) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(32);
  for (int i = 0; i < kDraws; ++i) {
    const Transform<S> a = draw_transform<S>(draw), b = draw_transform<S>(draw);
    const Motion expected = real(a) * real(b);
    const Transform<S> c = compose(a, b);
    expect_near(test::real(c.position), RealVec(expected.translation()), bound<S>(1, 5, 256));
    expect_near(test::real(c.rotation), RealMat(expected.linear()), bound<U>(1, 3, 3));
  }
}

TYPED_TEST(TransformTest, RelativeUndoesTheFirstMotion) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(33);
  for (int i = 0; i < kDraws; ++i) {
    const Transform<S> a = draw_transform<S>(draw), b = draw_transform<S>(draw);
    const RealMat inverse = test::real(a.rotation).transpose();
    const Transform<S> c = relative(a, b);
    expect_near(test::real(c.position), RealVec(inverse * (test::real(b.position) - test::real(a.position))),
                bound<S>(1, 6, 384));
    expect_near(test::real(c.rotation), RealMat(inverse * test::real(b.rotation)), bound<U>(1, 3, 3));
  }
}

TYPED_TEST(TransformTest, PosesComposeAsTheirTransforms) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(34);
  for (int i = 0; i < kDraws; ++i) {
    const Pose<S> a = {draw.vector<S>(6), draw.rotation<S>()}, b = {draw.vector<S>(6), draw.rotation<S>()};
    const Pose<S> c = compose(a, b);
    const RealMat rotation = test::real(a.orientation).toRotationMatrix();
    const RealVec position = test::real(a.position) + rotation * test::real(b.position);
    expect_near(test::real(c.position), position, bound<S>(1, 5, 256) + 192 * bound<U>(1, 5, 2));
    expect_near(test::real(c.orientation), (test::real(a.orientation) * test::real(b.orientation)).normalized(),
                bound<U>(6, 12, 1));
  }
  const Pose<S> still = Pose<S>::identity();
  const Pose<S> pose = {Vec3<S>{S(1), S(2), S(3)}, Quat<U>::identity()};
  EXPECT_EQ(compose(still, pose).position, pose.position);
  EXPECT_EQ(compose(still, pose).orientation, pose.orientation);
}

}  // namespace transform_test
}  // namespace isostep
