// Trials far from the origin: stack, pyramid, ragdoll and chain, judged as they are at home.
// SPDX-License-Identifier: MIT
#include "chains.hpp"
#include "families.hpp"
#include "judges.hpp"
#include "scenes/named.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

void shift(Number& x, double way) {
  double value = 0;
  TextError error;
  x.read(value, error);
  x = value + way;
}
/// Along +x.
Scene moved(Scene scene, double way) {
  for (SceneBody& body : scene.bodies) shift(body.position[0], way);
  for (SceneJoint& joint : scene.joints) {
    shift(joint.anchor[0], way);
    shift(joint.anchor_b[0], way);
  }
  return scene;
}

/// A wall of ten rows whose places are multiples of 1/32 m, which every scalar that reaches so far holds exactly.
Scene small_wall() {
  constexpr int kRows = 10;
  constexpr double kPitch = 1.0625;  // [m]
  Scene scene = stack(0);
  for (int row = 0; row < kRows; ++row) {
    for (int i = 0; i < kRows - row; ++i) {
      const double x = (i - (kRows - 1 - row) * 0.5) * kPitch;
      scene.bodies.push_back(body_of(box_part({0.5, 0.5, 0.5}), {x, 0.5 + row, 0}));
    }
  }
  return scene;
}

/// The pit of S7 with its first ragdoll alone.
Scene one_ragdoll() {
  constexpr std::size_t kPit = 5, kParts = 11, kJoints = 10;
  Scene scene = ragdolls();
  scene.bodies.resize(kPit + kParts, scene.bodies.front());
  scene.joints.resize(kJoints);
  return scene;
}

template <int kKilometres> Scene far_stack() { return moved(stack(10), 1000.0 * kKilometres); }
template <int kKilometres> Scene far_pyramid() { return moved(small_wall(), 1000.0 * kKilometres); }
template <int kKilometres> Scene far_ragdoll() { return moved(one_ragdoll(), 1000.0 * kKilometres); }
template <int kKilometres> Scene far_chain() { return moved(ball_chain(16, 100), 1000.0 * kKilometres); }

std::unique_ptr<Judge> in_millimetres(const Scene&) { return std::make_unique<Separation>(0.001); }
std::unique_ptr<Judge> in_links(const Scene&) { return std::make_unique<Separation>(kLink / 100); }

constexpr char kStack[] = "10 unit boxes stacked, far from the origin", kDrift[] = "largest way sideways, of a box";
constexpr char kPyramid[] = "a wall of ten rows, far from the origin",
               kDisplaced[] = "boxes displaced by more than half their size";
constexpr char kRagdoll[] = "a ragdoll falls, far from the origin", kJoints[] = "peak separation of a joint";
constexpr char kChain[] = "16 links of 1 kg swing with a ball of 100 kg, far from the origin";

}  // namespace

std::span<const Trial> far_trials() {
  static const Trial trials[] = {
      {"far_stack_10km", "20", kStack, kDrift, "%", 1, far_stack<10>, judge_of<Drift>},
      {"far_stack_100km", "20", kStack, kDrift, "%", 1, far_stack<100>, judge_of<Drift>},
      {"far_stack_1000km", "20", kStack, kDrift, "%", 1, far_stack<1000>, judge_of<Drift>},
      {"far_pyramid_10km", "20", kPyramid, kDisplaced, "", 0, far_pyramid<10>, displaced_by_half},
      {"far_pyramid_100km", "20", kPyramid, kDisplaced, "", 0, far_pyramid<100>, displaced_by_half},
      {"far_pyramid_1000km", "20", kPyramid, kDisplaced, "", 0, far_pyramid<1000>, displaced_by_half},
      {"far_ragdoll_10km", "20", kRagdoll, kJoints, "mm", 120, far_ragdoll<10>, in_millimetres},
      {"far_ragdoll_100km", "20", kRagdoll, kJoints, "mm", 120, far_ragdoll<100>, in_millimetres},
      {"far_ragdoll_1000km", "20", kRagdoll, kJoints, "mm", 120, far_ragdoll<1000>, in_millimetres},
      {"far_chain_10km", "20", kChain, kStretch, "%", 5, far_chain<10>, in_links},
      {"far_chain_100km", "20", kChain, kStretch, "%", 5, far_chain<100>, in_links},
      {"far_chain_1000km", "20", kChain, kStretch, "%", 5, far_chain<1000>, in_links},
  };
  return trials;
}

}  // namespace isostep::scenes
