// Bodies of part_pairs.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/store/body_frames.inl"
#include "isostep/systems/contacts/part_pairs.hpp"
#include "isostep/systems/contacts/throng.inl"

namespace isostep {

template <class S> void PartPairs<S>::begin(std::span<const std::uint64_t> apart) {
  collect_joined_pairs(apart);
  make_room_for_frames();
}

template <class S> void PartPairs<S>::collect_joined_pairs(std::span<const std::uint64_t> apart) {
  joined_pairs_.assign(apart.begin(), apart.end());
  for (const JointProperties<S>& joint : state_.joints.properties) {
    if ((joint.flags & joint_flag::kCollideConnected) != 0 || joint.body_a == kNoBody || joint.body_b == kNoBody)
      continue;
    joined_pairs_.push_back(pair_key(joint.body_a, joint.body_b));
  }
  sort_scratch_.resize(joined_pairs_.size());
  stable_sort(joined_pairs_.data(), sort_scratch_.data(), static_cast<std::uint32_t>(joined_pairs_.size()), OwnKey{});
}

/// Places the frames of awake bodies first, in their order. Frames of other bodies are added when they are met.
template <class S> void PartPairs<S>::make_room_for_frames() {
  const std::size_t count = state_.awake.states.size();
  for (const std::uint32_t slot : framed_slots_) framed_[slot] = Framed{};
  framed_.resize(map_.slot_count());
  framed_slots_.resize(count);
  frames_.resize(count);
  materials_.resize(count);
}
template <class S> void PartPairs<S>::frame_awake_body(std::size_t index) {
  const auto i = static_cast<std::uint32_t>(index);
  frames_[i] = frame_at(map_, {Location::kAwake, i});
  materials_[i] = state_.awake.properties[i].material;
  framed_[frames_[i].slot] = {i, traits_of(frames_[i])};
  framed_slots_[i] = frames_[i].slot;
}
template <class S> void PartPairs<S>::frame_body(std::uint32_t slot) {
  const BodyFrame<S> frame = frame_at(map_, map_.location(slot));
  framed_[slot] = {static_cast<std::uint32_t>(frames_.size()), traits_of(frame)};
  framed_slots_.push_back(slot);
  frames_.push_back(frame);
  materials_.push_back(map_.properties_at(map_.location(slot)).material);
}
template <class S> std::uint32_t PartPairs<S>::traits_of(const BodyFrame<S>& frame) {
  return static_cast<std::uint32_t>(frame.kind) | (frame.senses ? Framed::kSenses : 0u) |
         (frame.asleep ? Framed::kAsleep : 0u);
}

template <class S> std::uint32_t PartPairs<S>::gather(std::span<const std::uint64_t> pairs) {
  const auto budget = static_cast<std::uint64_t>(state_.settings.most_pairs);
  const Budget all = {most_looks(budget), most_parts(budget)};
  cut_compounds_ = 0;
  find_throng(pairs);
  if (gather(pairs, all, all)) return 0;
  const std::uint64_t count = pairs.size();
  gather(pairs, {all.looks / count, all.parts / count}, {~std::uint64_t{0}, ~std::uint64_t{0}});
  return cut_compounds_;
}
template <class S> void PartPairs<S>::find_throng(std::span<const std::uint64_t> pairs) {
  const std::span<const BodyFrame<S>> awake = std::span(frames_).first(state_.awake.states.size());
  throng_.begin(awake, state_.awake.properties, pairs.size());
  if (!throng_.any()) return;
  for (const std::uint64_t key : pairs) throng_.count(framed_[pair_a(key)].index, framed_[pair_b(key)].index);
}
/// Returns false if the pairs exceed the budget `all`.
template <class S> bool PartPairs<S>::gather(std::span<const std::uint64_t> pairs, Budget each, Budget all) {
  const std::uint64_t most_looks = all.looks;
  parts_.clear();
  groups_.clear();
  spheres_.clear();
  boxes_.clear();
  others_.clear();
  std::size_t joined = 0;
  for (const std::uint64_t key : pairs) {
    while (joined < joined_pairs_.size() && joined_pairs_[joined] < key) ++joined;
    if (joined < joined_pairs_.size() && joined_pairs_[joined] == key) continue;
    if (framed_[pair_a(key)].index == Framed::kNone) frame_body(pair_a(key));
    if (framed_[pair_b(key)].index == Framed::kNone) frame_body(pair_b(key));
    const Framed a = framed_[pair_a(key)], b = framed_[pair_b(key)];
    if (throng_.any() && throng_.leaves_out(a.index, b.index)) continue;
    if (a.traits == b.traits && a.traits < static_cast<std::uint32_t>(PartKind::other)) {  // awake and no sensors
      const bool spheres = a.traits == static_cast<std::uint32_t>(PartKind::sphere);
      add_part(spheres ? spheres_ : boxes_, {a.index, b.index, 0, 0});
    } else if (!gather_others(a, b, each, all)) {
      if (all.looks == 0 || all.parts == 0) return false;
      ++cut_compounds_;
    }
  }
  looks_ = most_looks - all.looks;
  return true;
}
/// Uses at most `each`, and takes it from `all`. Returns false if the pair needs more.
template <class S> bool PartPairs<S>::gather_others(Framed at_a, Framed at_b, const Budget& each, Budget& all) {
  const std::uint32_t either = at_a.traits | at_b.traits;
  const bool sensor = (either & Framed::kSenses) != 0, asleep = (either & Framed::kAsleep) != 0;
  if (!sensor && asleep) return true;  // a kinematic body at rest against sleepers
  const BodyFrame<S>&a = frames_[at_a.index], &b = frames_[at_b.index];
  const bool traits = a.traits || b.traits;
  const S margin = sensor && !traits ? S(0) : detail::kSpeculativeDistance<S>;
  const bool presses = traits && !asleep && map_.is_pushed(a.slot, b.slot);
  const std::uint64_t most_looks = min(each.looks, all.looks), most_parts = min(each.parts, all.parts);
  std::uint64_t looks = most_looks, parts = most_parts;
  const auto visit = [&](std::uint32_t i, std::uint32_t j) {
    if (traits && !meet(a, i, b, j, presses)) return true;
    if (parts == 0) return false;
    --parts;
    add_part(others_, {at_a.index, at_b.index, i, j});
    return true;
  };
  const bool whole = is_large(a) || is_large(b) ? visit_sorted_leaves(a, b, margin, looks, visit)
                                                : visit_parts(a, b, margin, looks, visit);
  all.looks -= most_looks - looks;
  all.parts -= most_parts - parts;
  return whole;
}
/// Returns true if two parts are sensed, or press on each other. Sleepers and unpushed bodies are only sensed.
template <class S>
bool PartPairs<S>::meet(const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b, std::uint32_t j,
                        bool presses) const {
  const PartMeeting meeting = meeting_of(map_, a, i, b, j);
  return meeting == PartMeeting::sensed || (meeting == PartMeeting::solid && presses);
}
template <class S>
template <class Visit>
bool PartPairs<S>::visit_sorted_leaves(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, std::uint64_t& looks,
                                       Visit& visit) {
  leaf_pairs_.clear();
  const bool whole = visit_leaves(a, b, margin, looks, [&](std::uint32_t i, std::uint32_t j) {
    leaf_pairs_.push_back(std::uint64_t{i} << 32 | j);
    return true;
  });
  const auto count = static_cast<std::uint32_t>(leaf_pairs_.size());
  if (sort_scratch_.size() < count) sort_scratch_.resize(count);
  stable_sort(leaf_pairs_.data(), sort_scratch_.data(), count, OwnKey{});
  for (const std::uint64_t pair : leaf_pairs_) {
    if (!visit(static_cast<std::uint32_t>(pair >> 32), static_cast<std::uint32_t>(pair))) return false;
  }
  return whole;
}
template <class S> ISO_INLINE void PartPairs<S>::add_part(std::vector<std::uint32_t>& list, const PartPair& part) {
  if (groups_.empty() || ends_group(part)) groups_.push_back(list_ends());
  list.push_back(static_cast<std::uint32_t>(parts_.size()) - groups_.back().parts);
  parts_.push_back(part);
}
template <class S> ISO_INLINE bool PartPairs<S>::ends_group(const PartPair& part) const {
  const std::size_t size = parts_.size() - groups_.back().parts;
  if (size < PartGroup::kEnough) return false;
  const PartPair& last = parts_.back();
  const bool continues = last.frame_a == part.frame_a && last.frame_b == part.frame_b;
  const bool on_surface = frames_[part.frame_a].surfaces || frames_[part.frame_b].surfaces;
  return !continues || !on_surface || size == PartGroup::kMost;
}

template <class S> typename PartPairs<S>::ListEnds PartPairs<S>::list_ends() const {
  return {static_cast<std::uint32_t>(parts_.size()), static_cast<std::uint32_t>(spheres_.size()),
          static_cast<std::uint32_t>(boxes_.size()), static_cast<std::uint32_t>(others_.size())};
}
template <class S> PartGroup PartPairs<S>::group(std::size_t index) const {
  const ListEnds from = groups_[index], to = index + 1 < groups_.size() ? groups_[index + 1] : list_ends();
  const auto part_of = [](const auto& list, std::uint32_t begin, std::uint32_t end) {
    return std::span(list).subspan(begin, end - begin);
  };
  return {from.parts, part_of(parts_, from.parts, to.parts), part_of(spheres_, from.spheres, to.spheres),
          part_of(boxes_, from.boxes, to.boxes), part_of(others_, from.others, to.others)};
}

}  // namespace isostep
