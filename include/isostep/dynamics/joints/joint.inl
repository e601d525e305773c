// Bodies of joint.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/ball.hpp"
#include "isostep/dynamics/joints/distance.hpp"
#include "isostep/dynamics/joints/fixed.hpp"
#include "isostep/dynamics/joints/hinge.hpp"

namespace isostep {

namespace detail {

template <class S> ISO_INLINE S trace_bound(const SolverMass<S>& a, const SolverMass<S>& b, MassShare<S> share) {
  const auto entry = [&](int i) { return share.a * a.kappa.rows[i][i] + share.b * b.kappa.rows[i][i]; };
  return max(entry(0), max(entry(1), entry(2)));
}

/// [1/m^2] how easily the pair turns about an axis of frame a.
template <class S>
ISO_INLINE S turning_about(Vec3<S> axis, const SolverMass<S>& a, const SolverMass<S>& b, MassShare<S> share) {
  return share.a * dot(axis, a.kappa * axis) + share.b * dot(axis, b.kappa * axis);
}
template <class S> ISO_INLINE S radius_of(S turning) { return turning > S(0) ? S(1) / sqrt(turning) : S(0); }

/// Lever of an angle about the joint's z axis, and of one across it: thin bodies turn far more easily about one. It is
/// the mean between the body's own radius of inertia, at which a row alone is one, and the one about the joint, at which
/// it is one once the point holds: where the arm is long, entries and impulses then both keep within the format.
template <class S>
ISO_INLINE void set_radii(const JointEnd<S>& end_a, const SolverMass<S>& a, const SolverMass<S>& b,
                          JointConstraint<S>& joint) {
  joint.radius = S(0);
  if (joint.block_count + joint.drive_count < 2) return;  // no row turns alone
  joint.radius = radius_of(trace_bound(a, b, joint.share));
  joint.drives[0].radius = joint.drives[1].radius = joint.radius;
  if (joint.drive_count == 0 || joint.properties.type == JointType::distance) return;
  const Mat3<Unit<S>> frame = to_matrix(end_a.pose.orientation * joint.properties.frame_a.orientation);
  const auto about = [&](int i) { return turning_about(convert<S>(frame.column(i)), a, b, joint.share); };
  const auto length_of = [](Vec3<S> arm) { return direction_of(arm.x, arm.y, arm.z).length; };
  const S arm = joint.share.a * length_of(joint.properties.frame_a.position) +
                joint.share.b * length_of(joint.properties.frame_b.position);
  const auto mean = [&](S own) { return sqrt(own) * sqrt(direction_of(own, arm, S(0)).length); };
  joint.drives[0].radius = mean(radius_of(about(2)));
  joint.drives[1].radius = mean(radius_of(S(0.5) * about(0) + S(0.5) * about(1)));
}

/// Which of the two kinds of row a joint has.
template <class S> ISO_INLINE void count_rows(JointConstraint<S>& joint) {
  const JointProperties<S>& p = joint.properties;
  const bool limit = (p.flags & joint_flag::kLimit) != 0, motor = (p.flags & joint_flag::kMotor) != 0;
  const bool spring = (p.flags & joint_flag::kSpring) != 0, cone = (p.flags & joint_flag::kCone) != 0;
  JointDrive<S>& main = joint.drives[0];
  JointDrive<S>& swing = joint.drives[1];
  main = {};
  swing = {};
  main.place = 2;
  main.push_speed = swing.push_speed = kAnglePushSpeed<S>;
  switch (p.type) {
    case JointType::ball:
      joint.block_count = cone || limit ? 2 : 1;
      joint.drive_count = cone || limit ? 2 : 0;
      main.bounded_below = main.bounded_above = limit;
      swing.bounded_above = cone;
      return;
    case JointType::hinge:
      joint.block_count = 2;
      joint.drive_count = limit || motor || spring ? 1 : 0;
      main.bounded_below = main.bounded_above = limit;
      main.driven = motor;
      main.sprung = spring;
      return;
    case JointType::fixed:
      joint.block_count = 2;
      joint.drive_count = 0;
      return;
    case JointType::distance: {
      const bool bounded = limit || !spring;
      const bool rod = bounded && !(p.lower < p.upper);
      joint.block_count = 1;
      joint.drive_count = rod ? 0 : 1;
      main.place = 0;
      main.push_speed = kJointPushSpeed<S>;
      main.bounded_below = bounded && p.lower > S(0);
      main.bounded_above = bounded;
      main.sprung = spring;
      return;
    }
  }
}

template <class S> ISO_INLINE void load_impulses(const JointState<S>& state, JointConstraint<S>& joint) {
  joint.blocks[0].impulse = state.point;
  joint.blocks[1].impulse = state.angular;
  JointDrive<S>& main = joint.drives[0];
  JointDrive<S>& swing = joint.drives[1];
  main.impulse = state.drive;
  swing.impulse = state.swing;
  main.piece = valid_piece(main, state.drive_piece());
  swing.piece = valid_piece(swing, state.swing_piece());
}

template <class S> ISO_INLINE void set_turns(JointRow<S>& row, const Mat3<S>& kappa_a, const Mat3<S>& kappa_b) {
  row.turn_a = kappa_a * row.angular_a;
  row.turn_b = kappa_b * row.angular_b;
}
/// Entry of K between two rows of one joint.
template <class S> ISO_INLINE S self_coupling(const JointRow<S>& i, const JointRow<S>& j, MassShare<S> share) {
  return share.a * coupling(i.linear, i.angular_a, j.linear, j.turn_a) +
         share.b * coupling(i.linear, i.angular_b, j.linear, j.turn_b);
}
template <class S> ISO_INLINE void weigh_block(JointBlock<S>& block, MassShare<S> share) {
  if (block.point) {
    const auto& r = block.rows;
    const Mat3<S> a =
        point_coupling<S>({r[0].angular_a, r[1].angular_a, r[2].angular_a}, {r[0].turn_a, r[1].turn_a, r[2].turn_a});
    const Mat3<S> b =
        point_coupling<S>({r[0].angular_b, r[1].angular_b, r[2].angular_b}, {r[0].turn_b, r[1].turn_b, r[2].turn_b});
    const S one = share.a + share.b;
    const auto mix = [&](S of_a, S of_b) { return round_to<S>(product(share.a, of_a) + product(share.b, of_b)); };
    const S xy = mix(a.rows[0].y, b.rows[0].y), xz = mix(a.rows[0].z, b.rows[0].z), yz = mix(a.rows[1].z, b.rows[1].z);
    block.coupling = {{{one + mix(a.rows[0].x, b.rows[0].x), xy, xz},
                       {xy, one + mix(a.rows[1].y, b.rows[1].y), yz},
                       {xz, yz, one + mix(a.rows[2].z, b.rows[2].z)}}};
    return;
  }
  const auto k = [&](int i, int j) { return self_coupling(block.rows[i], block.rows[j], share); };
  const S xy = k(0, 1), xz = k(0, 2), yz = k(1, 2);
  const Vec3<S> give = block.give;
  block.coupling = {{{k(0, 0) + give.x, xy, xz}, {xy, k(1, 1) + give.y, yz}, {xz, yz, k(2, 2) + give.z}}};
}

/// K_ij between blocks at one body, without the mass share of j.
template <class S>
ISO_INLINE Mat3<S> block_coupling(const JointBlock<S>& i, bool i_is_a, const JointBlock<S>& j, bool j_is_a) {
  if (i.point && j.point) {
    const auto angular = [&](int r) { return i_is_a ? i.rows[r].angular_a : i.rows[r].angular_b; };
    const auto turn = [&](int r) { return j_is_a ? j.rows[r].turn_a : j.rows[r].turn_b; };
    Mat3<S> p = point_coupling<S>({angular(0), angular(1), angular(2)}, {turn(0), turn(1), turn(2)});
    p = p + Mat3<S>::identity();
    return i_is_a == j_is_a ? p : Mat3<S>{{-p.rows[0], -p.rows[1], -p.rows[2]}};
  }
  Mat3<S> k;
  for (int r = 0; r < 3; ++r) {
    const JointRow<S>& row = i.rows[r];
    const Vec3<S> angular = i_is_a ? row.angular_a : row.angular_b;
    const auto with = [&](const JointRow<S>& other) {
      const S c = coupling(row.linear, angular, other.linear, j_is_a ? other.turn_a : other.turn_b);
      return i_is_a == j_is_a ? c : -c;
    };
    k.rows[r] = {with(j.rows[0]), with(j.rows[1]), with(j.rows[2])};
  }
  return k;
}

template <class S> ISO_INLINE Vec3<Velocity<S>> block_bias(const JointBlock<S>& block, S bias_rate) {
  const Velocity<S> most = kJointPushSpeed<S>;
  const auto bound = [&](Velocity<S> e) { return clamp(scaled(bias_rate, e), -most, most); };
  return {bound(block.error.x), bound(block.error.y), bound(block.error.z)};
}

/// The changes of impulse of a joint's rows, for bodies to be pushed once by all: on a long arm a drive and the point
/// turn a light body hard against each other, beyond the range of a spin, and what is left of both is little.
template <class S> class JointPush {
 public:
  using V = Velocity<S>;

  ISO_INLINE void add(const JointRow<S>& row, V change) {
    if (change == V(0)) return;
    rows_[count_] = &row;
    changes_[count_++] = change;
  }
  ISO_INLINE void add(const JointBlock<S>& block, Vec3<V> change) {
    for (int r = 0; r < 3; ++r) add(block.rows[r], change[r]);
  }
  ISO_INLINE void apply(const JointConstraint<S>& joint, SolverBodies<S>& bodies) const {
    if (bodies.moves(joint.row_a)) {
      const MotionRow<V> push = total(joint.share.a, [](const JointRow<S>& row) { return row.turn_a; });
      bodies.velocity[joint.row_a].linear -= push.linear;
      bodies.velocity[joint.row_a].angular -= push.angular;
    }
    if (bodies.moves(joint.row_b)) {
      const MotionRow<V> push = total(joint.share.b, [](const JointRow<S>& row) { return row.turn_b; });
      bodies.velocity[joint.row_b].linear += push.linear;
      bodies.velocity[joint.row_b].angular += push.angular;
    }
  }

 private:
  template <class Turn> ISO_INLINE MotionRow<V> total(S share, const Turn& turn) const {
    const auto zero = product(S(0), V(0));
    decltype(product(S(0), V(0))) linear[3] = {zero, zero, zero}, angular[3] = {zero, zero, zero};
    for (std::uint32_t i = 0; i < count_; ++i) {
      const V change = scaled(share, changes_[i]);
      const Vec3<S> along = rows_[i]->linear, about = turn(*rows_[i]);
      for (int k = 0; k < 3; ++k) {
        linear[k] = linear[k] + product(along[k], change);
        angular[k] = angular[k] + product(about[k], change);
      }
    }
    const auto rounded = [](const auto(&sum)[3]) {
      return Vec3<V>{round_to<V>(sum[0]), round_to<V>(sum[1]), round_to<V>(sum[2])};
    };
    return {rounded(linear), V(0), rounded(angular), V(0)};
  }

  const JointRow<S>* rows_[8];  // six of blocks, two of drives
  V changes_[8];
  std::uint32_t count_ = 0;
};

template <class S> ISO_INLINE JointRow<S> scaled_row(const JointRow<S>& row, Unit<S> s) {
  return {row.linear * s, row.angular_a * s, row.angular_b * s, row.turn_a * s, row.turn_b * s};
}
/// A fixed speed is the row itself, a spring a weaker one that yields, a constant impulse none.
template <class S> ISO_INLINE void place_drives(JointConstraint<S>& joint) {
  JointBlock<S>& block = joint.blocks[joint.block_count - 1];
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& drive = joint.drives[i];
    const int at = static_cast<int>(drive.place);
    const bool fixed = fixes_speed(drive.piece), springs = !fixed && drive.spring > S(0);
    block.rows[at] = fixed     ? drive.row
                     : springs ? scaled_row(drive.row, drive.spring_row.y)
                               : JointRow<S>::zero();
    const S share = convert<S>(drive.spring_row.x);
    block.give.set(at, springs ? share * share : S(0));
  }
}

/// Strength of a spring that has its frequency while the joint's own point holds and the rest of the world is still.
/// Symbols: a1 = 2 damping + angle, w^2 = angle a1 e, with e the effective mass and angle = 2 pi frequency h; roots are
///          taken apart, for where a spring is weak their product keeps digits that w^2 loses.
template <class S> ISO_INLINE void weigh_spring(JointConstraint<S>& joint) {
  JointDrive<S>& drive = joint.drives[0];
  S k = self_coupling(drive.row, drive.row, joint.share);
  if (joint.block_count > 1) {
    const JointBlock<S>& point = joint.blocks[0];
    const Mat3<S> inverse = invert_symmetric(point.coupling, kBlockCompliance<S>);
    const auto with = [&](int r) { return self_coupling(drive.row, point.rows[r], joint.share); };
    const Vec3<S> c = {with(0), with(1), with(2)};
    k = max(k - dot(c, inverse * c), k * kLeastCompliance<S>);
  }
  drive.spring = k > S(0) ? drive.spring_root / sqrt(k) : S(0);
  if (drive.spring < S(8) * resolution<S>()) drive.spring = S(0);
  drive.spring_row = direction_of(S(1), drive.spring, S(0));
  const S error = drive.position - drive.target;
  drive.spring_speed = saturated<S>(product(drive.spring_rate, error));
  drive.spring_push = drive.spring < S(1) ? saturated<S>(product(drive.spring * drive.spring_rate, error))
                                          : saturated<S>(product(drive.spring, drive.spring_speed));
}

template <class S> ISO_INLINE Velocity<S> motor_limit(const JointConstraint<S>& joint, Step<S> h) {
  return convert<Velocity<S>>(min(joint.motor_force * h, joint.most_motor));
}
template <class S>
ISO_INLINE DriveBounds<S> bounds_of(const JointDrive<S>& drive, const JointStep<S>& step, bool relax) {
  return bounds_of(drive, step.rate, step.h, relax ? S(0) : step.softness.bias_rate);
}
/// Whether the drive's impulse is the same whatever its speed.
template <class S> ISO_INLINE bool is_constant(const JointDrive<S>& drive, DrivePiece piece) {
  return !fixes_speed(piece) && !(drive.spring > S(0));
}

/// `speed` is that of the row as it stands in its block.
template <class S>
ISO_INLINE Velocity<S> drive_right_side(const JointDrive<S>& drive, Velocity<S> speed, const DriveBounds<S>& bounds,
                                        Velocity<S> most) {
  using V = Velocity<S>;
  if (fixes_speed(drive.piece)) return fixed_speed(drive, drive.piece, bounds) - speed;
  if (!(drive.spring > S(0))) return V(0);
  const S share = convert<S>(drive.spring_row.x);
  const V pushed = drive.impulse - motor_impulse(drive.piece, most);
  return -(speed + scaled(share, drive.spring_push) + saturated<S>(product(share / drive.spring, pushed)));
}

}  // namespace detail

