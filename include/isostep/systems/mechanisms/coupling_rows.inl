// Bodies of coupling_rows.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/force_bounds.hpp"
#include "isostep/dynamics/joints/joint.inl"
#include "isostep/math/angles.hpp"
#include "isostep/store/fat_box.hpp"
#include "isostep/store/finite_guard.hpp"
#include "isostep/systems/mechanisms/coupling_ends.inl"
#include "isostep/systems/mechanisms/coupling_rows.hpp"

namespace isostep {

template <class S> void CouplingRows<S>::begin_step() {
  runs_.clear();
  prepared_ = false;
  const auto& couplings = state_.records->couplings;
  for (std::uint32_t slot = 0; slot < couplings.all().size(); ++slot) {
    const Coupling<S>& coupling = couplings.all()[slot];
    if (!couplings.is_taken(slot) || sleeps(coupling)) continue;
    if (acts(coupling)) list_run(slot, coupling);
    else state_.parts.coupling_states[slot] = {};
  }
}
template <class S> bool CouplingRows<S>::sleeps(const Coupling<S>& coupling) const {
  for (const JointId joint : detail::joints_of(coupling).all) {
    if (joint && map_.joints.location(joint.slot).is_asleep()) return true;
  }
  return false;
}
/// Returns true if all of its joints, which are awake, are enabled.
template <class S> bool CouplingRows<S>::acts(const Coupling<S>& coupling) const {
  for (const JointId joint : detail::joints_of(coupling).all) {
    if (joint && !map_.is_enabled(*map_.joints.properties_of(joint))) return false;
  }
  return true;
}
template <class S> void CouplingRows<S>::list_run(std::uint32_t slot, const Coupling<S>& coupling) {
  const JointId joints[kMostTerms] = {coupling.joint_a, coupling.joint_b, coupling.joint_c};
  const S ratios[kMostTerms] = {coupling.ratio_a, coupling.ratio_b, coupling.ratio_c};
  Run& run = runs_.emplace_back();
  run.slot = slot;
  run.lower = coupling.lower;
  run.upper = coupling.upper;
  run.count = coupling.joint_c ? 3 : 2;
  run.turns = false;
  run.begins = true;
  for (int i = 0; i < run.count; ++i) {
    Term& term = run.terms[i];
    term.index = map_.joints.location(joints[i].slot).index;
    const JointProperties<S>& joint = state_.joints.properties[term.index];
    term.rows[0] = map_.row_of(joint.body_a);
    term.rows[1] = map_.row_of(joint.body_b);
    term.ratio = ratios[i];
    run.turns = run.turns || measure_of(joint.type) == JointMeasure::angle;
  }
}

template <class S> void CouplingRows<S>::place(SolverBodies<S>& bodies, std::int32_t rate) {
  bodies_ = &bodies;
  rate_ = S(rate);
  h_ = divide_to<Step<S>>(S(1), rate_);
  if (!prepared_) prepare();
  const JointStep<S> step = {state_.awake.states.data(), nullptr, rate_, h_, Softness<S>::rigid()};
  for (Run& run : runs_) {
    place(run, step);
    if (run.resisted) run.changed = V(0);
    else if (run.holds) push(run, run.changed);
  }
  sweep(kMechanismSweeps, true, false);
}
/// Prepares joints and finds resisted rows, with the bodies where the step finds them.
template <class S> void CouplingRows<S>::prepare() {
  prepared_ = true;
  for (Run& run : runs_) {
    for (int i = 0; i < run.count; ++i) {
      Term& term = run.terms[i];
      const JointProperties<S>& joint = state_.joints.properties[term.index];
      const JointEnd<S> a = {term.rows[0], map_.centre_pose_at(joint.body_a)},
                        b = {term.rows[1], map_.centre_pose_at(joint.body_b)};
      prepare_joint(detail::with_coordinate(joint), JointState<S>{}, a, b, *bodies_, term.joint);
    }
  }
  count_joints();
  for (Run& run : runs_) run.resisted = is_resisted(run);
}
template <class S> void CouplingRows<S>::count_joints() {
  joints_of_.assign(state_.awake.states.size() + 1, 0);
  for (const JointProperties<S>& joint : state_.joints.properties) {
    for (const std::uint32_t body : {joint.body_a, joint.body_b}) {
      const std::uint32_t row = map_.row_of(body);
      if (joints_of_[row] < 2) ++joints_of_[row];
    }
  }
}
template <class S> bool CouplingRows<S>::is_resisted(const Run& run) const {
  for (int i = 0; i < run.count; ++i) {
    if (is_resisted(run.terms[i], false) || is_resisted(run.terms[i], true)) return true;
  }
  return false;
}
/// Returns true if the body is in another joint too, or if the distance of its centre from the axis makes up most of
/// its inertia about the joint.
template <class S> bool CouplingRows<S>::is_resisted(const Term& term, bool of_b) const {
  constexpr S kFar = S(2);  // [1] distance by radius of gyration: 1 + 4 times the inertia; rows are stable up to 6
  const std::uint32_t row = term.rows[of_b ? 1 : 0];
  if (!bodies_->moves(row)) return false;
  if (1 < joints_of_[row]) return true;
  const JointProperties<S>& joint = term.joint.properties;
  if (measure_of(joint.type) != JointMeasure::angle) return false;
  const BodyProperties<S>& body = state_.awake.properties[row - 1];
  const Pose<S>& frame = of_b ? joint.frame_b : joint.frame_a;
  const Vec3<S> arm = frame.position - body.local_centre;
  const Vec3<Unit<S>> axis = rotate(frame.orientation, Vec3<Unit<S>>{Unit<S>(0), Unit<S>(0), Unit<S>(1)});
  return kFar * term.joint.drives[0].radius < length(cross(convert<S>(axis), arm));
}

template <class S> void CouplingRows<S>::solve(int sweeps) { sweep(sweeps, false, false); }
/// Relaxes with as many sweeps as a pass: couplings of the same joints converge slowly, and a rest of the speed that
/// closed their errors is energy out of nothing.
template <class S> void CouplingRows<S>::relax() { sweep(kMechanismSweeps, false, true); }
/// Solves the rows that joints resist, or the others.
template <class S> void CouplingRows<S>::sweep(int times, bool resisted, bool relaxes) {
  for (int i = 0; i < times; ++i) {
    for (Run& run : runs_) {
      if (run.resisted == resisted) solve(run, relaxes);
    }
  }
}

template <class S> void CouplingRows<S>::end_step() {
  for (const Run& run : runs_) {
    CouplingState<S>& state = state_.parts.coupling_states[run.slot];
    state.load = run.holds ? load_of(run) : S(0);
    detail::keep_finite(state);
  }
}

/// Computes the rows and the sum at the present poses.
template <class S> void CouplingRows<S>::place(Run& run, const JointStep<S>& step) const {
  S sum = S(0);
  for (int i = 0; i < run.count; ++i) {
    Term& term = run.terms[i];
    JointConstraint<S>& joint = term.joint;
    linearise_joint(joint, step);
    detail::set_turns(joint.drives[0].row, bodies_->mass[joint.row_a].kappa, bodies_->mass[joint.row_b].kappa);
    const detail::JointFrames<S> frames = detail::joint_frames(joint, step.states);
    const S at = detail::position_of(joint.properties.type, frames);
    sum = saturating_add(sum, saturate_to<S>(product(term.ratio, at)));
  }
  weigh(run);
  bound(run, sum);
  place_ends(run);
}

/// [1] Returns the speed along row i that an impulse along row j causes through bodies they share.
template <class S> S CouplingRows<S>::coupling_of(const Term& i, const Term& j) const {
  const JointRow<S>&from = j.joint.drives[0].row, &to = i.joint.drives[0].row;
  S sum = S(0);
  for (const bool of_j : {false, true}) {
    const std::uint32_t row = of_j ? j.joint.row_b : j.joint.row_a;
    if (!bodies_->moves(row)) continue;
    const S share = of_j ? j.joint.share.b : j.joint.share.a;
    for (const bool of_i : {false, true}) {
      if ((of_i ? i.joint.row_b : i.joint.row_a) != row) continue;
      const S moved = saturate_to<S>(dot_sum(to.linear, from.linear) +
                                     dot_sum(of_i ? to.angular_b : to.angular_a, of_j ? from.turn_b : from.turn_a));
      const S part = saturate_to<S>(product(share, moved));
      sum = saturating_add(sum, of_i == of_j ? part : -part);
    }
  }
  return sum;
}

/// [m] The lever of an angle. [1] for a length.
template <class S> S CouplingRows<S>::lever_of(const Term& term) {
  return measure_of(term.joint.properties.type) == JointMeasure::angle ? term.joint.drives[0].radius : S(1);
}
/// Divides an impulse on the sum among the rows, each by the measure in which it moves, so that the sum moves by one.
/// Counts a body in two of them: a sum that is pushed too far gains energy.
template <class S> void CouplingRows<S>::weigh(Run& run) const {
  const auto times = [](S a, S b) { return saturate_to<S>(product(a, b)); };
  S own[kMostTerms];
  int first = -1;
  for (int i = 0; i < run.count; ++i) {
    const Term& term = run.terms[i];
    own[i] = term.joint.holds && S(0) < lever_of(term) ? coupling_of(term, term) : S(0);
    if (first < 0 && S(0) < own[i]) first = i;
  }
  run.holds = 0 <= first;
  run.unit = S(0);
  if (!run.holds) return;
  const auto mass = [&](const Term& t) {  // [kg] reduced
    const SolverMass<S>&a = bodies_->mass[t.joint.row_a], &b = bodies_->mass[t.joint.row_b];
    return b.mass > S(0) ? times(t.joint.share.b, b.mass) : a.mass;
  };
  const Term& base = run.terms[first];
  for (int i = 0; i < run.count; ++i) {
    Term& term = run.terms[i];
    term.gear = term.push = S(0);
    if (!(S(0) < lever_of(term))) continue;
    term.gear = times(divide_to<S>(term.ratio, base.ratio), divide_to<S>(lever_of(base), lever_of(term)));
    if (S(0) < own[i]) term.push = times(term.gear, divide_to<S>(mass(base), mass(term)));
  }
  S moved = S(0);
  for (int i = 0; i < run.count; ++i) {
    for (int j = 0; j < run.count; ++j)
      moved = saturating_add(
          moved, times(run.terms[i].gear, times(coupling_of(run.terms[i], run.terms[j]), run.terms[j].push)));
  }
  run.holds = S(64) * resolution<S>() < moved;
  if (!run.holds) return;
  for (int i = 0; i < run.count; ++i) run.terms[i].push = divide_to<S>(run.terms[i].push, moved);
  run.unit = divide_to<S>(divide_to<S>(times(mass(base), lever_of(base)), moved), base.ratio);
}

/// Finds the speeds with which the sum stays within its bounds, or returns to them.
template <class S> void CouplingRows<S>::bound(Run& run, S sum) const {
  if (!run.holds) return;
  int first = 0;
  while (!(S(0) < abs(run.terms[first].push))) ++first;
  const Term& base = run.terms[first];
  const S middle = run.lower + (run.upper - run.lower) * S(0.5), half = (run.upper - run.lower) * S(0.5);
  const S off = run.turns ? wrap_angle(saturating_add(sum, -middle)) : saturating_add(sum, -middle);
  const S lever = lever_of(base);
  // As lengths along the first row, whose sense counts.
  const auto along = [&](S x) { return divide_to<S>(saturate_to<S>(product(x, lever)), abs(base.ratio)); };
  const S bias = kBias * rate_;
  const auto least = [&](S gap) {
    return detail::least_speed(along(gap), detail::kJointPushSpeed<S>, rate_, h_, bias);
  };
  V low = least(saturating_add(off, half)), high = -least(saturating_add(half, -off));
  if (half == S(0)) low = high = S(0) < off ? high : low;
  const bool reversed = base.ratio < S(0);
  run.low = reversed ? -high : low;
  run.high = reversed ? -low : high;
  run.most = most_change(run);
  if (run.begins) run.changed = change_of(run, state_.parts.coupling_states[run.slot].load);
  else run.changed = saturating_add(run.changed, run.borne);
  run.borne = V(0);
  run.begins = false;
  run.changed = clamp(saturate_to<V>(product(kWarmth, run.changed)), -run.most, run.most);
}

/// Returns the change of the sum by which no body gains more than an eighth of the linear or angular speed that forces
/// may give it in a sub-step. Alone, a light body on a long arm turns far more easily than its joint lets it, and
/// several rows may turn one body. Later sub-steps close the rest.
template <class S> Velocity<S> CouplingRows<S>::most_change(const Run& run) const {
  constexpr S kPart = S(0.125);
  S most = Limits<S>::speed();
  const auto keep = [&](S limit, S by) {
    if (S(0) < by) most = min(most, divide_to<S>(limit, by));
  };
  const auto times = [](S a, S b) { return saturate_to<S>(product(a, b)); };
  for (int i = 0; i < run.count; ++i) {
    const JointConstraint<S>& joint = run.terms[i].joint;
    const S push = abs(run.terms[i].push);
    for (const bool of_b : {false, true}) {
      const std::uint32_t row = of_b ? joint.row_b : joint.row_a;
      if (!bodies_->moves(row)) continue;
      const S moved = times(push, of_b ? joint.share.b : joint.share.a);
      const JointRow<S>& r = joint.drives[0].row;
      keep(Limits<S>::speed() * kPart, times(moved, max_abs(r.linear)));
      keep(detail::most_angular_speed(
               detail::solid_box(map_, state_.awake.states[row - 1], state_.awake.properties[row - 1])) *
               kPart,
           times(moved, max_abs(of_b ? r.turn_b : r.turn_a)));
    }
  }
  return convert<V>(most);
}

/// Converts a load to the change of speed that it makes in a sub-step. load_of() converts the last change back.
template <class S> Velocity<S> CouplingRows<S>::change_of(const Run& run, S load) const {
  if (run.unit == S(0)) return V(0);
  return divide_to<V>(divide_to<S>(load, run.unit), rate_);
}
template <class S> S CouplingRows<S>::load_of(const Run& run) const {
  return saturate_to<S>(product(run.unit, saturate_to<S>(product(rate_, saturating_add(run.changed, run.borne)))));
}

/// [m/s] Returns the speed of the sum, in rows of the first term.
template <class S> Velocity<S> CouplingRows<S>::speed_of(const Run& run) const {
  V speed = V(0);
  for (int i = 0; i < run.count; ++i) {
    const Term& term = run.terms[i];
    const JointMotion<S> motion = {bodies_->velocity[term.rows[0]], bodies_->velocity[term.rows[1]]};
    const V own = speed_along(term.joint.drives[0].row, motion);
    speed = saturating_add(speed, saturate_to<V>(product(term.gear, own)));
  }
  return speed;
}
/// Changes the sum's speed by its excess beyond the bounds, without the change so far: too large a change is taken
/// back. Relaxing pushes nothing back into its bounds.
template <class S> void CouplingRows<S>::solve(Run& run, bool relaxes) {
  if (!run.holds) return;
  const V low = !relaxes ? run.low : run.is_equal() ? V(0) : min(run.low, V(0));
  const V high = !relaxes ? run.high : run.is_equal() ? V(0) : max(run.high, V(0));
  const V without = saturating_subtract(speed_of(run), run.changed);
  const V changed = clamp(saturating_subtract(clamp(without, low, high), without), -run.most, run.most);
  const V change = changed - run.changed;
  run.changed = changed;
  if (!(change == V(0))) push(run, change);
  for (int i = 0; i < run.count; ++i) {
    if (run.terms[i].ends) stop(run, run.terms[i], relaxes);
  }
}
template <class S> void CouplingRows<S>::push(const Run& run, V change) {
  for (int i = 0; i < run.count; ++i) push(run.terms[i], saturate_to<V>(product(run.terms[i].push, change)));
}
template <class S> void CouplingRows<S>::push(const Term& term, V impulse) {
  const JointConstraint<S>& joint = term.joint;
  const JointRow<S>& row = joint.drives[0].row;
  const auto add = [&](std::uint32_t r, S share, Vec3<S> turn) {
    if (!bodies_->moves(r)) return;
    const V part = saturate_to<V>(product(share, impulse));
    const auto times = [&](Vec3<S> v) {
      return Vec3<V>{saturate_to<V>(product(v.x, part)), saturate_to<V>(product(v.y, part)),
                     saturate_to<V>(product(v.z, part))};
    };
    MotionRow<V>& motion = bodies_->velocity[r];
    motion.linear = saturating_add(motion.linear, times(row.linear));
    motion.angular = saturating_add(motion.angular, times(turn));
  };
  add(term.rows[0], -joint.share.a, row.turn_a);
  add(term.rows[1], joint.share.b, row.turn_b);
}

}  // namespace isostep
