// Predictability: a scene many times in one run, its start changed by a millionth; how far apart do the ends lie?
// Source:  Chung, Pollard 2016, Predictable behavior during contact simulation: a comparison of selected physics
//          engines, Computer Animation and Virtual Worlds 27. Differs: their question, our scenes.
// SPDX-License-Identifier: MIT
#include "published.hpp"
#include "scenes/shapes.hpp"
#include "scenes/trials/judges.hpp"
#include "scenes/trials/scene_numbers.hpp"

namespace isostep::scenes {
namespace {

constexpr double kChange = 1e-6;           // [m], [m/s], [rad/s] the most that a start is changed by, along each axis
constexpr int kStarts = 64;                // of one body, all at one place
constexpr int kStacks = 8;                 // side by side
constexpr double kStacksPitch = 4;         // [m] floats at the last are 1e-6 m apart
constexpr double kPredictableSeconds = 4;  // [s] all have come to rest by then

/// A ground of friction 0.5, and steps of 10 ms.
Scene plain_ground() {
  Scene scene = awake(static_cast<int>(kPredictableSeconds * 100));
  scene.hz = 100;
  add_floor(scene);
  return scene;
}

Vector changed(const Vector& of, Draws& draws) {
  const Vec3<double> v = value(of);
  const double x = v.x + draws.between(-kChange, kChange), y = v.y + draws.between(-kChange, kChange);
  return {x, y, v.z + draws.between(-kChange, kChange)};
}
SceneBody changed(SceneBody body, Draws& draws) {
  body.position = changed(body.position, draws);
  body.velocity = changed(body.velocity, draws);
  body.angular_velocity = changed(body.angular_velocity, draws);
  return body;
}

/// All copies are at one place, so that rounding is the same for all; those of one group do not meet.
Scene copies_of(Scene scene, SceneBody body) {
  Draws draws(1616);
  body.mass = 1;
  body.group = 1;
  for (int n = 0; n < kStarts; ++n) scene.bodies.push_back(changed(body, draws));
  return scene;
}
SceneBody thrown_box(Point half, Point at, Point velocity, Point spin) {
  SceneBody body = body_of(box_part(half), at);
  body.velocity = vector_of(velocity);
  body.angular_velocity = vector_of(spin);
  return body;
}

/// It lands on an edge and falls over the nearer side.
Scene dropped_box() {
  SceneBody body = thrown_box({0.25, 0.25, 0.25}, {0, 1.25, 0}, {0, 0, 0}, {0, 0, 0});
  body.orientation = {0, 0, 0.26, 0.965608};  // 30 degrees about z
  return copies_of(plain_ground(), body);
}
/// It slides against a wall, spinning, and stops there.
Scene box_against_wall() {
  Scene scene = plain_ground();
  scene.bodies.push_back(fixed_box({2.5, 1, 0}, {0.5, 1, 10}));
  return copies_of(scene, thrown_box({0.25, 0.25, 0.25}, {0, 0.25, 0}, {6, 0, 1}, {0, 2, 0}));
}
Scene tumbling_brick() {
  return copies_of(plain_ground(), thrown_box({0.2, 0.1, 0.05}, {0, 1, 0}, {4, 1, 0.5}, {1, 2, -9}));
}

constexpr int kStackThatIsHit = 5;  // boxes

/// A box is thrown at a stack of five, along x.
Scene stack_that_is_hit() {
  Scene scene = plain_ground();
  Draws draws(1616);
  for (int i = 0; i < kStacks; ++i) {
    const double z = kStacksPitch * (i - (kStacks - 1) / 2.0);
    for (int n = 0; n < kStackThatIsHit; ++n) {
      scene.bodies.push_back(body_of(box_part({0.25, 0.25, 0.25}), {0, 0.5 * n + 0.25, z}));
      scene.bodies.back().mass = 1;
    }
    SceneBody thrown = thrown_box({0.2, 0.2, 0.2}, {-1, 1.5, z + 0.0625}, {6, 0, 0}, {0, 0, 0});
    thrown.mass = 1;
    scene.bodies.push_back(changed(thrown, draws));
  }
  return scene;
}

/// [m] The root mean square distance of bodies at the end from the mean of their copies. Copies of `kBodies` each stand
/// a pitch apart, those of one body at one place.
template <std::size_t kBodies> class SpreadOfEnds : public Judge {
 public:
  explicit SpreadOfEnds(const Scene& scene) {
    for (const SceneBody& body : scene.bodies) first_ += body.type == BodyType::dynamic ? 0 : 1;
    copies_ = (scene.bodies.size() - first_) / kBodies;
  }
  void see(const Sight& sight) override { end_ = sight; }
  double figure() const override {
    double sum = 0;
    for (std::size_t body = 0; body < kBodies; ++body) {
      Vec3<double> mean = {0, 0, 0};
      for (std::size_t n = 0; n < copies_; ++n) mean += place(n, body) * (1.0 / static_cast<double>(copies_));
      for (std::size_t n = 0; n < copies_; ++n) sum += dot(place(n, body) - mean, place(n, body) - mean);
    }
    return std::sqrt(sum / static_cast<double>(copies_ * kBodies));
  }

 private:
  Vec3<double> place(std::size_t copy, std::size_t body) const {
    const double away = kBodies == 1 ? 0 : kStacksPitch * static_cast<double>(copy);
    return end_.bodies[first_ + copy * kBodies + body].centre - Vec3<double>{0, 0, away};
  }
  std::size_t first_ = 0;  // bodies that are no copies come first
  std::size_t copies_;
  Sight end_;
};

constexpr int kPredictableRates[] = {100, 250};

template <std::size_t kBodies = 1>
PublishedTest predictable_test(const char* name, const char* number, const char* description, Scene (*make)(),
                               const char* differs, std::span<const PublishedBar> bars) {
  return with_first_bar({.trial = {name, number, description, "spread of the ends after 4 s", "m", 0, make,
                                   judge_of<SpreadOfEnds<kBodies>>},
                         .source = "After Chung and Pollard",
                         .year = 2016,
                         .differs = differs,
                         .starts_differ_by = kChange,
                         .rates = kPredictableRates,
                         .bars = bars});
}

// The aim is ten times the change of the start.
constexpr PublishedBar kEdgeBars[] = {{100, 0.04, 1e-5}};
constexpr PublishedBar kWallBars[] = {{100, 0.04, 1e-5}};
constexpr PublishedBar kBrickBars[] = {{100, 0.01, 1e-5}};
constexpr PublishedBar kStackBars[] = {{100, 0.4, 1e-5}};
constexpr const char* kManyAtOnce =
    "our scenes, with 64 bodies at one place that do not meet; q16.16, which holds no such change, does not run";

}  // namespace

std::span<const PublishedTest> chung_pollard_tests() {
  static const PublishedTest tests[] = {
      predictable_test("predictable_edge", "edge", "a box falls on an edge, 64 starts within 1e-6 m, m/s and rad/s",
                       dropped_box, kManyAtOnce, kEdgeBars),
      predictable_test("predictable_wall", "wall",
                       "a spinning box slides against a wall, 64 starts within 1e-6 m, m/s and rad/s", box_against_wall,
                       kManyAtOnce, kWallBars),
      predictable_test("predictable_brick", "brick", "a thrown brick tumbles, 64 starts within 1e-6 m, m/s and rad/s",
                       tumbling_brick, kManyAtOnce, kBrickBars),
      predictable_test<kStackThatIsHit + 1>("predictable_stack", "stack hit",
                                            "a box hits a stack of five, 8 starts within 1e-6 m, m/s and rad/s",
                                            stack_that_is_hit, "our scene; 8 stacks side by side", kStackBars),
  };
  return tests;
}

}  // namespace isostep::scenes
