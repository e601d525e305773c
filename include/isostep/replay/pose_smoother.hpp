// PoseSmoother: draws bodies that a rollback has put elsewhere on their way there, instead of where they suddenly are.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/math/quat.hpp"
#include "isostep/session/timeline/frame.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

struct PoseSmootherSettings {
  float half_life = float(0.08);  // [s] after which half of a correction is still to be seen; 0: it is seen at once
  float snap_distance = 2;        // [m] a body that is drawn further off than this jumps
};

/// A filter of the poses for drawing, called at every step by an observer of `drive`:
///
///     after_step(f)  { smoother.after_step(f, game.world); }
///     restarted(f)   { smoother.restarted(f); }
///     ...
///     draw(smoother.smooth(game.world.poses_float(alpha), seconds_since_the_last_picture));
///
/// The error of a body is where it was believed to be less where it is, both at the last tick that was stepped before
/// the rollback. It is added to what is drawn and halves with every half-life. So a corrected body moves on with its
/// new velocity, and one that was not corrected is drawn exactly where it is. New bodies are drawn where they are. An
/// error is dropped below snap_distance / 2^14 and 2^-13 rad: any is gone 15 half-lives after its correction.
///
/// Never part of the state, and different on every machine. Allocates when bodies appear.
class PoseSmoother {
 public:
  ISO_INLINE explicit PoseSmoother(const PoseSmootherSettings& settings = {}) : settings_(settings) {}

  /// Call it when `world` has stepped `frame`, for the first time or again. It calls `poses_float`, which is no state.
  template <class W> ISO_INLINE void after_step(Frame frame, W& world) {
    if (frame < stepped_ && present_ == kNoFrame) present_ = stepped_;
    stepped_ = frame + 1;
    if (stepped_ < present_) return;
    const std::vector<RenderPose>& poses = world.poses_float(1);
    if (stepped_ == present_) take_errors(poses);
    present_ = kNoFrame;
    believe(poses);
  }
  /// The session has another past: everything is drawn where it is.
  ISO_INLINE void restarted(Frame frame) {
    bodies_.clear();
    present_ = kNoFrame;
    stepped_ = frame;
  }

  /// Returns the poses to draw, in the given order. `dt` [s]: since the last call. They are valid until the next.
  ISO_INLINE const std::vector<RenderPose>& smooth(const std::vector<RenderPose>& poses, float dt) {
    const float left = share_left(dt);
    drawn_.clear();
    for (const RenderPose& pose : poses) {
      drawn_.push_back(pose);
      Body* const body = find(pose.body);
      if (body == nullptr || !body->off) continue;
      decay(*body, left);
      if (body->off) displace(drawn_.back(), *body);
    }
    return drawn_;
  }

 private:
  using Turn = Quat<float>;
  struct Body {
    RenderPose believed{};         // at the tick of `belief`; its id names the body
    std::uint64_t belief = 0;      // of which sample it is
    Vec3<float> offset{};          // [m] drawn less true
    Turn turn = Turn::identity();  // after the true orientation comes this one
    bool off = false;              // offset and turn are not nothing
  };

  ISO_INLINE Body* find(BodyId id) {
    return id.slot < bodies_.size() && bodies_[id.slot].believed.body == id ? &bodies_[id.slot] : nullptr;
  }

  ISO_INLINE void believe(const std::vector<RenderPose>& poses) {
    ++belief_;
    for (const RenderPose& pose : poses) {
      if (pose.body.slot >= bodies_.size()) bodies_.resize(pose.body.slot + std::size_t{1});
      Body& body = bodies_[pose.body.slot];
      if (body.believed.body != pose.body) body = {};
      body.believed = pose;
      body.belief = belief_;
    }
  }

  ISO_INLINE void take_errors(const std::vector<RenderPose>& poses) {
    for (const RenderPose& pose : poses) {
      Body* const body = find(pose.body);
      if (body == nullptr) continue;
      if (body->belief != belief_) body->off = false;  // it was believed gone
      else add_error(*body, pose);
    }
  }
  static ISO_INLINE Vec3<float> position_of(const RenderPose& pose) {
    return {pose.position[0], pose.position[1], pose.position[2]};
  }
  static ISO_INLINE Turn orientation_of(const RenderPose& pose) {
    return {pose.orientation[0], pose.orientation[1], pose.orientation[2], pose.orientation[3]};
  }

  /// Changes the error so that the drawn pose stays where it is: offset + believed = new offset + pose, turn believed =
  /// new turn pose.
  ISO_INLINE void add_error(Body& body, const RenderPose& pose) {
    if (!body.off) {
      body.offset = {};
      body.turn = Turn::identity();
    }
    body.offset = body.offset + (position_of(body.believed) - position_of(pose));
    body.turn = normalise(body.turn * orientation_of(body.believed) * conjugate(orientation_of(pose)));
    const float snap = settings_.snap_distance;
    body.off = dot(body.offset, body.offset) <= snap * snap;
  }

  /// Shrinks the offset to `left` of itself. The turn goes as much of the straight line to identity: small angles
  /// shrink to `left` too, and tan(angle / 4) never to more than that.
  ISO_INLINE void decay(Body& body, float left) const {
    body.offset = body.offset * left;
    const float sign = body.turn.w < 0 ? float(-1) : float(1);  // the shorter way round
    const float share = sign * left;
    body.turn = normalise(
        Turn{share * body.turn.x, share * body.turn.y, share * body.turn.z, float(1) - left + share * body.turn.w});
    const float bound = settings_.snap_distance * kDropped;
    const Vec3<float> axis = {body.turn.x, body.turn.y, body.turn.z};
    body.off = dot(body.offset, body.offset) > bound * bound || dot(axis, axis) > kDropped * kDropped;
  }
  static ISO_INLINE void displace(RenderPose& pose, const Body& body) {
    const Vec3<float> position = position_of(pose) + body.offset;
    const Turn q = normalise(body.turn * orientation_of(pose));
    pose = {pose.body, {position.x, position.y, position.z}, {q.x, q.y, q.z, q.w}};
  }

  /// Returns 2^(-dt / half-life): the whole halvings, and exp(-z) of the rest by its series up to z^7, within 3e-6 of
  /// itself for z < ln 2.
  ISO_INLINE float share_left(float dt) const {
    if (!(dt < settings_.half_life * kForgotten)) return 0;
    if (dt <= 0) return 1;
    float halvings = dt / settings_.half_life;
    float left = 1;
    for (; halvings >= 1; halvings -= 1) left *= float(0.5);
    const float z = halvings * float(0.69314718);
    float series = 1;
    for (int n = 7; n > 0; --n) series = float(1) - series * z / static_cast<float>(n);
    return left * series;
  }

  static constexpr float kDropped = 0x1p-14;  // of the snap distance; and of a turn, as the sine of half its angle
  static constexpr float kForgotten = 32;     // half-lives after which nothing is left in a float's precision

  PoseSmootherSettings settings_;
  std::vector<Body> bodies_;       // by slot
  std::vector<RenderPose> drawn_;  // the result
  std::uint64_t belief_ = 0;       // samples taken
  Frame stepped_ = 0;              // all before it are stepped
  Frame present_ = kNoFrame;       // during a rollback: the frame it must reach to be compared with what was believed
};

}  // namespace isostep
