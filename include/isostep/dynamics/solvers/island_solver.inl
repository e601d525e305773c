// Bodies of island_solver.hpp: the stages of a step.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/contact_follow.hpp"
#include "isostep/dynamics/solvers/island_solver.hpp"
#include "isostep/dynamics/solvers/island_solver_contacts.inl"
#include "isostep/dynamics/solvers/island_solver_islands.inl"
#include "isostep/dynamics/solvers/island_solver_joints.inl"
#include "isostep/dynamics/solvers/island_solver_rows.inl"

namespace isostep {

template <class S> void IslandSolver<S>::colour_constraints(const StepContext<S>& context) {
  rate_ = context.hz * context.substeps;
  bodies_.gather(context, rate_, true);
  impacts_.begin(context, bodies_.rows());
  joints_.prepare_all(context, bodies_.rows());
  find_islands(context);
}

template <class S> void IslandSolver<S>::prepare(const StepContext<S>& context) {
  const ContactKernels<S>& kernels = *contact_kernels<S>(Simd::scalar);
  const SolverBodies<S>& bodies = bodies_.rows();
  const auto count = static_cast<std::uint32_t>(context.contacts.size());
  memory_.resize(count);
  block_bodies_.resize(count);
  order_.resize(count);
  for (std::uint32_t c = 0; c < count; ++c) {
    order_[c] = c;
    kernels.prepare({memory_[c].bytes, &block_bodies_[c], 1, static_cast<std::int32_t>(context.contacts[c].count),
                     rolls(context, c), &order_[c], context.contacts.data(), context.geometry.data(),
                     bodies.velocity.data(), bodies.mass.data(), S(0), S(0)});
  }
  roots_.resize(bodies.mass.size());
  kappa_.assign(bodies.mass.size(), Mat3<S>::diagonal(Vec3<S>::zero()));  // of what does not move none is ever set
  tension_.resize(bodies.mass.size(), Mat3<S>::diagonal(Vec3<S>::zero()));
}

/// Places the rows. Arms of contacts stay those of the step's begin; those of joints are current.
template <class S> void IslandSolver<S>::place_rows(const StepContext<S>& context, Island& island) {
  if (island.begun && island.joints.empty()) return;
  linearise_joints(context, island);
  for (std::size_t k = 0; k < island.joints.size(); ++k) {
    place_joint(joints_[island.joints[k]], island, island.joint_blocks[k]);
  }
  for (std::uint32_t k = 0; k < island.contacts.size(); ++k) place_contact(context, island, k);
  island.system.assemble();
}

/// Follows bodies that turn fast (contact_follow.hpp): free velocities become the current ones without the answers, by
/// the new inertia. In islands with joints only the inertia changes now; the rows follow at the next sub-step.
template <class S> void IslandSolver<S>::follow(const StepContext<S>& context, Island& island) {
  bool any = false;
  const bool by_answers = island.system.moves_by_answers();
  for (std::uint32_t i = 0; i < island.bodies.size(); ++i) {
    const std::uint32_t row = island.bodies[i];
    if (!bodies_.is_followed(context, row)) continue;
    any = true;
    bodies_.renew_inertia(context, row);
    if (!island.joints.empty()) continue;
    Vec3<V> free = bodies_.rows().velocity[row].angular;
    if (!by_answers) free = free - with_answers(island, i, MotionRow<V>::zero()).angular;
    find_root(row, bodies_.rows().mass[row].kappa);
    free_velocity_[row].angular = free;
  }
  if (!any || !island.joints.empty()) return;
  const std::vector<SolverMass<S>>& mass = bodies_.rows().mass;
  for (std::uint32_t k = 0; k < island.contacts.size(); ++k) {
    const std::uint32_t c = island.contacts[k];
    const ContactGeometry<S>& g = context.geometry[c];
    const auto points = static_cast<std::int32_t>(context.contacts[c].count);
    FollowedContact<S>(memory_[c].bytes, 1, points, rolls(context, c))
        .turn_by(mass[g.row_a].kappa, mass[g.row_b].kappa);
    if (by_answers) take_back_turns(context, island, k);
    place_contact(context, island, k);
  }
  island.system.assemble();
}

/// Subtracts a contact's answers from the free velocities of bodies that it follows.
template <class S>
void IslandSolver<S>::take_back_turns(const StepContext<S>& context, Island& island, std::uint32_t k) {
  const std::uint32_t c = island.contacts[k];
  const ContactGeometry<S>& g = context.geometry[c];
  const IslandPatch<N>& patch = island.system->patches()[k];
  const bool of_a = bodies_.is_followed(context, g.row_a), of_b = bodies_.is_followed(context, g.row_b);
  const auto take = [&](std::uint32_t r, const AngularRow<S, 1>& row) {
    const V impulse = impulse_of(island, r);
    const auto turn = [&](const S(&response)[3][1]) {
      return Vec3<V>{scaled(response[0][0], impulse), scaled(response[1][0], impulse), scaled(response[2][0], impulse)};
    };
    if (of_a) free_velocity_[g.row_a].angular += turn(row.response_a);
    if (of_b) free_velocity_[g.row_b].angular -= turn(row.response_b);
  };
  const Block& block = block_of(context, c);
  for (std::uint32_t t = 0; t < 2; ++t) take(patch.first + t, block.tangents[t].row);
  take(patch.first + 2, block.twist);
  for (std::uint32_t p = 0; p < patch.points; ++p) take(patch.normal + p, block.normals[p].row);
  if (patch.rolling == IslandPatch<N>::kNoRolling) return;
  const auto& rolling = *reinterpret_cast<const RollingRows<S, 1>*>(memory_[c].bytes);
  for (std::uint32_t r = 0; r < 2; ++r) take(patch.rolling + r, rolling.rows[r]);
}

/// Chooses the exponent of an island's answers, with room for answers larger than what is asked.
template <class S> void IslandSolver<S>::scale_right_sides(Island& island) {
  IslandSystem<N>& system = *island.system;
  const std::uint32_t rows = 3 * system.block_count();
  int exponent = -128;
  const auto see = [&](Value value, int of_row) {
    const int own = System::exponent(value) + of_row;
    if (exponent < own) exponent = own;
  };
  for (std::uint32_t r = 0; r < rows; ++r) {
    const IslandRow<N>& row = system.row(r);
    if (row.bound != RowBound::absent) see(System::value(island.asked[r]), D::kGain - row.exponent);
  }
  const auto motor = [&](std::size_t k, const auto& act) {
    const JointConstraint<S>& joint = joints_[island.joints[k]];
    for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
      const JointDrive<S>& drive = joint.drives[i];
      if (!drive.driven && !drive.servo) continue;
      const std::uint32_t r = 3 * (island.joint_blocks[k] + joint.block_count + i) + detail::kMotorRow;
      act(r, answer_of(island, r, most_impulse(drive)));
    }
  };
  for (std::size_t k = 0; k < island.joints.size(); ++k) {
    motor(k, [&](std::uint32_t r, Value most) { see(most, system.row(r).exponent + 5 * D::kRoom); });
  }
  system.rescale(island.exponent - exponent);
  island.exponent = exponent;
  for (std::uint32_t r = 0; r < rows; ++r) {
    IslandRow<N>& row = system.row(r);
    row.right = N(0);
    if (row.bound != RowBound::absent) {
      row.right = System::number(System::value(island.asked[r]), exponent + row.exponent);
    }
  }
  for (std::size_t k = 0; k < island.joints.size(); ++k) {
    motor(k, [&](std::uint32_t r, Value most) {
      system.row(r).limit = System::number(most, exponent - system.row(r).exponent);
    });
  }
}

