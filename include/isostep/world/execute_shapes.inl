// The commands about shapes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/validate.hpp"
#include "isostep/world/command_executor.hpp"

namespace isostep {

template <class S> ShapeId CommandExecutor<S>::execute(const AddShape<S>& command) {
  if (command.children.size() > kMaxChildren) {
    journal_.refuse({Fault::bad_shape, "", "children", "65536 or fewer"});
    return {};
  }
  std::vector<BlobRef> blobs(command.blobs.size());
  if (!find_blobs(command, blobs)) return {};
  const ShapeFault fault = validate(std::span<const Child<S>>(command.children), blobs);
  if (fault != ShapeFault::none) {
    const bool finite = fault != ShapeFault::not_finite;
    journal_.refuse({finite ? Fault::bad_shape : Fault::not_finite, "", describe(fault), ""});
    return {};
  }
  const ShapeId id = state_.shape_slots.template take<ShapeId>(state_.settings.id_space);
  std::vector<ShapeRecord>& shapes = state_.shapes.change();
  std::vector<Child<S>>& pool = state_.children.change();
  if (shapes.size() <= id.slot) shapes.resize(id.slot + 1, ShapeRecord{0, 0});
  shapes[id.slot] = {static_cast<std::uint32_t>(pool.size()), static_cast<std::uint32_t>(command.children.size())};
  for (const Child<S>& child : command.children) {
    pool.push_back(normalised(child));
    std::uint32_t& blob = pool.back().primitive.blob;
    if (blob != 0) blob = 1 + state_.geometry.change().take(blobs[blob - 1]);
  }
  if (!blobs.empty()) map_.renew_contents();
  map_.renew_tree(id.slot);
  return id;
}

/// The content of what a command names, each of which a part must name.
template <class S> bool CommandExecutor<S>::find_blobs(const AddShape<S>& command, std::vector<BlobRef>& blobs) {
  const GeometryStore& known = *state_.geometry;
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    blobs[i] = known.find(command.blobs[i], assets_);
    if (blobs[i] == nullptr)
      return journal_.refuse({Fault::bad_shape, "", "blobs", "content, or a name that the world or its assets know"});
  }
  if (known.names().size() + blobs.size() > kMaxBlobs)
    return journal_.refuse({Fault::bad_shape, "", "blobs", "kMaxBlobs or fewer in a world"});
  std::vector<std::uint8_t> named(blobs.size(), 0);
  for (const Child<S>& child : command.children) {
    const std::uint32_t blob = child.primitive.blob;
    if (blob != 0 && blob <= blobs.size()) named[blob - 1] = 1;
  }
  for (const std::uint8_t is_named : named) {
    if (is_named == 0) return journal_.refuse({Fault::bad_shape, "", "blobs", "each named by a part"});
  }
  return true;
}

template <class S> bool CommandExecutor<S>::execute(const RemoveShape& command) {
  if (!known(state_.shape_slots, command.shape, "shape")) return false;
  const std::uint32_t slot = command.shape.slot;
  for (std::uint32_t body = 0; body < map_.slots(); ++body) {
    if (map_.location(body).set != Location::kNone && map_.properties_at(map_.location(body)).shape == slot) {
      return journal_.refuse({Fault::shape_in_use, "", "shape", "no body with it"});
    }
  }
  std::vector<ShapeRecord>& shapes = state_.shapes.change();
  std::vector<Child<S>>& pool = state_.children.change();
  const ShapeRecord gone = shapes[slot];
  const auto first = pool.begin() + static_cast<std::ptrdiff_t>(gone.first_child);
  for (auto child = first; child != first + static_cast<std::ptrdiff_t>(gone.child_count); ++child) {
    if (child->primitive.blob != 0) state_.geometry.change().give_back(child->primitive.blob - 1);
  }
  map_.renew_contents();
  pool.erase(first, first + static_cast<std::ptrdiff_t>(gone.child_count));
  for (ShapeRecord& record : shapes) {
    if (record.first_child > gone.first_child) record.first_child -= gone.child_count;
  }
  shapes[slot] = {0, 0};
  map_.renew_tree(slot);
  state_.shape_slots.give_back(slot);
  return true;
}

}  // namespace isostep
