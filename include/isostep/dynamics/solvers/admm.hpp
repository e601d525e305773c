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
/// Limits:  kIterations; it reports islands that do not come within kTolerance of what is asked. Islands of more than
///          kMostBodies, and those with so many neighbours that a factorisation takes more than a solve may, are swept.
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
  static constexpr N kTolerance = N(0x1p-10);        // [1] of the most that any row asks for
  static constexpr std::uint32_t kMostBodies = 400;  // a wall of 210 takes 80 ms a step
  static constexpr int kSweeps = 16;

  void tie(std::uint32_t body_count, std::uint64_t most_work);
  void assemble();
  bool solve(bool firm, std::uint64_t most_work);
  std::uint64_t least_work() const { return elimination_work() + kIterations * iteration_work(); }

 private:
  using Pair = typename SparseCholesky<N>::Pair;
  using Base::block_count, Base::clamped, Base::too_large_;
  using Base::blocks_, Base::motions_, Base::patches_;

  ISO_INLINE bool is_tied_by(std::uint32_t block) const {
    const auto& body = blocks_[block].body;
    return body[0] != 0 && body[1] != 0;
  }
  /// Blocks of one constraint follow each other: they share its pairs.
  ISO_INLINE bool continues(std::uint32_t block) const {
    return block != 0 && blocks_[block].body[0] == blocks_[block - 1].body[0] &&
           blocks_[block].body[1] == blocks_[block - 1].body[1];
  }
  ISO_INLINE std::uint64_t iteration_work() const { return 2 * pairs_.size() + block_count(); }
  /// Returns about how many products of blocks a factorisation takes: exactly, if every body meets every other.
  ISO_INLINE std::uint64_t elimination_work() const {
    const std::uint64_t pairs = pairs_.size(), vectors = 2 * motions_.size();
    return pairs * pairs / vectors + vectors;
  }
  bool factorise();
  bool solve_all();
  void project();
  void begin_multipliers();
  bool is_solved();

  SparseCholesky<N> cholesky_;
  std::vector<Pair> pairs_;
  int scale_ = 0;  // A is factorised times 2^-scale
  bool is_factored_ = false;
  std::vector<N> x_, v_, p_;  // of each row
  std::vector<Vec3<N>> right_, motion_;
  N change_ = N(0), gap_ = N(0);
};

}  // namespace isostep
