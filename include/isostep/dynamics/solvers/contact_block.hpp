// The numbers of W contacts side by side, as the contact kernel reads them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "isostep/core/fields.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

/// One angular row of the Jacobian, which turns but does not push.
/// Symbols: jacobian_a, jacobian_b = the row's angular parts; response_a, response_b = change of angular velocity per
///          impulse.
template <class S, int W> struct AngularRow {
  S jacobian_a[3][W], jacobian_b[3][W];
  S response_a[3][W], response_b[3][W];
  S effective_mass[W];
  Velocity<S> impulse[W];  // [m/s] accumulated

  ISO_FIELDS(jacobian_a, jacobian_b, response_a, response_b, effective_mass, impulse)
};

template <class S, int W> struct NormalRow {
  AngularRow<S, W> row;
  Velocity<S> separation[W];     // [m] when the step began; overlaps deepened by Schedule::penetration_bias
  Velocity<S> total_impulse[W];  // [m/s] given over the step, but for the sub-step that runs

  ISO_FIELDS(row, separation, total_impulse)
};

template <class S, int W> struct FrictionRow {
  AngularRow<S, W> row;
  S direction[3][W];       // [1] tangent
  Velocity<S> surface[W];  // [m/s] speed of b's surface against a's along the tangent

  ISO_FIELDS(row, direction, surface)
};

/// W contacts of P points each: two rows of friction and one of twist for the patch, P normal rows. Each field has W
/// numbers of one width, without padding, so that a block of one contact packs into a lane of a wide block word by
/// word. The normal rows come last, so that fewer points make a shorter block.
template <class S, int W, int P> struct ContactBlock {
  S normal[3][W];  // [1] from a to b
  S share_a[W];    // [1] MassShare
  S share_b[W];
  S friction[W];     // [1] along the first tangent
  Unit<S> ratio[W];  // [1] that along the second, over it: below one of a grain
  FrictionRow<S, W> tangents[2];
  AngularRow<S, W> twist;  // its radius is inside the Jacobian
  S twist_friction[W];     // [1] friction that acts at that radius: a part of `friction`, as the patch's own is smaller
  Velocity<S> spin[W];     // [m/s] of b's surface against a's along the twist: -0, which added changes no bit, for none
  Velocity<S> left_gap[W];  // [m] a wider gap a relaxed pass leaves as it closes: 0 of what may bounce, else none
  NormalRow<S, W> normals[P];
};

/// Rolling resistance: two more angular rows about tangents of their own.
template <class S, int W> struct RollingRows {
  AngularRow<S, W> rows[2];
  S lever[W];  // [1] resisting torque per normal impulse, over the rows' radius

  ISO_FIELDS(rows, lever)
};
template <class S, int W, int P> struct RollingBlock {
  RollingRows<S, W> rolling;
  ContactBlock<S, W, P> contact;
};

/// Returns the size of a block of contacts with `points` points.
template <class S, int W> ISO_INLINE constexpr std::size_t block_bytes(std::int32_t points, bool rolling) {
  const auto missing = static_cast<std::size_t>(kMaxContactPoints - points);
  return sizeof(ContactBlock<S, W, kMaxContactPoints>) - missing * sizeof(NormalRow<S, W>) +
         (rolling ? sizeof(RollingRows<S, W>) : 0);
}

/// Sets the surface velocity [m/s] of b against a in the friction rows of one contact. `words`: those of its lane.
template <class S> ISO_INLINE void set_surface(unsigned char* words, std::size_t width, Vec3<Velocity<S>> surface) {
  using Block = ContactBlock<S, 1, kMaxContactPoints>;
  using Row = FrictionRow<S, 1>;
  for (std::size_t k = 0; k < 2; ++k) {
    unsigned char* row = words + width * (offsetof(Block, tangents) + k * sizeof(Row));
    S direction[3];
    for (std::size_t i = 0; i < 3; ++i)
      std::memcpy(&direction[i], row + width * (offsetof(Row, direction) + i * sizeof(S)), sizeof(S));
    const auto along = round_to<Velocity<S>>(dot_sum(Vec3<S>{direction[0], direction[1], direction[2]}, surface));
    std::memcpy(row + width * offsetof(Row, surface), &along, sizeof(along));
  }
}

/// Sets the angular velocity [rad/s] of b's surface against a's in the twist row of one contact.
template <class S> ISO_INLINE void set_spin(unsigned char* words, std::size_t width, Vec3<Velocity<S>> spin) {
  using Block = ContactBlock<S, 1, kMaxContactPoints>;
  using Row = AngularRow<S, 1>;
  unsigned char* const row = words + width * (offsetof(Block, twist) + offsetof(Row, jacobian_b));
  S jacobian[3];
  for (std::size_t i = 0; i < 3; ++i) std::memcpy(&jacobian[i], row + width * i * sizeof(S), sizeof(S));
  const Velocity<S> most = convert<Velocity<S>>(Limits<S>::speed());
  const auto sum = dot_sum(Vec3<S>{jacobian[0], jacobian[1], jacobian[2]}, spin);
  const Velocity<S> along = clamp(saturate_to<Velocity<S>>(sum), -most, most);
  std::memcpy(words + width * offsetof(Block, spin), &along, sizeof(along));
}

/// The rows of SolverBodies that a block's lanes read, and which of them they may write (one bit a lane).
struct BlockBodies {
  static constexpr int kMaxWidth = 16;
  std::uint32_t a[kMaxWidth];
  std::uint32_t b[kMaxWidth];
  std::uint32_t write_a;
  std::uint32_t write_b;
};

}  // namespace isostep
