// IslandSolver: joints as equations, their springs, motors and limits as rows of a block each.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint.inl"
#include "isostep/dynamics/joints/joint_tension.hpp"
#include "isostep/dynamics/solvers/island_solver.hpp"

namespace isostep {

namespace detail {
/// [1] The part of an error that a sub-step closes. Nothing has to converge, so it is a half. All of it would answer
/// the error of a curved path with its mirror image.
template <class S> inline constexpr S kIslandJointShare = S(0.5);

/// [1] The part of a limit's error that a sub-step closes, and the most speed that closes it [m/s]: half a metre a
/// second turns a limb at ten radians a second.
template <class S> inline constexpr S kIslandLimitShare = S(0.125);
template <class S> inline constexpr Velocity<S> kIslandLimitSpeed = Velocity<S>(0.5);

/// The rows in a drive's block.
enum DriveRow : std::uint32_t { kSpringRow, kMotorRow, kLimitRow };

/// Returns true if a drive's lower bound is the nearer one: a sub-step can reach no other.
template <class S> ISO_INLINE bool is_lower(const JointDrive<S>& drive) {
  if (!drive.bounded_above) return true;
  return drive.bounded_below && drive.position - drive.lower < drive.upper - drive.position;
}
}  // namespace detail

template <class S> JointStep<S> IslandSolver<S>::joint_step(const StepContext<S>& context) {
  const S rate = S(rate_);
  return {context.states.data(),
          &bodies_.rows(),
          rate,
          divide_to<Step<S>>(S(1), rate),
          {detail::kIslandJointShare<S> * rate, S(1), S(0)},
          rapid_angular_speed<S>(context.hz),
          angular_speed_to_follow<S>(rate_)};
}

template <class S> void IslandSolver<S>::linearise_joints(const StepContext<S>& context, Island& island) {
  const JointStep<S> step = joint_step(context);
  for (const std::uint32_t j : island.joints) {
    linearise_joint(joints_[j], step);
    curve_joint(joints_[j], step);
  }
  for (const std::uint32_t row : island.bodies) kappa_[row] = bodies_.rows().mass[row].kappa;
  stiffen(island, joints_.all(), step.h);
  for (const std::uint32_t row : island.bodies) find_root(row, kappa_[row]);
  for (const std::uint32_t j : island.joints) {
    JointConstraint<S>& joint = joints_[j];
    if (joint.drive_count == 0) continue;
    weigh_joint(joint, kappa_[joint.row_a], kappa_[joint.row_b]);
  }
}

/// Stiffens bodies at taut joints, as JointTrees does.
template <class S>
void IslandSolver<S>::stiffen(Island& island, std::span<const JointConstraint<S>> joints, Step<S> h) {
  taut_.clear();
  for (const std::uint32_t j : island.joints) detail::add_tension(joints[j], bodies_.rows(), h, tension_, taut_);
  for (const std::uint32_t row : taut_) {
    kappa_[row] = detail::stiffened(kappa_[row], tension_[row]);
    tension_[row] = Mat3<S>::diagonal(Vec3<S>::zero());
  }
}

template <class S>
void IslandSolver<S>::place_joint(const JointConstraint<S>& joint, Island& island, std::uint32_t first) {
  const Vec3<S> zero = Vec3<S>::zero();
  const auto put = [&](std::uint32_t r, const JointRow<S>& from, RowBound bound) {
    const bool empty = from.linear == zero && from.angular_a == zero && from.angular_b == zero;
    island.shapes[r] = {from.linear, from.angular_a, from.angular_b};
    island.system->row(r).bound = empty ? RowBound::absent : bound;
  };
  for (std::uint32_t i = 0; i < joint.block_count; ++i) {
    for (std::uint32_t r = 0; r < 3; ++r) put(3 * (first + i) + r, joint.blocks[i].rows[r], RowBound::equal);
    for (std::uint32_t r = 0; r < 3; ++r) place(island, 3 * (first + i) + r, 1, -512);
  }
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& drive = joint.drives[i];
    const std::uint32_t r = 3 * (first + joint.block_count + i);
    const auto bound = [](bool there, RowBound kind) { return there ? kind : RowBound::absent; };
    const bool spring = drive.spring > S(0), servo = spring && drive.servo;
    put(r + detail::kSpringRow, drive.row, bound(spring && !servo, RowBound::equal));
    put(r + detail::kMotorRow, drive.row, bound(drive.driven || servo, RowBound::boxed));
    put(r + detail::kLimitRow, drive.row,
        bound(drive.bounded_below || drive.bounded_above, detail::is_lower(drive) ? RowBound::above : RowBound::below));
    place(island, r + detail::kMotorRow, 2, -512);
    if (!servo) place(island, r + detail::kSpringRow, 1, -512);
    if (spring) soften(island, r + (servo ? detail::kMotorRow : detail::kSpringRow), drive);
  }
}

/// Makes a row the implicit spring of a drive: speed + spring_speed = -give impulse.
template <class S> void IslandSolver<S>::soften(Island& island, std::uint32_t r, const JointDrive<S>& drive) {
  const Value spring = System::value(drive.spring);
  const Value give = System::quotient(System::value(S(1)),
                                      System::product(System::product(spring, spring), island.ends[r / 3].reduced));
  place(island, r, 1, ((System::exponent(give) + 1) >> 1) + D::kRoom);
  IslandRow<N>& row = island.system->row(r);
  row.soft = System::number(give, 2 * row.exponent);
}

