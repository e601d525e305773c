// Own vectors against Eigen's over the same number: what exact sums and always-inlined code cost or save.
// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "isostep/math/eigen.hpp"
#include "isostep/math/mat3.hpp"
#include "isostep/math/quat.hpp"

namespace isostep {
namespace {

constexpr std::size_t kCount = 1024;  // 12 to 96 kB of operands: in the second-level cache at most

class Draw {
 public:
  double next() {  // in [-1, 1)
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(static_cast<std::int64_t>(state_) >> 32) / 0x1p31;
  }

 private:
  std::uint64_t state_ = 1;
};

template <class S> struct Operands {
  std::vector<Vec3<S>> a, b;
  std::vector<Quat<Unit<S>>> q;
  std::vector<Mat3<S>> m;
  std::vector<Mat3<Unit<S>>> r;

  Operands() {
    Draw draw;
    const auto vector = [&] {
      const double x = draw.next(), y = draw.next(), z = draw.next();
      return Vec3<S>{from_double<S>(4 * x), from_double<S>(4 * y), from_double<S>(4 * z)};
    };
    for (std::size_t i = 0; i < kCount; ++i) {
      a.push_back(vector());
      b.push_back(vector());
      const Vec3<S> v = vector();
      const Direction<S> d = direction_of(v.x, v.y, v.z);
      q.push_back(rotation(Vec3<Unit<S>>{d.x, d.y, d.z}, a.back().x));
      r.push_back(to_matrix(q.back()));
      m.push_back({{vector(), vector(), vector()}});
    }
  }
};

/// The number Eigen gets: the same bits, fused by nothing.
template <class S> using Same = EigenScalar<S>;
template <class S> using EVec = Eigen::Matrix<Same<S>, 3, 1>;
template <class S> using EMat = Eigen::Matrix<Same<S>, 3, 3>;

template <class T, class From> std::vector<T> converted(const std::vector<From>& from) {
  std::vector<T> result;
  for (const From& x : from) result.emplace_back(to_eigen(x));
  return result;
}

template <class F> void run(benchmark::State& state, F&& each) {
  for (auto _ : state) {
    for (std::size_t i = 0; i < kCount; ++i) benchmark::DoNotOptimize(each(i));
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(kCount) * state.iterations());
}

template <class S> void dot_own(benchmark::State& state) {
  const Operands<S> o;
  run(state, [&](std::size_t i) { return dot(o.a[i], o.b[i]); });
}
template <class S> void dot_eigen(benchmark::State& state) {
  const Operands<S> o;
  const auto a = converted<EVec<S>>(o.a), b = converted<EVec<S>>(o.b);
  run(state, [&](std::size_t i) { return a[i].dot(b[i]); });
}
template <class S> void cross_own(benchmark::State& state) {
  const Operands<S> o;
  run(state, [&](std::size_t i) { return cross(o.a[i], o.b[i]); });
}
template <class S> void cross_eigen(benchmark::State& state) {
  const Operands<S> o;
  const auto a = converted<EVec<S>>(o.a), b = converted<EVec<S>>(o.b);
  run(state, [&](std::size_t i) { return a[i].cross(b[i]).eval(); });
}
/// Ours is through the matrix, as the engine does; Eigen's is its own product of quaternion and vector, over S
/// throughout because it knows no second format.
template <class S> void rotate_own(benchmark::State& state) {
  const Operands<S> o;
  run(state, [&](std::size_t i) { return to_matrix(o.q[i]) * o.a[i]; });
}
template <class S> void rotate_eigen(benchmark::State& state) {
  const Operands<S> o;
  const auto a = converted<EVec<S>>(o.a);
  std::vector<Eigen::Quaternion<Same<S>>> q;
  for (const auto& x : o.q) {
    const auto part = [](Unit<S> u) { return Same<S>(convert<S>(u)); };
    q.emplace_back(part(x.w), part(x.x), part(x.y), part(x.z));
  }
  run(state, [&](std::size_t i) { return (q[i] * a[i]).eval(); });
}
template <class S> void mat3_vec3_own(benchmark::State& state) {
  const Operands<S> o;
  run(state, [&](std::size_t i) { return o.m[i] * o.a[i]; });
}
template <class S> void mat3_vec3_eigen(benchmark::State& state) {
  const Operands<S> o;
  const auto a = converted<EVec<S>>(o.a);
  const auto m = converted<EMat<S>>(o.m);
  run(state, [&](std::size_t i) { return (m[i] * a[i]).eval(); });
}
template <class S> void mat3_mat3_own(benchmark::State& state) {
  const Operands<S> o;
  run(state, [&](std::size_t i) { return o.m[i] * o.m[kCount - 1 - i]; });
}
template <class S> void mat3_mat3_eigen(benchmark::State& state) {
  const Operands<S> o;
  const auto m = converted<EMat<S>>(o.m);
  run(state, [&](std::size_t i) { return (m[i] * m[kCount - 1 - i]).eval(); });
}

#define ISO_BENCH_BOTH(operation)                \
  BENCHMARK_TEMPLATE(operation##_own, float);    \
  BENCHMARK_TEMPLATE(operation##_eigen, float);  \
  BENCHMARK_TEMPLATE(operation##_own, double);   \
  BENCHMARK_TEMPLATE(operation##_eigen, double); \
  BENCHMARK_TEMPLATE(operation##_own, Q16_16);   \
  BENCHMARK_TEMPLATE(operation##_eigen, Q16_16); \
  BENCHMARK_TEMPLATE(operation##_own, Q32_32);   \
  BENCHMARK_TEMPLATE(operation##_eigen, Q32_32)
ISO_BENCH_BOTH(dot);
ISO_BENCH_BOTH(cross);
ISO_BENCH_BOTH(rotate);
ISO_BENCH_BOTH(mat3_vec3);
ISO_BENCH_BOTH(mat3_mat3);
#undef ISO_BENCH_BOTH

}  // namespace
}  // namespace isostep

BENCHMARK_MAIN();
