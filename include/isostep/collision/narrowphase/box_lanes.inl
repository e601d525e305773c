// W pairs of boxes at once: axes over lanes, polygons too where that pays, each pair's own points one by one. Part of
// pair_kernel.inl, with internal linkage like it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_box.hpp"
#include "isostep/collision/narrowphase/box_faces_lanes.inl"

namespace isostep {
namespace {

template <class S, int W, class Isa, bool Polygons> struct BoxLanes {
  using Pairs = PairLanes<S, W, Isa>;
  using Axes = BoxAxesLanes<S, W, Isa>;
  using Clip = BoxFacesLanes<S, W, Isa>;
  using L = typename Pairs::L;
  using U = typename Pairs::U;
  using Mask = typename Pairs::Mask;
  using Batch = typename Pairs::Batch;
  using Faces = typename Clip::Faces;
  static constexpr int kEdges = Clip::kEdges;

  static void boxes(const PairRun<S>& run) {
    for (std::uint32_t at = run.begin; at < run.end; at += W) {
      const Batch batch = Pairs::batch_at(run, at);
      const typename Pairs::Bodies p = Pairs::gather_bodies(batch);
      typename Axes::Boxes boxes;
      typename Axes::Best best;
      for (int i = 0; i < W; ++i) run.counts[batch.pair[i]] = 0;
      if (!Axes::find(batch, p, run.margin, boxes, best)) continue;
      std::uint32_t touching = ~to_bits(best.apart) & batch.real;
      typename Axes::Rest rest;
      if (!Polygons || best.examine != 0) Axes::store(boxes, best, rest);
      if (best.examine != 0) touching &= ~Axes::finish_crosses(run, batch, best, rest);
      if constexpr (Polygons) {
        if (touching == 0) continue;
        Faces faces;
        Clip::clip(p, boxes, best, faces);
        touch_faces(run, batch, p, boxes, best, faces, touching);
      } else {
        touch_faces_alone(run, batch, best, rest, touching);
      }
    }
  }

 private:
  /// Holds the polygons' points by lane, for work that is done pair by pair.
  struct Points {
    alignas(kLaneAlignment<S, W>) S at[W][kEdges][4];  // [m] where each edge begins, world axes; its separation
    std::uint32_t kept[kEdges];                        // a bit a lane: its beginning is a point
  };

  /// Computes where every edge begins: midway between the surfaces, relative to a's centre of mass.
  static ISO_INLINE void place_points(const typename Pairs::Bodies& p, const typename Axes::Boxes& boxes,
                                      const typename Axes::Best& best, const Faces& faces, S margin, Points& points) {
    const Mask of_b = best.of_b, m0 = best.axis0, m1 = best.axis1;
    Mat3<U> turn;
    Vec3<L> place = {select(of_b, p.place_b.x, p.place_a.x), select(of_b, p.place_b.y, p.place_a.y),
                     select(of_b, p.place_b.z, p.place_a.z)};
    ISO_UNROLL for (int i = 0; i < 3; ++i) {
      const Vec3<U>&x = boxes.turn_a.rows[i], &y = boxes.turn_b.rows[i];
      turn.rows[i] = {select(of_b, y.x, x.x), select(of_b, y.y, x.y), select(of_b, y.z, x.z)};
    }
    const L radius = select(of_b, p.radius_b, p.radius_a), incident_radius = select(of_b, p.radius_a, p.radius_b);
    const L radii = radius + incident_radius;
    const L reach = L::broadcast(margin), patch = L::broadcast(margin + kPatchReach<S>);
    std::uint32_t touching = 0;
    for (int i = 0; i < kEdges; ++i) {
      points.kept[i] = 0;
      const typename Clip::Edge& edge = faces.edges[i];
      if (!any(edge.there)) continue;
      const L u = edge.from.at[0], v = edge.from.at[1], height = edge.from.at[2];
      const L separation = height - radii;
      points.kept[i] = to_bits(edge.there & less_equal(separation, patch));
      touching |= to_bits(edge.there & less_equal(separation, reach));
      if (points.kept[i] == 0) continue;
      const L level = faces.half[2] + (height + radius - incident_radius) * L::broadcast(S(0.5));
      const L above = select(faces.below, -level, level);
      const Vec3<L> world = place + turn * Vec3<L>{Clip::pick(m0, m1, above, v, u), Clip::pick(m0, m1, u, above, v),
                                                   Clip::pick(m0, m1, v, u, above)};
      const L words[4] = {world.x, world.y, world.z, separation};
      S* rows[W];
      ISO_UNROLL for (int lane = 0; lane < W; ++lane) rows[lane] = points.at[lane][i];
      store_transposed<4>(rows, words, 0xffffffffu >> (32 - W));
    }
    for (std::uint32_t& kept : points.kept) kept &= touching;
  }
  static ISO_INLINE void store_normals(const PairRun<S>& run, const Batch& batch, const typename Axes::Boxes& boxes,
                                       const typename Axes::Best& best, const Faces& faces, std::uint32_t touching) {
    const Mask flip = Clip::differ(faces.below, best.of_b);
    U words[4] = {U::zero(), U::zero(), U::zero(), U::zero()};
    ISO_UNROLL for (int i = 0; i < 3; ++i) {
      const Vec3<U>&a = boxes.turn_a.rows[i], &b = boxes.turn_b.rows[i];
      const U axis = select(best.of_b, Clip::pick(best.axis0, best.axis1, b.x, b.y, b.z),
                            Clip::pick(best.axis0, best.axis1, a.x, a.y, a.z));
      words[i] = select(flip, -axis, axis);
    }
    Unit<S>* rows[W];
    ISO_UNROLL for (int lane = 0; lane < W; ++lane) rows[lane] = &run.manifolds[batch.pair[lane]].normal.x;
    store_transposed<4>(rows, words, touching);
  }

  /// A pair's points in polygon order, from the incident face's first corner on. An edge along a side comes after the
  /// edge that left through it, and before those that had left it earlier.
  struct Outline {
    int count;
    std::uint32_t edges[kEdges], before[kEdges];
  };
  static ISO_INLINE Outline outline_of(const Faces& faces, const Points& points, int lane) {
    Outline outline;
    outline.count = 0;
    const auto bit = [lane](std::uint32_t lanes) ISO_INLINE_LAMBDA { return (lanes >> lane & 1u) != 0; };
    const auto add = [&](std::uint32_t i, std::uint32_t before) ISO_INLINE_LAMBDA {
      if (!bit(points.kept[i])) return;
      const auto& enters = faces.edges[i].enters;
      outline.edges[outline.count] = i;
      outline.before[outline.count] = bit(enters[3])   ? 7
                                      : bit(enters[2]) ? 6
                                      : bit(enters[1]) ? 5
                                      : bit(enters[0]) ? 4
                                                       : before;
      ++outline.count;
    };
    for (std::uint32_t i = 0; i < 4; ++i) {
      add(i, (i + 3) & 3u);
      const auto& leaves = faces.edges[i].leaves;
      if (!bit(leaves[0] | leaves[1] | leaves[2] | leaves[3])) continue;
      for (std::uint32_t side = 4; side-- > 0;) {
        if (!bit(leaves[side])) continue;
        add(4 + side, i);
        if (side >= 2) continue;
        for (std::uint32_t later = 4; later-- > 2;) {
          if (bit(faces.edges[4 + side].leaves[later])) add(4 + later, 4 + side);
        }
      }
    }
    return outline;
  }

  /// Does reduce_to_four() for an outline.
  static void reduce(const Faces& faces, const L& tolerance, S slack, int lane, Outline& outline) {
    alignas(kLaneAlignment<S, W>) S x[3][W];
    detail::ClipPolygon<S> polygon;
    polygon.count = outline.count;
    for (int i = 0; i < outline.count; ++i) {
      for (int k = 0; k < 3; ++k) faces.edges[outline.edges[i]].from.at[k].store(x[k]);
      polygon.points[i] = {x[0][lane], x[1][lane], x[2][lane], outline.before[i], outline.edges[i]};
    }
    tolerance.store(x[0]);
    detail::reduce_to_four(polygon, detail::depth_tie(x[0][lane], slack));
    outline.count = polygon.count;
    for (int i = 0; i < polygon.count; ++i) {
      outline.before[i] = polygon.points[i].before;
      outline.edges[i] = polygon.points[i].after;
    }
  }

  static ISO_INLINE void touch_alone(const PairRun<S>& run, const Batch& batch, int lane) {
    const BodyFrame<S>&a = *batch.a[lane], &b = *batch.b[lane];
    Manifold<S>& out = run.manifolds[batch.pair[lane]];
    collide_box_box(a.children->primitive, a.origin, b.children->primitive, origin_beside(a, b), run.margin, out);
    run.counts[batch.pair[lane]] = static_cast<std::uint8_t>(out.count);
  }

  /// Makes the polygons one by one.
  static ISO_INLINE void touch_faces_alone(const PairRun<S>& run, const Batch& batch, const typename Axes::Best& best,
                                           const typename Axes::Rest& rest, std::uint32_t touching) {
    for (std::uint32_t lanes = touching; lanes != 0; lanes &= lanes - 1) {
      const int lane = first_bit(lanes);
      const BodyFrame<S>&a = *batch.a[lane], &b = *batch.b[lane];
      Manifold<S>& out = run.manifolds[batch.pair[lane]];
      out.clear();
      detail::touch_best_faces(Axes::pair_of(batch, rest, lane), best.face(lane), a.radius, a.origin, b.radius,
                               origin_beside(a, b), run.margin, out);
      run.counts[batch.pair[lane]] = static_cast<std::uint8_t>(out.count);
    }
  }

  static void touch_faces(const PairRun<S>& run, const Batch& batch, const typename Pairs::Bodies& p,
                          const typename Axes::Boxes& boxes, const typename Axes::Best& best, const Faces& faces,
                          std::uint32_t touching) {
    Points points;
    place_points(p, boxes, best, faces, run.margin, points);
    store_normals(run, batch, boxes, best, faces, touching);
    const std::uint32_t unclear = to_bits(faces.unclear), of_b = to_bits(best.of_b), below = to_bits(faces.below),
                        negative = to_bits(faces.negative);
    const std::uint32_t axis0 = to_bits(best.axis0), axis1 = to_bits(best.axis1);
    const std::uint32_t incident0 = to_bits(faces.incident0), incident1 = to_bits(faces.incident1);
    for (std::uint32_t lanes = touching; lanes != 0; lanes &= lanes - 1) {
      const int lane = first_bit(lanes);
      const auto bit = [lane](std::uint32_t of) ISO_INLINE_LAMBDA { return of >> lane & 1u; };
      if (bit(unclear) != 0) {
        touch_alone(run, batch, lane);
        continue;
      }
      Manifold<S>& out = run.manifolds[batch.pair[lane]];
      Outline outline = outline_of(faces, points, lane);
      if (outline.count > kMaxContactPoints) {
        const S slack = detail::face_slack(detail::smallest_of(batch.a[lane]->half, batch.b[lane]->half));
        reduce(faces, boxes.tolerance, slack, lane, outline);
      }
      const std::uint32_t axis = 2 - 2 * bit(axis0) - bit(axis1), incident = 2 - 2 * bit(incident0) - bit(incident1);
      const std::uint32_t face = incident * 2 + bit(negative);
      const std::uint32_t name = 1u << 31 | bit(of_b) << 12 | axis << 10 | bit(below) << 9 | face << 6;
      out.count = outline.count;
      run.counts[batch.pair[lane]] = static_cast<std::uint8_t>(outline.count);
      for (int i = 0; i < outline.count; ++i) {
        const S* from = points.at[lane][outline.edges[i]];
        out.points[i] = {{from[0], from[1], from[2]}, from[3], name | outline.before[i] << 3 | outline.edges[i]};
      }
    }
  }
};

}  // namespace
}  // namespace isostep