template <class S> void IslandSolver<S>::solve(const StepContext<S>& context, Island& island, Pass pass) {
  IslandSystem<N>& system = *island.system;
  for (std::size_t k = 0; k < island.joints.size(); ++k) {
    ask_joint(joints_[island.joints[k]], island, island.joint_blocks[k], pass);
  }
  for (std::uint32_t k = 0; k < island.contacts.size(); ++k) ask_contact(context, island, k, pass);
  scale_right_sides(island);
  if (!island.begun) {
    for (std::size_t k = 0; k < island.joints.size(); ++k) {
      guess_joint(joints_[island.joints[k]], island, island.joint_blocks[k]);
    }
    for (std::uint32_t k = 0; k < island.contacts.size(); ++k) guess_contact(context, island, k);
    island.begun = true;
  }
  system.settle();
  const bool firm = pass != Pass::biased;  // what yields in positions is closed, in velocities it would stay
  const std::uint64_t even = island.work_left / island.solves_left--;
  const std::uint64_t kept = min(island.work_left, island.system.least_work() * island.solves_left);
  const bool solved = island.system.solve(firm, system.is_swept() ? even : island.work_left - kept);
  island.work_left -= min(island.work_left, system.work());
  island.unsolved = island.unsolved || !solved;
  apply(island);
}

