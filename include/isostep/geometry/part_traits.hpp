// PartTraits<S>: what a part of a shape has of its own: a material, a filter, and whether it senses or reports.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

/// [1] The least of a material's anisotropy, and so the least ratio of an ellipse of friction.
inline constexpr double kLeastGrain = 1.0 / 64;

/// A surface. A contact mixes two surfaces: friction and spin resistance are the root of the product, the rest the
/// larger of both. Two kinds that the world's table of pairs (material_pair.hpp) lists have the values of the table.
/// contact_friction.hpp: which coefficient of friction a contact has in a step.
template <class S> struct Material {
  S friction = S(0.6);          // [1] Coulomb, of what slides: the dynamic coefficient
  S restitution = S(0);         // [1] 0..1, of what meets at Settings::restitution_threshold or more
  S rolling_resistance = S(0);  // [m] lever arm of the normal force that resists rolling
  /// [m] Radius of the least patch: friction resists spinning about a contact's normal as if it acted so far from the
  /// middle of its points, or as far as these lie. It slows balls of 1 m and 10 cm in radius by 0.1 and 12 rad/s^2.
  S spin_resistance = S(1.0 / 128);
  Vec3<S> surface_velocity = {S(0), S(0), S(0)};  // [m/s] world, a conveyor belt's
  S static_friction = S(0);                       // [1] of what does not slide; below friction: the same as friction
  /// [1] 1/64..1: the part of friction that is left along the body's own x, y and z axes. Between the axes the force at
  /// its limit ends on an ellipsoid with these radii, so that runners {1/16, 1, 1} along x hold across.
  Vec3<S> anisotropy = {S(1), S(1), S(1)};
  std::uint32_t kind = 0;      // of material, for the table of pairs; 0: none
  std::uint32_t reserved = 0;  // 0: keeps records of 8-byte scalars without padding

  ISO_FIELDS(friction, restitution, rolling_resistance, spin_resistance, surface_velocity, static_friction, anisotropy,
             kind, reserved)

  friend ISO_INLINE constexpr bool operator==(const Material& a, const Material& b) {
    return a.friction == b.friction && a.restitution == b.restitution && a.rolling_resistance == b.rolling_resistance &&
           a.spin_resistance == b.spin_resistance && a.surface_velocity == b.surface_velocity &&
           a.static_friction == b.static_friction && a.anisotropy == b.anisotropy && a.kind == b.kind &&
           a.reserved == b.reserved;
  }
};

/// Two bodies collide when each one's mask has a bit of the other's category, unless they share a non-zero group. So do
/// two parts.
struct Filter {
  std::uint32_t category = 1;
  std::uint32_t mask = 0xffffffffu;
  std::uint32_t group = 0;

  ISO_FIELDS(category, mask, group)

  friend ISO_INLINE constexpr bool operator==(const Filter& a, const Filter& b) {
    return a.category == b.category && a.mask == b.mask && a.group == b.group;
  }
};
ISO_INLINE constexpr bool should_collide(const Filter& a, const Filter& b) {
  if (a.group != 0 && a.group == b.group) return false;
  return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

/// Bits of PartTraits::flags.
namespace part_flag {
inline constexpr std::uint32_t kOwnMaterial = 1u << 0;     // PartTraits::material is the part's; else the body's is
inline constexpr std::uint32_t kOwnFilter = 1u << 1;       // PartTraits::filter is the part's; else the body's is
inline constexpr std::uint32_t kSensor = 1u << 2;          // reports overlaps, is not solved and weighs nothing
inline constexpr std::uint32_t kReportContacts = 1u << 3;  // the part's contacts tell when they begin and end
inline constexpr std::uint32_t kAll = kOwnMaterial | kOwnFilter | kSensor | kReportContacts;
}  // namespace part_flag

/// A part without flags has the values of its body. Values that no flag makes the part's own are stored as zeros, so
/// that equal parts hash alike.
template <class S> struct PartTraits {
  std::uint32_t flags = 0;  // part_flag
  Filter filter = {0, 0, 0};
  Material<S> material = {S(0), S(0), S(0), S(0), {S(0), S(0), S(0)}, S(0), {S(0), S(0), S(0)}, 0, 0};

  ISO_INLINE constexpr bool has(std::uint32_t flag) const { return (flags & flag) != 0; }
  /// Returns the filter of the part, where the body has `of_body`.
  ISO_INLINE constexpr const Filter& filter_or(const Filter& of_body) const {
    return has(part_flag::kOwnFilter) ? filter : of_body;
  }
  ISO_INLINE constexpr const Material<S>& material_or(const Material<S>& of_body) const {
    return has(part_flag::kOwnMaterial) ? material : of_body;
  }
  /// Returns the traits as they are stored.
  ISO_INLINE constexpr PartTraits normalised() const {
    PartTraits stored = *this;
    if (!has(part_flag::kOwnFilter)) stored.filter = PartTraits{}.filter;
    if (!has(part_flag::kOwnMaterial)) stored.material = PartTraits{}.material;
    return stored;
  }
  friend ISO_INLINE constexpr bool operator==(const PartTraits& a, const PartTraits& b) {
    return a.flags == b.flags && a.filter == b.filter && a.material == b.material;
  }
  ISO_INLINE constexpr PartTraits& with(const Material<S>& own) {
    flags |= part_flag::kOwnMaterial;
    material = own;
    return *this;
  }
  ISO_INLINE constexpr PartTraits& with(const Filter& own) {
    flags |= part_flag::kOwnFilter;
    filter = own;
    return *this;
  }
  ISO_INLINE constexpr PartTraits& with(std::uint32_t more_flags) {
    flags |= more_flags;
    return *this;
  }

  ISO_FIELDS(flags, filter, material)
};

/// Returns true if two parts of bodies with these filters press on each other.
template <class S>
ISO_INLINE constexpr bool parts_collide(const PartTraits<S>& a, const Filter& of_a, const PartTraits<S>& b,
                                        const Filter& of_b) {
  return ((a.flags | b.flags) & part_flag::kSensor) == 0 && should_collide(a.filter_or(of_a), b.filter_or(of_b));
}

/// The union of the traits of a shape's parts: it allows no less than any of them.
struct ShapeTraits {
  std::uint32_t flags = 0;     // part_flag, of any of them
  bool any_as_body = false;    // some part has the filter of the body
  bool any_solid = false;      // some part is no sensor
  bool mixes_alone = true;     // every material of a part does, see contact_friction.hpp
  Filter filters = {0, 0, 0};  // of those that have one, together; group 0 where they differ

  ISO_INLINE constexpr bool has(std::uint32_t flag) const { return (flags & flag) != 0; }
  /// Returns the filter of the whole body, where the body has `of_body`.
  ISO_INLINE constexpr Filter filter_or(const Filter& of_body) const {
    if (!has(part_flag::kOwnFilter)) return of_body;
    return any_as_body ? both(filters, of_body) : filters;
  }
  template <class S> ISO_INLINE constexpr void add(const PartTraits<S>& part) {
    if (!part.has(part_flag::kOwnFilter)) any_as_body = true;
    else filters = has(part_flag::kOwnFilter) ? both(filters, part.filter) : part.filter;
    any_solid = any_solid || !part.has(part_flag::kSensor);
    flags |= part.flags;
  }
  static ISO_INLINE constexpr Filter both(const Filter& a, const Filter& b) {
    return {a.category | b.category, a.mask | b.mask, a.group == b.group ? a.group : 0u};
  }
};

}  // namespace isostep