template <class S>
void prepare_joint(const JointProperties<S>& properties, const JointState<S>& state, const JointEnd<S>& a,
                   const JointEnd<S>& b, const SolverBodies<S>& bodies, JointConstraint<S>& joint) {
  joint.properties = properties;
  joint.row_a = a.row;
  joint.row_b = b.row;
  joint.pose_a = a.pose;
  joint.pose_b = b.pose;
  const SolverMass<S>& mass_a = bodies.mass[a.row];
  const SolverMass<S>& mass_b = bodies.mass[b.row];
  joint.share = mass_share(mass_a.mass, mass_b.mass);
  joint.holds = a.row != b.row && joint.share.a + joint.share.b > S(0);
  joint.blocks[0].give = joint.blocks[1].give = Vec3<S>::zero();
  detail::count_rows(joint);
  detail::load_impulses(state, joint);
  detail::set_radii(a, mass_a, mass_b, joint);
  joint.motor_force = joint.most_motor = S(0);
  if (!joint.drives[0].driven) return;
  // torque h / (reduced mass radius) is the impulse, in its unit, that the motor gives in h.
  const S reduced = mass_a.mass > S(0) ? mass_a.mass * joint.share.a : mass_b.mass * joint.share.b;
  const S radius = joint.drives[0].radius;
  joint.motor_force = divide_to<S>(properties.motor_torque, reduced * radius);
  // Alone, without what the point holds, it turns a body no faster than its points may move.
  const S reach = max(S(1), max(max_abs(properties.frame_a.position), max_abs(properties.frame_b.position)));
  const S turning = max(detail::trace_bound(mass_a, mass_b, joint.share) * radius, S(1));
  joint.most_motor = min(Limits<S>::speed(), Limits<S>::surface_speed() / reach / turning);
}

