// Which bodies might touch: the tree of fat boxes and the pairs it yields, kept in step with the state they derive
// from.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/dynamics/body.hpp"

namespace isostep {

/// A cache, not state: the pairs are a function of every body's fat box, type, filter, and whether it is awake and a
/// sensor, all of them state. `place` compares with what it knew, so that loading a snapshot renews only what differs.
template <class S> class Proxies {
 public:
  void place(const BodyState<S>& state, const BodyProperties<S>& body, bool awake);
  void remove(std::uint32_t slot);
  void update();
  /// One past the largest slot met.
  std::size_t slots() const { return keys_.size(); }
  bool present(std::uint32_t slot) const { return slot < keys_.size() && keys_[slot].present; }

  ISO_INLINE const std::vector<std::uint64_t>& pairs() const { return pairs_.keys(); }
  const AabbTree<S>& tree() const { return tree_; }

 private:
  /// All that decides whether a body pairs with another.
  struct Key {
    Aabb<S> box;
    Filter filter;
    bool present, awake, dynamic, sensor, collides;
  };
  struct MayCollide {
    const std::vector<Key>* keys;
    ISO_INLINE bool operator()(std::uint32_t a, std::uint32_t b) const {
      const Key& ka = (*keys)[a];
      const Key& kb = (*keys)[b];
      // A sensor sees whatever moves, and what it passes when it moves itself; no other sensor.
      const bool meet = ka.sensor != kb.sensor || (!ka.sensor && (ka.dynamic || kb.dynamic));
      return meet && (ka.awake || kb.awake) && ka.collides && kb.collides && should_collide(ka.filter, kb.filter);
    }
  };

  AabbTree<S> tree_;
  PairSet<S> pairs_;
  std::vector<Key> keys_;  // by slot
};

}  // namespace isostep
