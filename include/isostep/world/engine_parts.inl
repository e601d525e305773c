// WorldEngine: the frames of bodies, and the pairs of their parts that might touch.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/world/engine.hpp"

namespace isostep {

namespace detail {
template <class S> ISO_INLINE Transform<S> placed(const Transform<S>& origin, const Child<S>& child) {
  return child.pose.is_identity() ? origin : compose(origin, Transform<S>::of(child.pose));
}
}  // namespace detail

template <class S> BodyFrame<S> WorldEngine<S>::frame_at(Location at) const {
  const BodyState<S>& state = state_at(at);
  const BodyProperties<S>& body = properties_at(at);
  const std::span<const Child<S>> children = children_of(body.shape);
  const Mat3<Unit<S>> turn = to_matrix(state.orientation);
  const Primitive<S>& first = children[0].primitive;
  const bool plain = children.size() == 1 && children[0].pose.is_identity();
  return {first.half,
          first.radius,
          state.centre,
          {-(turn * body.local_centre), turn},
          children.data(),
          static_cast<std::uint32_t>(children.size()),
          state.slot,
          at.set == Location::kAwake ? at.index + 1 : 0,
          plain ? part_kind_of(first.type) : PartKind::other,
          plain,
          (body.flags & body_flag::kSensor) != 0,
          at.is_frozen()};
}

/// visit(child_a, child_b) for every two parts whose bounds meet within the margin, in order of their indices, until it
/// answers false or `looks`, which counts down, are used up. False: that came before the end.
template <class S>
template <class Visit>
ISO_INLINE bool WorldEngine<S>::visit_parts(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin,
                                            std::uint64_t& looks, Visit&& visit) {
  if (a.child_count == 1 && b.child_count == 1) return visit(0u, 0u);
  // Most compounds have few children: their boxes are found once, not once for each child of the other.
  constexpr std::uint32_t kFew = 8;
  const Transform<S> origin_b = origin_beside(a, b);
  const auto box_of_b = [&](std::uint32_t j) {
    return bounds(b.children[j].primitive, detail::placed(origin_b, b.children[j]));
  };
  Aabb<S> boxes_b[kFew];
  for (std::uint32_t j = 0; j < min(b.child_count, kFew); ++j) boxes_b[j] = box_of_b(j);
  for (std::uint32_t i = 0; i < a.child_count; ++i) {
    const Transform<S> ta = detail::placed(a.origin, a.children[i]);
    const Aabb<S> box_a = grow(bounds(a.children[i].primitive, ta), margin);
    for (std::uint32_t j = 0; j < b.child_count; ++j) {
      if (looks == 0) return false;
      --looks;
      if (overlap(box_a, j < kFew ? boxes_b[j] : box_of_b(j)) && !visit(i, j)) return false;
    }
  }
  return true;
}

template <class S>
void WorldEngine<S>::collide_parts(const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b, std::uint32_t j,
                                   S margin, Manifold<S>& out) {
  const Child<S>&part_a = a.children[i], &part_b = b.children[j];
  const Transform<S> origin_b = origin_beside(a, b);
  if (a.plain && b.plain) {
    collide(part_a.primitive, a.origin, part_b.primitive, origin_b, margin, out);
  } else {
    collide(part_a.primitive, detail::placed(a.origin, part_a), part_b.primitive, detail::placed(origin_b, part_b),
            margin, out);
  }
}

/// Pairs that a joint keeps from colliding, ascending.
template <class S> void WorldEngine<S>::collect_joined_pairs() {
  joined_pairs_.clear();
  for (const JointProperties<S>& joint : state_.joints.properties) {
    if ((joint.flags & joint_flag::kCollideConnected) != 0 || joint.body_a == kNoBody || joint.body_b == kNoBody)
      continue;
    joined_pairs_.push_back(pair_key(joint.body_a, joint.body_b));
  }
  sort_scratch_.resize(joined_pairs_.size());
  stable_sort(joined_pairs_.data(), sort_scratch_.data(), static_cast<std::uint32_t>(joined_pairs_.size()), OwnKey{});
}

/// Frames of awake bodies come first, in their order; what they meet is added as it is met.
template <class S> void WorldEngine<S>::make_room_for_frames() {
  const std::size_t count = state_.awake.states.size();
  for (const std::uint32_t slot : framed_slots_) framed_[slot] = Framed{};
  framed_.resize(locations_.size());
  framed_slots_.resize(count);
  frames_.resize(count);
  materials_.resize(count);
}
template <class S> void WorldEngine<S>::frame_awake_body(std::size_t index) {
  const auto i = static_cast<std::uint32_t>(index);
  frames_[i] = frame_at({Location::kAwake, i});
  materials_[i] = state_.awake.properties[i].material;
  framed_[frames_[i].slot] = {i, traits_of(frames_[i])};
  framed_slots_[i] = frames_[i].slot;
}
template <class S> void WorldEngine<S>::frame_body(std::uint32_t slot) {
  const BodyFrame<S> frame = frame_at(locations_[slot]);
  framed_[slot] = {static_cast<std::uint32_t>(frames_.size()), traits_of(frame)};
  framed_slots_.push_back(slot);
  frames_.push_back(frame);
  materials_.push_back(properties_at(locations_[slot]).material);
}
template <class S> std::uint32_t WorldEngine<S>::traits_of(const BodyFrame<S>& frame) {
  return static_cast<std::uint32_t>(frame.kind) | (frame.sensor ? Framed::kSensor : 0u) |
         (frame.frozen ? Framed::kFrozen : 0u);
}

/// The parts that might touch, in order of their contacts' keys, and which of them are of one kind. Where compounds
/// have too many, every pair of bodies gets the same share of them.
template <class S> void WorldEngine<S>::gather_parts() {
  const auto budget = static_cast<std::uint64_t>(state_.settings.most_pairs);
  const PartBudget all = {budget * kLooksPerPair, budget * kPartsPerPair};
  if (gather_parts(all, all)) return;
  const std::uint64_t pairs = proxies_.pairs().size();
  gather_parts({all.looks / pairs, all.parts / pairs}, {~std::uint64_t{0}, ~std::uint64_t{0}});
}
/// False: all together do not fit.
template <class S> bool WorldEngine<S>::gather_parts(PartBudget each, PartBudget all) {
  parts_.clear();
  groups_.clear();
  sphere_pairs_.clear();
  box_pairs_.clear();
  other_pairs_.clear();
  const std::vector<std::uint64_t>& pairs = proxies_.pairs();
  std::size_t joined = 0;
  for (const std::uint64_t key : pairs) {
    while (joined < joined_pairs_.size() && joined_pairs_[joined] < key) ++joined;
    if (joined < joined_pairs_.size() && joined_pairs_[joined] == key) continue;
    if (framed_[pair_a(key)].index == Framed::kNone) frame_body(pair_a(key));
    if (framed_[pair_b(key)].index == Framed::kNone) frame_body(pair_b(key));
    const Framed a = framed_[pair_a(key)], b = framed_[pair_b(key)];
    if (a.traits == b.traits && a.traits < static_cast<std::uint32_t>(PartKind::other)) {  // awake and no sensors
      const bool spheres = a.traits == static_cast<std::uint32_t>(PartKind::sphere);
      add_part(spheres ? sphere_pairs_ : box_pairs_, {a.index, b.index, 0, 0});
    } else if (!gather_others(a, b, each, all)) {
      if (all.looks == 0 || all.parts == 0) return false;
      ++report_.cut_compounds;
    }
  }
  return true;
}
/// Takes from `all` what it uses, at most `each`. False: more was there.
template <class S>
bool WorldEngine<S>::gather_others(Framed at_a, Framed at_b, const PartBudget& each, PartBudget& all) {
  const std::uint32_t either = at_a.traits | at_b.traits;
  const bool sensor = (either & Framed::kSensor) != 0;
  if (!sensor && (either & Framed::kFrozen) != 0) return true;  // a kinematic body at rest against sleepers
  const S margin = sensor ? S(0) : detail::kSpeculativeDistance<S>;
  const std::uint64_t most_looks = min(each.looks, all.looks), most_parts = min(each.parts, all.parts);
  std::uint64_t looks = most_looks, parts = most_parts;
  const bool whole =
      visit_parts(frames_[at_a.index], frames_[at_b.index], margin, looks, [&](std::uint32_t i, std::uint32_t j) {
        if (parts == 0) return false;
        --parts;
        add_part(other_pairs_, {at_a.index, at_b.index, i, j});
        return true;
      });
  all.looks -= most_looks - looks;
  all.parts -= most_parts - parts;
  return whole;
}
template <class S> ISO_INLINE void WorldEngine<S>::add_part(std::vector<std::uint32_t>& list, const PartPair& part) {
  const auto place = static_cast<std::uint32_t>(parts_.size() % kGroup);
  if (place == 0) groups_.push_back(list_ends());
  list.push_back(place);
  parts_.push_back(part);
}
template <class S> typename WorldEngine<S>::ListEnds WorldEngine<S>::list_ends() const {
  return {static_cast<std::uint32_t>(sphere_pairs_.size()), static_cast<std::uint32_t>(box_pairs_.size()),
          static_cast<std::uint32_t>(other_pairs_.size())};
}

template <class S> typename WorldEngine<S>::ListEnds WorldEngine<S>::ends_of(std::size_t group) const {
  return group + 1 < groups_.size() ? groups_[group + 1] : list_ends();
}
template <class S> ISO_INLINE std::size_t WorldEngine<S>::parts_of(std::size_t group) const {
  return min(parts_.size() - group * kGroup, std::size_t{kGroup});
}

}  // namespace isostep
