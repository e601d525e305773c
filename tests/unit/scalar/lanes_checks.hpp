// Checks that lanes answer, bit for bit, what the scalar answers: shared by the tests of every instruction set.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "isostep/scalar/lanes_bounded.hpp"
#include "isostep/scalar/lanes_math.hpp"
#include "isostep/scalar/lanes_reciprocal.hpp"

// Each test file keeps its own copy of all this, compiled for its own instruction set.
namespace {

using isostep::Fixed;
using isostep::Lanes;
using isostep::product;

struct Random {  // splitmix64
  std::uint64_t state;
  std::uint64_t next() {
    state += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
};

/// A number where things go wrong: ends, zeros, ties, denormals, infinities and NaN as often as ordinary values.
template <class S> S sample(Random& random) {
  using Raw = isostep::RawBits<S>;
  constexpr int kBits = static_cast<int>(sizeof(S)) * 8;
  const std::uint64_t bits = random.next();
  const int kind = random.below(4);
  if constexpr (isostep::kIsFixed<S>) {
    const Raw sign_bit = Raw{1} << (kBits - 1);
    const Raw ends[] = {0,
                        1,
                        static_cast<Raw>(-1),
                        sign_bit,
                        sign_bit + 1,
                        sign_bit - 1,
                        static_cast<Raw>(sign_bit / 2),
                        Raw{1} << (S::kFracBits - 1),
                        static_cast<Raw>(Raw{3} << (S::kFracBits - 1)),
                        static_cast<Raw>(0xffffffffu),
                        static_cast<Raw>(std::uint64_t{1} << 32)};
    if (kind == 0) return isostep::from_bits<S>(ends[random.below(11)]);
    if (kind == 1) return isostep::from_bits<S>(static_cast<Raw>(bits));
    if (kind == 2) return S::from_raw(static_cast<typename S::Raw>(bits) >> random.below(kBits));
    return isostep::from_bits<S>(static_cast<Raw>(static_cast<Raw>(bits) << random.below(kBits)));
  } else {
    using Limits = std::numeric_limits<S>;
    const S ends[] = {S(0),
                      S(1),
                      S(0.5),
                      Limits::denorm_min(),
                      Limits::min(),
                      Limits::max(),
                      Limits::infinity(),
                      Limits::quiet_NaN(),
                      Limits::epsilon(),
                      S(3)};
    const S sign = (bits >> 63) != 0 ? S(-1) : S(1);
    if (kind == 0) return sign * ends[random.below(10)];
    if (kind == 1) return isostep::from_bits<S>(static_cast<Raw>(bits));
    return sign * static_cast<S>(bits >> 40) / static_cast<S>(std::uint64_t{1} << random.below(48));
  }
}

template <class S> bool is_nan(S a) { return !(a == a); }
/// The very bits.
template <class S> bool same_bits(S a, S b) { return isostep::to_bits(a) == isostep::to_bits(b); }
/// The very bits, but one NaN is as good as another: which operand's NaN survives a sum is the compiler's choice.
template <class S> bool same_value(S a, S b) { return same_bits(a, b) || (is_nan(a) && is_nan(b)); }

/// W scalars in memory.
template <class L> struct Block {
  using S = typename L::Scalar;
  static constexpr int kWidth = L::kWidth;
  alignas(isostep::kLaneAlignment<S, kWidth>) S lane[kWidth];

  static Block sampled(Random& random) {
    Block r;
    for (S& a : r.lane) a = sample<S>(random);
    return r;
  }
  static Block of(L lanes) {
    Block r;
    lanes.store(r.lane);
    return r;
  }
  L load() const { return L::load(lane); }
};

#define EXPECT_LANES(same, lanes, scalar)                                                            \
  do {                                                                                               \
    const auto block = Block<std::remove_cvref_t<decltype(lanes)>>::of(lanes);                       \
    for (int i = 0; i < decltype(block)::kWidth; ++i) {                                              \
      ASSERT_TRUE(same(block.lane[i], (scalar))) << #lanes << ", lane " << i << ", round " << round; \
    }                                                                                                \
  } while (false)

constexpr int kRounds = 4000;

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

/// Sums of up to eight products of formats F and G, rounded to the format Out: exact even where they wrap.
template <class A, class B, class Out, int W, class Isa> void check_sums() {
  using LA = Lanes<A, W, Isa>;
  using LB = Lanes<B, W, Isa>;
  using LO = Lanes<Out, W, Isa>;
  using ScalarSum = isostep::SumOf<A, B>;
  Random random{5};
  for (int round = 0; round < kRounds; ++round) {
    auto lanes = product(LA::zero(), LB::zero());
    ScalarSum sums[W];
    for (int i = 0; i < W; ++i) sums[i] = product(A(0), B(0));
    const int terms = 1 + random.below(8);
    for (int t = 0; t < terms; ++t) {
      const auto x = Block<LA>::sampled(random);
      const auto y = Block<LB>::sampled(random);
      const int kind = random.below(5);
      auto term = product(x.load(), y.load());
      if (kind == 3) term = isostep::widen<decltype(lanes)>(x.load());
      if (kind == 4) term = -term;
      if (kind == 0) lanes -= term;
      if (kind == 1) lanes = lanes + term;
      if (kind >= 2) lanes += term;
      for (int i = 0; i < W; ++i) {
        ScalarSum s = product(x.lane[i], y.lane[i]);
        if (kind == 3) s = isostep::widen<ScalarSum>(x.lane[i]);
        if (kind == 4) s = -s;
        sums[i] = kind == 0 ? sums[i] - s : sums[i] + s;
      }
    }
    const LO rounded = isostep::round_to<LO>(lanes);
    EXPECT_LANES(same_value, rounded, isostep::round_to<Out>(sums[i]));
    const auto x = Block<LA>::sampled(random);
    const auto y = Block<LB>::sampled(random);
    const LO one = isostep::round_product<LO>(x.load(), y.load());
    EXPECT_LANES(same_value, one, isostep::round_to<Out>(product(x.lane[i], y.lane[i])));
  }
}

/// A product of two formats, a quotient and a conversion.
template <class A, class B, int W, class Isa> void check_mixed() {
  using LA = Lanes<A, W, Isa>;
  using LB = Lanes<B, W, Isa>;
  Random random{6};
  for (int round = 0; round < kRounds; ++round) {
    const auto x = Block<LA>::sampled(random);
    const auto y = Block<LB>::sampled(random);
    const LA a = x.load();
    const LB b = y.load();
    EXPECT_LANES(same_value, a * b, x.lane[i] * y.lane[i]);
    EXPECT_LANES(same_value, b * a, y.lane[i] * x.lane[i]);
    const LB converted = isostep::convert<LB>(a);
    EXPECT_LANES(same_value, converted, isostep::convert<B>(x.lane[i]));
    const LA quotient = isostep::divide_to<LA>(a, b);
    EXPECT_LANES(same_value, quotient, isostep::divide_to<A>(x.lane[i], y.lane[i]));
  }
}

/// Rounding shifts below, at and above a word, and formats finer than the sum.
template <class Rep, int W, class Isa> void check_formats() {
  using isostep::Fixed;
  if constexpr (sizeof(Rep) == 4) {
    check_sums<Fixed<Rep, 16>, Fixed<Rep, 16>, Fixed<Rep, 16>, W, Isa>();
    check_sums<Fixed<Rep, 16>, Fixed<Rep, 30>, Fixed<Rep, 16>, W, Isa>();
    check_sums<Fixed<Rep, 16>, Fixed<Rep, 31>, Fixed<Rep, 16>, W, Isa>();
    check_sums<Fixed<Rep, 30>, Fixed<Rep, 30>, Fixed<Rep, 28>, W, Isa>();
    check_sums<Fixed<Rep, 30>, Fixed<Rep, 30>, Fixed<Rep, 16>, W, Isa>();
    check_sums<Fixed<Rep, 31>, Fixed<Rep, 31>, Fixed<Rep, 1>, W, Isa>();
    check_sums<Fixed<Rep, 16>, Fixed<Rep, 17>, Fixed<Rep, 31>, W, Isa>();
    check_sums<Fixed<Rep, 16>, Fixed<Rep, 16>, Fixed<Rep, 31>, W, Isa>();
    check_sums<Fixed<Rep, 8>, Fixed<Rep, 8>, Fixed<Rep, 16>, W, Isa>();
    check_sums<Fixed<Rep, 1>, Fixed<Rep, 2>, Fixed<Rep, 31>, W, Isa>();
    check_mixed<Fixed<Rep, 16>, Fixed<Rep, 30>, W, Isa>();
  } else {
    check_sums<Fixed<Rep, 32>, Fixed<Rep, 32>, Fixed<Rep, 32>, W, Isa>();
    check_sums<Fixed<Rep, 32>, Fixed<Rep, 62>, Fixed<Rep, 32>, W, Isa>();
    check_sums<Fixed<Rep, 32>, Fixed<Rep, 63>, Fixed<Rep, 32>, W, Isa>();
    check_sums<Fixed<Rep, 62>, Fixed<Rep, 62>, Fixed<Rep, 62>, W, Isa>();
    check_sums<Fixed<Rep, 40>, Fixed<Rep, 40>, Fixed<Rep, 40>, W, Isa>();
    check_sums<Fixed<Rep, 24>, Fixed<Rep, 24>, Fixed<Rep, 24>, W, Isa>();
    check_sums<Fixed<Rep, 32>, Fixed<Rep, 33>, Fixed<Rep, 32>, W, Isa>();
    check_sums<Fixed<Rep, 62>, Fixed<Rep, 62>, Fixed<Rep, 60>, W, Isa>();
    check_sums<Fixed<Rep, 62>, Fixed<Rep, 62>, Fixed<Rep, 59>, W, Isa>();
    check_sums<Fixed<Rep, 62>, Fixed<Rep, 62>, Fixed<Rep, 32>, W, Isa>();
    check_sums<Fixed<Rep, 63>, Fixed<Rep, 63>, Fixed<Rep, 1>, W, Isa>();
    check_sums<Fixed<Rep, 32>, Fixed<Rep, 32>, Fixed<Rep, 63>, W, Isa>();
    check_sums<Fixed<Rep, 16>, Fixed<Rep, 16>, Fixed<Rep, 32>, W, Isa>();
    check_sums<Fixed<Rep, 1>, Fixed<Rep, 1>, Fixed<Rep, 63>, W, Isa>();
    check_sums<Fixed<Rep, 1>, Fixed<Rep, 63>, Fixed<Rep, 40>, W, Isa>();
    check_sums<Fixed<Rep, 1>, Fixed<Rep, 62>, Fixed<Rep, 62>, W, Isa>();
    check_mixed<Fixed<Rep, 32>, Fixed<Rep, 62>, W, Isa>();
  }
}

// The suite. A type list is Lanes types; the test file says how its instruction set is looked for.
bool cpu_can_run();

template <class L> class LanesTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!cpu_can_run()) GTEST_SKIP() << "this processor lacks the instruction set";
  }
};
/// Sums up to a hundred times the bound, about it, on it, and of halves that round across it.
template <class L> void check_bounded_sums() {
  using S = typename L::Scalar;
  Random random{9};
  const S most = S(1);
  for (int round = 0; round < kRounds; ++round) {
    Block<L> x, y;
    for (int i = 0; i < L::kWidth; ++i) {
      const auto pick = [&] {
        const S half = isostep::from_double<S>(0.5), step = isostep::resolution<S>();
        const S ends[] = {S(1),        S(-1),       half,        -half,
                          S(1) - step, step - S(1), half + step, isostep::from_double<S>(1.5)};
        const double fine = static_cast<double>(random.next() >> 32) / 0x1p31 - 1;
        return random.below(2) == 0 ? ends[random.below(8)] : isostep::from_double<S>(1.9 * fine);
      };
      x.lane[i] = pick();
      y.lane[i] = pick();
    }
    const auto sum = product(x.load(), y.load()) + product(y.load(), y.load());
    const auto expected = [&](int i) {
      const auto whole = product(x.lane[i], y.lane[i]) + product(y.lane[i], y.lane[i]);
      const auto limit = isostep::widen<isostep::Sum<S>>(most);
      return isostep::round_to<S>(isostep::clamp(whole, -limit, limit));
    };
    EXPECT_LANES(same_bits, isostep::round_within<L>(sum, most), expected(i));
  }
}

/// Any number, and its products with numbers that leave sums their room.
template <class L> void check_headroom() {
  using S = typename L::Scalar;
  Random random{11};
  const S factors[] = {S(1), S(-1), isostep::from_double<S>(0.5), isostep::resolution<S>(), isostep::highest<S>()};
  for (int round = 0; round < kRounds; ++round) {
    const auto x = Block<L>::sampled(random);
    Block<L> y;
    for (S& factor : y.lane) factor = factors[random.below(5)];
    EXPECT_LANES(same_bits, isostep::with_headroom(x.load()), isostep::with_headroom(x.lane[i]));
    EXPECT_LANES(same_bits, isostep::round_with_headroom<L>(product(x.load(), y.load())),
                 isostep::round_with_headroom<S>(product(x.lane[i], y.lane[i])));
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
