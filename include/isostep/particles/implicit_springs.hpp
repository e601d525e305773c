// ImplicitSprings: implicit Euler for networks of springs, stable at any stiffness, by one sparse system a step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/math/sparse_cholesky.hpp"
#include "isostep/particles/axes.hpp"
#include "isostep/particles/spring.hpp"
#include "isostep/scalar/linear_system.hpp"

namespace isostep {

/// Source:  Baraff, Witkin 1998, Large Steps in Cloth Simulation, SIGGRAPH, eq. 6:
///          (M - h D - h^2 K) dv = h (f + h K v), K = df/dx, D = df/dv at the positions given.
///          Choi, Ko 2002, Stable but Responsive Cloth, SIGGRAPH, sec. 4: what a spring under pressure would push its
///          ends aside, the negative part of K, is left out, so the matrix is positive definite whatever the state.
/// Differs: a direct solve, not conjugate gradients: no tolerance, no count of iterations. Damping acts along the
///          spring; its derivative by position is left out, as it is in both papers' practice.
/// Symbols: h = 1 / rate; along the spring n, length l: -K = k (n n^T + s (1 - n n^T)), s = max(0, 1 - rest / l),
///          -D = c n n^T. d_i = m_i + sum (h^2 k + h c) over the springs of i, rounded up to a power 4^e_i: rows and
///          columns are divided by 2^e_i, so that entries are shares of one and the answer is 2^e_i dv_i.
/// Covers:  springs, and bungees while they pull, between particles, pinned ones, and anchors. `stiff` springs have
///          their exact motion in the force itself and are no part of the system.
/// Cost:    unknowns are the particles that a spring can move; the rest get h a. The order of elimination is found
///          again only when such particles, or who is tied to whom, change; a slack bungee keeps its place.
/// Limits:  fixed point: a mass of at least 2^-40 of its d_i, so k h^2 / m up to 10^12 over the springs of a particle.
///          An acceleration that S cannot hold has to be clamped by who gives it: the spring then acts as a weaker one
///          with the same resistance, slow but stable.
template <class S> class ImplicitSprings {
 public:
  /// velocity += dv of one (sub-)step of length 1 / rate. `springs` by slot; a free slot has a null id in `a`.
  /// `acceleration` [m/s^2]: of all forces at `position`, springs included. Pinned particles keep their velocity.
  /// False: the system could not be solved (not finite, or beyond the limits), and every velocity got h a instead.
  bool solve(const std::vector<Spring<S>>& springs, const Axes<S>& position, Axes<Velocity<S>>& velocity,
             const Axes<S>& acceleration, const std::vector<InverseMass<S>>& inverse_mass, std::int32_t rate);

 private:
  using System = LinearSystem<S>;
  using Number = typename System::Number;
  using Value = typename System::Value;

  /// A spring that can move something: which unknowns are its ends, kNoParticle for one that keeps its place.
  struct Edge {
    std::uint32_t spring, a, b;
  };
  /// A spring's direction and coefficients in this sub-step.
  struct Tension {
    Vec3<Number> n;      // [1] towards a
    Number across;       // [1] s
    Value stiff, whole;  // [kg] h^2 k, h^2 k + h c; 0 where it is slack or has no direction
  };

  bool solve_system(const std::vector<Spring<S>>& springs, const Axes<S>& position, Axes<Velocity<S>>& velocity,
                    const Axes<S>& acceleration, const std::vector<InverseMass<S>>& inverse_mass, std::int32_t rate);
  void list_unknowns(const std::vector<Spring<S>>& springs, const std::vector<InverseMass<S>>& inverse_mass);
  void analyse();
  void weigh(const std::vector<Spring<S>>& springs, const Axes<S>& position,
             const std::vector<InverseMass<S>>& inverse_mass, std::int32_t rate);
  Tension tension_of(const Spring<S>& spring, const Axes<S>& position, Value rate) const;
  void choose_exponents();
  void fill_matrix();
  int fill_right(const Axes<Velocity<S>>& velocity, const Axes<S>& acceleration, std::int32_t rate);

  static ISO_INLINE Value step_of(S acceleration, Value rate) {
    return System::quotient(System::value(acceleration), rate);
  }

  std::vector<std::uint32_t> unknowns_;   // slots, ascending
  std::vector<std::uint32_t> number_of_;  // of each slot, among the unknowns
  std::vector<Edge> edges_;               // by spring's slot
  std::vector<std::uint32_t> pair_of_;    // of each edge, in the system; kNoParticle: an end is fixed
  std::vector<typename SparseCholesky<Number>::Pair> pairs_;
  SparseCholesky<Number> system_;
  std::vector<Tension> tensions_;     // of each edge
  std::vector<Value> mass_, weight_;  // [kg] m_i, d_i
  std::vector<int> exponent_;         // e_i
  int top_exponent_ = 0;              // of all e_i
  int loss_ = 0;                      // the system's eigenvalues are at least 2^-loss
  std::vector<Vec3<Value>> push_;     // [m/s] h a of each unknown
  std::vector<Vec3<Number>> right_, answer_;
};

#define ISO_IMPLICIT_SPRINGS_OF(extern, S) extern template class ImplicitSprings<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_IMPLICIT_SPRINGS_OF)

}  // namespace isostep
