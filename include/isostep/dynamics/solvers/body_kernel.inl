// The kernel that integrates bodies: W side by side, written once for every scalar and instruction set. Included by one
// file per instruction set; everything here is inline or has internal linkage.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/gyroscopic.hpp"
#include "isostep/dynamics/solvers/body_kernels.hpp"
#include "isostep/math/lanes_select.hpp"
#include "isostep/scalar/lanes_math.hpp"

namespace isostep {
namespace {

/// Integrates bodies: forces, damping, free turning; then moves. A lane does not depend on its neighbours.
template <class S, int W, class Isa> struct BodyKernel {
  using L = Lanes<S, W, Isa>;
  using V = Lanes<Velocity<S>, W, Isa>;
  using U = Lanes<Unit<S>, W, Isa>;
  using H = Lanes<Step<S>, W, Isa>;
  using Mask = typename L::Mask;
  static constexpr std::uint32_t kAll = 0xffffffffu >> (32 - W);

  struct Motion {
    Vec3<V> linear, angular;
  };

  /// Loads rows of N numbers, N = 4 or 8. `of(i)` is the first of each.
  template <int N, class T, class Of> static ISO_INLINE void load_rows(const Of& of, Lanes<T, W, Isa> (&out)[N]) {
    const T* rows[W];
    for (int i = 0; i < W; ++i) rows[i] = of(i);
    load_transposed<N>(rows, out);
  }
  template <int N, class T, class Of>
  static ISO_INLINE void store_rows(const Of& of, const Lanes<T, W, Isa> (&in)[N], std::uint32_t mask) {
    T* rows[W];
    for (int i = 0; i < W; ++i) rows[i] = of(i);
    store_transposed<N>(rows, in, mask);
  }
  static ISO_INLINE Motion load(const MotionRow<Velocity<S>>* rows) {
    V all[8];
    load_rows<8, Velocity<S>>([rows](int i) ISO_INLINE_LAMBDA { return &rows[i].linear.x; }, all);
    return {{all[0], all[1], all[2]}, {all[4], all[5], all[6]}};
  }
  static ISO_INLINE void store(const Motion& m, MotionRow<Velocity<S>>* rows, std::uint32_t mask) {
    const V zero = V::zero();
    const V all[8] = {m.linear.x, m.linear.y, m.linear.z, zero, m.angular.x, m.angular.y, m.angular.z, zero};
    store_rows<8, Velocity<S>>([rows](int i) ISO_INLINE_LAMBDA { return &rows[i].linear.x; }, all, mask);
  }
  template <class Of> static ISO_INLINE Quat<U> load_rotation(const Of& of) {
    U q[4];
    load_rows<4, Unit<S>>([&of](int i) ISO_INLINE_LAMBDA { return &of(i).x; }, q);
    return {q[0], q[1], q[2], q[3]};
  }
  static ISO_INLINE Quat<U> orientation(const BodyState<S>* states) {
    return load_rotation([states](int i) ISO_INLINE_LAMBDA -> const Quat<Unit<S>>& { return states[i].orientation; });
  }
  /// Returns those of W bodies that have the bit, one bit each. The factor moves bit 8 i of eight bytes to bit 56 + i.
  static ISO_INLINE std::uint32_t which(const std::uint8_t* kinds, std::uint8_t bit) {
    constexpr int kBytes = W < 8 ? W : 8;
    std::uint32_t bits = 0;
    ISO_UNROLL for (int from = 0; from < W; from += kBytes) {
      std::uint64_t bytes = 0;
      ISO_UNROLL for (int i = 0; i < kBytes; ++i) bytes |= std::uint64_t{kinds[from + i]} << (8 * i);
      const std::uint64_t ones = (bytes >> first_bit(bit)) & 0x0101010101010101u;
      bits |= static_cast<std::uint32_t>(ones * 0x0102040810204080u >> 56) << from;
    }
    return bits;
  }
  template <class A> static ISO_INLINE V times(A a, V b) { return round_product<V>(a, b); }
  template <class A> static ISO_INLINE Vec3<V> times(A a, Vec3<V> b) {
    return {times(a, b.x), times(a, b.y), times(a, b.z)};
  }
  static ISO_INLINE Vec3<V> over(Vec3<L> a, H h) {
    return {round_product<V>(a.x, h), round_product<V>(a.y, h), round_product<V>(a.z, h)};
  }

  /// Writes bodies into run.left: see BodyKernels.
  static ISO_INLINE void leave(const BodyRun<S>& run, std::size_t first, std::uint32_t rest, std::uint32_t odd,
                               std::size_t& left) {
    for (std::uint32_t i = 0; i < W && rest >> i != 0; ++i) {
      if (((rest >> i) & 1u) == 0) continue;
      run.left[run.first + left++] = static_cast<std::uint32_t>(2 * (first + i)) + ((odd >> i) & 1u);
    }
  }

  // ---- velocities

  /// Adds the velocity that an acceleration gives. One of 0 changes nothing, not -0 to 0 either: whether any body has
  /// an acceleration is nothing to the others.
  static ISO_INLINE Vec3<V> pushed(const Vec3<V>& v, const Vec3<L>& a, H h) {
    const Vec3<V> by = over(a, h);
    const auto add = [](V x, V dx, L ax) ISO_INLINE_LAMBDA { return select(equal(ax, L::zero()), x, x + dx); };
    return {add(v.x, by.x, a.x), add(v.y, by.y, a.y), add(v.z, by.z, a.z)};
  }

  static ISO_INLINE void accelerate(const BodyRun<S>& run, std::size_t first, H h, Motion& m) {
    BodyFlight<S>* const flights = run.flights + first;
    V fall[4];
    load_rows<4, Velocity<S>>([flights](int i) ISO_INLINE_LAMBDA { return &flights[i].fall.x; }, fall);
    m.linear += {fall[0], fall[1], fall[2]};
    const V fallen[4] = {m.linear.x, m.linear.y, m.linear.z, V::zero()};
    store_rows<4, Velocity<S>>([flights](int i) ISO_INLINE_LAMBDA { return &flights[i].fallen.x; }, fallen, kAll);
    if (run.accelerations != nullptr) {
      alignas(kLaneAlignment<S, W>) S in[6][W];
      for (int i = 0; i < W; ++i) {
        const Acceleration<S>& of = run.accelerations[first + static_cast<std::size_t>(i)];
        for (int axis = 0; axis < 3; ++axis) {
          in[axis][i] = of.linear[axis];
          in[3 + axis][i] = of.angular[axis];
        }
      }
      m.linear = pushed(m.linear, {L::load(in[0]), L::load(in[1]), L::load(in[2])}, h);
      m.angular = pushed(m.angular, {L::load(in[3]), L::load(in[4]), L::load(in[5])}, h);
    }
    if (which(run.kinds + first, body_kind::kDamped) == 0) return;
    const BodyFactors<S>* const rows = run.factors + first;
    L factor[4];
    load_rows<4, S>([rows](int i) ISO_INLINE_LAMBDA { return &rows[i].linear_keep; }, factor);
    m.linear = times(factor[0], m.linear);
    m.angular = times(factor[1], m.angular);
  }

  /// Turns slow solids. Returns the bodies that must still turn.
  static ISO_INLINE std::uint32_t turn(const BodyRun<S>& run, std::size_t first, std::uint32_t turns, H h, Motion& m) {
    const std::uint8_t* const kinds = run.kinds + first;
    const BodyProperties<S>* const properties = run.properties + first;
    BodyTurn<S>* const rows = run.turns + first;
    const std::uint32_t slow =
        turns & which(kinds, body_kind::kSolid) & ~to_bits(less(V::broadcast(run.rapid), max_abs(m.angular)));
    if (slow == 0) return turns;
    Quat<U> q = orientation(run.states + first);
    const std::uint32_t tilted = which(kinds, body_kind::kTilted);
    if (tilted != 0) {
      const Quat<U> p = q * load_rotation([properties](int i) ISO_INLINE_LAMBDA -> const Quat<Unit<S>>& {
                          return properties[i].principal;
                        });
      q = select(Mask::from_bits(tilted), p, q);
    }
    const Mat3<U> axes = to_matrix(q, U::broadcast(Unit<S>(1)));
    L euler[4];
    load_rows<4, S>([rows](int i) ISO_INLINE_LAMBDA { return &rows[i].euler.x; }, euler);
    const SlowTurn<V> slowly =
        slow_turn(axes, Vec3<L>{euler[0], euler[1], euler[2]}, m.angular, h, L::broadcast(S(0.5)));
    const V known[4] = {slowly.known.x, slowly.known.y, slowly.known.z, V::zero()};
    store_rows<4, Velocity<S>>([rows](int i) ISO_INLINE_LAMBDA { return &rows[i].known.x; }, known, slow);
    m.angular = select(Mask::from_bits(slow), slowly.angular_velocity, m.angular);
    return turns & ~slow;
  }

  static ISO_INLINE void integrate_velocities(const BodyRun<S>& run, std::size_t first, std::size_t& left) {
    const std::uint8_t* const kinds = run.kinds + first;
    const std::uint32_t driven = which(kinds, body_kind::kDriven);
    if (driven == 0) return;
    const H h = H::broadcast(run.h);
    Motion m = load(run.velocity + first);
    accelerate(run, first, h, m);
    const std::uint32_t spins = driven & which(kinds, body_kind::kSpins);
    const std::uint32_t turns = driven & which(kinds, body_kind::kTurns);
    const std::uint32_t others = turns != 0 ? turn(run, first, turns, h, m) : 0;
    store(m, run.velocity + first, driven);
    std::uint32_t rest = others | (driven & which(kinds, body_kind::kLocked));
    if (spins != 0) rest |= spins & to_bits(less(V::broadcast(run.rapid), max_abs(m.angular)));
    leave(run, first, rest, others, left);
  }

  // ---- positions

  static ISO_INLINE void integrate_positions(const BodyRun<S>& run, std::size_t first, std::size_t& left) {
    const H h = H::broadcast(run.h);
    const Motion v = load(run.velocity + first);
    const V fast = V::broadcast(run.fast);
    const Vec3<V>& w = v.angular;
    const std::uint32_t fasts = to_bits(less(fast, max(w.x, max(w.y, w.z))) | less(min(w.x, min(w.y, w.z)), -fast));
    const std::uint32_t rest = fasts | which(run.kinds + first, body_kind::kLocked);
    const std::uint32_t moves = kAll & ~rest;
    leave(run, first, rest, fasts, left);
    if (moves == 0) return;
    Motion d = load(run.displacement + first);
    // The centre follows the displacement, not the moves: where S is coarse, small moves add up before they round.
    d.linear += times(h, mean_velocity(run.flights + first, v.linear));
    d.angular += times(h, w);
    store(d, run.displacement + first, moves);
    place(run, first, d.linear, moves);
    const Vec3<U> turned = {round_product<U>(w.x, h), round_product<U>(w.y, h), round_product<U>(w.z, h)};
    BodyState<S>* const states = run.states + first;
    const Quat<U> q = integrate(orientation(states), turned, U::broadcast(Unit<S>(0.5)));
    const U rotation[4] = {q.x, q.y, q.z, q.w};
    store_rows<4, Unit<S>>([states](int i) ISO_INLINE_LAMBDA { return &states[i].orientation.x; }, rotation, moves);
  }
  /// Returns the mean velocity over the sub-step: see BodyFlight.
  static ISO_INLINE Vec3<V> mean_velocity(const BodyFlight<S>* flights, Vec3<V> v) {
    V flight[8];
    load_rows<8, Velocity<S>>([flights](int i) ISO_INLINE_LAMBDA { return &flights[i].fallen.x; }, flight);
    const Mask free = equal(v.x, flight[0]) & equal(v.y, flight[1]) & equal(v.z, flight[2]);
    const L half = L::broadcast(S(0.5));
    const Vec3<V> fall = {flight[4], flight[5], flight[6]};
    return select(free, v - times(half, fall), v);
  }
  static ISO_INLINE void place(const BodyRun<S>& run, std::size_t first, Vec3<V> displacement, std::uint32_t moves) {
    alignas(kLaneAlignment<S, W>) S at[3][W];
    const Vec3<L> by = {convert<L>(displacement.x), convert<L>(displacement.y), convert<L>(displacement.z)};
    by.x.store(at[0]);
    by.y.store(at[1]);
    by.z.store(at[2]);
    for (std::size_t i = 0; i < W; ++i) {
      if (((moves >> i) & 1u) == 0) continue;
      run.states[first + i].centre = run.start[first + i] + Vec3<S>{at[0][i], at[1][i], at[2][i]};
    }
  }
};

/// The loops over bodies. The last ones, fewer than W, take one lane each.
#define ISO_BODY_LOOP(NAME)                                                           \
  template <class S, int W, class Isa> std::size_t NAME##_of(const BodyRun<S>& run) { \
    std::size_t i = run.first, left = 0;                                              \
    for (; i + W <= run.end; i += W) BodyKernel<S, W, Isa>::NAME(run, i, left);       \
    for (; i < run.end; ++i) BodyKernel<S, 1, Isa>::NAME(run, i, left);               \
    return left;                                                                      \
  }
ISO_BODY_LOOP(integrate_velocities)
ISO_BODY_LOOP(integrate_positions)
#undef ISO_BODY_LOOP

template <class S, int W, class Isa> constexpr BodyKernels<S> make_body_kernels(const char* name) {
  return {name, W, integrate_velocities_of<S, W, Isa>, integrate_positions_of<S, W, Isa>};
}

}  // namespace

/// The kernels of one lane of a scalar: any machine.
#define ISO_DEFINE_SCALAR_BODY_KERNELS(S) \
  ISO_DEFINE_KERNEL_TABLE(BodyKernels<S>, Simd::scalar, make_body_kernels<S, 1, isa::Portable>("scalar"))

}  // namespace isostep
