// The shape of a tree of ball joints: what trees have in common that are solved side by side.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// A span whose functions leave no symbol: what kernels of one instruction set include must not.
template <class T> struct KernelSpan {
  const T* first;
  std::size_t count;

  ISO_INLINE std::size_t size() const { return count; }
  ISO_INLINE const T& operator[](std::size_t i) const { return first[i]; }
  ISO_INLINE const T* begin() const { return first; }
  ISO_INLINE const T* end() const { return first + count; }
};

/// A joint of the shape, numbered in the order of elimination.
struct TreeJoint {
  std::uint32_t body_a, body_b;
  std::uint32_t first_link, link_count;  // to joints that are eliminated later
  bool a_moves, b_moves;
  bool closes_loop;  // through the world
};
/// Two joints at one body.
struct TreeLink {
  std::uint32_t to;
  bool from_is_a, to_is_a;  // which end of either is at the body
};
/// A body of the shape, by a joint that it has. What does not move is one body an end, even where it is the same one.
struct TreeBody {
  std::uint32_t joint;
  bool is_a, moves;
};

struct TreeShape {
  KernelSpan<TreeJoint> joints;
  KernelSpan<TreeLink> links;
  KernelSpan<TreeBody> bodies;
  KernelSpan<std::uint32_t> given;  // joints in the order in which they were made
};

}  // namespace isostep
