// A body's fat box: its bounds and a margin, renewed when the body leaves it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"

namespace isostep::detail {

/// [m] The margin around a body's bounds. A body's pairs are looked up anew only when it leaves its fat box.
template <class S> inline constexpr S kFatMargin = S(0.1);

/// Renews a body's fat box if the body has left it, or if `always`.
template <class S>
void renew_fat_box(const BodyMap<S>& map, BodyState<S>& state, const BodyProperties<S>& body, bool always);
/// [m] The box around the parts of a body that are no sensors, with that margin. The body has both kinds of parts.
template <class S>
Aabb<S> box_without_sensors(const BodyMap<S>& map, const BodyState<S>& state, const BodyProperties<S>& body);
/// [m] The fat box without parts that are sensors: they weigh nothing and touch nothing.
template <class S>
ISO_INLINE Aabb<S> solid_box(const BodyMap<S>& map, const BodyState<S>& state, const BodyProperties<S>& body) {
  const ShapeTraits& traits = map.shapes.traits_of(body.shape);
  return traits.has(part_flag::kSensor) && traits.any_solid ? box_without_sensors(map, state, body) : state.fat;
}

}  // namespace isostep::detail

namespace isostep {

#define ISO_FAT_BOX_OF(extern, S)                                                                                  \
  extern template void detail::renew_fat_box<S>(const BodyMap<S>&, BodyState<S>&, const BodyProperties<S>&, bool); \
  extern template Aabb<S> detail::box_without_sensors<S>(const BodyMap<S>&, const BodyState<S>&,                   \
                                                         const BodyProperties<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_FAT_BOX_OF)

}  // namespace isostep
