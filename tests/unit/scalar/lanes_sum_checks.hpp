// Checks that sums of products of lanes are, bit for bit, those of the scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/lanes_bounded.hpp"
#include "lanes_samples.hpp"

namespace isostep::test {
/// The test file says how its instruction set is looked for.
bool cpu_can_run();
}  // namespace isostep::test

namespace {

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

// The suite. A type list is Lanes types.
template <class L> class LanesTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!isostep::test::cpu_can_run()) GTEST_SKIP() << "this processor lacks the instruction set";
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

}  // namespace
