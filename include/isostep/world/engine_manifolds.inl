// WorldEngine: from fat pairs to contacts. Pairs of parts are gathered, collided group by group (each fills a manifold
// of its own, so any order will do), and merged with the contacts of the last step.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/world/engine_parts.inl"

namespace isostep {

namespace detail {
/// Whether both have the same points in the same order, and no name twice: then every impulse stays where it is.
template <class S> ISO_INLINE bool has_same_points(const Contact<S>& old, const Contact<S>& contact) {
  const std::uint32_t *f = old.features, *g = contact.features;
  if (old.count != contact.count || f[0] != g[0] || f[1] != g[1] || f[2] != g[2] || f[3] != g[3]) return false;
  const bool distinct2 = old.count < 2 || f[0] != f[1];
  const bool distinct3 = old.count < 3 || (f[0] != f[2] && f[1] != f[2]);
  return distinct2 && distinct3 && (old.count < 4 || (f[0] != f[3] && f[1] != f[3] && f[2] != f[3]));
}

/// Points keep the impulse of their feature. What no feature claims is shared among the points that found none: when
/// two boxes trade places as reference every feature changes at once, and the load they carry must not vanish with the
/// names.
template <class S> void inherit_impulses(const Contact<S>& old, Contact<S>& contact) {
  using V = Velocity<S>;
  if (has_same_points(old, contact)) {
    for (std::uint32_t p = 0; p < contact.count; ++p) contact.normal_impulse[p] = old.normal_impulse[p];
    return;
  }
  std::uint32_t claimed = 0, missing = 0;  // bit q: of old's point q; bit p: of contact's point p
  for (std::uint32_t p = 0; p < contact.count; ++p) {
    bool found = false;
    for (std::uint32_t q = 0; q < old.count; ++q) {
      if (old.features[q] != contact.features[p]) continue;
      contact.normal_impulse[p] = old.normal_impulse[q];
      claimed |= 1u << q;
      found = true;
    }
    if (!found) missing |= 1u << p;
  }
  if (missing == 0) return;
  V left = V(0);
  for (std::uint32_t q = 0; q < old.count; ++q) left += (claimed >> q & 1u) != 0 ? V(0) : old.normal_impulse[q];
  if (!(left > V(0))) return;
  const V share = left / V(std::popcount(missing));
  for (std::uint32_t p = 0; p < contact.count; ++p) {
    if ((missing >> p & 1u) != 0) contact.normal_impulse[p] = share;
  }
}
}  // namespace detail

/// One group of parts. Every pair fills its own count and manifold and reads frames alone: with room for all of them,
/// groups may be collided at once.
template <class S>
void WorldEngine<S>::collide_group(std::size_t group, std::uint8_t* counts, Manifold<S>* manifolds) const {
  const ListEnds begin = groups_[group], end = ends_of(group);
  PairRun<S> run = {
      frames_.data(), parts_.data() + group * kGroup, nullptr, 0, 0, detail::kSpeculativeDistance<S>, counts,
      manifolds};
  const auto run_of = [&](const std::vector<std::uint32_t>& list, std::uint32_t from, std::uint32_t to) {
    run.order = list.data();
    run.begin = from;
    run.end = to;
    return run;
  };
  pair_kernels_->spheres(run_of(sphere_pairs_, begin.spheres, end.spheres));
  pair_kernels_->boxes(run_of(box_pairs_, begin.boxes, end.boxes));
  collide_others(run_of(other_pairs_, begin.others, end.others));
}
template <class S> void WorldEngine<S>::collide_others(const PairRun<S>& run) {
  for (std::uint32_t i = run.begin; i < run.end; ++i) {
    const PartPair& pair = run.pairs[run.order[i]];
    const BodyFrame<S>&a = run.frames[pair.frame_a], &b = run.frames[pair.frame_b];
    const S margin = a.sensor || b.sensor ? S(0) : run.margin;
    Manifold<S>& out = run.manifolds[run.order[i]];
    collide_parts(a, pair.child_a, b, pair.child_b, margin, out);
    run.counts[run.order[i]] = static_cast<std::uint8_t>(out.count);
  }
}

template <class S>
ISO_INLINE void WorldEngine<S>::fill_contact(const PartPair& parts, const Manifold<S>& manifold, Contact<S>& contact,
                                             ContactGeometry<S>& g, std::size_t& old_cursor) const {
  const BodyFrame<S>&a = frames_[parts.frame_a], &b = frames_[parts.frame_b];
  contact = {};
  contact.key = {a.slot, b.slot, parts.child_a, parts.child_b};
  contact.count = static_cast<std::uint32_t>(manifold.count);
  g.row_a = a.row;
  g.row_b = b.row;
  g.normal = manifold.normal;
  g.material = mix(materials_[parts.frame_a], materials_[parts.frame_b]);
  const Vec3<S> from_a_to_b = b.centre - a.centre;
  for (int p = 0; p < kMaxContactPoints; ++p) {
    if (p == manifold.count) break;
    const ManifoldPoint<S>& point = manifold.points[p];
    contact.features[p] = point.feature;
    g.points[p] = {point.position, point.position - from_a_to_b, point.separation};
  }
  while (old_cursor < old_contacts_.size() && old_contacts_[old_cursor].key < contact.key) ++old_cursor;
  if (old_cursor == old_contacts_.size() || !(old_contacts_[old_cursor].key == contact.key)) return;
  const Contact<S>& old = old_contacts_[old_cursor];
  contact.flags = old.flags;
  contact.friction_impulse = old.friction_impulse;
  contact.twist_impulse = old.twist_impulse;
  detail::inherit_impulses(old, contact);
}

/// Makes room for a group's contacts behind those there are; notes which sensors it touches. Returns where they begin.
/// Contacts are written over those of the step before the last: nothing is cleared first.
template <class S> std::size_t WorldEngine<S>::place_group(std::size_t group, const std::uint8_t* counts) {
  const std::size_t first = placed_, parts = parts_of(group);
  std::size_t touching = 0;
  for (std::size_t i = 0; i < parts; ++i) touching += counts[i] != 0 ? 1u : 0u;
  const ListEnds begin = groups_[group], end = ends_of(group);
  for (std::uint32_t k = begin.others; k < end.others; ++k) {
    const std::size_t i = other_pairs_[k];
    const PartPair& part = parts_[group * kGroup + i];
    const BodyFrame<S>&a = frames_[part.frame_a], &b = frames_[part.frame_b];
    if (counts[i] == 0 || !(a.sensor || b.sensor)) continue;
    const SensorOverlap overlap = a.sensor ? SensorOverlap{a.slot, b.slot} : SensorOverlap{b.slot, a.slot};
    if (new_overlaps_.empty() || !(new_overlaps_.back() == overlap)) new_overlaps_.push_back(overlap);
    --touching;
  }
  placed_ += touching;
  if (state_.contacts.size() < placed_) state_.contacts.resize(placed_);
  if (geometry_.size() < placed_) geometry_.resize(placed_);
  return first;
}

/// The manifolds of one group become contacts, in order, from `next` on.
template <class S>
void WorldEngine<S>::merge_group(std::size_t group, const std::uint8_t* counts, const Manifold<S>* manifolds,
                                 std::size_t next, std::size_t& old_cursor) {
  const PartPair* parts = parts_.data() + group * kGroup;
  for (std::size_t i = 0; i < parts_of(group); ++i) {
    if (counts[i] == 0 || frames_[parts[i].frame_a].sensor || frames_[parts[i].frame_b].sensor) continue;
    fill_contact(parts[i], manifolds[i], state_.contacts[next], geometry_[next], old_cursor);
    ++next;
  }
}

template <class S> void WorldEngine<S>::update_manifolds() {
  collect_joined_pairs();
  make_room_for_frames();
  old_contacts_.swap(state_.contacts);
  new_overlaps_.clear();
  placed_ = 0;
  if (runner_.threads > 1 && proxies_.pairs().size() >= kLeastSharedPairs) share_manifolds();
  else make_manifolds();
  state_.contacts.resize(placed_);
  geometry_.resize(placed_);
  find_carried();
}

/// Kinematic bodies that turn, and the contacts on them.
template <class S> void WorldEngine<S>::find_carried() {
  using V = Velocity<S>;
  carriers_.clear();
  carried_.clear();
  const Settings<S>& settings = state_.settings;
  const std::int32_t rate = integration_rate(settings.solver, settings.hz, settings.substeps);
  const V fastest = spin_limit<S>(rate);
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  const auto turn = [&](V w) { return round_to<Unit<S>>(product(clamp(w, -fastest, fastest), h)); };
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    const BodyProperties<S>& body = state_.awake.properties[i];
    if (body.type != BodyType::kinematic) continue;
    Vec3<V> spin = state_.awake.states[i].spin;
    for (int axis = 0; axis < 3; ++axis) {
      if ((body.flags & (body_flag::kLockAngularX << axis)) != 0) spin[axis] = V(0);
    }
    if (spin == Vec3<V>::zero()) continue;
    const Vec3<Unit<S>> turned = {turn(spin.x), turn(spin.y), turn(spin.z)};
    carriers_.push_back(Carrier<S>::of(static_cast<std::uint32_t>(i) + 1, spin, turned, rate));
  }
  const auto count = static_cast<std::uint32_t>(carriers_.empty() ? 0 : geometry_.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const ContactGeometry<S>& g = geometry_[i];
    for (const bool on_b : {false, true}) {
      const std::uint32_t row = on_b ? g.row_b : g.row_a, rider = on_b ? g.row_a : g.row_b;
      const std::size_t at =
          detail::lower_bound(carriers_.size(), [&](std::size_t k) { return carriers_[k].row < row; });
      if (at == carriers_.size() || carriers_[at].row != row) continue;
      const Vec3<S> a_to_b = g.points[0].arm_a - g.points[0].arm_b;
      carried_.push_back({i, rider, carriers_[at], on_b ? -a_to_b : a_to_b, g.material.surface_velocity, on_b});
      break;  // two that are told both move nothing
    }
  }
}

