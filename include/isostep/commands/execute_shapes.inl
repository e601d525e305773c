// The commands about shapes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/commands/command_executor.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/geometry/validate.hpp"
#include "isostep/store/fat_box.hpp"

namespace isostep {

template <class S> ShapeId CommandExecutor<S>::execute(const AddShape<S>& command) {
  if (command.children.size() > kMaxChildren) {
    faults_.refuse({Fault::bad_shape, "", "children", "65536 or fewer"});
    return {};
  }
  std::vector<BlobRef> blobs(command.blobs.size());
  if (!find_blobs(command, blobs)) return {};
  const ShapeFaultPlace wrong = find_fault(std::span<const Child<S>>(command.children), blobs);
  if (wrong.fault != ShapeFault::none) {
    faults_.refuse(detail::report_of(wrong));
    return {};
  }
  if (!accept_traits(command.children)) return {};
  const ShapeId id = state_.shape_slots.template take<ShapeId>(state_.settings.id_space);
  std::vector<Child<S>> children;
  children.reserve(command.children.size());
  for (const Child<S>& child : command.children) {
    children.push_back(normalised(child));
    std::uint32_t& blob = children.back().primitive.blob;
    if (blob == 0) continue;
    const std::uint32_t place = state_.geometry.change().take(blobs[blob - 1]);
    map_.shapes.renew_content(place);
    blob = 1 + place;
  }
  map_.shapes.put(id.slot, std::move(children));
  return id;
}

template <class S> bool CommandExecutor<S>::accept_traits(std::span<const Child<S>> children) {
  for (std::uint32_t i = 0; i < children.size(); ++i) {
    FaultReport wrong = detail::fault_of(children[i].traits);
    if (wrong == Fault::none) continue;
    wrong.child = i;
    return faults_.refuse(wrong);
  }
  return true;
}

/// Finds the content that a command names. A part must name each.
template <class S> bool CommandExecutor<S>::find_blobs(const AddShape<S>& command, std::vector<BlobRef>& blobs) {
  const GeometryStore& known = *state_.geometry;
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    blobs[i] = known.find(command.blobs[i], assets_);
    if (blobs[i] == nullptr)
      return faults_.refuse({Fault::bad_shape, "", "blobs", "content, or a name that the world or its assets know"});
  }
  if (known.names().size() + blobs.size() > kMaxBlobs)
    return faults_.refuse({Fault::bad_shape, "", "blobs", "kMaxBlobs or fewer in a world"});
  std::vector<std::uint8_t> named(blobs.size(), 0);
  for (const Child<S>& child : command.children) {
    const std::uint32_t blob = child.primitive.blob;
    if (blob != 0 && blob <= blobs.size()) named[blob - 1] = 1;
  }
  for (const std::uint8_t is_named : named) {
    if (is_named == 0) return faults_.refuse({Fault::bad_shape, "", "blobs", "each named by a part"});
  }
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const RemoveShape& command) {
  if (!known(state_.shape_slots, command.shape, "shape")) return false;
  const std::uint32_t slot = command.shape.slot;
  if (map_.shapes.is_used(slot)) return faults_.refuse({Fault::shape_in_use, "", "shape", "no body with it"});
  for (const Child<S>& child : map_.shapes.children_of(slot)) {
    if (child.primitive.blob == 0) continue;
    state_.geometry.change().give_back(child.primitive.blob - 1);
    map_.shapes.renew_content(child.primitive.blob - 1);
  }
  map_.shapes.put(slot, {});
  state_.shape_slots.give_back(slot);
  return true;
}

/// The change covers old and new heights: a body stood on the old ones, or lies under the new ones.
template <class S> bool CommandExecutor<S>::execute(const SetHeights& command) {
  if (!known(state_.shape_slots, command.shape, "shape")) return false;
  const std::uint32_t shape = command.shape.slot;
  const Child<S>* const known_child = map_.shapes.height_field_of(shape, command.child);
  if (known_child == nullptr) return faults_.refuse({Fault::bad_argument, "", "child", "a height field of the shape"});
  const Child<S> child = *known_child;
  const HeightPatch patch = command.patch();
  const BakedHeightField& field = shape_as<HeightField>(map_.shapes.contents().view(child.primitive)).surface();
  const Result<BakedHeightField> changed = field.with_heights(patch);
  if (!accept_patch(changed)) return false;
  const BakedHeightField before = field;  // the field itself may be gone when its shape has another
  const int exponent = field.exponent();
  const Aabb<S> about = merge(detail::box_of_steps<S>(field.bounds_about(patch), exponent),
                              detail::box_of_steps<S>(changed.value().bounds_about(patch), exponent));
  replace_blob(shape, command.child, height_field_blob(changed.value()));
  for (std::uint32_t body = 0; body < map_.slot_count(); ++body) {
    if (map_.location(body).set != Location::kNone && map_.properties_at(map_.location(body)).shape == shape)
      renew_ground(body, child.pose,
                   {command.child, about, {child.primitive, &before}, {child.primitive, &changed.value()}});
  }
  return true;
}