namespace detail {
/// Velocities hold where a sub-step begins and move bodies through all of it: while an arm turns its end leaves the
/// tangent by h^2 / 2 w x (w x arm). A joint that closed that afterwards would turn the body back with every sub-step,
/// and a spinning top would sink.
template <class S> ISO_INLINE Vec3<Velocity<S>> curve_of(Vec3<S> arm, Vec3<Velocity<S>> spin, Step<S> h) {
  using V = Velocity<S>;
  const auto across = [](Vec3<V> w, Vec3<S> r) {
    return Vec3<V>{saturated<S>(product(r.z, w.y) - product(r.y, w.z)),
                   saturated<S>(product(r.x, w.z) - product(r.z, w.x)),
                   saturated<S>(product(r.y, w.x) - product(r.x, w.y))};
  };
  const S half = S(0.5) * h;
  return across({scaled(half, spin.x), scaled(half, spin.y), scaled(half, spin.z)}, convert<S>(across(spin, arm)));
}
}  // namespace detail

template <class S> void curve_joint(JointConstraint<S>& joint, const JointStep<S>& step) {
  if (joint.block_count == 0 || !joint.blocks[0].point) return;
  const auto curve = [&](Vec3<S> arm, std::uint32_t row) {
    const Vec3<Velocity<S>> spin = step.bodies->velocity[row].angular;
    return step.rapid < max_abs(spin) ? detail::curve_of(arm, spin, step.h) : Vec3<Velocity<S>>::zero();
  };
  joint.blocks[0].curve = curve(joint.arm_b, joint.row_b) - curve(joint.arm_a, joint.row_a);
}