template <class S> void WorldEngine<S>::make_manifolds() {
  for (std::size_t i = 0; i < frames_.size(); ++i) frame_awake_body(i);
  gather_parts();
  point_counts_.resize(kGroup);
  manifolds_.resize(kGroup);
  std::size_t old_cursor = 0;
  for (std::size_t group = 0; group < groups_.size(); ++group) {  // merged while its manifolds are in the cache
    collide_group(group, point_counts_.data(), manifolds_.data());
    const std::size_t first = place_group(group, point_counts_.data());
    merge_group(group, point_counts_.data(), manifolds_.data(), first, old_cursor);
  }
}

/// The same by threads: frames, collisions and merging side by side, what counts places in between one after another.
template <class S> void WorldEngine<S>::share_manifolds() {
  manifold_pieces_ = min(4 * static_cast<std::uint32_t>(runner_.threads), kMaxPieces);
  awake_frames_ = frames_.size();
  const std::uint32_t p = manifold_pieces_;
  const std::uint32_t stages[] = {p, 1, p, 1, p};  // of do_manifolds
  run_stages(runner_, stages, &WorldEngine::do_manifolds, this);
}
template <class S> void WorldEngine<S>::do_manifolds(void* data, std::uint32_t stage, std::uint32_t piece) {
  WorldEngine& engine = *static_cast<WorldEngine*>(data);
  const auto each = [&](std::size_t count, const auto& work) {
    const std::size_t pieces = engine.manifold_pieces_;
    for (std::size_t i = count * piece / pieces; i < count * (piece + 1) / pieces; ++i) work(i);
  };
  const auto counts = [&](std::size_t group) { return engine.point_counts_.data() + group * kGroup; };
  const auto manifolds = [&](std::size_t group) { return engine.manifolds_.data() + group * kGroup; };
  const std::size_t groups = engine.groups_.size();
  switch (stage) {
    case 0: return each(engine.awake_frames_, [&](std::size_t i) { engine.frame_awake_body(i); });
    case 1:
      engine.gather_parts();
      engine.point_counts_.resize(engine.groups_.size() * kGroup);
      engine.manifolds_.resize(engine.groups_.size() * kGroup);
      return;
    case 2: return each(groups, [&](std::size_t g) { engine.collide_group(g, counts(g), manifolds(g)); });
    case 3:
      engine.group_firsts_.resize(groups);
      for (std::size_t g = 0; g < groups; ++g) engine.group_firsts_[g] = engine.place_group(g, counts(g));
      return;
    default: break;
  }
  each(groups, [&](std::size_t g) {
    std::size_t old_cursor = engine.first_old_contact(g);
    engine.merge_group(g, counts(g), manifolds(g), engine.group_firsts_[g], old_cursor);
  });
}

/// The first of the last step's contacts that any of a group's may continue.
template <class S> std::size_t WorldEngine<S>::first_old_contact(std::size_t group) const {
  const PartPair& part = parts_[group * kGroup];
  const ContactKey least = {frames_[part.frame_a].slot, frames_[part.frame_b].slot, part.child_a, part.child_b};
  std::size_t low = 0, high = old_contacts_.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (old_contacts_[middle].key < least) low = middle + 1;
    else high = middle;
  }
  return low;
}

}  // namespace isostep
