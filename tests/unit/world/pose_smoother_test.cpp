// Corrected bodies are drawn without a jump and soon where they are; all others exactly where they are.
// SPDX-License-Identifier: MIT
#include "isostep/replay/pose_smoother.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "isostep/core/random.hpp"
#include "isostep/state/concepts.hpp"
#include "unit/world/worlds.hpp"

namespace isostep {
namespace pose_smoother_test {

using namespace test;

/// The part of a world that a smoother asks of.
struct Stage {
  std::vector<RenderPose> poses;
  const std::vector<RenderPose>& poses_float(float) { return poses; }
};
constexpr BodyId kBody = {3, 1};

/// The pose at x [m], turned by `angle` [rad] about y.
RenderPose at(double x, double angle = 0, BodyId body = kBody) {
  return {body,
          {static_cast<float>(x), 1, 2},
          {0, static_cast<float>(std::sin(angle / 2)), 0, static_cast<float>(std::cos(angle / 2))}};
}
Stage only(const RenderPose& pose) { return {{pose}}; }
/// [rad] The angle between two orientations.
double angle(const RenderPose& p, const RenderPose& q) {
  double dot = 0;
  for (int i = 0; i < 4; ++i) dot += double{p.orientation[i]} * q.orientation[i];
  return 2 * std::acos(std::min(1.0, std::fabs(dot)));
}
double angle_of(const RenderPose& pose) { return 2 * std::atan2(pose.orientation[1], pose.orientation[3]); }

bool same(const RenderPose& p, const RenderPose& q) {
  bool equal = p.body == q.body;
  for (int i = 0; i < 3; ++i) equal = equal && p.position[i] == q.position[i];
  for (int i = 0; i < 4; ++i) equal = equal && p.orientation[i] == q.orientation[i];
  return equal;
}
bool same(const std::vector<RenderPose>& p, const std::vector<RenderPose>& q) {
  bool equal = p.size() == q.size();
  for (std::size_t i = 0; equal && i < p.size(); ++i) equal = same(p[i], q[i]);
  return equal;
}

/// Corrects: believed there after frame `present`, and after a rollback by some frames found here.
void correct(PoseSmoother& smoother, Stage there, Stage here, Frame present = 9, Frame back = 3) {
  smoother.after_step(present, there);
  Stage past;  // what is seen on the way is of no interest
  for (Frame frame = present - back; frame < present; ++frame) smoother.after_step(frame, past);
  smoother.after_step(present, here);
}
RenderPose drawn(PoseSmoother& smoother, const RenderPose& pose, double dt) {
  return smoother.smooth({pose}, static_cast<float>(dt)).at(0);
}

TEST(PoseSmoother, WithoutCorrectionsPosesAreDrawnExactly) {
  PoseSmoother smoother;
  Pcg32 random = Pcg32::seeded(1);
  const auto number = [&] { return static_cast<float>(random.next_u24()) * 0x1p-20f; };
  for (Frame frame = 0; frame < 100; ++frame) {
    Stage stage;
    for (std::uint32_t slot = 0; slot < 5; ++slot) {
      stage.poses.push_back({{slot, 1}, {number(), number(), number()}, {number(), number(), number(), number()}});
    }
    smoother.after_step(frame, stage);
    ASSERT_TRUE(same(smoother.smooth(stage.poses, 0.01f), stage.poses));
  }
}

TEST(PoseSmoother, ARollbackThatChangesNothingIsNotSeen) {
  PoseSmoother smoother;
  correct(smoother, only(at(0.3, 1)), only(at(0.3, 1)));
  EXPECT_TRUE(same(drawn(smoother, at(0.4, 1.1), 0), at(0.4, 1.1)));
}

TEST(PoseSmoother, ACorrectedBodyIsDrawnWhereItWasBelievedAndHalfwayAfterAHalfLife) {
  for (const Frame back : {0, 1, 5}) {
    PoseSmoother smoother({.half_life = 0.1f});
    correct(smoother, only(at(5)), only(at(4)), 9, back);
    EXPECT_NEAR(drawn(smoother, at(4), 0).position[0], 5, 1e-6);
    EXPECT_NEAR(drawn(smoother, at(4), -1).position[0], 5, 1e-6) << "a clock that runs backwards does not add to it";
    EXPECT_NEAR(drawn(smoother, at(4), 0.1).position[0], 4.5, 1e-6);
    EXPECT_NEAR(drawn(smoother, at(4), 0.1).position[0], 4.25, 1e-6);
    EXPECT_NEAR(drawn(smoother, at(14), 0.3).position[0], 14 + 1 / 32.0, 2e-6) << "what moves on is drawn beside it";
  }
}

TEST(PoseSmoother, HowOftenAPictureIsDrawnDoesNotMatter) {
  for (const int pictures : {1, 3, 7, 50}) {
    PoseSmoother smoother({.half_life = 0.1f});
    correct(smoother, only(at(1)), only(at(0)));
    for (int i = 0; i < pictures; ++i) smoother.smooth({at(0)}, static_cast<float>(0.25 / pictures));
    EXPECT_NEAR(drawn(smoother, at(0), 0).position[0], std::exp2(-2.5), 2e-6) << pictures;
  }
}

TEST(PoseSmoother, ASmallTurnHalvesWithEveryHalfLife) {
  PoseSmoother smoother({.half_life = 0.1f});
  correct(smoother, only(at(0, 1.02)), only(at(0, 1)));
  EXPECT_NEAR(angle_of(drawn(smoother, at(0, 1), 0)), 1.02, 1e-6);
  EXPECT_NEAR(angle_of(drawn(smoother, at(0, 1), 0.1)), 1.01, 1e-6);
  EXPECT_NEAR(angle_of(drawn(smoother, at(0, 1), 0.1)), 1.005, 1e-6);
  EXPECT_NEAR(angle_of(drawn(smoother, at(0, 2), 0.1)), 2.0025, 1e-6);
}

/// The middle of the straight line between two unit quaternions halves the angle between them, however large.
TEST(PoseSmoother, ALargeTurnHalvesTooAndGoesTheShorterWay) {
  for (const double turn : {3.0, -3.0, kPi + 1}) {
    PoseSmoother smoother({.half_life = 0.1f});
    correct(smoother, only(at(0, 0.1 + turn)), only(at(0, 0.1)));
    const double shorter = turn > kPi ? turn - 2 * kPi : turn;
    EXPECT_NEAR(angle_of(drawn(smoother, at(0, 0.1), 0.1)), 0.1 + shorter / 2, 1e-6) << turn;
  }
}

TEST(PoseSmoother, TheTurnIsTakenInTheWorldsFrame) {
  // Believed: turned by 0.02 about the world's y after a quarter turn about x. Found: the quarter turn alone.
  const float r = std::sqrt(0.5f), s = std::sin(0.01f), c = std::cos(0.01f);
  const RenderPose found = {kBody, {0, 0, 0}, {r, 0, 0, r}};
  const RenderPose believed = {kBody, {0, 0, 0}, {c * r, s * r, -s * r, c * r}};
  // Meanwhile it was turned about z by the other quarter: drawn is y(0.02) z(90) x(90).
  const RenderPose now = {kBody, {0, 0, 0}, {0.5f, 0.5f, 0.5f, 0.5f}};
  PoseSmoother smoother;
  correct(smoother, only(believed), only(found));
  const RenderPose shown = drawn(smoother, now, 0);
  // (0, s, 0, c) times (1, 1, 1, 1) / 2.
  EXPECT_NEAR(shown.orientation[0], (c + s) / 2, 1e-6);
  EXPECT_NEAR(shown.orientation[1], (c + s) / 2, 1e-6);
  EXPECT_NEAR(shown.orientation[2], (c - s) / 2, 1e-6);
  EXPECT_NEAR(shown.orientation[3], (c - s) / 2, 1e-6);
}

TEST(PoseSmoother, AnyErrorIsGoneFifteenHalfLivesAfterItsCorrection) {
  for (const int pictures : {1, 15, 200}) {
    PoseSmoother smoother({.half_life = 0.1f, .snap_distance = 2});
    correct(smoother, only(at(2, 3.1)), only(at(0)));
    drawn(smoother, at(0), 0.7);
    EXPECT_GT(drawn(smoother, at(0), 0).position[0], 0.01f);
    for (int i = 0; i < pictures; ++i) smoother.smooth({at(0)}, static_cast<float>(0.8 / pictures));
    EXPECT_TRUE(same(drawn(smoother, at(0), 0.001), at(0))) << pictures;
  }
}

TEST(PoseSmoother, ABodyDrawnFurtherOffThanTheSnapDistanceJumps) {
  PoseSmoother smoother({.snap_distance = 2});
  correct(smoother, only(at(2.01, 1)), only(at(0)));
  EXPECT_TRUE(same(drawn(smoother, at(0), 0), at(0)));
  correct(smoother, only(at(1.99, 1)), only(at(0)), 19);
  EXPECT_NEAR(drawn(smoother, at(0), 0).position[0], 1.99, 1e-6);
  correct(smoother, only(at(1)), only(at(0)), 29);
  EXPECT_TRUE(same(drawn(smoother, at(0), 0), at(0))) << "2.99 m in two corrections";
}

TEST(PoseSmoother, CorrectionsAddUpSoThatNoneIsSeenToJump) {
  PoseSmoother smoother;
  correct(smoother, only(at(1, 0.3)), only(at(0)));
  const RenderPose before = drawn(smoother, at(0.2, 0.1), 0.05);
  correct(smoother, only(at(0.2, 0.1)), only(at(-0.3, 0.6)), 19);
  const RenderPose after = drawn(smoother, at(-0.3, 0.6), 0);
  EXPECT_NEAR(after.position[0], before.position[0], 1e-6);
  EXPECT_NEAR(angle_of(after), angle_of(before), 1e-6);
}

TEST(PoseSmoother, TurnsAboutDifferentAxesAddUpToo) {
  const auto about_x = [](float half) { return RenderPose{kBody, {0, 0, 0}, {std::sin(half), 0, 0, std::cos(half)}}; };
  const auto about_y = [](float half) { return RenderPose{kBody, {0, 0, 0}, {0, std::sin(half), 0, std::cos(half)}}; };
  PoseSmoother smoother;
  correct(smoother, only(about_y(0.5f)), only(about_y(0)));
  const RenderPose before = drawn(smoother, about_x(0.5f), 0);
  correct(smoother, only(about_x(0.5f)), only(about_x(-0.2f)), 19);
  EXPECT_NEAR(angle(drawn(smoother, about_x(-0.2f), 0), before), 0, 2e-3);
}

TEST(PoseSmoother, ARollbackWithinARollbackIsComparedWithWhatWasDrawn) {
  PoseSmoother smoother;
  Stage there = only(at(1)), wrong = only(at(7)), here = only(at(0));
  smoother.after_step(9, there);
  smoother.after_step(5, wrong);
  smoother.after_step(6, wrong);
  smoother.after_step(4, wrong);
  for (Frame frame = 5; frame < 9; ++frame) smoother.after_step(frame, wrong);
  smoother.after_step(9, here);
  EXPECT_NEAR(drawn(smoother, at(0), 0).position[0], 1, 1e-6);
}

TEST(PoseSmoother, StepsAfterThePresentAddNoError) {
  PoseSmoother smoother;
  correct(smoother, only(at(1)), only(at(0)));
  Stage later = only(at(0.25));
  smoother.after_step(10, later);
  EXPECT_NEAR(drawn(smoother, at(0.25), 0).position[0], 1.25, 1e-6);
}

TEST(PoseSmoother, NewBodiesAreDrawnWhereTheyAreAndGoneOnesNot) {
  const BodyId fresh = {4, 1}, reused = {3, 2};
  PoseSmoother smoother;
  correct(smoother, only(at(1)), {{at(0), at(5, 0, fresh)}});
  const std::vector<RenderPose> both = {at(5, 0, fresh), at(0)};
  const std::vector<RenderPose> shown = smoother.smooth(both, 0);
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_TRUE(same(shown[0], both[0]));
  EXPECT_NEAR(shown[1].position[0], 1, 1e-6);
  EXPECT_TRUE(smoother.smooth({}, 0).empty());
  EXPECT_TRUE(same(drawn(smoother, at(0, 0, reused), 0), at(0, 0, reused))) << "the slot's error is another body's";
  correct(smoother, only(at(0)), only(at(0.5, 0, reused)), 19);
  EXPECT_TRUE(same(drawn(smoother, at(0.5, 0, reused), 0), at(0.5, 0, reused)));
  EXPECT_TRUE(same(drawn(smoother, at(0), 0), at(0))) << "the old one is forgotten";
}

TEST(PoseSmoother, ABodyThatWasBelievedGoneIsDrawnWhereItIs) {
  PoseSmoother smoother;
  correct(smoother, only(at(1)), only(at(0)));
  correct(smoother, {}, only(at(0)), 19);
  EXPECT_TRUE(same(drawn(smoother, at(0), 0), at(0)));
}

TEST(PoseSmoother, AfterARestartEverythingIsDrawnWhereItIs) {
  PoseSmoother smoother;
  correct(smoother, only(at(1)), only(at(0)));
  smoother.restarted(4);
  EXPECT_TRUE(same(drawn(smoother, at(0), 0), at(0)));
  Stage elsewhere = only(at(0.5));
  for (Frame frame = 4; frame < 8; ++frame) smoother.after_step(frame, elsewhere);
  EXPECT_TRUE(same(drawn(smoother, at(0.5), 0), at(0.5)));
  correct(smoother, only(at(1)), only(at(0.5)), 8, 1);
  EXPECT_NEAR(drawn(smoother, at(0.5), 0).position[0], 1, 1e-6) << "from then on corrections are smoothed again";
}

TEST(PoseSmoother, WithoutAHalfLifeCorrectionsAreSeenAtOnce) {
  for (const float dt : {0.0f, 0.01f}) {
    PoseSmoother smoother({.half_life = 0});
    correct(smoother, only(at(1, 1)), only(at(0)));
    EXPECT_TRUE(same(drawn(smoother, at(0), dt), at(0)));
  }
}

// ---- worlds

constexpr Frame kKick = 20, kKnown = 26;

/// A cube that is kicked and one that is not, with their world.
template <class S> struct Field {
  World<S> world{settings<S>()};
  BodyId kicked, left_alone;

  Field() {
    add_ground(world);
    const ShapeId box = add_box(world, 0.5, 0.5, 0.5);
    kicked = world.create(moving<S>(box, {0, 0.5, 0}, {2, 0, 0}));
    left_alone = world.create(moving<S>(box, {0, 0.5, 9}, {2, 3, 0}));
  }
  void step(Frame frame, bool known) {
    if (known && frame == kKick) {
      // 4 m/s up, and 5 rad/s: a cube's inertia is mass edge^2 / 6.
      const double mass = to_double(world.mass(kicked));
      world.apply_impulse(kicked, vec<S>(0, 4 * mass, 0), vec<S>(0, 0, -5 * mass / 6));
    }
    world.step();
  }
};

template <class S> class PoseSmootherOf : public ::testing::Test {};
TYPED_TEST_SUITE(PoseSmootherOf, AllScalars);

const RenderPose& pose_of(const std::vector<RenderPose>& poses, BodyId body) {
  for (const RenderPose& pose : poses) {
    if (pose.body == body) return pose;
  }
  ADD_FAILURE() << "not drawn";
  return poses.at(0);
}
D3 place(const RenderPose& p) { return {p.position[0], p.position[1], p.position[2]}; }
/// The kick becomes known six frames late. Three pictures a tick.
TYPED_TEST(PoseSmootherOf, AMispredictedBodyIsDrawnWithoutAJumpAndSoonWhereItIs) {
  using S = TypeParam;
  constexpr int kPictures = 3;
  constexpr float kDt = 1.0f / (60 * kPictures);
  constexpr double kHalfLife = 0.06;
  const double decay = 1 - std::exp2(-kDt / kHalfLife);  // of the error, in a picture
  // Ordinary motion: a little above 4 m/s, with 2 m/s along at most, and 5 rad/s.
  constexpr double kMotion = 5.0 * kDt, kTurning = 6.0 * kDt;

  Field<S> field, straight;
  PoseSmoother smoother({.half_life = static_cast<float>(kHalfLife)});
  Snapshot<World<S>> saved;
  RenderPose last{}, last_true{};
  double raw_jump = 0, raw_turn = 0;
  double error = 0, turned = 0;  // [m], [rad] at most, when the kick becomes known
  for (Frame frame = 0; frame < 90; ++frame) {
    if (frame == kKick) field.world.save(saved);
    if (frame == kKnown) {
      field.world.load(saved);
      for (Frame past = kKick; past < kKnown; ++past) {
        field.step(past, true);
        smoother.after_step(past, field.world);
      }
    }
    field.step(frame, frame >= kKnown);
    smoother.after_step(frame, field.world);
    straight.step(frame, true);

    for (int i = 0; i < kPictures; ++i) {
      const std::vector<RenderPose> poses = field.world.poses_float(static_cast<float>(i + 1) / kPictures);
      const std::vector<RenderPose>& shown = smoother.smooth(poses, kDt);
      EXPECT_TRUE(same(pose_of(shown, field.left_alone), pose_of(poses, field.left_alone)));
      const RenderPose now = pose_of(shown, field.kicked), truth = pose_of(poses, field.kicked);
      if (frame == kKnown && i == 0) {
        error = length(place(truth) - place(last)) + kMotion;
        turned = angle(truth, last) + kTurning;
      }
      if (frame > 0) {
        EXPECT_LE(length(place(now) - place(last)), kMotion + decay * error) << "frame " << frame;
        EXPECT_LE(angle(now, last), kTurning + decay * turned) << "frame " << frame;
        raw_jump = std::max(raw_jump, length(place(truth) - place(last_true)));
        raw_turn = std::max(raw_turn, angle(truth, last_true));
      }
      last = now;
      last_true = truth;
      if (frame < kKnown || frame > kKnown + 15 * kHalfLife * 60) {
        EXPECT_TRUE(same(now, truth)) << frame;
      }
    }
    EXPECT_TRUE(frame < kKnown || field.world.hash() == straight.world.hash()) << frame;
  }
  EXPECT_GT(raw_jump, 5 * kMotion) << "nothing to be smoothed: the test shows nothing";
  EXPECT_GT(raw_turn, 3 * kTurning) << "nothing to be smoothed: the test shows nothing";
}

}  // namespace pose_smoother_test
}  // namespace isostep
