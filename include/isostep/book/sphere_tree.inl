// Bodies of SphereTree<S>. Included only where it is instantiated.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/hierarchy.inl"
#include "isostep/book/sphere_tree.hpp"

namespace isostep {

template <class S> void SphereTree<S>::insert(std::uint32_t slot, const Aabb<S>& box) {
  if (root_ == tree_.kNone) root_ = tree_.make_root();
  boxes_.insert(slot, box);
  tree_.insert(root_, slot, BoundingSphere<S>::around(box));
  ++changes_;
}
template <class S> void SphereTree<S>::update(std::uint32_t slot, const Aabb<S>& box) {
  ISO_ASSERT(contains(slot));
  boxes_.replace(slot, box);
  tree_.move(root_, slot, BoundingSphere<S>::around(box));
  ++changes_;
}
template <class S> void SphereTree<S>::remove(std::uint32_t slot) {
  boxes_.remove(slot);
  tree_.remove(slot);
  ++changes_;
}

template <class S> void SphereTree<S>::optimise() {
  if (changes_ != 0 && size() <= 2u * changes_) build(HierarchyBuild::top_down);
}
template <class S> void SphereTree<S>::build(HierarchyBuild how) {
  tree_.clear();
  root_ = tree_.make_root();
  for (std::uint32_t slot = boxes_.next(0); slot != Bitset::kNone; slot = boxes_.next(slot + 1u))
    tree_.stage(slot, BoundingSphere<S>::around(boxes_[slot]));
  tree_.build(root_, how);
  changes_ = 0;
}
template <class S> void SphereTree<S>::clear() {
  boxes_.clear();
  tree_.clear();
  root_ = tree_.kNone;
  changes_ = 0;
}

template <class S> bool SphereTree<S>::validate() const {
  if (root_ == tree_.kNone) return size() == 0;
  if (!tree_.validate(root_) || tree_.leaves(root_) != size()) return false;
  for (std::uint32_t slot = boxes_.next(0); slot != Bitset::kNone; slot = boxes_.next(slot + 1u)) {
    if (tree_.leaf_of(slot) == tree_.kNone) return false;
  }
  return true;
}

}  // namespace isostep
