// SparseCholesky<N>: large symmetric positive definite systems of 3 x 3 blocks, factorised by Eigen behind this wall.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "isostep/math/vec3.hpp"
#include "isostep/scalar/linear_system.hpp"

namespace isostep {

/// A symmetric block: what springs, and all that acts alike on both ends, add.
template <class N> struct SymmetricBlock { N xx, xy, xz, yy, yz, zz; };
/// Any block: what constraints add that share a body.
template <class N> struct GeneralBlock { N rows[3][3]; };

/// A x = b, of n unknown vectors, for N = LinearSystem<S>::Number.
/// Source:  the up-looking L L^T of Eigen's SimplicialLLT, vectors ordered by Eigen's approximate minimum degree
///          (Amestoy, Davis, Duff 1996, SIAM J. Matrix Anal. 17(4)). L L^T and not L D L^T: no entry of L exceeds the
///          root of A's largest diagonal entry, so with entries up to one it needs no range of its own.
/// Differs: fixed point solves with a block exponent and refines until the correction is below 2^-44 of the largest
///          unknown, from residuals that are summed exactly.
/// Limits:  fixed point: |A_ij| <= 1, |b_i| < 2, eigenvalues of A within [2^-kMostLoss, 2]; then no intermediate leaves
///          Q2.62. About 2^29 unknowns.
/// Order:   the order of elimination follows from the set of coupled pairs alone, not from the order they are given in.
///          The ordering counts in integers, but for one root of an integer, which IEEE 754 leaves no choice.
/// Memory:  warm, only Eigen's working rows in `factorise` are allocated: a few numbers an unknown.
template <class N> class SparseCholesky {
 public:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  static constexpr int kMostLoss = 44;

  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;
  /// A copy has yet to be analysed: what is remembered is scratch.
  SparseCholesky(const SparseCholesky&);
  SparseCholesky& operator=(const SparseCholesky&);

  bool is_analysed() const;
  /// The pattern: `size` vectors and which of them are coupled, two different ones to a pair; a pair may come again.
  /// A = 0. The pattern of the last call costs a comparison.
  void analyse(std::uint32_t size, const std::vector<Pair>& pairs);
  /// A = 0
  void clear();
  /// Adds to block (i, i).
  void add_diagonal(std::uint32_t i, const SymmetricBlock<N>& block);
  /// Adds to both blocks of a pair, numbered as in `analyse`.
  void add_pair(std::uint32_t pair, const SymmetricBlock<N>& block);
  /// Adds to block (first, second) of a pair, and its transpose to (second, first).
  void add_pair(std::uint32_t pair, const GeneralBlock<N>& block);
  /// Factorises A. Returns false where A is not positive definite.
  bool factorise();
  /// Factorises A with some unknowns held at zero: their rows and columns become the identity's, until A is factorised
  /// again. Bit c of held[i]: component c of vector i. Where one is held, b has to be zero.
  bool factorise(const std::vector<std::uint8_t>& held);
  /// x 2^exponent = A^-1 b 2^b_exponent. `loss`: A's eigenvalues are at least 2^-loss.
  /// False: no convergence, or (floating point) a result that is not finite.
  bool solve(const std::vector<Vec3<N>>& b, int b_exponent, int loss, std::vector<Vec3<N>>& x, int& exponent);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace isostep
