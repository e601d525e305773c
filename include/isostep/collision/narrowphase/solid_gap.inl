// SolidGap<S>: the axis along which two convex solids are furthest apart, or overlap least, by supports alone.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/collision/narrowphase/epa.inl"
#include "isostep/collision/narrowphase/solid_view.hpp"

namespace isostep::detail {

/// An axis of two solids, in a's frame; points are of the cores.
template <class S> struct SolidAxis {
  using F = Finer<S>;
  Vec3<Unit<F>> normal;  // [1] from a to b
  F separation;          // [m] of the cores along it: they are no nearer
  bool is_met;           // on_a and on_b are known
  Vec3<F> on_a, on_b;    // [m] where the cores are nearest along the normal
};

/// Finds support points of the difference of two cores, b moved by `shift`. Remembers a's point for each.
template <class S> class SolidSupports {
  using F = Finer<S>;
  using U = Unit<F>;

 public:
  static constexpr std::uint32_t kMost = 160;  // GJK's 32 and EPA's 64 rounds, and what it begins with

  ISO_INLINE SolidSupports(const SolidView<S>& a, const SolidView<S>& b, const Transform<F>& b_in_a, Vec3<F> shift)
      : a_(a), b_(b), b_in_a_(b_in_a), shift_(shift) {}

  /// Returns the point furthest along the direction. A point that was found before keeps its number.
  ISO_INLINE SupportPoint<F> support(Vec3<U> direction) const {
    const Vec3<F> on_a = a_.support(direction);
    const Vec3<F> on_b = to_world(b_in_a_, b_.support(transposed_times(b_in_a_.rotation, -direction))) + shift_;
    const Vec3<F> point = on_a - on_b;
    std::uint32_t i = 0;
    while (i < count_ && !(points_[i] == point && on_a_[i] == on_a)) ++i;
    if (i == count_ && count_ < kMost) points_[count_] = point, on_a_[count_++] = on_a;
    return {point, i, i};
  }
  /// [m] Returns the nearest points on a, and on b where it is not moved.
  ISO_INLINE GjkDistance<F> witnesses(const Simplex<F>& simplex, std::int32_t rounds) const {
    Vec3<F> on_a = Vec3<F>::zero(), point = on_a;
    for (int i = 0; i < simplex.count; ++i) {
      on_a += on_a_[min(simplex.points[i].vertex_a, kMost - 1)] * simplex.shares[i];
      point += simplex.points[i].point * simplex.shares[i];
    }
    return {F(0), Vec3<U>::zero(), on_a, on_a - point - shift_, rounds, F(0)};
  }

 private:
  const SolidView<S>& a_;
  const SolidView<S>& b_;
  const Transform<F>& b_in_a_;
  const Vec3<F> shift_;  // [m]
  mutable Vec3<F> points_[kMost], on_a_[kMost];
  mutable std::uint32_t count_ = 0;
};

/// Source:  Gilbert, Johnson and Keerthi 1988; van den Bergen 2001: see gjk.hpp and epa.hpp.
/// Differs: solids that overlap are moved apart along the best axis so far, and GJK finds the direction in which they
///          are nearest then. That axis, with the solids in place, is better, or the old one stays. So the axis is a
///          local best. A point proves whether it is the best of all (is_best); else EPA searches everywhere.
/// Error:   of the separation what GJK leaves, some digits of the size; of the normal its root, over the radius of
///          round parts.
template <class S> class SolidGap {
  using F = Finer<S>;
  using U = Unit<F>;

 public:
  ISO_INLINE SolidGap(const SolidView<S>& a, const SolidView<S>& b, const Transform<S>& ta, const Transform<S>& tb)
      : a_(a), b_(b), b_in_a_(fine_relative(ta, tb)), noise_(noise_of(max_abs(b_in_a_.position))) {}

  const SolidAxis<S>& best() const { return best_; }
  /// [m] Returns the separation of the cores along n.
  ISO_INLINE F along(Vec3<U> n) const {
    const Vec3<F> on_a = a_.support(n), on_b = b_.support(transposed_times(b_in_a_.rotation, -n));
    return dot(n, b_in_a_.position + b_in_a_.rotation * on_b - on_a);
  }
  /// Takes an axis that is better by more than `lead` [m].
  ISO_INLINE bool look(Vec3<U> n, F lead = F(0)) {
    const F separation = along(n);
    if (!(separation > best_.separation + lead)) return false;
    best_ = {n, separation, false, {}, {}};
    return true;
  }
  /// Sets the points of the axis so far, where features of both cross that were found elsewhere.
  ISO_INLINE void meet(Vec3<F> on_a, Vec3<F> on_b) { best_.is_met = true, best_.on_a = on_a, best_.on_b = on_b; }

  ISO_INLINE void meet_at_supports() {
    const Vec3<F> on_b = b_.support(transposed_times(b_in_a_.rotation, -best_.normal));
    const Vec3<F> p = to_world(b_in_a_, on_b);
    meet(p - best_.normal * best_.separation, p);
  }

  /// Climbs from the best axis to the best one nearby, and finds the points where the cores are nearest along it. Ends
  /// once an axis separates the cores by more than `reach`.
  ISO_INLINE void climb(F reach, F apart) {
    for (int round = 0; round < kRounds && best_.separation <= reach; ++round) {
      const F before = best_.separation;
      const Vec3<F> shift = best_.normal * max(apart - before, F(0));
      if (!step(shift)) return;
      if (best_.separation - before <= noise_) return;
    }
  }
  /// Finds the best axis of all, for cores that overlap.
  ISO_INLINE void search_everywhere(F enough) {
    const SolidSupports<S> supports(a_, b_, b_in_a_, Vec3<F>::zero());
    Simplex<F> simplex = begin(supports, normalise(b_in_a_.position));
    GjkDistance<F> found = run(supports, simplex);
    if (found.distance == F(0)) {
      const auto axis = Epa<F, SolidSupports<S>>(supports, noise_, enough).run(simplex);
      if (axis.status == EpaStatus::flat && axis.normal == Vec3<U>::zero()) return;
      found = supports.witnesses(axis.face, 0);
      found.normal = axis.normal;
    }
    if (look(found.normal)) meet(found.on_a, found.on_b);
  }

  const Transform<F>& b_in_a() const { return b_in_a_; }

 private:
  static constexpr int kRounds = 8;
  static constexpr int kMostIterations = 32;
  static constexpr double kSharp = 0x1p-36;  // [1] of the size: 5e-6 rad of what is round

  static ISO_INLINE F noise_of(F extent) { return max(gap_noise(extent), extent * U(kSharp)); }

  static ISO_INLINE Simplex<F> begin(const SolidSupports<S>& supports, Vec3<U> normal) {
    Simplex<F> simplex = {};
    simplex.points[0] = supports.support(normal);
    keep_one(simplex, 0);
    return simplex;
  }
  /// Runs GJK like Gjk::run, but to the last digits: across round parts the normal errs by the root of the rest.
  ISO_INLINE GjkDistance<F> run(const SolidSupports<S>& supports, Simplex<F>& simplex) const {
    for (int i = 1;; ++i) {
      const Heading<F> heading = heading_of(simplex);
      if (heading.length <= noise_) return overlap(supports, simplex, simplex);
      if (i == kMostIterations) return apart(supports, simplex, heading);
      const SupportPoint<F> next = supports.support(-heading.direction);
      const bool ends = !(dot(heading.direction, next.point) < heading.length - noise_ * F(0.5));
      Simplex<F> grown = simplex;
      grown.points[grown.count++] = next;
      const bool is_out = !ends && !has(simplex, next) && shrink(grown);
      if (!ends && !has(simplex, next) && !is_out) return overlap(supports, simplex, grown);
      if (ends || !is_out || !is_nearer(grown, simplex)) return apart(supports, simplex, heading);
      simplex = grown;
    }
  }
  static ISO_INLINE GjkDistance<F> overlap(const SolidSupports<S>& supports, Simplex<F>& simplex,
                                           const Simplex<F>& last) {
    simplex = last;
    return supports.witnesses(simplex, 0);
  }
  static ISO_INLINE GjkDistance<F> apart(const SolidSupports<S>& supports, const Simplex<F>& simplex,
                                         const Heading<F>& heading) {
    GjkDistance<F> found = supports.witnesses(simplex, 0);
    found.distance = heading.length;
    found.normal = -heading.direction;
    return found;
  }
  static ISO_INLINE bool has(const Simplex<F>& simplex, const SupportPoint<F>& point) {
    for (int i = 0; i < simplex.count; ++i) {
      if (simplex.points[i].vertex_a == point.vertex_a) return true;
    }
    return false;
  }
  /// Finds the axis where b, moved, is nearest to a. Returns false if they still overlap.
  ISO_INLINE bool step(Vec3<F> shift) {
    const SolidSupports<S> supports(a_, b_, b_in_a_, shift);
    Simplex<F> simplex = begin(supports, best_.normal);
    const GjkDistance<F> found = run(supports, simplex);
    if (!(found.distance > F(0))) return false;
    look(found.normal, noise_);
    meet(found.on_a, found.on_b);
    return true;
  }

  const SolidView<S>& a_;
  const SolidView<S>& b_;
  const Transform<F> b_in_a_;
  const F noise_;  // [m]
  SolidAxis<S> best_ = {Vec3<U>::zero(), -highest<F>(), false, {}, {}};
};

}  // namespace isostep::detail
