// Times of impact against densely sampled motions in double: never late, and early by the target alone.
// SPDX-License-Identifier: MIT
#include "isostep/collision/continuous/time_of_impact.hpp"

#include <gtest/gtest.h>

#include <array>

#include "unit/collision/query/cores.hpp"

namespace isostep::test {
namespace time_of_impact_test {

using oracle::D3;
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;

using QuatD = Quat<double>;
template <class S> CoreMotion<double> real(const CoreMotion<S>& motion) {
  const auto pose = [](const Pose<S>& p) {
    const Quat<Unit<S>> q = p.orientation;
    return Pose<double>{oracle::real(p.position),
                        normalise(QuatD{to_double(q.x), to_double(q.y), to_double(q.z), to_double(q.w)})};
  };
  return {pose(motion.start), pose(motion.end), oracle::real(motion.centre)};
}

template <class S> class TimeOfImpactTest : public testing::Test {
 protected:
  using U = Unit<S>;
  static Quat<U> made(QuatD q) {
    return normalise(Quat<U>{from_double<U>(q.x), from_double<U>(q.y), from_double<U>(q.z), from_double<U>(q.w)});
  }
  static QuatD turned(D3 by) {
    const double angle = oracle::length(by);
    if (angle == 0) return QuatD::identity();
    const D3 v = by * (isostep::sin(angle / 2) / angle);
    return {v.x, v.y, v.z, isostep::cos(angle / 2)};
  }
  /// A motion from somewhere by `way`, turning by `turn` about `centre`, in the solid's frame.
  CoreMotion<S> motion(D3 at, D3 way, D3 turn, D3 centre) {
    const Quat<U> start = random_.template orientation<S>();
    const QuatD q = {to_double(start.x), to_double(start.y), to_double(start.z), to_double(start.w)};
    const Quat<U> end = made(normalise(turned(turn) * q));
    const D3 moved = at + rotate(q, centre) + way - rotate(normalise(turned(turn) * q), centre);
    return {{oracle::made<S>(at), start}, {oracle::made<S>(moved), end}, oracle::made<S>(centre)};
  }
  /// [m] The rounding of cores of this size, this far apart, this far from the origin.
  static double rounding(double reach, double far) {
    using F = Finer<S>;
    return 24 * to_double(resolution<F>()) + reach * to_double(resolution<Unit<F>>()) * 32 +
           8 * to_double(resolution<S>()) * (kIsFixed<S> ? 1 : reach + far);
  }

  oracle::Random random_{1};
};
TYPED_TEST_SUITE(TimeOfImpactTest, Scalars);

/// Two motions in double.
template <class S> class Meeting {
 public:
  Meeting(const TestCore<S>& a, const CoreMotion<S>& of_a, const TestCore<S>& b, const CoreMotion<S>& of_b)
      : a_(a.real_core()), b_(b.real_core()), of_a_(real(of_a)), of_b_(real(of_b)) {}
  Gap at(double t) const { return between(pose_at(of_a_, t), pose_at(of_b_, t)); }
  Gap between(const Pose<double>& of_a, const Pose<double>& of_b) const {
    Transform<double> ta = Transform<double>::of(of_a), tb = Transform<double>::of(of_b);
    tb.position -= ta.position;
    ta.position = {0, 0, 0};
    return gap_of(a_, ta, b_, tb);
  }
  /// [m] A bound of how near they come up to `end`.
  double nearest(double end) const {
    double least = 1e300;
    for (int i = 0; i <= 100; ++i) least = std::min(least, at(end * i / 100).least);
    return least;
  }

 private:
  ConvexCore<double> a_, b_;
  CoreMotion<double> of_a_, of_b_;
};

TYPED_TEST(TimeOfImpactTest, is_that_of_the_sampled_motions) {
  using S = TypeParam;
  int none = 0, touch = 0, at_start = 0, cut_off = 0, rounds = 0, most = 0;
  for (int n = 0; n < 4000; ++n) {
    const double scale = n % 7 == 0 ? 0.05 : n % 7 == 1 ? 8 : 0.5;
    const TestCore<S> a = random_core<S>(static_cast<CoreKind>(n % 5), scale, this->random_);
    const TestCore<S> b = random_core<S>(static_cast<CoreKind>(n / 5 % 5), scale, this->random_);
    const D3 at = n % 3 == 0 ? D3{240, -130, 220} : D3{0, 0, 0}, from = this->random_.direction();
    const double apart = (a.size + b.size) * this->random_.in(0.7, 2), most_turn = n % 4 == 0 ? 1.5 : 0.5;
    const double length = apart * this->random_.in(0.3, 2);
    const D3 way = (from + this->random_.direction() * 0.7) * length;
    const D3 turn_a = n % 6 == 0 ? D3{0, 0, 0} : this->random_.point(most_turn),
             turn_b = this->random_.point(most_turn);
    const D3 centre = n % 5 == 0 ? this->random_.point(0.5 * scale) : D3{0, 0, 0};
    const CoreMotion<S> of_a = this->motion(at, way * 0.6, turn_a, centre);
    const CoreMotion<S> of_b = this->motion(at + from * apart, way * -0.4, turn_b, {0, 0, 0});
    const double target = 0.004 * scale, far = oracle::length(at);
    const TimeOfImpact<S> found = time_of_impact(a.core(), of_a, b.core(), of_b, from_double<S>(target));
    const double error = this->rounding(2 * (a.size + b.size + apart), far);
    const Meeting<S> meeting(a, of_a, b, of_b);
    const double t = to_double(found.fraction);
    if (found.impact == Impact::at_start) {
      ++at_start;
      ASSERT_EQ(found.fraction, Unit<S>(0)) << n;
      ASSERT_LT(meeting.at(0).most, target / 2 + 8 * error) << n;
      continue;
    }
    rounds += found.rounds;
    most = std::max(most, found.rounds);
    ASSERT_GT(meeting.nearest(t), target / 2 - error) << n << " status " << static_cast<int>(found.impact);
    if (found.impact == Impact::none) {
      ++none;
      ASSERT_EQ(found.fraction, Unit<S>(1)) << n;
      continue;
    }
    if (found.impact == Impact::cut_off) {
      ++cut_off;
      continue;
    }
    ++touch;
    ASSERT_LT(meeting.at(t).most, target + 8 * error) << n;
    ASSERT_GT(to_double(found.separation), target / 2 - error) << n;
    // Where the scalar has them.
    const CoreMotion<S> there = {pose_at(of_a, found.fraction), pose_at(of_b, found.fraction), Vec3<S>::zero()};
    const CoreMotion<double> poses = real(there);
    ASSERT_GT(meeting.between(poses.start, poses.end).least, target / 2 - 2 * error) << n;
    const D3 on_a = oracle::real(found.on_a), on_b = oracle::real(found.on_b), normal = oracle::real(found.normal);
    ASSERT_NEAR(dot(on_b - on_a, normal), meeting.at(t).most, 16 * error) << n;
  }
  EXPECT_GT(none, 500);
  EXPECT_GT(touch, 800);
  EXPECT_GT(at_start, 100);
  EXPECT_LT(rounds, 4 * (none + touch));
  EXPECT_LT(most, 32);
  EXPECT_EQ(cut_off, 0);
}

/// The bodies of the bullets' scene against its wall, a centimetre to either side of x = 0.
TYPED_TEST(TimeOfImpactTest, spinning_rods_and_bullets_stop_at_a_thin_wall) {
  using S = TypeParam;
  constexpr double kTarget = 0.002, kThick = 0.01;
  const TestCore<S> wall = box_core<S>({kThick, 30, 20});
  TestCore<S> sphere;
  sphere.add({0, 0, 0});
  sphere.thicken(0.05);
  const std::array<TestCore<S>, 3> bodies = {sphere, box_core<S>({0.05, 0.05, 0.05}), box_core<S>({0.01, 0.01, 0.25})};
  const Pose<S> still = Pose<S>::identity();
  int stopped = 0, cut_off = 0, most = 0;
  double early = 0;
  for (int n = 0; n < 999; ++n) {
    const TestCore<S>& body = bodies[static_cast<std::size_t>(n % 3)];
    const double speed = n % 3 == 2 ? this->random_.in(5, 50) : this->random_.in(20, 300);
    const double y = this->random_.in(-20, 20), x = this->random_.in(-5, -3);
    const D3 turn = this->random_.point(n % 3 == 2 ? 50 : 30) * (1.0 / 60);
    Pose<S> pose = {oracle::made<S>({x, y, 0}), this->random_.template orientation<S>()};
    for (int step = 0; step < 90; ++step) {
      const Quat<Unit<S>> next = normalise(this->made(this->turned(turn)) * pose.orientation);
      const Vec3<S> way = oracle::made<S>({speed / 60, 0, 0});
      const CoreMotion<S> motion = {pose, {pose.position + way, next}, Vec3<S>::zero()};
      const TimeOfImpact<S> found =
          time_of_impact(body.core(), motion, wall.core(), {still, still, Vec3<S>::zero()}, from_double<S>(kTarget));
      ASSERT_NE(found.impact, Impact::at_start) << n;
      pose = pose_at(motion, found.fraction);
      const Transform<double> there = oracle::real(Transform<S>::of(pose));
      double furthest = -1e300;
      for (const D3 v : body.real) furthest = std::max(furthest, to_world(there, v).x + to_double(body.radius));
      ASSERT_LT(furthest, -kThick - kTarget / 2 + 1e-4) << n << ": never through, nor nearer than half the target";
      if (found.impact == Impact::none) continue;
      ++stopped;
      cut_off += found.impact == Impact::cut_off ? 1 : 0;
      most = std::max(most, found.rounds);
      early = std::max(early, -kThick - furthest);
      break;
    }
    ASSERT_EQ(stopped, n + 1);
  }
  EXPECT_EQ(cut_off, 0);
  EXPECT_LT(most, 10);
  EXPECT_LT(early, kTarget + 1e-4);
}

/// A rod that turns in place meets a ball beside it at the angle where the ball touches its side.
TYPED_TEST(TimeOfImpactTest, a_turn_alone_meets_at_its_angle) {
  using S = TypeParam;
  TestCore<S> rod, ball;
  rod.add({-1, 0, 0}), rod.add({1, 0, 0});
  rod.thicken(0.0625);
  ball.add({0, 0, 0});
  ball.thicken(0.125);
  const Pose<S> start = Pose<S>::identity();
  for (double angle = 0.4; angle < 1.5; angle += 0.1) {
    const Pose<S> end = {Vec3<S>::zero(), this->made(this->turned({0, 0, angle + 1}))};
    const D3 at = {0.75 * isostep::cos(angle), 0.75 * isostep::sin(angle), 0};
    const Pose<S> there = {oracle::made<S>(at), start.orientation};
    const S target = from_double<S>(1e-3);
    const TimeOfImpact<S> found =
        time_of_impact(rod.core(), {start, end, Vec3<S>::zero()}, ball.core(), {there, there, Vec3<S>::zero()}, target);
    ASSERT_EQ(found.impact, Impact::touch);
    const Quat<Unit<S>> q = pose_at(CoreMotion<S>{start, end, Vec3<S>::zero()}, found.fraction).orientation;
    const double turned = 2 * isostep::atan2(to_double(q.z), to_double(q.w));
    const double touching = angle - isostep::asin((0.0625 + 0.125) / 0.75);
    EXPECT_LT(turned, touching - 0.4e-3);
    EXPECT_GT(turned, touching - 2e-3);
  }
}

TYPED_TEST(TimeOfImpactTest, what_does_not_move_is_apart_or_touches_at_the_start) {
  using S = TypeParam;
  const TestCore<S> box = box_core<S>({0.5, 0.5, 0.5});
  const auto at = [](double x) { return Pose<S>{{from_double<S>(x), S(0), S(0)}, Quat<Unit<S>>::identity()}; };
  const auto found = [&](double x, double way) {
    return time_of_impact(box.core(), {at(0), at(0), Vec3<S>::zero()}, box.core(),
                          {at(x), at(x + way), Vec3<S>::zero()}, from_double<S>(0.01));
  };
  EXPECT_EQ(found(1.02, 0).impact, Impact::none);
  EXPECT_EQ(found(1.02, 5).impact, Impact::none);
  EXPECT_EQ(found(1.007, 5).impact, Impact::none);
  EXPECT_EQ(found(1.003, 5).impact, Impact::at_start);
  EXPECT_EQ(found(0.7, 5).impact, Impact::at_start);
  const TimeOfImpact<S> hit = found(3, -4);
  EXPECT_EQ(hit.impact, Impact::touch);
  EXPECT_NEAR(to_double(hit.fraction), 2 / 4.0, 0.0026);
  EXPECT_LT(to_double(hit.normal.x), 1.0 + 1e-6);
  EXPECT_GT(to_double(hit.normal.x), 1.0 - 1e-6);
}

}  // namespace time_of_impact_test
}  // namespace isostep::test
