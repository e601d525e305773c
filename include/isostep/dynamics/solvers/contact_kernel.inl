// The contact kernel of the soft step: W contacts side by side, written once for every scalar and instruction set.
// Included by one file per instruction set; everything here is inline or has internal linkage, so that no copy compiled
// for one instruction set can serve another.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/contact_kernels.hpp"
#include "isostep/dynamics/solvers/contact_prepare.inl"
#include "isostep/dynamics/solvers/contact_store.inl"
#include "isostep/scalar/lanes.hpp"

namespace isostep {
namespace {

/// Brings friction of the contacts whose bits are set into their ellipses: `resting`, what brings rows to rest, or,
/// where that is outside, what a step that is equal for both rows leads to.
template <class S, int W, class V>
ISO_NOINLINE void hold_in_ellipses(const Unit<S> (&ratio)[W], std::uint32_t bits, const V& limit, const V (&equal)[2],
                                   V (&resting)[2]) {
  alignas(kLaneAlignment<S, W>) Velocity<S> most[W], rest[2][W], step[2][W];
  limit.store(most);
  for (int k = 0; k < 2; ++k) {
    resting[k].store(rest[k]);
    equal[k].store(step[k]);
  }
  for (int i = 0; i < W; ++i) {
    if (((bits >> i) & 1u) == 0) continue;
    Velocity<S> x = rest[0][i], y = rest[1][i];
    if (!hold_impulse_in_ellipse<S>(ratio[i], most[i], x, y)) continue;
    rest[0][i] = step[0][i];
    rest[1][i] = step[1][i];
    hold_impulse_in_ellipse<S>(ratio[i], most[i], rest[0][i], rest[1][i]);
  }
  for (int k = 0; k < 2; ++k) resting[k] = V::load(rest[k]);
}

/// Source:  Catto 2024, Solver2D: Soft Step. Impulses are velocity changes of the reduced mass, so that every
///          coefficient is near one at any masses.
/// Symbols: n = normal from a to b, v, w = linear and angular velocity, d = displacement since the step began, lambda =
///          impulse.
/// Order:   a biased pass solves tangents, then normals: non-penetration has the last word. A relaxed pass solves
///          normals, then tangents: the normal impulse without the push bounds friction. Lanes never interact.
template <class S, int W, class Isa, int P, bool Rolling> struct ContactKernel {
  using L = Lanes<S, W, Isa>;
  using V = Lanes<Velocity<S>, W, Isa>;
  using U = Lanes<Unit<S>, W, Isa>;
  using Block = std::conditional_t<Rolling, RollingBlock<S, W, P>, ContactBlock<S, W, P>>;

  struct Motion {
    V linear[3], angular[3];
  };
  struct Shares {
    L a, b;
  };

  static ISO_INLINE Motion gather(const MotionRow<Velocity<S>>* rows, const std::uint32_t* index) {
    const Velocity<S>* pointers[W];
    for (int i = 0; i < W; ++i) pointers[i] = &rows[index[i]].linear.x;
    V all[8];
    load_transposed<8>(pointers, all);
    return {{all[0], all[1], all[2]}, {all[4], all[5], all[6]}};
  }
  static ISO_INLINE void scatter(MotionRow<Velocity<S>>* rows, const std::uint32_t* index, std::uint32_t mask,
                                 const Motion& m) {
    Velocity<S>* pointers[W];
    for (int i = 0; i < W; ++i) pointers[i] = &rows[index[i]].linear.x;
    const V zero = V::zero();
    const V all[8] = {m.linear[0], m.linear[1], m.linear[2], zero, m.angular[0], m.angular[1], m.angular[2], zero};
    store_transposed<8>(pointers, all, mask);
  }
  template <class A> static ISO_INLINE V times(A a, V b) { return round_product<V>(a, b); }

  /// Returns b's angular part of the row minus a's. One product at a time: gcc keeps all terms of a single expression.
  static ISO_INLINE auto angular_sum(const AngularRow<S, W>& row, const Motion& a, const Motion& b) {
    auto sum = product(L::load(row.jacobian_b[0]), b.angular[0]);
    for (int i = 1; i < 3; ++i) sum += product(L::load(row.jacobian_b[i]), b.angular[i]);
    for (int i = 0; i < 3; ++i) sum -= product(L::load(row.jacobian_a[i]), a.angular[i]);
    return sum;
  }
  /// Returns the speed (or displacement) of b against a along the row.
  static ISO_INLINE V along(const S (&direction)[3][W], const AngularRow<S, W>& row, const Motion& a, const Motion& b) {
    auto sum = product(L::load(direction[0]), b.linear[0] - a.linear[0]);
    for (int i = 1; i < 3; ++i) sum += product(L::load(direction[i]), b.linear[i] - a.linear[i]);
    return round_to<V>(sum + angular_sum(row, a, b));
  }
  static ISO_INLINE void turn(const AngularRow<S, W>& row, V impulse, Motion& a, Motion& b) {
    for (int i = 0; i < 3; ++i) {
      a.angular[i] = a.angular[i] - times(L::load(row.response_a[i]), impulse);
      b.angular[i] = b.angular[i] + times(L::load(row.response_b[i]), impulse);
    }
  }
  static ISO_INLINE void push(const S (&direction)[3][W], const AngularRow<S, W>& row, const Shares& share, V impulse,
                              Motion& a, Motion& b) {
    const V to_a = times(share.a, impulse);
    const V to_b = times(share.b, impulse);
    for (int i = 0; i < 3; ++i) {
      const L d = L::load(direction[i]);
      a.linear[i] = a.linear[i] - times(d, to_a);
      b.linear[i] = b.linear[i] + times(d, to_b);
    }
    turn(row, impulse, a, b);
  }
  /// Stores an accumulated impulse, `wanted` within +-limit. Returns its change.
  static ISO_INLINE V accumulate(AngularRow<S, W>& row, V wanted, V limit) {
    const V next = clamp(wanted, V::zero() - limit, limit);
    const V change = next - V::load(row.impulse);
    next.store(row.impulse);
    return change;
  }

  static ISO_INLINE ContactBlock<S, W, P>& contact_of(Block& block) {
    if constexpr (Rolling) return block.contact;
    if constexpr (!Rolling) return block;
  }
  static ISO_INLINE V total_normal_impulse(const ContactBlock<S, W, P>& c) {
    V total = V::load(c.normals[0].row.impulse);
    for (int p = 1; p < P; ++p) total = total + V::load(c.normals[p].row.impulse);
    return total;
  }

  struct PassLanes {
    L bias_rate, mass_scale, impulse_scale, rate, one;
    V push_speed, max_separation, max_load;
  };
  static ISO_INLINE PassLanes lanes_of(const ContactPass<S>& pass) {
    return {L::broadcast(pass.softness.bias_rate),
            L::broadcast(pass.softness.mass_scale),
            L::broadcast(pass.softness.impulse_scale),
            L::broadcast(pass.rate),
            L::broadcast(S(1)),
            V::broadcast(pass.push_speed),
            V::broadcast(pass.max_separation),
            V::broadcast(pass.max_load)};
  }

  static ISO_INLINE void solve_tangents(ContactBlock<S, W, P>& c, const Shares& share, const PassLanes& pass, Motion& a,
                                        Motion& b) {
    const V load = min(total_normal_impulse(c), pass.max_load);
    AngularRow<S, W>& twist = c.twist;
    const V spin = round_to<V>(angular_sum(twist, a, b)) + V::load(c.spin);
    const V stopping = V::load(twist.impulse) - times(L::load(twist.effective_mass), spin);
    turn(twist, accumulate(twist, stopping, times(L::load(c.twist_friction), load)), a, b);
    const V limit = times(L::load(c.friction), load);
    V wanted[2], slip[2];
    for (int k = 0; k < 2; ++k) {
      const FrictionRow<S, W>& tangent = c.tangents[k];
      slip[k] = along(tangent.direction, tangent.row, a, b) + V::load(tangent.surface);
      wanted[k] = V::load(tangent.row.impulse) - times(L::load(tangent.row.effective_mass), slip[k]);
    }
    // The cone as a polygon of 16 sides inside it, x + tan(pi/16) y <= limit and (cos(3 pi/16) x + sin(3 pi/16) y) /
    // cos(pi/16) <= limit where x is the larger. Exact along either axis, and the basis lies along the friction; 2 %
    // short at most. What is beyond keeps its direction.
    const V of_t = abs(wanted[0]), of_u = abs(wanted[1]);
    const V x = max(of_t, of_u), y = min(of_t, of_u);
    const V size =
        max(x + times(L::broadcast(S(0.19891236737965800691)), y),
            times(L::broadcast(S(0.84775906502257351226)), x) + times(L::broadcast(S(0.56645449735052153652)), y));
    auto slides = less(limit, size);
    const auto grained = less(U::load(c.ratio), U::broadcast(Unit<S>(1)));
    if (any(grained)) {
      const L step = min(L::load(c.tangents[0].row.effective_mass), L::load(c.tangents[1].row.effective_mass));
      const V equal[2] = {V::load(c.tangents[0].row.impulse) - times(step, slip[0]),
                          V::load(c.tangents[1].row.impulse) - times(step, slip[1])};
      hold_in_ellipses<S>(c.ratio, to_bits(grained), limit, equal, wanted);
      slides = slides & ~grained;
    }
    if (any(slides)) {
      const L part = quotient_where<L>(slides, limit, size);
      for (V& w : wanted) w = select(slides, times(part, w), w);
    }
    for (int k = 0; k < 2; ++k) {
      FrictionRow<S, W>& tangent = c.tangents[k];
      push(tangent.direction, tangent.row, share, accumulate(tangent.row, wanted[k], limit), a, b);
    }
  }
  static ISO_INLINE void solve_rolling(Block& block, Motion& a, Motion& b) {
    if constexpr (Rolling) {
      const V limit = times(L::load(block.rolling.lever), total_normal_impulse(block.contact));
      for (AngularRow<S, W>& row : block.rolling.rows) {
        const V speed = round_to<V>(angular_sum(row, a, b));
        const V wanted = V::load(row.impulse) - times(L::load(row.effective_mass), speed);
        turn(row, accumulate(row, wanted, limit), a, b);
      }
    }
  }

  /// Solves the normals. A biased pass pushes overlaps apart softly, at a bounded speed. A relaxed pass does not, so
  /// that no push stays as speed. In either a gap may at most close. An open gap of a contact that may bounce only
  /// gives back impulse in a relaxed pass: if it closes, the next sub-step handles that and sees it bounce. In the
  /// other passes this would stop one corner of a flat fall and not another that is open by rounding.
  template <bool Relax>
  static ISO_INLINE void solve_normals(ContactBlock<S, W, P>& c, const Shares& share, const PassLanes& pass,
                                       const Motion& da, const Motion& db, Motion& a, Motion& b) {
    for (NormalRow<S, W>& n : c.normals) {
      // No deeper than what pushes at full speed anyway: times a high rate it fits.
      const V separation = max(V::load(n.separation) + along(c.normal, n.row, da, db), V::zero() - pass.max_separation);
      const V gap = times(pass.rate, min(separation, pass.max_separation));
      const V old = V::load(n.row.impulse);
      V change;
      if constexpr (Relax) {
        const V speed = along(c.normal, n.row, a, b) + max(gap, V::zero());
        change = times(L::load(n.row.effective_mass), speed);
        change = select(less(V::load(c.left_gap), separation), max(change, V::zero()), change);
      } else {
        const auto apart = less(V::zero(), separation);
        const V overlap = max(times(pass.bias_rate, separation), V::zero() - pass.push_speed);
        const V speed = along(c.normal, n.row, a, b) + select(apart, gap, overlap);
        const L mass_scale = select(apart, pass.one, pass.mass_scale);
        const L impulse_scale = select(apart, L::zero(), pass.impulse_scale);
        change = times(mass_scale, times(L::load(n.row.effective_mass), speed)) + times(impulse_scale, old);
      }
      const V next = max(old - change, V::zero());
      next.store(n.row.impulse);
      push(c.normal, n.row, share, next - old, a, b);
    }
  }

  static void warm_start(const BlockRun<S>& run) {
    for (std::int32_t i = 0; i < run.count; ++i) {
      Block& block = static_cast<Block*>(run.blocks)[i];
      ContactBlock<S, W, P>& c = contact_of(block);
      const BlockBodies& bodies = run.bodies[i];
      Motion a = gather(run.velocity, bodies.a), b = gather(run.velocity, bodies.b);
      const Shares share = {L::load(c.share_a), L::load(c.share_b)};
      turn(c.twist, V::load(c.twist.impulse), a, b);
      for (const FrictionRow<S, W>& t : c.tangents) push(t.direction, t.row, share, V::load(t.row.impulse), a, b);
      if constexpr (Rolling) {
        for (const AngularRow<S, W>& row : block.rolling.rows) turn(row, V::load(row.impulse), a, b);
      }
      for (NormalRow<S, W>& n : c.normals) {
        const V impulse = V::load(n.row.impulse);
        (V::load(n.total_impulse) + impulse).store(n.total_impulse);
        push(c.normal, n.row, share, impulse, a, b);
      }
      scatter(run.velocity, bodies.a, bodies.write_a, a);
      scatter(run.velocity, bodies.b, bodies.write_b, b);
    }
  }

  template <bool Relax> static void solve(const BlockRun<S>& run, const ContactPass<S>& pass) {
    const PassLanes lanes = lanes_of(pass);
    for (std::int32_t i = 0; i < run.count; ++i) {
      Block& block = static_cast<Block*>(run.blocks)[i];
      ContactBlock<S, W, P>& c = contact_of(block);
      const BlockBodies& bodies = run.bodies[i];
      Motion a = gather(run.velocity, bodies.a), b = gather(run.velocity, bodies.b);
      const Motion da = gather(run.displacement, bodies.a), db = gather(run.displacement, bodies.b);
      const Shares share = {L::load(c.share_a), L::load(c.share_b)};
      if constexpr (Relax) solve_normals<true>(c, share, lanes, da, db, a, b);
      solve_rolling(block, a, b);
      solve_tangents(c, share, lanes, a, b);
      if constexpr (!Relax) solve_normals<false>(c, share, lanes, da, db, a, b);
      scatter(run.velocity, bodies.a, bodies.write_a, a);
      scatter(run.velocity, bodies.b, bodies.write_b, b);
    }
  }
};

template <class S, int W, class Isa> constexpr ContactKernels<S> make_contact_kernels(const char* name) {
  ContactKernels<S> table = {name, W, &ContactPreparer<S, W, Isa>::prepare, &ContactStorer<S, W, Isa>::store, {},
                             {},   {}};
  const auto fill = [&]<int P, bool Rolling>() {
    using Kernel = ContactKernel<S, W, Isa, P, Rolling>;
    const int variant = (Rolling ? kMaxContactPoints : 0) + P - 1;
    table.warm_start[variant] = &Kernel::warm_start;
    table.solve[variant] = &Kernel::template solve<false>;
    table.relax[variant] = &Kernel::template solve<true>;
  };
  fill.template operator()<1, false>();
  fill.template operator()<2, false>();
  fill.template operator()<3, false>();
  fill.template operator()<4, false>();
  fill.template operator()<1, true>();
  fill.template operator()<2, true>();
  fill.template operator()<3, true>();
  fill.template operator()<4, true>();
  return table;
}

}  // namespace

/// The kernels of one lane of a scalar: any machine.
#define ISO_DEFINE_SCALAR_CONTACT_KERNELS(S) \
  ISO_DEFINE_KERNEL_TABLE(ContactKernels<S>, Simd::scalar, make_contact_kernels<S, 1, isa::Portable>("scalar"))

}  // namespace isostep
