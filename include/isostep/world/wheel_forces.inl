// Bodies of wheel_forces.hpp: a sub-step of suspensions and tyres.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/checks.hpp"
#include "isostep/world/wheel_drive.inl"
#include "isostep/world/wheel_ground.inl"

namespace isostep {

template <class S>
auto WheelForces<S>::solve(const SolverBodies<S>& bodies, const std::vector<Acceleration<S>>& accelerations,
                           std::int32_t rate) -> const std::vector<Push>& {
  bodies_ = &bodies;
  accelerations_ = &accelerations;
  rate_ = rate;
  h_ = divide_to<Step<S>>(S(1), S(rate));
  pushes_.clear();
  motion_.resize(bodies.mass.size());
  for (Run& run : runs_) {
    motion_[run.row] = next_motion(run.row);
    motion_[run.ground] = next_motion(run.ground);
  }
  for (Run& run : runs_) place(run);
  for (const Group& group : groups_) drive(group);
  for (int i = 0; i < kIterations; ++i) {
    for (const Group& group : groups_) {
      lock(group);
      for (std::uint32_t r = group.first; r < group.end; ++r) {
        if (!runs_[r].touches) continue;
        press(runs_[r]);
        grip(runs_[r]);
      }
    }
  }
  for (Run& run : runs_) tell(run);
  return pushes_;
}

/// As the sub-step would leave it without wheels, before contacts and joints.
template <class S> MotionRow<Velocity<S>> WheelForces<S>::next_motion(std::uint32_t row) const {
  MotionRow<V> motion = bodies_->velocity[row];
  if (!bodies_->moves(row)) return motion;
  const Acceleration<S>& by = (*accelerations_)[row - 1];
  const S scale = state_.awake.properties[row - 1].gravity_scale;
  const Vec3<S> pull = scale == S(1) ? state_.settings.gravity : state_.settings.gravity * scale;
  const auto times = [&](Vec3<S> a) {
    return Vec3<V>{round_to<V>(product(a.x, h_)), round_to<V>(product(a.y, h_)), round_to<V>(product(a.z, h_))};
  };
  motion.linear += times(by.linear + pull);
  motion.angular += times(by.angular);
  return motion;
}

/// Where the wheel's middle is on its way down, so that it touches the ground's plane; and the rows there.
template <class S> void WheelForces<S>::place(Run& run) {
  run.touches = false;
  run.spin.brake = V(0);
  const Wheel<S>& w = wheel(run);
  run.length = w.free_length;
  if (!run.met) return;
  const BodyState<S>& state = state_.awake.states[run.row - 1];
  const Vec3<S> hard_arm =
      rotate(state.orientation, w.hard_point - state_.awake.properties[run.row - 1].local_centre);
  const Vec3<U> down = rotate(state.orientation, w.suspension);
  const MotionRow<V>& moved = bodies_->displacement[run.ground];
  const Vec3<S> point = run.point + convert<S>(moved.linear) + cross(convert<S>(moved.angular), run.ground_arm);
  const U facing = -dot(down, run.normal);
  if (facing < U(0.25)) return;
  run.lean = divide_to<S>(S(1), facing);
  const S height = dot(state.centre - point + hard_arm, run.normal);
  const S length = saturate_to<S>(product(height - w.radius, run.lean));
  if (w.free_length <= length) return;
  run.touches = true;
  run.length = length;
  const Vec3<S> arm = hard_arm + down * length - run.normal * w.radius;
  run.at = state.centre + arm;
  const Vec3<S> ground_arm = run.at - point + run.ground_arm;
  const Vec3<U> forward = normalise(cross(rotate(state.orientation, run.axle), run.normal));
  const SolverMass<S>&body = bodies_->mass[run.row], &ground = bodies_->mass[run.ground];
  const auto row_of = [&](Vec3<U> way) { return Row::of(way, body, arm, ground, ground_arm); };
  run.up = row_of(run.normal);
  run.along = row_of(forward);
  run.across = row_of(cross(run.normal, forward));
  run.up.push(motion_[run.row], motion_[run.ground], run.load);
  run.along.push(motion_[run.row], motion_[run.ground], run.push_along);
  run.across.push(motion_[run.row], motion_[run.ground], run.push_across);
}

/// [m/s] Along a row, as it would be without the impulse that it has made so far.
template <class S> Velocity<S> WheelForces<S>::without(const Run& run, const Row& row, V impulse) const {
  return saturating_subtract(row.speed(motion_[run.row], motion_[run.ground]),
                             saturate_to<V>(product(row.give, impulse)));
}

/// Spring, damper, bar and stop: what they push, of the length and speed that they lead to themselves.
template <class S> void WheelForces<S>::press(Run& run) {
  const Wheel<S>& w = wheel(run);
  const S mass = bodies_->mass[run.row].mass;
  const auto times = [](auto a, auto b) { return saturate_to<S>(product(a, b)); };
  const V others = without(run, run.up, run.load);
  const S stiffness = divide_to<S>(saturating_add(w.stiffness, run.anti_roll), mass);  // [1/s^2]
  const S damping = saturating_add(divide_to<S>(w.damping, mass), stiffness * h_);     // [1/s]
  S force = times(stiffness, w.free_length - run.length);                              // [m/s^2] along the suspension
  if (run.partner != kNone && runs_[run.partner].touches) {
    const Run& other = runs_[run.partner];
    const S speed = times(other.lean, convert<S>(other.up.speed(motion_[other.row], motion_[other.ground])));
    const S pressed = wheel(other).free_length - other.length - speed * h_;
    force = saturating_add(force, -times(divide_to<S>(run.anti_roll, mass), pressed));
  }
  force = saturating_add(force, -times(damping, times(run.lean, convert<S>(others))));
  const S firm = times(times(times(run.up.give, run.lean), run.lean), damping * h_);
  const S pushed = divide_to<S>(times(force, run.lean), saturating_add(S(1), firm));  // [m/s^2]
  V load = max(V(0), saturate_to<V>(product(pushed, h_)));
  // The end of travel: no shorter after the sub-step, and where it is too short, out of that.
  const S room = divide_to<S>(run.length - (w.free_length - w.travel), run.lean);
  const V least = saturate_to<V>(product(-room, S(rate_)));
  const V stop = divide_to<V>(min(least, detail::kPushSpeed<S>) - others, run.up.give);
  load = max(load, stop);
  run.up.push(motion_[run.row], motion_[run.ground], load - run.load);
  run.load = load;
}

template <class S> void WheelForces<S>::grip(Run& run) {
  const Wheel<S>& w = wheel(run);
  MotionRow<V>&body = motion_[run.row], &ground = motion_[run.ground];
  const auto most = [&](S grip) {
    return saturate_to<V>(product(sqrt(saturate_to<S>(product(grip, run.friction))), run.load));
  };
  const detail::TyreImpulse<V> made =
      detail::tyre_impulse<S>(run.spin, run.along.give, run.across.give, without(run, run.along, run.push_along),
                              without(run, run.across, run.push_across), most(w.grip_along), most(w.grip_across));
  run.along.push(body, ground, made.along - run.push_along);
  run.across.push(body, ground, made.across - run.push_across);
  run.push_along = made.along;
  run.push_across = made.across;
}

/// The impulses of the sub-step, and how far the wheel turns in it.
template <class S> void WheelForces<S>::tell(Run& run) {
  constexpr S kTurn = S(6.28318530717958647692);
  const Wheel<S>& w = wheel(run);
  if (!run.touches) run.load = run.push_along = run.push_across = V(0);
  const V fastest = convert<V>(min(Limits<S>::surface_speed(), Limits<S>::speed() + Limits<S>::speed()));
  run.spin.rim = clamp(run.spin.after(run.push_along), -fastest, fastest);
  const S spin = divide_to<S>(run.spin.rim, w.radius);
  run.angle += clamp(spin * h_, -kTurn, kTurn);
  if (kTurn <= run.angle) run.angle -= kTurn;
  if (run.angle < S(0)) run.angle += kTurn;
  if (!run.touches) return;
  const auto sum = [&](auto part) {
    return Row::times(part(run.up), run.load) + Row::times(part(run.along), run.push_along) +
           Row::times(part(run.across), run.push_across);
  };
  const Vec3<V> linear = sum([](const Row& row) { return row.way; });
  pushes_.push_back({run.row, linear, sum([](const Row& row) { return row.spun; })});
  if (!(S(0) < run.up.share)) return;
  const Vec3<V> turning = sum([](const Row& row) { return row.ground_spun; });
  pushes_.push_back({run.ground, -Row::times(linear, run.up.share), -Row::times(turning, run.up.share)});
}

template <class S> void WheelForces<S>::end_step() {
  if (runs_.empty()) return;
  std::vector<Wheel<S>>& wheels = state_.force_records.change().wheels.change_all();
  for (const Run& run : runs_) {
    Wheel<S>& w = wheels[run.slot];
    const S mass = state_.awake.properties[run.row - 1].mass;
    const auto force = [&](V impulse) {
      return saturate_to<S>(product(mass, saturate_to<S>(product(impulse, S(rate_)))));
    };
    w.spin = divide_to<S>(run.spin.rim, w.radius);
    w.angle = run.angle;
    w.length = run.length;
    w.contact_body = run.touches ? run.met : BodyId{};
    w.contact_normal = run.touches ? run.normal : Vec3<U>{U(0), U(0), U(0)};
    w.contact_point = run.touches ? run.at : Vec3<S>::zero();
    w.load = force(run.load);
    w.along = force(run.push_along);
    w.across = force(run.push_across);
    constexpr V kTurning = V(0.05);
    if (kTurning < abs(run.spin.rim)) state_.awake.states[run.row - 1].sleep_clock = 0;
  }
}

}  // namespace isostep
