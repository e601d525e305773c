// Bodies of throng.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/shape_impact.hpp"
#include "isostep/core/random.hpp"
#include "isostep/store/body_frames.inl"
#include "isostep/systems/contacts/throng.hpp"

namespace isostep {

namespace detail {
ISO_INLINE Pcg32 draws_of_pair(std::uint32_t slot_a, std::uint32_t slot_b) {
  return Pcg32::seeded(std::uint64_t{slot_a} << 32 | slot_b);
}
/// [m] The inner radius of a solid body of one part, 0 for all others.
template <class S> S throng_reach(const BodyFrame<S>& body) {
  if (!body.plain || body.senses || body.surfaces) return S(0);
  if (body.kind == PartKind::sphere) return body.radius;
  if (body.kind == PartKind::box) return min(body.half.x, min(body.half.y, body.half.z)) + body.radius;
  const ShapeView<S> shape = part(body, 0);
  return is_bounded(shape.primitive.type) ? thickness<S>(shape) : S(0);
}
}  // namespace detail

template <class S>
void Throng<S>::begin(std::span<const BodyFrame<S>> frames, std::span<const BodyProperties<S>> bodies,
                      std::size_t pairs) {
  members_.clear();
  if (!is_searched(pairs, frames.size())) return;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const S reach = bodies[i].type == BodyType::dynamic ? detail::throng_reach(frames[i]) : S(0);
    members_.push_back({frames[i].centre, reach * S(kDeep), frames[i].slot, 0, 0});
  }
}

template <class S> bool Throng<S>::is_deep(const Member& a, const Member& b) {
  return !detail::longer_than(b.centre - a.centre, min(a.reach, b.reach));
}

template <class S> bool Throng<S>::leaves_out(std::uint32_t a, std::uint32_t b) const {
  if (members_.size() <= max(a, b)) return false;
  const Member &of_a = members_[a], &of_b = members_[b];
  if (min(of_a.deep, of_b.deep) <= kDeepest) return false;
  Pcg32 draws = detail::draws_of_pair(of_a.slot, of_b.slot);
  return draws.next() % max(of_a.pairs, of_b.pairs) >= kPartners;
}

template <class S> Vec3<Unit<S>> Throng<S>::way_apart(std::uint32_t slot_a, std::uint32_t slot_b) {
  Pcg32 draws = detail::draws_of_pair(slot_a, slot_b);
  const auto part = [&] { return S(static_cast<std::int32_t>(draws.next() >> 25) - 64) * S(1.0 / 64); };
  const S x = part(), y = part(), z = part();
  const Heading<S> way = heading_of(Vec3<S>{x, y, z});
  return way.length < S(0.125) ? detail::unit_axis<Unit<S>>(1, false) : way.direction;
}

}  // namespace isostep