/// Sets velocities: the free ones plus what the answers give.
template <class S> void IslandSolver<S>::apply(const Island& island) {
  for (std::uint32_t i = 0; i < island.bodies.size(); ++i) {
    const std::uint32_t row = island.bodies[i];
    bodies_.rows().velocity[row] = with_answers(island, i, free_velocity_[row]);
  }
}

/// Returns velocities of a body of the island, with what the answers give to it.
template <class S>
MotionRow<Velocity<S>> IslandSolver<S>::with_answers(const Island& island, std::uint32_t body,
                                                     const MotionRow<V>& free) const {
  const IslandMotion<N>& u = island.system->motion(body + 1);
  const BodyRoot& root = roots_[island.bodies[body]];
  const int exponent = island.exponent + root.root_exponent;
  MotionRow<V> v = free;
  const auto add = [](V old, N change, int e) { return System::add(old, System::value(change, e)); };
  v.linear = {add(free.linear.x, root.root * u.linear.x, exponent),
              add(free.linear.y, root.root * u.linear.y, exponent),
              add(free.linear.z, root.root * u.linear.z, exponent)};
  const Mat3<N>& t = root.turn;
  const N x = t.rows[0].x * u.angular.x, y = t.rows[1].x * u.angular.x + t.rows[1].y * u.angular.y,
          z = t.rows[2].x * u.angular.x + t.rows[2].y * u.angular.y + t.rows[2].z * u.angular.z;
  const int turning = exponent + root.turn_exponent;
  v.angular = {add(free.angular.x, root.root * x, turning), add(free.angular.y, root.root * y, turning),
               add(free.angular.z, root.root * z, turning)};
  return v;
}

template <class S> std::uint32_t IslandSolver<S>::unsolved() const {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < island_count_; ++i) count += islands_[i].unsolved ? 1u : 0u;
  return count;
}

