// The pairs as one scalar has them, and the algorithms over them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "brute_force.hpp"
#include "isostep/book/v_clip.hpp"
#include "isostep/collision/narrowphase/epa.hpp"
#include "isostep/collision/narrowphase/gjk.hpp"
#include "isostep/collision/narrowphase/pair_kernels.hpp"
#include "measure.hpp"

namespace isostep::bench {

/// The answer of an algorithm about a pair.
struct Said {
  bool answered;  // it ended by itself
  bool apart;
  double value;       // [m] distance; less than 0: depth; 0: it overlaps, by whatever
  Vec3<double> axis;  // from a to b, of `sat` where it makes a contact; else 0
};

template <class S> struct ScalarPair {
  Polyhedron<S> a, b;
  Transform<S> ta, tb;
  FeaturePair features;  // of 5 mm off
  PlacedHull exact_a, exact_b;
  Exact exact;  // of the poses as this scalar rounds them
};

template <class S> Transform<S> transform_of(const Pose<double>& pose) {
  const auto [x, y, z] = pose.position;
  const Quat<double> q = pose.orientation;
  const Quat<Unit<S>> turn = {from_double<Unit<S>>(q.x), from_double<Unit<S>>(q.y), from_double<Unit<S>>(q.z),
                              from_double<Unit<S>>(q.w)};
  return Transform<S>::of({{from_double<S>(x), from_double<S>(y), from_double<S>(z)}, normalise(turn)});
}
template <class V> Vec3<double> real(const V& v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
template <class S> Transform<double> real_transform(const Transform<S>& t) {
  Transform<double> made = {real(t.position), {}};
  for (int i = 0; i < 3; ++i) made.rotation.rows[i] = real(t.rotation.rows[i]);
  return made;
}

template <class S> std::vector<HullSolid<S>> solids_of(const PairSet& set) {
  std::vector<HullSolid<S>> solids;
  for (const BenchHull& hull : set.hulls) solids.emplace_back(hull.grid.hull, hull.grid.exponent);
  return solids;
}

template <class S>
std::vector<ScalarPair<S>> scalar_pairs(const PairSet& set, const std::vector<HullSolid<S>>& solids, Closeness kind) {
  std::vector<ScalarPair<S>> made;
  for (const BenchPair& pair : set.pairs[static_cast<std::size_t>(kind)]) {
    ScalarPair<S> p;
    p.a = solids[pair.a].polyhedron();
    p.b = solids[pair.b].polyhedron();
    p.ta = transform_of<S>(pair.at_a);
    p.tb = transform_of<S>(pair.at_b);
    Transform<S> before = p.tb;
    before.position.x += from_double<S>(0.003);
    before.position.y += from_double<S>(0.004);
    p.features = v_clip_distance<S>(p.a, p.ta, p.b, before, {}).features;
    p.exact_a = placed_hull(set.hulls[pair.a], real_transform(p.ta));
    p.exact_b = placed_hull(set.hulls[pair.b], real_transform(p.tb));
    p.exact = brute_force(p.exact_a, p.exact_b);
    made.push_back(std::move(p));
  }
  return made;
}

/// Farther than any pair is apart, so that nearly each has its axis. Where faces that are apart have no points over one
/// another there is no contact, and that is right.
inline constexpr double kSatMargin = 0.25;  // [m]

template <class S> Said ask_sat(const ScalarPair<S>& p, CollidePolyhedra<S> collide) {
  Manifold<S> found;
  found.clear();
  collide(p.a, p.ta, p.b, p.tb, S(kSatMargin), found);
  if (found.count == 0) return {p.exact.gap > 0, true, 0, {0, 0, 0}};
  return {true, found.points[0].separation > S(0), 0, real(found.normal)};
}
template <class S> Said ask_gjk(const ScalarPair<S>& p) {
  const GjkDistance<S> found = gjk_distance<S>(p.a, p.ta, p.b, p.tb);
  return {true, found.distance > S(0), to_double(found.distance), {0, 0, 0}};
}
template <class S> Said ask_epa(const ScalarPair<S>& p) {
  const EpaPenetration<S> found = epa_penetration<S>(p.a, p.ta, p.b, p.tb);
  return {found.status != EpaStatus::unfinished, found.status == EpaStatus::apart, -to_double(found.depth), {0, 0, 0}};
}
template <class S> Said ask_v_clip(const ScalarPair<S>& p, FeaturePair from) {
  const VClipDistance<S> found = v_clip_distance<S>(p.a, p.ta, p.b, p.tb, from);
  const bool ended = found.status != VClipStatus::unfinished;
  return {ended, found.status == VClipStatus::apart, to_double(found.distance), {0, 0, 0}};
}

template <class S> Said ask(const ScalarPair<S>& p, Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::sat: return ask_sat(p, pair_kernels<S>(Simd::best)->polyhedra);
    case Algorithm::sat_one_lane: return ask_sat(p, pair_kernels<S>(Simd::scalar)->polyhedra);
    case Algorithm::gjk: return ask_gjk(p);
    case Algorithm::epa: return ask_epa(p);
    case Algorithm::v_clip: return ask_v_clip(p, {});
    default: return ask_v_clip(p, p.features);
  }
}

}  // namespace isostep::bench
