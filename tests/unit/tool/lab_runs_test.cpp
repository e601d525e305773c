// The laboratory's models and runs: what becomes of a scene's masses and places, and what a run reports.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "built.hpp"
#include "own_folder.hpp"
#include "scenes/named.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/models.hpp"
#include "tool/lab/particle_run.hpp"
#include "tool/lab/run_point.hpp"
#include "tool/lab/sweep.hpp"
#include "tool/lab/work.hpp"

namespace isostep::tool::lab {
namespace lab_runs_test {

constexpr double kPi = 3.14159265358979323846;

scenes::Scene scene(const char* name) { return *scenes::find_scene(name); }
scenes::ScenePart box(double x, double y, double z) {
  scenes::ScenePart part;
  part.half_extents = {x, y, z};
  return part;
}
scenes::SceneBody body_at(double y, scenes::ScenePart part) {
  scenes::SceneBody body;
  body.parts = {part};
  body.position = {0, y, 0};
  return body;
}
double ball(double radius) { return 4 * kPi / 3 * radius * radius * radius; }
const Cancel kNever = [] { return false; };

// ---- spheres

TEST(LabSpheres, HaveTheVolumeMassAndPlaceOfWhatTheyStandFor) {
  const scenes::Scene pile = scene("S4s");
  const Offer<scenes::Scene> offer = sphere_model(pile);
  ASSERT_EQ(offer.reason, "");
  ASSERT_EQ(offer.model.bodies.size(), pile.bodies.size());
  for (std::size_t i = 0; i < pile.bodies.size(); ++i) {
    if (pile.bodies[i].type != BodyType::dynamic) continue;
    const BodyFacts before = facts_of(pile.bodies[i]), after = facts_of(offer.model.bodies[i]);
    EXPECT_EQ(offer.model.bodies[i].parts[0].type, ShapeType::sphere);
    EXPECT_NEAR(after.volume, before.volume, 1e-12);
    EXPECT_NEAR(after.mass, before.mass, 1e-12);
    EXPECT_LT(length_of(after.centre - before.centre), 1e-12);
  }
}

TEST(LabSpheres, AreMeasuredByClosedForms) {
  EXPECT_DOUBLE_EQ(facts_of(body_at(0, box(0.5, 1, 2))).volume, 8);
  scenes::ScenePart capsule;
  capsule.type = ShapeType::capsule;
  capsule.radius = 0.5;
  capsule.half_height = 1;
  EXPECT_NEAR(facts_of(body_at(0, capsule)).volume, ball(0.5) + kPi * 0.25 * 2, 1e-12);
  EXPECT_NEAR(ball(facts_of(body_at(0, capsule)).radius), ball(0.5) + kPi * 0.25 * 2, 1e-12);
}

TEST(LabSpheres, ACompoundStandsWhereItsVolumeIs) {
  scenes::SceneBody body = body_at(1, box(0.5, 0.5, 0.5));
  body.parts.push_back(box(0.5, 0.5, 1.5));  // three times the volume
  body.parts[1].position = {4, 0, 0};
  EXPECT_NEAR(facts_of(body).centre.x, 3, 1e-12);
  EXPECT_NEAR(facts_of(body).centre.y, 1, 1e-12);
}

TEST(LabSpheres, AreNotOfferedWhereTheyWouldBeAnotherScene) {
  // Unit boxes a metre apart: spheres of volume 1 have a radius of 0.6204.
  EXPECT_EQ(sphere_model(scene("S1x5")).reason,
            "as spheres of their volume bodies 1 and 2 would start 241 mm in one another");
  EXPECT_NE(sphere_model(scene("S5")).reason.find("spheres already"), std::string::npos);
  EXPECT_NE(sphere_model(scene("S7")).reason.find("joints"), std::string::npos);
  EXPECT_NE(sphere_model(scene("S9")).reason.find("script"), std::string::npos);
}

// ---- particles

TEST(LabParticles, AChainBecomesRodsBetweenItsJoints) {
  const Offer<ParticlePlan> offer = particle_model(scene("S6v"));
  ASSERT_EQ(offer.reason, "");
  const ParticlePlan& plan = offer.model;
  ASSERT_EQ(plan.particles.size(), 51u);  // 50 joints below the first, and the ball
  ASSERT_EQ(plan.rods.size(), 51u);
  EXPECT_TRUE(plan.scenery.empty());
  double mass = 0;
  for (const ParticlePlan::Particle& particle : plan.particles) mass += particle.mass;
  EXPECT_NEAR(mass, 150 - 0.5, 1e-9) << "half a link hangs on the world";
  int anchored = 0;
  for (const ParticlePlan::Rod& rod : plan.rods) {
    EXPECT_NEAR(rod.length, 0.5, 1e-9);
    anchored += rod.b < 0 ? 1 : 0;
  }
  EXPECT_EQ(anchored, 1);
}

TEST(LabParticles, ARainOfSpheresKeepsMassRadiusAndPit) {
  const Offer<ParticlePlan> offer = particle_model(scene("S5"));
  ASSERT_EQ(offer.reason, "");
  const ParticlePlan& plan = offer.model;
  ASSERT_EQ(plan.particles.size(), 4000u);
  ASSERT_EQ(plan.materials.size(), 1u);
  EXPECT_NEAR(plan.materials[0].radius, 0.25, 1e-12);
  EXPECT_EQ(plan.materials[0].friction, 0) << "a ball rolls, a particle slides";
  EXPECT_NEAR(plan.particles[0].mass, ball(0.25), 1e-12);
  ASSERT_EQ(plan.scenery.size(), 5u);
  // The floor's face at y = 0, the walls' at 5 m from the middle, all of them looking at the particles.
  EXPECT_EQ(plan.scenery[0].normal, (Vec3<double>{0, 1, 0}));
  EXPECT_NEAR(plan.scenery[0].offset, 0, 1e-12);
  for (int i = 1; i < 5; ++i) EXPECT_NEAR(plan.scenery[static_cast<std::size_t>(i)].offset, -5, 1e-12);
}

TEST(LabParticles, AreNotOfferedWhereTheyWouldBeAnotherScene) {
  EXPECT_NE(particle_model(scene("S7")).reason.find("has more than two joints"), std::string::npos);
  EXPECT_NE(particle_model(scene("S9")).reason.find("script"), std::string::npos);
  EXPECT_NE(particle_model(scene("S1x5")).reason.find("in one another"), std::string::npos);
  scenes::Scene between;
  between.bodies = {body_at(0, box(1, 1, 1)), body_at(3, box(0.1, 0.1, 0.1)), body_at(-3, box(0.1, 0.1, 0.1))};
  between.bodies[0].type = BodyType::static_;
  EXPECT_EQ(particle_model(between).reason, "body 0 is a box with bodies on more than one side");
}

template <class S> class LabParticleRuns : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(LabParticleRuns, Scalars);

TYPED_TEST(LabParticleRuns, BodiesAreWhereTheyAreInTheScene) {
  const Subject subject = subject_of("S6");
  const ParticleRun<TypeParam> run(subject, {"S6", kOwnEngine, "", "soft_step", "particles", 60, 4});
  const scenes::Sight sight = run.sight(0);
  ASSERT_EQ(sight.bodies.size(), subject.scene.bodies.size());
  for (std::size_t i = 0; i < sight.bodies.size(); ++i)
    EXPECT_LT(length_of(sight.bodies[i].centre - facts_of(subject.scene.bodies[i]).centre), 1e-4) << i;
}

TYPED_TEST(LabParticleRuns, AFallingBallIsWhereABallFalls) {
  scenes::SceneBody sphere = body_at(0, {});
  sphere.parts[0].type = ShapeType::sphere;
  sphere.parts[0].radius = 0.5;
  sphere.velocity = {1, 0, 0};
  Subject subject;
  subject.scene.bodies = {sphere};
  subject.particles = particle_model(subject.scene);
  ASSERT_EQ(subject.particles.reason, "");
  ParticleRun<TypeParam> run(subject, {"", kOwnEngine, "", "soft_step", "particles", 60, 32});
  for (int i = 0; i < 60; ++i) EXPECT_FALSE(run.step());
  const Vec3<double> centre = run.sight(0).bodies[0].centre;
  EXPECT_NEAR(centre.x, 1, 2e-3);
  EXPECT_NEAR(centre.y, -5, 5e-3);  // semi-implicit: g h / 2 = 2.6 mm too far
}

// ---- runs

TEST(LabRuns, TheReferenceDoesNotDeviateFromItself) {
  const Subject subject = subject_of("S1x5");
  const Reference reference = reference_of(subject, 90, kNever);
  ASSERT_TRUE(reference.exists);
  EXPECT_EQ(reference.standing.size(), 5u);
  const LabResult same = run_point(subject, reference.point, reference, 90, kNever);
  EXPECT_EQ(same.state, kDone);
  EXPECT_EQ(same.deviation, 0);
  EXPECT_TRUE(same.stood);
  EXPECT_EQ(same.frames, 90);
  EXPECT_GT(same.ms, 0);
  LabPoint coarse = reference.point;
  coarse.substeps = 1;
  EXPECT_GT(run_point(subject, coarse, reference, 90, kNever).deviation, 0);
}

TEST(LabRuns, ChainsWithoutContactsAreComparedWithTheDirectSolver) {
  EXPECT_EQ(reference_point(subject_of("S6")).solver, "direct");
  EXPECT_EQ(reference_point(subject_of("S1")).solver, "soft_step");
  EXPECT_EQ(reference_point(subject_of("S7")).solver, "soft_step");
}

TEST(LabRuns, WorkIsKnownBeforehandAndGrowsAsTheRunDoes) {
  const Subject chain = subject_of("S6");  // 51 bodies, 51 joints
  LabPoint point = {"S6", kOwnEngine, "float", "soft_step", "rigid", 60, 8};
  const double work = work_of(chain, point, 600);
  EXPECT_EQ(work, 600.0 * (51 + 51) * (8 + 4));
  EXPECT_EQ(work_of(chain, point, 1200), 2 * work);
  point.substeps = 20;
  EXPECT_EQ(work_of(chain, point, 600), 2 * work);
  point.scalar = "q32.32";
  EXPECT_EQ(work_of(chain, point, 600), 2 * work) << "what one scalar survives is not left out in another";
  point.solver = "direct";
  EXPECT_GT(work_of(chain, point, 600), 2 * work);
}

TEST(LabRuns, AReferenceThatWouldBeTooLongDoesWithoutWhatStands) {
  const Subject stack = subject_of("S1x5");
  const int fitting = static_cast<int>(kReferenceLimit / work_of(stack, reference_point(stack), 1));
  int steps = 0;
  const Cancel after_a_second = [&] { return ++steps > 60; };
  EXPECT_THROW(reference_of(stack, fitting, after_a_second), Cancelled);
  steps = 0;
  const Reference shortened = reference_of(stack, fitting + 1, after_a_second);
  EXPECT_TRUE(shortened.exists);
  EXPECT_TRUE(shortened.standing.empty());
}

TEST(LabRuns, AScalarsRangeRefusesWithItsReason) {
  Subject subject;
  subject.name = "far";
  subject.scene.bodies = {body_at(1e6, box(1, 1, 1))};
  const LabResult refused =
      run_point(subject, {"far", kOwnEngine, "q16.16", "soft_step", "rigid", 60, 8}, {}, 60, kNever);
  EXPECT_EQ(refused.state, kRefused);
  EXPECT_NE(refused.reason.find("out of range for q16.16"), std::string::npos) << refused.reason;
}

TEST(LabRuns, ACancelledRunIsNone) {
  const Subject subject = subject_of("S1x5");
  EXPECT_THROW(
      run_point(subject, {"S1x5", kOwnEngine, "double", "soft_step", "rigid", 60, 8}, {}, 60, [] { return true; }),
      Cancelled);
}

TEST(LabRuns, ATrialIsJudgedWhenItIsOver) {
  const Subject subject = subject_of("heavy_on_light_100");
  const LabPoint point = {"heavy_on_light_100", kOwnEngine, "double", "soft_step", "rigid", 60, 8};
  EXPECT_FALSE(run_point(subject, point, {}, 599, kNever).judged);
  const LabResult judged = run_point(subject, point, {}, 600, kNever);
  EXPECT_TRUE(judged.judged);
  EXPECT_TRUE(judged.survived);
}

// ---- grids and sweeps

TEST(LabGrid, HasEveryCombinationAndTheScenesOwn) {
  const std::vector<LabPoint> points = grid("S1x5", {{"float", "double"}, {"direct"}, {}, {1, 2}, {60, 120}});
  EXPECT_EQ(points.size(), 2u * 1 * 2 * 2 + 2) << "the scene's own solver in either scalar";
  EXPECT_EQ(grid("S1x5", {}).size(), 4u * std::size(isostep::test::kBuiltSolvers) * 6);
  EXPECT_EQ(default_point("S1x5", "float").solver, "soft_step");
}

TEST(LabGrid, RefusesWhatIsNotThere) {
  EXPECT_THROW(grid("S1x5", {{"q8.8"}, {}, {}, {}, {}}), ToolError);
  EXPECT_THROW(grid("S1x5", {{}, {"magic"}, {}, {}, {}}), ToolError);
  EXPECT_THROW(grid("S1x5", {{}, {}, {"cubes"}, {}, {}}), ToolError);
  EXPECT_THROW(grid("S1x5", {{}, {}, {"spheres"}, {}, {}}), ToolError);
  EXPECT_THROW(grid("no such scene", {}), ToolError);
}

TEST(LabSweep, LeavesOutWhatIsTooLongOnEveryMachineAlike) {
  const std::vector<LabPoint> points = grid("S1x5", {{"double"}, {"soft_step"}, {}, {2, 8}, {}});
  SweepOptions options;
  options.out = "";
  options.frames = 30;
  options.progress = false;
  options.limit = 30 * 6 * (2 + 4);
  const std::vector<LabResult> results = sweep(points, options);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].state, kDone);
  EXPECT_EQ(results[1].state, kLeftOut);
  EXPECT_EQ(results[1].point, points[1]);
  EXPECT_EQ(results[1].reason, "too long: 0.00216 million body sub-steps");
  EXPECT_EQ(results[1].frames, 0);
}

class LabSweepKept : public OwnFolder {};
TEST_F(LabSweepKept, AnswersInThePointsOrderWhateverTheJobsAndDoesNothingTwice) {
  const std::vector<LabPoint> points = grid("S1x5", {{"float", "double"}, {"soft_step", "pgs"}, {}, {1, 2}, {}});
  SweepOptions options;
  options.out = path("results");
  options.frames = 30;
  options.progress = false;
  options.jobs = 2;
  const std::vector<LabResult> first = sweep(points, options), again = sweep(points, options);
  options.out = "";
  options.jobs = 1;
  const std::vector<LabResult> alone = sweep(points, options);
  ASSERT_EQ(first.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(first[i].point, points[i]);
    EXPECT_EQ(again[i].ms_mean, first[i].ms_mean) << "kept, not measured again";
    EXPECT_EQ(alone[i].penetration, first[i].penetration);
    EXPECT_EQ(alone[i].deviation, first[i].deviation);
  }
}

}  // namespace lab_runs_test
}  // namespace isostep::tool::lab
