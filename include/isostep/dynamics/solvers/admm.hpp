// AdmmSystem<N>: an island solved by alternating a linear system with the projection onto its bounds.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/dynamics/solvers/island_system.hpp"
#include "isostep/math/sparse_cholesky.hpp"

namespace isostep {

/// Source:  Carpentier, Le Lidec, Montaut 2024, From Compliant to Rigid Contact Simulation: a Unified and Efficient
///          Approach, Robotics: Science and Systems (Simple); Boyd et al. 2011, Distributed Optimization and
///          Statistical Learning via the Alternating Direction Method of Multipliers, sec. 3.3-3.4.
/// Method:  an iteration solves (K + soft + p) x = right + p (z - v) for all rows at once, takes for z what x + v is
///          within its bounds, and adds x - z to v. K has the rank of the bodies: the system is solved for u,
///          (I + sum of w w^T / (p + soft)) u = sum of w b / (p + soft), by a factorisation of the bodies' graph, which
///          is the same for all iterations, and for all sub-steps of an island without joints.
/// Symbols: x = answers, z = answers within bounds, v = scaled multiplier of x = z, p = proximal weight, u = W^T x.
/// Differs: the friction of a patch is projected onto the disc that its load allows, both of the iteration; Simple
///          projects onto cones and shifts them (de Saxce). p is a power of two times the row's own diagonal.
///          Multipliers begin with what the answers of the last solve leave.
/// Limits:  kIterations; it reports islands that do not come within kTolerance of what is asked.
/// Order:   of rows; elimination as SparseCholesky. One thread.
/// Memory:  warm, what SparseCholesky allocates: islands whose bodies meet others are analysed anew.
template <class N> class AdmmSystem final : public IslandSystem<N> {
 public:
  using Base = IslandSystem<N>;
  using typename Base::D;
  static constexpr int kIterations = 40;
  /// Exponents of two. Rows that push or hold converge the faster the smaller their weight is, rows that slide the
  /// larger.
  static constexpr int kWeight = -4, kFrictionWeight = 0, kEquationWeight = -14;
  static constexpr N kTolerance = N(0x1p-10);  // [1] of the most that any row asks for
  static constexpr std::uint32_t kMostBodies = 400;

  void tie(std::uint32_t body_count, std::uint64_t most_work) override;
  void assemble() override;
  bool solve(bool firm, std::uint64_t most_work) override;
  std::uint64_t least_work() const override { return kIterations * this->block_count(); }

 private:
  using Pair = typename SparseCholesky<N>::Pair;
  using Base::at_body_, Base::blocks_, Base::first_, Base::motions_, Base::patches_;
  using Base::block_count, Base::clamped, Base::too_large_;

  bool factorise();
  bool solve_all();
  void project();
  void begin_multipliers();
  bool is_solved();

  SparseCholesky<N> cholesky_;
  std::vector<Pair> pairs_, last_pairs_;
  std::uint32_t last_bodies_ = 0;
  int scale_ = 0;  // A is factorised times 2^-scale
  bool is_factored_ = false;
  std::vector<N> x_, v_, p_;  // of each row
  std::vector<Vec3<N>> right_, motion_;
  N change_ = N(0), gap_ = N(0);
};

}  // namespace isostep
