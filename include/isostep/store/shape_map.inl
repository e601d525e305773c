// Bodies of shape_map.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "isostep/collision/continuous/shape_impact.hpp"
#include "isostep/dynamics/contact_friction.hpp"
#include "isostep/geometry/content.hpp"
#include "isostep/state/members.hpp"
#include "isostep/store/shape_map.hpp"

namespace isostep {

template <class S>
std::shared_ptr<const StoredShape<S>> stored_shape(std::vector<Child<S>> children, Contents<S> contents) {
  auto shape = std::make_shared<StoredShape<S>>();
  shape->children = std::move(children);
  shape->hash = detail::hash_sections(*shape);
  if (shape->children.size() >= ChildTree<S>::kLeastChildren)
    shape->tree = std::make_shared<const ChildTree<S>>(std::span<const Child<S>>(shape->children), contents);
  shape->thinnest = detail::kThick<S>;
  for (const Child<S>& child : shape->children) {
    if (!child.traits.has(part_flag::kSensor))
      shape->thinnest = min(shape->thinnest, thickness<S>(contents.view(child.primitive)));
    shape->traits.add(child.traits);
    if (child.traits.has(part_flag::kOwnMaterial) && !mixes_alone(child.traits.material))
      shape->traits.mixes_alone = false;
  }
  return shape;
}

template <class S> const Child<S>* ShapeMap<S>::height_field_of(std::uint32_t shape_slot, std::uint32_t child) const {
  const std::span<const Child<S>> children = children_of(shape_slot);
  const bool is_field = child < children.size() && children[child].primitive.type == ShapeType::height_field;
  return is_field ? &children[child] : nullptr;
}

template <class S> S ShapeMap<S>::least_thickness() const {
  if (knows_thickness_) return thickness_;
  thickness_ = detail::kThick<S>;
  for (std::uint32_t slot = 0; slot < state_.shapes.size(); ++slot) thickness_ = min(thickness_, thinnest_of(slot));
  knows_thickness_ = true;
  return thickness_;
}

template <class S> void ShapeMap<S>::renew_contents() { find_contents<S>(state_.geometry->contents(), contents_); }

template <class S> void ShapeMap<S>::renew_content(std::uint32_t place) {
  contents_.resize(state_.geometry->names().size());
  if (!state_.geometry->is_taken(place)) return;
  contents_[place] = content_of<S>(*state_.geometry->content(place));
}

template <class S> void ShapeMap<S>::put(std::uint32_t slot, std::vector<Child<S>> children) {
  while (state_.shapes.size() <= slot) state_.shapes.push_back(nullptr);
  const std::shared_ptr<const StoredShape<S>> earlier = state_.shapes[slot];
  const std::shared_ptr<const StoredShape<S>> next = stored_shape(std::move(children), contents());
  if (next->thinnest < thickness_) thickness_ = next->thinnest;
  if (earlier != nullptr && earlier->thinnest <= thickness_) forget_thickness();
  state_.shapes.change(slot) = next;
}

}  // namespace isostep
