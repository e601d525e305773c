// WorldEngine: hashing, loading, and the portable form.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/state/slots.hpp"
#include "isostep/world/engine.hpp"
#include "isostep/world/engine_sleep.inl"
#include "isostep/world/state_validator.hpp"

namespace isostep {

/// Root: settings, tick, slot tables, arrays, then the frozen islands' own hashes, in this order; of the islands every
/// 256 that are followed by another are one word, for they rarely change.
template <class S> std::uint64_t WorldEngine<S>::hash() const {
  HashCombiner root;
  root.add(hash_records_by_fields(&state_.settings, 1));
  root.add(state_.tick);
  root.add(detail::hash_slots(state_.body_slots));
  root.add(detail::hash_slots(state_.shape_slots));
  root.add(detail::hash_slots(state_.joint_slots));
  const auto add = [&](const Remembered& known, const auto& array) {
    root.add(known.get([&] { return hash_records(array.data(), array.size()); }));
  };
  add(state_.shapes.remembered(), *state_.shapes);
  add(state_.children.remembered(), *state_.children);
  add(state_.fixed.remembered(0), state_.fixed->states);
  add(state_.fixed.remembered(1), state_.fixed->properties);
  WorldState<S>::own_sections(
      [&](const char*, const auto& array) { root.add(hash_records(array.data(), array.size())); }, state_);
  const FrozenIslands<S>& frozen = state_.frozen;
  for (std::size_t p = 0; p + 1 < frozen.pages(); ++p) {
    root.add(frozen.remembered(p).get([&] {
      HashCombiner page;
      for (std::size_t i = 0; i < frozen.page_size(p); ++i) page.add(frozen.page(p)[i]->hash);
      return page.value();
    }));
  }
  if (!frozen.empty()) {
    const std::size_t last = frozen.pages() - 1;
    for (std::size_t i = 0; i < frozen.page_size(last); ++i) root.add(frozen.page(last)[i]->hash);
  }
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
  ++loads_;
  events_.clear();
  report_ = {};
  fault_ = {};
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

template <class S> void WorldEngine<S>::write_portable(Writer& writer) const {
  writer.write(ScalarTraits<S>::kId);
  writer.write(state_.settings);
  writer.write(state_.tick);
  detail::write_slots(writer, state_.body_slots);
  detail::write_slots(writer, state_.shape_slots);
  detail::write_slots(writer, state_.joint_slots);
  WorldState<S>::sections([&](const char*, const auto& array) { writer.write_array(array); }, state_);
  writer.write_count(state_.frozen.size());
  for (const std::shared_ptr<const FrozenIsland<S>>& island : state_.frozen) {
    FrozenIsland<S>::sections([&](const char*, const auto& array) { writer.write_array(array); }, *island);
  }
}

template <class S> Result<void> WorldEngine<S>::read_portable(Reader& reader) {
  WorldState<S> next;
  if (reader.read<std::uint32_t>() != ScalarTraits<S>::kId && reader.ok()) {
    reader.fail(ErrorCode::incompatible, "not written by a rigid world of this scalar");
  }
  reader.read(next.settings);
  reader.read(next.tick);
  detail::read_slots(reader, next.body_slots);
  detail::read_slots(reader, next.shape_slots);
  detail::read_slots(reader, next.joint_slots);
  const auto read_section = [&](const char*, auto& array) { reader.read_array(array, detail::kMaxRecords); };
  WorldState<S>::sections(read_section, next);
  const std::uint32_t islands = reader.read_count(detail::kMaxRecords, 20);
  for (std::uint32_t i = 0; i < islands && reader.ok(); ++i) {
    auto island = std::make_shared<FrozenIsland<S>>();
    FrozenIsland<S>::sections(read_section, *island);
    island->hash = detail::hash_island(*island);
    next.frozen.push_back(std::move(island));
  }
  if (reader.ok()) {
    if (const char* rule = StateValidator<S>(next).broken_rule()) reader.fail(ErrorCode::corrupt, rule);
  }
  const Result<void> result = reader.result("world");
  if (reader.ok()) load(next);
  return result;
}

}  // namespace isostep
