// Makes the blocks that the kernel reads from contacts' geometry: W contacts at once, written once for every scalar and
// instruction set. Part of contact_kernel.inl, with internal linkage like it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "isostep/dynamics/contact_friction.hpp"
#include "isostep/dynamics/solvers/contact_kernels.hpp"
#include "isostep/math/lanes_select.hpp"
#include "isostep/math/mat3.hpp"
#include "isostep/scalar/lanes_math.hpp"

namespace isostep {
namespace {

/// Prepares W contacts. Every lane has the bits of W = 1: branches are selections, skipped if no lane needs them.
/// Symbols: n = normal from a to b, arm = from a body's centre of mass to a point, kappa = mass times inverse inertia.
template <class S, int W, class Isa> struct ContactPreparer {
  using L = Lanes<S, W, Isa>;
  using V = Lanes<Velocity<S>, W, Isa>;
  using U = Lanes<Unit<S>, W, Isa>;
  using Mask = typename L::Mask;
  using Block = ContactBlock<S, W, kMaxContactPoints>;  // its first `points` normals alone are there
  using Row = AngularRow<S, W>;
  using Geometry = ContactGeometry<S>;
  using Point = typename Geometry::Point;

  struct Body {
    Vec3<V> velocity, angular_velocity;
    L mass;
    Mat3<L> kappa;
    Mask moves;
  };
  struct Impulses {
    V normal[kMaxContactPoints];
    Vec3<V> friction;
    V twist;
  };
  struct Materials {
    L friction, rolling, spin;
    Vec3<L> surface;
  };
  struct Arms {
    Vec3<L> a, b;
  };

  static_assert(sizeof(Block) == W * sizeof(ContactBlock<S, 1, kMaxContactPoints>), "words of lanes and nothing else");

  // ---- gathering: the records are read in runs of four and eight words, which transpose by whole registers

  static_assert(offsetof(Contact<S>, friction_impulse) == offsetof(Contact<S>, normal_impulse) + 4 * sizeof(S));
  static_assert(offsetof(Contact<S>, twist_impulse) == offsetof(Contact<S>, normal_impulse) + 7 * sizeof(S));
  static_assert(sizeof(Point) == 7 * sizeof(S) && sizeof(SolverMass<S>) == 10 * sizeof(S));
  static_assert(offsetof(Geometry, material) == offsetof(Geometry, points) + kMaxContactPoints * sizeof(Point));
  static_assert(offsetof(Geometry, ratio) == offsetof(Geometry, axis) + sizeof(Vec3<Unit<S>>));
  static_assert(sizeof(MixedMaterial<S>) == 7 * sizeof(S));

  template <int Words, class T, class Record, class Field>
  static ISO_INLINE void gather(const Record* const* records, Field&& field, Lanes<T, W, Isa>* out) {
    const T* rows[W];
    ISO_UNROLL for (int i = 0; i < W; ++i) rows[i] = field(*records[i]);
    load_transposed<Words>(rows, out);
  }
  static ISO_INLINE Impulses gather_impulses(const Contact<S>* const* contacts) {
    V w[8];
    gather<8>(
        contacts, [](const Contact<S>& c) ISO_INLINE_LAMBDA { return &c.normal_impulse[0]; }, w);
    return {{w[0], w[1], w[2], w[3]}, {w[4], w[5], w[6]}, w[7]};
  }
  static ISO_INLINE Vec3<U> gather_normal(const Geometry* const* geometry) {
    U w[4];  // the last is the next field's
    gather<4>(
        geometry, [](const Geometry& g) ISO_INLINE_LAMBDA { return &g.normal.x; }, w);
    return {w[0], w[1], w[2]};
  }
  static ISO_INLINE Vec3<U> gather_axis(const Geometry* const* geometry, U& ratio) {
    U w[4];
    gather<4>(
        geometry, [](const Geometry& g) ISO_INLINE_LAMBDA { return &g.axis.x; }, w);
    ratio = w[3];
    return {w[0], w[1], w[2]};
  }
  static ISO_INLINE Arms gather_point(const Geometry* const* geometry, int p, L& separation) {
    L w[8];
    gather<8>(
        geometry, [p](const Geometry& g) ISO_INLINE_LAMBDA { return &g.points[p].arm_a.x; }, w);
    separation = w[6];
    return {{w[0], w[1], w[2]}, {w[3], w[4], w[5]}};
  }
  /// Reads from a word before the material, so that eight words end with the record.
  static ISO_INLINE Materials gather_material(const Geometry* const* geometry) {
    L w[8];
    gather<8>(
        geometry, [](const Geometry& g) ISO_INLINE_LAMBDA { return &g.points[kMaxContactPoints - 1].separation; }, w);
    return {w[1], w[3], w[4], {w[5], w[6], w[7]}};
  }
  static ISO_INLINE Body gather_body(const PrepareRun<S>& run, const std::uint32_t* rows) {
    const Velocity<S>* motion[W];
    const S* mass[W];
    const S* rest[W];
    ISO_UNROLL for (int i = 0; i < W; ++i) {
      motion[i] = &run.velocity[rows[i]].linear.x;
      mass[i] = &run.mass[rows[i]].mass;
      rest[i] = &run.mass[rows[i]].kappa.rows[1].z;
    }
    V v[8];
    L m[8], r[4];
    load_transposed<8>(motion, v);
    load_transposed<8>(mass, m);
    load_transposed<4>(rest, r);
    return {{v[0], v[1], v[2]},
            {v[4], v[5], v[6]},
            m[0],
            {{{m[1], m[2], m[3]}, {m[4], m[5], m[6]}, {m[7], r[2], r[3]}}},
            less(L::zero(), m[0])};
  }

  /// Returns a bit for each contact that may bounce.
  static ISO_INLINE std::uint32_t bouncing(const Geometry* const* geometry) {
    std::uint32_t bits = 0;
    ISO_UNROLL for (int i = 0; i < W; ++i) bits |= (S(0) < geometry[i]->material.restitution ? 1u : 0u) << i;
    return bits;
  }
  /// Returns a bit for each contact whose friction has an axis.
  static ISO_INLINE std::uint32_t grained(const Geometry* const* geometry) {
    std::uint32_t bits = 0;
    ISO_UNROLL for (int i = 0; i < W; ++i) bits |= (geometry[i]->ratio < Unit<S>(1) ? 1u : 0u) << i;
    return bits;
  }
  /// Returns a bit for each contact that did not touch in the last step.
  static ISO_INLINE std::uint32_t fresh(const Contact<S>* const* contacts) {
    std::uint32_t bits = 0;
    ISO_UNROLL for (int i = 0; i < W; ++i) bits |= ((contacts[i]->flags & contact_flag::kTouching) == 0 ? 1u : 0u) << i;
    return bits;
  }

  // ---- storing

  template <class T> static ISO_INLINE void store(const Vec3<Lanes<T, W, Isa>>& v, T (&field)[3][W]) {
    v.x.store(field[0]);
    v.y.store(field[1]);
    v.z.store(field[2]);
  }

  // ---- rows

  /// The masses of the two bodies of a row of the Jacobian.
  struct RowMaker {
    const Mat3<L>& kappa_a;
    const Mat3<L>& kappa_b;
    L share_a, share_b;

    /// Fills angular parts of a row whose speed is jacobian_b . response_b - jacobian_a . response_a, without `linear`.
    ISO_INLINE void angular(Vec3<L> jacobian_a, Vec3<L> jacobian_b, L linear, V impulse, Row& row) const {
      const Vec3<L> response_a = (kappa_a * jacobian_a) * share_a;
      const Vec3<L> response_b = (kappa_b * jacobian_b) * share_b;
      const L k = linear + round_to<L>(dot_sum(jacobian_a, response_a) + dot_sum(jacobian_b, response_b));
      store(jacobian_a, row.jacobian_a);
      store(jacobian_b, row.jacobian_b);
      store(response_a, row.response_a);
      store(response_b, row.response_b);
      // Rows that push have k >= 1. A turning row with less than an eighth has hardly a lever: it resists nothing.
      const Mask sound = less(L::broadcast(S(0.125)), k);
      quotient_where<L>(sound, L::broadcast(S(1)), k).store(row.effective_mass);
      impulse.store(row.impulse);
    }
    ISO_INLINE void pushing(Vec3<L> direction, const Arms& arms, V impulse, Row& row) const {
      angular(cross(arms.a, direction), cross(arms.b, direction), share_a + share_b, impulse, row);
    }
  };

  /// Computes mass_share() of solver_body.hpp.
  static ISO_INLINE void share_masses(const Body& a, const Body& b, L& share_a, L& share_b) {
    const L zero = L::zero(), one = L::broadcast(S(1)), half = L::broadcast(S(0.5));
    const L half_sum = half * a.mass + half * b.mass;  // the sum itself may not fit
    const L ratio = quotient_where<L>(a.moves & b.moves, half * b.mass, half_sum);
    share_a = select(a.moves, select(b.moves, ratio, one), zero);
    share_b = select(b.moves, select(a.moves, one - ratio, one), zero);
  }

  /// Returns v_b - v_a at the ends of two arms [m/s].
  static ISO_INLINE Vec3<V> relative_velocity(const Body& a, const Body& b, const Arms& arms) {
    const auto part = [&](int i, int j) ISO_INLINE_LAMBDA {
      return round_to<V>(product(b.angular_velocity[i], arms.b[j]) - product(b.angular_velocity[j], arms.b[i]) -
                         product(a.angular_velocity[i], arms.a[j]) + product(a.angular_velocity[j], arms.a[i]));
    };
    return b.velocity - a.velocity + Vec3<V>{part(1, 2), part(2, 0), part(0, 1)};
  }

  // ---- tangents

  /// Returns a vector without its part along the normal.
  static ISO_INLINE Vec3<V> flatten(Vec3<V> x, Vec3<U> n) {
    const V along = round_to<V>(dot_sum(x, n));
    return {x.x - round_to<V>(product(along, n.x)), x.y - round_to<V>(product(along, n.y)),
            x.z - round_to<V>(product(along, n.z))};
  }
  /// Computes tangents_of() of vec3.hpp.
  static ISO_INLINE Tangents<U> any_tangents(Vec3<U> n) {
    const U half = U::broadcast(Unit<S>(0.5)), one = U::broadcast(Unit<S>(1)), minus = U::broadcast(Unit<S>(-1));
    const Mask negative = less(n.z, U::zero());
    const U half_z = n.z * half;
    const U divisor = select(negative, U::broadcast(Unit<S>(-0.5)), half) + half_z;
    const U a = -divide_to<U>(half, divisor);
    const U b = n.x * (n.y * a);
    const U xx = n.x * (n.x * a);
    const U yy = n.y * (n.y * a);
    // The sign is chosen before the sum: of the two sums the one that is not wanted need not fit.
    return {{one + select(negative, -xx, xx), select(negative, -b, b), select(negative, n.x, -n.x)},
            {b, select(negative, minus, one) + yy, -n.y}};
  }
  /// Returns a basis whose first vector is along `lead` (which is flat) in lanes that lead; any basis in the others.
  static ISO_INLINE Tangents<U> basis_along(Mask leads, Vec3<V> lead, Vec3<U> n) {
    if (!any(leads)) return any_tangents(n);
    const Direction<V> t = direction_where(leads, lead.x, lead.y, lead.z);
    const Vec3<U> first = {t.x, t.y, t.z};
    const Vec3<U> second = cross(n, first);
    if (all(leads)) return {first, second};
    const Tangents<U> other = any_tangents(n);
    return {select(leads, first, other.t), select(leads, second, other.u)};
  }
  /// Returns the friction basis. A contact that slides takes the slip's direction, which friction opposes. Another
  /// takes that of the friction it already bears, or any if there is none. The kernel's cone is exact along the basis.
  static ISO_INLINE Tangents<U> friction_basis(Vec3<U> n, Vec3<V> borne, V limit, Vec3<V> slip) {
    const Vec3<V> slide = flatten(slip, n);
    // A contact that sticks trembles by less than its friction stops in a sub-step, and by less than it slides. A slip
    // below 1e-4 m/s is noise: where a body falls straight down, it would turn the basis any way.
    const V trembling = max(min(V::broadcast(detail::kSlidingSpeed<S>), limit), V::broadcast(Velocity<S>(0.0001)));
    const Mask slides = less(trembling, max_abs(slide));
    if (all(slides)) return basis_along(slides, slide, n);
    const Vec3<V> force = flatten(borne, n);
    const Mask bears = less(limit, V::broadcast(Velocity<S>(8)) * max_abs(force));  // below an eighth: noise
    return basis_along(slides | bears, select(slides, slide, force), n);
  }

  // ---- a block

  /// [m] Returns the patch's radius: 1.082 times the root mean square distance of the points from their middle. A
  /// square patch under even pressure resists twisting as if all friction acted at 0.541 of its half diagonal.
  static ISO_INLINE L patch_radius(const Vec3<L>* arms_b, Vec3<L> middle, int points, L share) {
    auto sum = SumOf<L, L>::zero();
    for (int p = 0; p < points; ++p) {
      const Vec3<L> half = (arms_b[p] - middle) * L::broadcast(S(0.5));  // so that the largest patch's square fits
      sum = sum + dot_sum(half * share, half);
    }
    return L::broadcast(S(2 * 0.541)) * root(round_to<L>(sum));
  }

  static ISO_INLINE void fill(const PrepareRun<S>& run, const Contact<S>* const* contacts,
                              const Geometry* const* geometry, unsigned char* memory, BlockBodies& bodies) {
    Block& block = *reinterpret_cast<Block*>(memory + (run.rolling ? sizeof(RollingRows<S, W>) : 0));
    std::uint32_t rows_a[W], rows_b[W];
    ISO_UNROLL for (int i = 0; i < W; ++i) {
      bodies.a[i] = rows_a[i] = geometry[i]->row_a;
      bodies.b[i] = rows_b[i] = geometry[i]->row_b;
    }
    const Body a = gather_body(run, rows_a), b = gather_body(run, rows_b);
    bodies.write_a = to_bits(a.moves);
    bodies.write_b = to_bits(b.moves);

    RowMaker make = {a.kappa, b.kappa, {}, {}};
    share_masses(a, b, make.share_a, make.share_b);
    make.share_a.store(block.share_a);
    make.share_b.store(block.share_b);
    const Vec3<U> normal = gather_normal(geometry);
    const Vec3<L> n = {convert<L>(normal.x), convert<L>(normal.y), convert<L>(normal.z)};
    store(n, block.normal);
    const Materials material = gather_material(geometry);
    material.friction.store(block.friction);

    const Impulses impulses = gather_impulses(contacts);
    V total = V::zero();
    Arms sum = {{L::zero(), L::zero(), L::zero()}, {L::zero(), L::zero(), L::zero()}};
    Arms first = sum;
    Vec3<L> arms_b[kMaxContactPoints];
    const L most_bias = L::broadcast(run.most_bias);
    const std::uint32_t bounces = bouncing(geometry);
    const V none = V::broadcast(highest<Velocity<S>>());
    select(Mask::from_bits(bounces), V::zero(), none).store(block.left_gap);
    // The overlap of what bounces anew is an impact's, as deep as impacts.hpp takes it.
    const Mask anew = Mask::from_bits(bounces & fresh(contacts));
    const L bias = select(anew, L::zero(), L::broadcast(run.penetration_bias));
    for (int p = 0; p < run.points; ++p) {
      NormalRow<S, W>& row = block.normals[p];
      L separation;
      const Arms arms = gather_point(geometry, p, separation);
      const V impulse = impulses.normal[p];
      make.pushing(n, arms, impulse, row.row);
      convert<V>(separation - min(bias * max(-separation, L::zero()), most_bias)).store(row.separation);
      (-impulse).store(row.total_impulse);  // the first warm start is the last step's
      total = total + impulse;
      sum = {sum.a + arms.a, sum.b + arms.b};
      if (p == 0) first = arms;
      arms_b[p] = arms.b;
    }

    constexpr S kShares[kMaxContactPoints] = {S(1), S(0.5), S(1.0 / 3), S(0.25)};
    const L share = L::broadcast(kShares[run.points - 1]);
    const Arms arms = {sum.a * share, sum.b * share};
    const Vec3<V> surface = {convert<V>(material.surface.x), convert<V>(material.surface.y),
                             convert<V>(material.surface.z)};
    const V limit = round_to<V>(product(material.friction, total));
    Tangents<U> basis = friction_basis(normal, impulses.friction, limit, relative_velocity(a, b, arms) + surface);
    U ratio = U::broadcast(Unit<S>(1));
    const Mask grain = Mask::from_bits(grained(geometry));
    if (any(grain)) {
      const Vec3<U> axis = gather_axis(geometry, ratio);
      basis = {select(grain, axis, basis.t), select(grain, cross(normal, axis), basis.u)};
    }
    ratio.store(block.ratio);
    const Vec3<U> directions[2] = {basis.t, basis.u};
    for (int k = 0; k < 2; ++k) {
      FrictionRow<S, W>& tangent = block.tangents[k];
      const Vec3<U> d = directions[k];
      const Vec3<L> t = {convert<L>(d.x), convert<L>(d.y), convert<L>(d.z)};
      make.pushing(t, arms, round_to<V>(dot_sum(impulses.friction, d)), tangent.row);
      store(t, tangent.direction);
      round_to<V>(dot_sum(surface, d)).store(tangent.surface);
    }

    const L patch = run.points > 1 ? patch_radius(arms_b, arms.b, run.points, share) : L::zero();
    prepare_twist(n, patch, material, impulses.twist, make, block);
    if (any(grain)) {  // as spinning_factor()
      const U half = U::broadcast(Unit<S>(0.5));
      const L twist = L::load(block.twist_friction), factor = convert<L>(root(half + half * (ratio * ratio)));
      select(grain, twist * factor, twist).store(block.twist_friction);
    }
    V::broadcast(-Velocity<S>(0)).store(block.spin);
    if (run.rolling) {
      prepare_rolling(a, b, first, normal, material.rolling, make, *reinterpret_cast<RollingRows<S, W>*>(memory));
    }
  }

  /// The row's radius is at least that of gyration, which keeps the coefficients near one for any small patch.
  static ISO_INLINE void prepare_twist(Vec3<L> n, L patch, const Materials& material, V impulse, const RowMaker& make,
                                       Block& block) {
    const L zero = L::zero(), one = L::broadcast(S(1));
    const L k = round_to<L>(dot_sum(n, make.kappa_a * n * make.share_a) + dot_sum(n, make.kappa_b * n * make.share_b));
    const Mask turns = less(zero, k);
    const L gyration = min(quotient_where<L>(turns, one, root(max(k, zero))), L::broadcast(Limits<S>::extent()));
    // A contact at four times that radius spins no more as it is; a larger one is no different, and this one fits.
    const L reach = max(patch, min(material.spin, gyration * L::broadcast(S(4))));
    const L radius = max(reach, gyration);
    const Vec3<L> twist = n * radius;
    make.angular(twist, twist, zero, impulse, block.twist);
    (material.friction * quotient_where<L>(less(zero, radius), reach, radius)).store(block.twist_friction);
  }

  static ISO_INLINE void prepare_rolling(const Body& a, const Body& b, const Arms& arms, Vec3<U> n, L resistance,
                                         const RowMaker& make, RollingRows<S, W>& rolling) {
    // The rows' radius is the distance from the contact to the centre that rolls: it keeps the coefficients near one.
    const L zero = L::zero();
    const L radius = max(select(a.moves, abs(dot(arms.a, n)), zero), select(b.moves, abs(dot(arms.b, n)), zero));
    // The rows lie along the rolling itself, so that their separate limits resist it as one.
    const Vec3<V> angular_velocity = flatten(b.angular_velocity - a.angular_velocity, n);
    const Mask rolls = less(V::broadcast(Velocity<S>(0.01)), max_abs(angular_velocity));  // [rad/s] slower is rest
    const Tangents<U> basis = basis_along(rolls, angular_velocity, n);
    const Vec3<U> axes[2] = {basis.t, basis.u};
    for (int k = 0; k < 2; ++k) {
      const Vec3<L> axis = {convert<L>(axes[k].x), convert<L>(axes[k].y), convert<L>(axes[k].z)};
      const Vec3<L> jacobian = axis * radius;
      make.angular(jacobian, jacobian, zero, V::zero(), rolling.rows[k]);
    }
    // A body does not roll at all beyond the radius itself; four times it is no different and fits.
    const L lever = quotient_where<L>(less(zero, radius), resistance, radius);
    min(lever, L::broadcast(S(4))).store(rolling.lever);
  }

  static void prepare(const PrepareRun<S>& run) {
    const std::size_t bytes = block_bytes<S, W>(run.points, run.rolling);
    // Lanes that are left over hold a contact of nothing with nothing, whose impulses stay zero.
    const Contact<S> no_contact = {};
    Geometry no_geometry = {};
    no_geometry.ratio = Unit<S>(1);
    auto* memory = static_cast<unsigned char*>(run.blocks);
    BlockBodies* bodies = run.bodies;
    for (std::int32_t at = 0; at < run.count; at += W, memory += bytes, ++bodies) {
      const Contact<S>* contacts[W];
      const Geometry* geometry[W];
      ISO_UNROLL for (int i = 0; i < W; ++i) {
        const bool real = at + i < run.count;
        contacts[i] = real ? &run.contacts[run.order[at + i]] : &no_contact;
        geometry[i] = real ? &run.geometry[run.order[at + i]] : &no_geometry;
      }
      fill(run, contacts, geometry, memory, *bodies);
    }
  }
};

}  // namespace
}  // namespace isostep
