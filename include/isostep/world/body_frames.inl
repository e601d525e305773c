// Bodies of body_frames.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/world/body_frames.hpp"

namespace isostep {

namespace detail {
template <class S> ISO_INLINE Transform<S> placed(const Transform<S>& origin, const Child<S>& child) {
  return child.pose.is_identity() ? origin : compose(origin, Transform<S>::of(child.pose));
}
template <class S> ISO_INLINE ShapeView<S> part(const BodyFrame<S>& frame, std::uint32_t index) {
  return frame.contents.view(frame.children[index].primitive);
}
}  // namespace detail

template <class S> BodyFrame<S> frame_at(const BodyMap<S>& map, Location at) {
  const BodyState<S>& state = map.state_at(at);
  const BodyProperties<S>& body = map.properties_at(at);
  const std::span<const Child<S>> children = map.children_of(body.shape);
  const Mat3<Unit<S>> turn = to_matrix(state.orientation);
  const Primitive<S>& first = children[0].primitive;
  const bool plain = children.size() == 1 && children[0].pose.is_identity();
  return {first.half,
          first.radius,
          state.centre,
          {-(turn * body.local_centre), turn},
          children.data(),
          map.contents(),
          static_cast<std::uint32_t>(children.size()),
          state.slot,
          at.set == Location::kAwake ? at.index + 1 : 0,
          plain ? part_kind_of(first.type) : PartKind::other,
          plain,
          (body.flags & body_flag::kSensor) != 0,
          at.is_asleep()};
}

template <class S, class Visit>
ISO_INLINE bool visit_parts(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, std::uint64_t& looks,
                            Visit&& visit) {
  if (a.child_count == 1 && b.child_count == 1) return visit(0u, 0u);
  // Most compounds have few children: their boxes are found once, not once for each child of the other.
  constexpr std::uint32_t kFew = 8;
  const Transform<S> origin_b = origin_beside(a, b);
  const auto box_of_b = [&](std::uint32_t j) {
    return bounds(detail::part(b, j), detail::placed(origin_b, b.children[j]));
  };
  Aabb<S> boxes_b[kFew];
  for (std::uint32_t j = 0; j < min(b.child_count, kFew); ++j) boxes_b[j] = box_of_b(j);
  for (std::uint32_t i = 0; i < a.child_count; ++i) {
    const Transform<S> ta = detail::placed(a.origin, a.children[i]);
    const Aabb<S> box_a = grow(bounds(detail::part(a, i), ta), margin);
    for (std::uint32_t j = 0; j < b.child_count; ++j) {
      if (looks == 0) return false;
      --looks;
      if (overlap(box_a, j < kFew ? boxes_b[j] : box_of_b(j)) && !visit(i, j)) return false;
    }
  }
  return true;
}

template <class S>
void collide_parts(const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b, std::uint32_t j, S margin,
                   Manifold<S>& out) {
  const Child<S>&part_a = a.children[i], &part_b = b.children[j];
  const Transform<S> origin_b = origin_beside(a, b);
  if (a.plain && b.plain) {
    collide(detail::part(a, i), a.origin, detail::part(b, j), origin_b, margin, out);
  } else {
    collide(detail::part(a, i), detail::placed(a.origin, part_a), detail::part(b, j), detail::placed(origin_b, part_b),
            margin, out);
  }
}

template <class S> bool bodies_touch(const BodyMap<S>& map, std::uint32_t slot_a, std::uint32_t slot_b) {
  constexpr S kMargin = detail::kSpeculativeDistance<S>;
  const BodyFrame<S> a = frame_at(map, map.location(slot_a)), b = frame_at(map, map.location(slot_b));
  bool touch = false;
  std::uint64_t looks = ~std::uint64_t{0};
  visit_parts(a, b, kMargin, looks, [&](std::uint32_t i, std::uint32_t j) {
    Manifold<S> manifold;
    collide_parts(a, i, b, j, kMargin, manifold);
    touch = manifold.count > 0;
    return !touch;
  });
  return touch;
}

}  // namespace isostep