template <class S>
void IslandSolver<S>::ask_joint(const JointConstraint<S>& joint, Island& island, std::uint32_t first, Pass pass) {
  const S bias_rate = pass == Pass::biased ? detail::kIslandJointShare<S> * S(rate_) : S(0);
  for (std::uint32_t i = 0; i < joint.block_count; ++i) {
    const Vec3<V>&error = joint.blocks[i].error, &curve = joint.blocks[i].curve;
    for (std::uint32_t r = 0; r < 3; ++r) {
      const std::uint32_t at = 3 * (first + i) + r;
      const V most = detail::kJointPushSpeed<S>, bias = scaled(bias_rate, error[static_cast<int>(r)]);
      island.asked[at] =
          -(speed_of(island, at, free_velocity_) + clamp(bias, -most, most) + curve[static_cast<int>(r)]);
    }
  }
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate_));
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& drive = joint.drives[i];
    const std::uint32_t r = 3 * (first + joint.block_count + i);
    const V speed = speed_of(island, r, free_velocity_);
    island.asked[r + detail::kSpringRow] = -(speed + drive.spring_speed);
    island.asked[r + detail::kMotorRow] = drive.servo ? -(speed + drive.spring_speed) : drive.speed - speed;
    const bool lower = detail::is_lower(drive);
    const S gap = lower ? drive.position - drive.lower : drive.upper - drive.position;
    const V distance = detail::bounded_error(gap, h);
    V allowed = scaled(S(rate_), distance);
    if (!(gap > S(0))) {
      const S rate = pass == Pass::biased ? detail::kIslandLimitShare<S> * S(rate_) : S(0);
      allowed = max(scaled(rate, distance), -detail::kIslandLimitSpeed<S>);
    }
    island.asked[r + detail::kLimitRow] = lower ? -(speed + allowed) : allowed - speed;
  }
}

/// [m/s] Returns the most impulse that a motor or servo gives in a sub-step.
template <class S> typename IslandSolver<S>::V IslandSolver<S>::most_impulse(const JointDrive<S>& drive) const {
  return detail::most_impulse(drive, divide_to<Step<S>>(S(1), S(rate_)));
}

/// Loads the impulses of the last step, and guesses that each drive is on the same piece of its law again. A limit that
/// pushes leaves the motor no speed to reach, so the motor gives all that it has.
template <class S>
void IslandSolver<S>::guess_joint(const JointConstraint<S>& joint, Island& island, std::uint32_t first) {
  for (std::uint32_t i = 0; i < joint.block_count; ++i) {
    const Vec3<V>& impulse = joint.blocks[i].impulse;
    for (std::uint32_t r = 0; r < 3; ++r) load(island, 3 * (first + i) + r, impulse[static_cast<int>(r)]);
  }
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& drive = joint.drives[i];
    const std::uint32_t r = 3 * (first + joint.block_count + i);
    IslandRow<N>& limit = island.system->row(r + detail::kLimitRow);
    const bool lower = limit.bound == RowBound::above;
    const bool pushes = drive.piece == (lower ? DrivePiece::lower : DrivePiece::upper);
    limit.state = pushes ? RowState::free : lower ? RowState::at_low : RowState::at_high;
    IslandRow<N>& motor = island.system->row(r + detail::kMotorRow);
    const V asks = drive.servo ? -drive.spring_speed : drive.speed;
    const bool back = pushes ? asks < V(0) : drive.piece == DrivePiece::backwards;
    const bool forth = pushes ? !back : drive.piece == DrivePiece::forwards;
    motor.state = forth ? RowState::at_high : back ? RowState::at_low : RowState::free;
    const bool acts = drive.driven || drive.servo;
    load(island, r + (pushes ? detail::kLimitRow : acts ? detail::kMotorRow : detail::kSpringRow), drive.impulse);
  }
}

template <class S>
void IslandSolver<S>::keep_joint(JointConstraint<S>& joint, const Island& island, std::uint32_t first) const {
  for (std::uint32_t i = 0; i < joint.block_count; ++i) {
    const std::uint32_t r = 3 * (first + i);
    joint.blocks[i].impulse = {impulse_of(island, r), impulse_of(island, r + 1), impulse_of(island, r + 2)};
  }
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    const std::uint32_t r = 3 * (first + joint.block_count + i);
    const V spring = impulse_of(island, r + detail::kSpringRow), motor = impulse_of(island, r + detail::kMotorRow);
    const V limit = impulse_of(island, r + detail::kLimitRow), most = most_impulse(drive) - resolution<V>();
    const V bound = convert<V>(Limits<S>::speed());
    drive.impulse = clamp(spring + motor + limit, -bound, bound);
    drive.piece = V(0) < limit                     ? DrivePiece::lower
                  : limit < V(0)                   ? DrivePiece::upper
                  : !(drive.driven || drive.servo) ? DrivePiece::free
                  : !(motor < most)                ? DrivePiece::forwards
                  : !(-most < motor)               ? DrivePiece::backwards
                  : drive.servo                    ? DrivePiece::free
                                                   : DrivePiece::driven;
  }
}

/// Places the rows across rods anew that now pull much harder (judge_sway()). Returns true if there are any.
template <class S> bool IslandSolver<S>::tighten(Island& island) {
  bool any = false;
  for (std::size_t k = 0; k < island.joints.size(); ++k) {
    JointConstraint<S>& joint = joints_[island.joints[k]];
    if (joint.drive_count == 0 || !joint.drives[joint.drive_count - 1].sways) continue;
    keep_joint(joint, island, island.joint_blocks[k]);
    bool tightens = false;
    for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
      if (joint.drives[i].sways) tightens = detail::judge_sway(joint, joint.drives[i], true) || tightens;
    }
    if (tightens) place_joint(joint, island, island.joint_blocks[k]);
    any = any || tightens;
  }
  if (any) island.system.assemble();
  return any;
}

}  // namespace isostep
