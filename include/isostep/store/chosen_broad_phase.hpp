// ChosenBroadPhase<S>: boxes in the structure that a name says.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/broad_phase.hpp"
#include "isostep/collision/broadphase/broad_phase_name.hpp"
#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/core/instantiate.hpp"
#if !defined(ISOSTEP_NO_BOOK)
#include "isostep/book/bsp_tree.hpp"
#include "isostep/book/cell_grid.hpp"
#include "isostep/book/cell_tree.hpp"
#include "isostep/book/sphere_tree.hpp"
#include "isostep/book/sweep_and_prune.hpp"
#endif

namespace isostep {

/// A BroadPhase but for pairs, for which `with` gives the structure. The box tree, which most worlds use, is called
/// directly. The others cost an indirect call per visit. Structures that are not in use are empty.
template <class S> class ChosenBroadPhase {
 public:
  ISO_INLINE BroadPhaseName name() const { return name_; }
  /// Chooses a structure of this build and empties the present one. The caller inserts the boxes again.
  void choose(BroadPhaseName name);

  void insert(std::uint32_t slot, const Aabb<S>& box);
  void update(std::uint32_t slot, const Aabb<S>& box);
  void remove(std::uint32_t slot);
  void optimise();
  const Aabb<S>& box(std::uint32_t slot) const;

  template <class Visit> ISO_INLINE void query(const Aabb<S>& box, Visit&& visit) const {
    if (name_ == BroadPhaseName::box_tree) return box_tree_.query(box, visit);
    using Plain = std::remove_reference_t<Visit>;
    const auto call = [](void* data, std::uint32_t slot)
                          ISO_INLINE_LAMBDA { return static_cast<bool>((*static_cast<Plain*>(data))(slot)); };
    query_other(box, call, const_cast<void*>(static_cast<const void*>(&visit)));
  }
  template <class Visit> ISO_INLINE void sweep(const Sweep<S>& sweep, Visit&& visit) const {
    if (name_ == BroadPhaseName::box_tree) return box_tree_.sweep(sweep, visit);
    using Plain = std::remove_reference_t<Visit>;
    const auto call = [](void* data, std::uint32_t slot, Unit<S> most)
                          ISO_INLINE_LAMBDA { return (*static_cast<Plain*>(data))(slot, most); };
    sweep_other(sweep, call, const_cast<void*>(static_cast<const void*>(&visit)));
  }
  /// Calls visit(structure) with the structure in use, which is a BroadPhase.
  template <class Visit> ISO_INLINE auto with(Visit&& visit) { return with(*this, visit); }

 private:
  template <class Self, class Visit> static ISO_INLINE auto with(Self& self, Visit& visit) {
    switch (self.name_) {
#define ISO_CASE(name, Structure) \
  case BroadPhaseName::name: return visit(self.name##_);
      ISO_FOR_EACH_BUILT_BROAD_PHASE(ISO_CASE)
#undef ISO_CASE
      default: break;  // left out
    }
    return visit(self.box_tree_);
  }
  void query_other(const Aabb<S>& box, bool (*visit)(void*, std::uint32_t), void* data) const;
  void sweep_other(const Sweep<S>& sweep, Unit<S> (*visit)(void*, std::uint32_t, Unit<S>), void* data) const;

  BroadPhaseName name_ = BroadPhaseName::box_tree;
#define ISO_MEMBER(name, Structure) Structure<S> name##_;
  ISO_FOR_EACH_BUILT_BROAD_PHASE(ISO_MEMBER)
#undef ISO_MEMBER
};

#define ISO_CHOSEN_BROAD_PHASE_OF(extern, S) extern template class ChosenBroadPhase<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CHOSEN_BROAD_PHASE_OF)

}  // namespace isostep
