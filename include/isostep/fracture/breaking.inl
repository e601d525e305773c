// Bodies of breaking.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "isostep/core/random.hpp"
#include "isostep/fracture/breaking.hpp"
#include "isostep/fracture/shatter.hpp"
#include "isostep/math/transform.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/store/state.hpp"

namespace isostep {
namespace detail {

/// Returns a direction [1] on the grid, to 15 bits.
template <class U> GridVector grid_direction(const Vec3<U>& v) {
  return {nearest_scaled(v.x, 15), nearest_scaled(v.y, 15), nearest_scaled(v.z, 15)};
}
/// Returns a pattern with as many pieces as the record allows, or a few less.
template <class S> FracturePattern pattern_of(const Breakable<S>& b) {
  const std::uint32_t n = b.most_pieces;
  switch (b.pattern) {
    case BreakPattern::grain: return GrainPlanes{grid_direction(b.grain), min(n / 2 - 1, GrainPlanes::kMost), 1};
    case BreakPattern::radial: return n < 6 ? RadialCracks{n, 0} : RadialCracks{min(n / 3, RadialCracks::kMost), 2};
    case BreakPattern::voronoi: return VoronoiCells{n, 128};
    default: return EightBoxes{};
  }
}

/// Breaks one marked body.
template <class S> class Breaking {
  using U = Unit<S>;

 public:
  Breaking(World<S>& world, const Breakable<S>& record, const Blow<S>& blow)
      : world_(world), record_(record), blow_(blow) {}

  /// Returns the number of pieces [1], or 0 if the body is unchanged.
  std::uint32_t run() {
    const std::optional<Fracture> pieces = pieces_of_body();
    if (!pieces || pieces->pieces.size() < 2) return 0;
    const std::vector<ShapeId> shapes = add_piece_shapes(world_, *pieces);
    const auto shards = shatter<S>(*pieces, world_.view(record_.body), shapes);
    if (!shards.ok()) {
      for (const ShapeId shape : shapes) {
        if (shape) world_.remove_shape(shape);
      }
      return 0;
    }
    replace(shards.value());
    return static_cast<std::uint32_t>(shards.value().size());
  }

 private:
  std::optional<Fracture> pieces_of_body() const {
    const BodyView<S> view = world_.view(record_.body);
    if (view.state == nullptr || view.children.size() != 1) return {};
    const Child<S>& child = view.children[0];
    const std::optional<GridHull> solid = solid_of(child.primitive);
    if (!solid) return {};
    const Transform<S> frame = Transform<S>::of(child.pose);
    const auto impact = grid_impact(*solid, to_local(frame, blow_.point), blow_in(frame));
    if (!impact.ok()) return {};
    FractureLimits limits;
    limits.most_pieces = record_.most_pieces;
    const Result<Fracture> pieces = fracture(*solid, pattern_of(record_), impact.value(), seed(), limits);
    if (!pieces.ok()) return {};
    return pieces.value();
  }
  /// Returns the blow's direction [1] as a vector of S, which has digits enough for a direction.
  Vec3<S> blow_in(const Transform<S>& frame) const {
    return transposed_times(frame.rotation, convert<S>(blow_.direction));
  }
  std::optional<GridHull> solid_of(const Primitive<S>& primitive) const {
    if (primitive.type == ShapeType::box) {
      const Result<GridHull> box = grid_box(Box<S>::of(primitive));
      return box.ok() ? std::optional<GridHull>(box.value()) : std::nullopt;
    }
    if (primitive.type != ShapeType::hull || primitive.radius > S(0)) return {};
    const Result<GridHull> hull = read_hull(world_.state().geometry->content(primitive.blob - 1)->bytes());
    return hull.ok() ? std::optional<GridHull>(hull.value()) : std::nullopt;
  }
  std::uint64_t seed() const {
    const std::uint64_t body = std::uint64_t{record_.body.generation} << 32 | record_.body.slot;
    Pcg32 mixed = Pcg32::seeded(record_.seed ^ body, world_.tick());
    const std::uint64_t high = mixed.next();
    return high << 32 | mixed.next();
  }

  void replace(const std::vector<BodyDefinition<S>>& shards) {
    const BodyView<S> view = world_.view(record_.body);
    const S whole = view.properties->mass;
    const ShapeId shape = world_.state().shape_slots.template id_of<ShapeId>(view.properties->shape);
    world_.destroy(record_.body);
    if (record_.owns_shape) world_.remove_shape(shape);
    for (const BodyDefinition<S>& shard : shards) {
      const BodyId piece = world_.create(shard);
      if (piece) add_record(piece, shard.mass, whole);
    }
  }
  void add_record(BodyId piece, S mass, S whole) {
    Breakable<S> record = record_;
    record.body = piece;
    record.depth = record_.depth > 0 ? record_.depth - 1 : 0;
    record.break_impulse = record_.break_impulse * divide_to<U>(mass, whole);
    record.owns_shape = true;
    record.expires = record_.lifetime > 0 && mass < record_.small_mass ? world_.tick() + record_.lifetime : 0;
    if (record.depth > 0 || record.expires > 0) world_.add(record);
  }

  World<S>& world_;
  Breakable<S> record_;
  Blow<S> blow_;
};

/// Destroys an expired body, and its shape if it has one of its own.
template <class S> void remove_expired(World<S>& world, const Breakable<S>& record) {
  const BodyView<S> view = world.view(record.body);
  const ShapeId shape = world.state().shape_slots.template id_of<ShapeId>(view.properties->shape);
  world.destroy(record.body);
  if (record.owns_shape) world.remove_shape(shape);
}

}  // namespace detail

template <class S> BreakReport break_bodies(World<S>& world, std::uint32_t most) {
  return pin_floats([&] {
    BreakReport report;
    const auto& registry = world.state().records->breakables;
    std::vector<BreakableId> due;
    for (const BreakableId id : registry.slot_map().template ids<BreakableId>()) {
      const Breakable<S>& record = *registry.find(id);
      const bool is_over = record.expires != 0 && record.expires <= world.tick();
      if (!world.is_enabled(record.body)) continue;
      if (is_over || S(0) < world.input(id)->impulse) due.push_back(id);
    }
    for (const BreakableId id : due) {
      const Breakable<S> record = *world.find(id);
      if (record.expires != 0 && record.expires <= world.tick()) {
        detail::remove_expired(world, record);
        ++report.expired;
        continue;
      }
      if (report.broken + report.whole >= most) continue;
      const std::uint32_t pieces = detail::Breaking<S>(world, record, *world.input(id)).run();
      report.pieces += pieces;
      if (pieces > 0) {
        ++report.broken;
        continue;
      }
      ++report.whole;
      world.set_input(id, Blow<S>{});
    }
    return report;
  });
}

}  // namespace isostep
