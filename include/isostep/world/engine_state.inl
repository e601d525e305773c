// WorldEngine: hashing, loading, and the portable form.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/state/members.hpp"
#include "isostep/world/engine.hpp"
#include "isostep/world/engine_sleep.inl"
#include "isostep/world/state_validator.hpp"

namespace isostep {

template <class S> std::uint64_t WorldEngine<S>::hash() const {
  detail::StateHasher root;
  WorldState<S>::members(root, state_);
  return root.value();
}

namespace detail {
/// What a world was made with: gravity alone is changed by commands.
template <class S> bool same_making(const Settings<S>& a, const Settings<S>& b) {
  return a.hz == b.hz && a.substeps == b.substeps && a.allow_sleep == b.allow_sleep && a.solver == b.solver &&
         a.id_space == b.id_space && a.most_pairs == b.most_pairs;
}
}  // namespace detail

/// Takes time for what is awake in either state, for the islands that only one of them has at their place, and for what
/// is fixed if that differs.
template <class S> void WorldEngine<S>::load(const WorldState<S>& from) {
  other_islands_.clear();
  state_.frozen.each_difference(from.frozen,
                                [&](std::size_t i) { other_islands_.push_back(static_cast<std::uint32_t>(i)); });
  const bool other_fixed = !state_.fixed.is_same(from.fixed);
  forget_places(other_fixed);
  state_ = from;
  journal_.note_load();
  events_.clear();
  report_ = {};
  start_slots_.clear();
  renew_places(other_fixed);
}

/// Of everything but the islands, and the fixed bodies, that stay.
template <class S> void WorldEngine<S>::forget_places(bool other_fixed) {
  slots_.clear();
  const auto forget = [&](const BodySet<S>& bodies, const JointSet<S>& joints) {
    for (const BodyState<S>& body : bodies.states) {
      locations_[body.slot] = Location{};
      slots_.push_back(body.slot);
    }
    for (const JointState<S>& joint : joints.states) joint_locations_[joint.slot] = Location{};
  };
  if (other_fixed) forget(*state_.fixed, {});
  forget(state_.awake, state_.joints);
  for (const std::uint32_t i : other_islands_) {
    if (i >= state_.frozen.size()) continue;
    forget(state_.frozen[i]->bodies, state_.frozen[i]->joints);
    count_names(*state_.frozen[i], ~0u);
  }
}

/// Of the same in the new state; the broad phase changes only where a body differs from what it knew.
template <class S> void WorldEngine<S>::renew_places(bool other_fixed) {
  if (locations_.size() < state_.body_slots.entries().size()) {
    locations_.resize(state_.body_slots.entries().size());
    named_.resize(locations_.size());
  }
  if (joint_locations_.size() < state_.joint_slots.entries().size())
    joint_locations_.resize(state_.joint_slots.entries().size());
  const auto take = [&](const BodySet<S>& set, std::uint32_t name, bool awake) {
    relabel(set, name, 0);
    for (std::size_t i = 0; i < set.states.size(); ++i) proxies_.place(set.states[i], set.properties[i], awake);
  };
  if (other_fixed) take(*state_.fixed, Location::kFixed, false);
  take(state_.awake, Location::kAwake, true);
  relabel_joints(state_.joints, Location::kAwake, 0);
  for (const std::uint32_t i : other_islands_) {
    if (i >= state_.frozen.size()) continue;
    take(state_.frozen[i]->bodies, i, false);
    relabel_joints(state_.frozen[i]->joints, i, 0);
    count_names(*state_.frozen[i], 1);
  }
  for (const std::uint32_t slot : slots_) {
    if (locations_[slot].set == Location::kNone) proxies_.remove(slot);
  }
}

namespace detail {
/// In the first word of a portable world, beside the scalar's id: blobs stand at its end.
inline constexpr std::uint32_t kBlobsBit = 0x40000000u;
}  // namespace detail

template <class S> void WorldEngine<S>::write_portable(Writer& writer) const {
  writer.write(ScalarTraits<S>::kId | (state_.geometry->empty() ? 0 : detail::kBlobsBit));
  WorldState<S>::members(detail::StateWriter(writer), state_);
}

template <class S> Result<void> WorldEngine<S>::read_portable(Reader& reader) {
  WorldState<S> next;
  const auto kind = reader.read<std::uint32_t>();
  if ((kind & ~detail::kBlobsBit) != ScalarTraits<S>::kId && reader.ok())
    reader.fail(ErrorCode::incompatible, "not written by a rigid world of this scalar");
  const auto read_store = [&](GeometryStore& store) {
    if ((kind & detail::kBlobsBit) != 0) store.read(reader, *state_.geometry, assets_);
  };
  WorldState<S>::members(detail::StateReader(reader, read_store), next);
  if (reader.ok()) {
    if (const char* rule = StateValidator<S>(next).broken_rule()) reader.fail(ErrorCode::corrupt, rule);
  }
  const Result<void> result = reader.result("world");
  if (reader.ok()) load(next);
  return result;
}

}  // namespace isostep
