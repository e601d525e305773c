// Rotations of games against Eigen over long double, for every scalar.
// SPDX-License-Identifier: MIT
#include "isostep/math/rotations.hpp"

#include "isostep/math/euler.hpp"
#include "oracle.hpp"

namespace isostep {
namespace rotations_test {

using namespace test;

constexpr Real kPi = 3.14159265358979323846264338327950288L;

template <class S> class RotationsTest : public testing::Test {
 protected:
  /// The bound of an angle up to pi that went through S and U.
  static Real angle_bound() { return half_ulp<S>(4) * 4 + bound<Unit<S>>(24, 32, 1); }
  /// Expects that two quaternions are one rotation.
  static void expect_same(const RealQuat& a, const RealQuat& b, Real tolerance) {
    const bool flips = a.coeffs().dot(b.coeffs()) < 0;
    expect_near(a, flips ? RealQuat(-b.coeffs()) : b, tolerance);
  }
};
TYPED_TEST_SUITE(RotationsTest, Scalars);

TYPED_TEST(RotationsTest, axes_and_angles_come_back) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(31);
  for (int i = 0; i < kDraws; ++i) {
    const Quat<U> q = draw.rotation<S>();
    const AxisAngle<S> turn = axis_angle_of<S>(q);
    EXPECT_GE(turn.angle, S(0));
    EXPECT_LE(real(turn.angle), kPi + this->angle_bound());
    this->expect_same(real(rotation(turn.axis, turn.angle)), real(q).normalized(), this->angle_bound());
    this->expect_same(real(rotation_by(rotation_vector_of<S>(q))), real(q).normalized(), this->angle_bound() * 2);
  }
  const AxisAngle<S> none = axis_angle_of<S>(Quat<U>::identity());
  EXPECT_EQ(none.angle, S(0));
  EXPECT_EQ(none.axis, (Vec3<U>{U(0), U(1), U(0)}));
  EXPECT_EQ(rotation_by(Vec3<S>::zero()), Quat<U>::identity());
}

TYPED_TEST(RotationsTest, a_rotation_vector_is_axis_times_angle) {
  using S = TypeParam;
  Draw draw(32);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> v = draw.vector<S>(i % 4 == 0 ? -4 : 2);
    const RealVec way = real(v);
    const RealQuat expected(Eigen::AngleAxis<Real>(way.norm(), way.normalized()));
    this->expect_same(real(rotation_by(v)), expected, this->angle_bound() * 2);
  }
}

TYPED_TEST(RotationsTest, matrices_and_quaternions_agree_both_ways) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(33);
  for (int i = 0; i < kDraws; ++i) {
    Quat<U> q = draw.rotation<S>();
    if (i % 8 == 0) q = normalise(Quat<U>{q.x, q.y, q.z, U(0)});  // half turns
    if (i % 8 == 1) q = normalise(Quat<U>{U(0), q.y, U(0), q.w});
    this->expect_same(real(to_quaternion(to_matrix(q))), real(q).normalized(), bound<U>(24, 32, 1));
  }
  EXPECT_EQ(to_quaternion(Mat3<U>::identity()), Quat<U>::identity());
}

TYPED_TEST(RotationsTest, the_least_turn_leads_from_one_vector_to_the_other) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(34);
  int opposite = 0, parallel = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<U> from = draw.direction<S>();
    Vec3<U> to = draw.direction<S>();
    const Vec3<U> hair = draw.vector<U>(-3 - i % 27);
    if (i % 4 == 1) to = normalise(from + hair);
    if (i % 4 == 2) to = normalise(-from + hair);
    if (i % 40 == 3) to = from;
    if (i % 40 == 7) to = -from;
    const Quat<U> turn = rotation_between(from, to);
    expect_near(RealVec(real(turn).normalized() * real(from)), real(to), bound<U>(96, 96, 1));
    const Real angle = std::atan2(real(from).cross(real(to)).norm(), real(from).dot(real(to)));
    EXPECT_NEAR(double(real(angle_between<S>(Quat<U>::identity(), turn)) - angle), 0,
                double(this->angle_bound() + bound<U>(96, 96, 1)));
    parallel += to == from;
    opposite += to == -from;
  }
  EXPECT_GT(parallel, 20);
  EXPECT_GT(opposite, 20);
}

TYPED_TEST(RotationsTest, looking_points_z_forward_and_y_up) {
  using S = TypeParam;
  Draw draw(35);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3<S> forward = draw.vector<S>(3), up = i % 10 == 0 ? forward : draw.vector<S>(3);
    if (max_abs(forward) < S(1) || max_abs(up) < S(1)) continue;
    const RealQuat q = real(look_rotation(forward, up)).normalized();
    const RealVec z = q * RealVec(0, 0, 1), y = q * RealVec(0, 1, 0), f = real(forward).normalized();
    const Real tolerance = bound<Unit<S>>(64, 64, 1);
    expect_near(z, f, tolerance);
    const RealVec across = f.cross(real(up).normalized());
    if (across.norm() < 0.01L) continue;
    EXPECT_NEAR(double(y.dot(across) / across.norm()), 0, double(tolerance) * 200);
    EXPECT_GT(y.dot(real(up)), 0);
  }
}

