// Eigen over our scalars: what compiles, gives the answer of Eigen over double within the format's rounding.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/eigen.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace isostep {
namespace eigen_test {

template <class S> constexpr bool kExactly = detail::kIsExactType<S>;

template <class S> S number(double x) {
  if constexpr (kExactly<S>) return S(x);
  if constexpr (!kExactly<S>) return from_double<S>(x);
}
/// The last place of a number near one.
template <class S> double place() { return to_double(std::numeric_limits<S>::epsilon()); }

template <class S> class EigenOver : public testing::Test {
 protected:
  using Column = Eigen::Matrix<S, 3, 1>;
  using Square = Eigen::Matrix<S, 3, 3>;

  double draw() {  // in [-1, 1], of few bits, so that every scalar holds it
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(static_cast<std::int64_t>(state_) >> 54) / 512;
  }
  Column vector(double size) { return {number<S>(size * draw()), number<S>(size * draw()), number<S>(size * draw())}; }
  Square matrix(double size) {
    Square m;
    m << vector(size), vector(size), vector(size);
    return m;
  }
  /// Symmetric, eigenvalues within [2, 6].
  Square stiff() {
    const Square m = matrix(0.5);
    return m + m.transpose() + Square(Column::Constant(S(4)).asDiagonal());
  }
  template <class A, class B> void expect_near(const A& a, const B& b, double places) {
    EXPECT_LE((a.template cast<double>() - b).cwiseAbs().maxCoeff(), places * place<S>()) << a << "\n\n" << b;
  }

 private:
  std::uint64_t state_ = 7;
};
using Numbers = testing::Types<Fixed<std::int64_t, 32>, Q16_16, Exact<float>, Exact<double>>;
TYPED_TEST_SUITE(EigenOver, Numbers);

TYPED_TEST(EigenOver, VectorsAndMatricesCompute) {
  for (int i = 0; i < 100; ++i) {
    const auto a = this->vector(4), b = this->vector(4);
    const auto m = this->matrix(2);
    const Eigen::Vector3d x = a.template cast<double>(), y = b.template cast<double>();
    const Eigen::Matrix3d n = m.template cast<double>();
    EXPECT_NEAR(to_double(a.dot(b)), x.dot(y), 64 * place<TypeParam>());
    EXPECT_NEAR(to_double(a.norm()), x.norm(), 64 * place<TypeParam>());
    this->expect_near(a.cross(b).eval(), x.cross(y).eval(), 64);
    this->expect_near((m * a).eval(), (n * x).eval(), 64);
    this->expect_near((m * m).eval(), (n * n).eval(), 64);
    if (x.norm() > 1) this->expect_near(a.normalized(), x.normalized(), 16);
    EXPECT_EQ(a.cwiseMax(b), b.cwiseMax(a));
    EXPECT_TRUE(a.isApprox(a));
    EXPECT_TRUE(a.allFinite());
  }
}

TYPED_TEST(EigenOver, ConstantsInSourceAreNotCutToIntegers) {
  using S = TypeParam;
  auto v = this->vector(2);
  const Eigen::Vector3d x = v.template cast<double>();
  this->expect_near((v * 0.5).eval(), (x * 0.5).eval(), 1);
  this->expect_near((0.5 * v).eval(), (x * 0.5).eval(), 1);
  this->expect_near((v / 0.5).eval(), (x / 0.5).eval(), 2);
  this->expect_near((v * 2).eval(), (x * 2).eval(), 0);
  this->expect_near((v / 2).eval(), (x / 2).eval(), 1);
  this->expect_near(((v + v) * 0.25).eval(), (x * 0.5).eval(), 1);
  v *= 0.5;
  this->expect_near(v, (x * 0.5).eval(), 1);
  EXPECT_GT(to_double((Eigen::Matrix<S, 3, 1>(S(1), S(1), S(1)) * 0.1).sum()), 0.29);
}

/// Eigen's own question whether m * x may be formed for an x of type T.
template <class S, class T>
concept EigenTakes = requires {
  typename Eigen::internal::promote_scalar_arg<S, T, false>::type;
};
TEST(EigenOverFixed, TakesNoDoubleKnownAtRunTimeOnly) {
  EXPECT_FALSE((EigenTakes<Q16_16, double>)) << "what is left is a Literal, which only the compiler can make";
  EXPECT_FALSE((EigenTakes<Q32_32, float>));
  EXPECT_TRUE((EigenTakes<Q16_16, int>));
  EXPECT_TRUE((EigenTakes<Exact<float>, double>));
}

TYPED_TEST(EigenOver, LinearSystemsAreSolved) {
  for (int i = 0; i < 50; ++i) {
    const auto m = this->stiff();
    const auto b = this->vector(2);
    const Eigen::Matrix3d n = m.template cast<double>();
    const Eigen::Vector3d x = n.inverse() * b.template cast<double>();
    this->expect_near(m.inverse().eval(), n.inverse().eval(), 64);
    this->expect_near(m.ldlt().solve(b).eval(), x, 32);
    this->expect_near(m.partialPivLu().solve(b).eval(), x, 32);
    this->expect_near(m.fullPivLu().solve(b).eval(), x, 32);
    EXPECT_EQ(m.fullPivLu().rank(), 3);
    EXPECT_NEAR(to_double(m.determinant()), n.determinant(), 256 * place<TypeParam>());
  }
}

TYPED_TEST(EigenOver, RankIsSeen) {
  using S = TypeParam;
  const Eigen::Matrix<S, 3, 1> a(S(1), S(2), S(-1)), b(S(0.5), S(1), S(3));
  const Eigen::Matrix<S, 3, 3> m = a * b.transpose();
  EXPECT_EQ(m.fullPivLu().rank(), 1);
  EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixX<S>>(m).kernel().cols(), 2);
}

