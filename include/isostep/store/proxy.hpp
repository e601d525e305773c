// Proxy<S>: what the broad phase knows of a body.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "isostep/dynamics/body.hpp"

namespace isostep {

/// The kind is what a body is to others, an index of these bits. Bodies that collide with nothing have no kind.
namespace proxy_kind {
inline constexpr std::uint32_t kAwake = 1, kDynamic = 2, kSensor = 4;
inline constexpr std::uint32_t kCount = 8;

/// Returns true if bodies of two kinds pair: one is awake, and one is dynamic and none a sensor, or exactly one is a
/// sensor. A sensor sees whatever moves, and what it passes when it moves itself, but no other sensor.
ISO_INLINE constexpr bool pair(std::uint32_t a, std::uint32_t b) {
  const bool sees = ((a ^ b) & kSensor) != 0, touches = ((a | b) & kSensor) == 0 && ((a | b) & kDynamic) != 0;
  return ((a | b) & kAwake) != 0 && (sees || touches);
}
/// Returns a bit for every kind that pairs with this one.
ISO_INLINE constexpr std::uint32_t partners(std::uint32_t kind) {
  std::uint32_t set = 0;
  for (std::uint32_t other = 0; other < kCount; ++other) set |= pair(kind, other) ? 1u << other : 0u;
  return set;
}
inline constexpr std::array<std::uint32_t, kCount> kPartners = {partners(0), partners(1), partners(2), partners(3),
                                                                partners(4), partners(5), partners(6), partners(7)};
/// Bits: the awake kinds, and those of them that can be pushed.
inline constexpr std::uint32_t kAllAwake = 0xaau;
inline constexpr std::uint32_t kFree = 1u << (kAwake | kDynamic) | 1u << (kAwake | kDynamic | kSensor);
}  // namespace proxy_kind

/// Traits and boxes decide which bodies pair. The traits of a body whose parts differ, and of a subtree of bodies,
/// allow at least what any of them allows.
struct ProxyTraits {
  std::uint32_t kinds = 0;     // bits: what it is, a proxy_kind each
  std::uint32_t partners = 0;  // bits: the kinds it pairs with
  Filter filter = {};

  template <class S>
  static ISO_INLINE ProxyTraits of(const BodyProperties<S>& body, const ShapeTraits& parts, bool awake) {
    const Filter filter = parts.filter_or(body.filter);
    if ((body.flags & body_flag::kCollide) == 0) return {0, 0, filter};
    const std::uint32_t solid =
        (awake ? proxy_kind::kAwake : 0u) | (body.type == BodyType::dynamic ? proxy_kind::kDynamic : 0u);
    const std::uint32_t sensor = solid | proxy_kind::kSensor;
    if ((body.flags & body_flag::kSensor) != 0) return of_kind(sensor, filter);
    if (!parts.has(part_flag::kSensor)) return of_kind(solid, filter);
    return parts.any_solid ? of_both(of_kind(solid, filter), of_kind(sensor, filter)) : of_kind(sensor, filter);
  }
  static ISO_INLINE ProxyTraits of_kind(std::uint32_t kind, const Filter& filter) {
    return {1u << kind, proxy_kind::kPartners[kind], filter};
  }
  static ISO_INLINE ProxyTraits of_both(const ProxyTraits& a, const ProxyTraits& b) {
    return {a.kinds | b.kinds, a.partners | b.partners, ShapeTraits::both(a.filter, b.filter)};
  }
  ISO_INLINE bool pairs_with(const ProxyTraits& other) const {
    return (partners & other.kinds) != 0 && should_collide(filter, other.filter);
  }
  friend ISO_INLINE bool operator==(const ProxyTraits& a, const ProxyTraits& b) {
    return a.kinds == b.kinds && a.partners == b.partners && a.filter == b.filter;
  }
};

template <class S> struct Proxy {
  Aabb<S> box;
  ProxyTraits traits;
  bool present;
};

}  // namespace isostep
