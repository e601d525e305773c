// IslandSolver: contacts as rows, in the numbers that the contact kernels prepare and store.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/island_solver.hpp"

namespace isostep {

namespace detail {
/// [1] The part of an overlap that a sub-step closes, at most at kPushSpeed.
template <class S> inline constexpr S kIslandContactShare = S(0.25);
}  // namespace detail

template <class S> void IslandSolver<S>::place_contact(const StepContext<S>& context, Island& island, std::uint32_t k) {
  const std::uint32_t c = island.contacts[k];
  const Block& block = block_of(context, c);
  IslandPatch<N>& patch = island.system->patches()[k];
  const auto vector = [](const S(&v)[3][1]) ISO_INLINE_LAMBDA -> Vec3<S> { return {v[0][0], v[1][0], v[2][0]}; };
  const auto put = [&](std::uint32_t r, const S(*direction)[3][1], const AngularRow<S, 1>& row, RowBound bound) {
    const Vec3<S> linear = direction != nullptr ? vector(*direction) : Vec3<S>::zero();
    island.shapes[r] = {linear, vector(row.jacobian_a), vector(row.jacobian_b)};
    island.system->row(r).bound = row.effective_mass[0] > S(0) ? bound : RowBound::absent;
  };
  const std::uint32_t count = 3 * (1 + (patch.points + 2) / 3);
  for (std::uint32_t r = patch.first; r < patch.first + count; ++r) island.system->row(r).bound = RowBound::absent;
  for (std::uint32_t t = 0; t < 2; ++t) {
    put(patch.first + t, &block.tangents[t].direction, block.tangents[t].row, RowBound::boxed);
  }
  put(patch.first + 2, nullptr, block.twist, RowBound::boxed);
  for (std::uint32_t p = 0; p < patch.points; ++p) {
    put(patch.normal + p, &block.normal, block.normals[p].row, RowBound::above);
  }
  place(island, patch.first, count, -512);
  const auto factor = [](S ratio, int& exponent) {
    const Value value = System::value(ratio);
    exponent = System::exponent(value);
    return System::number(value, exponent);
  };
  patch.friction = factor(block.friction[0], patch.friction_exponent);
  patch.ratio = System::number(System::value(block.ratio[0]), 0);
  patch.twist_friction = factor(block.twist_friction[0], patch.twist_exponent);
  if (patch.rolling == IslandPatch<N>::kNoRolling) return;
  const auto& rolling = *reinterpret_cast<const RollingRows<S, 1>*>(memory_[c].bytes);
  for (std::uint32_t r = 0; r < 2; ++r) put(patch.rolling + r, nullptr, rolling.rows[r], RowBound::boxed);
  island.system->row(patch.rolling + 2).bound = RowBound::absent;
  place(island, patch.rolling, 3, island.system->row(patch.first).exponent);
  patch.lever = factor(rolling.lever[0], patch.lever_exponent);
  patch.lever_exponent += island.system->row(patch.rolling).exponent - island.system->row(patch.first).exponent;
}

template <class S>
void IslandSolver<S>::ask_contact(const StepContext<S>& context, Island& island, std::uint32_t k, Pass pass) {
  const Block& block = block_of(context, island.contacts[k]);
  const IslandPatch<N>& patch = island.system->patches()[k];
  const S rate = S(rate_);
  const V farthest = divide_to<V>(S(64), rate);  // what lies farther away is not met within the sub-step
  const auto ask = [&](std::uint32_t r, V wanted) { island.asked[r] = wanted - speed_of(island, r, free_velocity_); };
  for (std::uint32_t t = 0; t < 2; ++t) ask(patch.first + t, -block.tangents[t].surface[0]);
  ask(patch.first + 2, -block.spin[0]);
  if (patch.rolling != IslandPatch<N>::kNoRolling) {
    for (std::uint32_t r = 0; r < 2; ++r) ask(patch.rolling + r, V(0));
  }
  for (std::uint32_t p = 0; p < patch.points; ++p) {
    const std::uint32_t r = patch.normal + p;
    const NormalRow<S, 1>& row = block.normals[p];
    const V separation = row.separation[0] + speed_of(island, r, bodies_.rows().displacement);
    V wanted = V(0);
    // A gap that is still open pushes nothing in a relaxed pass: the next sub-step closes it, and may see it bounce.
    const bool opens = pass == Pass::relaxed && separation > V(0) && !(impulse_of(island, r) > V(0));
    if (separation > V(0)) wanted = -scaled(rate, opens ? farthest : min(separation, farthest));
    else if (pass == Pass::biased)
      wanted = min(-scaled(detail::kIslandContactShare<S> * rate, max(separation, -farthest)), detail::kPushSpeed<S>);
    ask(r, wanted);
  }
}

/// Guesses states: points that pushed push again, friction at its limit stays there. In a new contact friction holds.
template <class S> void IslandSolver<S>::guess_contact(const StepContext<S>& context, Island& island, std::uint32_t k) {
  Block& block = block_of(context, island.contacts[k]);
  const IslandPatch<N>& patch = island.system->patches()[k];
  IslandSystem<N>& system = *island.system;
  bool fresh = true;
  for (std::uint32_t p = 0; p < patch.points; ++p) {
    const V impulse = block.normals[p].row.impulse[0];
    fresh = fresh && !(impulse > V(0));
    load(island, patch.normal + p, impulse);
    block.normals[p].total_impulse[0] = V(0);
  }
  for (std::uint32_t p = 0; p < patch.points; ++p) {
    const std::uint32_t r = patch.normal + p;
    const bool pushes = fresh ? island.asked[r] > V(0) : block.normals[p].row.impulse[0] > V(0);
    system.row(r).state = pushes ? RowState::free : RowState::at_low;
  }
  for (std::uint32_t t = 0; t < 2; ++t) load(island, patch.first + t, block.tangents[t].row.impulse[0]);
  load(island, patch.first + 2, block.twist.impulse[0]);
  system.guess_friction(k, fresh);
}

template <class S> void IslandSolver<S>::keep_contact(const StepContext<S>& context, Island& island, std::uint32_t k) {
  Block& block = block_of(context, island.contacts[k]);
  const IslandPatch<N>& patch = island.system->patches()[k];
  for (std::uint32_t p = 0; p < patch.points; ++p) {
    const V impulse = impulse_of(island, patch.normal + p);
    NormalRow<S, 1>& row = block.normals[p];
    row.total_impulse[0] = saturating_add(row.total_impulse[0], impulse);
    row.row.impulse[0] = impulse;
  }
  for (std::uint32_t t = 0; t < 2; ++t) block.tangents[t].row.impulse[0] = impulse_of(island, patch.first + t);
  block.twist.impulse[0] = impulse_of(island, patch.first + 2);
}

}  // namespace isostep
