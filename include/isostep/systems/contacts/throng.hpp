// Throng<S>: of bodies deep inside one another each collides with some of the others.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/collision/narrowphase/pair_kernels.hpp"
#include "isostep/dynamics/body.hpp"

namespace isostep {

/// Each of n bodies in one place overlaps all others. All n^2 / 2 contacts push at once, and each undoes what others
/// did: a thousand crates leave at 70 m/s, and a step takes seconds. A few partners push a body out as well.
/// Input:   a step's pairs and the frames of its awake bodies.
/// Output:  the pairs that are left out.
/// Method:  a pair is deep if its centres are nearer than kDeep of the smaller inner radius. Of the pairs of two bodies
///          with more than kDeepest deep pairs each, about kPartners a body are kept, by a hash of their slots: a
///          function of the state, which stays the same as long as the throng.
/// Limits:  bodies of several parts, and bodies that no contact moves, belong to no throng. A step with fewer than kFew
///          pairs a body is not searched. Bodies that touch are two inner radii apart: a heap has no deep pairs.
template <class S> class Throng {
 public:
  /// Begins with the frames and properties of all awake bodies, in their order.
  void begin(std::span<const BodyFrame<S>> frames, std::span<const BodyProperties<S>> bodies, std::size_t pairs);
  ISO_INLINE bool any() const { return !members_.empty(); }
  /// Returns true if a step with so many pairs and awake bodies is searched for throngs.
  static ISO_INLINE constexpr bool is_searched(std::uint64_t pairs, std::size_t bodies) {
    return bodies != 0 && pairs >= std::uint64_t{kFew} * bodies;
  }
  /// Counts a pair by its frames. Call it for all pairs before leaves_out().
  ISO_INLINE void count(std::uint32_t a, std::uint32_t b) {
    if (members_.size() <= max(a, b)) return;
    Member &of_a = members_[a], &of_b = members_[b];
    if (!(S(0) < min(of_a.reach, of_b.reach))) return;
    ++of_a.pairs;
    ++of_b.pairs;
    if (!is_deep(of_a, of_b)) return;
    ++of_a.deep;
    ++of_b.deep;
  }
  bool leaves_out(std::uint32_t a, std::uint32_t b) const;
  /// [1] The direction that separates two balls of a throng with one centre. Along one axis all would pile up on it.
  static Vec3<Unit<S>> way_apart(std::uint32_t slot_a, std::uint32_t slot_b);

 private:
  static constexpr std::size_t kFew = 32;        // pairs a body
  static constexpr std::uint32_t kDeepest = 4;   // pairs of a body that a blow may have driven so deep
  static constexpr std::uint32_t kPartners = 8;  // [1] more push faster: 16 at up to 15 m/s, 8 at 13
  static constexpr double kDeep = 1.5;           // [1] of the smaller inner radius

  struct Member {
    Vec3<S> centre;  // [m]
    S reach;         // [m] 0 of what is none of a throng
    std::uint32_t slot;
    std::uint32_t pairs, deep;
  };
  static bool is_deep(const Member& a, const Member& b);

  std::vector<Member> members_;  // by frame; empty: there is no throng
};

}  // namespace isostep
