// JoinedBodies<S>: what joints tie to a body, as a tree.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/store/body_map.hpp"

namespace isostep {

/// Input:   the joints of awake bodies.
/// Output:  the mechanism of a body: all dynamic bodies that chains of joints connect with it; the same as a tree.
/// Keeps:   nothing but memory.
/// Order:   follows from the order of bodies and joints alone.
template <class S> class JoinedBodies {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// A body of a tree. Its place follows from that of the joint's other body, which comes before it in the tree, or
  /// which no joint moves.
  struct Link {
    std::uint32_t body;   // among the awake ones
    std::uint32_t joint;  // among those of the state; kNone: of the root
    bool is_b;            // of the joint
  };

  ISO_INLINE JoinedBodies(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  /// Takes the joints as they are now; no body is known yet.
  void begin();
  ISO_INLINE bool is_known(std::uint32_t body) const { return known_[body] != 0; }
  /// Finds the mechanism of a body that is not known yet, by index among the awake bodies. The body comes first.
  std::span<const std::uint32_t> find(std::uint32_t body);
  /// Returns true if joints tie the mechanism of find() to a body that they do not move, or to the world.
  bool is_held() const;
  /// Returns the tree of the mechanism of find(), each body once. It grows from joints with unmoved bodies or, without
  /// those, from `root`. Leaves out joints that close a loop.
  std::span<const Link> tree_from(std::uint32_t root);

 private:
  /// Calls visit(joint, is_b), where is_b tells that the body is the joint's b.
  template <class Visit> ISO_INLINE void each_joint(std::uint32_t body, const Visit& visit) const {
    for (std::uint32_t i = first_[body]; i < first_[body + 1]; ++i) visit(at_body_[i] / 2, at_body_[i] % 2 != 0);
  }
  std::uint32_t dynamic_at(std::uint32_t slot) const;
  std::uint32_t other_of(std::uint32_t joint, bool is_b) const;
  void add(const Link& link);

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::vector<std::uint32_t> first_, filled_, at_body_;  // of each body its joints, each twice its place, plus 1 for b
  std::vector<std::uint8_t> known_, in_tree_;            // by body
  std::vector<std::uint32_t> members_;
  std::vector<Link> links_;
};

}  // namespace isostep
