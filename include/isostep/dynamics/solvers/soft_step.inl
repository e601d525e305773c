// Bodies of soft_step.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "isostep/dynamics/gyroscopic.hpp"
#include "isostep/dynamics/solvers/soft_step.hpp"

namespace isostep {
namespace detail {

// Contacts are springs of an eighth of the sub-step rate. A quarter, all that one spring alone allows, leaves a wall of
// 210 boxes trembling at 1e-3 J/kg, an eighth at 1e-9: springs that share a body stiffen one another and one pass over
// them does not converge. Softer ones sag: a stack of n boxes sags 3.5 n^2 / substeps^2 mm and buckles once that nears
// 50. The angle a sub-step is pi / 4 whatever the rate, and so the coefficients are constants.
template <class S> inline constexpr S kContactAngle = S(0.785398163397448309616);    // [rad]
template <class S> inline constexpr S kContactDamping = S(5);                        // [1] of critical
template <class S> inline constexpr Velocity<S> kPushSpeed = Velocity<S>(3);         // [m/s]
template <class S> inline constexpr Velocity<S> kRestitutionSpeed = Velocity<S>(1);  // [m/s]

/// What a kernel's index says of its contacts.
struct Variant {
  std::int32_t points;
  bool rolling;
  static ISO_INLINE constexpr Variant of(std::uint32_t index) {
    return {static_cast<std::int32_t>(index) % kMaxContactPoints + 1, index >= kMaxContactPoints};
  }
};

/// No motion along and about locked axes, whatever pushed.
template <class V> ISO_INLINE void hold_locks(std::uint32_t flags, MotionRow<V>& row) {
  if ((flags & body_flag::kAllLocks) == 0) return;
  for (int axis = 0; axis < 3; ++axis) {
    if ((flags & (body_flag::kLockX << axis)) != 0) row.linear.set(axis, V(0));
    if ((flags & (body_flag::kLockAngularX << axis)) != 0) row.angular.set(axis, V(0));
  }
}

}  // namespace detail

template <class S> void SoftStep<S>::gather_bodies(const SolverInput<S>& input) {
  const std::size_t count = input.states.size();
  bodies_.velocity.resize(count + 1);
  bodies_.displacement.assign(count + 1, MotionRow<Velocity<S>>::zero());
  bodies_.mass.resize(count + 1);
  inertia_.resize(count);
  bodies_.velocity[0] = MotionRow<Velocity<S>>::zero();
  bodies_.mass[0] = {S(0), Mat3<S>::diagonal(Vec3<S>::zero())};
  for (std::size_t i = 0; i < count; ++i) {
    const BodyState<S>& state = input.states[i];
    const BodyProperties<S>& body = input.properties[i];
    bodies_.velocity[i + 1] = {state.velocity, Velocity<S>(0), state.spin, Velocity<S>(0)};
    SolverMass<S>& mass = bodies_.mass[i + 1];
    if (body.type != BodyType::dynamic) {
      mass = bodies_.mass[0];
      continue;
    }
    mass.mass = body.mass;
    if (body.kappa.x == body.kappa.y && body.kappa.y == body.kappa.z) {
      mass.kappa = Mat3<S>::diagonal(body.kappa);
    } else {
      mass.kappa = rotate_diagonal(to_matrix(state.orientation * body.principal), body.kappa);
      const S least = min(body.kappa.x, min(body.kappa.y, body.kappa.z));
      const auto ratio = [&](S k) { return k > S(0) ? least / k : S(0); };
      inertia_[i] = {ratio(body.kappa.x), ratio(body.kappa.y), ratio(body.kappa.z)};
    }
    if ((body.flags & (7u * body_flag::kLockAngularX)) != 0) {
      for (int axis = 0; axis < 3; ++axis) {
        if ((body.flags & (body_flag::kLockAngularX << axis)) == 0) continue;
        for (int k = 0; k < 3; ++k) {
          mass.kappa.rows[axis].set(k, S(0));
          mass.kappa.rows[k].set(axis, S(0));
        }
      }
    }
  }
}

template <class S>
void SoftStep<S>::add_run(const ContactKernels<S>& kernels, std::uint32_t variant, std::uint32_t first,
                          std::uint32_t count) {
  const auto width = static_cast<std::uint32_t>(kernels.width);
  const std::uint32_t blocks = (count + width - 1) / width;
  runs_.push_back({&kernels, variant, first, count, block_count_, blocks, memory_bytes_});
  block_count_ += blocks;
  const detail::Variant shape = detail::Variant::of(variant);
  memory_bytes_ += blocks * width * block_bytes<S, 1>(shape.points, shape.rolling);
  memory_bytes_ = (memory_bytes_ + 63) / 64 * 64;
}

template <class S> void SoftStep<S>::colour_constraints(const SolverInput<S>& input, const ContactKernels<S>& wide) {
  constexpr std::uint32_t kUncolouredBucket = Colouring::kUncoloured * kContactVariants;
  const std::size_t count = input.contacts.size();
  colouring_.begin(bodies_.mass.size());
  bucket_.resize(count);
  order_.resize(count);
  bucket_ends_.assign(kUncolouredBucket + 1, 0);
  runs_.clear();
  block_count_ = 0;
  memory_bytes_ = 0;
  const auto variant_of = [&](std::size_t i) {
    const bool rolling = input.geometry[i].material.rolling_resistance > S(0);
    return input.contacts[i].count - 1 + (rolling ? std::uint32_t{kMaxContactPoints} : 0u);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const ContactGeometry<S>& g = input.geometry[i];
    const std::uint32_t colour = colouring_.colour(g.row_a, bodies_.moves(g.row_a), g.row_b, bodies_.moves(g.row_b));
    bucket_[i] = colour == Colouring::kUncoloured ? kUncolouredBucket : colour * kContactVariants + variant_of(i);
    ++bucket_ends_[bucket_[i]];
  }
  std::uint32_t total = 0;
  for (std::uint32_t b = 0; b < kUncolouredBucket; ++b) {
    if (bucket_ends_[b] != 0) add_run(wide, b % kContactVariants, total, bucket_ends_[b]);
    total += bucket_ends_[b];
    bucket_ends_[b] = total - bucket_ends_[b];
  }
  bucket_ends_[kUncolouredBucket] = total;
  for (std::size_t i = 0; i < count; ++i) order_[bucket_ends_[bucket_[i]]++] = static_cast<std::uint32_t>(i);
  // What found no colour is solved one by one, in canonical order, at every width.
  const ContactKernels<S>& narrow = *contact_kernels<S>(Simd::scalar);
  for (std::uint32_t first = total; first < count;) {
    const std::uint32_t variant = variant_of(order_[first]);
    std::uint32_t end = first + 1;
    while (end < count && variant_of(order_[end]) == variant) ++end;
    add_run(narrow, variant, first, end - first);
    first = end;
  }
}

template <class S> BlockRun<S> SoftStep<S>::blocks_of(const Run& run) {
  return {memory_.data()->bytes + run.offset, &block_bodies_[run.first_block], static_cast<std::int32_t>(run.blocks),
          bodies_.velocity.data(), bodies_.displacement.data()};
}

template <class S> void SoftStep<S>::prepare(const SolverInput<S>& input) {
  memory_.resize((memory_bytes_ + 63) / 64 + 1);
  block_bodies_.resize(block_count_ + 1);
  for (const Run& run : runs_) {
    const detail::Variant shape = detail::Variant::of(run.variant);
    run.kernels->prepare({memory_.data()->bytes + run.offset, &block_bodies_[run.first_block],
                          static_cast<std::int32_t>(run.count), shape.points, shape.rolling, &order_[run.first],
                          input.contacts.data(), input.geometry.data(), bodies_.velocity.data(), bodies_.mass.data()});
  }
}

template <class S> void SoftStep<S>::integrate_velocities(const SolverInput<S>& input) {
  using V = Velocity<S>;
  const std::int32_t rate = input.hz * input.substeps;
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  const auto times = [](auto a, auto b) { return round_to<V>(product(a, b)); };
  for (std::size_t i = 0; i < input.states.size(); ++i) {
    const BodyProperties<S>& body = input.properties[i];
    if (body.type != BodyType::dynamic) continue;
    MotionRow<V>& row = bodies_.velocity[i + 1];
    Vec3<S> acceleration = body.gravity_scale == S(1) ? input.gravity : input.gravity * body.gravity_scale;
    if (!input.accelerations.empty()) {
      acceleration += input.accelerations[i].linear;
      const Vec3<S> turning = input.accelerations[i].angular;
      row.angular += {times(turning.x, h), times(turning.y, h), times(turning.z, h)};
    }
    row.linear += {times(acceleration.x, h), times(acceleration.y, h), times(acceleration.z, h)};
    // Implicit: v' = v / (1 + h c), stable at any damping.
    if (body.linear_damping > S(0)) {
      const S keep = S(1) / (S(1) + body.linear_damping * h);
      row.linear = {times(keep, row.linear.x), times(keep, row.linear.y), times(keep, row.linear.z)};
    }
    if (body.angular_damping > S(0)) {
      const S keep = S(1) / (S(1) + body.angular_damping * h);
      row.angular = {times(keep, row.angular.x), times(keep, row.angular.y), times(keep, row.angular.z)};
    }
    if ((body.flags & body_flag::kSpins) != 0) {
      row.angular =
          turn_freely<S>(to_matrix(input.states[i].orientation * body.principal), inertia_[i], row.angular, h);
    }
    detail::hold_locks(body.flags, row);
  }
}

template <class S> void SoftStep<S>::integrate_positions(const SolverInput<S>& input) {
  using V = Velocity<S>;
  const std::int32_t rate = input.hz * input.substeps;
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  const V fastest = spin_limit<S>(rate);
  const auto times = [](V a, Step<S> b) { return round_to<V>(product(a, b)); };
  for (std::size_t i = 0; i < input.states.size(); ++i) {
    MotionRow<V>& v = bodies_.velocity[i + 1];
    detail::hold_locks(input.properties[i].flags, v);
    MotionRow<V>& d = bodies_.displacement[i + 1];
    BodyState<S>& state = input.states[i];
    const Vec3<V> move = {times(v.linear.x, h), times(v.linear.y, h), times(v.linear.z, h)};
    const auto turn = [&](V w) { return round_to<Unit<S>>(product(clamp(w, -fastest, fastest), h)); };
    // The centre follows the displacement, not the moves: where S is coarse, small moves add up before they round.
    const Vec3<S> before = convert<S>(d.linear);
    d.linear += move;
    d.angular += {times(v.angular.x, h), times(v.angular.y, h), times(v.angular.z, h)};
    state.centre += convert<S>(d.linear) - before;
    state.orientation =
        integrate(state.orientation, Vec3<Unit<S>>{turn(v.angular.x), turn(v.angular.y), turn(v.angular.z)});
  }
}

namespace detail {
template <class S> ContactPass<S> contact_pass(const SolverInput<S>& input) {
  const S rate = S(input.hz * input.substeps);
  // A gap wider than a sub-step covers at 64 m/s counts as that: nothing so far apart closes within the sub-step. Loads
  // beyond a 64th of the format (32 m/s for Q16.16) count as that: times friction and the cone's slope they still fit.
  return {soften(kContactAngle<S>, kContactDamping<S>, rate),
          rate,
          kPushSpeed<S>,
          divide_to<Velocity<S>>(S(64), rate),
          highest<Velocity<S>>() * Velocity<S>(1.0 / 64),
          kRestitutionSpeed<S>};
}
}  // namespace detail

template <class S>
void SoftStep<S>::solve_substeps(const SolverInput<S>& input, const TreeKernels<S>& trees) {
  const ContactPass<S> pass = detail::contact_pass(input);
  const S rate = S(input.hz * input.substeps);
  const JointStep<S> joint_step = {input.states.data(), &bodies_, rate, divide_to<Step<S>>(S(1), rate),
                                   joint_softness(rate)};
  joint_trees_.plan(input.joints, bodies_, &trees);
  const std::uint32_t batches = joint_trees_.batch_count();
  for (std::int32_t substep = 0; substep < input.substeps; ++substep) {
    integrate_velocities(input);
    for (std::uint32_t i = 0; i < batches; ++i) joint_trees_.warm_start(i, input.joints, joint_step);
    for (const Run& run : runs_) run.kernels->warm_start[run.variant](blocks_of(run));
    for (std::uint32_t i = 0; i < batches; ++i) joint_trees_.solve(i, input.joints, joint_step, false);
    for (const Run& run : runs_) run.kernels->solve[run.variant](blocks_of(run), pass);
    integrate_positions(input);
    for (std::uint32_t i = 0; i < batches; ++i) joint_trees_.solve(i, input.joints, joint_step, true);
    for (const Run& run : runs_) run.kernels->relax[run.variant](blocks_of(run), pass);
  }
  for (std::uint32_t i = 0; i < batches; ++i) joint_trees_.store(i, input.joints);
}

template <class S> void SoftStep<S>::restitute(const SolverInput<S>& input) {
  bool bounces = false;
  for (const ContactGeometry<S>& g : input.geometry) bounces = bounces || g.material.restitution > S(0);
  if (!bounces) return;
  const ContactPass<S> pass = detail::contact_pass(input);
  for (const Run& run : runs_) run.kernels->restitute[run.variant](blocks_of(run), pass);
}

template <class S> void SoftStep<S>::store_impulses(const SolverInput<S>& input) {
  for (const Run& run : runs_) {
    const detail::Variant shape = detail::Variant::of(run.variant);
    run.kernels->store({memory_.data()->bytes + run.offset, static_cast<std::int32_t>(run.count), shape.points,
                        shape.rolling, &order_[run.first], input.contacts.data(), input.step_impulses.data()});
  }
  for (std::size_t i = 0; i < input.states.size(); ++i) {
    input.states[i].velocity = bodies_.velocity[i + 1].linear;
    input.states[i].spin = bodies_.velocity[i + 1].angular;
  }
}

}  // namespace isostep
