// The shape of a tree of ball joints: what trees have in common that are solved side by side.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace isostep {

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
  std::span<const TreeJoint> joints;
  std::span<const TreeLink> links;
  std::span<const TreeBody> bodies;
  std::span<const std::uint32_t> given;  // joints in the order in which they were made
};

}  // namespace isostep
