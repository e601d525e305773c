// Bodies of coupling_forces.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/force_bounds.hpp"
#include "isostep/dynamics/joints/joint.inl"
#include "isostep/math/angles.hpp"
#include "isostep/systems/forces/coupling_forces.hpp"

namespace isostep {

namespace detail {
/// [1] The part of an error that a sub-step closes: as kBaumgarte, but of a sub-step.
template <class S> inline constexpr S kCouplingBias = S(0.2);
}  // namespace detail

template <class S>
auto CouplingForces<S>::solve(const SolverBodies<S>& bodies, const std::vector<Acceleration<S>>& accelerations,
                              std::int32_t rate) -> const std::vector<VelocityChange<S>>& {
  bodies_ = &bodies;
  rate_ = S(rate);
  h_ = divide_to<Step<S>>(S(1), rate_);
  changes_.clear();
  if (runs_.empty()) list_runs(bodies);
  motion_.resize(bodies.mass.size());
  before_.resize(bodies.mass.size());
  for (Run& run : runs_) {
    for (int i = 0; i < run.count; ++i) {
      const JointConstraint<S>& joint = run.terms[i].joint;
      for (const std::uint32_t row : {joint.row_a, joint.row_b})
        motion_[row] = before_[row] = detail::next_motion(state_, bodies, accelerations, row, h_);
    }
  }
  JointStep<S> step = {state_.awake.states.data(), nullptr, rate_, h_, Softness<S>::rigid()};
  for (Run& run : runs_) place(run, step);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (Run& run : runs_) push(run);
  }
  for (const std::uint32_t row : rows_) {
    changes_.push_back({row, saturating_subtract(motion_[row].linear, before_[row].linear),
                        saturating_subtract(motion_[row].angular, before_[row].angular)});
  }
  return changes_;
}

/// All of its joints are awake and hold their bodies.
template <class S> bool CouplingForces<S>::acts(const Coupling<S>& coupling) const {
  for (const JointId joint : detail::joints_of(coupling).all) {
    if (!joint) continue;
    if (map_.joint_location(joint.slot).is_asleep() || !map_.is_enabled(*map_.properties_of(joint))) return false;
  }
  return true;
}

template <class S> void CouplingForces<S>::list_runs(const SolverBodies<S>& bodies) {
  const auto& couplings = state_.records->couplings;
  rows_.clear();
  for (std::uint32_t slot = 0; slot < couplings.all().size(); ++slot) {
    const Coupling<S>& coupling = couplings.all()[slot];
    if (!couplings.is_taken(slot) || !acts(coupling)) continue;
    Run& run = runs_.emplace_back();
    run.lower = coupling.lower;
    run.upper = coupling.upper;
    run.count = coupling.joint_c ? 3 : 2;
    run.turns = false;
    const JointId joints[kMostTerms] = {coupling.joint_a, coupling.joint_b, coupling.joint_c};
    const S ratios[kMostTerms] = {coupling.ratio_a, coupling.ratio_b, coupling.ratio_c};
    for (int i = 0; i < run.count; ++i) {
      const JointProperties<S>& joint = state_.joints.properties[map_.joint_location(joints[i].slot).index];
      const auto end_at = [&](std::uint32_t body) { return JointEnd<S>{map_.row_of(body), map_.centre_pose_at(body)}; };
      run.terms[i].ratio = ratios[i];
      prepare_joint(detail::with_coordinate(joint), JointState<S>{}, end_at(joint.body_a), end_at(joint.body_b), bodies,
                    run.terms[i].joint);
      run.turns = run.turns || measure_of(joint.type) == JointMeasure::angle;
      for (const std::uint32_t row : {run.terms[i].joint.row_a, run.terms[i].joint.row_b}) {
        bool listed = !bodies.moves(row);
        for (const std::uint32_t other : rows_) listed = listed || other == row;
        if (!listed) rows_.push_back(row);
      }
    }
  }
}

/// Places the rows and the sum as the bodies lie now.
template <class S> void CouplingForces<S>::place(Run& run, const JointStep<S>& step) const {
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
}