template <class S> void linearise_joint(JointConstraint<S>& joint, const JointStep<S>& step) {
  joint.blocks[0].curve = joint.blocks[1].curve = Vec3<Velocity<S>>::zero();
  const detail::JointFrames<S> frames = detail::joint_frames(joint, step.states);
  joint.arm_a = frames.arm_a;
  joint.arm_b = frames.arm_b;
  switch (joint.properties.type) {
    case JointType::ball: detail::linearise_ball(frames, step.h, joint); break;
    case JointType::hinge: detail::linearise_hinge(frames, step.h, joint); break;
    case JointType::fixed: detail::linearise_fixed(frames, step.h, joint); break;
    case JointType::distance: detail::linearise_distance(frames, step.h, joint); break;
  }
  JointDrive<S>& main = joint.drives[0];
  main.piece = detail::valid_piece(main, main.piece);
  if (!main.sprung) return;
  const JointProperties<S>& p = joint.properties;
  const S angle = S(6.283185307179586) * (p.spring_frequency * step.h);
  const S a1 = S(2) * p.spring_damping + angle;
  main.spring_root = sqrt(angle) * sqrt(a1);
  main.spring_rate = a1 > S(0) ? step.rate * (angle / a1) : S(0);
}

template <class S> void weigh_joint(JointConstraint<S>& joint, const Mat3<S>& kappa_a, const Mat3<S>& kappa_b) {
  for (std::uint32_t i = 0; i < joint.block_count; ++i) {
    for (JointRow<S>& row : joint.blocks[i].rows) detail::set_turns(row, kappa_a, kappa_b);
  }
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) detail::set_turns(joint.drives[i].row, kappa_a, kappa_b);
  if (joint.drives[0].sprung) {
    if (joint.block_count > 1) detail::weigh_block(joint.blocks[0], joint.share);
    detail::weigh_spring(joint);
  }
}

