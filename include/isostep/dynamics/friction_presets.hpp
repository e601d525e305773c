// Coefficients of friction of pairs of materials, as Millington's table has them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/records/material_pair.hpp"

namespace isostep {

/// The coefficients of a pair of surfaces, not of one.
template <class S> struct FrictionPreset {
  S static_friction, friction;  // [1] of what rests; of what slides

  /// Returns the record for kinds that a game gives to its materials.
  ISO_INLINE constexpr MaterialPair<S> between(std::uint32_t kind_a, std::uint32_t kind_b) const {
    MaterialPair<S> pair;
    pair.kind_a = kind_a;
    pair.kind_b = kind_b;
    pair.friction = friction;
    pair.static_friction = static_friction;
    return pair;
  }
  /// Returns a material for both bodies: two equal materials mix to the same values.
  ISO_INLINE constexpr Material<S> material() const {
    Material<S> material;
    material.friction = friction;
    material.static_friction = static_friction;
    return material;
  }
};

/// Expands ISO_FOR_EACH_FRICTION_PRESET(X) to X(name, static, dynamic). Source:  Millington 2010, Game Physics Engine
/// Development, 2nd ed., p. 435. Velcro is an estimate of the book.
#define ISO_FOR_EACH_FRICTION_PRESET(X) \
  X(crate_on_concrete, 0.5, 0.4)        \
  X(crate_on_ice, 0.2, 0.1)             \
  X(glass_on_ice, 0.1, 0.03)            \
  X(glass_on_glass, 0.95, 0.4)          \
  X(metal_on_metal, 0.6, 0.4)           \
  X(lubricated_metal, 0.1, 0.05)        \
  X(rubber_on_concrete, 1.0, 0.8)       \
  X(wet_rubber_on_concrete, 0.7, 0.5)   \
  X(racing_tyre_on_concrete, 1.5, 1.0)  \
  X(velcro_on_velcro, 6.0, 4.0)

/// presets::crate_on_concrete<S>() and so on. `add(presets::crate_on_ice<S>().between(kWood, kIce))`.
namespace presets {
#define ISO_PRESET(name, rest, slide) \
  template <class S> ISO_INLINE constexpr FrictionPreset<S> name() { return {S(rest), S(slide)}; }
ISO_FOR_EACH_FRICTION_PRESET(ISO_PRESET)
#undef ISO_PRESET
}  // namespace presets

}  // namespace isostep
