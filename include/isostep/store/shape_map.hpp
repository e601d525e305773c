// ShapeMap<S>: what the shapes of a state are to those who meet them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// A shape of children as a world stores them, or of none, with all that follows from them; contents come first.
template <class S>
std::shared_ptr<const StoredShape<S>> stored_shape(std::vector<Child<S>> children, Contents<S> contents);

/// ShapeMap leads from a slot to the shape, and from a body to what its shape makes of it. A cache: all of it follows
/// from the state.
/// Input:   the state; shapes that commands put there, bodies that come and go, changes of blobs.
/// Output:  children, their traits, trees and contents; what a body is by its flags and its parts.
/// Keeps:   the content of blobs; how many bodies have a shape; the least thickness of all.
template <class S> class ShapeMap {
 public:
  ISO_INLINE explicit ShapeMap(WorldState<S>& state) : state_(state) {}

  // Shapes, by slot.
  ISO_INLINE std::span<const Child<S>> children_of(std::uint32_t shape_slot) const {
    return state_.shapes[shape_slot]->children;
  }
  /// Of all parts of a shape.
  ISO_INLINE const ShapeTraits& traits_of(std::uint32_t shape_slot) const { return state_.shapes[shape_slot]->traits; }
  /// Null: the shape has few children.
  ISO_INLINE const ChildTree<S>* tree_of(std::uint32_t shape_slot) const {
    return state_.shapes[shape_slot]->tree.get();
  }
  /// [m] The least thickness() of all its children.
  ISO_INLINE S thinnest_of(std::uint32_t shape_slot) const { return state_.shapes[shape_slot]->thinnest; }
  /// [m] The least of all shapes.
  S least_thickness() const;
  /// Null: the shape has no such child, or it is no height field.
  const Child<S>* height_field_of(std::uint32_t shape_slot, std::uint32_t child) const;
  /// Whether a body has the shape.
  ISO_INLINE bool is_used(std::uint32_t shape_slot) const {
    return shape_slot < uses_.size() && uses_[shape_slot] != 0;
  }
  /// Contents of the blobs that children name.
  ISO_INLINE Contents<S> contents() const { return {contents_.data()}; }

  // Bodies, by their shapes.
  /// Whether the body, or one of its parts, is a sensor; and whether nothing of it is anything else.
  ISO_INLINE bool senses(const BodyProperties<S>& body) const {
    return (body.flags & body_flag::kSensor) != 0 || traits_of(body.shape).has(part_flag::kSensor);
  }
  ISO_INLINE bool is_sensor(const BodyProperties<S>& body) const {
    return (body.flags & body_flag::kSensor) != 0 || !traits_of(body.shape).any_solid;
  }
  /// Whether something of it presses on others.
  ISO_INLINE bool has_contacts(const BodyProperties<S>& body) const {
    constexpr std::uint32_t kFlags = body_flag::kSensor | body_flag::kCollide;
    return (body.flags & kFlags) == body_flag::kCollide && traits_of(body.shape).any_solid;
  }
  /// No less than any of its parts collides with.
  ISO_INLINE Filter filter_of(const BodyProperties<S>& body) const {
    return traits_of(body.shape).filter_or(body.filter);
  }
  /// Whether events tell when the contacts of a part begin and end.
  ISO_INLINE bool reports(const BodyProperties<S>& body, std::uint32_t child) const {
    return (body.flags & body_flag::kReportContacts) != 0 ||
           children_of(body.shape)[child].traits.has(part_flag::kReportContacts);
  }

  // Changes.
  /// Counts the bodies of a shape. `by`: 1 when one comes; modulo 2^32, -1 when it goes.
  ISO_INLINE void count_use(std::uint32_t shape_slot, std::uint32_t by) {
    if (uses_.size() <= shape_slot) uses_.resize(shape_slot + 1);
    uses_[shape_slot] += by;
  }
  /// Renews all contents, after the state's blobs have changed.
  void renew_contents();
  /// Renews the one at a place.
  void renew_content(std::uint32_t place);
  /// Puts a shape in place of that which the slot has; its number is among those handed out.
  void put(std::uint32_t slot, std::vector<Child<S>> children);
  /// The shapes of the state are others.
  ISO_INLINE void forget_thickness() { knows_thickness_ = false; }

 private:
  WorldState<S>& state_;
  std::vector<const void*> contents_;  // by place in the geometry store
  std::vector<std::uint32_t> uses_;    // by shape slot: bodies that have it
  mutable S thickness_ = S(0);         // [m] least_thickness(), where it is known
  mutable bool knows_thickness_ = false;
};

#define ISO_SHAPE_MAP_OF(extern, S)                                                                          \
  extern template std::shared_ptr<const StoredShape<S>> stored_shape<S>(std::vector<Child<S>>, Contents<S>); \
  extern template class ShapeMap<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SHAPE_MAP_OF)

}  // namespace isostep
