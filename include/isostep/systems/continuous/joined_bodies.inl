// Bodies of joined_bodies.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/continuous/joined_bodies.hpp"

namespace isostep {

/// Returns the index of a dynamic body among the awake ones. kNone: the world, or a body that joints do not move.
template <class S> std::uint32_t JoinedBodies<S>::dynamic_at(std::uint32_t slot) const {
  if (slot == kNoBody) return kNone;
  const Location at = map_.location(slot);
  const bool moves = at.set == Location::kAwake && map_.properties_at(at).type == BodyType::dynamic;
  return moves ? at.index : kNone;
}
/// Returns the body at the other end of the joint.
template <class S> std::uint32_t JoinedBodies<S>::other_of(std::uint32_t joint, bool is_b) const {
  const JointProperties<S>& p = state_.joints.properties[joint];
  return dynamic_at(is_b ? p.body_a : p.body_b);
}

template <class S> void JoinedBodies<S>::begin() {
  const std::size_t count = state_.awake.states.size();
  const std::span<const JointProperties<S>> joints = state_.joints.properties;
  const auto each_end = [&](const auto& act) {
    for (std::uint32_t i = 0; i < joints.size(); ++i) {
      if (!map_.is_enabled(joints[i])) continue;
      const std::uint32_t ends[] = {dynamic_at(joints[i].body_a), dynamic_at(joints[i].body_b)};
      for (std::uint32_t end = 0; end < 2; ++end) {
        if (ends[end] != kNone) act(ends[end], 2 * i + end);
      }
    }
  };
  known_.assign(count, 0);
  in_tree_.assign(count, 0);
  first_.assign(count + 1, 0);
  each_end([&](std::uint32_t body, std::uint32_t) { ++first_[body + 1]; });
  for (std::size_t i = 0; i < count; ++i) first_[i + 1] += first_[i];
  filled_.assign(first_.begin(), first_.end());
  at_body_.resize(first_[count]);
  each_end([&](std::uint32_t body, std::uint32_t joint) { at_body_[filled_[body]++] = joint; });
}

template <class S> std::span<const std::uint32_t> JoinedBodies<S>::find(std::uint32_t body) {
  members_.assign(1, body);
  known_[body] = 1;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    each_joint(members_[i], [&](std::uint32_t joint, bool is_b) {
      const std::uint32_t other = other_of(joint, is_b);
      if (other == kNone || known_[other] != 0) return;
      known_[other] = 1;
      members_.push_back(other);
    });
  }
  return members_;
}

template <class S> bool JoinedBodies<S>::is_held() const {
  bool held = false;
  for (const std::uint32_t body : members_) {
    each_joint(body, [&](std::uint32_t joint, bool is_b) { held = held || other_of(joint, is_b) == kNone; });
  }
  return held;
}

template <class S> void JoinedBodies<S>::add(const Link& link) {
  if (in_tree_[link.body] != 0) return;
  in_tree_[link.body] = 1;
  links_.push_back(link);
}

template <class S> std::span<const typename JoinedBodies<S>::Link> JoinedBodies<S>::tree_from(std::uint32_t root) {
  links_.clear();
  for (const std::uint32_t body : members_) in_tree_[body] = 0;
  for (const std::uint32_t body : members_) {
    each_joint(body, [&](std::uint32_t joint, bool is_b) {
      if (other_of(joint, is_b) == kNone) add({body, joint, is_b});
    });
  }
  if (links_.empty()) add({root, kNone, false});
  for (std::size_t i = 0; i < links_.size(); ++i) {
    each_joint(links_[i].body, [&](std::uint32_t joint, bool is_b) {
      const std::uint32_t other = other_of(joint, is_b);
      if (other != kNone) add({other, joint, !is_b});
    });
  }
  return links_;
}

}  // namespace isostep
