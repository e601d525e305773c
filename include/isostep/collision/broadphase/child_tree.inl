// Bodies of child_tree.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/child_tree.hpp"
#include "isostep/geometry/bounds.hpp"

namespace isostep {

template <class S> ChildTree<S>::ChildTree(std::span<const Child<S>> children, Contents<S> contents) : bounds_{} {
  std::uint32_t leaves = 0;
  bool any = false;
  for (std::uint32_t i = 0; i < children.size(); ++i) {
    const ShapeView<S> view = contents.view(children[i].primitive);
    first_leaves_.push_back(leaves);
    leaves += leaves_of<S>(view);
    has_surfaces_ = has_surfaces_ || is_surface(view.primitive.type);
    if (view.primitive.type == ShapeType::half_space) {
      endless_.push_back(i);
      continue;
    }
    const Aabb<S> box = isostep::bounds(view, Transform<S>::of(children[i].pose));
    bounds_ = any ? merge(bounds_, box) : box;
    any = true;
    tree_.stage(i, box);
  }
  if (any) tree_.rebuild();
}

}  // namespace isostep
