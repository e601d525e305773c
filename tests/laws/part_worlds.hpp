// Bodies of a few parts with traits of their own, for the laws of such.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "unit/world/worlds.hpp"

namespace isostep::test {

inline constexpr std::uint32_t kOther = 2;  // a category that bodies are not of

template <class S> class PartWorlds : public ::testing::Test {
 protected:
  using Parts = std::vector<Child<S>>;

  static Child<S> box(D3 half, D3 at, const PartTraits<S>& traits = {}) {
    Child<S> part = part_at(primitive_of(Box<S>{vec<S>(half)}), at);
    part.traits = traits;
    return part;
  }
  static PartTraits<S> slippery(double friction) {
    Material<S> material;
    material.friction = num<S>(friction);
    return PartTraits<S>{}.with(material);
  }
  /// Collides with what is of that category alone.
  static PartTraits<S> only(std::uint32_t category) { return PartTraits<S>{}.with(Filter{category, category, 0}); }
  static PartTraits<S> flagged(std::uint32_t flags) { return PartTraits<S>{}.with(flags); }
  /// A surface of heights as a part: its blob is the first of its shape.
  Child<S> field_part(const BlobRef& field) {
    Child<S> part = w.state().shapes[w.add_shape(field).slot]->children[0];
    part.primitive.blob = 1;
    return part;
  }
  ShapeId shape(const Parts& parts, const std::vector<BlobRef>& blobs = {}) {
    const ShapeId id = w.add_shape(std::span<const Child<S>>(parts), std::span<const BlobRef>(blobs));
    EXPECT_TRUE(id) << describe(w.fault());
    return id;
  }
  BodyId fixed(const Parts& parts, D3 at = {0, 0, 0}) { return w.create(quiet(still<S>(shape(parts), at))); }
  BodyId loose(const Parts& parts, D3 at, D3 velocity = {0, 0, 0}) {
    return w.create(quiet(moving<S>(shape(parts), at, velocity)));
  }
  static BodyDefinition<S> quiet(BodyDefinition<S> d) {
    d.report_contacts = false;
    d.allow_sleep = false;
    return d;
  }
  D3 at(BodyId body) const { return real(w.view(body).pose.position); }
  /// Two floors side by side: one part of each side, along x.
  Parts floors(const PartTraits<S>& left, const PartTraits<S>& right) {
    return {box({8, 0.5, 4}, {-8, -0.5, 0}, left), box({8, 0.5, 4}, {8, -0.5, 0}, right)};
  }

  World<S> w{settings<S>()};
};

}  // namespace isostep::test
