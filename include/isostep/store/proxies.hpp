// Which bodies might touch: the structure of fat boxes and the pairs it yields, kept in step with the state they derive
// from.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/store/chosen_broad_phase.hpp"
#include "isostep/store/crowd.hpp"
#include "isostep/store/proxy.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// A cache, not state. The pairs are a function of every body's fat box, type, filters and whether it is awake, and
/// beyond the budget also of the contacts; all of them are state. `place` compares a body with what it knew, so loading
/// a snapshot renews only what differs.
template <class S> class Proxies {
 public:
  /// `shapes`: those of the state. They are read when a body is placed.
  ISO_INLINE explicit Proxies(const StoredShapes<S>& shapes) : shapes_(shapes) {}

  /// Places a body, or renews its place. A disabled body has none.
  void place(const BodyState<S>& state, const BodyProperties<S>& body, bool awake);
  void remove(std::uint32_t slot);
  /// Returns true if `place` would change nothing.
  bool is_placed(const BodyState<S>& state, const BodyProperties<S>& body, bool awake) const;
  /// Renews the pairs. If there are more than `budget`, the `contacts` of the last step help to choose among them.
  void update(std::span<const Contact<S>> contacts, std::size_t budget);
  bool present(std::uint32_t slot) const { return slot < proxies_.size() && proxies_[slot].present; }

  ISO_INLINE const std::vector<std::uint64_t>& pairs() const { return pairs_.keys(); }
  /// The number of bodies that the budget keeps from some of their pairs.
  std::uint32_t bodies_left_out() const { return left_out_; }
  const ChosenBroadPhase<S>& boxes() const { return boxes_; }
  /// Moves the boxes to another structure.
  void use(BroadPhaseName name);

  /// Visits the pairs alone: structures differ between worlds that agree.
  template <class Visit> void visit_scratch(const Visit& visit) {
    visit("pairs", const_cast<std::vector<std::uint64_t>&>(pairs_.keys()));  // injected faults are written to them
  }

 private:
  struct MayCollide {
    const std::vector<Proxy<S>>* proxies;
    ISO_INLINE bool operator()(std::uint32_t a, std::uint32_t b) const {
      return (*proxies)[a].traits.pairs_with((*proxies)[b].traits);
    }
  };

  ISO_INLINE Proxy<S> proxy_of(const BodyState<S>& state, const BodyProperties<S>& body, bool awake) const {
    return {state.fat, ProxyTraits::of(body, shapes_[body.shape]->traits, awake), true};
  }

  const StoredShapes<S>& shapes_;
  ChosenBroadPhase<S> boxes_;
  PairSet<S> pairs_;
  Crowd<S> crowd_;
  std::uint32_t left_out_ = 0;
  std::vector<Proxy<S>> proxies_;  // by slot
};

#define ISO_PROXIES_OF(extern, S) extern template class Proxies<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PROXIES_OF)

}  // namespace isostep
