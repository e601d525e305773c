// Joints of W trees that bound or hold a twist and a swing: their rows, and how far they are from their limits. Part of
// tree_kernel.inl, with internal linkage like it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/tree_gather.inl"
#include "isostep/dynamics/joints/turn_rows.hpp"

namespace isostep {
namespace {

/// Joints with limits on twist and swing. A limit that no speed of the sub-step reaches asks for nothing: its angle and
/// the law of its drive need not be known. Such a joint is clear.
/// Symbols: q = frame b relative to frame a, m = half the angle in the middle of the twist's range, R = a quarter of
///          that range. n = |(q_z, q_w)| is the cosine of half the swing, d = |q_w cos m + q_z sin m| is n times the
///          cosine of f, half of the twist's distance from the middle: it is within its range while f < R.
/// Why:     cosines are concave: from f to R it is at least (cos f - cos R) / (sin R + sin(R / 2)), the twist's slope,
///          and the same for a swing with the cone for R. A turn of t changes the swing by t at most, and f by t / (2
///          n) at most while n keeps its value: by less than 2 t / (3 n) if t < n / 2. So neither the turn itself nor a
///          row's speed times the sub-step (a twist's row is 1 / n long) reaches a limit. 1 - e / 2 - e^2 / 8 with e =
///          q_x^2 + q_y^2 replaces n, without a root: it is n or more; and n^2 = 1 - e where less is asked for.
template <class S, int W, class Isa> struct TreeStopper : TreeGatherer<S, W, Isa> {
  using Base = TreeGatherer<S, W, Isa>;
  using Base::load;
  using Base::number;
  using Base::store;
  using typename Base::Body;
  using typename Base::Drive;
  using typename Base::L;
  using typename Base::Mask;
  using typename Base::Memory;
  using typename Base::Node;
  using typename Base::Rows;
  using typename Base::Stops;
  using typename Base::U;
  using typename Base::V;

  /// Finds the clear joints. A joint with an active drive, or one that turns by half of what it may, is not clear.
  static ISO_INLINE void place_stops(const TreeRun<S>& run, Memory m, Step<S> h) {
    for (std::size_t j = 0; j < run.shape.joints.size(); ++j) {
      const TreeJoint& of = run.shape.joints[j];
      if (of.stops == TreeJoint::kNoStops) continue;
      Stops& stops = m.stops[of.stops];
      const Frames f = frames_of(m.bodies[of.body_a], m.bodies[of.body_b], stops);
      const V reach = reach_of(f.between, stops), turned = turn_of(of, m, h);
      reach.store(stops.reach);
      const TreeNode& node = run.shape.nodes[of.node - 1];
      std::uint32_t acting = 0;
      for (std::uint32_t d = node.first_drive; d < node.first_drive + node.drive_count; ++d)
        acting |= run.drives[d].now.fixed();
      run.clear[j] = to_bits(less(turned + turned, reach)) & ~acting;
      if (!Base::is_clear(run, node)) write_rows(run, j, f, m, h);
    }
  }
  /// Returns true if a joint turns too fast to stay clear. Computes the rows of such joints.
  static ISO_INLINE bool find_reached(const TreeRun<S>& run, Memory m, Step<S> h) {
    bool some = false;
    for (std::size_t j = 0; j < run.shape.joints.size(); ++j) {
      if (run.clear[j] == 0) continue;
      const TreeJoint& of = run.shape.joints[j];
      Stops& stops = m.stops[of.stops];
      const std::uint32_t stays = to_bits(less(turn_of(of, m, h), V::load(stops.reach)));
      if ((run.clear[j] & ~stays) == 0) continue;
      run.clear[j] &= stays;
      write_rows(run, j, frames_of(m.bodies[of.body_a], m.bodies[of.body_b], stops), m, h);
      some = true;
    }
    return some;
  }

  /// Stores by how much a body has turned since the orientation in its lanes: twice the sines of half the turn.
  static ISO_INLINE void turn_since(Body& body, const Quat<U>& now) {
    const Quat<U> turn = now * conjugate(rotation(body.orientation));
    const auto back = less(turn.w, U::zero());
    const auto part = [&](U x) ISO_INLINE_LAMBDA {
      const V half = convert<V>(select(back, -x, x));
      return half + half;
    };
    store(Vec3<V>{part(turn.x), part(turn.y), part(turn.z)}, body.turned);
  }

  static ISO_INLINE Mat3<U> matrix_of(Quat<U> q) { return to_matrix(q, U::broadcast(Unit<S>(1))); }

 private:
  struct Frames {
    Quat<U> a, b, between;
  };  // to world; b seen from a

  static ISO_INLINE Quat<U> rotation(const Unit<S> (&field)[4][W]) {
    return {U::load(field[0]), U::load(field[1]), U::load(field[2]), U::load(field[3])};
  }
  static ISO_INLINE Frames frames_of(const Body& a, const Body& b, const Stops& stops) {
    Frames f;
    f.a = rotation(a.orientation) * rotation(stops.frame_a);
    f.b = rotation(b.orientation) * rotation(stops.frame_b);
    f.between = conjugate(f.a) * f.b;
    return f;
  }
  /// [rad] Returns a quarter of the turn that reaches no limit, in the unit of turn_of().
  static ISO_INLINE V reach_of(const Quat<U>& q, const Stops& stops) {
    const L one = number(S(1)), half = number(S(0.5));
    const L e = one * round_to<U>(product(q.x, q.x) + product(q.y, q.y)), half_e = half * e;
    const L n = one - half_e - half * (half_e * half_e);
    const U along = round_to<U>(product(q.w, U::load(stops.middle[0])) + product(q.z, U::load(stops.middle[1])));
    const L twist = (one * max(along, -along) - L::load(stops.twist) * n) * L::load(stops.twist_slope);
    const L swing = (one - (e + e) - L::load(stops.swing)) * L::load(stops.swing_slope);
    const L most = half * (one - e);
    // Rounding changes orientations and cosines by less than 2^-8.
    return convert<V>(number(S(0.25)) * (min(most, min(twist, swing)) - number(S(0x1p-8))));
  }
  /// [rad] Returns a quarter of the angle by which a joint's bodies turn against each other in a sub-step, or more: a
  /// vector is shorter than twice its largest component.
  static ISO_INLINE V turn_of(const TreeJoint& of, Memory m, Step<S> h) {
    const L half = number(S(0.5) * h);
    const auto turned = [half](V w) ISO_INLINE_LAMBDA { return round_to<V>(product(half, w)); };
    const Vec3<V> a = load(m.bodies[of.body_a].angular), b = load(m.bodies[of.body_b].angular);
    return max_abs(Vec3<V>{turned(b.x) - turned(a.x), turned(b.y) - turned(a.y), turned(b.z) - turned(a.z)});
  }

  // ---- rows, as turn_rows.hpp has them

  static ISO_INLINE Vec3<L> levers(Vec3<U> axis, L radius) {
    return {convert<L>(axis.x) * radius, convert<L>(axis.y) * radius, convert<L>(axis.z) * radius};
  }
  static ISO_INLINE void store_row(Vec3<L> row, std::size_t place, Rows& rows) {
    ISO_UNROLL for (std::size_t k = 0; k < 3; ++k) {
      row[static_cast<int>(k)].store(rows.angular_a[3 * place + k]);
      row[static_cast<int>(k)].store(rows.angular_b[3 * place + k]);
    }
  }
  static ISO_INLINE void write_rows(const TreeRun<S>& run, std::size_t j, const Frames& f, Memory m, Step<S> h) {
    const TreeJoint& of = run.shape.joints[j];
    const TreeNode& node = run.shape.nodes[of.node - 1];
    const Stops& stops = m.stops[of.stops];
    Rows& rows = m.rows[node.rows];
    const Mat3<U> a = matrix_of(f.a);
    const Vec3<U> zb = matrix_of(f.b).column(2);
    if (!node.may_idle) {
      write_hinge(stops, a, zb, h, rows, m.nodes[of.node - 1]);
      if (node.drive_count > 0) measure_twist(run, j, f.between, number(S(1)), m);
      return;
    }
    const Vec3<U> za = a.column(2);
    measure_twist(run, j, f.between, write_twist(stops, za, zb, rows), m);
    const Vec3<U> n = cross(za, zb);
    const Direction<U> axis = direction_where(all_lanes(), n.x, n.y, n.z);
    store_row(levers({axis.x, axis.y, axis.z}, L::load(stops.swing_radius)), 0, rows);
    measure_swing(run, j, axis.length, dot(za, zb), m);
  }
  static ISO_INLINE typename U::Mask all_lanes() { return U::Mask::from_bits(Base::kAll); }
  static ISO_INLINE void write_hinge(const Stops& stops, const Mat3<U>& a, Vec3<U> zb, Step<S> h, Rows& rows,
                                     Node& node) {
    const L radius = L::load(stops.radius), most = number(S(32) * h);
    store_row(levers(a.column(0), radius), 0, rows);
    store_row(levers(a.column(1), radius), 1, rows);
    store_row(levers(a.column(2), L::load(stops.twist_radius)), 2, rows);
    const auto error = [most](L e) ISO_INLINE_LAMBDA { return convert<V>(clamp(e, -most, most)); };
    const Vec3<U> tilt = transposed_times(a, zb);
    const U more = select(less(tilt.x, U::zero()), tilt.z, -tilt.z);  // part_across()
    const U across = tilt.x + select(less(tilt.z, U::zero()), more, U::zero());
    store(Vec3<V>{error(-(radius * tilt.y)), error(radius * across), V::zero()}, node.error);
  }
  /// Writes the row of the twist. Returns the cosine of half the swing, at least kLeastTwistCosine.
  static ISO_INLINE L write_twist(const Stops& stops, Vec3<U> za, Vec3<U> zb, Rows& rows) {
    const U half = U::broadcast(Unit<S>(0.5));
    const Vec3<U> sum = za * half + zb * half;
    const Direction<U> mean = direction_where(all_lanes(), sum.x, sum.y, sum.z);
    const L cosine = max(convert<L>(mean.length), number(detail::kLeastTwistCosine<S>));
    const L radius = quotient_where<L>(less(L::zero(), cosine), L::load(stops.twist_radius), cosine);
    store_row(levers({mean.x, mean.y, mean.z}, radius), 2, rows);
    return cosine;
  }

  // ---- how far from their limits drives are, in lanes that are not clear

  /// Does set_angle() of joint_frames.hpp. Where a twist has no meaning, no limit acts, and one that acted stops.
  static ISO_INLINE void measure_twist(const TreeRun<S>& run, std::size_t j, const Quat<U>& q, L cosine, Memory m) {
    const TreeJoint& of = run.shape.joints[j];
    const Stops& stops = m.stops[of.stops];
    const std::uint32_t d = run.shape.nodes[of.node - 1].first_drive;
    alignas(kLaneAlignment<S, W>) Unit<S> sine[W], unit[W];
    alignas(kLaneAlignment<S, W>) S least[W];
    q.z.store(sine);
    q.w.store(unit);
    cosine.store(least);
    for (std::uint32_t left = Base::kAll & ~run.clear[j]; left != 0; left &= left - 1) {
      const int i = first_bit(left);
      const bool means = detail::kLeastTwistCosine<S> < least[i];
      if (!means || stops.twist[i] == kNoCosine<S>) {
        m.drives[d].above_lower[i] = m.drives[d].below_upper[i] = highest<S>();
        run.drives[d].now.clear(1u << i);
        continue;
      }
      const bool turned = unit[i] < Unit<S>(0);
      S angle = S(2) * atan2_to<S>(turned ? -sine[i] : sine[i], turned ? -unit[i] : unit[i]);
      const S lower = stops.lower[i], upper = stops.upper[i], radius = stops.twist_radius[i];
      const S from_middle = angle - (lower + upper) * S(0.5), turn = S(6.283185307179586);
      if (turn * S(0.5) < from_middle) angle -= turn;
      if (from_middle < turn * S(-0.5)) angle += turn;
      m.drives[d].above_lower[i] = angle * radius - lower * radius;
      m.drives[d].below_upper[i] = upper * radius - angle * radius;
    }
  }
  static ISO_INLINE void measure_swing(const TreeRun<S>& run, std::size_t j, U sine, U cosine, Memory m) {
    const TreeJoint& of = run.shape.joints[j];
    const Stops& stops = m.stops[of.stops];
    const std::uint32_t d = run.shape.nodes[of.node - 1].first_drive + 1;
    alignas(kLaneAlignment<S, W>) Unit<S> y[W], x[W];
    sine.store(y);
    cosine.store(x);
    for (std::uint32_t left = Base::kAll & ~run.clear[j]; left != 0; left &= left - 1) {
      const int i = first_bit(left);
      const S radius = stops.swing_radius[i];
      const bool bounded = !(stops.swing[i] == kNoCosine<S>);
      m.drives[d].above_lower[i] = highest<S>();
      m.drives[d].below_upper[i] = bounded ? stops.cone[i] * radius - atan2_to<S>(y[i], x[i]) * radius : highest<S>();
    }
  }
};

}  // namespace
}  // namespace isostep
