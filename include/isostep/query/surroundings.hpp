// Surroundings<S>: what is around one character, gathered once a step for all its casts and looks.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/collision/narrowphase/shape_core.hpp"
#include "isostep/collision/query/round_parting.hpp"
#include "isostep/collision/query/solid_cast.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/query/query_sight.hpp"
#include "isostep/store/proxies.hpp"

namespace isostep {

/// A contact of a character with something near it.
template <class S> struct NearContact {
  BodyId body;
  Vec3<Unit<S>> normal;  // [1] of the surface, towards the character
  S separation;          // [m] of the deepest point; below 0: overlap
  Vec3<S> point;         // [m] that one, midway between the two, world
};

/// An obstacle that a character meets on its way.
template <class S> struct ObstacleHit {
  BodyId body;
  Vec3<S> point;         // [m] of the surface, world
  Vec3<Unit<S>> normal;  // [1] of the surface, against the way
  Unit<S> fraction;      // [1] of the way
};

/// Input:   the state and its caches, which stay as they are from `begin_step` to the last question. Positions are of
///          the body's origin.
/// Output:  the contacts and hits that CastQueries would find among what the filter sees.
/// Keeps:   through a step, the places of all parts that a character has come near; of one character, the parts around
///          it, and planes that separate it from them. A part is not looked at again while its plane shows that it is
///          not in the way.
template <class S> class Surroundings {
 public:
  ISO_INLINE Surroundings(const WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies), sight_(state, map) {}

  void begin_step();
  /// Begins with a body of one convex part that does not turn. Lists that the filter names outlive the questions. The
  /// body does not see what it, or its part, does not collide with by the filter `collides`, nor bodies whose materials
  /// are of `passed_kinds`.
  void begin(ShapeId shape, const Pose<S>& pose, const QueryFilter& filter, const Filter& collides,
             std::span<const std::uint32_t> passed_kinds = {});
  /// Gathers what is within `reach` [m] of the place where it began. A question beyond that gathers more.
  void gather(Vec3<S> reach);

  /// [m] The distance of the shape at `at` from a point; below 0: the point is inside.
  S distance(Vec3<S> at, Vec3<S> point) const;
  /// Finds contacts with all parts and triangles within `margin` [m] of the shape. Order: bodies, children, triangles.
  void find_contacts(Vec3<S> at, S margin, std::vector<NearContact<S>>& out);
  /// Returns the first part that it meets. One that it overlaps from the start counts only if the way leads further in.
  std::optional<ObstacleHit<S>> cast(Vec3<S> from, Vec3<S> way);
  /// [1] The normal of the surface that a ray meets first; none if it begins inside of that.
  std::optional<Vec3<Unit<S>>> cast_ray(Vec3<S> from, Vec3<S> way);

 private:
  struct Placed {
    BodyId body;
    ShapeView<S> shape;
    Transform<S> at;              // of the part's frame, world
    Aabb<S> box;                  // [m] around it, world
    const PartTraits<S>* traits;  // of its own; null: it is as its body

    ISO_INLINE bool is_convex() const { return !is_surface(shape.primitive.type); }
  };
  /// Indices of placed parts.
  struct Range {
    static constexpr std::uint32_t kUnknown = 0xffffffffu;
    std::uint32_t first, last;
  };
  /// A body in the region.
  struct Near {
    std::uint32_t slot;
    Range parts;
  };
  struct BySlot {
    ISO_INLINE std::uint64_t operator()(const Near& nearby) const { return nearby.slot; }
  };
  struct Part {
    std::uint32_t placed;
    Parting<S> parting;  // of what is convex, from the character
  };
  /// A part that a cast may meet.
  struct Candidate {
    S room;  // [m] between the two where the way ends, as far as is known
    std::uint32_t part;
  };

  void gather_around(const Aabb<S>& box);
  void find_bodies_near();
  ISO_INLINE Range parts_of(std::uint32_t slot) {
    const Range known = placed_of_[slot];
    return known.first != Range::kUnknown ? known : place(slot);
  }
  ISO_INLINE bool collides_with(std::uint32_t slot) const {
    const BodyProperties<S>& other = map_.properties_at(map_.location(slot));
    for (const std::uint32_t kind : passed_kinds_) {
      if (kind == other.material.kind) return false;
    }
    return (other.flags & body_flag::kCollide) != 0 && should_collide(collides_, map_.shapes.filter_of(other));
  }
  /// Returns true if the part is in the way. Some part of its body is.
  ISO_INLINE bool is_in_the_way(std::uint32_t slot, const Placed& part) const {
    if (part.traits == nullptr) return true;
    const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
    return sight_.sees_part(filter_, body, *part.traits) &&
           should_collide(collides_, part.traits->filter_or(body.filter));
  }
  Range place(std::uint32_t slot);
  Range place_some(std::uint32_t slot, const ChildTree<S>& tree);
  void add_placed(BodyId body, const Transform<S>& origin, const Child<S>& child, bool traits);
  ISO_INLINE void cover(const Aabb<S>& box) {
    if (!contains(region_, box)) gather_around(box);
  }
  ISO_INLINE Aabb<S> box_at(Vec3<S> at) const { return {at + box_.low, at + box_.high}; }
  Sweep<S> sweep_of(Vec3<S> from, Vec3<S> way) const;
  void find_candidates(Vec3<S> from, Vec3<S> way);
  bool meet(Part& part, Vec3<S> from, Vec3<S> way, Unit<S> latest, SolidHit<S>& hit);
  void find_parting(Part& part, Vec3<S> start);
  bool is_parted(Part& part, Vec3<S> at, S margin);
  void add_contacts_of(const Placed& part, Vec3<S> at, S margin, std::vector<NearContact<S>>& out) const;

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  const Proxies<S>& proxies_;
  QuerySight<S> sight_;

  // Of the step.
  std::vector<Placed> placed_;
  std::vector<Range> placed_of_;  // by body slot; not of shapes with a tree
  // Of one character.
  QueryFilter filter_;
  Filter collides_;
  std::span<const std::uint32_t> passed_kinds_;
  const Primitive<S>* shape_ = nullptr;
  Vec3<S> begin_;                      // [m]
  Vec3<S> offset_;                     // [m] of the shape's frame from the body's origin
  Aabb<S> box_;                        // [m] around the shape of a body at the world's origin
  std::optional<ShapeCore<S>> core_;   // of the shape
  std::optional<RoundCore<S>> round_;  // of a ball or capsule
  SolidCast<S> cast_;                  // of the core
  Aabb<S> region_;                     // [m] of which all parts are known
  std::vector<Part> parts_;
  std::vector<Candidate> candidates_;

  // Memory of a search.
  std::vector<Near> near_, near_scratch_;
  std::vector<std::uint32_t> children_, children_scratch_;
};

#define ISO_SURROUNDINGS_OF(extern, S) extern template class Surroundings<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SURROUNDINGS_OF)

}  // namespace isostep
