// Shapes: by numbers, of parts, of blobs.
// SPDX-License-Identifier: MIT
#include "objects.hpp"

using namespace isostep;
using namespace isostep::c;

namespace {

template <class S, template <class> class Shape>
iso_status add_shape(iso_world* world, const char* call, const void* from, iso_shape* out) {
  return in_world<S>(world, call, Access::changes, [&](auto& of) {
    ISO_C_REQUIRE(call, out);
    Shape<S> shape{};
    const iso_status taken = take_sized(call, from, shape);
    return taken != kOk ? taken : put_id(of.world.add_shape(shape), out);
  });
}
template <class S, template <class> class Shape>
iso_status put_primitive(const char* call, const void* from, void* out) {
  ISO_C_REQUIRE(call, out);
  Shape<S> shape{};
  const iso_status taken = take_sized(call, from, shape);
  if (taken == kOk) put_plain(out, shape.primitive());
  return taken;
}

template <class S> iso_status add_hull(iso_world* world, const void* from, const iso_blob* blob, iso_shape* out) {
  constexpr const char* kCall = "add_hull";
  return in_world<S>(world, kCall, Access::changes, [&](auto& of) {
    ISO_C_REQUIRE(kCall, out);
    CHull<S> hull;
    const iso_status taken = take_sized(kCall, from, hull);
    if (taken != kOk) return taken;
    const Found<iso_blob> found(blob, kCall);
    if (found.status != kOk) return found.status;
    const Child<S> child = {Hull<S>{1, hull.radius}.primitive(), Pose<S>::identity()};
    return put_id(of.world.add_shape(std::span<const Child<S>>(&child, 1), {&found.object->blob, 1}), out);
  });
}

template <class S>
iso_status add_compound(iso_world* world, const void* children, std::size_t count, const iso_blob* const* blobs,
                        std::size_t blob_count, iso_shape* out) {
  constexpr const char* kCall = "add_compound";
  return in_world<S>(world, kCall, Access::changes, [&](auto& of) {
    ISO_C_REQUIRE(kCall, out);
    if (count != 0) ISO_C_REQUIRE(kCall, children);
    if (blob_count != 0) ISO_C_REQUIRE(kCall, blobs);
    if (count > kMaxChildren) return refuse(kMisused, kCall, "count", "65536 at most");
    if (blob_count > kMaxChildren) return refuse(kMisused, kCall, "blob_count", "65536 at most");
    std::vector<Child<S>> parts(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto* const at = static_cast<const std::uint8_t*>(children) + i * extent_of<Child<S>>().size;
      const iso_status taken = take_plain(kCall, at, parts[i]);
      if (taken != kOk) return taken;
    }
    std::vector<BlobRef> named(blob_count);
    for (std::size_t i = 0; i < blob_count; ++i) {
      const Found<iso_blob> found(blobs[i], kCall);
      if (found.status != kOk) return found.status;
      named[i] = found.object->blob;
    }
    return put_id(of.world.add_shape(std::span<const Child<S>>(parts), named), out);
  });
}

}  // namespace

iso_status iso_add_blob(iso_world* world, const iso_blob* blob, iso_shape* out) {
  constexpr const char* kCall = "add_blob";
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    ISO_C_REQUIRE(kCall, out);
    const Found<iso_blob> found(blob, kCall);
    return found.status != kOk ? found.status : put_id(of.world.add_shape(found.object->blob), out);
  });
}

iso_status iso_world_add_asset(iso_world* world, const iso_blob* blob) {
  constexpr const char* kCall = "world_add_asset";
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    const Found<iso_blob> found(blob, kCall);
    if (found.status != kOk) return found.status;
    for (const BlobRef& asset : of.assets) {
      if (asset->id() == found.object->blob->id()) return kOk;
    }
    of.assets.push_back(found.object->blob);
    of.use_assets_of(of.world);
    return kOk;
  });
}

iso_status iso_set_heights(iso_world* world, iso_shape shape, uint32_t child, const iso_height_patch* patch) {
  constexpr const char* kCall = "set_heights";
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    CHeightPatch from;
    const iso_status taken = take_sized(kCall, patch, from);
    if (taken != kOk) return taken;
    if (from.columns == 0 || from.rows == 0) return refuse(kMisused, kCall, "columns, rows", "1 or more");
    ISO_C_REQUIRE(kCall, from.heights.at);
    const std::uint64_t places = std::uint64_t{from.columns} * from.rows;
    if (places > SetHeights::kMost) return refuse(kMisused, kCall, "columns, rows", "a part of the field");
    HeightPatch heights = {
        from.column, from.row, from.columns, from.rows, {from.heights.at, static_cast<std::size_t>(places)}, {}};
    const std::uint64_t cells = std::uint64_t{from.columns - 1} * (from.rows - 1);
    if (from.materials.at != nullptr) heights.materials = {from.materials.at, static_cast<std::size_t>(cells)};
    of.world.set_heights(id_of<ShapeId>(shape), child, heights);
    return kOk;
  });
}

iso_status iso_get_heights(const iso_world* world, iso_shape shape, uint32_t child, iso_height_grid* grid,
                           const int16_t** heights, const uint8_t** materials) {
  constexpr const char* kCall = "get_heights";
  return in_any_world(world, kCall, Access::reads, [&](auto& of) {
    ISO_C_REQUIRE(kCall, heights);
    ISO_C_REQUIRE(kCall, materials);
    const BakedHeightField* const field = of.world.height_field(id_of<ShapeId>(shape), child);
    if (field == nullptr) return refuse({Fault::bad_argument, kCall, "shape", "a height field of this world"});
    *heights = field->heights().data();
    *materials = field->materials().data();
    return put_sized(kCall, grid, field->grid());
  });
}

iso_status iso_remove_shape(iso_world* world, iso_shape shape) {
  return in_any_world(world, "remove_shape", Access::changes, [&](auto& of) {
    of.world.remove_shape(id_of<ShapeId>(shape));
    return kOk;
  });
}

#define ISO_SHAPE(P, S, name)                                                                        \
  iso_status iso_##P##_add_##name(iso_world* world, const iso_##P##_##name* shape, iso_shape* out) { \
    return add_shape<S, twin::name>(world, "add_" #name, shape, out);                                \
  }                                                                                                  \
  iso_status iso_##P##_##name##_primitive(const iso_##P##_##name* shape, iso_##P##_primitive* out) { \
    return put_primitive<S, twin::name>(#name "_primitive", shape, out);                             \
  }
#define ISO_SHAPES(P, S)                                                                                              \
  ISO_SHAPE(P, S, sphere)                                                                                             \
  ISO_SHAPE(P, S, box)                                                                                                \
  ISO_SHAPE(P, S, capsule)                                                                                            \
  ISO_SHAPE(P, S, half_space)                                                                                         \
  ISO_SHAPE(P, S, cylinder)                                                                                           \
  ISO_SHAPE(P, S, cone)                                                                                               \
  iso_status iso_##P##_add_hull(iso_world* world, const iso_##P##_hull* hull, const iso_blob* blob, iso_shape* out) { \
    return add_hull<S>(world, hull, blob, out);                                                                       \
  }                                                                                                                   \
  iso_status iso_##P##_add_compound(iso_world* world, const iso_##P##_child* children, size_t count,                  \
                                    const iso_blob* const* blobs, size_t blob_count, iso_shape* out) {                \
    return add_compound<S>(world, children, count, blobs, blob_count, out);                                           \
  }
ISO_C_FAMILIES(ISO_SHAPES)