/// [1] Speed of row i by an impulse along row j, through the bodies that both have.
template <class S> S CouplingForces<S>::coupling_of(const Term& i, const Term& j) const {
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

/// Divides an impulse on the sum among the rows: each in the measure in which it moves, and all so that the sum moves
/// by one. A body's motion in two of them is counted, for a sum that is pushed too far gains energy.
template <class S> void CouplingForces<S>::weigh(Run& run) const {
  const auto times = [](S a, S b) { return saturate_to<S>(product(a, b)); };
  const auto lever = [](const Term& t) {
    return measure_of(t.joint.properties.type) == JointMeasure::angle ? t.joint.drives[0].radius : S(1);
  };
  S own[kMostTerms];
  int first = -1;
  for (int i = 0; i < run.count; ++i) {
    const Term& term = run.terms[i];
    own[i] = term.joint.holds && S(0) < lever(term) ? coupling_of(term, term) : S(0);
    if (first < 0 && S(0) < own[i]) first = i;
  }
  run.holds = 0 <= first;
  if (!run.holds) return;
  const auto mass = [&](const Term& t) {  // [kg] reduced
    const SolverMass<S>&a = bodies_->mass[t.joint.row_a], &b = bodies_->mass[t.joint.row_b];
    return b.mass > S(0) ? times(t.joint.share.b, b.mass) : a.mass;
  };
  const Term& base = run.terms[first];
  for (int i = 0; i < run.count; ++i) {
    Term& term = run.terms[i];
    term.gear = term.push = S(0);
    if (!(S(0) < lever(term))) continue;
    term.gear = times(divide_to<S>(term.ratio, base.ratio), divide_to<S>(lever(base), lever(term)));
    if (S(0) < own[i]) term.push = times(term.gear, divide_to<S>(mass(base), mass(term)));
  }
  S moved = S(0);
  for (int i = 0; i < run.count; ++i) {
    for (int j = 0; j < run.count; ++j)
      moved = saturating_add(
          moved, times(run.terms[i].gear, times(coupling_of(run.terms[i], run.terms[j]), run.terms[j].push)));
  }
  run.holds = S(64) * resolution<S>() < moved;
  for (int i = 0; run.holds && i < run.count; ++i) run.terms[i].push = divide_to<S>(run.terms[i].push, moved);
}

/// Sets the speeds between which the sum stays within its bounds, or returns to them.
template <class S> void CouplingForces<S>::bound(Run& run, S sum) const {
  if (!run.holds) return;
  int first = 0;
  while (!(S(0) < abs(run.terms[first].push))) ++first;
  const Term& base = run.terms[first];
  const S middle = run.lower + (run.upper - run.lower) * S(0.5), half = (run.upper - run.lower) * S(0.5);
  const S off = run.turns ? wrap_angle(saturating_add(sum, -middle)) : saturating_add(sum, -middle);
  const S lever = measure_of(base.joint.properties.type) == JointMeasure::angle ? base.joint.drives[0].radius : S(1);
  // The gaps are lengths along the first row, whose sense counts.
  const auto along = [&](S x) { return divide_to<S>(saturate_to<S>(product(x, lever)), abs(base.ratio)); };
  const S bias = detail::kCouplingBias<S> * rate_;
  const auto least = [&](S gap) {
    return detail::least_speed(along(gap), detail::kJointPushSpeed<S>, rate_, h_, bias);
  };
  V low = least(saturating_add(off, half)), high = -least(saturating_add(half, -off));
  if (half == S(0)) low = high = S(0) < off ? high : low;
  const bool reversed = base.ratio < S(0);
  run.low = reversed ? -high : low;
  run.high = reversed ? -low : high;
  run.most = most_change(run);
  run.changed = V(0);
}

/// The greatest change, of which no body gains more than an eighth of the speed, or of the turn, that forces may give
/// it in a sub-step: alone, a light body on a long arm turns far more easily than its joint lets it, and several rows
/// may turn one body. The next sub-steps close what is left.
template <class S> Velocity<S> CouplingForces<S>::most_change(const Run& run) const {
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
      keep(detail::most_angular_speed(state_.awake.states[row - 1].fat) * kPart,
           times(moved, max_abs(of_b ? r.turn_b : r.turn_a)));
    }
  }
  return convert<V>(most);
}

template <class S> JointMotion<S> CouplingForces<S>::motion_of(const Term& term) const {
  return {motion_[term.joint.row_a], motion_[term.joint.row_b]};
}

template <class S> void CouplingForces<S>::push(Run& run) {
  if (!run.holds) return;
  V speed = V(0);
  for (int i = 0; i < run.count; ++i) {
    const Term& term = run.terms[i];
    const V own = speed_along(term.joint.drives[0].row, motion_of(term));
    speed = saturating_add(speed, saturate_to<V>(product(term.gear, own)));
  }
  const V asked = saturating_subtract(clamp(speed, run.low, run.high), speed);
  const V changed = clamp(saturating_add(run.changed, asked), -run.most, run.most);
  const V change = changed - run.changed;
  if (change == V(0)) return;
  run.changed = changed;
  for (int i = 0; i < run.count; ++i) {
    const Term& term = run.terms[i];
    const JointConstraint<S>& joint = term.joint;
    const V impulse = saturate_to<V>(product(term.push, change));
    const JointRow<S>& row = joint.drives[0].row;
    const auto add = [&](std::uint32_t r, S share, Vec3<S> turn, bool of_b) {
      if (!bodies_->moves(r)) return;
      const V part = saturate_to<V>(product(of_b ? share : -share, impulse));
      const auto times = [&](Vec3<S> v) {
        return Vec3<V>{saturate_to<V>(product(v.x, part)), saturate_to<V>(product(v.y, part)),
                       saturate_to<V>(product(v.z, part))};
      };
      motion_[r].linear = saturating_add(motion_[r].linear, times(row.linear));
      motion_[r].angular = saturating_add(motion_[r].angular, times(turn));
    };
    add(joint.row_a, joint.share.a, row.turn_a, false);
    add(joint.row_b, joint.share.b, row.turn_b, true);
  }
}

}  // namespace isostep
