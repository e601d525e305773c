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

/// Makes a stored shape of these children, or of none, with all that follows from them. Their contents exist already.
template <class S>
std::shared_ptr<const StoredShape<S>> stored_shape(std::vector<Child<S>> children, Contents<S> contents);

/// ShapeMap finds a shape by its slot, and what a body is by its shape. It is a cache: all of it follows from the
/// state.
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
  /// The traits of all parts of a shape together.
  ISO_INLINE const ShapeTraits& traits_of(std::uint32_t shape_slot) const { return state_.shapes[shape_slot]->traits; }
  /// Returns null if the shape has few children.
  ISO_INLINE const ChildTree<S>* tree_of(std::uint32_t shape_slot) const {
    return state_.shapes[shape_slot]->tree.get();
  }
  /// [m] The least thickness() of all its children that are no sensors.
  ISO_INLINE S thinnest_of(std::uint32_t shape_slot) const { return state_.shapes[shape_slot]->thinnest; }
  /// [m] The least thinnest_of() of all shapes.
  S least_thickness() const;
  /// Returns null if the shape has no such child, or if it is no height field.
  const Child<S>* height_field_of(std::uint32_t shape_slot, std::uint32_t child) const;
  /// Returns true if a body has the shape.
  ISO_INLINE bool is_used(std::uint32_t shape_slot) const {
    return shape_slot < uses_.size() && uses_[shape_slot] != 0;
  }
  /// Returns the contents of the blobs that children name.
  ISO_INLINE Contents<S> contents() const { return {contents_.data()}; }

  // Bodies, by their shapes.
  /// senses() returns true if the body or one of its parts is a sensor, is_sensor() if nothing of it is anything else.
  ISO_INLINE bool senses(const BodyProperties<S>& body) const {
    return (body.flags & body_flag::kSensor) != 0 || traits_of(body.shape).has(part_flag::kSensor);
  }
  ISO_INLINE bool is_sensor(const BodyProperties<S>& body) const {
    return (body.flags & body_flag::kSensor) != 0 || !traits_of(body.shape).any_solid;
  }
  /// Returns true if a part of the body presses on others.
  ISO_INLINE bool has_contacts(const BodyProperties<S>& body) const {
    constexpr std::uint32_t kFlags = body_flag::kSensor | body_flag::kCollide;
    return (body.flags & kFlags) == body_flag::kCollide && traits_of(body.shape).any_solid;
  }
  /// Returns a filter that allows at least what any of its parts collides with.
  ISO_INLINE Filter filter_of(const BodyProperties<S>& body) const {
    return traits_of(body.shape).filter_or(body.filter);
  }
  /// Returns true if events report when contacts of the part begin and end.
  ISO_INLINE bool reports(const BodyProperties<S>& body, std::uint32_t child) const {
    return (body.flags & body_flag::kReportContacts) != 0 ||
           children_of(body.shape)[child].traits.has(part_flag::kReportContacts);
  }

  // Changes.
  /// Counts the bodies of a shape. `by`: 1 when one comes; -1 modulo 2^32 when one goes.
  ISO_INLINE void count_use(std::uint32_t shape_slot, std::uint32_t by) {
    if (uses_.size() <= shape_slot) uses_.resize(shape_slot + 1);
    uses_[shape_slot] += by;
  }
  /// Renews all contents, after the state's blobs have changed.
  void renew_contents();
  /// Renews the content at one place.
  void renew_content(std::uint32_t place);
  /// Puts a shape into a slot that was handed out, in place of the shape there.
  void put(std::uint32_t slot, std::vector<Child<S>> children);
  /// The shapes of the state have changed: least_thickness() is computed anew.
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
