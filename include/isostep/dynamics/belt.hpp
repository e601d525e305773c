// Belts<S>: the SurfaceVelocity records of a step, in the world's axes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/core/lower_bound.hpp"
#include "isostep/core/registry.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/dynamics/surface_velocity.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/math/mat3.hpp"

namespace isostep {

/// A body's surface as a step begins.
template <class S> struct Belt {
  using V = Velocity<S>;
  std::uint32_t body;   // slot
  Vec3<S> linear;       // [m/s] world
  Vec3<S> angular;      // [rad/s] world
  Vec3<S> from_origin;  // [m] from the body's origin to its centre of mass, world

  ISO_INLINE bool turns() const { return !(angular == Vec3<S>::zero()); }
  /// [m/s] at the end of an arm [m] from the centre of mass.
  ISO_INLINE Vec3<S> velocity_at(Vec3<S> arm) const {
    const Vec3<S> at = arm + from_origin, w = angular;
    const auto part = [&](int i, int j)
                          ISO_INLINE_LAMBDA { return saturate_to<S>(product(w[i], at[j]) - product(w[j], at[i])); };
    const Vec3<S> turned = held_within(Vec3<S>{part(1, 2), part(2, 0), part(0, 1)}, Limits<S>::speed());
    return held_within(linear + turned, Limits<S>::speed());
  }
};

/// Ascending by the body's slot. Keeps nothing from step to step but memory.
template <class S> class Belts {
 public:
  /// pose_of(slot): a pair of the body's orientation and its centre of mass in its frame [m]. `fastest` [rad/s].
  template <class PoseOf>
  ISO_INLINE void update(const Registry<SurfaceVelocity<S>, SurfaceVelocityId>& records, S fastest,
                         const PoseOf& pose_of) {
    all_.clear();
    if (records.all().empty()) return;
    for (std::uint32_t slot = 0; slot < records.all().size(); ++slot) {
      const SurfaceVelocity<S>& record = records.all()[slot];
      if (!records.is_taken(slot) || !record.runs()) continue;
      const auto [orientation, centre] = pose_of(record.body.slot);
      const Mat3<Unit<S>> turn = to_matrix(orientation);
      all_.push_back(
          {record.body.slot, turn * record.linear, held_within(turn * record.angular, fastest), turn * centre});
    }
    scratch_.resize(all_.size());
    stable_sort(all_.data(), scratch_.data(), static_cast<std::uint32_t>(all_.size()), BySlot{});
  }
  ISO_INLINE bool empty() const { return all_.empty(); }
  ISO_INLINE bool any_turns() const {
    for (const Belt<S>& belt : all_) {
      if (belt.turns()) return true;
    }
    return false;
  }
  /// Null: its surface does not run.
  ISO_INLINE const Belt<S>* find(std::uint32_t body) const {
    const std::size_t at =
        lower_bound(all_.size(), [&](std::size_t i) ISO_INLINE_LAMBDA { return all_[i].body < body; });
    return at < all_.size() && all_[at].body == body ? &all_[at] : nullptr;
  }

 private:
  struct BySlot {
    ISO_INLINE std::uint64_t operator()(const Belt<S>& belt) const { return belt.body; }
  };
  std::vector<Belt<S>> all_, scratch_;
};

/// What the belts of a contact's bodies add to its surface velocity.
template <class S>
ISO_INLINE void add_belts(const Belts<S>& belts, const ContactKey& key, std::uint32_t count, ContactGeometry<S>& g) {
  const Belt<S>*a = belts.find(key.body_a), *b = belts.find(key.body_b);
  if (a == nullptr && b == nullptr) return;
  const auto arms = detail::ContactArms<S>::middle_of(g, count);
  Vec3<S> surface = g.material.surface_velocity;
  if (a != nullptr) surface -= a->velocity_at(arms.a);
  if (b != nullptr) surface += b->velocity_at(arms.b);
  const S most = Limits<S>::speed() + Limits<S>::speed();
  g.material.surface_velocity = held_within(surface, most);
}

}  // namespace isostep