/// Solves again until joints that are taken implicitly are on the right pieces.
template <class S> void IslandSolver<S>::solve_tight(const StepContext<S>& context, Island& island) {
  solve(context, island, Pass::biased);
  for (int again = 0; again < detail::kMostPieceChanges && tighten(island); ++again) {
    ++island.solves_left;  // beside those that the step's work is divided among
    solve(context, island, Pass::biased);
  }
}
/// Runs `act` on velocities of bodies that mechanisms push, and adds its change of them to the free velocities.
template <class S>
template <class Act>
void IslandSolver<S>::move_freely(const StepContext<S>& context, const Act& act) {
  std::vector<MotionRow<V>>& velocity = bodies_.rows().velocity;
  const auto add = [&](std::uint32_t row, bool before) {
    MotionRow<V>&free = free_velocity_[row], &now = velocity[row];
    free.linear = before ? saturating_subtract(free.linear, now.linear) : saturating_add(free.linear, now.linear);
    free.angular = before ? saturating_subtract(free.angular, now.angular) : saturating_add(free.angular, now.angular);
  };
  for (const std::uint32_t row : context.mechanisms.bodies) add(row, true);
  act();
  for (const std::uint32_t row : context.mechanisms.bodies) add(row, false);
}
/// Solves mechanisms in turn with the islands that they push. The first sweep of both is already done.
template <class S> void IslandSolver<S>::solve_mechanisms(const StepContext<S>& context) {
  if (!context.mechanisms.any()) return;
  for (int sweep = 1; sweep < kMechanismSweeps; ++sweep) {
    move_freely(context, [&] { context.mechanisms.solve(bodies_.rows(), 1); });
    for (std::uint32_t i = 0; i < island_count_; ++i) {
      if (!islands_[i].pushed) continue;
      ++islands_[i].solves_left;
      solve_tight(context, islands_[i]);
    }
  }
  if (context.mechanisms.couples) move_freely(context, [&] { context.mechanisms.close(bodies_.rows()); });
}
template <class S> void IslandSolver<S>::begin_mechanisms(const StepContext<S>& context) {
  if (!context.mechanisms.any()) return;
  context.mechanisms.place(bodies_.rows(), rate_);
  context.mechanisms.solve(bodies_.rows(), 1);
}
template <class S> void IslandSolver<S>::relax_mechanisms(const StepContext<S>& context) {
  if (context.mechanisms.any()) move_freely(context, [&] { context.mechanisms.relax(bodies_.rows()); });
}

template <class S> void IslandSolver<S>::keep(const StepContext<S>& context, Island& island) {
  for (std::size_t k = 0; k < island.joints.size(); ++k) {
    keep_joint(joints_[island.joints[k]], island, island.joint_blocks[k]);
  }
  for (std::uint32_t k = 0; k < island.contacts.size(); ++k) keep_contact(context, island, k);
}

template <class S> void IslandSolver<S>::solve_substeps(const StepContext<S>& context) {
  const std::size_t count = bodies_.count();
  for (std::int32_t substep = 0; substep < context.substeps; ++substep) {
    bodies_.renew_forces(context);
    if (impacts_.any()) impacts_.bounce(context, bodies_);
    bodies_.integrate_velocities(context, 0, count);
    for (const Carried<S>& carried : context.carried) {
      Block& block = block_of(context, carried.contact);
      set_surface<S>(reinterpret_cast<unsigned char*>(&block), 1, carried.surface(bodies_.rows()));
      if (carried.spins()) set_spin<S>(reinterpret_cast<unsigned char*>(&block), 1, carried.spin);
    }
    begin_mechanisms(context);
    free_velocity_ = bodies_.rows().velocity;
    for (std::uint32_t i = 0; i < island_count_; ++i) {
      place_rows(context, islands_[i]);
      solve_tight(context, islands_[i]);
    }
    solve_mechanisms(context);
    const bool any_followed = bodies_.integrate_positions(context, 0, count);
    for (std::uint32_t i = 0; any_followed && i < island_count_; ++i) follow(context, islands_[i]);
    relax_mechanisms(context);
    for (std::uint32_t i = 0; i < island_count_; ++i) {
      solve(context, islands_[i], Pass::relaxed);
      keep(context, islands_[i]);
    }
    if (context.mechanisms.any()) context.mechanisms.end();
    joints_.add_impulses(context);
  }
}

template <class S> void IslandSolver<S>::store_impulses(const StepContext<S>& context) {
  const ContactKernels<S>& kernels = *contact_kernels<S>(Simd::scalar);
  for (std::uint32_t c = 0; c < context.contacts.size(); ++c) {
    Block& block = block_of(context, c);
    const std::uint32_t points = context.contacts[c].count;
    for (std::uint32_t p = 0; p < points; ++p) {
      block.normals[p].total_impulse[0] -= block.normals[p].row.impulse[0];  // the kernel adds the last
    }
    kernels.store({memory_[c].bytes, 1, static_cast<std::int32_t>(points), rolls(context, c), &order_[c],
                   context.contacts.data(), context.step_impulses.data()});
  }
  impacts_.store(context);
  bodies_.store(context, 0, bodies_.count());
  bodies_.hold_energy(context);
  joints_.store(context);
}

}  // namespace isostep
