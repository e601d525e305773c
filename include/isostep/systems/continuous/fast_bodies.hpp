// FastBodies<S>: who moves so far in a step that it is swept, and what comes towards it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/systems/continuous/pair_sweep.hpp"

namespace isostep {

/// Input:   the state after the solver, how its bodies moved, the broad phase.
/// Output:  movers: dynamic bodies that move by more than half of the inner radii of their part and of the thinnest
///          static or kinematic one, or end deep inside a fixed body, or meet a fast kinematic body; then bullets in
///          the way of others. Fast kinematic bodies. Boxes of dynamic bodies that were outside their fat boxes.
/// Keeps:   nothing from step to step but memory.
/// Order:   deep and fast bodies by index among the awake bodies, then bodies that were met, then bullets.
template <class S> class FastBodies {
 public:
  /// A fast kinematic body.
  struct Carrier {
    std::uint32_t slot;
    Aabb<S> swept;
  };

  /// A static or kinematic body.
  struct Fixed {
    std::uint32_t slot;
    Aabb<S> fat;
  };

  ISO_INLINE FastBodies(const WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies,
                        const StepMotion<S>& motion, const PairSweep<S>& pairs)
      : state_(state), map_(map), proxies_(proxies), motion_(motion), pairs_(pairs) {}

  /// Finds all movers but slow bullets.
  void find();
  /// Adds slow bullets. Call it when fixed bodies have cut the movers. Returns false if there are no bullets at all.
  bool find_bullets();
  ISO_INLINE std::span<Mover<S>> movers() { return movers_; }
  ISO_INLINE std::span<const Carrier> carriers() const { return carriers_; }
  /// All static and kinematic bodies, if `knows_fixed`: they are so few that a look at each takes less time than one
  /// into the boxes of all bodies.
  ISO_INLINE bool knows_fixed() const { return knows_fixed_; }
  ISO_INLINE std::span<const Fixed> fixed() const { return fixed_; }
  /// Boxes around the motions of bodies that may meet a bullet outside their fat boxes, by slot.
  ISO_INLINE const AabbTree<S>& comers() const { return comers_; }
  /// Numbers the movers for mover_of(), by index among the awake bodies.
  void number();
  /// Returns null if the body is no mover.
  ISO_INLINE const Mover<S>* mover_of(std::size_t index) const {
    return mover_of_[index] == 0 ? nullptr : &movers_[mover_of_[index] - 1];
  }

 private:
  /// Values over all bodies that decide which of them are fast.
  struct Survey {
    S thinnest;  // [m] inner radius of what stops a body, up to kThick
    bool bullets, kinematic;
  };
  static constexpr std::size_t kFewFixed = 128;
  static constexpr std::uint32_t kAsked = 1, kDeepInside = 2;  // of mover_of_, before there are movers

  Survey survey() const;
  S thinnest_static() const;
  std::uint64_t thinnest_of_page(std::size_t page) const;
  void mark_deep(std::span<const std::uint32_t> asked);
  void leave_out_joined();
  void add_if_fast(std::size_t index);
  void find_met_by_kinematic(S least);
  bool are_still_more_than(std::size_t most) const;
  void list_fixed();
  void find_comers();

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  const Proxies<S>& proxies_;
  const StepMotion<S>& motion_;
  const PairSweep<S>& pairs_;
  Survey survey_ = {};  // of this step
  std::vector<Mover<S>> movers_;
  std::vector<Carrier> carriers_;
  std::vector<Fixed> fixed_;
  bool knows_fixed_ = false;
  AabbTree<S> comers_;
  std::vector<std::uint32_t> met_, sort_scratch_;  // by fast kinematic bodies: indices among the awake ones
  std::vector<std::uint32_t> mover_of_;            // by that index: its place in movers_, plus 1; 0: none
};

}  // namespace isostep