template <class S> bool CommandExecutor<S>::accept_patch(const Result<BakedHeightField>& changed) {
  if (!changed.ok() && changed.error().place == "heights")
    return faults_.refuse({Fault::bad_argument, "", "heights", "one a place of a rectangle inside the field"});
  if (!changed.ok())
    return faults_.refuse({Fault::bad_argument, "", "materials", "none, or one a cell, and somewhere no hole"});
  const ShapeFault fault = detail::fault_of_surface<S>(changed.value());
  if (fault != ShapeFault::none) return faults_.refuse({Fault::bad_shape, "", "heights", expected_of(fault)});
  const bool fits = state_.geometry->names().size() < kMaxBlobs;
  return fits || faults_.refuse({Fault::bad_shape, "", "heights", "fewer than kMaxBlobs in a world"});
}
/// An asset stays one: if the store or the game's assets have content of that name, it comes from there.
template <class S>
void CommandExecutor<S>::replace_blob(std::uint32_t shape, std::uint32_t child, const BlobRef& blob) {
  const BlobRef known = state_.geometry->find(BlobMention{blob->id(), nullptr}, assets_);
  const std::span<const Child<S>> now = map_.shapes.children_of(shape);
  std::vector<Child<S>> children(now.begin(), now.end());
  std::uint32_t& name = children[child].primitive.blob;
  GeometryStore& store = state_.geometry.change();
  const std::uint32_t old = name - 1, place = store.take(known != nullptr ? known : blob);
  name = 1 + place;
  store.give_back(old);
  map_.shapes.renew_content(old);
  map_.shapes.renew_content(place);
  map_.shapes.put(shape, std::move(children));
}
/// Renews a body whose field has changed. `field`: its pose in the body's frame.
template <class S>
void CommandExecutor<S>::renew_ground(std::uint32_t body, const Pose<S>& field, const FieldChange& change) {
  const Location at = map_.location(body);
  if (at.is_asleep()) wake_.wake_for_change(body);
  const Location now = map_.location(body);
  const BodyProperties<S>& properties = map_.properties_at(now);
  BodyState<S> state = map_.state_at(now);
  const Transform<S> placed = compose(Transform<S>::of(origin_pose(state, properties)), Transform<S>::of(field));
  const Aabb<S> fat = state.fat;
  detail::renew_fat_box(map_, state, properties, true);
  if (!(state.fat == fat)) {
    map_.change_state(body).fat = state.fat;
    proxies_.place(state, map_.properties_at(now), now.set == Location::kAwake);
  }
  const Aabb<S> there = grow(detail::turned_box(change.about, placed), detail::kFatMargin<S>);
  wake_.wake_touching(there, body);
  wake_.wake_wheels_on(body, there);
  lift_buried(body, placed, there, change);
}
/// A field holds nothing from behind: a body whose centre was above its old heights and is below the new ones rises by
/// as much as the ground below that centre.
template <class S>
void CommandExecutor<S>::lift_buried(std::uint32_t ground, const Transform<S>& placed, const Aabb<S>& there,
                                     const FieldChange& change) {
  const BodyProperties<S>& own = map_.properties_at(map_.location(ground));
  const PartTraits<S>& field = map_.shapes.children_of(own.shape)[change.child].traits;
  std::vector<std::uint32_t> met;
  proxies_.boxes().query(there, [&](std::uint32_t slot) {
    const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
    if (body.type != BodyType::dynamic || !map_.shapes.has_contacts(own) || !map_.shapes.has_contacts(body))
      return true;
    bool collides = false;
    for (const Child<S>& part : map_.shapes.children_of(body.shape))
      collides = collides || parts_collide(field, own.filter, part.traits, body.filter);
    if (collides) met.push_back(slot);
    return true;
  });
  std::vector<std::uint32_t> scratch(met.size());
  stable_sort(met.data(), scratch.data(), static_cast<std::uint32_t>(met.size()), OwnKey{});
  for (const std::uint32_t slot : met) {
    const Vec3<S> centre = map_.state_at(map_.location(slot)).centre;
    const Vec3<S> rise = placed.rotation.column(1) * rise_below(centre, placed, change);
    if (rise == Vec3<S>::zero() || !detail::within(centre + rise, Limits<S>::position())) continue;
    Pose<S> pose = map_.origin_pose_at(slot);
    pose.position += rise;
    if (detail::within(pose.position, Limits<S>::position()))
      execute(SetPose<S>{state_.body_slots.template id_of<BodyId>(slot), pose});
  }
}
/// [m] The rise of the field below a centre that was above it and no longer is; else 0.
template <class S>
S CommandExecutor<S>::rise_below(Vec3<S> centre, const Transform<S>& placed, const FieldChange& change) const {
  const Vec3<Unit<S>> up = placed.rotation.column(1);
  const S height = to_local(placed, centre).y, clear = S(1);  // [m]
  const S above = max(change.about.high.y - height, S(0)) + clear;
  const S below = max(height - change.about.low.y, S(0)) + clear;
  const Vec3<S> start = centre + up * above, way = up * -(above + below);
  RayHit<S> was, is;
  if (!detail::within(start, Limits<S>::position()) || !ray_cast(change.before, placed, start, way, S(1), was) ||
      !ray_cast(change.after, placed, start, way, S(1), is))
    return S(0);
  const S centre_at = divide_to<S>(above, above + below);  // [1] of the way
  if (was.fraction < centre_at || !(is.fraction < centre_at)) return S(0);
  return saturate_to<S>(product(was.fraction - is.fraction, above + below));
}

}  // namespace isostep
