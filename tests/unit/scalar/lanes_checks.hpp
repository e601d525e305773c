// Checks that lanes answer, bit for bit, what the scalar answers: shared by the tests of every instruction set.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/lanes_math.hpp"
#include "isostep/scalar/lanes_reciprocal.hpp"
#include "lanes_sum_checks.hpp"

namespace {

template <class L> void check_arithmetic() {
  using S = typename L::Scalar;
  Random random{1};
  for (int round = 0; round < kRounds; ++round) {
    const auto x = Block<L>::sampled(random);
    const auto y = Block<L>::sampled(random);
    const auto z = Block<L>::sampled(random);
    const L a = x.load();
    const L b = y.load();
    const L c = z.load();
    EXPECT_LANES(same_value, a + b, x.lane[i] + y.lane[i]);
    EXPECT_LANES(same_value, a - b, x.lane[i] - y.lane[i]);
    EXPECT_LANES(same_value, a * b, x.lane[i] * y.lane[i]);
    EXPECT_LANES(same_value, a / b, x.lane[i] / y.lane[i]);
    EXPECT_LANES(same_value, divide(a, b), x.lane[i] / y.lane[i]);
    EXPECT_LANES(same_bits, -a, -x.lane[i]);
    EXPECT_LANES(same_bits, min(a, b), isostep::min(x.lane[i], y.lane[i]));
    EXPECT_LANES(same_bits, max(a, b), isostep::max(x.lane[i], y.lane[i]));
    EXPECT_LANES(same_bits, isostep::clamp(a, b, c), isostep::clamp(x.lane[i], y.lane[i], z.lane[i]));
    EXPECT_LANES(same_bits, abs(a), isostep::abs(x.lane[i]));
    EXPECT_LANES(same_bits, a, x.lane[i]);
    EXPECT_LANES(same_bits, L::broadcast(x.lane[0]), x.lane[0]);
    EXPECT_LANES(same_bits, L::zero(), S(0));
    for (const L zero : {L::zero(), -L::zero()}) {
      const auto z0 = Block<L>::of(zero);
      EXPECT_LANES(same_value, add_zero(a, zero), x.lane[i] + z0.lane[i]);
      EXPECT_LANES(same_value, subtract_zero(a, zero), x.lane[i] - z0.lane[i]);
    }
    L sum = a;
    sum += b;
    sum -= c;
    EXPECT_LANES(same_value, sum, x.lane[i] + y.lane[i] - z.lane[i]);
    L scaled = a;
    scaled *= b;
    EXPECT_LANES(same_value, scaled, x.lane[i] * y.lane[i]);
  }
}

template <class L> void check_sqrt() {
  using S = typename L::Scalar;
  Random random{2};
  const auto root_of_square = Block<L>::of(sqrt(L::broadcast(S(49))));
  EXPECT_TRUE(same_bits(root_of_square.lane[0], S(7)));
  EXPECT_TRUE(same_bits(Block<L>::of(sqrt(L::broadcast(S(-0.0)))).lane[0], S(-0.0)));
  for (int round = 0; round < kRounds; ++round) {
    const auto x = Block<L>::sampled(random);
    EXPECT_LANES(same_value, sqrt(x.load()), Block<L>::of(sqrt(L::broadcast(x.lane[i]))).lane[0]);
    // IEEE: the root of an exact square is exact; 2^12 squares stay exact in float.
    const auto whole = static_cast<S>(random.below(4096));
    const auto square = sqrt(L::broadcast(whole * whole));
    EXPECT_LANES(same_bits, square, whole);
  }
}

/// Roots, quotients and directions; every other round of ordinary size, where no square leaves the range.
template <class L> void check_math() {
  using S = typename L::Scalar;
  using U = isostep::Unit<S>;
  constexpr int kWidth = L::kWidth;
  Random random{11};
  for (int round = 0; round < kRounds; ++round) {
    Block<L> x, y, z, root, quotient, length;
    Block<isostep::Unit<L>> dx, dy, dz;
    for (int i = 0; i < kWidth; ++i) {
      const auto number = [&] {
        return round % 2 == 0 ? sample<S>(random)
                              : isostep::from_double<S>(static_cast<double>(random.below(2001) - 1000) / 1024);
      };
      x.lane[i] = number();
      y.lane[i] = number();
      z.lane[i] = number();
    }
    const std::uint32_t bits = static_cast<std::uint32_t>(random.next());
    const auto mask = L::Mask::from_bits(bits & (0xffffffffu >> (32 - kWidth)));
    isostep::root(x.load()).store(root.lane);
    isostep::quotient_where<L>(mask, x.load(), y.load()).store(quotient.lane);
    const auto d = isostep::direction_where(mask, x.load(), y.load(), z.load());
    d.x.store(dx.lane);
    d.y.store(dy.lane);
    d.z.store(dz.lane);
    d.length.store(length.lane);
    for (int i = 0; i < kWidth; ++i) {
      const S a = x.lane[i], b = y.lane[i], c = z.lane[i];
      ASSERT_TRUE(same_value(root.lane[i], isostep::sqrt(a))) << "lane " << i;
      const bool chosen = ((bits >> i) & 1u) != 0;
      ASSERT_TRUE(same_value(quotient.lane[i], chosen ? a / b : S(0))) << "lane " << i;
      if (!chosen) continue;
      const isostep::Direction<S> one = isostep::direction_of(a, b, c);
      ASSERT_TRUE(same_value<U>(dx.lane[i], one.x) && same_value<U>(dy.lane[i], one.y) &&
                  same_value<U>(dz.lane[i], one.z) && same_value(length.lane[i], one.length))
          << "lane " << i;
    }
  }
}

/// Quaternions of any length up to two, of none too.
template <class L> void check_quaternions() {
  using U = typename isostep::Unit<L>::Scalar;
  Random random{13};
  std::size_t none = 0;
  for (int round = 0; round < kRounds; ++round) {
    Block<isostep::Unit<L>> q[4];
    U one[4][L::kWidth];
    for (int i = 0; i < L::kWidth; ++i) {
      const bool empty = random.below(8) == 0;
      none += empty ? 1u : 0u;
      for (int k = 0; k < 4; ++k) {
        one[k][i] = empty ? U(0) : isostep::from_double<U>(static_cast<double>(random.below(2001) - 1000) / 1024);
        q[k].lane[i] = one[k][i];
      }
      isostep::normalise4(one[0][i], one[1][i], one[2][i], one[3][i]);
    }
    auto x = q[0].load(), y = q[1].load(), z = q[2].load(), w = q[3].load();
    isostep::normalise4(x, y, z, w);
    x.store(q[0].lane);
    y.store(q[1].lane);
    z.store(q[2].lane);
    w.store(q[3].lane);
    for (int i = 0; i < L::kWidth; ++i) {
      for (int k = 0; k < 4; ++k) ASSERT_TRUE(same_value<U>(q[k].lane[i], one[k][i])) << "lane " << i;
    }
  }
  EXPECT_GT(none, 0u);
}

template <class L> void check_masks() {
  using Mask = typename L::Mask;
  constexpr int W = L::kWidth;
  constexpr std::uint32_t kAll = (1u << W) - 1;
  Random random{3};
  for (int round = 0; round < kRounds; ++round) {
    const auto x = Block<L>::sampled(random);
    auto y = Block<L>::sampled(random);
    if (random.below(2) == 0) y.lane[random.below(W)] = x.lane[0];
    if (random.below(2) == 0) y.lane[0] = x.lane[0];
    const L a = x.load();
    const L b = y.load();
    std::uint32_t less_bits = 0;
    std::uint32_t less_equal_bits = 0;
    std::uint32_t equal_bits = 0;
    for (int i = 0; i < W; ++i) {
      less_bits |= (x.lane[i] < y.lane[i] ? 1u : 0u) << i;
      less_equal_bits |= (x.lane[i] <= y.lane[i] ? 1u : 0u) << i;
      equal_bits |= (x.lane[i] == y.lane[i] ? 1u : 0u) << i;
    }
    ASSERT_EQ(to_bits(less(a, b)), less_bits);
    ASSERT_EQ(to_bits(less_equal(a, b)), less_equal_bits);
    ASSERT_EQ(to_bits(equal(a, b)), equal_bits);
    EXPECT_LANES(same_bits, select(less(a, b), a, b), x.lane[i] < y.lane[i] ? x.lane[i] : y.lane[i]);
    const std::uint32_t p = static_cast<std::uint32_t>(random.next()) & kAll;
    const std::uint32_t q = static_cast<std::uint32_t>(random.next()) & kAll;
    const Mask m = Mask::from_bits(p);
    const Mask n = Mask::from_bits(q);
    ASSERT_EQ(to_bits(m), p);
    ASSERT_EQ(to_bits(m & n), p & q);
    ASSERT_EQ(to_bits(m | n), p | q);
    ASSERT_EQ(to_bits(~m), ~p & kAll);
    ASSERT_EQ(any(m), p != 0);
    ASSERT_EQ(all(m), p == kAll);
    EXPECT_LANES(same_bits, select(m, a, b), ((p >> i) & 1u) != 0 ? x.lane[i] : y.lane[i]);
  }
  EXPECT_TRUE(all(Mask::from_bits(kAll)));
  EXPECT_FALSE(any(Mask::from_bits(0)));
}

template <int N, class L> void check_transposes() {
  using S = typename L::Scalar;
  constexpr int W = L::kWidth;
  Random random{4};
  for (int round = 0; round < 200; ++round) {
    S records[3 * W * N + 1];
    for (S& a : records) a = sample<S>(random);
    const S* rows[W];
    for (int i = 0; i < W; ++i) rows[i] = records + 1 + N * random.below(3 * W);  // shared and unaligned, as they come
    L lanes[N];
    isostep::load_transposed<N>(rows, lanes);
    for (int n = 0; n < N; ++n) EXPECT_LANES(same_bits, lanes[n], rows[i][n]);

    S target[W][N + 1];
    S before[W][N + 1];
    for (int i = 0; i < W; ++i) {
      for (int n = 0; n <= N; ++n) before[i][n] = target[i][n] = sample<S>(random);
    }
    const std::uint32_t mask = static_cast<std::uint32_t>(random.next());
    S* targets[W];
    for (int i = 0; i < W; ++i) targets[i] = ((mask >> i) & 1u) != 0 ? target[i] : nullptr;
    isostep::store_transposed<N>(targets, lanes, mask);
    for (int i = 0; i < W; ++i) {
      for (int n = 0; n <= N; ++n) {
        const bool written = n < N && ((mask >> i) & 1u) != 0;
        ASSERT_TRUE(same_bits(target[i][n], written ? rows[i][n] : before[i][n])) << "row " << i << " scalar " << n;
      }
    }
  }
}
/// Any number; in every other round all lanes of one size, as a fast path may ask for, and about powers of two.
template <class L> void check_reciprocals() {
  using S = typename L::Scalar;
  Random random{10};
  for (int round = 0; round < 4 * kRounds; ++round) {
    auto x = Block<L>::sampled(random);
    if constexpr (isostep::kIsFixed<S>) {
      const int size = random.below(S::kBits - 1);
      for (S& a : x.lane) {
        if (round % 2 == 0) break;
        const std::uint64_t near = (std::uint64_t{1} << size) + static_cast<std::uint64_t>(random.below(5)) - 2;
        const std::uint64_t any = (std::uint64_t{1} << size) | (random.next() & ((std::uint64_t{1} << size) - 1));
        a = S::from_raw(static_cast<typename S::Raw>(random.below(2) == 0 ? near : any));
      }
    }
    EXPECT_LANES(same_value, reciprocal(x.load()), S(1) / x.lane[i]);
  }
}

TYPED_TEST_SUITE_P(LanesTest);

TYPED_TEST_P(LanesTest, ArithmeticAnswersTheScalarsBits) { check_arithmetic<TypeParam>(); }
TYPED_TEST_P(LanesTest, ComparisonsAndSelectionsAnswerTheScalars) { check_masks<TypeParam>(); }
TYPED_TEST_P(LanesTest, RootsQuotientsAndDirectionsAnswerTheScalars) { check_math<TypeParam>(); }
TYPED_TEST_P(LanesTest, QuaternionsAreNormalisedAsScalarsAre) { check_quaternions<TypeParam>(); }
TYPED_TEST_P(LanesTest, TransposesGatherAndScatterRecords) {
  check_transposes<4, TypeParam>();
  check_transposes<8, TypeParam>();
}
template <class S, int W, class Isa> void check_usual_sums(Lanes<S, W, Isa>) {
  using L = Lanes<S, W, Isa>;
  using U = isostep::Unit<S>;
  static_assert(std::same_as<isostep::Unit<L>, Lanes<U, W, Isa>>);
  static_assert(std::same_as<isostep::SumOf<L, isostep::Unit<L>>, decltype(product(L{}, isostep::Unit<L>{}))>);
  check_sums<S, S, S, W, Isa>();
  check_sums<S, U, S, W, Isa>();
  check_sums<S, isostep::Step<S>, S, W, Isa>();
  check_sums<U, U, U, W, Isa>();
}
TYPED_TEST_P(LanesTest, SumsOfProductsRoundOnce) { check_usual_sums(TypeParam::zero()); }
TYPED_TEST_P(LanesTest, SumsAreHeldWithinABound) { check_bounded_sums<TypeParam>(); }
TYPED_TEST_P(LanesTest, HeadroomIsHalfOfTheFormat) { check_headroom<TypeParam>(); }
TYPED_TEST_P(LanesTest, ReciprocalsAnswerTheScalars) { check_reciprocals<TypeParam>(); }
REGISTER_TYPED_TEST_SUITE_P(LanesTest, ReciprocalsAnswerTheScalars, SumsAreHeldWithinABound, HeadroomIsHalfOfTheFormat,
                            ArithmeticAnswersTheScalarsBits, ComparisonsAndSelectionsAnswerTheScalars,
                            RootsQuotientsAndDirectionsAnswerTheScalars, QuaternionsAreNormalisedAsScalarsAre,
                            TransposesGatherAndScatterRecords, SumsOfProductsRoundOnce);

}  // namespace