template <class S> void couple_blocks(JointConstraint<S>& joint) {
  if (joint.drive_count > 0) detail::place_drives(joint);
  for (std::uint32_t i = 0; i < joint.block_count; ++i) detail::weigh_block(joint.blocks[i], joint.share);
}

template <class S> void apply_impulses(JointConstraint<S>& joint, const JointStep<S>& step) {
  detail::JointPush<S> push;
  for (std::uint32_t i = 0; i < joint.block_count; ++i) push.add(joint.blocks[i], joint.blocks[i].impulse);
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    if (detail::is_constant(drive, drive.piece)) {
      drive.impulse = detail::motor_impulse(drive.piece, detail::motor_limit(joint, step.h));
    }
    push.add(drive.row, drive.impulse);
  }
  push.apply(joint, *step.bodies);
}

template <class S>
Vec3<Velocity<S>> right_side(const JointConstraint<S>& joint, std::uint32_t block, const JointMotion<S>& motion,
                             const JointStep<S>& step, bool relax) {
  using V = Velocity<S>;
  const JointBlock<S>& of = joint.blocks[block];
  const Vec3<V> speed = speed_along(of, motion);
  Vec3<V> right = -speed;
  if (!relax) right -= detail::block_bias(of, step.softness.bias_rate);
  if (block + 1 < joint.block_count) return right;
  const V most = detail::motor_limit(joint, step.h);
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& drive = joint.drives[i];
    const int at = static_cast<int>(drive.place);
    right.set(at, detail::drive_right_side(drive, speed[at], detail::bounds_of(drive, step, relax), most));
  }
  return right;
}

