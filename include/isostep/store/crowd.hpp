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

/// Bodies in one place have pairs by the square of their number; a budget keeps a step's time and memory in bounds.
/// Method:  All pairs, if they are no more than the budget. Else, in this order and as far as it lasts: pairs with what
///          is static, kinematic or asleep, so that nothing falls through a floor; pairs of moving bodies that have
///          contacts already; new ones. What is first to be too much is shared: each moving body gets as many partners
///          as there is budget a body, those that stand behind it, nearest first, in the walk of a tree.
/// Order:   that tree is built anew from the bodies in order of their slots, so it is a function of the state, and with
///          it the choice: of boxes, traits and contacts alone, not of what came before.
/// Cost:    O(bodies log bodies + budget) where few boxes meet in vain. Whole subtrees are left out by what filters
///          and kinds they hold, so bodies that do not collide with one another cost no more in one place than apart.
template <class S> class Crowd {
 public:
  /// `proxies` by slot; `contacts` of the last step, ascending by key. Afterwards keys() are the choice, ascending.
  void choose(std::span<const Proxy<S>> proxies, std::span<const Contact<S>> contacts, std::size_t budget);

  std::vector<std::uint64_t>& keys() { return keys_; }
  /// Whether these are all pairs that there are.
  bool whole() const { return left_out_ == 0; }
  /// Bodies that were not given all their pairs.
  std::uint32_t bodies_left_out() const { return left_out_; }

 private:
  /// A search finds the pairs of a body with everything that is not free, or those of two free bodies.
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
