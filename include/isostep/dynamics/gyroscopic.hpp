// The gyroscopic term, by the midpoint rule: a spinning top precesses, and free turning keeps momentum and energy.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/mat3.hpp"
#include "isostep/scalar/headroom.hpp"

namespace isostep {

/// The pace of a body that is not slow. Fast: it turns by more than an eighth of a radian in an integration step.
enum class Pace { brisk, fast };

/// The angular velocity of a slow solid after a free turn, in the world and in the principal frame [rad/s].
template <class V> struct SlowTurn { Vec3<V> angular_velocity, known; };

namespace detail {
/// Returns the change of the angular velocity w by Euler's equations, in the principal frame, over h.
template <class S, class V, class H> ISO_INLINE Vec3<V> explicit_change(Vec3<S> euler, Vec3<V> w, H h) {
  const auto times = [](auto a, V b) ISO_INLINE_LAMBDA { return round_to<V>(product(a, b)); };
  const Vec3<V> hw = {times(h, w.x), times(h, w.y), times(h, w.z)};
  return {times(euler.x, times(hw.y, w.z)), times(euler.y, times(hw.z, w.x)), times(euler.z, times(hw.x, w.y))};
}
}  // namespace detail

/// Turns a slow solid freely over h, by at most a sixteenth of a radian in a step of the world. FreeTurn explains this
/// form. Takes numbers or lanes; `half` is one half in each lane.
template <class U, class S, class V, class H>
ISO_INLINE SlowTurn<V> slow_turn(const Mat3<U>& axes, Vec3<S> euler, Vec3<V> angular_velocity, H h, S half) {
  const auto halved = [half](V x) ISO_INLINE_LAMBDA { return round_to<V>(product(half, x)); };
  const Vec3<V> w = transposed_times(axes, angular_velocity), all = detail::explicit_change(euler, w, h);
  const Vec3<V> change = -detail::explicit_change(euler, w + Vec3<V>{halved(all.x), halved(all.y), halved(all.z)}, h);
  return {angular_velocity - axes * change, w - change};
}

/// Torque-free rotation over time steps h, between which other forces push.
///
/// One step: I (w' - w) + h m x I m = 0, m = (w + w') / 2, in the principal frame. The rule conserves |I w| and w I w;
/// with w' in place of m a box at 10 rad/s loses a third of its energy in ten seconds. A slow solid takes the explicit
/// form, m at half of Euler's step: within a sixteenth of a radian about each world axis a box gains at most 1.2e-5 of
/// its energy in a step, the flattest strip 1.3e-4. Others take one Newton step, which conserves both to third order:
/// at a radian a sub-step, the most that a body turns, energy swings by 6 %. A fast body is scaled back to its energy.
///
/// Pushes: the orientation follows w' as if it were the angular velocity half a step later, so momentum is I w' + h/2
/// w' x I w'. A push of k after the step adds more to that than the torque h^-1 I k, and a fast top under torque would
/// sink as if braked. So the excess, h/2 (f(w' + k) - f(w')) with f(w) = w x I w, is taken back once k is known. For a
/// fast body that is no small change: it must not add energy.
/// Source:  Catto 2015, Numerical Methods (GDC), implicit gyroscopic torque; Hairer, Lubich, Wanner 2006, Geometric
///          Numerical Integration, on quadratic invariants; Lee, Leok, McClamroch 2005, A Lie group variational
///          integrator for the attitude dynamics of a rigid body, on momentum between two orientations.
/// Symbols: inertia = principal moments over the largest of them [1]; only ratios matter, so no unit is needed. euler =
///          (I_y - I_z) / I_x and so on cyclically [1]: Euler's equations are dw_x/dt = euler_x w_y w_z.
/// Frames:  `axes` leads from the principal frame to the world. Angular velocities in and out are in the world [rad/s].
///          `known`, in the principal frame, is the value after the last step: the difference is the pushes since.
template <class S> struct FreeTurn {
  using V = Velocity<S>;
  const Mat3<Unit<S>>& axes;
  Vec3<S> inertia, euler;
  Step<S> h;

  static ISO_INLINE Vec3<S> euler_of(Vec3<S> i) {
    const auto ratio = [](S over, S under) { return S(0) < under ? divide_to<S>(over, under) : S(0); };
    return {ratio(i.y - i.z, i.x), ratio(i.z - i.x, i.y), ratio(i.x - i.y, i.z)};
  }
  /// Returns true if the ratios are those of a solid: at most 1, rounding aside. A user's moments may be of no solid.
  static ISO_INLINE bool is_solid(Vec3<S> euler) { return held_within(euler, S(2)) == euler; }

  /// Turns over a step. First takes back the excess of pushes since the last step. Rounding by the axes is no push:
  /// taken for one it feeds on itself.
  ISO_INLINE Vec3<V> turn(Vec3<V> angular_velocity, Vec3<V>& known, Pace pace) const {
    const Vec3<V> w = local(angular_velocity);
    Vec3<V> change = implicit_change(w, known);
    if (pace == Pace::fast) change = w - with_energy_of(w, w - change, false);
    known = w - change;
    return angular_velocity - world(change);
  }
  /// Only takes back the excess, when no step follows.
  ISO_INLINE Vec3<V> settle(Vec3<V> angular_velocity, Vec3<V> known, Pace pace) const {
    const Vec3<V> w = local(angular_velocity);
    Vec3<V> change = solve(w, half(bend(w) - bend(known)));
    if (pace == Pace::fast) change = w - with_energy_of(w, w - change, true);
    return angular_velocity - world(change);
  }
  ISO_INLINE Vec3<V> local(Vec3<V> angular_velocity) const { return transposed_times(axes, angular_velocity); }

 private:
  /// Returns `w` scaled to the energy of `like`, rounding aside, unless it may have less.
  ISO_INLINE Vec3<V> with_energy_of(Vec3<V> like, Vec3<V> w, bool may_have_less) const {
    const Vec3<S> roots = {sqrt(inertia.x), sqrt(inertia.y), sqrt(inertia.z)};
    const auto root_of_energy = [&](Vec3<V> v) ISO_INLINE_LAMBDA {
      return length(Vec3<V>{times(roots.x, v.x), times(roots.y, v.y), times(roots.z, v.z)});
    };
    const V wanted = root_of_energy(like), is = root_of_energy(w);
    if (may_have_less && !(wanted < is)) return w;
    if (!(half(wanted) < is)) return like;  // nothing that a step does
    const S scale = divide_to<S>(wanted, is);
    const auto scaled = [scale](V x) ISO_INLINE_LAMBDA { return round_with_headroom<V>(product(scale, x)); };
    return {scaled(w.x), scaled(w.y), scaled(w.z)};
  }
  static ISO_INLINE V half(V x) { return round_to<V>(product(S(0.5), x)); }
  static ISO_INLINE Vec3<V> half(Vec3<V> x) { return {half(x.x), half(x.y), half(x.z)}; }
  template <class A> static ISO_INLINE V times(A a, V b) { return round_to<V>(product(a, b)); }
  ISO_INLINE Vec3<V> moment(Vec3<V> w) const {
    return {times(inertia.x, w.x), times(inertia.y, w.y), times(inertia.z, w.z)};
  }
  ISO_INLINE Vec3<V> turned(Vec3<V> w) const { return {times(h, w.x), times(h, w.y), times(h, w.z)}; }  // [rad]
  /// Returns h f(w), within half of the format: a pass may leave speeds beyond the limit, which are cut after the step.
  ISO_INLINE Vec3<V> bend(Vec3<V> w) const {
    const Vec3<V> m = moment(w), hw = turned(w);
    return {round_with_headroom<V>(product(hw.y, m.z) - product(hw.z, m.y)),
            round_with_headroom<V>(product(hw.z, m.x) - product(hw.x, m.z)),
            round_with_headroom<V>(product(hw.x, m.y) - product(hw.y, m.x))};
  }
  ISO_INLINE Vec3<V> implicit_change(Vec3<V> w, Vec3<V> known) const {
    const Vec3<V> f = bend(w);
    const bool pushed = convert<V>(S(64) * resolution<S>()) < max_abs(w - known);
    return solve(w, pushed ? f + half(f - bend(known)) : f);
  }
  /// Returns J^-1 f, J = I + h/2 ([w]x I - [I w]x).
  ISO_INLINE Vec3<V> solve(Vec3<V> w, Vec3<V> f) const {
    const auto halved = [](V x) { return convert<S>(half(x)); };
    const Vec3<V> hw = turned(w), hm = turned(moment(w));
    const Vec3<S> ix = inertia;
    const Vec3<S> a = {halved(hw.x), halved(hw.y), halved(hw.z)}, m = {halved(hm.x), halved(hm.y), halved(hm.z)};
    const Mat3<S> j = {{{ix.x, m.z - a.z * ix.y, a.y * ix.z - m.y},
                        {a.z * ix.x - m.z, ix.y, m.x - a.x * ix.z},
                        {m.y - a.y * ix.x, a.x * ix.y - m.x, ix.z}}};
    const Vec3<S> c0 = j.column(0), c1 = j.column(1), c2 = j.column(2);
    const Vec3<S> n12 = cross(c1, c2), n20 = cross(c2, c0), n01 = cross(c0, c1);
    const S determinant = dot(c0, n12);
    if (!(abs(determinant) > resolution<S>())) return Vec3<V>::zero();
    const auto part = [&](Vec3<S> n) { return divide_to<V>(round_to<V>(dot_sum(n, f)), convert<V>(determinant)); };
    return {part(n12), part(n20), part(n01)};
  }
  /// Transforms changes only: the axes are not quite of unit length, and a whole velocity would grow with them.
  ISO_INLINE Vec3<V> world(Vec3<V> change) const { return axes * change; }
};

}  // namespace isostep
