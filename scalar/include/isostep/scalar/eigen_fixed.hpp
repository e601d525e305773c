// Jacobi's rotations for Eigen's JacobiSVD and SelfAdjointEigenSolver over fixed point, where Eigen's own overflow.
// SPDX-License-Identifier: MIT
#pragma once

// This is included by eigen.hpp. Neither solver's header is needed here: these specialise templates that they declare
// again.

#include <Eigen/Core>
#include <Eigen/Jacobi>
#include <utility>

#include "isostep/scalar/fixed.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep::detail {

/// Returns the rotation whose cosine and sine are the direction of (x, y). No square or cotangent leaves the format.
template <class S> ISO_INLINE Eigen::JacobiRotation<S> rotation_along(S x, S y) {
  const Direction<S> d = direction_of(x, y, S(0));
  return {convert<S>(d.x), convert<S>(d.y)};
}
/// Returns J that makes J* [x y; y z] J diagonal, and turns by at most 45 degrees.
/// Source: Golub, Van Loan 2013, Matrix Computations, sec. 8.5.2. Differs: tan = y / (|h| + sqrt(h^2 + y^2)) with
///         h = (x - z) / 2, which divides nothing.
template <class S> ISO_INLINE Eigen::JacobiRotation<S> diagonalising(S x, S y, S z) {
  if (y == S(0)) return {S(1), S(0)};
  const S h = (x - z) * S::from_raw(typename S::Raw{1} << (S::kFracBits - 1));
  const S length = direction_of(h, y, S(0)).length;
  return rotation_along(abs(h) + length, (h > S(0)) == (y > S(0)) ? -abs(y) : abs(y));
}

}  // namespace isostep::detail

namespace Eigen {
namespace internal {

/// One step of JacobiSVD: both rotations that make the block of rows and columns p and q diagonal.
/// Eigen's own step squares a cotangent that grows without bound as the block becomes diagonal; in fixed point it never
/// ends. This is the hook that Eigen calls just before it; `false` says that the block is done.
template <class MatrixType, int QRPreconditioner, bool IsComplex> struct svd_precondition_2x2_block_to_be_real;

template <class Rep, int F, isostep::Overflow P, int R, int C, int O, int MR, int MC, int QRPreconditioner>
struct svd_precondition_2x2_block_to_be_real<Matrix<isostep::Fixed<Rep, F, P>, R, C, O, MR, MC>, QRPreconditioner,
                                             false> {
  using S = isostep::Fixed<Rep, F, P>;

  template <class Work, class Svd> static ISO_INLINE bool run(Work& work, Svd& svd, Index p, Index q, S& largest) {
    const S zero(0);
    const S t = work.coeff(p, p) + work.coeff(q, q), d = work.coeff(q, p) - work.coeff(p, q);
    JacobiRotation<S> left(S(1), zero);  // first makes the block symmetric
    if (d != zero) left = isostep::detail::rotation_along(d < zero ? -t : t, isostep::abs(d));
    const S m00 = left.c() * work.coeff(p, p) + left.s() * work.coeff(q, p);
    const S m01 = left.c() * work.coeff(p, q) + left.s() * work.coeff(q, q);
    const S m11 = left.c() * work.coeff(q, q) - left.s() * work.coeff(p, q);
    const JacobiRotation<S> right = isostep::detail::diagonalising(m00, m01, m11);
    left = left * right.transpose();
    work.applyOnTheLeft(p, q, left);
    if (svd.computeU()) svd.m_matrixU.applyOnTheRight(p, q, left.transpose());
    work.applyOnTheRight(p, q, right);
    if (svd.computeV()) svd.m_matrixV.applyOnTheRight(p, q, right);
    work.coeffRef(p, q) = work.coeffRef(q, p) = zero;  // but for rounding, which must not start another sweep
    largest = isostep::max(largest, isostep::max(isostep::abs(work.coeff(p, p)), isostep::abs(work.coeff(q, q))));
    return false;
  }
};

}  // namespace internal

/// Eigenvalues, ascending, and eigenvectors of a symmetric matrix whose lower half is given, by cyclic Jacobi
/// rotations.
/// Eigen's tridiagonal QR iteration squares numbers divided by epsilon, which wraps, and then takes a matrix for
/// diagonal that is not. Both `compute` and `computeDirect` are this one.
/// Error:  a few raw units times the largest entry; measured in tests/unit/scalar/eigen_test.cpp.
template <class MatrixType> class SelfAdjointEigenSolver;

template <class Rep, int F, isostep::Overflow P, int R, int C, int O, int MR, int MC>
class SelfAdjointEigenSolver<Matrix<isostep::Fixed<Rep, F, P>, R, C, O, MR, MC>> {
 public:
  using Scalar = isostep::Fixed<Rep, F, P>;
  using RealScalar = Scalar;
  using MatrixType = Matrix<Scalar, R, C, O, MR, MC>;
  using EigenvectorsType = MatrixType;
  using RealVectorType = Matrix<Scalar, R, 1, 0, MR, 1>;
  static constexpr int kSweeps = 30;  // convergence is quadratic: 12 rows take 8

  SelfAdjointEigenSolver() = default;
  template <class D> explicit SelfAdjointEigenSolver(const EigenBase<D>& m, int options = ComputeEigenvectors) {
    compute(m, options);
  }

  template <class D> SelfAdjointEigenSolver& computeDirect(const EigenBase<D>& m, int options = ComputeEigenvectors) {
    return compute(m, options);
  }
  template <class D> SelfAdjointEigenSolver& compute(const EigenBase<D>& m, int = ComputeEigenvectors) {
    MatrixType work = m.derived();
    const Index n = work.rows();
    work.template triangularView<StrictlyUpper>() = work.transpose();
    Scalar scale = work.cwiseAbs().maxCoeff();
    if (scale == Scalar(0)) scale = Scalar(1);
    work /= scale;  // entries up to one keep all their bits and leave room for sums
    eivec_.setIdentity(n, n);
    info_ = NoConvergence;
    for (int sweep = 0; sweep < kSweeps && info_ != Success; ++sweep) {
      if (!sweep_changes(work)) info_ = Success;
    }
    eivalues_ = work.diagonal() * scale;
    for (Index i = 0; i < n; ++i) {
      Index smallest;
      eivalues_.tail(n - i).minCoeff(&smallest);
      if (smallest == 0) continue;
      std::swap(eivalues_[i], eivalues_[i + smallest]);
      eivec_.col(i).swap(eivec_.col(i + smallest));
    }
    return *this;
  }

  const RealVectorType& eigenvalues() const { return eivalues_; }
  const EigenvectorsType& eigenvectors() const { return eivec_; }
  ComputationInfo info() const { return info_; }

 private:
  bool sweep_changes(MatrixType& work) {
    bool changed = false;
    for (Index p = 1; p < work.rows(); ++p) {
      for (Index q = 0; q < p; ++q) {
        if (!(NumTraits<Scalar>::epsilon() < isostep::abs(work.coeff(p, q)))) continue;
        changed = true;
        const JacobiRotation<Scalar> turn =
            isostep::detail::diagonalising(work.coeff(p, p), work.coeff(p, q), work.coeff(q, q));
        work.applyOnTheRight(p, q, turn);
        work.applyOnTheLeft(p, q, turn.adjoint());
        work.coeffRef(p, q) = work.coeffRef(q, p) = Scalar(0);
        eivec_.applyOnTheRight(p, q, turn);
      }
    }
    return changed;
  }

  MatrixType eivec_;
  RealVectorType eivalues_;
  ComputationInfo info_ = InvalidInput;
};

}  // namespace Eigen