TYPED_TEST(RotationsTest, interpolation_follows_the_shorter_arc) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(36);
  for (int i = 0; i < kDraws; ++i) {
    const Quat<U> a = draw.rotation<S>();
    Quat<U> b = draw.rotation<S>();
    if (i % 4 == 0) b = normalise(a * rotation(draw.direction<S>(), S(0.0009765625)));
    const U t = abs(draw.number<U>(0));
    const RealQuat expected = real(a).normalized().slerp(real(t), real(b).normalized());
    const Real apart = real(a).normalized().angularDistance(real(b).normalized());
    if (apart < kPi - 0.01L) this->expect_same(real(slerp(a, b, t)), expected, bound<U>(48, 64, 1));
    const RealQuat quick = real(nlerp(a, b, t));
    // At an even rate t of the angle; nlerp differs by up to 0.07 of a half turn's angle, by its cube of smaller ones.
    const Real off = quick.angularDistance(expected);
    EXPECT_LE(double(off), double(apart * apart * apart / 128 + bound<U>(64, 64, 1) * 8 + Real(1e-9))) << double(apart);
    this->expect_same(real(slerp(a, b, U(0))), real(a).normalized(), bound<U>(32, 32, 1));
    this->expect_same(real(slerp(a, b, U(1))), real(b).normalized(), bound<U>(48, 64, 1));
    this->expect_same(real(nlerp(a, b, U(1))), real(b).normalized(), bound<U>(32, 32, 1));
  }
}

TYPED_TEST(RotationsTest, swing_and_twist_make_the_whole) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(37);
  for (int i = 0; i < kDraws; ++i) {
    const Quat<U> q = draw.rotation<S>();
    const Vec3<U> axis = draw.direction<S>();
    const SwingTwist<U> parts = swing_twist_of(q, axis);
    this->expect_same(real(parts.swing) * real(parts.twist), real(q).normalized(), bound<U>(64, 64, 1));
    const RealVec swing(real(parts.swing).vec()), twist(real(parts.twist).vec());
    const RealVec n = real(axis).normalized();
    // Of a swing by nearly half a turn the twist has fewer digits.
    const Real open = RealQuat(real(q).w(), n.dot(real(q).vec()), 0, 0).norm();
    EXPECT_NEAR(double(swing.dot(n)), 0, double(bound<U>(64, 64, 1) / open));
    EXPECT_NEAR(double(twist.cross(n).norm()), 0, double(bound<U>(64, 64, 1)));
  }
  const SwingTwist<U> half = swing_twist_of(Quat<U>{U(1), U(0), U(0), U(0)}, Vec3<U>{U(0), U(1), U(0)});
  EXPECT_EQ(half.twist, Quat<U>::identity());
}

constexpr EulerOrder kOrders[] = {EulerOrder::xyz, EulerOrder::xzy, EulerOrder::yxz,
                                  EulerOrder::yzx, EulerOrder::zxy, EulerOrder::zyx};
constexpr int kAxes[][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
RealQuat euler(int order, Real first, Real second, Real third) {
  const Real angles[3] = {first, second, third};
  RealQuat q = RealQuat::Identity();
  for (int i = 0; i < 3; ++i) q = q * RealQuat(Eigen::AngleAxis<Real>(angles[i], RealVec::Unit(kAxes[order][i])));
  return q;
}

TYPED_TEST(RotationsTest, euler_angles_turn_in_their_order) {
  using S = TypeParam;
  Draw draw(38);
  for (int i = 0; i < kDraws; ++i) {
    const int order = i % 6;
    const Vec3<S> angles = draw.vector<S>(3);
    this->expect_same(real(rotation_of(kOrders[order], angles.x, angles.y, angles.z)),
                      euler(order, real(angles.x), real(angles.y), real(angles.z)), this->angle_bound() * 3);
  }
}

TYPED_TEST(RotationsTest, euler_angles_come_back_locked_or_not) {
  using S = TypeParam;
  using U = Unit<S>;
  Draw draw(39);
  int locked = 0;
  for (int i = 0; i < kDraws; ++i) {
    const int order = i % 6;
    Quat<U> q = draw.rotation<S>();
    const S quarter = S(1.57079632679489661923), hair = draw.number<S>(-2 - i / 6 % 16);
    const bool near = i % 3 == 0;
    const Vec3<S> angles = draw.vector<S>(1);
    const S second = i % 2 == 0 ? quarter - hair : hair - quarter;
    if (near) q = normalise(rotation_of(kOrders[order], angles.x, second, angles.z));
    const EulerAngles<S> found = euler_angles_of<S>(kOrders[order], q);
    locked += found.is_locked;
    EXPECT_LE(real(abs(found.first)), kPi + this->angle_bound());
    EXPECT_LE(real(abs(found.second)), kPi / 2 + this->angle_bound());
    EXPECT_LE(real(abs(found.third)), kPi + this->angle_bound());
    if (found.is_locked) {
      EXPECT_EQ(found.third, S(0));
    }
    this->expect_same(real(rotation_of(kOrders[order], found.first, found.second, found.third)), real(q).normalized(),
                      this->angle_bound() * 4);
    const Real away = kPi / 2 - std::abs(real(found.second));
    if (away < 0.1L) continue;  // each by itself has fewer digits there
    const RealQuat again = euler(order, real(found.first), real(found.second), real(found.third));
    this->expect_same(again, real(q).normalized(), this->angle_bound() * 4);
  }
  const Quat<U> up = rotation(Vec3<U>{U(0), U(1), U(0)}, S(1.57079632679489661923));
  EXPECT_TRUE(euler_angles_of<S>(EulerOrder::xyz, up).is_locked || kIsFixed<S>);
  const U r = sqrt(U(0.5));
  EXPECT_TRUE(euler_angles_of<S>(EulerOrder::xyz, Quat<U>{U(0), r, U(0), r}).is_locked);
  EXPECT_TRUE(euler_angles_of<S>(EulerOrder::zxy, Quat<U>{-r, U(0), U(0), r}).is_locked);
  EXPECT_FALSE(euler_angles_of<S>(EulerOrder::xyz, Quat<U>::identity()).is_locked);
}

}  // namespace rotations_test
}  // namespace isostep
