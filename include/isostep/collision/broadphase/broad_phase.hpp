// BroadPhase: what a world asks of a structure of boxes, and all pairs of one in canonical order.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/core/stable_sort.hpp"

namespace isostep {

namespace detail {
/// Visitors of the three kinds, used by the concept alone.
struct AnyBoxVisit {
  bool operator()(std::uint32_t slot) const;
};
struct AnyPairVisit {
  void operator()(std::uint32_t slot, std::uint32_t other) const;
};
template <class S> struct AnySweepVisit { Unit<S> operator()(std::uint32_t slot, Unit<S> max_fraction) const; };
}  // namespace detail

/// A structure over boxes that the caller names by small integers (slots), each at most once.
///
/// The structure is a cache, not state: its shape depends on its history, and so does the order of visits, which is
/// never specified. The set of visits depends on the boxes alone, and equals that of brute force:
///   insert(slot, box)        the slot is free;  update(slot, box), remove(slot): it is taken
///   optimise()               restores quality after changes. Call it once before many queries. Results do not need it.
///   clear()                  forgets the boxes, keeps the memory
///   query(box, visit)        visit(slot) -> bool, once for every stored box that overlaps `box`; false ends it
///   sweep(sweep, visit)      visit(slot, max_fraction) -> the new max_fraction, not larger. Called at most once for
///                            every stored box, and at least for those that the sweep touches within the current
///                            fraction.
///   overlapping_pairs(matches, most, visit)            visit(slot, slot) once for every two stored boxes that overlap
///   overlapping_pairs_of(slots, matches, most, visit)  visit(slot, other) for every one of `slots` that is stored and
///                            every stored box that overlaps its own, itself included
/// The last two return false if they give up after `most` visits, or what the structure counts as such: some pairs are
/// not visited then. A caller whose results depend on order sorts: PairSet does, and all_pairs below.
/// Touching boxes overlap. Boxes have low <= high and coordinates within 4 position limits (geometry/limits.hpp).
/// No operation allocates once the structure has seen its greatest slot and size.
template <class B, class S>
concept BroadPhase = std::default_initializable<B> &&
    std::same_as<typename B::Matches, typename AabbTree<S>::Matches> &&
    requires(B b, const B& asked, std::uint32_t slot, const Aabb<S>& box, const Sweep<S>& sweep,
             std::span<const std::uint32_t> slot_list, typename B::Matches& matches, std::uint64_t most) {
  { b.insert(slot, box) } -> std::same_as<void>;
  { b.update(slot, box) } -> std::same_as<void>;
  { b.remove(slot) } -> std::same_as<void>;
  { b.optimise() } -> std::same_as<void>;
  { b.clear() } -> std::same_as<void>;
  { asked.size() } -> std::same_as<std::uint32_t>;
  { asked.contains(slot) } -> std::same_as<bool>;
  { asked.box(slot) } -> std::same_as<const Aabb<S>&>;
  { asked.query(box, detail::AnyBoxVisit{}) } -> std::same_as<void>;
  { asked.sweep(sweep, detail::AnySweepVisit<S>{}) } -> std::same_as<void>;
  { asked.overlapping_pairs(matches, most, detail::AnyPairVisit{}) } -> std::same_as<bool>;
  { asked.overlapping_pairs_of(slot_list, matches, most, detail::AnyPairVisit{}) } -> std::same_as<bool>;
  { asked.validate() } -> std::same_as<bool>;
};

namespace detail {
struct TakePair {
  std::vector<std::uint64_t>* keys;
  ISO_INLINE void operator()(std::uint32_t slot, std::uint32_t other) const { keys->push_back(pair_key(slot, other)); }
};
}  // namespace detail

/// Holds the memory of all_pairs. Keep it from call to call.
template <class S> struct AllPairs {
  std::vector<std::uint64_t> keys;  // ascending `pair_key`s
  std::vector<std::uint64_t> scratch;
  typename AabbTree<S>::Matches matches;
};

/// Finds every two stored boxes that overlap, in canonical order: pairs.keys. They are the same for every structure
/// over these boxes.
/// Source:  Millington 2007, Game Physics Engine Development, ch. 12: the potential contacts of a hierarchy or
///          partition.
template <class S, BroadPhase<S> B> ISO_INLINE void all_pairs(const B& structure, AllPairs<S>& pairs) {
  pairs.keys.clear();
  structure.overlapping_pairs(pairs.matches, ~std::uint64_t{0}, detail::TakePair{&pairs.keys});
  if (pairs.scratch.size() < pairs.keys.size()) pairs.scratch.resize(pairs.keys.size());
  stable_sort(pairs.keys.data(), pairs.scratch.data(), static_cast<std::uint32_t>(pairs.keys.size()), OwnKey{});
}

}  // namespace isostep