// A decomposition is told by its definition: orthonormal factors whose product is the matrix, values in order.
TYPED_TEST(EigenOver, SingularValuesAndVectorsAreFound) {
  using Mat = Eigen::Matrix<TypeParam, 3, 3>;
  for (int i = 0; i < 300; ++i) {
    const Mat m = this->matrix(4);
    const Eigen::JacobiSVD<Mat> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d u = svd.matrixU().template cast<double>(), v = svd.matrixV().template cast<double>();
    const Eigen::Vector3d values = svd.singularValues().template cast<double>();
    this->expect_near(m, (u * values.asDiagonal() * v.transpose()).eval(), 128);
    EXPECT_LE((u * u.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 32 * place<TypeParam>());
    EXPECT_LE((v * v.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 32 * place<TypeParam>());
    EXPECT_TRUE(values[0] >= values[1] && values[1] >= values[2] && values[2] >= 0) << values;
  }
}

TYPED_TEST(EigenOver, EigenvaluesAndVectorsAreFound) {
  using Mat = Eigen::Matrix<TypeParam, 3, 3>;
  for (int i = 0; i < 300; ++i) {
    const Mat half = this->matrix(2);
    const Mat m = half + half.transpose();
    const Eigen::SelfAdjointEigenSolver<Mat> solver(m);
    ASSERT_EQ(solver.info(), Eigen::Success);
    const Eigen::Matrix3d v = solver.eigenvectors().template cast<double>();
    const Eigen::Vector3d values = solver.eigenvalues().template cast<double>();
    this->expect_near(m, (v * values.asDiagonal() * v.transpose()).eval(), 128);
    EXPECT_LE((v * v.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 32 * place<TypeParam>());
    EXPECT_TRUE(values[0] <= values[1] && values[1] <= values[2]) << values;
  }
  const Eigen::SelfAdjointEigenSolver<Mat> nothing(Mat::Zero().eval());
  EXPECT_EQ(nothing.eigenvalues(), (Eigen::Matrix<TypeParam, 3, 1>::Zero()));
}

TEST(EigenOverFixed, DecompositionsOfTwelveRowsEnd) {
  using S = Q16_16;
  Eigen::MatrixX<S> m(12, 12);
  for (int r = 0; r < 12; ++r) {
    for (int c = 0; c < 12; ++c) m(r, c) = from_double<S>(std::sin(17 * r + 3 * c) + (r == c ? 0.5 : 0));
  }
  const Eigen::MatrixXd n = m.cast<double>();
  // Sums of squares and of values are kept by rotations: at most 12 sqrt(12) of the greatest error times the norm.
  const double tolerance = 512 * place<S>() * n.norm();
  const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixX<S>>(m).singularValues().cast<double>();
  EXPECT_NEAR(singular.squaredNorm(), n.squaredNorm(), tolerance);
  const Eigen::MatrixX<S> symmetric = m + m.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixX<S>> solver(symmetric);
  ASSERT_EQ(solver.info(), Eigen::Success);
  const Eigen::VectorXd values = solver.eigenvalues().cast<double>();
  EXPECT_NEAR(values.sum(), 2 * n.trace(), tolerance);
  EXPECT_NEAR(values.squaredNorm(), (n + n.transpose()).squaredNorm(), 2 * tolerance);
}

TYPED_TEST(EigenOver, QuaternionsRotate) {
  using S = TypeParam;
  using Quat = Eigen::Quaternion<S>;
  const Eigen::Matrix<S, 3, 1> axis(S(0), S(0.6), S(0.8));
  const Quat q(Eigen::AngleAxis<S>(S(0.7), axis));
  const Eigen::Quaterniond p(Eigen::AngleAxisd(to_double(S(0.7)), axis.template cast<double>()));
  for (int i = 0; i < 50; ++i) {
    const auto v = this->vector(4);
    this->expect_near((q * v).eval(), (p * v.template cast<double>()).eval(), 64);
  }
  this->expect_near(q.toRotationMatrix(), p.toRotationMatrix(), 16);
  this->expect_near((q * q).normalized().coeffs().eval(), (p * p).normalized().coeffs().eval(), 16);
  this->expect_near(Quat(q.toRotationMatrix()).coeffs(), p.coeffs(), 32);
  this->expect_near(q.inverse().coeffs().eval(), p.inverse().coeffs().eval(), 16);
  this->expect_near(Quat::Identity().slerp(S(0.5), q).coeffs().eval(),
                    Eigen::Quaterniond::Identity().slerp(0.5, p).coeffs().eval(), 64);
}

TYPED_TEST(EigenOver, PrintsDecimalsThatReadBack) {
  using S = TypeParam;
  const Eigen::Matrix<S, 1, 3> v(S(0.5), S(-2), S(0.1));
  std::ostringstream out;
  out << v;
  EXPECT_EQ(out.str(), "0.5  -2 0.1");
}

TYPED_TEST(EigenOver, RandomStaysWithinOne) {
  using S = TypeParam;
  using Many = Eigen::Matrix<S, 20, 20>;
  const Eigen::Matrix<double, 20, 20> m = Many::Random().eval().template cast<double>();
  EXPECT_LE(m.cwiseAbs().maxCoeff(), 1);
  EXPECT_LT(m.minCoeff(), -0.8);
  EXPECT_GT(m.maxCoeff(), 0.8);
}

TEST(EigenOverFixed, TrappingFormatsCompileAndStayInRange) {
  using S = Fixed<std::int64_t, 32, Overflow::trap>;  // ends the program at the first wrap
  using Mat = Eigen::Matrix<S, 3, 3>;
  Mat m;
  m << S(4), S(1), S(0.5), S(1), S(3), S(0.25), S(0.5), S(0.25), S(2);
  const Eigen::Matrix<S, 3, 1> b(S(1), S(2), S(3));
  EXPECT_NEAR(to_double(m.ldlt().solve(b).sum()), 1.9441176470588235, 1e-8);  // -5/68 + 97/170 + 123/85
  EXPECT_NEAR(to_double(Eigen::JacobiSVD<Mat>(m).singularValues().sum()), 9, 1e-8);
  EXPECT_NEAR(to_double(Eigen::SelfAdjointEigenSolver<Mat>(m).eigenvalues().sum()), 9, 1e-8);
}

TEST(EigenOverFixed, CastsRoundToNearest) {
  const Eigen::Matrix<Unit<Q32_32>, 2, 1> fine(Unit<Q32_32>(0.3), Unit<Q32_32>(-0.7));
  const auto coarse = fine.cast<Q32_32>().eval();
  EXPECT_EQ(coarse[0], Q32_32(0.3));
  EXPECT_EQ(coarse[1], Q32_32(-0.7));
}

}  // namespace eigen_test
}  // namespace isostep
