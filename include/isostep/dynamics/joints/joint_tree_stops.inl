// Bodies of joint_tree.hpp for joints with stops: of a twist and a swing whose drives are limits and nothing else.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "isostep/dynamics/joints/joint_tree.hpp"
#include "isostep/dynamics/joints/tree_lanes.hpp"

namespace isostep {

namespace detail {
template <class S> ISO_INLINE bool has_stops(const JointConstraint<S>& joint) {
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& drive = joint.drives[i];
    if (drive.asked != nullptr || drive.sprung || drive.driven) return false;
  }
  return joint.block_count > 1 && bounds_twist_and_swing<S>(joint.properties.type);
}
/// Returns true if a joint's angles are measured once a step: it holds a point, and drives angles without soft limits.
template <class S> ISO_INLINE bool follows(const JointConstraint<S>& joint) {
  if (joint.drive_count == 0 || !holds_point(joint.properties) || has_stops(joint)) return false;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& drive = joint.drives[i];
    if (drive.block == 0 || drive.sways || (drive.asked != nullptr && is_soft(*drive.asked))) return false;
  }
  return true;
}
/// [rad] per cosine: the way from any smaller angle to the one of this sine and cosine is at least that many times the
/// difference of their cosines. 1 / (sin R + sin(R / 2)), or 1 if that is less or the format has too few digits for it.
template <class S> ISO_INLINE S slope_to(SinCos<Unit<S>> most) {
  const S sum = convert<S>(most.sin) + sqrt(max(S(0.5) - S(0.5) * convert<S>(most.cos), S(0)));
  return S(0.125) < sum ? max(S(1), S(1) / sum) : S(1);
}
template <class S> ISO_INLINE TreeStopLimits<S> stop_limits(const JointConstraint<S>& joint) {
  const JointProperties<S>& p = joint.properties;
  TreeStopLimits<S> limits = {};
  const S middle = (p.lower + p.upper) * S(0.25);
  limits.middle = middle == S(0) ? SinCos<Unit<S>>{Unit<S>(0), Unit<S>(1)} : sin_cos_to<Unit<S>>(middle);
  limits.twist = limits.swing = kNoCosine<S>;
  limits.twist_slope = limits.swing_slope = S(1);
  const bool twists = (p.flags & joint_flag::kLimit) != 0;
  if (twists) {
    const SinCos<Unit<S>> range = sin_cos_to<Unit<S>>((p.upper - p.lower) * S(0.25));
    limits.twist = convert<S>(range.cos);
    limits.twist_slope = slope_to<S>(range);
  }
  limits.cone = most_swing(p, twists);
  if (joint.drive_count > 1 && joint.drives[1].bounded_above) {
    const SinCos<Unit<S>> cone = sin_cos_to<Unit<S>>(limits.cone);
    limits.swing = convert<S>(cone.cos);
    limits.swing_slope = slope_to<S>(cone);
  }
  limits.lower = p.lower;
  limits.upper = p.upper;
  limits.radius = joint.radius;
  limits.twist_radius = joint.drives[0].radius;
  limits.swing_radius = joint.drives[1].radius;
  return limits;
}

ISO_INLINE void set_piece(PieceLanes& lanes, std::uint32_t lane, DrivePiece piece) {
  const std::uint32_t bit = 1u << lane;
  lanes.clear(bit);
  if (piece == DrivePiece::lower) lanes.lower |= bit;
  if (piece == DrivePiece::upper) lanes.upper |= bit;
  if (piece == DrivePiece::driven) lanes.driven |= bit;
  if (piece == DrivePiece::forwards) lanes.forwards |= bit;
  if (piece == DrivePiece::backwards) lanes.backwards |= bit;
}
ISO_INLINE DrivePiece piece_of(const PieceLanes& lanes, std::uint32_t lane) {
  const auto has = [lane](std::uint32_t bits) { return (bits >> lane & 1u) != 0; };
  if (has(lanes.lower)) return DrivePiece::lower;
  if (has(lanes.upper)) return DrivePiece::upper;
  if (has(lanes.driven)) return DrivePiece::driven;
  if (has(lanes.forwards)) return DrivePiece::forwards;
  return has(lanes.backwards) ? DrivePiece::backwards : DrivePiece::free;
}
}  // namespace detail

/// Writes, once a step, what kernels need of joints with stops.
template <class S> void JointTrees<S>::set_stops(const Batch& batch, std::span<JointConstraint<S>> joints) {
  const TreeRun<S> run = run_of(batch, nullptr);
  const auto width = static_cast<std::uint32_t>(batch.kernels->width);
  const TreeStopView<S> stops(run.memory, run.shape, width);
  for (std::uint32_t j = 0; j < run.shape.joints.size(); ++j) {
    const TreeJoint& of = run.shape.joints[j];
    if (of.stops == TreeJoint::kNoStops) continue;
    TreeStopLimits<S> limits = {};
    for (std::uint32_t lane = width; lane-- > 0;) {
      JointConstraint<S>& joint = joints[run.joints[j * width + lane]];
      const JointProperties<S>& p = joint.properties;
      if (lane + 1 == width || (run.lanes >> lane & 1u) != 0) limits = detail::stop_limits(joint);
      stops.set_frames(of.stops, lane, p.frame_a.orientation, p.frame_b.orientation);
      stops.set_limits(of.stops, lane, limits);
      detail::empty_block(joint.blocks[1]);
    }
  }
}

/// Sets the drives of trees from their constraints once a step: impulses and pieces. Drives that a sub-step skips ask
/// for nothing.
template <class S> void JointTrees<S>::set_drives(const Batch& batch, std::span<const JointConstraint<S>> joints) {
  const TreeRun<S> run = run_of(batch, nullptr);
  const auto width = static_cast<std::uint32_t>(batch.kernels->width);
  const TreeDriveView<S> drives(run.memory, run.shape, width);
  for (std::size_t d = 0; d < run.shape.drives.size(); ++d) {
    const TreeDrive& of = run.shape.drives[d];
    for (std::uint32_t lane = 0; lane < width; ++lane) {
      const JointDrive<S>& drive = joints[run.joints[of.joint * width + lane]].drives[of.index];
      drives.impulse(d, lane) = of.stops() && drive.piece == DrivePiece::free ? Velocity<S>(0) : drive.impulse;
      drives.right(d, lane) = Velocity<S>(0);
      drives.give(d, lane) = S(0);
      detail::set_piece(run.drives[d].now, lane, drive.piece);
      run.drives[d].motors |= (drive.driven ? 1u : 0u) << lane;
    }
  }
}

}  // namespace isostep
