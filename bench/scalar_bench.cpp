// Cost of the scalars' arithmetic and elementary functions: independent operations on arrays that fit the first cache.
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>

#include "isostep/scalar/math.hpp"

namespace {

namespace iso = isostep;
using iso::Q16_16;
using iso::Q32_32;
using iso::Unit;

constexpr int kCount = 1024;  // operations per pass; the items per second that Google Benchmark prints are operations

/// Evenly spread pseudo-random numbers, the same for every scalar.
template <class S> std::array<S, 4 * kCount> numbers(double low, double high) {
  std::array<S, 4 * kCount> result;
  std::uint64_t state = 1;
  for (S& x : result) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    x = iso::from_double<S>(low + (high - low) * (static_cast<double>(state >> 11) * 0x1p-53));
  }
  return result;
}

template <class S, class Operation>
void measure(benchmark::State& state, double low, double high, Operation operation) {
  const auto x = numbers<S>(low, high);
  for (auto _ : state) {
    for (int i = 0; i < kCount; ++i) {
      auto result = operation(&x[static_cast<std::size_t>(4 * i)]);
      benchmark::DoNotOptimize(result);
    }
  }
  state.SetItemsProcessed(state.iterations() * kCount);
}

template <class S> void add(benchmark::State& s) {
  measure<S>(s, -50, 50, [](const S* x) { return x[0] + x[1]; });
}
template <class S> void multiply(benchmark::State& s) {
  measure<S>(s, -50, 50, [](const S* x) { return x[0] * x[1]; });
}
template <class S> void divide(benchmark::State& s) {
  measure<S>(s, 1, 50, [](const S* x) { return x[0] / x[1]; });
}
template <class S> void dot3(benchmark::State& s) {
  measure<S>(s, -50, 50, [](const S* x) {
    return iso::round_to<S>(iso::product(x[0], x[1]) + iso::product(x[1], x[2]) + iso::product(x[2], x[3]));
  });
}
template <class S> void sqrt(benchmark::State& s) {
  measure<S>(s, 0, 5000, [](const S* x) { return iso::sqrt(x[0]); });
}
template <class S> void rsqrt(benchmark::State& s) {
  measure<S>(s, 1, 5000, [](const S* x) { return iso::rsqrt(x[0]); });
}
template <class S> void sin(benchmark::State& s) {
  measure<S>(s, -50, 50, [](const S* x) { return iso::sin(x[0]); });
}
template <class S> void cos(benchmark::State& s) {
  measure<S>(s, -50, 50, [](const S* x) { return iso::cos(x[0]); });
}
template <class S> void sin_cos(benchmark::State& s) {
  measure<S>(s, -50, 50, [](const S* x) { return iso::sin_cos(x[0]); });
}
template <class S> void atan2(benchmark::State& s) {
  measure<S>(s, -50, 50, [](const S* x) { return iso::atan2(x[0], x[1]); });
}
template <class S> void asin(benchmark::State& s) {
  measure<S>(s, -1, 1, [](const S* x) { return iso::asin(x[0]); });
}
template <class S> void acos(benchmark::State& s) {
  measure<S>(s, -1, 1, [](const S* x) { return iso::acos(x[0]); });
}
template <class S> void exp(benchmark::State& s) {
  measure<S>(s, -9, 9, [](const S* x) { return iso::exp(x[0]); });
}
template <class S> void log(benchmark::State& s) {
  measure<S>(s, 0, 5000, [](const S* x) { return iso::log(x[0]); });
}
/// The share that a damping between 0 and 1 per second leaves after a step.
template <class S> void power_to(benchmark::State& s) {
  const auto h = iso::divide_to<iso::Step<S>>(S(1), S(60));
  measure<S>(s, 0, 1, [h](const S* x) { return iso::power_to<iso::Step<S>>(x[0], h); });
}
template <class S> void direction_of(benchmark::State& s) {
  measure<S>(s, -50, 50, [](const S* x) { return iso::direction_of(x[0], x[1], x[2]); });
}
/// Norms within a hundredth of one, as after a sub-step.
template <class S> void normalise4(benchmark::State& s) {
  measure<Unit<S>>(s, 0.4975, 0.5025, [](const Unit<S>* q) {
    std::array<Unit<S>, 4> r{q[0], q[1], q[2], q[3]};
    iso::normalise4(r[0], r[1], r[2], r[3]);
    return r;
  });
}

#define ISO_BENCH(FUNCTION)             \
  BENCHMARK_TEMPLATE(FUNCTION, float);  \
  BENCHMARK_TEMPLATE(FUNCTION, double); \
  BENCHMARK_TEMPLATE(FUNCTION, Q16_16); \
  BENCHMARK_TEMPLATE(FUNCTION, Q32_32);
ISO_BENCH(add)
ISO_BENCH(multiply)
ISO_BENCH(divide)
ISO_BENCH(dot3)
ISO_BENCH(sqrt)
ISO_BENCH(rsqrt)
ISO_BENCH(direction_of)
ISO_BENCH(normalise4)
ISO_BENCH(sin)
ISO_BENCH(cos)
ISO_BENCH(sin_cos)
ISO_BENCH(atan2)
ISO_BENCH(asin)
ISO_BENCH(acos)
ISO_BENCH(exp)
ISO_BENCH(log)
ISO_BENCH(power_to)

}  // namespace

BENCHMARK_MAIN();
