// Throng<S>: of bodies deep inside one another each collides with some of the others.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/collision/narrowphase/pair_kernels.hpp"
#include "isostep/dynamics/body.hpp"

namespace isostep {

/// Each of n bodies in one place overlaps all others. All n^2 / 2 contacts push at once, and what one relaxes another
/// has pushed: a thousand crates leave at 70 m/s, and a step takes seconds. A few partners push a body out as well.
/// Input:   a step's pairs and the frames of its awake bodies.
/// Output:  which pairs are left out.
/// Method:  a pair is deep if its centres are nearer than kDeep of the smaller inner radius. Of the pairs of two bodies
///          with more deep ones than kDeepest each, about kPartners a body are kept, by a hash of their slots: the
///          choice is a function of the state, and stays the same while the throng does.
/// Limits:  bodies of several parts, and what no contact moves, are none of a throng. Steps with fewer than kFew pairs
///          a body are not looked at; bodies that touch are two inner radii apart, so a heap has no deep pairs.
template <class S> class Throng {
 public:
  /// Begins with the frames and properties of all awake bodies, in their order.
  void begin(std::span<const BodyFrame<S>> frames, std::span<const BodyProperties<S>> bodies, std::size_t pairs);
  ISO_INLINE bool any() const { return !members_.empty(); }
  /// Counts a pair by its frames; after all pairs leaves_out() knows.
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
  /// [1] Two balls of a throng with the same centre are pushed apart along it: along one axis all would pile up on it.
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
