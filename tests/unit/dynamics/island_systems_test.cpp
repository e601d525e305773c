// Islands as complementarity problems, by every method: against enumeration of who is at which bound, and where that is
// long by their conditions.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "isostep/dynamics/solvers/admm.hpp"
#include "isostep/dynamics/solvers/avbd.hpp"
#include "isostep/dynamics/solvers/pivoting.hpp"

namespace isostep {
namespace island_systems_test {

constexpr std::uint64_t kWork = 2'000'000;
constexpr double kScale = 0x1p-24;  // of right-hand sides and answers: room for answers of a million in fixed point

template <class N> N number(double x) {
  if constexpr (std::is_same_v<N, Exact<double>>) return N(x);
  else return from_double<N>(x);
}

/// A problem for one method, and the answers that it finds.
template <class Method> class IslandProblem : public testing::Test {
 protected:
  using N = typename Method::D::N;
  double draw() { return static_cast<double>(random_()) / 2147483648.0 - 1; }

  /// Blocks of three rows between two bodies each, which `rank` directions of them can move.
  void build(std::uint32_t blocks, std::uint32_t bodies, int rank) {
    system_.begin();
    const auto count = static_cast<int>(6 * (bodies + 1));
    w_ = Eigen::MatrixXd::Zero(3 * static_cast<int>(blocks), count);
    for (std::uint32_t b = 0; b < blocks; ++b) {
      const std::uint32_t ends[2] = {b % (bodies + 1), (b + 1 + b / (bodies + 1)) % (bodies + 1)};
      system_.add_block(ends[0], ends[1] == ends[0] ? 0 : ends[1]);
      for (std::uint32_t r = 3 * b; r < 3 * b + 3; ++r) {
        for (std::uint32_t e = 0; e < 2; ++e) {
          if (ends[e] == 0 || (e == 1 && ends[1] == ends[0])) continue;
          double parts[6] = {};
          for (int i = 0; i < rank; ++i) parts[i] = draw() * 0.25;
          auto& end = system_.row(r).ends[e];
          end.linear = {number<N>(parts[0]), number<N>(parts[1]), number<N>(parts[2])};
          end.angular = {number<N>(parts[3]), number<N>(parts[4]), number<N>(parts[5])};
          for (int i = 0; i < 6; ++i) w_(static_cast<int>(r), static_cast<int>(6 * ends[e]) + i) = parts[i];
        }
      }
    }
    const auto rows = static_cast<std::size_t>(3 * blocks);
    low_.assign(rows, 0);
    high_.assign(rows, 0);
    right_ = Eigen::VectorXd(3 * static_cast<int>(blocks));
    for (std::uint32_t r = 0; r < rows; ++r) right_[static_cast<int>(r)] = draw();
    bodies_ = bodies;
  }
  void bound(std::uint32_t r, RowBound kind) {
    constexpr double kFar = 1e9;
    IslandRow<N>& row = system_.row(r);
    row.bound = kind;
    row.state = RowState::free;
    row.answer = N(0);
    row.limit = number<N>(0.3 * kScale);
    row.right = number<N>(right_[static_cast<int>(r)] * kScale);
    low_[r] = kind == RowBound::above ? 0 : kind == RowBound::boxed ? -0.3 : -kFar;
    high_[r] = kind == RowBound::below ? 0 : kind == RowBound::boxed ? 0.3 : kFar;
  }
  /// One body on one point, pushed along its tangents x and z; its normal is y. Friction along z: `ratio` of the limit.
  void begin_on_a_point(double x, double z, double ratio = 1) {
    build(1, 1, 0);
    for (std::uint32_t r = 0; r < 3; ++r) {
      system_.row(r).ends[1] = IslandMotion<N>::zero();
      system_.row(r).ends[1].linear[r == 0 ? 0 : r == 1 ? 2 : 1] = number<N>(0.5);
    }
    right_ << x, z, 1;
    bound(0, RowBound::boxed);
    bound(1, RowBound::boxed);
    bound(2, RowBound::above);
    system_.patches().clear();
    system_.patches().push_back(
        {0, 2, 1, IslandPatch<N>::kNoRolling, number<N>(0.5), N(0), N(0), number<N>(ratio), 0, 0, 0});
    system_.tie(bodies_, kWork);
    system_.assemble();
  }
  bool solve() {
    system_.tie(bodies_, kWork);
    system_.assemble();
    return system_.solve(false, kWork);
  }
  double answer(std::uint32_t r) const { return to_double(system_.row(r).answer) / kScale; }
  /// K with what rows yield, as the class says it.
  Eigen::MatrixXd yielding() const {
    Eigen::MatrixXd k = w_ * w_.transpose();
    for (int i = 0; i < k.rows(); ++i) {
      if (low_[static_cast<std::size_t>(i)] > -1e8 || high_[static_cast<std::size_t>(i)] < 1e8) k(i, i) *= 1 + 0x1p-12;
    }
    return k;
  }

  /// Every row free, at its lower or at its upper bound: all combinations, until one answers.
  bool enumerate(const Eigen::MatrixXd& k, Eigen::VectorXd& x) const {
    const int n = static_cast<int>(k.rows());
    int combinations = 1;
    for (int i = 0; i < n; ++i) combinations *= 3;
    for (int which = 0; which < combinations; ++which) {
      Eigen::MatrixXd a = k;
      Eigen::VectorXd b = right_;
      bool possible = true;
      std::vector<int> state(static_cast<std::size_t>(n));
      for (int i = 0, rest = which; i < n; ++i, rest /= 3) {
        const auto at = static_cast<std::size_t>(i);
        state[at] = rest % 3;
        if (state[at] == 0) continue;
        const double value = state[at] == 1 ? low_[at] : high_[at];
        possible = possible && std::abs(value) < 1e8;
        a.row(i).setZero();
        a(i, i) = 1;
        b[i] = value;
      }
      if (!possible) continue;
      x = a.fullPivLu().solve(b);
      const Eigen::VectorXd rest = k * x - right_;
      for (int i = 0; possible && i < n; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (state[at] == 0) possible = low_[at] - 1e-12 < x[i] && x[i] < high_[at] + 1e-12;
        if (state[at] == 1) possible = rest[i] > -1e-12;
        if (state[at] == 2) possible = rest[i] < 1e-12;
      }
      if (possible) return true;
    }
    return false;
  }

  std::mt19937 random_{11};
  Method system_;
  Eigen::MatrixXd w_;
  Eigen::VectorXd right_;
  std::vector<double> low_, high_;
  std::uint32_t bodies_ = 0;
};
using Fixed62 = Fixed<std::int64_t, 62>;
template <class Method> class Pivots : public IslandProblem<Method> {};
using PivotingSystems = testing::Types<PivotingSystem<Exact<double>>, PivotingSystem<Fixed62>>;
TYPED_TEST_SUITE(Pivots, PivotingSystems);
template <class Method> class Repeats : public IslandProblem<Method> {};
using RepeatedSystems =
    testing::Types<AvbdSystem<Exact<double>>, AvbdSystem<Fixed62>, AdmmSystem<Exact<double>>, AdmmSystem<Fixed62>>;
TYPED_TEST_SUITE(Repeats, RepeatedSystems);

TYPED_TEST(Pivots, SmallProblemsHaveTheAnswerThatEnumerationFinds) {
  const RowBound kinds[] = {RowBound::above, RowBound::boxed, RowBound::equal, RowBound::below};
  for (int trial = 0; trial < 100; ++trial) {
    this->build(2, 2, 6);
    for (std::uint32_t r = 0; r < 6; ++r) {
      this->bound(r, kinds[this->random_() % 4]);
    }
    ASSERT_TRUE(this->solve()) << trial;
    Eigen::VectorXd x;
    const Eigen::MatrixXd k = this->yielding();
    ASSERT_TRUE(this->enumerate(k, x)) << trial;
    // Equations still yield a little after the last pass: 2^-20 of 2^-20, times what K magnifies.
    const double bound =
        1e-6 * (1 + x.norm()) / std::max(1e-6, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues()[0]);
    for (std::uint32_t r = 0; r < 6; ++r)
      EXPECT_NEAR(this->answer(r), x[static_cast<int>(r)], bound) << trial << " " << r;
  }
}

/// As many rows as three times the ways to move: half of what pushes is redundant.
TYPED_TEST(Pivots, PivotsOnRedundantProblemsComeToAnEnd) {
  for (int trial = 0; trial < 60; ++trial) {
    this->build(24, 6, trial % 2 == 0 ? 6 : 4);
    for (std::uint32_t r = 0; r < 72; ++r) {
      this->bound(r, r % 3 == 0 || trial % 3 == 0 ? RowBound::above : RowBound::boxed);
    }
    ASSERT_TRUE(this->solve()) << trial;
    EXPECT_LT(this->system_.pivots(), TypeParam::kMostPivots) << trial;
    Eigen::VectorXd x(72);
    for (std::uint32_t r = 0; r < 72; ++r) x[static_cast<int>(r)] = this->answer(r);
    const Eigen::VectorXd rest = this->yielding() * x - this->right_;
    const double slack = 1e-6 * (1 + x.cwiseAbs().maxCoeff());
    for (std::uint32_t r = 0; r < 72; ++r) {
      const double at = x[static_cast<int>(r)], left = rest[static_cast<int>(r)];
      EXPECT_GE(at, this->low_[r] - slack);
      EXPECT_LE(at, this->high_[r] + slack);
      EXPECT_TRUE(at <= this->low_[r] + slack || left < slack) << trial << " " << r;
      EXPECT_TRUE(at >= this->high_[r] - slack || left > -slack) << trial << " " << r;
    }
  }
}

TYPED_TEST(Pivots, PivotsEndWithTheirBudget) {
  int ended = 0;
  for (int trial = 0; trial < 30; ++trial) {
    this->build(24, 6, 6);
    for (std::uint32_t r = 0; r < 72; ++r) this->bound(r, r % 3 == 0 ? RowBound::above : RowBound::boxed);
    this->system_.tie(this->bodies_, kWork);
    this->system_.assemble();
    const std::uint64_t one = this->system_.least_work() / TypeParam::kLeastPivots;
    ended += this->system_.solve(false, 2 * one) ? 0 : 1;
    EXPECT_LE(this->system_.work(), 3 * one);  // with what equations take at the end
    for (std::uint32_t r = 0; r < 72; ++r) {
      EXPECT_LE(this->low_[r], this->answer(r));
      EXPECT_LE(this->answer(r), this->high_[r] + 1e-9);
    }
  }
  EXPECT_GT(ended, 10);
}

TYPED_TEST(Pivots, FrictionIsBoundedByTheLoad) {
  for (const double push : {0.2, 0.9}) {
    this->begin_on_a_point(push, 0);
    this->system_.guess_friction(0, true);
    ASSERT_TRUE(this->system_.solve(false, kWork));
    EXPECT_NEAR(this->answer(2), 4, 2e-3);
    EXPECT_NEAR(this->answer(0), push < 0.5 ? 4 * push : 2, 2e-3);
    EXPECT_NEAR(this->answer(1), 0, 1e-6);
  }
}

/// Methods that improve answers begin each solve with those of the last.
TYPED_TEST(Repeats, solves_come_to_the_answer_that_enumeration_finds) {
  const RowBound kinds[] = {RowBound::above, RowBound::boxed, RowBound::equal, RowBound::below};
  for (int trial = 0; trial < 40; ++trial) {
    this->build(2, 2, 6);
    for (std::uint32_t r = 0; r < 6; ++r) this->bound(r, kinds[this->random_() % 4]);
    this->system_.tie(this->bodies_, kWork);
    this->system_.assemble();
    for (int i = 0; i < 400; ++i) this->system_.solve(true, kWork);
    Eigen::VectorXd x;
    const Eigen::MatrixXd k = this->w_ * this->w_.transpose();
    ASSERT_TRUE(this->enumerate(k, x)) << trial;
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues()[0];
    if (least < 1e-3) continue;  // hardly coupled: such answers take thousands of passes
    for (std::uint32_t r = 0; r < 6; ++r) EXPECT_NEAR(this->answer(r), x[static_cast<int>(r)], 1e-3 * (1 + x.norm()));
  }
}

/// A body on one point: friction is within a disc of the load, and opposes the push however that lies to the tangents.
TYPED_TEST(Repeats, friction_opposes_the_push_on_a_disc_of_the_load) {
  for (const double push : {0.3, 0.9}) {
    this->begin_on_a_point(push * 0.6, push * 0.8);
    for (int i = 0; i < 30; ++i) this->system_.solve(true, kWork);
    const double friction = push < 0.5 ? 4 * push : 2;  // K is a quarter
    EXPECT_NEAR(this->answer(2), 4, 4e-3);
    EXPECT_NEAR(this->answer(0), 0.6 * friction, 4e-3);
    EXPECT_NEAR(this->answer(1), 0.8 * friction, 4e-3);
  }
}

/// On a grain it is the force of the ellipse that is nearest to the one that would hold the body.
TYPED_TEST(Repeats, friction_on_a_grain_is_the_force_of_its_ellipse_that_takes_most_power) {
  constexpr double kRatio = 0.25;
  for (const double push : {0.1, 0.3, 0.9}) {
    const double x = push * 0.6, z = push * 0.8;
    this->begin_on_a_point(x, z, kRatio);
    for (int i = 0; i < 60; ++i) this->system_.solve(true, kWork);
    double nearest[2] = {4 * x, 4 * z};  // K is a quarter
    if (std::hypot(nearest[0], nearest[1] / kRatio) > 2) {
      double least = 1e9;
      for (int i = 0; i < 100000; ++i) {
        const double at[2] = {2 * std::cos(i * 1e-4), 2 * kRatio * std::sin(i * 1e-4)};
        const double distance = std::hypot(at[0] - 4 * x, at[1] - 4 * z);
        if (distance < least) least = distance, nearest[0] = at[0], nearest[1] = at[1];
      }
    }
    EXPECT_NEAR(this->answer(2), 4, 4e-3);
    EXPECT_NEAR(this->answer(0), nearest[0], 4e-3) << push;
    EXPECT_NEAR(this->answer(1), nearest[1], 4e-3) << push;
  }
}

}  // namespace island_systems_test
}  // namespace isostep
