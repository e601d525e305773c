// Sparse systems: against elimination in double, at the condition where fixed point has to refine, and in any order.
// SPDX-License-Identifier: MIT
#include "isostep/math/sparse_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

namespace isostep {
namespace sparse_cholesky_test {

template <class S> class SparseCholeskyOf : public testing::Test {
 public:
  using Number = typename LinearSystem<S>::Number;

 protected:
  using Pair = typename SparseCholesky<Number>::Pair;

  static Number number(double x) {
    if constexpr (kIsFixed<S>) return from_double<Number>(x);
    if constexpr (!kIsFixed<S>) return Number(x);
  }
  static SymmetricBlock<Number> diagonal(double x) {
    return {number(x), number(0), number(0), number(x), number(0), number(x)};
  }
  /// A loop of n vectors, each tied to the next with weight 1/4; `ground` keeps it from being singular.
  void loop(std::uint32_t n, double ground, bool backwards = false) {
    n_ = n;
    ground_ = ground;
    std::vector<Pair> pairs;
    for (std::uint32_t i = 0; i < n; ++i) pairs.push_back({i, (i + 1) % n});
    if (backwards) std::reverse(pairs.begin(), pairs.end());
    cholesky_.analyse(n, pairs);
    for (std::uint32_t i = 0; i < n; ++i) cholesky_.add_diagonal(i, diagonal(0.5 + ground));
    for (std::uint32_t i = 0; i < n; ++i) cholesky_.add_pair(i, diagonal(-0.25));
  }
  /// Expects a wave along the loop to be an eigenvector, with eigenvalue ground + (1 - cos) / 2.
  void expect_wave(int waves) {
    std::vector<Vec3<Number>> b, x;
    const double turn = 2 * std::acos(-1.0) * waves / n_;
    for (std::uint32_t i = 0; i < n_; ++i) {
      b.push_back({number(std::cos(turn * i)), number(0), number(-0.5 * std::sin(turn * i))});
    }
    int exponent = 0;
    const int loss = static_cast<int>(std::ceil(-std::log2(ground_)));
    ASSERT_TRUE(cholesky_.solve(b, 3, loss, x, exponent));
    const double eigenvalue = ground_ + (1 - std::cos(turn)) / 2;
    for (std::uint32_t i = 0; i < n_; ++i) {
      const double scale = kIsFixed<S> ? std::ldexp(1, exponent - 3) : 1;
      EXPECT_NEAR(scale * eigenvalue * to_double(x[i].x), to_double(b[i].x), 2e-13 / ground_ + 1e-12) << i;
      EXPECT_NEAR(scale * eigenvalue * to_double(x[i].z), to_double(b[i].z), 2e-13 / ground_ + 1e-12) << i;
      EXPECT_EQ(to_double(x[i].y), 0);
    }
  }

  std::uint32_t n_ = 0;
  double ground_ = 0;
  SparseCholesky<Number> cholesky_;
};
using Scalars = testing::Types<double, Q32_32>;
TYPED_TEST_SUITE(SparseCholeskyOf, Scalars);

TYPED_TEST(SparseCholeskyOf, WavesAreDividedByTheirEigenvalues) {
  for (const double ground : {0.25, 0x1p-10, 0x1p-20}) {
    this->loop(60, ground);
    ASSERT_TRUE(this->cholesky_.factorise());
    for (const int waves : {0, 1, 7, 30}) this->expect_wave(waves);
  }
}

TYPED_TEST(SparseCholeskyOf, TheOrderInWhichPairsAreGivenDoesNotMatter) {
  std::vector<Vec3<typename TestFixture::Number>> b(40, {this->number(0.25), this->number(0.5), this->number(-1)}), x,
      y;
  b[3].x = this->number(1);
  b[17].y = this->number(-0.125);
  int first = 0, second = 0;
  this->loop(40, 0.125);
  ASSERT_TRUE(this->cholesky_.factorise());
  ASSERT_TRUE(this->cholesky_.solve(b, 0, 3, x, first));
  this->loop(40, 0.125, true);
  ASSERT_TRUE(this->cholesky_.factorise());
  ASSERT_TRUE(this->cholesky_.solve(b, 0, 3, y, second));
  EXPECT_EQ(first, second);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(x[i], y[i]) << i;
}

TYPED_TEST(SparseCholeskyOf, AMatrixThatIsNotPositiveDefiniteIsRefused) {
  this->loop(10, 0.25);
  this->cholesky_.add_diagonal(4, this->diagonal(-0.75));
  EXPECT_FALSE(this->cholesky_.factorise());
  this->cholesky_.clear();
  EXPECT_FALSE(this->cholesky_.factorise());
}

/// Three vectors in a ring with blocks that are not symmetric, and some components held; against dense elimination.
TYPED_TEST(SparseCholeskyOf, GeneralBlocksAndHeldUnknownsAgreeWithEigen) {
  using N = typename TestFixture::Number;
  std::mt19937 random(5);
  const auto draw = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(9, 9);
    this->cholesky_.analyse(3, {{0, 1}, {2, 1}, {2, 0}});
    const int pairs[3][2] = {{0, 1}, {2, 1}, {2, 0}};
    for (std::uint32_t i = 0; i < 3; ++i) {
      this->cholesky_.add_diagonal(i, this->diagonal(0.875));
      for (int c = 0; c < 3; ++c) a(static_cast<int>(3 * i) + c, static_cast<int>(3 * i) + c) = 0.875;
      GeneralBlock<N> block;
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
          const double entry = 0.125 * draw();
          block.rows[r][c] = this->number(entry);
          a(3 * pairs[i][0] + r, 3 * pairs[i][1] + c) = a(3 * pairs[i][1] + c, 3 * pairs[i][0] + r) = entry;
        }
      }
      this->cholesky_.add_pair(i, block);
    }
    std::vector<std::uint8_t> held(3);
    std::vector<Vec3<N>> b(3), x;
    Eigen::VectorXd right(9);
    for (std::uint32_t i = 0; i < 3; ++i) {
      held[i] = trial == 0 ? 0 : static_cast<std::uint8_t>(random() % 8);
      for (int c = 0; c < 3; ++c) {
        const int row = static_cast<int>(3 * i) + c;
        const bool out = (held[i] >> c & 1) != 0;
        right[row] = out ? 0 : draw();
        b[i][c] = this->number(right[row]);
        if (!out) continue;
        a.row(row).setZero();
        a.col(row).setZero();
        a(row, row) = 1;
      }
    }
    ASSERT_TRUE(this->cholesky_.factorise(held));
    int exponent = 0;
    ASSERT_TRUE(this->cholesky_.solve(b, 0, 4, x, exponent));
    const Eigen::VectorXd wanted = a.ldlt().solve(right);
    for (int row = 0; row < 9; ++row) {
      const double scale = kIsFixed<TypeParam> ? std::ldexp(1, exponent) : 1;
      EXPECT_NEAR(scale * to_double(x[static_cast<std::size_t>(row / 3)][row % 3]), wanted[row], 1e-12) << trial;
    }
  }
}

TYPED_TEST(SparseCholeskyOf, ACopyHasYetToBeAnalysed) {
  this->loop(10, 0.25);
  EXPECT_TRUE(this->cholesky_.is_analysed());
  SparseCholesky<typename TestFixture::Number> copy(this->cholesky_);
  EXPECT_FALSE(copy.is_analysed());
  copy = std::move(this->cholesky_);
  EXPECT_TRUE(copy.is_analysed());
  EXPECT_FALSE(this->cholesky_.is_analysed());
}

}  // namespace sparse_cholesky_test
}  // namespace isostep