template <class S>
void push_joint(JointConstraint<S>& joint, const JointRows<S>& change, Softness<S> soft, SolverBodies<S>& bodies) {
  using V = Velocity<S>;
  const V limit = convert<V>(Limits<S>::speed());
  const auto next = [&](V old, V full) {
    return clamp(old + scaled(soft.mass_scale, full) - scaled(soft.impulse_scale, old), -limit, limit);
  };
  detail::JointPush<S> push;
  Vec3<V> asked[2] = {change.point, change.angular};
  Vec3<V>& of_drives = asked[joint.block_count - 1];
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    const int at = static_cast<int>(drive.place);
    if (!detail::is_constant(drive, drive.piece)) {
      const bool fixed = detail::fixes_speed(drive.piece);
      const V full = fixed ? of_drives[at] : round_to<V>(product(drive.spring_row.y, of_drives[at]));
      const V impulse = next(drive.impulse, full);
      push.add(drive.row, impulse - drive.impulse);
      drive.impulse = impulse;
    }
    of_drives.set(at, V(0));
  }
  for (std::uint32_t i = 0; i < joint.block_count; ++i) {
    Vec3<V>& impulse = joint.blocks[i].impulse;
    const Vec3<V> old = impulse;
    impulse = {next(old.x, asked[i].x), next(old.y, asked[i].y), next(old.z, asked[i].z)};
    push.add(joint.blocks[i], impulse - old);
  }
  push.apply(joint, bodies);
}

template <class S> bool judge_drives(JointConstraint<S>& joint, const JointStep<S>& step, bool relax) {
  const JointMotion<S> m = gather(*step.bodies, joint.row_a, joint.row_b);
  const Velocity<S> most = detail::motor_limit(joint, step.h);
  bool changes = false;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    drive.next = detail::next_piece(drive, speed_along(drive.row, m), detail::bounds_of(drive, step, relax), most);
    changes = changes || drive.next != drive.piece;
  }
  return changes;
}

template <class S> JointStart<S> start_of(const JointConstraint<S>& joint, const SolverBodies<S>& bodies) {
  return {gather(bodies, joint.row_a, joint.row_b),
          {joint.blocks[0].impulse, joint.blocks[1].impulse},
          {joint.drives[0].impulse, joint.drives[1].impulse}};
}
template <class S> void restart_joint(JointConstraint<S>& joint, const JointStart<S>& start, SolverBodies<S>& bodies) {
  scatter(bodies, joint.row_a, joint.row_b, start.motion);
  joint.blocks[0].impulse = start.impulses.point;
  joint.blocks[1].impulse = start.impulses.angular;
  for (int i = 0; i < 2; ++i) joint.drives[i].impulse = start.drives[i];
}

template <class S> void change_pieces(JointConstraint<S>& joint, const JointStep<S>& step) {
  JointMotion<S> m = gather(*step.bodies, joint.row_a, joint.row_b);
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    if (drive.next == drive.piece) continue;
    drive.piece = drive.next;
    if (!detail::is_constant(drive, drive.piece)) continue;
    const Velocity<S> impulse = detail::motor_impulse(drive.piece, detail::motor_limit(joint, step.h));
    push(drive.row, joint.share, impulse - drive.impulse, m);
    drive.impulse = impulse;
  }
  scatter(*step.bodies, joint.row_a, joint.row_b, m);
}

template <class S> void store_joint(const JointConstraint<S>& joint, JointState<S>& state) {
  using V = Velocity<S>;
  const Vec3<V> zero = Vec3<V>::zero();
  const auto kept = [&](std::uint32_t i) { return i < joint.drive_count ? joint.drives[i].impulse : V(0); };
  const auto piece = [&](std::uint32_t i) {
    return i < joint.drive_count ? static_cast<std::uint32_t>(joint.drives[i].piece) : 0u;
  };
  state.point = joint.block_count > 0 ? joint.blocks[0].impulse : zero;
  state.angular = joint.block_count > 1 ? joint.blocks[1].impulse : zero;
  state.drive = kept(0);
  state.swing = kept(1);
  state.pieces = piece(0) | piece(1) << 8;
}

}  // namespace isostep
