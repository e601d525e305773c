// Short words for the makers of scenes: bodies of one primitive, the floor, the pit, and the draws.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include "isostep/scalar/math.hpp"
#include "scene.hpp"

namespace isostep::scenes {

/// x = 1664525 x + 1013904223 mod 2^32. Doubles hold every draw exactly.
class Draws {
 public:
  explicit Draws(std::uint32_t seed) : x_(seed) {}
  std::uint32_t next() { return x_ = x_ * 1664525u + 1013904223u; }
  /// 0 up to, but not, 1.
  double unit() { return static_cast<double>(next() >> 8) * 0x1p-24; }
  double between(double low, double high) { return low + (high - low) * unit(); }

 private:
  std::uint32_t x_;
};

inline constexpr double kTurn = 6.28318530717958647692;      // [rad]
inline constexpr double kHalfRoot = 0.70710678118654752440;  // sine and cosine of an eighth of a turn

struct Point {
  double x, y, z;
};
inline Vector vector_of(Point p) { return {p.x, p.y, p.z}; }
/// Rounds to 1/1024 m: so every scalar and every engine gets one geometry.
inline double on_grid(double metres) { return std::floor(1024 * metres + 0.5) / 1024; }
inline Point on_grid(Point p) { return {on_grid(p.x), on_grid(p.y), on_grid(p.z)}; }

inline ScenePart box_part(Point half) {
  ScenePart part;
  part.type = ShapeType::box;
  part.half_extents = vector_of(half);
  return part;
}
inline ScenePart sphere_part(double radius) {
  ScenePart part;
  part.type = ShapeType::sphere;
  part.radius = radius;
  return part;
}
inline ScenePart capsule_part(double radius, double half_height) {
  ScenePart part;
  part.type = ShapeType::capsule;
  part.radius = radius;
  part.half_height = half_height;
  return part;
}
/// A capsule, cylinder or cone.
inline ScenePart round_part(ShapeType type, double radius, double half_height) {
  ScenePart part = capsule_part(radius, half_height);
  part.type = type;
  return part;
}
inline SceneBody body_of(ScenePart part, Point at) {
  SceneBody body;
  body.parts.push_back(std::move(part));
  body.position = vector_of(at);
  return body;
}
inline SceneBody fixed_box(Point at, Point half) {
  SceneBody body = body_of(box_part(half), at);
  body.type = BodyType::static_;
  return body;
}
/// A joint with both frames at one point.
inline SceneJoint joint_of(JointType type, int a, int b, Point anchor) {
  SceneJoint joint;
  joint.type = type;
  joint.a = a;
  joint.b = b;
  joint.anchor = vector_of(anchor);
  return joint;
}
/// A turn about the world's y axis.
inline Rotation yaw(double angle) {
  const SinCos<double> half = sin_cos(angle / 2);
  return {0, half.sin, 0, half.cos};
}

/// An empty scene in which nobody falls asleep.
inline Scene awake(int frames) {
  Scene scene;
  scene.allow_sleep = false;
  scene.frames = frames;
  return scene;
}
/// A scene in which nobody sleeps, and nobody falls.
inline Scene weightless(int frames) {
  Scene scene = awake(frames);
  scene.gravity = zero_vector();
  return scene;
}

/// Top face at y = 0.
inline void add_floor(Scene& scene) { scene.bodies.push_back(fixed_box({0, -1, 0}, {50, 1, 50})); }
/// Inside `inner` x `inner` m, walls 1 m thick and 40 m high.
inline void add_pit(Scene& scene, double inner) {
  const double half = inner / 2;
  add_floor(scene);
  scene.bodies.push_back(fixed_box({half + 0.5, 20, 0}, {0.5, 20, half + 1}));
  scene.bodies.push_back(fixed_box({-half - 0.5, 20, 0}, {0.5, 20, half + 1}));
  scene.bodies.push_back(fixed_box({0, 20, half + 0.5}, {half, 20, 0.5}));
  scene.bodies.push_back(fixed_box({0, 20, -half - 0.5}, {half, 20, 0.5}));
}

/// Box, sphere, capsule in turn; always four draws a body. Sizes of S4 times `scale`.
inline SceneBody drawn_body(int n, Point at, Draws& draws, double scale) {
  const double a = draws.unit(), b = draws.unit(), c = draws.unit(), angle = draws.between(0, kTurn);
  const Point box = {scale * (0.25 + 0.25 * a), scale * (0.25 + 0.25 * b), scale * (0.25 + 0.25 * c)};
  SceneBody body = body_of(n % 3 == 0   ? box_part(box)
                           : n % 3 == 1 ? sphere_part(scale * (0.25 + 0.25 * a))
                                        : capsule_part(scale * (0.15 + 0.15 * a), scale * (0.1 + 0.15 * b)),
                           at);
  body.orientation = yaw(angle);
  return body;
}

}  // namespace isostep::scenes
