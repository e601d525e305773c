// Crowd<S>: which pairs a step looks at where there are more of them than its budget allows.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/core/bitset.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/store/proxy.hpp"

namespace isostep {

/// The pairs of bodies in one place grow by the square of their number. A budget bounds a step's time and memory.
/// Method:  All pairs, if they are no more than the budget. Else, in this order and until it is used up: pairs with
///          what is static, kinematic or asleep, so that nothing falls through a floor; pairs of moving bodies that
///          have contacts; new pairs. The first kind that is too much is shared: each awake body gets budget / bodies
///          partners. Among moving bodies they are those behind it, nearest first, in the walk of a tree.
/// Order:   The tree is built anew from the bodies in order of their slots. So the tree and the choice are functions of
///          the state: of boxes, traits and contacts alone, not of what came before.
/// Cost:    O(bodies log bodies + budget) if few boxes meet in vain. Whole subtrees are skipped by the filters and
///          kinds in them, so bodies that do not collide with one another cost no more in one place than apart.
template <class S> class Crowd {
 public:
  /// `proxies`: by slot. `contacts`: of the last step, ascending by key. Then keys() are the chosen pairs, ascending.
  void choose(std::span<const Proxy<S>> proxies, std::span<const Contact<S>> contacts, std::size_t budget);

  std::vector<std::uint64_t>& keys() { return keys_; }
  /// Returns true if these are all pairs.
  bool whole() const { return left_out_ == 0; }
  /// The number of bodies that were not given all their pairs.
  std::uint32_t bodies_left_out() const { return left_out_; }

 private:
  /// A search finds the pairs of a body with everything that is not free, or the pairs of two free bodies.
  enum class Side : std::uint8_t { held, free };
  struct Search;

  void build(std::span<const Proxy<S>> proxies);
  void forget(std::size_t all_but);
  bool gather(Side side, std::size_t share, std::size_t most);
  void keep_contacts(std::span<const Contact<S>> contacts, std::size_t most);
  bool has_contacts(std::uint64_t key) const;
  std::size_t share_of(std::size_t room) const;
  void leave_out(std::uint32_t slot) { left_out_ += is_left_out_.insert(slot) ? 1u : 0u; }

  std::span<const Proxy<S>> proxies_;
  AabbTree<S> tree_;
  std::vector<ProxyTraits> traits_;   // by node
  std::vector<std::uint32_t> awake_;  // slots of those that may pair
  std::vector<std::uint64_t> keys_, scratch_;
  std::size_t contacts_begin_ = 0, contacts_end_ = 0;  // in keys_: ascending
  Bitset is_left_out_;
  std::uint32_t left_out_ = 0;
};

}  // namespace isostep
