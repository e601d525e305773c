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
#include "isostep/dynamics/records/surface_velocity.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/math/mat3.hpp"

namespace isostep {

/// The surface of a record at the start of a step.
template <class S> struct BeltPlace {
  Quat<Unit<S>> orientation;  // of the body
  Vec3<S> centre;             // [m] of mass, in its frame
  std::uint32_t first_leaf;   // as contacts count the parts: surfaces.hpp. Of the whole body kEveryPart
  std::uint32_t leaf_count;
};

/// A running surface of a body, or of a part, at the start of a step.
template <class S> struct Belt {
  using V = Velocity<S>;
  std::uint32_t body;                    // slot
  std::uint32_t first_leaf, leaf_count;  // as BeltPlace has them
  bool runs;
  Vec3<S> linear;       // [m/s] world
  Vec3<S> angular;      // [rad/s] world
  Vec3<S> from_origin;  // [m] from the body's origin to its centre of mass, world

  ISO_INLINE std::uint64_t key() const { return std::uint64_t{body} << 32 | first_leaf; }
  ISO_INLINE bool turns() const { return !(angular == Vec3<S>::zero()); }
  /// [m/s] Returns the velocity at the end of an arm [m] from the centre of mass.
  ISO_INLINE Vec3<S> velocity_at(Vec3<S> arm) const {
    const Vec3<S> at = arm + from_origin, w = angular;
    const auto part = [&](int i, int j)
                          ISO_INLINE_LAMBDA { return saturate_to<S>(product(w[i], at[j]) - product(w[j], at[i])); };
    const Vec3<S> turned = held_within(Vec3<S>{part(1, 2), part(2, 0), part(0, 1)}, Limits<S>::speed());
    return held_within(linear + turned, Limits<S>::speed());
  }
};

/// Holds the belts of a step, ascending by body slot, then by part, the whole body's last. Keeps only memory.
template <class S> class Belts {
 public:
  /// Lists the belts. place_of(record) returns a BeltPlace. `fastest` [rad/s] limits their rotation.
  template <class PlaceOf>
  ISO_INLINE void update(const Registry<SurfaceVelocity<S>, SurfaceVelocityId>& records, S fastest,
                         const PlaceOf& place_of) {
    all_.clear();
    if (records.all().empty()) return;
    for (std::uint32_t slot = 0; slot < records.all().size(); ++slot) {
      const SurfaceVelocity<S>& record = records.all()[slot];
      const bool counts = record.runs() || record.part != kEveryPart;  // a part that stands still hides the body's
      if (!records.is_taken(slot) || !counts) continue;
      const BeltPlace<S> place = place_of(record);
      const Mat3<Unit<S>> turn = to_matrix(place.orientation);
      all_.push_back({record.body.slot, place.first_leaf, place.leaf_count, record.runs(), turn * record.linear,
                      held_within(turn * record.angular, fastest), turn * place.centre});
    }
    scratch_.resize(all_.size());
    stable_sort(all_.data(), scratch_.data(), static_cast<std::uint32_t>(all_.size()), ByPart{});
  }
  ISO_INLINE bool empty() const { return all_.empty(); }
  ISO_INLINE bool any_turns() const {
    for (const Belt<S>& belt : all_) {
      if (belt.turns()) return true;
    }
    return false;
  }
  /// Returns the belt of a leaf, as in ContactKey: its part's, else the body's. Null if the surface does not run there.
  ISO_INLINE const Belt<S>* find(std::uint32_t body, std::uint32_t leaf) const {
    const std::uint64_t key = std::uint64_t{body} << 32 | leaf, whole = std::uint64_t{body} << 32 | kEveryPart;
    const std::size_t next = first_not([&](std::uint64_t other) ISO_INLINE_LAMBDA { return other <= key; });
    if (next > 0 && all_[next - 1].body == body && leaf - all_[next - 1].first_leaf < all_[next - 1].leaf_count)
      return all_[next - 1].runs ? &all_[next - 1] : nullptr;
    const std::size_t at = first_not([&](std::uint64_t other) ISO_INLINE_LAMBDA { return other < whole; });
    return at < all_.size() && all_[at].key() == whole ? &all_[at] : nullptr;
  }

 private:
  struct ByPart {
    ISO_INLINE std::uint64_t operator()(const Belt<S>& belt) const { return belt.key(); }
  };
  /// Returns the index of the first belt whose key is not before, for keys that ascend.
  template <class Before> ISO_INLINE std::size_t first_not(const Before& before) const {
    return lower_bound(all_.size(), [&](std::size_t i) ISO_INLINE_LAMBDA { return before(all_[i].key()); });
  }

  std::vector<Belt<S>> all_, scratch_;
};

/// Adds the belts of a contact's parts to its surface velocity.
template <class S>
ISO_INLINE void add_belts(const Belts<S>& belts, const ContactKey& key, std::uint32_t count, ContactGeometry<S>& g) {
  const Belt<S>*a = belts.find(key.body_a, key.child_a), *b = belts.find(key.body_b, key.child_b);
  if (a == nullptr && b == nullptr) return;
  const auto arms = detail::ContactArms<S>::middle_of(g, count);
  Vec3<S> surface = g.material.surface_velocity;
  if (a != nullptr) surface -= a->velocity_at(arms.a);
  if (b != nullptr) surface += b->velocity_at(arms.b);
  const S most = Limits<S>::speed() + Limits<S>::speed();
  g.material.surface_velocity = held_within(surface, most);
}

}  // namespace isostep
